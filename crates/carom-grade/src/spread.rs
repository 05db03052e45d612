//! Measures how far rounding moves a run of the course's rule: the error that a program in single
//! precision cannot avoid.

use rand_core::Rng;
use rand_pcg::Pcg32;

use crate::course::Course;
use crate::course_rule::Clock;
use crate::program::Program;
use crate::tracks::{State, Track, Tracks};

/// Number of jittered runs.
const RUNS: u64 = 4;

/// Largest relative error of a step: two units in the last place of single precision. A program
/// that transforms to the coordinates of colliders, as the course's does, rounds several times in a
/// step.
const JITTER: f64 = 2.0 / (1_u64 << 23) as f64;

/// Largest distances between runs that round differently.
pub(crate) struct Spread {
    /// Index of the start of each ball; balls with equal starts share one.
    balls: Vec<usize>,
    /// For each start, the largest distance after a number of frames \[m\].
    of_start: Vec<Vec<f64>>,
}

impl Spread {
    /// Compares runs of a program that round differently with `reference`, its exact run.
    pub fn of(program: &Program, course: &Course, reference: &Tracks, clock: &Clock) -> Self {
        let mut runs = vec![program.run_single(course, clock)];
        for seed in 0..RUNS {
            let mut random = Pcg32::new(seed, 0);
            // A number in [-1, 1).
            let mut jitter = || f64::from(random.next_u32() as i32) / f64::from(1_u32 << 31);
            runs.push(program.run_jittered(course, clock, &mut || JITTER * jitter()));
        }
        // Balls with equal starts follow equal paths, each with its own rounding errors.
        let mut of_start: Vec<(State, Vec<f64>)> = Vec::new();
        for (ball, track) in reference.balls.iter().enumerate() {
            let start = track.states[0];
            let known = of_start.iter().position(|(it, _)| *it == start);
            let known = known.unwrap_or_else(|| {
                of_start.push((start, Vec::new()));
                of_start.len() - 1
            });
            let largest = &mut of_start[known].1;
            largest.resize(largest.len().max(track.states.len()), 0.0);
            for other in runs.iter().filter_map(|run| run.balls.get(ball)) {
                for (age, (there, right)) in other.states.iter().zip(&track.states).enumerate() {
                    largest[age] = largest[age].max(there.position.distance(right.position));
                }
            }
        }
        for (_, largest) in &mut of_start {
            let mut so_far = 0.0_f64;
            for distance in largest {
                so_far = so_far.max(*distance);
                *distance = so_far;
            }
        }
        let of_ball = |track: &Track| of_start.iter().position(|(it, _)| *it == track.states[0]);
        let balls = reference.balls.iter().filter_map(of_ball).collect();
        Self { balls, of_start: of_start.into_iter().map(|(_, largest)| largest).collect() }
    }

    /// Spread of a ball `age` frames after its emission \[m\].
    pub fn at(&self, ball: usize, age: usize) -> f64 {
        let ages = self.balls.get(ball).and_then(|it| self.of_start.get(*it));
        let ages = ages.map(Vec::as_slice).unwrap_or_default();
        ages.get(age).or(ages.last()).copied().unwrap_or(0.0)
    }

    /// Largest spread of any ball at any time \[m\].
    pub fn largest(&self) -> f64 {
        self.of_start.iter().filter_map(|ages| ages.last()).copied().fold(0.0, f64::max)
    }
}
