//! Grades a recorded run by comparison with the course's rule and with each known mistake.

use std::collections::BTreeMap;

use crate::assign;
use crate::course::Course;
use crate::course_rule::{Clock, run};
use crate::fit::{Fit, Rows};
use crate::mistake::{Mistake, Mistakes};
use crate::recorded::Recorded;
use crate::spread::Spread;
use crate::tracks::{Key, Touch, Tracks};
use crate::verdict::{Explanation, Parts, Verdict};

/// Default tolerance of positions \[m\]: a few times the error of single precision in the scenes of
/// the course before a ball leaves the picture, and half of the smallest effect of a mistake that
/// should be detected.
pub const TOLERANCE: f64 = 5e-4;

/// Factor between the allowed error and the measured spread by rounding: a program rounds in
/// another order than the runs that measured the spread.
const SPREADS: f64 = 4.0;

/// Spread \[m\] above which the verdict contains a note.
const FAR_SPREAD: f64 = 0.02;

/// Offsets of the table's clock that are recognized \[frames\].
const SHIFTS: [i32; 4] = [1, -1, 2, -2];

/// Most frames of a display before the first time of a table: some minutes.
const MOST_FRAMES_BEFORE: f64 = 20_000.0;

/// Most rows of a table that is compared with pairs of mistakes, which would take minutes for more.
const MOST_ROWS_OF_PAIRS: usize = 100_000;

/// Fraction of all rows by which a pair of mistakes must agree longer than a single one to be
/// named.
const WORTH_A_PAIR: f64 = 0.02;

/// Grades runs of one scene.
pub struct Grader {
    course: Course,
    tolerance: f64,
    /// Time up to which runs have been computed \[s\].
    end: f64,
    /// Runs without mistakes and with each single mistake.
    runs: BTreeMap<Mistakes, Tracks>,
    spread: Option<Spread>,
}

/// Result of grading, with the runs from which it was derived.
pub struct Graded {
    /// The result.
    pub verdict: Verdict,
    /// The run of the course's rule.
    pub reference: Tracks,
    /// The run of the best explanation, if the recorded run is not right.
    pub explanation: Option<Tracks>,
    /// Meaning of each label of the table.
    pub(crate) keys: Vec<Key>,
}

impl Grader {
    /// Creates a grader for runs of this course with a `tolerance` \[m\].
    pub fn new(course: Course, tolerance: f64) -> Self {
        Self { course, tolerance, end: 0.0, runs: BTreeMap::new(), spread: None }
    }

    /// The course.
    pub fn course(&self) -> &Course {
        &self.course
    }

    /// Computes a run with these mistakes, `end` \[s\] long, in single or double precision.
    pub fn planted(&self, mistakes: Mistakes, end: f64, single: bool) -> Tracks {
        let clock = Clock::Fixed(end);
        if single {
            run::<f32>(&self.course, mistakes, &clock)
        } else {
            run::<f64>(&self.course, mistakes, &clock)
        }
    }

    /// Grades a recorded run.
    pub fn grade(&mut self, recorded: &Recorded) -> Graded {
        // The table's clock may be ahead.
        let end = recorded.end() + 3.0 * self.course.frame_time;
        self.make_ready(end);
        let reference = &self.runs[&Mistakes::NONE];
        let keys = assign::keys(recorded, reference, self.course.capacity());
        let rows = self.rows(recorded, &keys);
        let right = rows.follow(reference, 0.0);
        // A run that is too long to be compared to its end may be right.
        let departs = right.departure.is_some();
        let shift = departs.then(|| self.shift(&rows)).flatten();
        let (mut explanations, mut explaining, mut is_mirrored) = (Vec::new(), None, false);
        if departs && shift.is_none() {
            explanations = self.explanations(&rows, &right);
            explaining = explanations.first().map(|it| self.tracks(it.mistakes, recorded));
            is_mirrored = self.is_mirrored(&rows, &right);
        }
        let fit = shift.as_ref().map_or(&right, |(_, fit)| fit).clone();
        let parts = Parts {
            course: &self.course,
            recorded,
            keys: &keys,
            reference,
            fit,
            shift: shift.map(|(frames, _)| frames),
            is_mirrored,
            rounding: rows.rounding,
            explanations,
            explaining: explaining.as_ref(),
            tolerance: self.base_tolerance(recorded),
            asked: self.tolerance,
        };
        let verdict = Verdict::of(parts);
        Graded { verdict, reference: reference.clone(), explanation: explaining, keys }
    }

