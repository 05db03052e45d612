//! The derivative of an impact.

use glam::DVec3;

use super::coefficients::{Combined, RestitutionRates};
use super::dual::{Dual, vector};
use super::law::{Coefficients, FirstBody, StruckSphere, collide};
use super::start::Flying;
use super::state::SphereTangent;
use super::supported::Rates;
use super::variation::Variation;
use crate::forces::LinearForce;
use crate::friction::ContactFriction;
use crate::id::{ColliderId, SphereId};
use crate::real::Vector;
use crate::rule::exact::NormalCurvature;
use crate::system::System;

/// Derivative of an impact: a saltation matrix (Aizerman and Gantmakher, Q. J. Mech. Appl. Math. 11, 243 (1958);
/// Müller, Chaos Solitons Fractals 5, 1671 (1995)). It includes the change of the time of the impact.
#[derive(Debug, Clone)]
pub(super) struct Saltation {
    pub first: First,
    pub second: Colliding,
    /// Unit vector from body 1 to body 2.
    pub normal: DVec3,
    pub restitution: RestitutionRates,
    pub sliding: Combined,
    pub friction: ContactFriction,
    /// Speed that the surface adds along the normal \[m/s\].
    pub kick: f64,
    /// Indices of other spheres whose accelerations depend on the velocities of these, and how much smaller their
    /// accelerations are after the impact \[m/s²\].
    pub companions: Vec<(usize, DVec3)>,
    /// Time since the start of the derivatives \[s\].
    pub time: f64,
}

/// A sphere at an impact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Colliding {
    /// Index in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    pub position: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
    pub radius: f64,
    pub mass: f64,
    pub inertia_factor: f64,
    /// Accelerations before the impact, and after it.
    pub before: Rates,
    pub after: Rates,
}

impl Colliding {
    /// The sphere at an index of the world's arrays, in this motion, with its accelerations before and after the impact.
    pub fn of(
        system: &System,
        (place, id): (usize, SphereId),
        body: &Flying,
        [before, after]: [Rates; 2],
    ) -> Self {
        Self {
            place,
            id,
            position: body.position,
            velocity: body.velocity,
            angular_velocity: body.angular_velocity,
            radius: system.spheres.radius[place],
            mass: system.spheres.mass[place],
            inertia_factor: system.spheres.inertia_factor(place),
            before,
            after,
        }
    }
}

/// Body 1 of an impact.
#[derive(Debug, Clone)]
pub(super) enum First {
    Sphere(Colliding),
    Surface(TouchedSurface),
}

/// A surface at the point where it is touched.
#[derive(Debug, Clone)]
pub(super) struct TouchedSurface {
    pub collider: ColliderId,
    /// Centre of its rotation \[m\].
    pub origin: DVec3,
    pub velocity: DVec3,
    pub angular_velocity: DVec3,
    /// Acceleration of that centre \[m/s²\], and angular acceleration \[rad/s²\].
    pub acceleration: DVec3,
    pub angular_acceleration: DVec3,
    /// Velocity of the material relative to the place of the surface \[m/s\].
    pub belt: DVec3,
    /// Position of the collider, if it is at rest \[m\].
    pub pivot: Option<DVec3>,
    pub curvature: NormalCurvature,
}

/// A small change of all inputs of an impact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Change {
    pub spheres: [SphereTangent; 2],
    pub radii: [f64; 2],
    pub masses: [f64; 2],
    pub restitution: f64,
    pub sliding: f64,
    pub surface_position: DVec3,
    pub surface_velocity: DVec3,
    pub surface_rotation: DVec3,
}

/// Two bodies after an impact.
struct Collided {
    /// Centres of the spheres; the centre of body 2 twice if body 1 is a surface.
    places: [Vector<Dual>; 2],
    first: FirstBody<Dual>,
    second: StruckSphere<Dual>,
    /// Delay of the impact \[s\].
    later: f64,
}

impl Colliding {
    /// Returns the motion, radius and mass of the sphere before the impact.
    fn struck(&self) -> StruckSphere<f64> {
        StruckSphere {
            velocity: self.velocity.into(),
            angular_velocity: self.angular_velocity.into(),
            radius: self.radius,
            mass: self.mass,
            inertia_factor: self.inertia_factor,
        }
    }

    /// Returns the centre, motion, radius and mass of a sphere at an impact that comes `later` \[s\].
    pub fn at_impact(
        &self,
        change: &SphereTangent,
        [radius, mass]: [f64; 2],
        later: f64,
    ) -> (Vector<Dual>, StruckSphere<Dual>) {
        let position = vector(self.position, change.position + later * self.velocity);
        let gained = change.velocity + later * self.before.acceleration(self.velocity);
        let turned = change.angular_velocity + later * self.before.angular_acceleration;
        let sphere = StruckSphere {
            velocity: vector(self.velocity, gained),
            angular_velocity: vector(self.angular_velocity, turned),
            radius: Dual::new(self.radius, radius),
            mass: Dual::new(self.mass, mass),
            inertia_factor: self.inertia_factor,
        };
        (position, sphere)
    }

