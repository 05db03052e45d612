//! The relative motion of two spheres that fly alike without drag.

use crate::real::{Real, Vector};
use crate::rule::exact::flights::FlightLanes;

/// The motion of one sphere relative to another from the later start of their flights; one pair, or one per lane.
#[derive(Clone, Copy)]
pub(super) struct Relative<N> {
    /// Start, on the world's clock \[s\].
    pub start: N,
    /// Offset from centre to centre \[m\].
    pub offset: Vector<N>,
    /// Velocity \[m/s\].
    pub velocity: Vector<N>,
}

impl<N: Real> Relative<N> {
    /// The motion of the second sphere, or of its image where there is a shift \[m\], relative to the
    /// first, if both fall with the same acceleration \[m/s²\], if any.
    #[inline(always)]
    pub fn between(
        first: &FlightLanes<N>,
        second: &FlightLanes<N>,
        image_shift: Option<Vector<N>>,
        acceleration: Option<Vector<N>>,
    ) -> Self {
        let start = first.time.max(second.time);
        let [age, other_age] = [start - first.time, start - second.time];
        let mut offset = second.position - first.position;
        if let Some(shift) = image_shift {
            offset = offset + shift;
        }
        offset = offset + (second.velocity * other_age - first.velocity * age);
        let mut velocity = second.velocity - first.velocity;
        if let Some(acceleration) = acceleration {
            offset = offset + acceleration * ((other_age * other_age - age * age) * 0.5);
            velocity = velocity + acceleration * (other_age - age);
        }
        Self { start, offset, velocity }
    }
}
