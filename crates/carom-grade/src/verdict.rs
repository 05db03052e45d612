//! Verdicts.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use serde::{Serialize, Serializer};

use crate::contact::ContactKind;
use crate::course::Course;
use crate::fit::{Departed, Fit};
use crate::mistake::{Mistake, Mistakes};
use crate::recorded::Recorded;
use crate::tracks::{Key, Touch, Tracks};

/// Fraction of the rows after the departure that a mistake must explain to be named as the cause.
const CONVINCING: f64 = 0.25;

/// Fraction of the scene's duration; if a table ends earlier, the verdict contains a note.
const WHOLE: f64 = 0.9;

/// Most explanations in a verdict: the best, and two others.
const LISTED: usize = 3;

/// Result of grading a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Name of the scene.
    pub scene: String,
    /// Whether the run agrees with the course's rule.
    pub same: bool,
    /// Allowed error of positions \[m\], in addition to rounding in single precision.
    pub tolerance: f64,
    /// Number of balls in the table.
    pub balls: usize,
    /// First and last time \[s\].
    pub time: [f64; 2],
    /// Time up to which the run was compared \[s\], if that is before its end.
    pub compared_until: Option<f64>,
    /// Comparison with the course's rule.
    pub fit: Fit,
    /// Number of digits to which positions agree; digits after the point within 1 m of the origin.
    pub digits: Option<i32>,
    /// First departure.
    pub departure: Option<Departure>,
    /// Whether the first explanation explains the departure.
    pub explained: bool,
    /// Known mistakes, the best fit first.
    pub explanations: Vec<Explanation>,
    /// Additional notes.
    pub notes: Vec<String>,
}

/// Point where a run departs from the course's rule.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Departure {
    /// Time \[s\].
    pub time: f64,
    /// Label of the ball.
    pub ball: String,
    /// Line of the table.
    pub line: u64,
    /// Position of the ball in the table \[m\].
    pub position: [f64; 3],
    /// Position of the ball under the course's rule \[m\]; `None` if it does not have the ball.
    pub expected: Option<[f64; 3]>,
    /// Distance between the two \[m\].
    pub distance: Option<f64>,
    /// Contact of the ball at that point.
    pub contact: Option<DepartureContact>,
}

/// Contact at which a run departs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DepartureContact {
    /// Time \[s\].
    pub time: f64,
    /// Part of the collider.
    pub kind: ContactKind,
    /// Name of the collider.
    pub collider: String,
    /// Whether only the mistake that explains the run causes this contact.
    pub only_by_mistake: bool,
}

/// A known mistake that may explain a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// One mistake, or two.
    #[serde(serialize_with = "one_by_one")]
    pub mistakes: Mistakes,
    /// Mistakes whose runs are identical in all rows.
    pub same_as: Vec<Mistake>,
    /// Comparison with the run of the mistake.
    pub fit: Fit,
    /// Fraction of the rows that the mistake explains and the course's rule does not.
    pub share: f64,
    /// Distance of the departing ball directly after the departure \[m\].
    pub distance_after: f64,
}

impl Explanation {
    pub(crate) fn new(mistakes: Mistakes, fit: Fit, right: &Fit, distance_after: f64) -> Self {
        let gained = fit.followed as f64 - right.followed as f64;
        let share = gained / (right.rows - right.followed).max(1) as f64;
        Self { mistakes, same_as: Vec::new(), fit, share: share.max(0.0), distance_after }
    }

    /// Orders the better explanation first: the one that agrees longer; among equal ones, the
    /// nearer one. Nearness is measured over all rows if they agree longer than the course's rule,
    /// else directly after the departure.
    pub(crate) fn compare(&self, other: &Self) -> Ordering {
        let nearer = match self.share > 0.0 {
            true => self.fit.residual.total_cmp(&other.fit.residual),
            false => self.distance_after.total_cmp(&other.distance_after),
        };
        other.fit.followed.cmp(&self.fit.followed).then(nearer)
    }

