//! What an impact does to velocities, and what persistent contacts do to accelerations. One file
//! per law.

mod combine;
mod complementarity;
mod contact_force;
mod cue;
mod face;
mod friction;
mod generalized_reflection;
mod group;
mod kick;
mod least_change;
mod line_of_centres;
mod order_free;
mod plastic;
mod problem;
mod project;
mod reflection;
mod resolve;
mod sequential;
mod simultaneous;
mod touching;

pub(crate) use contact_force::contact_forces_within;
pub use contact_force::{ContactForces, contact_forces};
pub use cue::Strike;
pub(crate) use friction::{FrictionContact, SpinningSphere, apply_friction};
pub(crate) use generalized_reflection::levels;
pub(crate) use group::rounding_of;
pub(crate) use kick::kick;
pub(crate) use least_change::least_change;
pub use line_of_centres::line_of_centres;
pub(crate) use line_of_centres::reduced_mass;
pub(crate) use project::Projection;
pub use reflection::reflection;
pub use resolve::resolve;
pub(crate) use resolve::{projections, resolve_within};
pub use touching::{GroupResponse, TouchingContact};

use glam::DVec3;

use crate::bodies::Motion;
use crate::detect::Separation;
use crate::detect::contact::{Bodies, Contact};
use crate::friction::ContactFriction;
use crate::integrate;
use crate::material_pair::MaterialPair;
use crate::report::{BodyPair, Impact};
use crate::restitution::{BodyRestitution, ContactRestitution};
use crate::surface::{Form, SurfaceMotion};
use crate::system::System;

/// Answers contacts one after the other: each that still closes when its turn comes gets its
/// impulse. The impacts bear this `time` \[s\] since the start of the step. Lazy.
pub(crate) fn sequentially<'a>(
    contacts: impl Iterator<Item = &'a Contact>,
    system: &System,
    motion: &mut Motion,
    time: f64,
) -> impl Iterator<Item = Impact> {
    contacts.filter_map(move |contact| answer(contact, system, motion, time))
}

/// Answers one contact; `None`, and nothing changed, if the bodies are not closing.
pub(crate) fn answer(
    contact: &Contact,
    system: &System,
    motion: &mut Motion,
    time: f64,
) -> Option<Impact> {
    let restitution = restitution_of(contact.bodies, system);
    let kick = kick_at(contact, system, motion, time);
    answer_with(contact, (restitution, kick), system, motion, time)
}

/// Speed that the surface of a contact adds \[m/s\]; 0 between spheres.
fn kick_at(contact: &Contact, system: &System, motion: &Motion, time: f64) -> f64 {
    let Bodies::Surface { sphere, surface } = contact.bodies else { return 0.0 };
    let given = system.surfaces[surface as usize].kick;
    if given == 0.0 {
        return 0.0;
    }
    let index = sphere as usize;
    let state = (motion.position[index], motion.velocity[index]);
    let acceleration = integrate::acceleration_alone(system, index, state, time);
    kick(given, -acceleration.dot(contact.separation.normal), system.spheres.radius[index])
}

/// Answers one contact without giving back any of the speed of approach.
pub(crate) fn answer_plastically(
    contact: &Contact,
    system: &System,
    motion: &mut Motion,
    time: f64,
) -> Option<Impact> {
    answer_with(contact, (ContactRestitution::Constant(0.0), 0.0), system, motion, time)
}

/// Restitution of a contact, from its pair of materials or from those of its bodies.
pub(crate) fn restitution_of(bodies: Bodies, system: &System) -> ContactRestitution {
    let given = system.material_pair(bodies).and_then(MaterialPair::contact_restitution);
    given.unwrap_or_else(|| {
        ContactRestitution::of(body_restitutions(bodies, system), system.settings.combine_rule)
    })
}

/// Restitutions of the bodies of a contact.
pub(crate) fn body_restitutions(bodies: Bodies, system: &System) -> [BodyRestitution; 2] {
    let of_sphere = |sphere: u32| system.spheres.restitution(sphere as usize);
    match bodies {
        Bodies::Pair(first, second) => [first, second].map(of_sphere),
        Bodies::Surface { sphere, surface } => {
            [system.surfaces[surface as usize].restitution, of_sphere(sphere)]
        }
    }
}

