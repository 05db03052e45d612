//! Sphere-frames per second of built-in scenes under the rule `exact`.

use std::time::{Duration, Instant};

use carom::StageCounts;
use carom_scene::{Library, Override, Scene};
use serde::Serialize;

use super::median::median;
use super::work_columns;
use crate::failure::Failure;
use crate::stage_work::StageWork;
use crate::table::{Side, Table};

const SET: [&str; 8] = [
    "tutorial3",
    "tutorial4",
    "simtest1",
    "simtest2",
    "simtest3",
    "simtest4",
    "simtest5",
    "simtest6",
];

/// Shortest duration of a measurement: short scenes are repeated.
const SHORTEST: Duration = Duration::from_millis(200);

/// Speed of a scene.
#[derive(Debug, Clone, Serialize)]
pub struct SceneRow {
    scene: String,
    title: String,
    frames: u64,
    impacts: u64,
    /// `None` without impacts.
    work_per_impact: Option<StageWork<f64>>,
    /// The rate of each run \[1/s\].
    runs: Vec<f64>,
    /// Median of the rates \[1/s\].
    sphere_frames_per_second: f64,
}

/// Measures the scenes of the set.
pub fn measure_set(runs: u32) -> Result<Vec<SceneRow>, Failure> {
    SET.iter().map(|name| measure(name, runs)).collect()
}

fn measure(name: &str, runs: u32) -> Result<SceneRow, Failure> {
    let exact: Override = "simulation.rule=exact".parse()?;
    let scene = Library::new().find(name, &[exact])?.0;
    let passages: Result<Vec<Passage>, Failure> = (0..runs).map(|_| passage(&scene)).collect();
    let passages = passages?;
    let Passage { frames, impacts, work, .. } = passages.first().copied().unwrap_or_default();
    let runs: Vec<f64> = passages.iter().map(|it| it.rate).collect();
    let sphere_frames_per_second = median(runs.clone());
    Ok(SceneRow {
        scene: scene.name,
        title: scene.title,
        frames,
        impacts,
        work_per_impact: StageWork::per_impact(work, impacts),
        runs,
        sphere_frames_per_second,
    })
}

/// Repeated runs of a scene.
#[derive(Clone, Copy, Default)]
struct Passage {
    /// Frames in one run of the scene.
    frames: u64,
    impacts: u64,
    work: StageCounts,
    /// Sphere-frames per second over all runs.
    rate: f64,
}

fn passage(scene: &Scene) -> Result<Passage, Failure> {
    let h = scene.simulation.frame_time;
    let (mut sphere_frames, mut stepping) = (0, Duration::ZERO);
    loop {
        let mut world = scene.world()?;
        let (mut frames, mut impacts, mut work) = (0, 0, StageCounts::default());
        let began = Instant::now();
        while world.time() < scene.simulation.duration {
            let report = world.step(h)?;
            impacts += report.impacts.len() as u64;
            work += report.work;
            sphere_frames += world.spheres().len();
            frames += 1;
        }
        stepping += began.elapsed();
        if stepping >= SHORTEST {
            let rate = sphere_frames as f64 / stepping.as_secs_f64();
            return Ok(Passage { frames, impacts, work, rate });
        }
    }
}

pub fn table(rows: &[SceneRow]) -> Table {
    let (left, right) = (Side::Left, Side::Right);
    let columns = [
        ("scene", left),
        ("title", left),
        ("frames", right),
        ("impacts", right),
        ("sphere-frames/s", right),
    ];
    let mut table = Table::new(&[&columns[..], &work_columns::NAMES].concat());
    for row in rows {
        let mut texts = vec![
            row.scene.clone(),
            row.title.clone(),
            row.frames.to_string(),
            row.impacts.to_string(),
            format!("{:.2} M", 1e-6 * row.sphere_frames_per_second),
        ];
        texts.extend(work_columns::texts(row.work_per_impact));
        table.push(texts);
    }
    table
}