    /// Returns the change of the motion after an impact that comes later by this \[s\], at the time of the
    /// undisturbed impact.
    fn after(&self, place: Vector<Dual>, sphere: &StruckSphere<Dual>, later: f64) -> SphereTangent {
        let velocity = sphere.velocity.value();
        SphereTangent {
            position: place.change() - later * velocity,
            velocity: sphere.velocity.change() - later * self.after.acceleration(velocity),
            angular_velocity: sphere.angular_velocity.change()
                - later * self.after.angular_acceleration,
        }
    }
}

impl TouchedSurface {
    /// Returns the velocity of the material at the contact of a sphere with a surface of this normal, if the impact comes
    /// later by this \[s\].
    fn velocity_of_material(
        &self,
        (arm, normal): (Vector<Dual>, Vector<Dual>),
        (faster, later): (DVec3, f64),
    ) -> Vector<Dual> {
        let velocity = vector(self.velocity, faster + later * self.acceleration);
        let spin = vector(self.angular_velocity, later * self.angular_acceleration);
        let belt = vector(self.belt, later * self.angular_velocity.cross(self.belt));
        velocity + spin.cross(arm) + belt - normal * belt.dot(normal)
    }

    /// Returns the velocity of the surface at a point \[m/s\].
    fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.origin)
    }

    /// Returns the displacement of a point of the surface if the collider turns by an angle \[rad\].
    fn turned(&self, rotation: DVec3, point: DVec3) -> DVec3 {
        self.pivot.map_or(DVec3::ZERO, |pivot| rotation.cross(point - pivot))
    }

    /// Returns the normal at the contact with a sphere whose centre has moved by this \[m\], if the surface is
    /// shifted \[m\], turned \[rad\], and the impact comes later by this \[s\].
    fn normal(
        &self,
        (normal, centre): (DVec3, DVec3),
        moved: DVec3,
        (shift, later): (DVec3, f64),
        rotation: DVec3,
    ) -> Vector<Dual> {
        let shift = shift + self.turned(rotation, centre);
        let along = moved - shift - later * self.velocity_at(centre);
        let across = along - along.dot(normal) * normal;
        let turned = (later * self.angular_velocity + rotation).cross(normal);
        vector(normal, self.curvature.rate(across) + turned)
    }
}

impl Saltation {
    /// Returns the spheres of the impact.
    pub fn spheres(&self) -> impl Iterator<Item = &Colliding> {
        let first = match &self.first {
            First::Sphere(sphere) => Some(sphere),
            First::Surface(_) => None,
        };
        first.into_iter().chain([&self.second])
    }

    /// Returns the ratio of the speed of approach to the relative speed: 0 if the impact grazes.
    pub fn directness(&self) -> f64 {
        let relative = self.relative_velocity();
        let speed = relative.length();
        if speed == 0.0 { 0.0 } else { -relative.dot(self.normal) / speed }
    }

    /// Returns the velocity of body 2 relative to body 1 at the contact, without the rotation of spheres \[m/s\].
    fn relative_velocity(&self) -> DVec3 {
        let first = match &self.first {
            First::Sphere(sphere) => sphere.velocity,
            First::Surface(surface) => surface.velocity_at(self.point()),
        };
        self.second.velocity - first
    }

    /// Returns the contact point on body 2 \[m\].
    fn point(&self) -> DVec3 {
        self.second.position - self.second.radius * self.normal
    }

    /// Returns velocities and angular velocities of bodies 1 and 2 after the impact; zero for a surface.
    pub fn outcome(&self) -> [[DVec3; 2]; 2] {
        let mut second = self.second.struck();
        let mut first = match &self.first {
            First::Sphere(sphere) => FirstBody::Sphere(sphere.struck()),
            First::Surface(surface) => {
                let belt = surface.belt - self.normal * surface.belt.dot(self.normal);
                FirstBody::Surface((surface.velocity_at(self.point()) + belt).into())
            }
        };
        let coefficients = Coefficients {
            restitution: self.restitution.combined.value,
            restitution_by_speed: self.restitution.by_speed,
            sliding: self.sliding.value,
            friction: self.friction,
            kick: self.kick,
        };
        collide(&mut first, &mut second, self.normal.into(), &coefficients);
        let motion = |it: &StruckSphere<f64>| [it.velocity.into(), it.angular_velocity.into()];
        let of_first = match &first {
            FirstBody::Sphere(sphere) => motion(sphere),
            FirstBody::Surface(_) => [DVec3::ZERO; 2],
        };
        [of_first, motion(&second)]
    }

