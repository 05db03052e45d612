//! Verdicts.

use std::collections::BTreeSet;

use serde::{Serialize, Serializer};

use crate::contact::ContactKind;
use crate::course::Course;
use crate::estimate::Candidate;
use crate::fit::{Departed, Fit};
use crate::mistake::{Mistake, Mistakes};
use crate::program::Program;
use crate::quantity::WrongNumber;
use crate::recorded::Recorded;
use crate::scatter::Scatter;
use crate::tracks::{Key, Touch, Tracks};

/// Fraction of the rows after the departure that a cause must explain to be named.
const CONVINCING: f64 = 0.5;

/// Relative difference of residuals that is chance.
const CHANCE: f64 = 0.01;

/// Most candidates that are looked at more closely.
const LOOKED_AT: usize = 8;

/// Fraction of the scene's duration; if a table ends earlier, the verdict contains a note.
const WHOLE: f64 = 0.9;

/// Most explanations in a verdict: the best, and two others.
const LISTED: usize = 3;

/// Result of grading a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Name of the scene.
    pub scene: String,
    /// Whether the run agrees with the course's rule, in whatever form.
    pub same: bool,
    /// Differences of the table's form from that of the course, such as mirrored axes.
    pub form: Vec<String>,
    /// Scatter of the positions, as that of measured ones.
    pub scatter: Option<Scatter>,
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
    /// Whether the first explanation explains the departure, and is not only the nearest.
    pub explained: bool,
    /// Known mistakes and wrong numbers, the best fit first.
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
    /// Number of contacts of the ball before that are right.
    pub contacts_right: usize,
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

/// Known mistakes and wrong numbers of a program.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// One mistake, or two, or none.
    #[serde(serialize_with = "one_by_one")]
    pub mistakes: Mistakes,
    /// Wrong numbers.
    pub numbers: Vec<WrongNumber>,
}

impl Cause {
    fn of(program: &Program, course: &Course) -> Self {
        let numbers = program.numbers.iter().map(|it| WrongNumber::of(it, course)).collect();
        Self { mistakes: program.mistakes, numbers }
    }
}

/// What may explain a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// Mistakes and wrong numbers.
    #[serde(flatten)]
    pub cause: Cause,
    /// Other causes whose runs this table does not distinguish.
    pub same_as: Vec<Cause>,
    /// Comparison with the run of the cause.
    pub fit: Fit,
    /// Fraction of the rows that the cause explains and the course's rule does not.
    pub share: f64,
    /// Whether the cause is only the nearest: the rows that it explains are far off on average, and
    /// agree only because rounding moves such a run far. The cause may be another.
    pub nearest: bool,
    /// Where the run departs from the cause, too.
    pub then: Option<Then>,
}

/// Point where a run departs from a program that explains it so far.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Then {
    /// Time \[s\].
    pub time: f64,
    /// Label of the ball.
    pub ball: String,
    /// Contact of the ball at that point.
    pub contact: Option<DepartureContact>,
    /// Number of that contact, or of the last before, from 1; 0 if there was none.
    pub number: usize,
}

impl Explanation {
    /// `tolerance`: allowed error \[m\], without that by rounding.
    pub(crate) fn new(candidate: Candidate, right: &Fit, tolerance: f64, course: &Course) -> Self {
        let Candidate { program, fit } = candidate;
        let gained = fit.followed as f64 - right.followed as f64;
        let share = (gained / (right.rows - right.followed).max(1) as f64).max(0.0);
        let cause = Cause::of(&program, course);
        let nearest = fit.is_far(tolerance);
        Self { cause, same_as: Vec::new(), fit, share, nearest, then: None }
    }

    /// Whether the causes explain so much that they are named.
    pub(crate) fn convinces(&self) -> bool {
        self.share >= CONVINCING
    }

    /// Describes what the program does, in sentences.
    pub fn sentence(&self) -> String {
        let sentences: Vec<&str> = self.cause.mistakes.iter().map(Mistake::sentence).collect();
        sentences.join(" ")
    }
}

/// Whether a table does not distinguish two programs.
fn is_same(a: &Fit, b: &Fit) -> bool {
    let (own, other) = (a.residual, b.residual);
    a.followed == b.followed && (own - other).abs() <= CHANCE * own.max(other) + 1e-9
}

