//! Results of claims, as a table or as JSON.

use std::io::{self, Write};
use std::time::Duration;

use serde::Serialize;

use super::claim::{Claim, Outcome};
use crate::args::Verify;
use crate::machine::Machine;
use crate::table::{Side, Table};

/// Result of a claim.
#[derive(Debug, Clone, Serialize)]
pub struct Finding {
    claim: String,
    expected: f64,
    source: &'static str,
    /// `None` if the measurement failed.
    measured: Option<f64>,
    error: Option<f64>,
    tolerance: f64,
    /// Whether error and tolerance are relative to the expected value.
    relative: bool,
    reason: &'static str,
    verdict: Verdict,
    /// Why the measurement failed.
    fault: Option<String>,
    state_hash: Option<String>,
    wall_time: f64,
}

/// Columns of a table of findings; the run time is in seconds.
pub const COLUMNS: [&str; 9] = [
    "claim",
    "expected",
    "measured",
    "deviation",
    "tolerance",
    "kind",
    "run time",
    "source",
    "reason of the tolerance",
];

/// Whether a claim holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
enum Verdict {
    Pass,
    Miss,
}

impl Finding {
    pub fn new(claim: &Claim, outcome: Outcome, elapsed: Duration) -> Self {
        let (expected, tolerance) = (claim.expected, claim.tolerance);
        let measured = outcome.as_ref().ok().map(|it| it.value).filter(|value| value.is_finite());
        let error = measured.map(|value| tolerance.error(value, expected.value));
        let is_exact = outcome.as_ref().is_ok_and(|it| !it.was_stepped);
        let holds = is_exact && error.is_some_and(|error| error <= tolerance.bound);
        let state_hash = outcome.as_ref().ok().map(|measured| measured.state.to_string());
        Self {
            claim: claim.name.clone(),
            expected: expected.value,
            source: expected.source,
            measured,
            error,
            tolerance: tolerance.bound,
            relative: tolerance.is_relative,
            reason: tolerance.reason,
            verdict: if holds { Verdict::Pass } else { Verdict::Miss },
            fault: match (outcome, measured) {
                (Err(fault), _) => Some(fault.to_string()),
                (Ok(_), None) => Some("the measured value is not finite".to_owned()),
                (Ok(_), _) if !is_exact => Some("spheres were stepped: not exact".to_owned()),
                _ => None,
            },
            state_hash,
            wall_time: elapsed.as_secs_f64(),
        }
    }

    fn csv_row(&self) -> [String; COLUMNS.len()] {
        let shown = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
        [
            self.claim.clone(),
            shown(Some(self.expected)),
            shown(self.measured),
            self.error.map_or(String::new(), |error| format!("{error:.1e}")),
            format!("{:?}", self.tolerance),
            (if self.relative { "relative" } else { "absolute" }).to_owned(),
            format!("{:.1}", self.wall_time),
            self.source.to_owned(),
            self.reason.to_owned(),
        ]
    }

    fn row(&self) -> Vec<String> {
        let part = |value: f64| {
            let sign = if self.relative && value != 0.0 { " rel" } else { "" };
            format!("{value:.1e}{sign}")
        };
        vec![
            match self.verdict {
                Verdict::Pass => "pass".to_owned(),
                Verdict::Miss => "MISS".to_owned(),
            },
            self.claim.clone(),
            number(self.expected),
            self.measured.map_or("-".to_owned(), number),
            self.error.map_or("-".to_owned(), part),
            part(self.tolerance),
            self.state_hash.clone().unwrap_or_else(|| "-".to_owned()),
            self.source.to_owned(),
        ]
    }
}

/// Formats a number with the digits that are usual in print.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if value.fract() == 0.0 && size < 1e15 => format!("{value}"),
        size if (1e-3..1e7).contains(&size) => format!("{value:.9}"),
        _ => format!("{value:.3e}"),
    }
}

/// All findings, with the machine.
#[derive(Debug, Serialize)]
pub struct Report<'a> {
    machine: Machine,
    rule: &'a str,
    full: bool,
    long: bool,
    claims: &'a [Finding],
    passed: usize,
    pub missed: usize,
}

impl<'a> Report<'a> {
    pub fn new(args: &'a Verify, findings: &'a [Finding]) -> Self {
        let missed = findings.iter().filter(|finding| finding.verdict == Verdict::Miss).count();
        Self {
            machine: Machine::this(),
            rule: &args.rule,
            full: args.full,
            long: args.long,
            claims: findings,
            passed: findings.len() - missed,
            missed,
        }
    }

    pub fn print(&self, json: bool, csv: bool) -> io::Result<()> {
        let mut out = io::stdout().lock();
        if csv {
            return self.print_csv(out);
        }
        if json {
            serde_json::to_writer_pretty(&mut out, self)?;
            return writeln!(out);
        }
        let (left, right) = (Side::Left, Side::Right);
        let mut table = Table::new(&[
            ("", left),
            ("claim", left),
            ("expected", right),
            ("measured", right),
            ("error", right),
            ("tolerance", right),
            ("end state", left),
            ("source", left),
        ]);
        self.claims.iter().for_each(|finding| table.push(finding.row()));
        table.write(&mut out)?;
        writeln!(out)?;
        for finding in self.claims.iter().filter(|finding| finding.verdict == Verdict::Miss) {
            match &finding.fault {
                Some(fault) => writeln!(out, "MISS {}: {fault}", finding.claim)?,
                None => writeln!(out, "MISS {} (tolerance: {})", finding.claim, finding.reason)?,
            }
        }
        writeln!(out, "{} of {} claims hold, rule {}", self.passed, self.claims.len(), self.rule)?;
        writeln!(out, "{}", self.machine)
    }

    /// Prints a row for each claim, with the columns of [`COLUMNS`].
    fn print_csv(&self, out: impl Write) -> io::Result<()> {
        let mut table = csv::Writer::from_writer(out);
        table.write_record(COLUMNS)?;
        self.claims.iter().try_for_each(|finding| table.write_record(finding.csv_row()))?;
        table.flush()
    }
}
