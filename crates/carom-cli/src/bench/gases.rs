//! Impacts per second in gases of elastic hard spheres.

use std::process::{Command, Stdio};
use std::time::Instant;

use carom::{Rule, StageCounts, World};
use serde::{Deserialize, Serialize};

use super::median::median;
use super::work_columns;
use crate::args::Bench;
use crate::failure::Failure;
use crate::gas::{self, COLLISIONS_TO_EQUILIBRIUM, Filling, Speeds};
use crate::machine;
use crate::stage_work::StageWork;
use crate::table::{Side, Table};

/// A gas whose speed is published.
struct Published {
    count: usize,
    packing_fraction: f64,
    /// Millions of impacts per second: Smallenburg, "Efficient event-driven simulations of hard
    /// spheres", Eur. Phys. J. E 45, 22 (2022).
    rate: f64,
    /// Whether only `--full` measures it.
    is_large: bool,
}

const SET: [Published; 7] = [
    published(1_000, 0.20, 0.63),
    published(10_000, 0.20, 0.49),
    published(100_000, 0.20, 0.23),
    published(4_000, 0.49, 0.93),
    published(108_000, 0.25, 0.16),
    published(108_000, 0.49, 0.24),
    Published { is_large: true, ..published(1_000_000, 0.49, 0.27) },
];

const fn published(count: usize, packing_fraction: f64, rate: f64) -> Published {
    Published { count, packing_fraction, rate, is_large: false }
}

/// Where the published figures come from.
pub const NOTE: &str =
    "published: Smallenburg, Eur. Phys. J. E 45, 22 (2022), one core of another machine";

/// Fewest impacts in a run: enough for about a second, and for every sphere to take part.
const FEWEST_IMPACTS: u64 = 200_000;

/// Collisions per sphere in a frame: enough that writing the state of all spheres costs little.
const COLLISIONS_PER_FRAME: f64 = 1.0;

/// Most impacts in a frame: the report of more would be a large part of the measured memory.
const MOST_IMPACTS_OF_A_FRAME: f64 = 125_000.0;

/// Speed of a gas.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct GasRow {
    spheres: usize,
    packing_fraction: f64,
    /// Impacts in each run.
    impacts: u64,
    /// The rate of each run \[1/s\].
    runs: Vec<f64>,
    /// Median of the rates \[1/s\].
    impacts_per_second: f64,
    /// Published rate \[1/s\], if there is one.
    published: Option<f64>,
    ratio: Option<f64>,
    /// Growth of the peak memory per sphere, if the system reports it.
    bytes_per_sphere: Option<f64>,
    /// Work per impact over all runs.
    work_per_impact: Option<StageWork<f64>>,
}

/// Measures each gas of the set in a process of its own, so that peak memory and heap are not
/// affected by another gas.
pub fn measure_set(args: &Bench) -> Result<Vec<GasRow>, Failure> {
    SET.iter().filter(|it| args.full || !it.is_large).map(|it| measure_apart(it, args)).collect()
}

fn measure_apart(published: &Published, args: &Bench) -> Result<GasRow, Failure> {
    let Published { count, packing_fraction, rate, .. } = *published;
    let fault = |what: String| Failure::Fault(format!("cannot measure {count} spheres: {what}"));
    let program = std::env::current_exe().map_err(|error| fault(error.to_string()))?;
    let mut command = Command::new(program);
    command.args(["bench", "--json", "--n", &count.to_string()]);
    command.args(["--packing-fraction", &packing_fraction.to_string()]);
    command.args(["--runs", &args.runs.to_string()]);
    if let Some(impacts) = args.impacts {
        command.args(["--impacts", &impacts.to_string()]);
    }
    let output = command.stderr(Stdio::inherit()).output();
    let output = output.map_err(|error| fault(error.to_string()))?;
    if !output.status.success() {
        return Err(fault(output.status.to_string()));
    }
    let figures: Apart = serde_json::from_slice(&output.stdout)
        .map_err(|error| fault(format!("no figures came back: {error}")))?;
    let row = figures.gases.into_iter().next();
    let row = row.ok_or_else(|| fault("no figures came back".to_owned()))?;
    let ratio = row.impacts_per_second / (1e6 * rate);
    Ok(GasRow { published: Some(1e6 * rate), ratio: Some(ratio), ..row })
}

