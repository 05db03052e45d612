//! What grading says.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use serde::{Serialize, Serializer};

use crate::contact::ContactKind;
use crate::course::Course;
use crate::fit::{Departed, Fit};
use crate::mistake::{Mistake, Mistakes};
use crate::recorded::Recorded;
use crate::tracks::{Key, Touch, Tracks};

/// The part of the rows after the departure that a mistake must follow to be named as the cause.
const CONVINCING: f64 = 0.25;

/// A table that ends before this part of the scene's duration is worth a note.
const WHOLE: f64 = 0.9;

/// Explanations that a verdict lists: the best, and two runners-up.
const LISTED: usize = 3;

/// What grading says of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Verdict {
    /// Name of the scene.
    pub scene: String,
    /// Whether the run is the same as that of the course's rule.
    pub same: bool,
    /// How far places may be off \[m\], besides what rounding in single precision does.
    pub tolerance: f64,
    /// How many balls the table has.
    pub balls: usize,
    /// The first and the last time \[s\].
    pub time: [f64; 2],
    /// Until when it is compared \[s\], where that is before its end.
    pub compared_until: Option<f64>,
    /// How the run follows the course's rule.
    pub fit: Fit,
    /// Digits to which places are the same, of the rows that follow; those after the point within 1 m of
    /// the origin.
    pub digits: Option<i32>,
    /// Where it departs first.
    pub departure: Option<Departure>,
    /// Whether the first of the explanations explains it.
    pub explained: bool,
    /// Known mistakes, the one that fits best first.
    pub explanations: Vec<Explanation>,
    /// What else there is to know.
    pub notes: Vec<String>,
}

/// Where a run departs from the course's rule.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Departure {
    /// In s.
    pub time: f64,
    /// What the table calls the ball.
    pub ball: String,
    /// Line of the table.
    pub line: u64,
    /// Where the ball is in the table \[m\].
    pub position: [f64; 3],
    /// Where the course's rule has it \[m\]; `None` where it has no such ball.
    pub expected: Option<[f64; 3]>,
    /// How far apart these are \[m\].
    pub distance: Option<f64>,
    /// What the ball touches there.
    pub contact: Option<DepartureContact>,
}

/// The contact at which a run departs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DepartureContact {
    /// In s.
    pub time: f64,
    /// Part of the collider.
    pub kind: ContactKind,
    /// Name of the collider.
    pub collider: String,
    /// Whether the course's rule has no such contact, only the mistake that explains the run.
    pub only_by_mistake: bool,
}

/// A known mistake, and how a run follows it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Explanation {
    /// One, or two at once.
    #[serde(serialize_with = "one_by_one")]
    pub mistakes: Mistakes,
    /// Mistakes whose runs are the same in all rows.
    pub same_as: Vec<Mistake>,
    /// How the run follows it.
    pub fit: Fit,
    /// The part of the rows that it explains and the course's rule does not.
    pub share: f64,
    /// How far off the ball that departs is right after its departure \[m\].
    pub distance_after: f64,
}

impl Explanation {
    pub(crate) fn new(mistakes: Mistakes, fit: Fit, right: &Fit, distance_after: f64) -> Self {
        let gained = fit.followed as f64 - right.followed as f64;
        let share = gained / (right.rows - right.followed).max(1) as f64;
        Self { mistakes, same_as: Vec::new(), fit, share: share.max(0.0), distance_after }
    }

    /// Puts the better one first: it follows longer; of those that follow as long as each other, the nearer one,
    /// in all rows where they follow longer than the course's rule, else right after the departure.
    pub(crate) fn compare(&self, other: &Self) -> Ordering {
        let nearer = match self.share > 0.0 {
            true => self.fit.residual.total_cmp(&other.fit.residual),
            false => self.distance_after.total_cmp(&other.distance_after),
        };
        other.fit.followed.cmp(&self.fit.followed).then(nearer)
    }

    /// Whether both cannot be distinguished by this run.
    fn is_same_as(&self, other: &Self) -> bool {
        let (a, b) = (self.fit.residual, other.fit.residual);
        let (near_a, near_b) = (self.distance_after, other.distance_after);
        self.fit.followed == other.fit.followed
            && (a - b).abs() <= 1e-9 * a.max(1e-6)
            && (near_a - near_b).abs() <= 1e-9
    }

    /// What its program does, in sentences.
    pub fn sentence(&self) -> String {
        let sentences: Vec<&str> = self.mistakes.iter().map(Mistake::sentence).collect();
        sentences.join(" ")
    }
}

fn one_by_one<S: Serializer>(mistakes: &Mistakes, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(mistakes.iter())
}

/// What a verdict is made of.
pub(crate) struct Parts<'a> {
    pub course: &'a Course,
    pub recorded: &'a Recorded,
    pub keys: &'a [Key],
    pub reference: &'a Tracks,
    pub fit: Fit,
    /// By how many frames the clock of the table is off.
    pub shift: Option<i32>,
    /// Whether the run fits better with z mirrored.
    pub is_mirrored: bool,
    /// From when on \[s\] rounding moves a ball far, and how far \[m\].
    pub rounding: Option<[f64; 2]>,
    /// The best first; those that are no better than the course's rule are left out.
    pub explanations: Vec<Explanation>,
    /// The run of the first of them.
    pub explaining: Option<&'a Tracks>,
    /// How far places may be off \[m\]: what was asked for, or more where they have few decimals.
    pub tolerance: f64,
    /// What was asked for \[m\].
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

/// How many digits numbers have in common that differ by this part.
fn digits(difference: f64) -> i32 {
    (0..=15).take_while(|digits| difference <= 0.5 * 10_f64.powi(-digits)).last().unwrap_or(0)
}

/// The best explanations, without those that are the same as one before.
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

/// The last contact of a ball that can show in a row: after the row before it, or in the frame before that,
/// whose answer shows a frame later.
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

/// The end of the course's run \[s\], where that is before the end of the table.
fn compared_until(parts: &Parts) -> Option<f64> {
    let end = parts.reference.times.last().copied();
    end.filter(|end| *end < parts.recorded.end())
}

fn ball_at(reference: &Tracks, key: Key, time: f64) -> Option<usize> {
    let (frame, part) = reference.frame_at(time)?;
    reference.ball(key, frame + usize::from(part > 0.0))
}
