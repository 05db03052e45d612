//! Table with a row for each run.

use std::path::Path;

use carom_grade::Verdict;

use super::row::Row;
use crate::failure::{Failure, unwritable, unwritable_table};

/// Columns of the file.
const COLUMNS: [&str; 16] = [
    "run",
    "scene",
    "result",
    "digits",
    "largest_difference_m",
    "departs_at_s",
    "ball",
    "line",
    "distance_m",
    "contact",
    "mistake",
    "explains",
    "residual_m",
    "runners_up",
    "notes",
    "error",
];

/// Writes the file.
pub fn write(path: &Path, rows: &[Row]) -> Result<(), Failure> {
    let failed = |error| unwritable_table(path, error);
    let mut table = csv::Writer::from_path(path).map_err(failed)?;
    table.write_record(COLUMNS).map_err(failed)?;
    for row in rows {
        table.write_record(record(row)).map_err(failed)?;
    }
    table.flush().map_err(|error| unwritable(path, &error))
}

fn record(row: &Row) -> [String; COLUMNS.len()] {
    let text = |value: Option<String>| value.unwrap_or_default();
    let verdict = row.verdict.as_ref();
    let departure = verdict.and_then(|it| it.departure.as_ref());
    let number = |value: f64| format!("{value:.6e}");
    let best = verdict.and_then(|it| it.explanations.first());
    let others = verdict.map(|it| &it.explanations).into_iter().flatten();
    let others: Vec<String> = others.skip(1).map(|it| it.in_a_table()).collect();
    [
        row.run.display().to_string(),
        text(verdict.map(|it| it.scene.clone())),
        result(row).to_owned(),
        text(verdict.and_then(|it| it.digits).map(|it| it.to_string())),
        text(verdict.map(|it| number(it.fit.max))),
        text(departure.map(|it| it.time.to_string())),
        text(departure.map(|it| it.ball.clone())),
        text(departure.map(|it| it.line.to_string())),
        text(departure.and_then(|it| it.distance).map(number)),
        departure.map_or(String::new(), |_| contact(verdict)),
        text(best.map(|it| it.in_a_table())),
        text(best.map(|it| format!("{:.4}", it.share))),
        text(best.map(|it| number(it.fit.rms))),
        others.join("; "),
        text(verdict.map(|it| it.notes.join("; "))),
        text(row.error.clone()),
    ]
}

/// Cells of a run in the printed table.
pub fn cells(row: &Row) -> [String; 7] {
    let verdict = row.verdict.as_ref();
    let departure = verdict.and_then(|it| it.departure.as_ref());
    let best = verdict.and_then(|it| it.explanations.first());
    let fit = best.map(|it| &it.fit).or(verdict.map(|it| &it.fit));
    [
        row.run.display().to_string(),
        verdict.map_or(String::new(), |it| it.scene.clone()),
        match verdict.and_then(|it| it.digits).filter(|_| result(row) == "same") {
            Some(digits) => format!("same, {digits} digits"),
            None => result(row).to_owned(),
        },
        departure.map_or(String::new(), |it| format!("{:.2}", it.time)),
        departure.map_or(String::new(), |_| contact(verdict)),
        best.map_or(String::new(), |it| it.in_a_table()),
        fit.map_or(String::new(), |it| format!("{:.1} %", 100.0 * it.part())),
    ]
}

fn result(row: &Row) -> &'static str {
    match &row.verdict {
        Some(verdict) if verdict.same => "same",
        Some(verdict) if verdict.departure.is_some() => "departs",
        Some(verdict) if verdict.fit.followed > 0 => "same in part",
        Some(_) => "not compared",
        None => "error",
    }
}

fn contact(verdict: Option<&Verdict>) -> String {
    let departure = verdict.and_then(|it| it.departure.as_ref());
    let contact = departure.and_then(|it| it.contact.as_ref());
    contact.map_or("none".to_owned(), |it| format!("{} of {}", it.kind, it.collider))
}