    /// Whether this run does not distinguish the two.
    fn is_same_as(&self, other: &Self) -> bool {
        let (a, b) = (self.fit.residual, other.fit.residual);
        let (near_a, near_b) = (self.distance_after, other.distance_after);
        self.fit.followed == other.fit.followed
            && (a - b).abs() <= 1e-9 * a.max(1e-6)
            && (near_a - near_b).abs() <= 1e-9
    }

    /// Describes what the program does, in sentences.
    pub fn sentence(&self) -> String {
        let sentences: Vec<&str> = self.mistakes.iter().map(Mistake::sentence).collect();
        sentences.join(" ")
    }
}

fn one_by_one<S: Serializer>(mistakes: &Mistakes, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(mistakes.iter())
}

/// Data from which a verdict is created.
pub(crate) struct Parts<'a> {
    pub course: &'a Course,
    pub recorded: &'a Recorded,
    pub keys: &'a [Key],
    pub reference: &'a Tracks,
    pub fit: Fit,
    /// Offset of the table's clock \[frames\].
    pub shift: Option<i32>,
    /// Whether the run agrees better with z mirrored.
    pub is_mirrored: bool,
    /// Time \[s\] from which rounding moves a ball far, and the distance \[m\].
    pub rounding: Option<[f64; 2]>,
    /// Explanations that are better than the course's rule, the best first.
    pub explanations: Vec<Explanation>,
    /// Run of the first explanation.
    pub explaining: Option<&'a Tracks>,
    /// Allowed error of positions \[m\]: as requested, or larger if the table has few decimals.
    pub tolerance: f64,
    /// Requested tolerance \[m\].
    pub asked: f64,
}

impl Verdict {
    pub(crate) fn of(parts: Parts) -> Self {
        let Parts { course, recorded, fit, tolerance, .. } = &parts;
        let same = fit.is_complete();
        let times = [recorded.rows.first(), recorded.rows.last()];
        let explanations = if same { Vec::new() } else { grouped(parts.explanations.clone()) };
        let explained = explanations.first().is_some_and(|it| it.share >= CONVINCING);
        let departure = fit.departure.as_ref().map(|it| departure(&parts, it));
        let found = fit.max.is_finite() && fit.followed > 0;
        Self {
            scene: course.name.clone(),
            same,
            tolerance: *tolerance,
            balls: recorded.labels.len(),
            time: times.map(|row| row.map_or(0.0, |row| row.time)),
            compared_until: compared_until(&parts),
            digits: found.then(|| digits(fit.max_relative)),
            departure,
            explained,
            explanations,
            notes: notes(&parts),
            fit: parts.fit,
        }
    }
}

/// Number of digits that agree at this relative difference.
fn digits(difference: f64) -> i32 {
    (0..=15).take_while(|digits| difference <= 0.5 * 10_f64.powi(-digits)).last().unwrap_or(0)
}

/// Returns the best explanations; merges those that this run does not distinguish.
fn grouped(found: Vec<Explanation>) -> Vec<Explanation> {
    let mut listed: Vec<Explanation> = Vec::new();
    for explanation in found {
        let is_same = |it: &Explanation| it.mistakes.len() == 1 && it.is_same_as(&explanation);
        match listed.iter().position(is_same) {
            Some(place) => listed[place].same_as.extend(explanation.mistakes.iter()),
            None if listed.len() == LISTED => break,
            None => listed.push(explanation),
        }
    }
    listed
}

