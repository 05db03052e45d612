//! The derivative of an impact.

use glam::DVec3;

use super::coefficients::{Combined, RestitutionRates};
use super::dual::{Dual, vector};
use super::law::{Coefficients, FirstBody, StruckSphere, collide};
use super::state::{NUMBERS, SphereTangent};
use super::supported::Rates;
use super::variation::Variation;
use crate::id::{ColliderId, SphereId};
use crate::real::Vector;
use crate::rule::exact::NormalCurvature;

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
    pub tangential_restitution: f64,
    /// Speed that the surface adds along the normal \[m/s\].
    pub kick: f64,
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
    pub curvature: NormalCurvature,
}

/// A small change of all inputs of an impact.
#[derive(Debug, Clone, Copy, Default)]
struct Change {
    spheres: [SphereTangent; 2],
    radii: [f64; 2],
    masses: [f64; 2],
    restitution: f64,
    sliding: f64,
    surface_position: DVec3,
    surface_velocity: DVec3,
}

/// Two bodies after an impact.
struct Collided {
    /// Centres of the spheres; the centre of body 2 twice if body 1 is a surface.
    places: [Vector<Dual>; 2],
    first: FirstBody,
    second: StruckSphere,
    /// Delay of the impact \[s\].
    later: f64,
}

impl Colliding {
    /// Returns the centre, motion, radius and mass of a sphere at an impact that comes `later` \[s\].
    fn at_impact(
        &self,
        change: &SphereTangent,
        [radius, mass]: [f64; 2],
        later: f64,
    ) -> (Vector<Dual>, StruckSphere) {
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
    fn after(&self, place: Vector<Dual>, sphere: &StruckSphere, later: f64) -> SphereTangent {
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
    /// Returns the velocity of the surface at a point \[m/s\].
    fn velocity_at(&self, point: DVec3) -> DVec3 {
        self.velocity + self.angular_velocity.cross(point - self.origin)
    }

    /// Returns the normal at the contact with a sphere whose centre has moved by this \[m\], if the surface is
    /// shifted \[m\] and the impact comes later by this \[s\].
    fn normal(
        &self,
        (normal, point): (DVec3, DVec3),
        moved: DVec3,
        (shift, later): (DVec3, f64),
    ) -> Vector<Dual> {
        let along = moved - shift - later * self.velocity_at(point);
        let across = along - along.dot(normal) * normal;
        let turned = later * self.angular_velocity.cross(normal);
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
        let Collided { first, second, .. } = self.collided(&Change::default());
        let motion = |it: &StruckSphere| [it.velocity.value(), it.angular_velocity.value()];
        let of_first = match &first {
            FirstBody::Sphere(sphere) => motion(sphere),
            FirstBody::Surface(_) => [DVec3::ZERO; 2],
        };
        [of_first, motion(&second)]
    }

    /// Applies the derivative of the impact to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let second = self.second.place;
        let mut change = self.change_of(direction);
        change.spheres[1] = spheres[second];
        if let First::Sphere(first) = &self.first {
            change.spheres[0] = spheres[first.place];
        }
        let [first, last] = self.apply(&change);
        spheres[second] = last;
        if let First::Sphere(sphere) = &self.first {
            spheres[sphere.place] = first;
        }
    }

    /// Replaces derivatives with respect to the motion after the impact by derivatives with respect to the motion
    /// before, and adds those with respect to the other inputs of the impact to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let second = self.second.place;
        let mut after = [SphereTangent::default(), spheres[second]];
        let count = match &self.first {
            First::Sphere(first) => {
                after[0] = spheres[first.place];
                2
            }
            First::Surface(_) => 1,
        };
        let by = |change: &Change| {
            let [first, last] = self.apply(change);
            first.dot(&after[0]) + last.dot(&after[1])
        };
        let mut before = [SphereTangent::default(); 2];
        for (body, tangent) in before.iter_mut().enumerate().skip(2 - count) {
            for number in 0..NUMBERS {
                let mut change = Change::default();
                change.spheres[body] = SphereTangent::unit(number);
                *tangent.number_mut(number) = by(&change);
            }
        }
        self.add_to_gradient(by, gradient);
        spheres[second] = before[1];
        if let First::Sphere(first) = &self.first {
            spheres[first.place] = before[0];
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
                (surface.restitution, surface.friction)
            }
        };
        (change.radii[1], change.masses[1]) = (second.radius, second.mass);
        change.restitution = self.restitution.combined.change([restitution, second.restitution]);
        change.sliding = self.sliding.change([friction, second.friction]);
        change
    }

    /// Adds the derivatives with respect to the inputs of [`Self::change_of`] to a gradient.
    fn add_to_gradient(&self, by: impl Fn(&Change) -> f64, gradient: &mut Variation) {
        let restitution = by(&Change { restitution: 1.0, ..Change::default() });
        let sliding = by(&Change { sliding: 1.0, ..Change::default() });
        let of_body = |body: usize| {
            let mut units = [0.0; 2];
            units[body] = 1.0;
            let radius = by(&Change { radii: units, ..Change::default() });
            [radius, by(&Change { masses: units, ..Change::default() })]
        };
        let mut add_sphere = |id, body: usize| {
            let [radius, mass] = of_body(body);
            let sphere = gradient.sphere_mut(id);
            sphere.radius += radius;
            sphere.mass += mass;
            sphere.restitution += self.restitution.combined.by_bodies[body] * restitution;
            sphere.friction += self.sliding.by_bodies[body] * sliding;
        };
        add_sphere(self.second.id, 1);
        match &self.first {
            First::Sphere(first) => add_sphere(first.id, 0),
            First::Surface(surface) => {
                let along = |change: &dyn Fn(DVec3) -> Change| {
                    DVec3::from_array(DVec3::AXES.map(|axis| by(&change(axis))))
                };
                let by_place =
                    along(&|axis| Change { surface_position: axis, ..Change::default() });
                let by_velocity =
                    along(&|axis| Change { surface_velocity: axis, ..Change::default() });
                let collider = gradient.collider_mut(surface.collider);
                collider.position += by_place;
                collider.velocity += by_velocity + self.time * by_place;
                collider.restitution += self.restitution.combined.by_bodies[0] * restitution;
                collider.friction += self.sliding.by_bodies[0] * sliding;
            }
        }
    }

    /// Returns the change of the motion after the impact.
    fn apply(&self, change: &Change) -> [SphereTangent; 2] {
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
    fn delay(&self, change: &Change) -> f64 {
        let [first, second] = change.spheres;
        let opened = match &self.first {
            First::Sphere(_) => {
                (second.position - first.position).dot(self.normal) - change.radii[0]
            }
            First::Surface(_) => (second.position - change.surface_position).dot(self.normal),
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
                let point = self.point();
                let shift = (change.surface_position, later);
                let normal = surface.normal((self.normal, point), place.change(), shift);
                let origin_moved = change.surface_position + later * surface.velocity;
                let arm = place - normal * second.radius - vector(surface.origin, origin_moved);
                let spin = vector(surface.angular_velocity, DVec3::ZERO);
                let velocity = vector(surface.velocity, change.surface_velocity) + spin.cross(arm);
                (place, FirstBody::Surface(velocity), normal)
            }
        };
        let coefficients = Coefficients {
            restitution: Dual::new(self.restitution.combined.value, change.restitution),
            restitution_by_speed: self.restitution.by_speed,
            sliding: Dual::new(self.sliding.value, change.sliding),
            tangential_restitution: self.tangential_restitution,
            kick: self.kick,
        };
        collide(&mut first, &mut second, normal, &coefficients);
        Collided { places: [first_place, place], first, second, later }
    }
}
