//! A leg of a sphere's way, as sensors see it.

use glam::DVec3;

use crate::detect::surface_tree::Bounds;
use crate::flight::Flight;
use crate::id::SphereId;
use crate::settings::nearest_image;

/// In a periodic box a leg is cut where it may have crossed this part of the box.
const PART_OF_BOX: f64 = 0.5;

/// A part of the flight of one sphere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Leg {
    pub sphere: SphereId,
    /// Of the sphere in the arrays of the world.
    pub index: u32,
    /// \[m\]
    pub radius: f64,
    pub flight: Flight,
    /// When the flight's own time is 0, on the world's clock \[s\].
    pub flight_start: f64,
    /// Beginning and end of the part, on the world's clock \[s\].
    pub from: f64,
    pub to: f64,
}

impl Leg {
    /// The flight from `time` \[s\] on.
    pub fn flight_from(&self, time: f64) -> Flight {
        let (position, velocity) = self.flight.after(time - self.flight_start);
        Flight { position, velocity, ..self.flight }
    }

    /// Bounds of the sphere over the leg.
    pub fn bounds(&self) -> Bounds {
        let start = self.flight_from(self.from);
        let way = start.farthest(self.to - self.from);
        let slack = 1e-9 * (start.position.abs().max_element() + way.max_element() + self.radius);
        Bounds::around(start.position, way + (self.radius + slack))
    }

    /// The leg in pieces that are short beside a box with these edges \[m\], each of which begins in it.
    pub fn pieces(self, period: DVec3) -> impl Iterator<Item = Self> {
        let whole = self.to - self.from;
        let way = self.flight_from(self.from).farthest(whole);
        let count = (way / (PART_OF_BOX * period)).max_element().ceil().clamp(1.0, 1e9) as u32;
        let is_periodic = period != DVec3::INFINITY;
        (0..count).map(move |number| {
            if !is_periodic {
                return self;
            }
            let at = |number: u32| self.from + whole * (f64::from(number) / f64::from(count));
            let (from, to) =
                (at(number), if number + 1 == count { self.to } else { at(number + 1) });
            let flight = self.flight_from(from);
            let flight = Flight { position: nearest_image(flight.position, period), ..flight };
            Self { flight, flight_start: from, from, to, ..self }
        })
    }
}

/// Shifts \[m\] of images that a piece of a leg may come to in a box with these edges \[m\].
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
