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
use incidence::Origin;

use glam::DVec3;

use super::batch::Impulses;
use super::slots::Slots;
use super::solver::Solver;
use super::sub_step::SubStep;
use super::swept::FREE;
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
    velocity: DVec3,
    /// r w \[m/s\]
    spin: DVec3,
    /// Whether contacts bear it in the end.
    pub bears: bool,
    /// Whether it has met a surface.
    pub met_surface: bool,
}

/// What cascades came to in a sub-step.
#[derive(Debug, Clone, Default)]
pub(super) struct Landings {
    /// The spheres that they took through it, by slot.
    pub spheres: Vec<Landed>,
    /// What their contacts begin the next sub-step with.
    contacts: Vec<(Origin, Impulses)>,
}

impl Landings {
    /// Whether the sphere in a slot is among them.
    pub fn has(&self, slot: usize) -> bool {
        let place = |it: &Landed| it.slot as usize;
        !self.spheres.is_empty() && self.spheres.binary_search_by_key(&slot, place).is_ok()
    }
}

/// Follows the cascades about the spheres in these slots. Until they [`land`], their spheres move as if nothing
/// touched them.
pub(super) fn follow(
    system: &System,
    solver: &mut Solver,
    seeds: &[usize],
    sub_step: &SubStep,
    report: &mut StepReport,
) {
    solver.landings.spheres.clear();
    solver.landings.contacts.clear();
    if seeds.is_empty() || solver.has_moving_surfaces || solver.has_other_forces {
        return;
    }
    solver.incidence.renew(&solver.slabs, solver.slots.len());
    let mut gathering = Gathering::among(solver.slots.len());
    for &seed in seeds {
        let Some(mut island) = gathering.gather(solver, seed, sub_step) else { continue };
        let course = Course::run(&mut island, &solver.places, sub_step);
        report.energy_account.contacts += course.work;
        let impacts = course.impacts.iter().map(|it| it.report(system, &solver.slots, sub_step));
        report.impacts.extend(impacts);
        withdraw(solver, &island, course.last, sub_step);
    }
    solver.landings.spheres.sort_unstable_by_key(|landed| landed.slot);
}

/// Takes an island, whose last flight took so long \[s\], out of what the sweeps work on.
fn withdraw(solver: &mut Solver, island: &Island, last: f64, sub_step: &SubStep) {
    let Solver { slots, slabs, landings, .. } = solver;
    for body in island.bodies.iter().filter(|body| body.inverse_mass > 0.0) {
        let slot = body.slot as usize;
        let free = slots.accelerated(slot, sub_step.h);
        slots.velocity[slot] = slots.velocity[slot].with_vector(free);
        if let Some(spin) = slots.spin.get_mut(slot) {
            *spin = slots.spin_before[slot];
        }
        let Body { slot, position, velocity, spin, bears, met_surface, .. } = *body;
        landings.spheres.push(Landed { slot, position, velocity, spin, bears, met_surface });
    }
    for link in &island.links {
        landings.contacts.push((link.origin, link.kept(island, last, sub_step)));
        link.origin.set(slabs, Impulses::default(), FREE);
    }
}

/// Gives the spheres of cascades their last velocities, and their contacts what they begin the next sub-step with.
pub(super) fn land(solver: &mut Solver) {
    let Solver { slots, slabs, landings, .. } = solver;
    for landed in &landings.spheres {
        let slot = landed.slot as usize;
        slots.velocity[slot] = slots.velocity[slot].with_vector(landed.velocity);
        if let Some(spin) = slots.spin.get_mut(slot) {
            *spin = spin.with_vector(landed.spin);
        }
    }
    for &(origin, kept) in &landings.contacts {
        origin.set(slabs, kept, 0.0);
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
