//! Tables of runs with known mistakes, as a student's program would write them.
#![allow(dead_code, reason = "each file of tests uses some of it")]

use std::fmt::Write;
use std::path::Path;

use carom_grade::{Course, Grader, Mistakes, Reading, Recorded, TOLERANCE, Tracks};
use carom_scene::Library;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// The scenes of the course.
pub const SCENES: [&str; 6] =
    ["simtest1", "simtest2", "simtest3", "simtest4", "simtest5", "simtest6"];

pub fn grader(scene: &str) -> Grader {
    let scene = Library::new().find(scene, &[]).unwrap().0;
    Grader::new(Course::of(&scene).unwrap(), TOLERANCE)
}

/// Format of a table.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    /// Largest noise of a coordinate \[m\].
    pub noise: f64,
    /// Number of frames from one row to the next.
    pub every: usize,
    /// First frame in the table.
    pub first: usize,
    pub velocities: bool,
    pub seed: u64,
}

impl Default for Style {
    fn default() -> Self {
        Self { noise: 0.0, every: 1, first: 1, velocities: true, seed: 0 }
    }
}

/// Writes the table of a run.
pub fn table(tracks: &Tracks, style: Style) -> String {
    let mut random = Pcg64::seed_from_u64(style.seed);
    let mut noise = || style.noise * (f64::from(random.next_u32()) / f64::from(1_u32 << 31) - 1.0);
    let mut text = "t,ball,x,y,z".to_owned();
    text += if style.velocities { ",vx,vy,vz\n" } else { "\n" };
    for frame in (style.first..=tracks.frames()).step_by(style.every) {
        for ball in 0..tracks.len() {
            let Some(state) = tracks.state(ball, frame) else { continue };
            if tracks.state(ball, frame - 1).is_none() {
                continue;
            }
            let [x, y, z] = state.position.to_array().map(|it| it + noise());
            write!(text, "{},{ball},{x},{y},{z}", tracks.time(frame)).unwrap();
            if style.velocities {
                let [x, y, z] = state.velocity.to_array();
                write!(text, ",{x},{y},{z}").unwrap();
            }
            text.push('\n');
        }
    }
    text
}

pub fn recorded(text: &str) -> Recorded {
    Recorded::parse(Path::new("run.csv"), text.as_bytes(), &Reading::default()).unwrap()
}

/// Records a run with these mistakes in single precision.
pub fn planted(grader: &Grader, mistakes: Mistakes, seconds: f64, style: Style) -> Recorded {
    let tracks = grader.planted(mistakes, seconds, true);
    recorded(&table(&tracks, style))
}
