//! Conservation laws in a long run of elastic impacts.

use std::sync::{Arc, OnceLock};

use carom::{BodyPair, Boundary, DVec3, Rule, Settings, World};

use super::claim::{Claim, Expected, Fault, Measured, Tolerance};
use super::setup::{add_walls, world};
use crate::gas::{Filling, Speeds, add_spheres, gas};

const FILLING: Filling = Filling { count: 1_000, packing_fraction: 0.2 };
const IMPACTS: usize = 1_000_000;
/// Number of frames between two checks of all pairs of spheres.
const FRAMES_PER_LOOK: usize = 100;
/// Many more frames than the impacts should take.
const MOST_FRAMES: usize = 100_000;

pub fn claims() -> Vec<Claim> {
    let runs = [of_runs("in a periodic box", periodic), of_runs("in six walls", walled)];
    runs.into_iter().flatten().collect()
}

/// Claims about a run that is made once for all of them.
fn of_runs(place: &str, run: fn(Rule) -> Result<LargestErrors, Fault>) -> [Claim; 5] {
    let shared = Arc::new(OnceLock::new());
    let claim = |name: &str, bound: f64, reason: &'static str, part: fn(&LargestErrors) -> f64| {
        let shared = Arc::clone(&shared);
        Claim::new(
            format!("gas of 1,000 {place}, 1,000,000 impacts: {name}"),
            Expected::no_error("conservation laws"),
            Tolerance::absolute(bound, reason),
            move |rule| {
                let kept: &Result<LargestErrors, Fault> = shared.get_or_init(|| run(rule));
                let kept = kept.as_ref().map_err(ToString::to_string)?;
                Ok(Measured { value: part(kept), ..kept.state })
            },
        )
    };
    let target = "as demanded; rounding of a million impacts is 3e-13";
    let of_impact = "rounding of two velocities, twenty units";
    [
        claim("energy [relative]", 1e-12, target, |kept| kept.energy),
        claim("momentum [of the sum of sizes]", 1e-12, target, |kept| kept.momentum),
        claim("largest overlap [radius]", 1e-9, target, |kept| kept.overlap),
        claim("energy of any impact [relative]", 5e-15, of_impact, |kept| kept.impact_energy),
        claim("momentum of any impact [relative]", 5e-15, of_impact, |kept| kept.impact_momentum),
    ]
}

/// Largest errors of a run.
struct LargestErrors {
    /// Relative error of the energy.
    energy: f64,
    /// Error of the momentum, relative to the sum of the magnitudes of the momenta.
    momentum: f64,
    /// Overlap in radii.
    overlap: f64,
    /// Largest relative error of energy in a single entry of the ledger; NaN if the rule keeps no
    /// ledger.
    impact_energy: f64,
    impact_momentum: f64,
    /// State at the end.
    state: Measured,
}

fn periodic(rule: Rule) -> Result<LargestErrors, Fault> {
    run(gas(FILLING, Speeds::Equilibrium, rule, 1)?)
}

fn walled(rule: Rule) -> Result<LargestErrors, Fault> {
    let mut world = world(rule)?;
    // The edge of the filling is meant for centres.
    add_walls(&mut world, FILLING.edge() + 1.0)?;
    add_spheres(&mut world, FILLING, Speeds::Equilibrium, 1)?;
    run(world)
}

fn run(mut world: World) -> Result<LargestErrors, Fault> {
    let energy = world.kinetic_energy();
    let sizes: f64 = world.spheres().velocities().iter().map(|v| v.length()).sum();
    // Momentum at the start, plus what walls have added since.
    let mut momentum = world.momentum();
    let (mut overlap, mut impact_energy, mut impact_momentum) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut impacts, mut entries, mut frames) = (0, 0, 0);
    while impacts < IMPACTS && frames < MOST_FRAMES {
        let report = world.step(FILLING.frame_time())?;
        for impact in &report.impacts {
            if let BodyPair::Collider { .. } = impact.between {
                momentum += impact.impulse * impact.normal;
            }
        }
        for entry in report.ledger() {
            entries += 1;
            impact_energy = impact_energy.max(entry.group.energy_error());
            impact_momentum = impact_momentum.max(entry.group.momentum_error());
        }
        impacts += report.impacts.len();
        frames += 1;
        if frames % FRAMES_PER_LOOK == 0 {
            overlap = overlap.max(deepest_overlap(&world));
        }
    }
    // Without impacts, or with an empty ledger, conservation would prove nothing.
    if impacts < IMPACTS {
        return Err(format!("only {impacts} impacts").into());
    }
    if entries == 0 {
        (impact_energy, impact_momentum) = (f64::NAN, f64::NAN);
    }
    Ok(LargestErrors {
        energy: (world.kinetic_energy() / energy - 1.0).abs(),
        momentum: (world.momentum() - momentum).length() / sizes,
        overlap,
        impact_energy,
        impact_momentum,
        state: Measured::in_world(&world, 0.0),
    })
}

/// Deepest overlap in radii of one half.
fn deepest_overlap(world: &World) -> f64 {
    let depth = match *world.settings() {
        Settings { boundary: Boundary::Periodic { size }, .. } => {
            1.0 - nearest_distance(world.spheres().positions(), size)
        }
        _ => world.overlaps(0.0).iter().map(|overlap| overlap.depth).fold(0.0, f64::max),
    };
    depth.max(0.0) / 0.5
}

/// Smallest distance between two centres in a periodic box.
fn nearest_distance(places: &[DVec3], size: DVec3) -> f64 {
    let mut nearest = f64::INFINITY;
    for (j, place) in places.iter().enumerate() {
        for other in &places[..j] {
            let offset = place - other;
            let offset = offset - size * (offset / size).round();
            nearest = nearest.min(offset.length_squared());
        }
    }
    nearest.sqrt()
}
