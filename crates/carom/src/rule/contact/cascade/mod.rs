//! Cascades: where a sphere strikes what touches something else, or comes to a second body after its first
//! impact, a small island of spheres goes through the sub-step anew, from impact to impact in order of time.
//!
//! The sweeps answer all impacts of a sub-step together, as if they came at one time, and take what a few of
//! them leave for solved. In a heap that is good enough, for much is lost there anyway. Elastic bounces
//! would lose or gain by it, and impacts that follow each other would be mixed.

mod course;
mod incidence;
mod island;
mod link;

pub(super) use incidence::Incidence;

use glam::DVec3;

use super::slots::Slots;
use super::solver::Solver;
use super::sub_step::SubStep;
use crate::report::{BodyPair, Impact, StepReport};
use crate::system::System;
use course::Course;
use island::{Body, Gathering, Island};

/// Where a cascade takes a sphere.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landed {
    pub slot: u32,
    /// Centre at the end of the sub-step \[m\].
    pub position: DVec3,
    /// Whether contacts bear it in the end.
    pub bears: bool,
    /// Whether it has met a surface.
    pub met_surface: bool,
}

/// Follows the cascades about the spheres in these slots.
pub(super) fn follow(
    system: &System,
    solver: &mut Solver,
    seeds: &[usize],
    sub_step: &SubStep,
    report: &mut StepReport,
) {
    solver.landed.clear();
    if seeds.is_empty() || solver.has_moving_surfaces || solver.has_other_forces {
        return;
    }
    solver.incidence.renew(&solver.slabs, solver.slots.len());
    let mut gathering = Gathering::among(solver.slots.len());
    for &seed in seeds {
        let Some(mut island) = gathering.gather(solver, seed, sub_step) else { continue };
        let course = Course::run(&mut island, &solver.places, sub_step);
        let given = island.bodies.iter().map(|body| work_of_sweeps(&solver.slots, body, sub_step));
        report.energy_account.contacts += course.work - given.sum::<f64>();
        let impacts = course.impacts.iter().map(|it| it.report(system, &solver.slots, sub_step));
        report.impacts.extend(impacts);
        land(solver, &island, course.last, sub_step);
    }
    solver.landed.sort_unstable_by_key(|landed| landed.slot);
}

/// Work \[J\] of the impulses that the sweeps gave a sphere, as it was accounted for.
fn work_of_sweeps(slots: &Slots, body: &Body, sub_step: &SubStep) -> f64 {
    if body.inverse_mass == 0.0 {
        return 0.0;
    }
    let slot = body.slot as usize;
    let [now, before] = [slots.velocity[slot], slots.before[slot]].map(|row| row.vector());
    let change = now - slots.accelerated(slot, sub_step.h);
    let mut twice = change.dot(now + before) / body.inverse_mass;
    if let (Some(now), Some(before)) = (slots.spin.get(slot), slots.spin_before.get(slot)) {
        let [now, before] = [now, before].map(|row| row.vector());
        twice += (now - before).dot(now + before) / body.inverse_inertia;
    }
    0.5 * twice
}

/// Gives the solver what came out of a cascade whose last flight took so long \[s\].
fn land(solver: &mut Solver, island: &Island, last: f64, sub_step: &SubStep) {
    let Solver { slots, slabs, landed, .. } = solver;
    for body in island.bodies.iter().filter(|body| body.inverse_mass > 0.0) {
        let slot = body.slot as usize;
        slots.velocity[slot] = slots.velocity[slot].with_vector(body.velocity);
        if let Some(spin) = slots.spin.get_mut(slot) {
            *spin = spin.with_vector(body.spin);
        }
        let Body { slot, position, bears, met_surface, .. } = *body;
        landed.push(Landed { slot, position, bears, met_surface });
    }
    for link in &island.links {
        let kept = link.kept(island, last, sub_step);
        link.origin.keep(slabs, kept);
    }
}

/// An impact of a cascade.
#[derive(Debug, Clone, Copy)]
struct Met {
    /// The slots of the spheres; of one only, and the number of the surface that it met.
    bodies: Partners,
    /// Between them, as seen from the first or the surface.
    impact: Contact,
}

/// Who meets.
#[derive(Debug, Clone, Copy)]
enum Partners {
    Spheres([u32; 2]),
    Surface(u32, u32),
}

/// What happens in an impact.
#[derive(Debug, Clone, Copy)]
struct Contact {
    point: DVec3,
    normal: DVec3,
    approach_speed: f64,
    separation_speed: f64,
    impulse: f64,
    tangential_impulse: DVec3,
}

impl Met {
    fn report(&self, system: &System, slots: &Slots, sub_step: &SubStep) -> Impact {
        let Contact {
            point,
            mut normal,
            approach_speed,
            separation_speed,
            impulse,
            mut tangential_impulse,
        } = self.impact;
        let between = match self.bodies {
            Partners::Spheres(both) => {
                let [first, second] = both.map(|slot| slots.id[slot as usize]);
                if first < second {
                    BodyPair::Spheres(first, second)
                } else {
                    normal = -normal;
                    // From zero, for it not to become -0.
                    tangential_impulse = DVec3::ZERO - tangential_impulse;
                    BodyPair::Spheres(second, first)
                }
            }
            Partners::Surface(surface, slot) => {
                let collider = system.surfaces[surface as usize].collider;
                BodyPair::Collider { collider, sphere: slots.id[slot as usize] }
            }
        };
        Impact {
            time: sub_step.time,
            between,
            point,
            normal,
            approach_speed,
            separation_speed,
            impulse,
            tangential_impulse,
        }
    }
}
