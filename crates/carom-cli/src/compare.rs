//! The command `compare`: runs the same scene under several rules, or with changed values.

use std::fs::File;
use std::io::{self, Write};
use std::iter;
use std::path::Path;
use std::time::{Duration, Instant};

use carom::World;
use carom_scene::Library;
use carom_scene::unfinished::create_folders_of;
use serde::Serialize;

use crate::args::Compare;
use crate::failure::{Failure, unwritable, unwritable_table};
use crate::machine::Machine;
use crate::standard_input::is_standard;
use crate::table::{Side, Table};

/// Runs a scene under several rules, or with changed values, and prints the distance of the results.
pub fn compare(library: &Library, args: &Compare) -> Result<(), Failure> {
    let mut runs = Vec::new();
    let (mut name, mut h, mut frames) = (String::new(), 0.0, 0);
    for Variant { label, change } in variants(args)? {
        let scene = args.choice.find(library, change.into_iter().chain(args.length.overrides()))?;
        let frame_time = scene.simulation.frame_time;
        if runs.is_empty() {
            h = frame_time;
            frames = args.length.frames(scene.simulation.duration, h)?;
            name.clone_from(&scene.name);
        } else if frame_time != h {
            let text = format!("--with {label}: all runs are compared after frames of {h} s");
            return Err(Failure::Usage(text));
        }
        runs.push(Run::new(label, scene.world()?));
    }
    let out = args.out.as_deref();
    args.replacing.check(out.filter(|path| !is_standard(path)))?;
    let mut rows = out.map(|path| Rows::create(path, &runs)).transpose()?;
    for _ in 0..frames {
        for run in &mut runs {
            run.step(h)?;
        }
        if let Some((reference, others)) = runs.split_first_mut() {
            others.iter_mut().for_each(|run| run.measure(&reference.world));
        }
        if let Some(rows) = &mut rows {
            rows.write(&runs)?;
        }
    }
    rows.map_or(Ok(()), Rows::finish)?;
    let what = if args.with.is_empty() { "rule" } else { "change" };
    let comparison = Comparison::new(name, h, frames, &runs);
    // If rows go to the standard output, the result goes elsewhere.
    if out.is_some_and(is_standard) {
        comparison.print(&mut io::stderr(), what, args.json)?;
    } else {
        comparison.print(&mut io::stdout(), what, args.json)?;
    }
    Ok(())
}

/// A run to make.
struct Variant {
    /// Name of the run: its rule or its change.
    label: String,
    /// What differs from the scene, as `path=value`.
    change: Option<String>,
}

/// Label of the scene without a change.
const UNCHANGED: &str = "the scene";

/// Returns the runs to make, the reference first.
fn variants(args: &Compare) -> Result<Vec<Variant>, Failure> {
    if !args.with.is_empty() {
        let changed = |it: &String| Variant { label: it.clone(), change: Some(it.clone()) };
        let reference = Variant { label: UNCHANGED.to_owned(), change: None };
        return Ok(iter::once(reference).chain(args.with.iter().map(changed)).collect());
    }
    if args.rules.len() < 2 {
        return Err(Failure::Usage("two rules are needed to compare".to_owned()));
    }
    let under = |rule: &String| {
        let change = Some(format!("simulation.rule={rule}"));
        Variant { label: rule.clone(), change }
    };
    Ok(args.rules.iter().map(under).collect())
}

/// A scene in motion.
struct Run {
    label: String,
    world: World,
    impacts: u64,
    stepping: Duration,
    /// Distance from the reference in the present frame.
    now: Distance,
    /// Largest distance in any frame.
    largest: Distance,
}

/// Distance between the spheres of two worlds, matched by id \[m\].
#[derive(Debug, Clone, Copy, Default, Serialize)]
struct Distance {
    /// Root mean square.
    rms: f64,
    max: f64,
}

impl Run {
    fn new(label: String, world: World) -> Self {
        Self {
            label,
            world,
            impacts: 0,
            stepping: Duration::ZERO,
            now: Distance::default(),
            largest: Distance::default(),
        }
    }

    fn step(&mut self, h: f64) -> Result<(), Failure> {
        let began = Instant::now();
        let report = self
            .world
            .step(h)
            .map_err(|error| Failure::Fault(format!("{}: {error}", self.label)))?;
        self.stepping += began.elapsed();
        self.impacts += report.impacts.len() as u64;
        Ok(())
    }

    fn measure(&mut self, reference: &World) {
        self.now = Distance::between(reference, &self.world);
        self.largest.rms = self.largest.rms.max(self.now.rms);
        self.largest.max = self.largest.max.max(self.now.max);
    }
}

impl Distance {
    /// Computes the distance over the spheres that both worlds have.
    fn between(first: &World, second: &World) -> Self {
        let (a, b) = (first.spheres(), second.spheres());
        let (mut squares, mut max, mut count) = (0.0, 0.0_f64, 0_u32);
        for (i, id) in a.ids().iter().enumerate() {
            let Some(j) = b.index_of(*id) else { continue };
            let square = a.positions()[i].distance_squared(b.positions()[j]);
            squares += square;
            max = max.max(square);
            count += 1;
        }
        Self { rms: (squares / f64::from(count.max(1))).sqrt(), max: max.sqrt() }
    }
}

