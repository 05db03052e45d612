//! The stages Prepare, Sweep and Correct, slab by slab.

mod conjugate;

use crate::report::StepReport;
use crate::rule::contact::contacts::aim;
use crate::rule::contact::contacts::kernel;
use crate::rule::contact::contacts::{passages, surface_sweeps, surfaces};
use crate::rule::contact::slabs::{Direction, Slab, Slabs};
use crate::rule::contact::slots::slab_totals::SlabTotals;
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;
use crate::settings::Contact;

/// Largest change of an impulse in a sweep, as a part of the largest impulse: with `converged`, sweeps
/// end there.
const CONVERGED: f64 = 1e-10;
/// Overlap that a sub-step may add, as a part of the smallest radius, before there are more sweeps.
const TOLERABLE: f64 = 0.001;
/// Largest number of sweeps, as a multiple of the parameter.
const MORE: u32 = 8;
/// Largest number of sweeps with `converged`.
const MOST_SWEEPS: u32 = 20_000;

/// Prepares all contacts: normals, gaps, impacts; applies the impulses to start from.
pub(crate) fn prepare(solver: &mut Solver, sub_step: &SubStep) {
    let Solver { slots, slabs, places, .. } = solver;
    slabs.each_contact(slots, Direction::Forwards, |run, slab| {
        aim::prepare(run, &mut slab.batches, sub_step);
        passages::find(run, &mut slab.surfaces, places);
        surfaces::prepare(run, &mut slab.surfaces, places, sub_step);
        surface_sweeps::find_active(&slab.surfaces, &mut slab.active);
    });
}

/// Sweeps over all contacts: as often as the parameters say, and longer while bodies would overlap by more than
/// [`TOLERABLE`]. These sweeps go in one direction, since a heap needs more sweeps forth and back. In each slab
/// surfaces come last, so that little is pressed through them.
pub(crate) fn sweep(
    solver: &mut Solver,
    sub_step: &SubStep,
    parameters: Contact,
    report: &mut StepReport,
) {
    let residual = if parameters.converged {
        converge(solver, report)
    } else {
        sweep_until_apart(solver, sub_step, parameters.sweeps, report)
    };
    let account = &mut report.contact_account;
    account.residual = account.residual.max(residual);
}

/// Sweeps at least this number of times, then over the slabs that still close and those beside them. Returns the
/// residual.
fn sweep_until_apart(
    solver: &mut Solver,
    sub_step: &SubStep,
    least: u32,
    report: &mut StepReport,
) -> f64 {
    let tolerable = TOLERABLE * solver.smallest_radius / sub_step.h;
    let mut number = 0;
    loop {
        let found = sweep_once(solver, false, report);
        number += 1;
        let slabs = &mut solver.slabs;
        if number >= least {
            pass_over_apart(slabs, tolerable);
        }
        if number >= MORE * least || slabs.iter().all(|slab| slab.is_done) {
            slabs.iter_mut().for_each(|slab| slab.is_done = false);
            return found.residual();
        }
    }
}

/// Excludes from sweeps the slabs whose contacts, and those of the slabs beside them, close by no more than this
/// speed \[m/s\].
fn pass_over_apart(slabs: &mut Slabs, tolerable: f64) {
    let is_apart = |slab: &Slab| slab.totals.excess <= tolerable;
    let apart: Vec<bool> = slabs.list.iter().map(is_apart).collect();
    for (number, slab) in slabs.list.iter_mut().enumerate() {
        let near = number.saturating_sub(1)..(number + 2).min(apart.len());
        slab.is_done = apart[near].iter().all(|it| *it);
    }
    slabs.far.is_done = is_apart(&slabs.far);
}

/// Sweeps forth and back until impulses hardly change, without friction along conjugate directions. Returns the
/// residual.
fn converge(solver: &mut Solver, report: &mut StepReport) -> f64 {
    let descends = !solver.kinds.friction;
    if descends {
        conjugate::begin(&mut solver.slots, &mut solver.slabs);
    }
    let (mut last, mut sweeps) = (f64::INFINITY, 0);
    loop {
        sweep_once(solver, true, report);
        let residual = sweep_once(solver, false, report).residual();
        sweeps += 2;
        if residual <= CONVERGED || sweeps >= MOST_SWEEPS {
            conjugate::end(&mut solver.slabs);
            return residual;
        }
        if descends {
            last = conjugate::follow(&mut solver.slots, &mut solver.slabs, last);
        }
    }
}

/// Sweeps over all contacts once, but for those of slabs that are done.
pub(crate) fn sweep_once(
    solver: &mut Solver,
    backwards: bool,
    report: &mut StepReport,
) -> SlabTotals {
    let Solver { slots, slabs, .. } = solver;
    let direction = if backwards { Direction::Backwards } else { Direction::Forwards };
    slabs.each_contact(slots, direction, |run, slab| {
        if slab.is_done {
            return;
        }
        let SlabTotals { change, excess, impulse, .. } = if backwards {
            let surfaces = surface_sweeps::sweep(run, slab.active_surfaces(), backwards);
            kernel::sweep(run, &mut slab.batches, backwards).or_larger(surfaces)
        } else {
            let pairs = kernel::sweep(run, &mut slab.batches, backwards);
            surface_sweeps::sweep(run, slab.active_surfaces(), backwards).or_larger(pairs)
        };
        slab.totals = SlabTotals { change, excess, impulse, ..slab.totals };
    });
    report.work.sweeps += 1;
    slabs.iter().fold(SlabTotals::default(), |all, slab| all.or_larger(slab.totals))
}

/// Scales the speeds at which bounces separate by this part.
pub(crate) fn soften_bounces(solver: &mut Solver, part: f64) {
    let soften = |bias: &mut f64| {
        if *bias < 0.0 {
            *bias *= part;
        }
    };
    for slab in solver.slabs.iter_mut() {
        slab.batches.pairs.iter_mut().flat_map(|batch| &mut batch.bias).for_each(soften);
        slab.surfaces.iter_mut().map(|contact| &mut contact.bias).for_each(soften);
    }
}

/// Moves overlapping bodies apart by a part of each overlap; velocities stay as they are.
pub(crate) fn correct(solver: &mut Solver, report: &mut StepReport) {
    let Solver { slots, slabs, places, .. } = solver;
    slabs.each_contact(slots, Direction::Forwards, |run, slab| {
        let of_pairs = kernel::correct(run, &slab.batches);
        let of_surfaces = surface_sweeps::correct(run, &slab.surfaces, places);
        slab.totals.energy = of_pairs.energy + of_surfaces.energy;
        slab.totals.overlap = of_pairs.overlap.max(of_surfaces.overlap);
    });
    report.energy_account.correction += slabs.energy();
    let overlap = slabs.iter().map(|slab| slab.totals.overlap).fold(0.0, f64::max);
    let account = &mut report.contact_account;
    account.largest_overlap = account.largest_overlap.max(overlap);
}
