//! The derivative of a damped thread's becoming taut, at which its force jumps.

use glam::DVec3;

use super::state::SphereTangent;
use super::variation::Variation;
use crate::id::SpringId;

/// Derivative of the instant at which a damped thread becomes taut: a saltation matrix, as of an impact.
#[derive(Debug, Clone)]
pub(super) struct Tightening {
    pub thread: SpringId,
    /// Index of the sphere at its first end in the arrays of the world, and of that at its second; `None` at a fixed
    /// point.
    pub ends: (usize, Option<usize>),
    /// Unit vector from the first end to the second.
    pub direction: DVec3,
    /// Rate of change of its length \[m/s\], > 0.
    pub lengthening: f64,
    /// Spheres whose accelerations jump, by index, and how much smaller these are afterwards \[m/s²\].
    pub jumps: Vec<(usize, DVec3)>,
}

impl Tightening {
    /// Applies the derivative to the derivatives of the spheres in one direction.
    pub fn pass(&self, direction: &Variation, spheres: &mut [SphereTangent]) {
        let (first, second) = self.ends;
        let of_second = second.map_or(DVec3::ZERO, |place| spheres[place].position);
        let longer = (of_second - spheres[first].position).dot(self.direction);
        let later = (direction.spring(self.thread).rest_length - longer) / self.lengthening;
        for &(place, lost) in &self.jumps {
            spheres[place].velocity += later * lost;
        }
    }

    /// The transpose of [`Self::pass`]; adds the derivative with respect to the rest length to a gradient.
    pub fn pass_back(&self, spheres: &mut [SphereTangent], gradient: &mut Variation) {
        let (first, second) = self.ends;
        let of_jumps = self.jumps.iter().map(|&(place, lost)| lost.dot(spheres[place].velocity));
        let by_length = of_jumps.sum::<f64>() / self.lengthening;
        gradient.spring_mut(self.thread).rest_length += by_length;
        spheres[first].position += by_length * self.direction;
        if let Some(second) = second {
            spheres[second].position -= by_length * self.direction;
        }
    }
}
