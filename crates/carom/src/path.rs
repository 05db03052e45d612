//! Predicted paths of spheres.

use glam::DVec3;

use crate::flight::Flight;
use crate::polynomial_flight::PolynomialFlight;
use crate::report::Impact;

/// A piece of a path: a flight from an event to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PathLeg {
    /// When the piece begins, on the world's clock \[s\].
    pub start: f64,
    /// When it ends, on the world's clock \[s\].
    pub end: f64,
    /// When the flight's own time is 0, on the world's clock \[s\]: its last event, which may be before now.
    pub flight_start: f64,
    /// The motion over the piece; in a periodic box it may lead out of it. Along a round surface or an edge it is the
    /// motion as it begins; [`Self::state_at`] has all of it.
    pub flight: Flight,
    /// The motion along a round surface or an edge.
    pub(crate) curve: Option<PolynomialFlight>,
}

impl PathLeg {
    /// Centre \[m\] and velocity \[m/s\] at a time of the piece on the world's clock \[s\].
    pub fn state_at(&self, time: f64) -> (DVec3, DVec3) {
        let age = time - self.flight_start;
        self.curve.map_or_else(|| self.flight.after(age), |curve| curve.after(age))
    }

    /// Whether two pieces are of one motion.
    pub(crate) fn continues(&self, before: &Self) -> bool {
        let motion = |leg: &Self| (leg.flight_start, leg.flight, leg.curve);
        motion(self) == motion(before)
    }
}

/// Where a predicted path ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PathEnd {
    /// The path ends with the requested time.
    Horizon,
    /// The path ends with the last requested impact. A leg of zero length has the velocity after
    /// it.
    Impacts,
    /// Where the motion cannot be followed: a step would put the sphere into a stepped zone, or fail.
    NoClosedForm,
}

/// The path of a sphere as [`World::predict`](crate::World::predict) predicts it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct PredictedPath {
    /// Pieces of the path, one after the other without gaps.
    pub legs: Vec<PathLeg>,
    /// Impacts of the sphere on the way. They count their time from now \[s\].
    pub impacts: Vec<Impact>,
    /// Where the path ends.
    pub end: PathEnd,
    /// Edges of the periodic box \[m\]; infinite along an open axis.
    pub(crate) period: DVec3,
}

impl PredictedPath {
    /// Centre \[m\] at a time on the world's clock \[s\], in a periodic box within it; `None` outside of the
    /// path. At the time of an event it is that after it.
    pub fn position_at(&self, time: f64) -> Option<DVec3> {
        let (position, _) = self.state_at(time)?;
        Some(crate::rule::periodic::wrapped(position, self.period))
    }

    /// Velocity \[m/s\] at a time on the world's clock \[s\]; `None` outside of the path. At the time of an event it
    /// is that after it.
    pub fn velocity_at(&self, time: f64) -> Option<DVec3> {
        Some(self.state_at(time)?.1)
    }

    /// Returns the time at which the path ends, on the world's clock \[s\].
    pub fn end_time(&self) -> f64 {
        self.legs.last().map_or(f64::NEG_INFINITY, |leg| leg.end)
    }

    fn state_at(&self, time: f64) -> Option<(DVec3, DVec3)> {
        let leg = self.legs.iter().rev().find(|leg| leg.start <= time)?;
        (time <= leg.end).then(|| leg.state_at(time))
    }
}