fn departure(parts: &Parts, departed: &Departed) -> Departure {
    let row = &parts.recorded.rows[departed.row];
    let label = &parts.recorded.labels[row.label];
    let since = departed.before.map_or(0.0, |row| parts.recorded.rows[row].time);
    let key = parts.keys[row.label];
    let contact = |tracks: &Tracks, only_by_mistake: bool| {
        let touch = last_touch(tracks, key, [since, row.time], parts.course.frame_time)?;
        let collider = parts.course.colliders[touch.surface].name.clone();
        let time = tracks.times[touch.frame];
        Some(DepartureContact { time, kind: touch.kind, collider, only_by_mistake })
    };
    let by_mistake = || parts.explaining.and_then(|tracks| contact(tracks, true));
    Departure {
        time: departed.time,
        ball: label.clone(),
        line: departed.line,
        position: row.position.to_array(),
        expected: departed.expected,
        distance: departed.distance,
        contact: contact(parts.reference, false).or_else(by_mistake),
    }
}

/// Finds the last contact of a ball that can affect a row: after the previous row, or one frame
/// before it, because the response shows a frame later.
fn last_touch(tracks: &Tracks, key: Key, [since, until]: [f64; 2], h: f64) -> Option<&Touch> {
    let (first, last) = (since - 1.5 * h, until + 0.5 * h);
    let is_it = |touch: &&Touch| {
        let time = tracks.times[touch.frame];
        first < time && time < last && tracks.ball(key, touch.frame) == Some(touch.ball)
    };
    tracks.touches.iter().rev().find(is_it)
}

fn notes(parts: &Parts) -> Vec<String> {
    let Parts { course, recorded, reference, keys, .. } = parts;
    let mut notes = Vec::new();
    if let Some(frames) = parts.shift {
        let seconds = f64::from(frames) * course.frame_time;
        notes.push(format!(
            "the clock of the table is off: the run is the same with {seconds:+.3} s added to its times"
        ));
    }
    if parts.is_mirrored {
        let unity = "is it in Unity's coordinates (--unity), or was that said of one that is not?";
        notes.push(format!(
            "with z mirrored the run follows the course's rule much longer: {unity}"
        ));
    }
    if let Some([since, most]) = parts.rounding {
        notes.push(format!(
            "from {since:.2} s on rounding alone moves a ball by up to {most:.1e} m: it may be off by four times \
             that"
        ));
    }
    if parts.tolerance > parts.asked {
        let (tolerance, asked) = (parts.tolerance, parts.asked);
        notes.push(format!(
            "places have so few decimals that they may be off by {tolerance:.1e} m, not only by {asked:.1e} m"
        ));
    }
    let is_between = |time: &&f64| reference.frame_at(**time).is_some_and(|(_, part)| part > 0.0);
    let times = recorded.times();
    let between = times.iter().filter(is_between).count();
    if between > 0 {
        notes.push(format!(
            "{between} of {} times are not ends of frames of {} s: the reference is interpolated there",
            times.len(),
            course.frame_time
        ));
    }
    let there: BTreeSet<usize> = recorded
        .rows
        .iter()
        .filter_map(|row| ball_at(reference, keys[row.label], row.time))
        .collect();
    let missing =
        reference.births_until(recorded.end()).filter(|ball| !there.contains(ball)).count();
    if missing > 0 {
        let are =
            if missing == 1 { "ball of the reference is" } else { "balls of the reference are" };
        notes.push(format!("{missing} {are} not in the table"));
    }
    let (end, duration) = (recorded.end(), course.duration);
    if end < WHOLE * duration {
        notes.push(format!("only the first {end:.2} s of {duration} s are in the table"));
    }
    if let Some(end) = compared_until(parts) {
        notes.push(format!("the run is longer than what is compared: {end} s"));
    }
    notes
}

/// End of the course's run \[s\], if it is before the end of the table.
fn compared_until(parts: &Parts) -> Option<f64> {
    let end = parts.reference.times.last().copied();
    end.filter(|end| *end < parts.recorded.end())
}

fn ball_at(reference: &Tracks, key: Key, time: f64) -> Option<usize> {
    let (frame, part) = reference.frame_at(time)?;
    reference.ball(key, frame + usize::from(part > 0.0))
}
