//! Coefficients of contacts, and their derivatives by the coefficients of the bodies.

use crate::detect::contact::Bodies;
use crate::material_pair::MaterialPair;
use crate::respond;
use crate::restitution::{BodyRestitution, ContactRestitution};
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

/// The coefficient of restitution of a contact, and its derivatives.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RestitutionRates {
    pub combined: Combined,
    /// Derivative by the speed of approach \[s/m\].
    pub by_speed: f64,
}

/// Returns the coefficient of restitution of a contact at a speed of approach \[m/s\]. A body with a law, and a pair of
/// materials with a restitution of its own, have no coefficient to differentiate by.
pub(super) fn restitution_of(system: &System, bodies: Bodies, speed: f64) -> RestitutionRates {
    let pair = system.material_pair(bodies).and_then(MaterialPair::contact_restitution);
    let both = respond::body_restitutions(bodies, system);
    let rule = system.settings.combine_rule;
    let restitution = pair.unwrap_or_else(|| ContactRestitution::of(both, rule));
    let of_bodies = rule.derivatives([both[0].at(speed), both[1].at(speed)]);
    let by_body = |body: usize| match both[body] {
        BodyRestitution::Constant(_) if pair.is_none() => of_bodies[body],
        _ => 0.0,
    };
    let by_bodies = [by_body(0), by_body(1)];
    let combined = Combined { value: restitution.at(speed), by_bodies };
    RestitutionRates { combined, by_speed: restitution.slope(speed) }
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
    let pair = system.material_pair(bodies);
    let is_given = pair.is_some_and(|pair| pair.friction.sliding.is_some());
    let by_bodies = if is_given { [0.0; 2] } else { by_bodies };
    Combined { value: respond::friction_of(bodies, system).sliding, by_bodies }
}
