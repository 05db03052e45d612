//! A step once more, from its report: the flights and impacts that it was made of.

use std::sync::Arc;

use glam::DVec3;

use super::error::DerivativeError;
use super::saltation::{Colliding, Combined, First, Saltation, TouchedSurface};
use crate::colliders::Colliders;
use crate::detect::contact::Bodies;
use crate::detect::instant::Instant;
use crate::detect::sphere_surface;
use crate::flight::{Flight, Propagator};
use crate::forces::{self, LinearForce};
use crate::id::{ColliderId, SphereId};
use crate::report::{BodyPair, Impact, StepReport};
use crate::respond;
use crate::rule::exact::curvature_of;
use crate::rule::periodic;
use crate::settings::Rule;
use crate::surface::Role;
use crate::system::System;
use crate::world::World;

/// Where a sphere is found again, it may be off by this part of its size and of its way: rounding, but no motion
/// that is not that of a flight.
const ROUNDING: f64 = 1e-9;
/// Unit normals of one contact that were found in two ways may differ by this.
const SAME_NORMAL: f64 = 1e-6;

/// A linear map of small changes of the motion of spheres.
#[derive(Debug, Clone)]
pub(super) enum Piece {
    /// A flight of the sphere at this place in the arrays of the world, for a time \[s\] at a rate of drag
    /// \[1/s\].
    Flight {
        place: usize,
        time: f64,
        drag_rate: f64,
    },
    Impact(Box<Saltation>),
}

/// A world before a step.
pub(super) struct Start {
    pub ids: Vec<SphereId>,
    bodies: Vec<Flying>,
    colliders: Arc<Colliders>,
    /// On the world's clock \[s\].
    time: f64,
}

/// A sphere in flight.
#[derive(Debug, Clone, Copy)]
struct Flying {
    position: DVec3,
    velocity: DVec3,
    angular_velocity: DVec3,
    linear: LinearForce,
    /// Since the start of the step \[s\].
    since: f64,
    /// How far it may be off \[m\].
    tolerance: f64,
}

impl Start {
    /// Of the world as it is.
    ///
    /// # Errors
    /// What the world has that is not known.
    pub fn of(world: &World) -> Result<Self, DerivativeError> {
        check(world)?;
        let Instant { system, motion, time } = world.now();
        let flying = |place: usize| Flying {
            position: motion.position[place],
            velocity: motion.velocity[place],
            angular_velocity: motion.spin.angular_velocity.get(place).copied().unwrap_or_default(),
            linear: linear_on(&system, place),
            since: 0.0,
            tolerance: ROUNDING * (system.spheres.radius[place] + motion.position[place].length()),
        };
        let bodies = (0..motion.position.len()).map(flying).collect();
        Ok(Self {
            ids: system.spheres.id.clone(),
            bodies,
            colliders: world.shared_colliders(),
            time,
        })
    }

    /// The pieces of the step that the world has taken since, in order. `elapsed` is the time since derivatives are
    /// followed \[s\].
    ///
    /// # Errors
    /// What in the step has no derivative.
    pub fn pieces(mut self, world: &World, elapsed: f64) -> Result<Vec<Piece>, DerivativeError> {
        let report = world.report();
        let Instant { system, motion, time: end } = world.now();
        self.check(report, &system, end)?;
        let mut pieces = Vec::new();
        for group in &report.groups {
            let impact = &report.impacts[group.first];
            if group.count > 1 {
                let time = self.time + impact.time;
                return Err(DerivativeError::Simultaneous { sphere: second_of(impact), time });
            }
            let places = self.places(impact);
            for &place in places.iter().flatten() {
                pieces.push(self.fly(place, impact.time));
            }
            let saltation = self.saltation(&system, impact, places, elapsed);
            let Some(saltation) = saltation else {
                return Err(self.persistent(second_of(impact), end));
            };
            self.leave(&saltation);
            pieces.push(Piece::Impact(Box::new(saltation)));
        }
        for place in 0..self.bodies.len() {
            pieces.push(self.fly(place, end - self.time));
            let body = &self.bodies[place];
            let period = system.settings.boundary.period();
            let off = periodic::wrapped(motion.position[place] - body.position, period);
            if off.length() > body.tolerance {
                return Err(self.persistent(self.ids[place], end));
            }
        }
        Ok(pieces)
    }