/// The part of a process's output that is read back.
#[derive(Deserialize)]
struct Apart {
    gases: Vec<GasRow>,
}

/// Measures a gas in this process.
pub fn measure(filling: Filling, args: &Bench) -> Result<GasRow, Failure> {
    let most = filling.most();
    if filling.packing_fraction >= most {
        return Err(Failure::Usage(format!(
            "{} spheres have no place on a lattice at a packing fraction of {} (below {most:.4})",
            filling.count, filling.packing_fraction
        )));
    }
    let memory_before = machine::peak_memory();
    // Each impact is a collision for two spheres.
    let longest = 2.0 * MOST_IMPACTS_OF_A_FRAME / filling.count as f64;
    let h = filling.time_of(COLLISIONS_PER_FRAME.min(longest));
    let mut world = gas::gas(filling, Speeds::Equilibrium, Rule::default(), 1)?;
    gas::run_collisions(&mut world, h, COLLISIONS_TO_EQUILIBRIUM)?;
    let impacts = args.impacts.unwrap_or(FEWEST_IMPACTS.max(2 * filling.count as u64));
    let mut counted = Counted::default();
    let runs: Result<Vec<f64>, carom::Error> =
        (0..args.runs).map(|_| rate(&mut world, h, impacts, &mut counted)).collect();
    let runs = runs?;
    let growth = memory_before.zip(machine::peak_memory()).map(|(before, after)| after - before);
    Ok(GasRow {
        spheres: filling.count,
        packing_fraction: filling.packing_fraction,
        impacts,
        impacts_per_second: median(runs.clone()),
        runs,
        published: None,
        ratio: None,
        bytes_per_sphere: growth.map(|bytes| bytes as f64 / filling.count as f64),
        work_per_impact: StageWork::per_impact(counted.work, counted.impacts),
    })
}

/// Totals over all runs.
#[derive(Default)]
struct Counted {
    impacts: u64,
    work: StageCounts,
}

/// Measures impacts per second over at least `impacts` impacts.
fn rate(
    world: &mut World,
    h: f64,
    impacts: u64,
    counted: &mut Counted,
) -> Result<f64, carom::Error> {
    let (mut done, began) = (0, Instant::now());
    while done < impacts {
        let report = world.step(h)?;
        done += report.impacts.len() as u64;
        counted.work += report.work;
    }
    counted.impacts += done;
    Ok(done as f64 / began.elapsed().as_secs_f64())
}

pub fn table(rows: &[GasRow]) -> Table {
    let right = Side::Right;
    let columns = [
        ("gas of spheres", right),
        ("packing fraction", right),
        ("impacts/s", right),
        ("published", right),
        ("ratio", right),
        ("bytes/sphere", right),
    ];
    let mut table = Table::new(&[&columns[..], &work_columns::NAMES].concat());
    let millions = |rate: f64| format!("{:.3} M", 1e-6 * rate);
    let or_none = |text: Option<String>| text.unwrap_or_else(|| "-".to_owned());
    for row in rows {
        let mut texts = vec![
            row.spheres.to_string(),
            format!("{:.2}", row.packing_fraction),
            millions(row.impacts_per_second),
            or_none(row.published.map(millions)),
            or_none(row.ratio.map(|ratio| format!("{ratio:.2}"))),
            or_none(row.bytes_per_sphere.map(|bytes| format!("{bytes:.0}"))),
        ];
        texts.extend(work_columns::texts(row.work_per_impact));
        table.push(texts);
    }
    table
}
