//! The derivative of the motion of a sphere that several planes hold: along a groove, or at rest in a corner.

use glam::DVec3;

use super::start::Held;
use super::state::SphereTangent;
use super::variation::Variation;
use crate::flight::Propagator;
use crate::id::{ColliderId, SphereId};

/// One of the planes of a corner.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wall {
    pub collider: ColliderId,
    pub normal: DVec3,
    /// How the centre moves for a unit by which this plane alone moves along its normal.
    pub shift: DVec3,
}

/// Flight of a sphere that several smooth planes at rest hold: freely along them, not at all in a corner.
#[derive(Debug, Clone)]
pub(super) struct CorneredFlight {
    /// Index in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    pub walls: Vec<Wall>,
    /// Derivatives of the acceleration by the radius, and by the mass.
    pub by_inputs: [DVec3; 2],
    /// Length \[s\].
    pub time: f64,
    /// Start, counted from the start of the derivatives \[s\].
    pub began: f64,
}

impl CorneredFlight {
    /// Returns the flight with a length \[s\].
    pub fn over(self, time: f64) -> Self {
        Self { time, ..self }
    }

    /// Returns whether the same planes hold the sphere next.
    pub fn goes_on(&self, next: Option<Held>) -> bool {
        let Some(next) = next else { return true };
        self.walls.iter().all(|it| next.has(it.collider, it.normal))
    }

    /// Returns whether a plane of a collider with this normal bears the sphere.
    pub fn has(&self, collider: ColliderId, normal: DVec3) -> bool {
        self.walls.iter().any(|it| it.collider == collider && it.normal.dot(normal) > 0.5)
    }

    pub fn colliders(&self) -> impl Iterator<Item = ColliderId> {
        self.walls.iter().map(|it| it.collider)
    }

    /// Returns the part of a vector along which the planes let the sphere move.
    fn along(&self, vector: DVec3) -> DVec3 {
        self.walls.iter().fold(vector, |rest, it| rest - it.normal.dot(vector) * it.shift)
    }

    /// Applies the derivative of the flight to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let change = direction.sphere(self.id);
        let by_inputs = [change.radius, change.mass].into_iter().zip(self.by_inputs);
        let by_inputs: DVec3 = by_inputs.filter(|it| it.0 != 0.0).map(|(by, it)| by * it).sum();
        let sphere = &mut spheres[self.place];
        let over = Propagator::over(self.time, 0.0);
        sphere.fly(over, direction.acceleration + change.acceleration + by_inputs);
        (sphere.position, sphere.velocity) =
            (self.along(sphere.position), self.along(sphere.velocity));
        for wall in &self.walls {
            let collider = direction.collider(wall.collider);
            let moved = collider.position + (self.began + self.time) * collider.velocity;
            sphere.position += (wall.normal.dot(moved) + change.radius) * wall.shift;
            sphere.velocity += wall.normal.dot(collider.velocity) * wall.shift;
        }
    }

    /// The transpose of [`Self::pass`]; adds the derivatives with respect to all other inputs to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let after = spheres[self.place];
        for wall in &self.walls {
            let by_place = wall.shift.dot(after.position);
            let by_speed = wall.shift.dot(after.velocity);
            let collider = gradient.collider_mut(wall.collider);
            collider.position += by_place * wall.normal;
            collider.velocity += (by_speed + (self.began + self.time) * by_place) * wall.normal;
            collider.rotation = DVec3::NAN;
            gradient.sphere_mut(self.id).radius += by_place;
        }
        let sphere = &mut spheres[self.place];
        let across = |vector: DVec3| {
            self.walls.iter().fold(vector, |rest, it| rest - it.shift.dot(vector) * it.normal)
        };
        (sphere.position, sphere.velocity) = (across(after.position), across(after.velocity));
        let by_acceleration = sphere.fly_back(Propagator::over(self.time, 0.0));
        gradient.acceleration += by_acceleration;
        let of_sphere = gradient.sphere_mut(self.id);
        of_sphere.acceleration += by_acceleration;
        of_sphere.radius += self.by_inputs[0].dot(by_acceleration);
        of_sphere.mass += self.by_inputs[1].dot(by_acceleration);
    }
}
