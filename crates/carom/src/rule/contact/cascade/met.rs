//! Impacts of cascades.

use glam::DVec3;

use crate::report::{BodyPair, Impact};
use crate::rule::contact::solver::Solver;
use crate::rule::contact::sub_step::SubStep;
use crate::system::System;

/// An impact of a cascade.
#[derive(Debug, Clone, Copy)]
pub struct Met {
    /// The slots of the spheres; of one only, and the number of the surface that it met.
    pub bodies: Partners,
    /// Between them, as seen from the first or the surface.
    pub impact: Contact,
}

/// The bodies of an impact.
#[derive(Debug, Clone, Copy)]
pub enum Partners {
    Spheres([u32; 2]),
    Surface(u32, u32),
}

/// The geometry and impulses of an impact.
#[derive(Debug, Clone, Copy)]
pub struct Contact {
    pub point: DVec3,
    pub normal: DVec3,
    pub approach_speed: f64,
    pub separation_speed: f64,
    pub impulse: f64,
    pub tangential_impulse: DVec3,
}

impl Met {
    /// The impact for the report.
    pub fn report(&self, system: &System, solver: &Solver, sub_step: &SubStep) -> Impact {
        let slots = &solver.slots;
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
                    // Subtracted from zero, so that zero does not become -0.
                    tangential_impulse = DVec3::ZERO - tangential_impulse;
                    BodyPair::Spheres(second, first)
                }
            }
            Partners::Surface(surface, slot) => {
                let own = solver.places.surface_of(surface);
                let collider = system.surfaces[own as usize].collider;
                BodyPair::Collider { collider, sphere: slots.id[slot as usize] }
            }
        };
        Impact {
            time: sub_step.time,
            between,
            point: slots.wrapped_place(point),
            normal,
            approach_speed,
            separation_speed,
            impulse,
            tangential_impulse,
            kick: 0.0,
        }
    }
}