/// Friction of a contact, from its pair of materials or from what its bodies say.
pub(crate) fn friction_of(bodies: Bodies, system: &System) -> ContactFriction {
    let sphere_friction = |sphere: u32| system.spheres.friction(sphere as usize);
    let both = match bodies {
        Bodies::Pair(first, second) => [sphere_friction(first), sphere_friction(second)],
        Bodies::Surface { sphere, surface } => {
            [system.surfaces[surface as usize].friction, sphere_friction(sphere)]
        }
    };
    let mut friction = ContactFriction::of(both, system.settings.friction_combine_rule);
    if let Bodies::Surface { surface, .. } = bodies {
        friction.cushion = system.surfaces[surface as usize].cushion;
    }
    if let Some(pair) = system.material_pair(bodies) {
        pair.apply_friction(&mut friction);
    }
    friction
}

/// Velocity \[m/s\] of the material of a surface that moves so, relative to its place, where it has this normal and
/// friction acts on the sphere; zero between spheres.
pub(crate) fn belt_of(
    bodies: Bodies,
    motion: &SurfaceMotion,
    normal: DVec3,
    system: &System,
) -> DVec3 {
    if motion.belt == DVec3::ZERO || friction_of(bodies, system).sliding == 0.0 {
        return DVec3::ZERO;
    }
    motion.belt_across(normal)
}

fn answer_with(
    contact: &Contact,
    (restitution, kick): (ContactRestitution, f64),
    system: &System,
    motion: &mut Motion,
    time: f64,
) -> Option<Impact> {
    let Separation { normal, point, .. } = contact.separation;
    let (velocity, mass) = (&mut motion.velocity, &system.spheres.mass);
    let (approach_speed, separation_speed, impulse) = match contact.bodies {
        Bodies::Pair(i, j) => {
            let (i, j) = (i as usize, j as usize);
            let approach_speed = -(velocity[j] - velocity[i]).dot(normal);
            let before = [velocity[i], velocity[j]];
            let restitution = restitution.at(approach_speed);
            let (after, impulse) =
                line_of_centres(before, [mass[i], mass[j]], normal, restitution)?;
            [velocity[i], velocity[j]] = after;
            (approach_speed, (velocity[j] - velocity[i]).dot(normal), impulse)
        }
        Bodies::Surface { sphere, surface } => {
            let i = sphere as usize;
            let of_surface = system.surfaces[surface as usize].motion.velocity_at(point);
            let relative = velocity[i] - of_surface;
            let restitution = restitution.at(-relative.dot(normal));
            let change = reflection(relative, normal, restitution)? + kick;
            velocity[i] += change * normal;
            let separation_speed = (velocity[i] - of_surface).dot(normal);
            (-relative.dot(normal), separation_speed, mass[i] * change)
        }
    };
    let between = BodyPair::of(contact.bodies, system);
    Some(Impact {
        time,
        between,
        point,
        normal,
        approach_speed,
        separation_speed,
        impulse,
        tangential_impulse: DVec3::ZERO,
        kick,
    })
}

/// Puts a sphere that hit a flat surface onto it, at `time` \[s\], in place of the normal force that would
/// keep it there; spheres at rounded surfaces and pairs of spheres are left where they are. Returns the
/// work of that \[J\]; `None` where the sphere was not moved.
pub(crate) fn put_on_surface(
    contact: &Contact,
    system: &System,
    motion: &mut Motion,
    time: f64,
) -> Option<f64> {
    let Bodies::Surface { sphere, surface } = contact.bodies else { return None };
    let form = &system.surfaces[surface as usize].form;
    if matches!(form, Form::Sphere { .. } | Form::Edge(_) | Form::Corner(_)) {
        return None;
    }
    let Separation { point, normal, .. } = contact.separation;
    let (index, radius) = (sphere as usize, system.spheres.radius[sphere as usize]);
    let before = system.potential_energy_alone(motion, index, time);
    motion.position[index] = point + radius * normal;
    Some(system.potential_energy_alone(motion, index, time) - before)
}