    /// Computes all runs up to a time \[s\], rounded up to a multiple of 5 s.
    fn make_ready(&mut self, end: f64) {
        // The runs of a folder have similar lengths, so computed runs are reused for the same
        // rounded length. Longer ones would do as well, but have a larger spread by rounding, and a
        // verdict must not depend on what was graded before.
        let end = (end / 5.0).ceil() * 5.0;
        if end == self.end && !self.runs.is_empty() {
            return;
        }
        self.end = end;
        let clock = Clock::Fixed(self.end);
        let known = std::iter::once(Mistakes::NONE).chain(Mistake::all().map(Mistakes::from));
        self.runs = known.map(|it| (it, run::<f64>(&self.course, it, &clock))).collect();
        self.spread = Some(Spread::of(&self.course, &self.runs[&Mistakes::NONE], &clock));
    }

    fn base_tolerance(&self, recorded: &Recorded) -> f64 {
        // The three coordinates are rounded, each by at most the resolution.
        self.tolerance.max(2.0 * recorded.resolution)
    }

    fn rows<'a>(&self, recorded: &'a Recorded, keys: &'a [Key]) -> Rows<'a> {
        let reference = &self.runs[&Mistakes::NONE];
        let base = self.base_tolerance(recorded);
        let mut rows = Rows {
            recorded,
            keys,
            balls: Vec::new(),
            tolerances: Vec::new(),
            rounding: None,
            frame_time: self.course.frame_time,
        };
        for row in &recorded.rows {
            let frame = reference.frame_at(row.time).map(|(frame, part)| (frame, part > 0.0));
            let frame = frame.map(|(frame, is_between)| frame + usize::from(is_between));
            let ball = frame.and_then(|frame| reference.ball(keys[row.label], frame));
            let spread = match (ball, frame, &self.spread) {
                (Some(ball), Some(frame), Some(spread)) => {
                    spread.at(ball, frame - reference.balls[ball].birth)
                }
                // A ball that exists only in the wrong run.
                (None, _, Some(spread)) => spread.largest(),
                _ => 0.0,
            };
            if spread > FAR_SPREAD {
                let [since, most] = rows.rounding.unwrap_or([row.time, spread]);
                rows.rounding = Some([since, most.max(spread)]);
            }
            rows.balls.push(ball);
            rows.tolerances.push(base + SPREADS * spread);
        }
        rows
    }

    /// Offset of the table's clock \[frames\], if it explains the whole difference.
    fn shift(&self, rows: &Rows) -> Option<(i32, Fit)> {
        let reference = &self.runs[&Mistakes::NONE];
        // Before the first bounce, explicit Euler would look the same.
        let bounced = |it: &Touch| {
            reference.times[it.frame] + 3.0 * self.course.frame_time < rows.recorded.end()
        };
        if !reference.touches.iter().any(bounced) {
            return None;
        }
        let fits = SHIFTS.iter().map(|&frames| {
            let later = f64::from(frames) * self.course.frame_time;
            (frames, rows.follow(reference, later))
        });
        fits.into_iter().find(|(_, fit)| {
            let moved = fit.max_velocity.unwrap_or(0.0) * self.course.frame_time;
            fit.is_complete() && fit.rms.is_finite() && moved < 10.0 * self.tolerance
        })
    }

    /// Whether the run agrees with the course's rule much longer if z is mirrored.
    fn is_mirrored(&self, rows: &Rows, right: &Fit) -> bool {
        let mirrored = rows.recorded.mirrored();
        let fit = self.rows(&mirrored, rows.keys).follow(&self.runs[&Mistakes::NONE], 0.0);
        fit.followed as f64 > right.followed as f64 + WORTH_A_PAIR * fit.rows as f64
    }

