//! Places along a track.

use std::f64::consts::TAU;

use carom::DVec3;

use crate::scene::Piece;

/// A place on the path of a track, and the directions there.
#[derive(Clone, Copy)]
pub struct Station {
    /// Position on the lowest line \[m\].
    pub position: DVec3,
    /// Direction as seen from above \[rad\]: 0 along +x, positive to the left.
    heading: f64,
    /// Slope \[rad\], positive upward.
    pub pitch: f64,
    /// How far the cross-section is turned \[rad\], positive where its right side is the higher one.
    pub bank: f64,
}

impl Station {
    /// The beginning of a track with this slope \[rad\].
    pub fn at_start(pitch: f64) -> Self {
        Self { position: DVec3::ZERO, heading: 0.0, pitch, bank: 0.0 }
    }

    /// Unit vectors ahead, upward across the path, and to the right.
    pub fn axes(&self) -> [DVec3; 3] {
        let (sin, cos) = libm::sincos(self.pitch);
        let level = self.level();
        [cos * level + sin * DVec3::Y, cos * DVec3::Y - sin * level, level.cross(DVec3::Y)]
    }

    /// Ahead as seen from above.
    fn level(&self) -> DVec3 {
        let (sin, cos) = libm::sincos(self.heading);
        DVec3::new(cos, 0.0, -sin)
    }

    /// Returns the station at a part in [0, 1] of a piece that begins here.
    pub fn along(&self, piece: &Piece, part: f64) -> Self {
        match *piece {
            Piece::Straight { length } => {
                let [ahead, ..] = self.axes();
                Self { position: self.position + part * length * ahead, ..*self }
            }
            Piece::Curve { radius, degrees, bank_degrees } => {
                let (angle, side) = (part * degrees.to_radians(), 1.0_f64.copysign(degrees));
                let heading = self.heading + angle;
                let [from, to] = [self.heading, heading].map(libm::sincos);
                let level = DVec3::new(to.0 - from.0, 0.0, to.1 - from.1);
                let rise = radius * angle.abs() * libm::tan(self.pitch);
                Self {
                    position: self.position + side * radius * level + rise * DVec3::Y,
                    heading,
                    bank: self.bank + side * bank_degrees.to_radians() * eased(part),
                    ..*self
                }
            }
            Piece::Bend { radius, degrees, shift } => {
                let side = 1.0_f64.copysign(degrees);
                let pitch = self.pitch + part * degrees.to_radians();
                let [from, to] = [self.pitch, pitch].map(libm::sincos);
                let [.., right] = self.axes();
                // Sideways with the direction of the path at both ends.
                let left = shift * (part - libm::sin(TAU * part) / TAU);
                let on = (to.0 - from.0) * self.level() + (from.1 - to.1) * DVec3::Y;
                let position = self.position + side * radius * on - left * right;
                Self { position, pitch, ..*self }
            }
            Piece::Gap { length, drop, pitch_degrees } => {
                let position = self.position + part * (length * self.level() - drop * DVec3::Y);
                let pitch = pitch_degrees.map_or(self.pitch, f64::to_radians);
                Self { position, pitch, ..*self }
            }
        }
    }
}

/// Rises from 0 to 1 in the first quarter and returns in the last one, without a jump of its slope.
fn eased(part: f64) -> f64 {
    let part = (4.0 * part.min(1.0 - part)).min(1.0);
    part * part * (3.0 - 2.0 * part)
}
