//! A segment of a sphere's flight, which sensors test for crossings.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::contact_time::{PolynomialTrack, Track};
use crate::flight::Flight;
use crate::id::SphereId;
use crate::norm::Norm;
use crate::polynomial_flight::PolynomialFlight;
use crate::settings::nearest_image;

/// In a periodic box a segment is cut where it may have crossed this part of the box.
const PART_OF_BOX: f64 = 0.5;

/// A part of the flight of one sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlightSegment {
    pub sphere: SphereId,
    /// Index of the sphere in the arrays of the world.
    pub index: u32,
    /// Radius \[m\].
    pub radius: f64,
    pub flight: Flight,
    /// The polynomial flight where forces have no closed form.
    pub curve: Option<PolynomialFlight>,
    /// Start of the flight on the world's clock \[s\].
    pub flight_start: f64,
    /// Beginning and end of the part, on the world's clock \[s\].
    pub from: f64,
    pub to: f64,
}

impl FlightSegment {
    /// The flight of the sphere from `time` \[s\] on.
    pub fn flight_from(&self, time: f64) -> Flight {
        let age = time - self.flight_start;
        let (position, velocity) = match &self.curve {
            Some(curve) => curve.after(age),
            None => self.flight.after(age),
        };
        Flight { position, velocity, ..self.flight }
    }

    /// The path of the sphere from `time` \[s\] on, relative to a place \[m\].
    pub fn track_from(&self, time: f64, place: DVec3) -> Track {
        let track = match self.curve {
            Some(curve) => {
                let age = time - self.flight_start;
                Track::Polynomial(Box::new(PolynomialTrack::new(curve, age)))
            }
            None => Track::Flight(self.flight_from(time)),
        };
        track.shifted(-place)
    }

    /// Largest distance of the flight up to `time` \[s\], along each axis \[m\].
    pub fn farthest(&self, time: f64) -> DVec3 {
        match &self.curve {
            Some(curve) => curve.farthest(),
            None => self.flight.farthest(time - self.flight_start),
        }
    }

    /// An upper bound of the acceleration from `time` \[s\] on \[m/s²\], without drag, which only slows the sphere
    /// down.
    pub fn most_acceleration(&self) -> f64 {
        match &self.curve {
            Some(curve) => {
                let [low, high] = curve.acceleration.bounds();
                low.abs().max(high.abs()).norm()
            }
            None => self.flight.acceleration.norm(),
        }
    }

    /// Bounds of the sphere over the segment.
    pub fn bounds(&self) -> Bounds {
        let (start, way) = match &self.curve {
            Some(curve) => (curve.position, curve.farthest()),
            None => {
                let start = self.flight_from(self.from);
                (start.position, start.farthest(self.to - self.from))
            }
        };
        let slack = 1e-9 * (start.abs().max_element() + way.max_element() + self.radius);
        Bounds::around(start, way + (self.radius + slack))
    }

    /// The segment in pieces that are short beside a box with these edges \[m\], each of which begins in it.
    pub fn pieces(self, period: DVec3) -> impl Iterator<Item = Self> {
        let whole = self.to - self.from;
        let way = match &self.curve {
            Some(curve) => curve.farthest(),
            None => self.flight_from(self.from).farthest(whole),
        };
        let count = (way / (PART_OF_BOX * period)).max_element().ceil().clamp(1.0, 1e9) as u32;
        let is_periodic = period != DVec3::INFINITY;
        (0..count).map(move |number| {
            if !is_periodic {
                return self;
            }
            let at = |number: u32| self.from + whole * (f64::from(number) / f64::from(count));
            let (from, to) =
                (at(number), if number + 1 == count { self.to } else { at(number + 1) });
            let place = self.flight_from(from).position;
            let shift = nearest_image(place, period) - place;
            let flight = Flight { position: self.flight.position + shift, ..self.flight };
            let moved = |curve: PolynomialFlight| PolynomialFlight {
                position: curve.position + shift,
                ..curve
            };
            Self { flight, curve: self.curve.map(moved), from, to, ..self }
        })
    }
}

/// Offsets \[m\] of images that a piece of a segment may reach in a box with these edges \[m\].
pub(super) fn shifts(period: DVec3) -> impl Iterator<Item = DVec3> {
    let boxes = |axis: usize| if period[axis].is_finite() { -1..=1 } else { 0..=0 };
    let [xs, ys, zs] = [0, 1, 2].map(boxes);
    let period = DVec3::select(period.is_finite_mask(), period, DVec3::ZERO);
    xs.flat_map(move |x: i32| {
        let zs = zs.clone();
        ys.clone().flat_map(move |y: i32| zs.clone().map(move |z: i32| [x, y, z]))
    })
    .map(move |boxes| DVec3::from_array(boxes.map(f64::from)) * period)
}
