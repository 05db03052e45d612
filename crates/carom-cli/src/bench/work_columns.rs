//! Columns of a table that tell the work of an impact.

use crate::stage_work::StageWork;
use crate::table::Side;

/// Names of the columns: the stages that take most of the time where spheres meet one by one.
pub const NAMES: [(&str, Side); 3] = [
    ("predictions/impact", Side::Right),
    ("pair tests/impact", Side::Right),
    ("cell crossings/impact", Side::Right),
];

/// The texts of a row, one for each column.
pub fn texts(work: Option<StageWork<f64>>) -> [String; NAMES.len()] {
    let counts = |work: StageWork<f64>| [work.predictions, work.pair_tests, work.cell_crossings];
    match work.map(counts) {
        Some(counts) => counts.map(|count| format!("{count:.2}")),
        None => NAMES.map(|_| "-".to_owned()),
    }
}
