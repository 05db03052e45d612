//! Other forms in which a table may hold a right run: axes exchanged or mirrored, other units,
//! another zero of time or place.

use carom::DVec3;

use crate::recorded::{Recorded, Row};
use crate::tracks::{Key, Tracks};

/// Orders of the axes.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [2, 1, 0], [1, 2, 0], [2, 0, 1]];

/// Units of length \[m\], with the name in which they are written.
const LENGTHS: [(f64, &str); 6] =
    [(1.0, "m"), (0.01, "cm"), (1e-3, "mm"), (0.0254, "in"), (0.3048, "ft"), (1e3, "km")];

/// Rows at the start of a ball that a form must bring near the rule.
const EARLY: usize = 8;

/// Rows of the whole table that are compared first.
const SAMPLED: usize = 60;

/// Most frames by which the zero of time may differ: some lengths of a scene.
const MOST_FRAMES: usize = 2_000;

/// Forms that are compared in full.
const LISTED: usize = 6;

/// A way to write a run: the course's form is computed from that of the table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Form {
    /// Axis of the table for each axis of the course.
    axes: [usize; 3],
    /// Sign of each axis.
    signs: DVec3,
    /// Unit of length \[m\].
    length: f64,
    /// Unit of time, in units of the table as it was read.
    pub time: f64,
    /// Added to all times \[s\].
    pub later: f64,
    /// Added to all positions \[m\].
    offset: DVec3,
}

impl Form {
    /// The form of the course.
    pub const SAME: Self = Self {
        axes: [0, 1, 2],
        signs: DVec3::ONE,
        length: 1.0,
        time: 1.0,
        later: 0.0,
        offset: DVec3::ZERO,
    };

    /// The form of the course but for the unit of time.
    pub fn of_time(time: f64) -> Self {
        Self { time, ..Self::SAME }
    }

    /// The form of the course but for the zero of time \[s\].
    pub fn shifted(later: f64) -> Self {
        Self { later, ..Self::SAME }
    }

    fn position(&self, there: DVec3) -> DVec3 {
        let turned = DVec3::from_array(self.axes.map(|axis| there[axis]));
        turned * self.signs * self.length + self.offset
    }

    /// Distance of a row from the rule in the coordinates that the table has, at most 1 m.
    fn distance(&self, row: &Row, seen: DVec3, keys: &[Key], rule: &Tracks) -> f64 {
        let seen = DVec3::from_array(self.axes.map(|axis| seen[axis]));
        let there = rule.sample(keys[row.label], row.time * self.time + self.later);
        let apart = |there: DVec3| ((there - self.position(row.position)) * seen).length();
        there.map_or(1.0, |it| apart(it.position).min(1.0))
    }

    /// Converts a run from this form to that of the course.
    pub fn apply(&self, recorded: &Recorded) -> Recorded {
        let mut own = recorded.clone();
        own.seen = DVec3::from_array(self.axes.map(|axis| recorded.seen[axis]));
        own.resolution *= self.length;
        for row in &mut own.rows {
            row.position = self.position(row.position) * own.seen;
            row.time = row.time * self.time + self.later;
            let turned = |it: DVec3| DVec3::from_array(self.axes.map(|axis| it[axis])) * self.signs;
            row.velocity = row.velocity.map(|it| turned(it) * (self.length / self.time));
        }
        own
    }

    /// Unit of length, in units of the table as it was read.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Whether the form has the zeros of time and place that the course has.
    pub fn has_zeros(&self) -> bool {
        self.later == 0.0 && self.offset == DVec3::ZERO
    }

    /// Number of differences from the course's form.
    fn differences(&self) -> usize {
        let mirrored = (0..3).filter(|axis| self.signs[*axis] < 0.0).count();
        let moved = (0..3).filter(|axis| self.axes[*axis] != *axis).count();
        let of = [self.length, self.time].iter().filter(|it| **it != 1.0).count();
        let zeros = usize::from(self.later != 0.0) + usize::from(self.offset != DVec3::ZERO);
        mirrored + moved + of + 2 * zeros
    }

    /// Describes the differences, each with the option that reads them.
    pub fn words(&self, frame_time: f64) -> Vec<String> {
        let names = ["x", "y", "z"];
        let mut words = Vec::new();
        let moved: Vec<usize> = (0..3).filter(|axis| self.axes[*axis] != *axis).collect();
        if !moved.is_empty() {
            let columns: Vec<String> = moved
                .iter()
                .map(|axis| format!("{}={}", names[*axis], names[self.axes[*axis]]))
                .collect();
            let columns = columns.join(",");
            let of: Vec<&str> = moved.iter().map(|axis| names[*axis]).collect();
            words.push(match of.as_slice() {
                [first, second] => format!("{first} and {second} swapped (--columns {columns})"),
                _ => format!("x, y and z in another order (--columns {columns})"),
            });
        }
        for (name, sign) in names.iter().zip(self.signs.to_array()) {
            if sign < 0.0 {
                let option = if *name == "z" { " (--unity)" } else { "" };
                words.push(format!("{name} mirrored{option}"));
            }
        }
        if let Some((_, name)) = LENGTHS[1..].iter().find(|it| it.0 == self.length) {
            words.push(format!("lengths in {name} (--length-unit {name})"));
        }
        if self.time != 1.0 {
            let (name, option) = match self.time {
                time if time == frame_time => ("frames", "frames"),
                1e-3 => ("milliseconds", "ms"),
                _ => ("minutes", "min"),
            };
            words.push(format!("time in {name} (--time-unit {option})"));
        }
        if self.later != 0.0 {
            let later = self.later;
            words.push(format!("{later:+.3} s added to its times (--time-offset {later:.3})"));
        }
        if self.offset != DVec3::ZERO {
            let [x, y, z] = self.offset.to_array();
            words.push(format!("({x:.4}, {y:.4}, {z:.4}) m added to its positions"));
        }
        words
    }
}

