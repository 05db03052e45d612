//! Table columns with the work per impact.

use crate::stage_work::StageWork;
use crate::table::Side;

/// Names of the columns: the stages that take most time if spheres collide in pairs.
pub const NAMES: [(&str, Side); 3] = [
    ("predictions/impact", Side::Right),
    ("pair tests/impact", Side::Right),
    ("cell crossings/impact", Side::Right),
];

/// Texts of a row, one per column.
pub fn texts(work: Option<StageWork<f64>>) -> [String; NAMES.len()] {
    let counts = |work: StageWork<f64>| [work.predictions, work.pair_tests, work.cell_crossings];
    match work.map(counts) {
        Some(counts) => counts.map(|count| format!("{count:.2}")),
        None => NAMES.map(|_| "-".to_owned()),
    }
}