    fn check(&self, report: &StepReport, system: &System, end: f64) -> Result<(), DerivativeError> {
        if self.ids != system.spheres.id {
            return Err(DerivativeError::Changed);
        }
        if report.zone_account.joined > 0 || report.zone_account.spheres > 0 {
            let sphere = self.ids.first().copied();
            return sphere.map_or(Ok(()), |sphere| Err(self.persistent(sphere, end)));
        }
        Ok(())
    }

    fn persistent(&self, sphere: SphereId, end: f64) -> DerivativeError {
        DerivativeError::PersistentContact { sphere, from: self.time, to: end }
    }

    /// The places of the spheres of an impact in the arrays of the world.
    fn places(&self, impact: &Impact) -> [Option<usize>; 2] {
        let place = |id: SphereId| self.ids.binary_search(&id).ok();
        match impact.between {
            BodyPair::Spheres(first, second) => [place(first), place(second)],
            BodyPair::Collider { sphere, .. } => [None, place(sphere)],
        }
    }

    /// Takes a sphere on to a time since the start of the step \[s\].
    fn fly(&mut self, place: usize, time: f64) -> Piece {
        let body = &mut self.bodies[place];
        let Flying { position, velocity, linear, since, .. } = *body;
        let LinearForce { acceleration, drag_rate } = linear;
        let over = time - since;
        let flight = Flight { position, velocity, acceleration, drag_rate };
        (body.position, body.velocity) = flight.after(over);
        body.since = time;
        body.tolerance += ROUNDING * (body.position - position).length();
        Piece::Flight { place, time: over, drag_rate }
    }

    /// The derivative of an impact; none if the spheres are not where it is.
    fn saltation(
        &mut self,
        system: &System,
        impact: &Impact,
        places: [Option<usize>; 2],
        elapsed: f64,
    ) -> Option<Saltation> {
        let period = system.settings.boundary.period();
        let Impact { point, normal, .. } = *impact;
        let mut colliding = |place: usize, side: f64| {
            let touching = point + side * system.spheres.radius[place] * normal;
            let body = &mut self.bodies[place];
            let off = periodic::wrapped(touching - body.position, period);
            let is_there = off.length() <= body.tolerance;
            // As the step has it: no rounding is carried on.
            body.position += off;
            is_there.then(|| Colliding {
                position: touching,
                ..of_sphere(system, place, self.ids[place], body)
            })
        };
        let second_place = places[1]?;
        let second = colliding(second_place, 1.0)?;
        let (first, bodies) = match (impact.between, places[0]) {
            (BodyPair::Collider { collider, .. }, _) => {
                let touched = self.touched((collider, impact), &second)?;
                let (surface, touched) = touched;
                let sphere = second_place as u32;
                (First::Surface(touched), Bodies::Surface { sphere, surface })
            }
            (_, Some(place)) => {
                let bodies = Bodies::pair([place as u32, second_place as u32]);
                (First::Sphere(colliding(place, -1.0)?), bodies)
            }
            (_, None) => return None,
        };
        let [restitution, sliding] = coefficients(system, bodies);
        let tangential_restitution = respond::friction_of(bodies, system).tangential_restitution;
        Some(Saltation {
            first,
            second,
            normal,
            restitution,
            sliding,
            tangential_restitution,
            kick: impact.kick,
            time: elapsed + impact.time,
        })
    }

    /// The surface of a collider that a sphere touches in an impact.
    fn touched(
        &self,
        (collider, impact): (ColliderId, &Impact),
        sphere: &Colliding,
    ) -> Option<(u32, TouchedSurface)> {
        let deflecting = self.colliders.surfaces().iter().enumerate();
        let candidates = deflecting
            .filter(|(_, it)| it.collider == collider && it.role == Role::Deflects)
            .filter_map(|(number, surface)| {
                let (form, motion) = surface.after(impact.time);
                let separation = sphere_surface(&form, sphere.position, sphere.radius)?;
                let off = (separation.normal - impact.normal).length();
                Some((off, number, form, motion, separation))
            });
        let nearest = candidates
            .filter(|it| it.0 <= SAME_NORMAL && it.4.distance.abs() <= SAME_NORMAL * sphere.radius)
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let (_, number, form, motion, separation) = nearest?;
        let beside = sphere.velocity - motion.velocity_at(separation.point);
        let curvature = curvature_of(&form, [sphere.position, beside], &separation);
        let touched = TouchedSurface {
            collider,
            origin: motion.origin,
            velocity: motion.velocity,
            angular_velocity: motion.angular_velocity,
            curvature,
        };
        Some((number as u32, touched))
    }

