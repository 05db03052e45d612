//! Spheres in regular order.

use carom::DVec3;

use super::check_count;
use crate::error::Problem;
use crate::requirement::check_vector;
use crate::scene::Vector;
use crate::scene::values::vector;

/// Centres \[m\] along a line.
pub(super) fn row(
    count: u32,
    [start, step]: [Vector; 2],
    path: &str,
) -> Result<Vec<DVec3>, Problem> {
    check_count(count.into(), &format!("{path}.count"))?;
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
