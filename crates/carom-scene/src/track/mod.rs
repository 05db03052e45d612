//! Meshes of tracks: a path of stations, and the gutter along it.

mod station;

use carom::{DVec3, Mesh};

use crate::scene::{Piece, Track};
use station::Station;

/// Most triangles of a track.
const MOST_TRIANGLES: f64 = 1e6;
/// Steepest slope on which a curve can be followed, in degrees: beyond it a helix has no direction as seen from above.
const STEEPEST: f64 = 80.0;

/// Makes the mesh of a track.
///
/// # Errors
/// What is wrong with its numbers, in words.
pub(crate) fn mesh(track: &Track) -> Result<Mesh, String> {
    check(track)?;
    let section = Section::of(track);
    let mut surface = Surface::default();
    let mut station = Station::at_start(track.pitch_degrees.to_radians());
    let mut last = None;
    for (number, piece) in track.pieces.iter().enumerate() {
        check_slope(piece, station.pitch)
            .map_err(|problem| format!("pieces[{number}].{}: {problem}", piece.kind()))?;
        if let Piece::Gap { .. } = piece {
            last = None;
            station = station.along(piece, 1.0);
            continue;
        }
        let from = last.unwrap_or_else(|| surface.add_ring(section.ring(&station)));
        let count = facets(piece, track.facet_degrees) as u32;
        last = Some((1..=count).fold(from, |before, part| {
            let next = station.along(piece, f64::from(part) / f64::from(count));
            let ring = surface.add_ring(section.ring(&next));
            surface.add_strip([before, ring], section.facets);
            ring
        }));
        station = station.along(piece, 1.0);
    }
    if surface.triangles.is_empty() {
        return Err("`pieces` has nothing but gaps".to_owned());
    }
    Mesh::new(surface.vertices, surface.triangles).map_err(|error| error.to_string())
}

/// Facets that follow each other along a piece.
fn facets(piece: &Piece, facet_degrees: f64) -> f64 {
    match piece {
        Piece::Straight { .. } => 1.0,
        Piece::Curve { degrees, .. } | Piece::Bend { degrees, .. } => {
            // A turn by rounding more needs no facet more.
            (degrees.abs() / facet_degrees - 1e-9).ceil().max(1.0)
        }
        Piece::Gap { .. } => 0.0,
    }
}

fn check(track: &Track) -> Result<(), String> {
    let Track { radius, pieces, arc_degrees, sides, facet_degrees, pitch_degrees, .. } = track;
    positive("radius", *radius)?;
    if !(*arc_degrees > 0.0 && *arc_degrees <= 360.0) {
        return Err(format!("`arc_degrees` must be above 0 and at most 360, not {arc_degrees}"));
    }
    if !((3..=999).contains(sides) && sides % 2 == 1) {
        return Err(format!("`sides` must be an odd number from 3 to 999, not {sides}"));
    }
    if !(0.1..=45.0).contains(facet_degrees) {
        return Err(format!("`facet_degrees` must be from 0.1 to 45, not {facet_degrees}"));
    }
    finite("pitch_degrees", *pitch_degrees)?;
    for (number, piece) in pieces.iter().enumerate() {
        check_piece(piece, *radius)
            .map_err(|problem| format!("pieces[{number}].{}: {problem}", piece.kind()))?;
    }
    let along: f64 = pieces.iter().map(|piece| facets(piece, *facet_degrees)).sum();
    let triangles = 2.0 * along * f64::from(*sides);
    if triangles > MOST_TRIANGLES {
        return Err(format!(
            "it would have {triangles:.0} triangles, and {MOST_TRIANGLES:.0} are allowed; a larger \
             `facet_degrees` makes fewer"
        ));
    }
    Ok(())
}

fn check_piece(piece: &Piece, section: f64) -> Result<(), String> {
    let wider = |radius: f64| {
        positive("radius", radius)?;
        let is_wide = radius > section;
        if is_wide {
            Ok(())
        } else {
            Err(format!("`radius` must be above {section}, that of the track"))
        }
    };
    match piece {
        Piece::Straight { length } => positive("length", *length),
        Piece::Curve { radius, degrees, bank_degrees } => {
            wider(*radius)?;
            turn(*degrees)?;
            finite("bank_degrees", *bank_degrees)
        }
        Piece::Bend { radius, degrees, shift } => {
            wider(*radius)?;
            turn(*degrees)?;
            finite("shift", *shift)
        }
        Piece::Gap { length, drop, pitch_degrees } => {
            if !(length.is_finite() && *length >= 0.0) {
                return Err(format!("`length` must not be negative, not {length}"));
            }
            finite("drop", *drop)?;
            finite("pitch_degrees", pitch_degrees.unwrap_or(0.0))
        }
    }
}

fn check_slope(piece: &Piece, pitch: f64) -> Result<(), String> {
    let slope = pitch.to_degrees();
    let is_possible = !matches!(piece, Piece::Curve { .. })
        || libm::cos(pitch) > libm::cos(STEEPEST.to_radians());
    if is_possible {
        Ok(())
    } else {
        Err(format!("begins at a slope of {slope:.0} degrees, and at most {STEEPEST} are possible"))
    }
}

fn positive(name: &str, length: f64) -> Result<(), String> {
    let is_good = length.is_finite() && length > 0.0;
    if is_good {
        Ok(())
    } else {
        Err(format!("`{name}` must be positive and finite, not {length}"))
    }
}

fn finite(name: &str, number: f64) -> Result<(), String> {
    if number.is_finite() { Ok(()) } else { Err(format!("`{name}` must be finite, not {number}")) }
}

fn turn(degrees: f64) -> Result<(), String> {
    let is_good = degrees.is_finite() && degrees != 0.0;
    if is_good { Ok(()) } else { Err(format!("`degrees` must be finite and not 0, not {degrees}")) }
}

/// A cross-section: facets that touch the circle.
struct Section {
    radius: f64,
    /// \[rad\]
    arc: f64,
    facets: u32,
}

impl Section {
    fn of(track: &Track) -> Self {
        Self { radius: track.radius, arc: track.arc_degrees.to_radians(), facets: track.sides }
    }

    /// Corners of the facets at a station, from its left to its right.
    fn ring(&self, station: &Station) -> impl Iterator<Item = DVec3> {
        let [_, up, right] = station.axes();
        let center = station.position + self.radius * up;
        let step = self.arc / f64::from(self.facets);
        let corner = self.radius / libm::cos(0.5 * step);
        let first = station.bank - 0.5 * self.arc;
        (0..=self.facets).map(move |number| {
            let (sin, cos) = libm::sincos(first + step * f64::from(number));
            center + corner * (sin * right - cos * up)
        })
    }
}

/// Vertices and triangles, as they come.
#[derive(Default)]
struct Surface {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Adds the corners of a cross-section. Returns the number of the first.
    fn add_ring(&mut self, ring: impl Iterator<Item = DVec3>) -> u32 {
        let first = self.vertices.len() as u32;
        self.vertices.extend(ring);
        first
    }

    /// Adds the facets between two rings, which are given by their first corners. They face inward.
    fn add_strip(&mut self, [back, ahead]: [u32; 2], facets: u32) {
        for corner in 0..facets {
            let [a, b, c, d] =
                [back + corner, back + corner + 1, ahead + corner, ahead + corner + 1];
            self.triangles.extend([[a, b, c], [c, b, d]]);
        }
    }
}
