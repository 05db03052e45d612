//! Coefficients of contacts, and their derivatives by the coefficients of the bodies.

use crate::detect::contact::Bodies;
use crate::respond;
use crate::system::System;

/// A coefficient of a contact, and its derivatives by those of the two bodies.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Combined {
    pub value: f64,
    pub by_bodies: [f64; 2],
}

impl Combined {
    /// Returns the change of the coefficient, given the changes of the coefficients of the two bodies.
    pub fn change(&self, bodies: [f64; 2]) -> f64 {
        self.by_bodies[0] * bodies[0] + self.by_bodies[1] * bodies[1]
    }
}

/// Returns the coefficient of restitution of a contact.
pub(super) fn restitution_of(system: &System, bodies: Bodies) -> Combined {
    let sphere_restitution = |sphere: u32| system.spheres.restitution[sphere as usize];
    let both = match bodies {
        Bodies::Pair(first, second) => [first, second].map(sphere_restitution),
        Bodies::Surface { sphere, surface } => {
            [system.surfaces[surface as usize].restitution, sphere_restitution(sphere)]
        }
    };
    let rule = system.settings.combine_rule;
    Combined { value: rule.combine(both[0], both[1]), by_bodies: rule.derivatives(both) }
}

/// Returns the coefficient of sliding friction of a contact.
pub(super) fn sliding_of(system: &System, bodies: Bodies) -> Combined {
    let sphere_friction = |sphere: u32| system.spheres.friction(sphere as usize);
    let both = match bodies {
        Bodies::Pair(first, second) => [first, second].map(sphere_friction),
        Bodies::Surface { sphere, surface } => {
            [system.surfaces[surface as usize].friction, sphere_friction(sphere)]
        }
    };
    let by_bodies = match both.map(|it| it.sliding) {
        [Some(first), Some(second)] => {
            system.settings.friction_combine_rule.derivatives([first, second])
        }
        [first, second] => [first, second].map(|it| f64::from(u8::from(it.is_some()))),
    };
    Combined { value: respond::friction_of(bodies, system).sliding, by_bodies }
}
