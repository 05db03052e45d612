//! Tables of runs of the independent simulator.
#![allow(dead_code, reason = "each file of tests uses some of it")]

use std::fmt::Write;
use std::path::Path;

use carom_grade::{Course, Grader, Reading, Recorded, TOLERANCE, Verdict};
use carom_scene::{Library, Scene};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::simulator::{Plan, Row, simulate};

/// How a table is written.
#[derive(Debug, Clone, Copy)]
pub struct Table {
    /// Standard deviation of each coordinate [m].
    pub scatter: f64,
    /// Number of frames from one row to the next.
    pub every: usize,
    /// Decimals of positions; all if `None`.
    pub decimals: Option<usize>,
    pub velocities: bool,
    pub seed: u64,
}

pub const EXACT: Table =
    Table { scatter: 0.0, every: 1, decimals: None, velocities: false, seed: 0 };

pub fn scene(name: &str) -> Scene {
    Library::new().find(name, &[]).unwrap().0
}

pub fn random(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

/// A number in [0, 1).
pub fn part(random: &mut Pcg64) -> f64 {
    f64::from(random.next_u32()) / 4_294_967_296.0
}

/// A number of the normal distribution, nearly: the sum of twelve uniform ones.
fn normal(random: &mut Pcg64) -> f64 {
    (0..12).map(|_| part(random)).sum::<f64>() - 6.0
}

/// Writes the table of some rows; `form` changes time and position.
pub fn table(
    rows: &[Row],
    style: Table,
    form: impl Fn(f64, [f64; 3]) -> (f64, [f64; 3]),
) -> String {
    let mut random = random(style.seed);
    let mut text = "t,ball,x,y,z".to_owned() + if style.velocities { ",vx,vy,vz\n" } else { "\n" };
    for row in rows.iter().filter(|row| row.frame % style.every == 0) {
        let measured = row.position.map(|it| it + style.scatter * normal(&mut random));
        let (time, position) = form(row.time, measured);
        write!(text, "{time},{}", row.ball).unwrap();
        for value in position {
            match style.decimals {
                Some(decimals) => write!(text, ",{value:.decimals$}").unwrap(),
                None => write!(text, ",{value}").unwrap(),
            }
        }
        if style.velocities {
            let [x, y, z] = row.velocity;
            write!(text, ",{x},{y},{z}").unwrap();
        }
        text.push('\n');
    }
    text
}

pub fn read(text: &str) -> Recorded {
    Recorded::parse(Path::new("run.csv"), text.as_bytes(), &Reading::default()).unwrap()
}

/// Grades a table.
pub fn grade(scene: &Scene, text: &str) -> Verdict {
    Grader::new(Course::of(scene).unwrap(), TOLERANCE).grade(&read(text)).verdict
}

/// Grades a run of a plan, written in a style.
pub fn verdict(name: &str, plan: &Plan, seconds: f64, style: Table) -> Verdict {
    let scene = scene(name);
    grade(&scene, &table(&simulate(&scene, plan, seconds), style, |t, x| (t, x)))
}

/// All lines of a verdict as text.
pub fn said(verdict: &Verdict) -> String {
    let lines = verdict.lines().into_iter().map(|(name, text)| format!("{name}: {text}\n"));
    format!("{}\n{}", verdict.headline(), lines.collect::<String>())
}