    /// Finds the mistakes that explain a run better than the course's rule does, the best first.
    fn explanations(&self, rows: &Rows, right: &Fit) -> Vec<Explanation> {
        let mut found: Vec<Explanation> =
            Mistake::all().map(|mistake| self.explanation(mistake.into(), rows, right)).collect();
        found.sort_by(Explanation::compare);
        let best = &found[0].fit;
        let much_longer = best.followed as f64 + WORTH_A_PAIR * best.rows as f64;
        if !best.is_complete()
            && best.rows <= MOST_ROWS_OF_PAIRS
            && let Some(pair) = self.pair(rows, right)
            && pair.fit.followed as f64 > much_longer
        {
            found.insert(0, pair);
        }
        let reference = &self.runs[&Mistakes::NONE];
        let of_rule = right.departure.map_or(0.0, |it| rows.distance_after(&it, reference));
        // A difference of a tenth of a percent is chance.
        found.retain(|it| it.share > 0.0 || it.distance_after < 0.999 * of_rule);
        found
    }

    /// Finds the pair of mistakes that explains a run best.
    fn pair(&self, rows: &Rows, right: &Fit) -> Option<Explanation> {
        let mut best: Option<Explanation> = None;
        for first in Mistake::all() {
            for second in Mistake::all().filter(|second| *second > first) {
                let pair = Mistakes::from(first).with(second);
                let found = self.explanation(pair, rows, right);
                if best.as_ref().is_none_or(|best| found.fit.is_better_than(&best.fit)) {
                    best = Some(found);
                }
            }
        }
        best
    }

    fn explanation(&self, mistakes: Mistakes, rows: &Rows, right: &Fit) -> Explanation {
        let own;
        let tracks = match self.runs.get(&mistakes) {
            Some(known) if !self.needs_own_run(mistakes, rows.recorded) => known,
            _ => {
                own = self.tracks(mistakes, rows.recorded);
                &own
            }
        };
        let after = right.departure.map_or(0.0, |it| rows.distance_after(&it, tracks));
        Explanation::new(mistakes, rows.follow(tracks, 0.0), right, after)
    }

    /// Whether the run with these mistakes depends on the times of the table.
    fn needs_own_run(&self, mistakes: Mistakes, recorded: &Recorded) -> bool {
        mistakes.has(Mistake::DisplayFrames) && display_times(&self.course, recorded).is_some()
    }

    /// Returns the run with these mistakes with which a table is compared.
    fn tracks(&self, mistakes: Mistakes, recorded: &Recorded) -> Tracks {
        if self.needs_own_run(mistakes, recorded)
            && let Some(times) = display_times(&self.course, recorded)
        {
            return run::<f64>(&self.course, mistakes, &Clock::At(times));
        }
        let known = self.runs.get(&mistakes).cloned();
        known.unwrap_or_else(|| run::<f64>(&self.course, mistakes, &Clock::Fixed(self.end)))
    }
}

/// Finds the display frames in which a table was recorded: the times of the table, if they are not
/// multiples of the frame time. Frames before its first time have the length of its first one.
fn display_times(course: &Course, recorded: &Recorded) -> Option<Vec<f64>> {
    let times = recorded.times();
    let off = |time: &&f64| {
        let frames = **time / course.frame_time;
        (frames - frames.round()).abs() > 0.02
    };
    if 2 * times.iter().filter(off).count() < times.len() || times.len() < 2 {
        return None;
    }
    let (first, usual) = (times[0], times[1] - times[0]);
    let before = (first / usual).round().max(1.0);
    if before > MOST_FRAMES_BEFORE {
        return None;
    }
    let before = before as usize;
    let before = (1..before).map(|frame| first * frame as f64 / before as f64);
    Some(before.chain(times.iter().copied().filter(|time| *time > 0.0)).collect())
}