/// The best of some candidates: among those that the table does not distinguish, the simplest.
pub(crate) fn best(all: &[Candidate]) -> Option<&Candidate> {
    let best = all.iter().reduce(|a, b| if b.fit.is_better_than(&a.fit) { b } else { a })?;
    let simplest = |it: &&Candidate| (it.program.causes(), it.program.numbers.len());
    all.iter().filter(|it| is_same(&it.fit, &best.fit)).min_by_key(simplest)
}

/// Orders candidates, the best first, and keeps some.
pub(crate) fn listed(mut all: Vec<Candidate>) -> Vec<Candidate> {
    let mut listed = Vec::new();
    while let Some(best) = best(&all) {
        if listed.len() == LOOKED_AT {
            break;
        }
        let program = best.program.clone();
        let place = all.iter().position(|it| it.program == program).unwrap_or(0);
        listed.push(all.remove(place));
    }
    listed
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
    /// Differences of the table's form from that of the course.
    pub form: Vec<String>,
    pub scatter: Option<Scatter>,
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
        let same = fit.is_complete() && parts.scatter.is_none();
        let times = [recorded.rows.first(), recorded.rows.last()];
        let mut explanations = grouped(parts.explanations.clone());
        if let (Some(best), Some(tracks)) = (explanations.first_mut(), parts.explaining) {
            best.then = best.fit.departure.as_ref().map(|it| then(&parts, tracks, it));
        }
        let explained = explanations.first().is_some_and(|it| !it.nearest);
        let departure = fit.departure.as_ref().map(|it| departure(&parts, it));
        let found = fit.max.is_finite() && fit.followed > 0;
        Self {
            scene: course.name.clone(),
            same,
            form: parts.form.clone(),
            scatter: parts.scatter,
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
        match listed.iter().position(|it| is_same(&it.fit, &explanation.fit)) {
            Some(place) => listed[place].same_as.push(explanation.cause),
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
    let span = [since, row.time];
    let contact = contact_at(parts, parts.reference, key, span);
    let by_mistake = || {
        let contact = contact_at(parts, parts.explaining?, key, span)?;
        Some(DepartureContact { only_by_mistake: true, ..contact })
    };
    let before = contact.as_ref().map_or(row.time, |it| it.time - 0.5 * parts.course.frame_time);
    Departure {
        time: departed.time,
        ball: label.clone(),
        line: departed.line,
        position: row.position.to_array(),
        expected: departed.expected,
        distance: departed.distance,
        contacts_right: contacts_until(parts.reference, key, row.time, before),
        contact: contact.or_else(by_mistake),
    }
}

/// Point where a run departs from `tracks`, the best explanation.
fn then(parts: &Parts, tracks: &Tracks, departed: &Departed) -> Then {
    let row = &parts.recorded.rows[departed.row];
    let since = departed.before.map_or(0.0, |row| parts.recorded.rows[row].time);
    let key = parts.keys[row.label];
    let contact = contact_at(parts, tracks, key, [since, row.time]);
    let until = contact.as_ref().map_or(row.time, |it| it.time);
    Then {
        time: departed.time,
        ball: parts.recorded.labels[row.label].clone(),
        contact,
        number: contacts_until(tracks, key, row.time, until),
    }
}

/// Contact of a ball that can affect the last of two successive times of it.
fn contact_at(
    parts: &Parts,
    tracks: &Tracks,
    key: Key,
    span: [f64; 2],
) -> Option<DepartureContact> {
    let touch = last_touch(tracks, key, span, parts.course.frame_time)?;
    let collider = parts.course.colliders[touch.surface].name.clone();
    let time = tracks.times[touch.frame];
    Some(DepartureContact { time, kind: touch.kind, collider, only_by_mistake: false })
}

/// Number of contacts up to a time \[s\] of the ball that has a key at another time. Contacts in
/// successive frames are one.
fn contacts_until(tracks: &Tracks, key: Key, there: f64, until: f64) -> usize {
    let ball = ball_at(tracks, key, there);
    let own = tracks.touches.iter().filter(|it| Some(it.ball) == ball);
    let frames: Vec<usize> =
        own.map(|it| it.frame).filter(|frame| tracks.times[*frame] <= until + 1e-9).collect();
    let follows = frames.windows(2).filter(|it| it[1] <= it[0] + 1).count();
    frames.len() - follows
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
    if recorded.seen.min_element() == 0.0 {
        notes.push("the table has no z: only x and y are compared".to_owned());
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
