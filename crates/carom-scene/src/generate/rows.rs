//! Staggered rows.

use super::place::Place;
use crate::error::Problem;
use crate::requirement::{check, check_vector};
use crate::scene::StaggeredRows;
use crate::scene::values::vector;

/// Places in staggered rows, numbered by row and place in the row.
pub(super) fn staggered(rows: &StaggeredRows, path: &str) -> Result<Vec<Place>, Problem> {
    check(rows.counts.iter().all(|&count| count > 0), &format!("{path}.counts"), || {
        format!("must be at least 1 each, not {:?}", rows.counts)
    })?;
    check_vector(rows.start, &format!("{path}.start"))?;
    check_vector(rows.step, &format!("{path}.step"))?;
    check_vector(rows.row_step, &format!("{path}.row_step"))?;
    let [start, step, row_step] = [rows.start, rows.step, rows.row_step].map(vector);
    let place = |row: u32, count: u32, i: u32| {
        let shift = 0.5 * (f64::from(rows.counts[0]) - f64::from(count));
        let center = start + f64::from(row) * row_step + (shift + f64::from(i)) * step;
        Place { center, numbers: [row + 1, i + 1, 0] }
    };
    let all = (0..rows.rows).zip(rows.counts.iter().cycle());
    Ok(all.flat_map(|(row, &count)| (0..count).map(move |i| place(row, count, i))).collect())
}