/// Units of time that a table may have, in units as it was read.
pub(crate) fn times(frame_time: f64) -> [f64; 4] {
    [1.0, frame_time, 1e-3, 60.0]
}

/// Finds the forms with this unit of time that bring a run nearest to the rule, the best first.
///
/// A form counts by rows over the whole table, among them the first of the first ball: those of a
/// wrong program are near the rule, too.
pub(crate) fn nearest(recorded: &Recorded, keys: &[Key], rule: &Tracks, time: f64) -> Vec<Near> {
    let sample = Sample::of(recorded);
    let mut found = Vec::new();
    for (length, _) in LENGTHS {
        for axes in ORDERS {
            for bits in 0..8 {
                let sign = |axis: usize| if bits & (1 << axis) == 0 { 1.0 } else { -1.0 };
                let signs = DVec3::new(sign(0), sign(1), sign(2));
                let form = Form { axes, signs, length, time, ..Form::SAME };
                found.push(Near::of(form, &sample, keys, rule));
            }
        }
    }
    found.sort_by(Near::compare);
    found.truncate(LISTED);
    found
}

/// Finds another zero of time, in whole frames, or of place, for a form.
pub(crate) fn zeros(recorded: &Recorded, keys: &[Key], rule: &Tracks, form: &Form) -> Vec<Near> {
    let sample = Sample::of(recorded);
    let h = rule.time(1);
    let most = rule.frames().min(MOST_FRAMES) as i32;
    let shifted = |frames: i32| Form { later: f64::from(frames) * h, ..*form };
    let mut starts: Vec<(f64, i32)> = (-most..=most)
        .filter(|it| *it != 0)
        .map(|frames| (Near::start(&shifted(frames), &sample, keys, rule), frames))
        .collect();
    starts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.abs().cmp(&b.1.abs())));
    let nearest = starts.iter().take(LISTED);
    let all = nearest.map(|it| Near::of(shifted(it.1), &sample, keys, rule));
    let mut found: Vec<Near> = all.min_by(Near::compare).into_iter().collect();
    let apart = sample.early().iter().filter_map(|row| {
        let there = rule.sample(keys[row.label], row.time * form.time)?;
        Some(there.position - form.position(row.position))
    });
    let apart: Vec<DVec3> = apart.collect();
    if let Some(first) = apart.first()
        && apart.iter().all(|it| it.distance(*first) < 1e-3 * first.length())
    {
        let form = Form { offset: *first, ..*form };
        found.push(Near::of(form, &sample, keys, rule));
    }
    found
}

/// Distance of a run in the form of the course.
pub(crate) fn near(recorded: &Recorded, keys: &[Key], rule: &Tracks) -> Near {
    Near::of(Form::SAME, &Sample::of(recorded), keys, rule)
}

/// Orders forms, the nearest first.
pub(crate) fn sorted(mut forms: Vec<Near>) -> Vec<Near> {
    forms.sort_by(Near::compare);
    forms
}

/// Rows that are compared first.
struct Sample<'a> {
    /// The first rows of the first ball, then rows of the whole table.
    rows: Vec<&'a Row>,
    /// 1 for each coordinate that the table has.
    seen: DVec3,
}

impl<'a> Sample<'a> {
    fn of(recorded: &'a Recorded) -> Self {
        let first = recorded.rows.first().map_or(0, |row| row.label);
        let every = recorded.rows.len().div_ceil(SAMPLED).max(1);
        let early = recorded.rows.iter().filter(|row| row.label == first).take(EARLY);
        let rows = early.chain(recorded.rows.iter().step_by(every)).collect();
        Self { rows, seen: recorded.seen }
    }

    fn early(&self) -> &[&'a Row] {
        &self.rows[..self.rows.len().min(EARLY)]
    }
}

/// A form with its distance from the rule.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Near {
    pub form: Form,
    /// Mean distance of the first rows, each limited to 1 m.
    pub early: f64,
    /// Mean distance of all compared rows, each limited to 1 m.
    all: f64,
}

impl Near {
    fn of(form: Form, sample: &Sample, keys: &[Key], rule: &Tracks) -> Self {
        let distance = |row: &&Row| form.distance(row, sample.seen, keys, rule);
        let all = sample.rows.iter().map(distance).sum::<f64>() / sample.rows.len() as f64;
        Self { form, early: Self::start(&form, sample, keys, rule), all }
    }

    /// Mean distance of the first rows, each limited to 1 m.
    fn start(form: &Form, sample: &Sample, keys: &[Key], rule: &Tracks) -> f64 {
        let early = sample.early();
        early.iter().map(|row| form.distance(row, sample.seen, keys, rule)).sum::<f64>()
            / early.len() as f64
    }

    /// Orders the nearer one first; among equal ones, the one with fewer differences.
    fn compare(&self, other: &Self) -> std::cmp::Ordering {
        // A micrometre is rounding.
        let size = |it: &Self| ((it.all + it.early) * 1e6).round();
        let differences = |it: &Self| it.form.differences();
        size(self).total_cmp(&size(other)).then(differences(self).cmp(&differences(other)))
    }
}
