//! Places in regular patterns.

use carom::{DQuat, DVec3};

use super::place::Place;
use crate::error::Problem;
use crate::requirement::{check, check_direction, check_positive, check_vector};
use crate::scene::values::vector;
use crate::scene::{Lattice, Ring, Row, Stacking, Vector};

/// Places along a line.
pub(super) fn row(row: &Row, path: &str) -> Result<Vec<Place>, Problem> {
    check_vector(row.start, &format!("{path}.start"))?;
    check_vector(row.step, &format!("{path}.step"))?;
    let (start, step) = (vector(row.start), vector(row.step));
    Ok((0..row.count).map(|i| Place::along(i, start + f64::from(i) * step)).collect())
}

/// Places on a box-shaped lattice.
pub(super) fn lattice(lattice: &Lattice, path: &str) -> Result<Vec<Place>, Problem> {
    check_vector(lattice.start, &format!("{path}.start"))?;
    check_vector(lattice.spacing, &format!("{path}.spacing"))?;
    let (start, spacing) = (vector(lattice.start), vector(lattice.spacing));
    let [nx, ny, nz] = lattice.counts;
    let cells = (0..nz).flat_map(|z| (0..ny).map(move |y| (y, z)));
    let cells = cells.flat_map(|(y, z)| (0..nx).map(move |x| [x, y, z]));
    let place = |cell: [u32; 3]| Place {
        center: start + DVec3::from_array(cell.map(f64::from)) * spacing,
        numbers: cell.map(|number| number + 1),
    };
    Ok(cells.map(place).collect())
}

/// Places in a close packing, layer by layer; neighbours are `spacing` apart. A packing without `stacking` is a
/// triangular lattice in the plane of x and y.
pub(super) fn close_packing(
    counts: [u32; 3],
    stacking: Option<Stacking>,
    (start, spacing): (Vector, f64),
    path: &str,
) -> Result<Vec<Place>, Problem> {
    check_vector(start, &format!("{path}.start"))?;
    let start = vector(start);
    let [nx, ny, nz] = counts;
    check(stacking.is_some() || nz == 1, &format!("{path}.counts"), || {
        format!("must have one row in a layer in two dimensions, not {nz}")
    })?;
    let rows = (0..ny).flat_map(|layer| (0..nz).map(move |row| [layer, row]));
    let rows = rows.map(|row| (row, start + spacing * row_of_packing(row, stacking)));
    let along = |([layer, row], first): ([u32; 2], DVec3)| {
        (0..nx).map(move |x| Place {
            center: first + spacing * f64::from(x) * DVec3::X,
            numbers: [x, layer, row].map(|number| number + 1),
        })
    };
    Ok(rows.flat_map(along).collect())
}

/// First place of a row in a close packing of spacing 1.
fn row_of_packing([layer, row]: [u32; 2], stacking: Option<Stacking>) -> DVec3 {
    let (row_distance, layer_distance) = (0.75_f64.sqrt(), (2.0_f64 / 3.0).sqrt());
    let Some(stacking) = stacking else {
        return DVec3::new(0.5 * f64::from(layer % 2), f64::from(layer) * row_distance, 0.0);
    };
    // A sphere lies above the middle of a triangle of the layer below: half a spacing further in
    // its row, and a third of the way to the next row. Two such shifts move a row by a whole
    // spacing.
    let steps = layer
        % match stacking {
            Stacking::Hcp => 2,
            Stacking::Fcc => 3,
        };
    DVec3::new(
        0.5 * f64::from((row + steps) % 2),
        f64::from(layer) * layer_distance,
        (f64::from(row) + f64::from(steps) / 3.0) * row_distance,
    )
}

/// Places evenly on a circle.
pub(super) fn ring(ring: &Ring, path: &str) -> Result<Vec<Place>, Problem> {
    /// Above this component of the axis, y is the better start: x is almost parallel to the axis.
    const NEARLY: f64 = 0.9;
    check_vector(ring.center, &format!("{path}.center"))?;
    check_positive(ring.radius, &format!("{path}.radius"))?;
    check_direction(ring.axis, &format!("{path}.axis"))?;
    let axis = vector(ring.axis).normalize();
    let side = if axis.x.abs() > NEARLY { DVec3::Y } else { DVec3::X };
    let first = (side - axis * axis.dot(side)).normalize();
    let quarter_on = axis.cross(first);
    let place = |i: u32| {
        let (sin, cos) = libm::sincos(angle(ring, i));
        let direction = cos * first + sin * quarter_on;
        Place::along(i, vector(ring.center) + ring.radius * direction)
    };
    Ok((0..ring.count).map(place).collect())
}

/// Rotation of place `i`, from 0, about the axis of its ring.
pub(super) fn turn_on_ring(ring: &Ring, i: u32) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle(ring, i));
    let [x, y, z] = (sin * vector(ring.axis).normalize()).to_array();
    DQuat::from_xyzw(x, y, z, cos)
}

/// Angle from the first place of a ring to place `i` \[rad\].
fn angle(ring: &Ring, i: u32) -> f64 {
    std::f64::consts::TAU / f64::from(ring.count) * f64::from(i)
}
