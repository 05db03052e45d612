//! Compares a recorded run with a computed one.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::recorded::Recorded;
use crate::tracks::{Key, Tracks};

/// Residual, as a multiple of the tolerance, that is far off. Single precision leaves up to some
/// twenty times the tolerance of the runs of known mistakes in the scenes of the course.
const FAR: f64 = 40.0;

/// A recorded run with data about its rows from the course's rule.
#[derive(Clone)]
pub(crate) struct Rows<'a> {
    pub recorded: &'a Recorded,
    /// Meaning of each label.
    pub keys: &'a [Key],
    /// Ball of each row under the course's rule; rows of one ball belong together.
    pub balls: Vec<Option<usize>>,
    /// Largest allowed error of each row \[m\].
    pub tolerances: Vec<f64>,
    /// Time \[s\] from which rounding moves a ball far, and the largest such distance \[m\].
    pub rounding: Option<[f64; 2]>,
    /// Frame time \[s\]; it converts differences of velocities to distances.
    pub frame_time: f64,
}

/// Result of a comparison.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fit {
    /// Number of rows that agree: those of each ball up to its first departure.
    pub followed: usize,
    /// Number of all rows.
    pub rows: usize,
    /// Root mean square of the distances in rows that agree \[m\].
    pub rms: f64,
    /// Largest distance in rows that agree \[m\].
    pub max: f64,
    /// Largest distance in rows that agree, divided by the distance of the ball from the origin if
    /// that is more than 1 m.
    pub max_relative: f64,
    /// Largest difference of velocities in rows that agree \[m/s\], if the table has velocities.
    pub max_velocity: Option<f64>,
    /// Earliest departure.
    pub departure: Option<Departed>,
    /// Root mean square of the distances, including the distances to which differences of
    /// velocities lead \[m\].
    #[serde(skip)]
    pub(crate) residual: f64,
}

/// The first row that does not agree.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Departed {
    /// Time of the row \[s\].
    pub time: f64,
    /// Line of the row in the file.
    pub line: u64,
    /// Index in the list of rows.
    #[serde(skip)]
    pub(crate) row: usize,
    /// Index of the previous row of the same ball.
    #[serde(skip)]
    pub(crate) before: Option<usize>,
    /// Position of the ball in the computed run \[m\]; `None` if that run does not have the ball.
    pub expected: Option<[f64; 3]>,
    /// Distance from that position \[m\].
    pub distance: Option<f64>,
}

impl Fit {
    /// Whether all rows agree.
    pub fn is_complete(&self) -> bool {
        self.followed == self.rows
    }

    /// Whether the rows that agree are far off on average, for an allowed error of `tolerance` \[m\]
    /// without that by rounding. They agree then only because rounding moves such a run far.
    pub(crate) fn is_far(&self, tolerance: f64) -> bool {
        // A ball that is kilometres away may be off by much.
        self.rms > FAR * tolerance && self.max_relative > tolerance
    }

    /// Fraction of the rows that agree.
    pub fn part(&self) -> f64 {
        self.followed as f64 / self.rows.max(1) as f64
    }

    /// Whether this fit is better: more rows agree, or as many with a smaller residual.
    pub(crate) fn is_better_than(&self, other: &Self) -> bool {
        (self.followed, other.residual) > (other.followed, self.residual)
    }
}

impl Rows<'_> {
    /// Compares the recorded run with `tracks`, whose clock is ahead of the table's by `later`
    /// \[s\].
    pub fn follow(&self, tracks: &Tracks, later: f64) -> Fit {
        let mut sums = Sums::default();
        let mut departure: Option<Departed> = None;
        // For each ball, its last row, and whether it still agrees.
        let mut balls: BTreeMap<(Key, Option<usize>), (Option<usize>, bool)> = BTreeMap::new();
        for (number, row) in self.recorded.rows.iter().enumerate() {
            let time = row.time + later;
            let key = self.keys[row.label];
            let ball = balls.entry((key, self.balls[number]));
            let known = ball.or_insert((None, true));
            let (before, follows) = (known.0.replace(number), known.1);
            if !follows {
                continue;
            }
            if tracks.frame_at(time).is_none() {
                // Rows before the start count as agreeing; rows after the end of the computed run
                // do not count.
                sums.followed += usize::from(time < 0.0);
                continue;
            }
            let there = tracks.sample(key, time);
            let distance = there.map(|there| self.recorded.distance(row, there.position));
            if let (Some(there), Some(distance)) = (there, distance)
                && distance <= self.tolerances[number]
            {
                let velocity = row.velocity.map(|it| it.distance(there.velocity));
                if let Some(velocity) = velocity {
                    sums.max_velocity = Some(sums.max_velocity.unwrap_or(0.0).max(velocity));
                }
                let moved = velocity.unwrap_or(0.0) * self.frame_time;
                sums.add(distance, there.position.length(), moved);
                continue;
            }
            known.1 = false;
            departure.get_or_insert(Departed {
                time: row.time,
                line: row.line,
                row: number,
                before,
                expected: there.map(|it| it.position.to_array()),
                distance,
            });
        }
        sums.fit(self.recorded.rows.len(), departure)
    }
}

