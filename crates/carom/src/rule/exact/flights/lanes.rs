//! Flights without drag, one of them or several side by side.

use fearless_simd::Simd;
use glam::DVec3;

use super::body::Body;
use crate::flight;
use crate::lanes::{LANES, Lanes};
use crate::real::Vector;
use crate::rule::periodic;

/// A sphere in flight since some time \[s\], or several side by side.
#[derive(Clone, Copy)]
pub(crate) struct FlightLanes<N> {
    pub position: Vector<N>,
    pub velocity: Vector<N>,
    pub time: N,
}

impl FlightLanes<f64> {
    pub fn of_one(body: &Body) -> Self {
        let Body { position, velocity, time, .. } = *body;
        Self { position: position.into(), velocity: velocity.into(), time }
    }
}

impl<S: Simd> FlightLanes<Lanes<S>> {
    #[inline(always)]
    pub fn of_each(simd: S, bodies: [&Body; LANES]) -> Self {
        // Two numbers that lie side by side in memory are read at once.
        let pairs = |pair: fn(&Body) -> [f64; 2]| Lanes::pairs(simd, bodies.map(pair));
        let [x, y] = pairs(|body| [body.position.x, body.position.y]);
        let [z, u] = pairs(|body| [body.position.z, body.velocity.x]);
        let [v, w] = pairs(|body| [body.velocity.y, body.velocity.z]);
        Self {
            position: Vector { x, y, z },
            velocity: Vector { x: u, y: v, z: w },
            time: Lanes::each(simd, bodies.map(|body| body.time)),
        }
    }

    /// Centres \[m\] in a periodic box, whose edges are given \[m\], and velocities \[m/s\] at `time`
    /// \[s\], under an acceleration \[m/s²\].
    #[inline(always)]
    pub fn states_at(
        &self,
        simd: S,
        acceleration: Vector<Lanes<S>>,
        period: DVec3,
        time: f64,
    ) -> [[DVec3; LANES]; 2] {
        let age = Lanes::all(simd, time) - self.time;
        let (position, velocity) =
            flight::without_drag(age, self.position, self.velocity, acceleration);
        let mut positions = position.to_array();
        if position.is_beyond(Vector::all(simd, 0.5 * period)) {
            positions = positions.map(|position| periodic::wrapped(position, period));
        }
        [positions, velocity.to_array()]
    }
}