    /// Has the spheres of an impact go on with the motion after it.
    fn leave(&mut self, saltation: &Saltation) {
        let outcome = saltation.outcome();
        let mut set = |place: usize, [velocity, angular_velocity]: [DVec3; 2]| {
            (self.bodies[place].velocity, self.bodies[place].angular_velocity) =
                (velocity, angular_velocity);
        };
        set(saltation.second.place, outcome[1]);
        if let First::Sphere(first) = &saltation.first {
            set(first.place, outcome[0]);
        }
    }
}

impl Piece {
    /// The propagator of a flight.
    pub fn propagator(time: f64, drag_rate: f64) -> Propagator {
        Propagator::over(time, drag_rate)
    }
}

fn of_sphere(system: &System, place: usize, id: SphereId, body: &Flying) -> Colliding {
    Colliding {
        place,
        id,
        position: body.position,
        velocity: body.velocity,
        angular_velocity: body.angular_velocity,
        radius: system.spheres.radius[place],
        mass: system.spheres.mass[place],
        inertia_factor: system.spheres.inertia_factor(place),
        linear: body.linear,
    }
}

/// The forces on a sphere.
fn linear_on(system: &System, place: usize) -> LinearForce {
    let (radius, mass) = (system.spheres.radius[place], system.spheres.mass[place]);
    let (mut linear, _) = forces::total_linear(system.forces, radius, mass);
    linear.acceleration += system.spheres.applied_acceleration(place).unwrap_or_default();
    linear
}

/// Coefficients of restitution and of sliding friction of a contact.
fn coefficients(system: &System, bodies: Bodies) -> [Combined; 2] {
    let restitution = system.spheres.restitution.as_slice();
    let (of_first, friction_of_first, second) = match bodies {
        Bodies::Pair(first, second) => {
            (restitution[first as usize], system.spheres.friction(first as usize), second)
        }
        Bodies::Surface { sphere, surface } => {
            let surface = &system.surfaces[surface as usize];
            (surface.restitution, surface.friction, sphere)
        }
    };
    let rule = system.settings.combine_rule;
    let both = [of_first, restitution[second as usize]];
    let by_bodies = rule.derivatives(both);
    let of_restitution = Combined { value: rule.combine(both[0], both[1]), by_bodies };
    let value = respond::friction_of(bodies, system).sliding;
    let friction = [friction_of_first, system.spheres.friction(second as usize)];
    let by_bodies = match friction.map(|it| it.sliding) {
        [Some(first), Some(second)] => {
            system.settings.friction_combine_rule.derivatives([first, second])
        }
        [first, second] => [first, second].map(|it| f64::from(u8::from(it.is_some()))),
    };
    [of_restitution, Combined { value, by_bodies }]
}

fn second_of(impact: &Impact) -> SphereId {
    match impact.between {
        BodyPair::Spheres(_, second) | BodyPair::Collider { sphere: second, .. } => second,
    }
}

/// Refuses a world that has something whose derivatives are not known.
fn check(world: &World) -> Result<(), DerivativeError> {
    let Instant { system, .. } = world.now();
    let refuse = |what| Err(DerivativeError::Unsupported(what));
    if !matches!(system.settings.rule, Rule::Exact(_)) {
        return refuse("a rule other than `exact`");
    }
    if system.has_interactions() {
        return refuse("forces between spheres");
    }
    if !forces::are_linear(system.forces) {
        return refuse("forces that depend on places, or not linearly on velocities");
    }
    if world.emitters().len() > 0 {
        return refuse("emitters");
    }
    if world.colliders().any(|(_, collider)| !collider.motion.is_empty()) {
        return refuse("colliders that do not move steadily");
    }
    if system.spheres.growth_speed.iter().any(|&speed| speed > 0.0) {
        return refuse("spheres that grow");
    }
    Ok(())
}