/// A table with a row for each frame.
struct Rows<'a> {
    path: &'a Path,
    table: csv::Writer<Box<dyn Write>>,
}

impl<'a> Rows<'a> {
    fn create(path: &'a Path, runs: &[Run]) -> Result<Self, Failure> {
        let out: Box<dyn Write> = if is_standard(path) {
            Box::new(io::stdout())
        } else {
            let file = create_folders_of(path).and_then(|()| File::create(path));
            Box::new(file.map_err(|error| unwritable(path, &error))?)
        };
        let mut rows = Self { path, table: csv::Writer::from_writer(out) };
        let quantities = ["rms", "max", "energy", "impacts"];
        let names = |run: &Run| quantities.map(|quantity| format!("{}_{quantity}", run.label));
        rows.write_cells(iter::once("t".to_owned()).chain(runs.iter().flat_map(names)))?;
        Ok(rows)
    }

    fn write(&mut self, runs: &[Run]) -> Result<(), Failure> {
        let time = runs.first().map_or(0.0, |run| run.world.time());
        let cells = |Run { world, now: Distance { rms, max }, impacts, .. }: &Run| {
            let numbers = [*rms, *max, world.total_energy()].map(|it| format!("{it:.16e}"));
            numbers.into_iter().chain([impacts.to_string()])
        };
        self.write_cells(iter::once(format!("{time:.16e}")).chain(runs.iter().flat_map(cells)))
    }

    fn write_cells(&mut self, cells: impl Iterator<Item = String>) -> Result<(), Failure> {
        self.table.write_record(cells).map_err(|error| unwritable_table(self.path, error))
    }

    fn finish(mut self) -> Result<(), Failure> {
        self.table.flush().map_err(|error| unwritable(self.path, &error))
    }
}

/// Result of the command.
#[derive(Debug, Serialize)]
struct Comparison {
    machine: Machine,
    scene: String,
    frame_time: f64,
    frames: u64,
    /// Run with which the others are compared.
    reference: String,
    runs: Vec<Row>,
}

/// Result of a run.
#[derive(Debug, Serialize)]
struct Row {
    /// Rule or change of the run.
    run: String,
    spheres: usize,
    impacts: u64,
    energy: f64,
    /// Difference from the energy of the reference \[J\].
    energy_error: f64,
    /// Distance from the spheres of the reference \[m\].
    final_distance: Distance,
    largest_distance: Distance,
    /// Time spent in steps \[s\].
    stepping_time: f64,
    state_hash: String,
}

impl Comparison {
    fn new(scene: String, frame_time: f64, frames: u64, runs: &[Run]) -> Self {
        let reference = runs.first().map_or(0.0, |run| run.world.total_energy());
        let row = |run: &Run| Row {
            run: run.label.clone(),
            spheres: run.world.spheres().len(),
            impacts: run.impacts,
            energy: run.world.total_energy(),
            energy_error: run.world.total_energy() - reference,
            final_distance: run.now,
            largest_distance: run.largest,
            stepping_time: run.stepping.as_secs_f64(),
            state_hash: run.world.state_hash().to_string(),
        };
        Self {
            machine: Machine::this(),
            scene,
            frame_time,
            frames,
            reference: runs.first().map(|run| run.label.clone()).unwrap_or_default(),
            runs: runs.iter().map(row).collect(),
        }
    }

    /// Prints the result; `what` says what the runs differ in.
    fn print(&self, mut out: &mut dyn Write, what: &str, json: bool) -> io::Result<()> {
        if json {
            serde_json::to_writer_pretty(&mut out, self)?;
            return writeln!(out);
        }
        let Self { scene, frame_time, frames, reference, .. } = self;
        let seconds = frame_time * *frames as f64;
        writeln!(
            out,
            "{scene}, {seconds:.3} s in {frames} frames of {frame_time:.6} s; distances of \
             spheres alive in both worlds, and energy errors, from {reference}"
        )?;
        let right = Side::Right;
        let mut table = Table::new(&[
            (what, Side::Left),
            ("spheres", right),
            ("impacts", right),
            ("energy, J", right),
            ("error, J", right),
            ("rms at end, m", right),
            ("rms largest, m", right),
            ("max largest, m", right),
            ("physics", right),
            ("state hash", Side::Left),
        ]);
        for row in &self.runs {
            table.push(vec![
                row.run.clone(),
                row.spheres.to_string(),
                row.impacts.to_string(),
                format!("{:.6}", row.energy),
                format!("{:+.3e}", row.energy_error),
                format!("{:.3e}", row.final_distance.rms),
                format!("{:.3e}", row.largest_distance.rms),
                format!("{:.3e}", row.largest_distance.max),
                format!("{:.3} s", row.stepping_time),
                row.state_hash.clone(),
            ]);
        }
        table.write(&mut out)
    }
}