    /// Sets the accelerations of spheres that fly on curves, by index, before the impact and after it \[m/s²\].
    pub fn set_curved(&mut self, before: &[(usize, DVec3)], after: &[(usize, DVec3)]) {
        let rates = |acceleration| Rates {
            linear: LinearForce { acceleration, drag_rate: 0.0 },
            angular_acceleration: DVec3::ZERO,
        };
        for (&(place, before), &(_, after)) in before.iter().zip(after) {
            let first = match &mut self.first {
                First::Sphere(first) => Some(first),
                First::Surface(_) => None,
            };
            let mut struck = first.into_iter().chain([&mut self.second]);
            match struck.find(|it| it.place == place) {
                Some(sphere) => (sphere.before, sphere.after) = (rates(before), rates(after)),
                None if before != after => self.companions.push((place, before - after)),
                None => {}
            }
        }
    }

    /// Applies the derivative of the impact to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let second = self.second.place;
        let mut change = self.change_of(direction);
        change.spheres[1] = spheres[second];
        if let First::Sphere(first) = &self.first {
            change.spheres[0] = spheres[first.place];
        }
        if !self.companions.is_empty() {
            let later = self.delay(&change);
            for &(place, lost) in &self.companions {
                spheres[place].velocity += later * lost;
            }
        }
        let [first, last] = self.apply(&change);
        spheres[second] = last;
        if let First::Sphere(sphere) = &self.first {
            spheres[sphere.place] = first;
        }
    }

    /// Returns the change of the other inputs of the impact in a direction.
    fn change_of(&self, direction: &Variation) -> Change {
        let second = direction.sphere(self.second.id);
        let mut change = Change::default();
        let (restitution, friction) = match &self.first {
            First::Sphere(first) => {
                let first = direction.sphere(first.id);
                (change.radii[0], change.masses[0]) = (first.radius, first.mass);
                (first.restitution, first.friction)
            }
            First::Surface(surface) => {
                let surface = direction.collider(surface.collider);
                change.surface_position = surface.position + self.time * surface.velocity;
                change.surface_velocity = surface.velocity;
                change.surface_rotation = surface.rotation;
                (surface.restitution, surface.friction)
            }
        };
        (change.radii[1], change.masses[1]) = (second.radius, second.mass);
        change.restitution = self.restitution.combined.change([restitution, second.restitution]);
        change.sliding = self.sliding.change([friction, second.friction]);
        change
    }

    /// Returns the change of the motion after the impact.
    pub fn apply(&self, change: &Change) -> [SphereTangent; 2] {
        let Collided { places, first, second, later } = self.collided(change);
        let of_first = match (&self.first, &first) {
            (First::Sphere(before), FirstBody::Sphere(after)) => {
                before.after(places[0], after, later)
            }
            _ => SphereTangent::default(),
        };
        [of_first, self.second.after(places[1], &second, later)]
    }

    /// Returns the delay of the impact \[s\].
    pub fn delay(&self, change: &Change) -> f64 {
        let [first, second] = change.spheres;
        let opened = match &self.first {
            First::Sphere(_) => {
                (second.position - first.position).dot(self.normal) - change.radii[0]
            }
            First::Surface(surface) => {
                let turned = surface.turned(change.surface_rotation, self.point());
                (second.position - change.surface_position - turned).dot(self.normal)
            }
        };
        let closing = self.relative_velocity().dot(self.normal);
        -(opened - change.radii[1]) / closing
    }

    /// Returns the bodies after the impact.
    fn collided(&self, change: &Change) -> Collided {
        let later = self.delay(change);
        let [of_first, of_second] = &change.spheres;
        let of_body = |body: usize| [change.radii[body], change.masses[body]];
        let (place, mut second) = self.second.at_impact(of_second, of_body(1), later);
        let (first_place, mut first, normal) = match &self.first {
            First::Sphere(sphere) => {
                let (first_place, first) = sphere.at_impact(of_first, of_body(0), later);
                let normal = (place - first_place).direction();
                (first_place, FirstBody::Sphere(first), normal)
            }
            First::Surface(surface) => {
                let shift = (change.surface_position, later);
                let at = (self.normal, self.second.position);
                let rotation = change.surface_rotation;
                let normal = surface.normal(at, place.change(), shift, rotation);
                let origin_moved = change.surface_position + later * surface.velocity;
                let arm = place - normal * second.radius - vector(surface.origin, origin_moved);
                let faster = (change.surface_velocity, later);
                let velocity = surface.velocity_of_material((arm, normal), faster);
                (place, FirstBody::Surface(velocity), normal)
            }
        };
        let coefficients = Coefficients {
            restitution: Dual::new(self.restitution.combined.value, change.restitution),
            restitution_by_speed: self.restitution.by_speed,
            sliding: Dual::new(self.sliding.value, change.sliding),
            friction: self.friction,
            kick: self.kick,
        };
        collide(&mut first, &mut second, normal, &coefficients);
        Collided { places: [first_place, place], first, second, later }
    }
}
