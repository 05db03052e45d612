//! Flights of spheres that fly alike without drag, one of them or several side by side.

use fearless_simd::Simd;
use glam::DVec3;

use super::body::Body;
use super::periodic;
use crate::flight;
use crate::lanes::{LANES, Lanes};
use crate::real::{Real, Vector};

/// A sphere in flight since some time \[s\], or several side by side.
#[derive(Clone, Copy)]
pub(super) struct Flights<N> {
    pub position: Vector<N>,
    pub velocity: Vector<N>,
    pub time: N,
}

/// How another sphere is seen when the later one of two flights begins.
#[derive(Clone, Copy)]
pub(super) struct Relative<N> {
    /// On the world's clock \[s\].
    pub start: N,
    /// From the centre of the one that sees to that of the other \[m\].
    pub offset: Vector<N>,
    /// \[m/s\]
    pub velocity: Vector<N>,
}

impl<N: Real> Flights<N> {
    /// How this one sees another, an image where there is a way to it \[m\], if both fall with the
    /// same acceleration \[m/s²\], if any.
    #[inline(always)]
    pub fn see(
        &self,
        other: &Self,
        way: Option<Vector<N>>,
        acceleration: Option<Vector<N>>,
    ) -> Relative<N> {
        let start = self.time.or_larger(other.time);
        let [age, other_age] = [start - self.time, start - other.time];
        let mut offset = other.position - self.position;
        if let Some(way) = way {
            offset = offset + way;
        }
        offset = offset + (other.velocity * other_age - self.velocity * age);
        let mut velocity = other.velocity - self.velocity;
        if let Some(acceleration) = acceleration {
            offset = offset + acceleration * ((other_age * other_age - age * age) * 0.5);
            velocity = velocity + acceleration * (other_age - age);
        }
        Relative { start, offset, velocity }
    }
}

impl Flights<f64> {
    pub fn of_one(body: &Body) -> Self {
        let Body { position, velocity, time, .. } = *body;
        Self { position: position.into(), velocity: velocity.into(), time }
    }
}

impl<S: Simd> Flights<Lanes<S>> {
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
        let (place, velocity) =
            flight::without_drag(age, self.position, self.velocity, acceleration);
        let mut places = place.to_array();
        if place.is_beyond(Vector::all(simd, 0.5 * period)) {
            places = places.map(|place| periodic::folded(place, period));
        }
        [places, velocity.to_array()]
    }
}
