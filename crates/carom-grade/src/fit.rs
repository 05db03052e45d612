//! How long a recorded run follows another one, and how well.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::recorded::Recorded;
use crate::tracks::{Key, Tracks};

/// A recorded run, with what is known of its rows from the course's rule.
pub(crate) struct Rows<'a> {
    pub recorded: &'a Recorded,
    /// What its labels mean.
    pub keys: &'a [Key],
    /// The ball of each row under the course's rule: rows of one ball belong together.
    pub balls: Vec<Option<usize>>,
    /// How far each row may be off \[m\].
    pub tolerances: Vec<f64>,
    /// From when on \[s\] rounding moves a ball far, and how far \[m\] it does at most.
    pub rounding: Option<[f64; 2]>,
    /// Frame time \[s\]: what velocities that differ make of places in a frame.
    pub frame_time: f64,
}

/// How well a recorded run follows another one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Fit {
    /// Rows up to the first departure of their ball, of those that are compared.
    pub followed: usize,
    /// All rows.
    pub rows: usize,
    /// Root of the mean square of the distances of the rows that are followed \[m\].
    pub rms: f64,
    /// Largest distance of them \[m\].
    pub max: f64,
    /// Largest distance of them, as a part of how far the ball is from the origin, where that is more than 1 m.
    pub max_relative: f64,
    /// Largest difference of their velocities \[m/s\], where there are any.
    pub max_velocity: Option<f64>,
    /// The earliest departure.
    pub departure: Option<Departed>,
    /// Root of the mean square of distances and of what velocities make of them \[m\].
    #[serde(skip)]
    pub(crate) residual: f64,
}

/// The first row that is too far off.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Departed {
    /// Its time \[s\].
    pub time: f64,
    /// Line in the file.
    pub line: u64,
    /// Place in the list of rows.
    #[serde(skip)]
    pub(crate) row: usize,
    /// The row of the same ball before it.
    #[serde(skip)]
    pub(crate) before: Option<usize>,
    /// Where the other run has the ball \[m\]; `None` where it has none.
    pub expected: Option<[f64; 3]>,
    /// How far off it is \[m\].
    pub distance: Option<f64>,
}

impl Fit {
    /// Whether every row is followed.
    pub fn is_complete(&self) -> bool {
        self.followed == self.rows
    }

    /// The part of the rows that is followed.
    pub fn part(&self) -> f64 {
        self.followed as f64 / self.rows.max(1) as f64
    }

    /// Whether it is the better one: it follows longer, or as long and nearer.
    pub(crate) fn is_better_than(&self, other: &Self) -> bool {
        (self.followed, other.residual) > (other.followed, self.residual)
    }
}

impl Rows<'_> {
    /// How well the recorded run follows `tracks`, whose clock is `later` \[s\] ahead of the table's.
    pub fn follow(&self, tracks: &Tracks, later: f64) -> Fit {
        let mut sums = Sums::default();
        let mut departure: Option<Departed> = None;
        // The last row of each ball, and whether it still follows.
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
                // Before the start there is nothing to do wrong; after the end of what was run, nothing is known.
                sums.followed += usize::from(time < 0.0);
                continue;
            }
            let there = tracks.sample(key, time);
            let distance = there.map(|there| there.position.distance(row.position));
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

/// How long after a departure runs are compared that follow no longer \[s\].
const AFTERWARDS: f64 = 0.5;

impl Rows<'_> {
    /// Root of the mean square of distances \[m\] of the ball that departs, each 1 m at most, right after its
    /// departure.
    pub fn distance_after(&self, departed: &Departed, tracks: &Tracks) -> f64 {
        let rows = &self.recorded.rows;
        let (label, ball) = (rows[departed.row].label, self.balls[departed.row]);
        let (mut sum, mut count) = (0.0, 0.0);
        let until = departed.time + AFTERWARDS;
        let shown =
            rows.iter().enumerate().skip(departed.row).take_while(|(_, row)| row.time <= until);
        for (number, row) in shown {
            if row.label != label || self.balls[number] != ball {
                continue;
            }
            let there = tracks.sample(self.keys[label], row.time);
            let distance = there.map_or(1.0, |it| it.position.distance(row.position).min(1.0));
            (sum, count) = (sum + distance * distance, count + 1.0);
        }
        (sum / f64::max(count, 1.0)).sqrt()
    }
}

/// What adds up over rows.
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