impl Rows<'_> {
    /// Returns rows that may be off by these errors \[m\], too.
    pub fn widened(&self, errors: &[f64]) -> Self {
        let mut rows = self.clone();
        rows.tolerances.iter_mut().zip(errors).for_each(|(own, error)| *own += error);
        rows
    }

    /// Whether all rows up to a time \[s\] agree with `tracks`.
    pub fn agree_until(&self, tracks: &Tracks, until: f64) -> bool {
        let rows = self.recorded.rows.iter().enumerate().take_while(|(_, row)| row.time <= until);
        rows.filter(|(_, row)| row.time >= 0.0).all(|(number, row)| {
            let there = tracks.sample(self.keys[row.label], row.time);
            there.is_some_and(|it| {
                self.recorded.distance(row, it.position) <= self.tolerances[number]
            })
        })
    }

    /// Time of the `count`-th row time after `time`, or of the last row \[s\].
    pub fn later(&self, time: f64, count: usize) -> f64 {
        let rows = &self.recorded.rows;
        let first = rows.partition_point(|row| row.time <= time);
        let mut last = time;
        let mut left = count;
        for row in &rows[first..] {
            if row.time > last {
                if left == 0 {
                    break;
                }
                (last, left) = (row.time, left - 1);
            }
        }
        last
    }

    /// Numbers of at most `most` rows up to a time \[s\]: most of them the last, the others spread
    /// over the rest.
    pub fn chosen(&self, until: f64, most: usize) -> Vec<usize> {
        let end = self.recorded.rows.partition_point(|row| row.time <= until);
        if end <= most {
            return (0..end).collect();
        }
        let late = most * 2 / 3;
        let early = end - late;
        let every = early.div_ceil(most - late);
        (0..early).step_by(every).chain(early..end).collect()
    }
}

/// Sums over rows.
#[derive(Default)]
struct Sums {
    followed: usize,
    compared: usize,
    squares: f64,
    residuals: f64,
    max: f64,
    max_relative: f64,
    max_velocity: Option<f64>,
}

impl Sums {
    fn add(&mut self, distance: f64, from_origin: f64, moved: f64) {
        self.followed += 1;
        self.compared += 1;
        self.max = self.max.max(distance);
        self.squares += distance * distance;
        self.max_relative = self.max_relative.max(distance / from_origin.max(1.0));
        self.residuals += distance * distance + moved * moved;
    }

    fn fit(self, rows: usize, departure: Option<Departed>) -> Fit {
        let root_of_mean = |sum: f64| match self.compared {
            0 => f64::INFINITY,
            compared => (sum / compared as f64).sqrt(),
        };
        Fit {
            followed: if self.compared > 0 { self.followed } else { 0 },
            rows,
            rms: root_of_mean(self.squares),
            max: self.max,
            max_relative: self.max_relative,
            max_velocity: self.max_velocity,
            departure,
            residual: root_of_mean(self.residuals),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use carom::DVec3;

    use super::*;
    use crate::recorded::Reading;
    use crate::tracks::{State, Track};

    #[test]
    fn rows_after_the_end_of_the_other_run_neither_follow_it_nor_depart() {
        let state = State { position: DVec3::ZERO, velocity: DVec3::ZERO };
        let tracks = Tracks {
            times: vec![0.0, 1.0, 2.0],
            balls: vec![Track { birth: 0, states: vec![state; 3] }],
            ..Tracks::default()
        };
        let text = b"t,ball,x,y,z\n1,0,0,0,0\n2,0,0,0,0\n3,0,0,0,0\n4,0,9,0,0\n";
        let recorded = Recorded::parse(Path::new("t.csv"), text, &Reading::default()).unwrap();
        let rows = Rows {
            recorded: &recorded,
            keys: &[Key::Number(0)],
            balls: vec![Some(0); 4],
            tolerances: vec![1e-3; 4],
            rounding: None,
            frame_time: 1.0,
        };
        let fit = rows.follow(&tracks, 0.0);
        assert_eq!((fit.followed, fit.rows), (2, 4));
        assert_eq!(fit.departure, None);
        assert!(!fit.is_complete());
    }
}
