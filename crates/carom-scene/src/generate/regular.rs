//! Spheres in regular order.

use carom::DVec3;

use super::count::check_spheres;
use crate::error::Problem;
use crate::requirement::{check_direction, check_positive, check_vector};
use crate::scene::values::vector;
use crate::scene::{Stacking, Vector};

/// Centres \[m\] along a line.
pub(super) fn row(
    count: u32,
    [start, step]: [Vector; 2],
    path: &str,
) -> Result<Vec<DVec3>, Problem> {
    check_spheres(count.into(), &format!("{path}.count"))?;
    check_vector(start, &format!("{path}.start"))?;
    check_vector(step, &format!("{path}.step"))?;
    let (start, step) = (vector(start), vector(step));
    Ok((0..count).map(|i| start + f64::from(i) * step).collect())
}

/// Centres \[m\] on a box-shaped lattice.
pub(super) fn lattice(
    counts: [u32; 3],
    [start, spacing]: [Vector; 2],
    path: &str,
) -> Result<Vec<DVec3>, Problem> {
    check_vector(start, &format!("{path}.start"))?;
    check_vector(spacing, &format!("{path}.spacing"))?;
    let (start, spacing) = (vector(start), vector(spacing));
    let [nx, ny, nz] = counts;
    let cells = (0..nz).flat_map(|z| (0..ny).map(move |y| (y, z)));
    let cells = cells.flat_map(|(y, z)| (0..nx).map(move |x| [x, y, z].map(f64::from)));
    Ok(cells.map(|cell| start + DVec3::from_array(cell) * spacing).collect())
}

/// Centres \[m\] of a close packing, whose neighbours are this far apart, layer by layer.
pub(super) fn close_packing(
    counts: [u32; 3],
    stacking: Stacking,
    (start, spacing): (Vector, f64),
    path: &str,
) -> Result<Vec<DVec3>, Problem> {
    check_vector(start, &format!("{path}.start"))?;
    let start = vector(start);
    let [nx, ny, nz] = counts;
    let rows = (0..ny).flat_map(|layer| (0..nz).map(move |row| [layer, row]));
    let rows = rows.map(|row| start + spacing * row_of_packing(row, stacking));
    let along = |row: DVec3| (0..nx).map(move |x| row + spacing * f64::from(x) * DVec3::X);
    Ok(rows.flat_map(along).collect())
}

/// Where a row of a close packing begins whose neighbours are one apart.
fn row_of_packing([layer, row]: [u32; 2], stacking: Stacking) -> DVec3 {
    // A sphere of a layer lies over the middle of a triangle of the layer below: half a sphere on in
    // its row, and a third of the way to the next. The second such step comes back in the row.
    let steps = layer
        % match stacking {
            Stacking::Hcp => 2,
            Stacking::Fcc => 3,
        };
    let (row_distance, layer_distance) = (0.75_f64.sqrt(), (2.0_f64 / 3.0).sqrt());
    DVec3::new(
        0.5 * f64::from((row + steps) % 2),
        f64::from(layer) * layer_distance,
        (f64::from(row) + f64::from(steps) / 3.0) * row_distance,
    )
}

/// Centres \[m\] evenly on a circle with this centre and radius.
pub(super) fn ring(
    count: u32,
    (center, radius): (Vector, f64),
    axis: Vector,
    path: &str,
) -> Result<Vec<DVec3>, Problem> {
    /// Beyond this, the axis is nearly along x: the circle hardly reaches to that side.
    const NEARLY: f64 = 0.9;
    check_spheres(count.into(), &format!("{path}.count"))?;
    check_vector(center, &format!("{path}.center"))?;
    check_positive(radius, &format!("{path}.radius"))?;
    check_direction(axis, &format!("{path}.axis"))?;
    let axis = vector(axis).normalize();
    let side = if axis.x.abs() > NEARLY { DVec3::Y } else { DVec3::X };
    let first = (side - axis * axis.dot(side)).normalize();
    let quarter_on = axis.cross(first);
    let turn = std::f64::consts::TAU / f64::from(count);
    let directions = (0..count).map(|i| libm::sincos(turn * f64::from(i)));
    let directions = directions.map(|(sin, cos)| cos * first + sin * quarter_on);
    Ok(directions.map(|direction| vector(center) + radius * direction).collect())
}
