//! Shapes made of surfaces of revolution: their bands, and the volumes that they enclose.

use glam::{DVec2, DVec3};

use crate::band::{Band, Profile};
use crate::collider::{Ends, Shape};

/// A solid of revolution in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct RoundSolid {
    /// Centre of the solid, on its axis \[m\].
    pub center: DVec3,
    /// Unit vector.
    pub axis: DVec3,
    pub outline: Outline,
}

/// What a solid of revolution is bounded by, in its own coordinates; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Outline {
    /// Between two discs.
    Frustum { bottom_radius: f64, top_radius: f64, half: f64 },
    /// All within a radius of a line along the axis.
    Capsule { radius: f64, half: f64 },
    /// All within a radius of a circle about the axis.
    Torus { ring_radius: f64, tube_radius: f64 },
    /// The part of a ball that is farther from the direction of the axis than this angle \[rad\].
    Bowl { radius: f64, opening: f64 },
}

/// Pieces of an outline, at most.
const MOST_PIECES: usize = 3;

impl Outline {
    /// Returns the outline of a shape that is a solid of revolution, or whose inside is one.
    pub fn of(shape: &Shape) -> Option<Self> {
        Some(match *shape {
            Shape::Cylinder { radius, height } | Shape::Pipe { radius, length: height, .. } => {
                Self::Frustum { bottom_radius: radius, top_radius: radius, half: 0.5 * height }
            }
            Shape::Cone { bottom_radius, top_radius, height }
            | Shape::Funnel { bottom_radius, top_radius, height } => {
                Self::Frustum { bottom_radius, top_radius, half: 0.5 * height }
            }
            Shape::Capsule { radius, length } => Self::Capsule { radius, half: 0.5 * length },
            Shape::Torus { ring_radius, tube_radius } => Self::Torus { ring_radius, tube_radius },
            Shape::Bowl { radius, opening } => Self::Bowl { radius, opening },
            _ => return None,
        })
    }

    /// Returns the profiles of its side and its discs, facing outward.
    fn profiles(&self) -> [Option<Profile>; MOST_PIECES] {
        match *self {
            Self::Frustum { bottom_radius, top_radius, half } => {
                let (top, bottom) = (DVec2::new(0.0, half), DVec2::new(0.0, -half));
                let rims = [DVec2::new(top_radius, half), DVec2::new(bottom_radius, -half)];
                let cap = |from: DVec2, to: DVec2, radius: f64| {
                    (radius > 0.0).then(|| Profile::line(from, to))
                };
                [
                    Some(Profile::line(rims[0], rims[1])),
                    cap(rims[1], bottom, bottom_radius),
                    cap(top, rims[0], top_radius),
                ]
            }
            Self::Capsule { radius, half } => {
                let from = DVec2::new(0.0, half);
                let (direction, length) = (DVec2::NEG_Y, 2.0 * half);
                [Some(Profile::Line { from, direction, length, thickness: radius }), None, None]
            }
            Self::Torus { ring_radius, tube_radius } => {
                let (center, ends) = (DVec2::new(ring_radius, 0.0), [DVec2::X; 2]);
                let radius = tube_radius;
                [Some(Profile::Arc { center, radius, ends, is_hollow: false }), None, None]
            }
            Self::Bowl { radius, opening } => {
                let (sin, cos) = libm::sincos(opening);
                let rim = DVec2::new(sin, cos);
                let (center, ends) = (DVec2::ZERO, [DVec2::NEG_Y, rim]);
                let lid = || Profile::line(DVec2::new(0.0, radius * rim.y), radius * rim);
                let side = Profile::Arc { center, radius, ends, is_hollow: false };
                [Some(side), (rim.x > 0.0).then(lid), None]
            }
        }
    }
}

impl RoundSolid {
    /// Returns the bands of its side and its discs, facing outward.
    pub fn bands(&self) -> impl Iterator<Item = Band> {
        let Self { center, axis, outline } = *self;
        let profiles = outline.profiles().into_iter().flatten();
        profiles.map(move |profile| Band { center, axis, profile, is_open: false })
    }

    /// The walls of a hollow shape with this inside, each facing outward and then inward.
    pub fn walls(&self, shape: &Shape) -> impl Iterator<Item = Band> + use<> {
        let Ends { bottom, top } = match *shape {
            Shape::Pipe { closed, .. } => closed,
            _ => Ends::NONE,
        };
        let walls: Vec<Band> = self.bands().collect();
        let is_wall = move |number: &usize| [true, bottom, top][*number];
        (0..walls.len()).filter(is_wall).flat_map(move |number| {
            let wall = walls[number];
            [wall, Band { profile: wall.profile.turned(), ..wall }]
        })
    }

    /// Size of the coordinates that it is given by \[m\].
    pub fn coordinates(&self) -> f64 {
        self.bands().map(|band| band.coordinates()).fold(0.0, f64::max)
    }

    /// Smallest and largest of `(x - center)·direction` over the solid \[m\], or more than that.
    pub fn extent(&self, direction: DVec3) -> [f64; 2] {
        self.bands()
            .map(|band| band.extent(direction))
            .fold([0.0; 2], |all, own| [all[0].min(own[0]), all[1].max(own[1])])
    }
}
