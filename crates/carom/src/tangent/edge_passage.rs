//! Edges of forces, and the derivative of a sphere's passing one at which a force jumps.

use glam::DVec3;

use super::state::SphereTangent;
use super::variation::Variation;
use crate::forces::{ForceEdge, SphereState};
use crate::id::SphereId;
use crate::system::System;

/// Largest distance by which a flight is beyond an edge at which its step ends, as a part of the coordinates: above
/// rounding, and far below any way of a sphere.
const AT_EDGE: f64 = 1e-12;
/// Distance from an edge at which a force counts as that of one side, as a part of the coordinates.
const ASIDE: f64 = 8.0 * f64::EPSILON;

/// The side of an edge on which a sphere flies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub edge: ForceEdge,
    /// Derivative of the height of the edge by the radius of the sphere; `None` if it is not constant.
    pub by_radius: Option<f64>,
    pub is_beyond: bool,
}

/// Derivative of the instant at which a sphere passes an edge of a force: a saltation matrix, as of an impact.
#[derive(Debug, Clone)]
pub(super) struct Passage {
    /// Index of the sphere in the arrays of the world.
    pub place: usize,
    pub id: SphereId,
    pub normal: DVec3,
    /// Derivative of the height of the edge by the radius.
    pub by_radius: f64,
    pub velocity: DVec3,
    /// How much smaller the acceleration of the sphere is afterwards \[m/s²\].
    pub lost: DVec3,
    /// Time since the start of the derivatives \[s\].
    pub time: f64,
}

impl Side {
    /// Returns the side of each edge of the forces on a sphere on which it is in this state.
    pub fn all(system: &System, state: &SphereState) -> Vec<Self> {
        let mut sides = Vec::new();
        for (_, force) in system.forces.iter() {
            let radius = state.radius;
            let [wider, widest] = [2.0, 3.0].map(|factor| force.edges(factor * radius));
            for (number, edge) in force.edges(radius).into_iter().enumerate() {
                let heights = [wider.get(number), widest.get(number)].map(|it| Some(it?.height));
                let by_radius = heights[0].zip(heights[1]).and_then(|(wider, widest)| {
                    let bend = widest - 2.0 * wider + edge.height;
                    let rounding = ASIDE * (widest.abs() + edge.height.abs());
                    (bend.abs() <= rounding).then_some((wider - edge.height) / radius)
                });
                let is_beyond = edge.normal.dot(state.position) > edge.height;
                sides.push(Self { edge, by_radius, is_beyond });
            }
        }
        sides
    }

    /// Returns a position on this side \[m\]: the position itself, unless it is beyond the edge by rounding.
    pub fn keep(&self, position: DVec3) -> DVec3 {
        let ForceEdge { normal, height } = self.edge;
        let sign = if self.is_beyond { 1.0 } else { -1.0 };
        let inside = sign * (normal.dot(position) - height);
        let size = position.length() + height.abs();
        let least = ASIDE * size;
        if inside >= least || inside < -AT_EDGE * size {
            return position;
        }
        position + sign * (least - inside) * normal
    }

    /// Returns whether another side is one of the same plane.
    pub fn is_of_same_plane(&self, other: &Self) -> bool {
        let size = self.edge.height.abs() + other.edge.height.abs();
        let off = (self.edge.height - other.edge.height).abs();
        self.edge.normal == other.edge.normal
            && off <= ASIDE * size
            && self.by_radius == other.by_radius
    }
}

impl Passage {
    /// Returns the ratio of the speed across the edge to the speed: 0 if the sphere grazes it.
    pub fn directness(&self) -> f64 {
        let speed = self.velocity.length();
        if speed == 0.0 { 0.0 } else { self.velocity.dot(self.normal).abs() / speed }
    }

    /// Applies the derivative to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let sphere = &mut spheres[self.place];
        let higher = self.by_radius * direction.sphere(self.id).radius;
        let later = (higher - sphere.position.dot(self.normal)) / self.speed();
        sphere.velocity += later * self.lost;
    }

    /// The transpose of [`Self::pass`]; adds the derivative with respect to the radius to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let sphere = &mut spheres[self.place];
        let by_height = self.lost.dot(sphere.velocity) / self.speed();
        sphere.position -= by_height * self.normal;
        gradient.sphere_mut(self.id).radius += by_height * self.by_radius;
    }

    fn speed(&self) -> f64 {
        self.velocity.dot(self.normal)
    }
}
