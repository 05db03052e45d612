//! The command `bench`: measures the speed of gases, heaps and scenes.

mod gases;
mod heaps;
mod median;
mod scenes;
mod threads;
mod work_columns;

use std::io::{self, Write};

use serde::Serialize;

use crate::args::Bench;
use crate::failure::Failure;
use crate::gas::Filling;
use crate::machine::Machine;
use gases::GasRow;
use heaps::HeapRow;
use scenes::SceneRow;

/// Measures everything on one thread, and heaps also on all threads; prints the results.
pub fn bench(args: &Bench) -> Result<(), Failure> {
    let figures = threads::on(1, || measure(args))?;
    Ok(figures.print(args.json)?)
}

fn measure(args: &Bench) -> Result<Figures, Failure> {
    let mut figures = Figures {
        machine: Machine::this(),
        gases: Vec::new(),
        heaps: Vec::new(),
        scenes: Vec::new(),
    };
    if let (Some(count), Some(packing_fraction)) = (args.n, args.packing_fraction) {
        let filling = Filling { count: count as usize, packing_fraction };
        figures.gases.push(gases::measure(filling, args)?);
    } else {
        let is_wanted = |set: &str| args.set == "all" || args.set == set;
        if is_wanted("gas") {
            figures.gases = gases::measure_set(args)?;
        }
        if is_wanted("heaps") {
            figures.heaps = heaps::measure_set(args.runs, args.full)?;
        }
        if is_wanted("scenes") {
            figures.scenes = scenes::measure_set(args.runs)?;
        }
    }
    Ok(figures)
}

/// All measurements, and the machine.
#[derive(Debug, Serialize)]
struct Figures {
    machine: Machine,
    gases: Vec<GasRow>,
    heaps: Vec<HeapRow>,
    scenes: Vec<SceneRow>,
}

impl Figures {
    fn print(&self, json: bool) -> io::Result<()> {
        let mut out = io::stdout().lock();
        if json {
            serde_json::to_writer_pretty(&mut out, self)?;
            return writeln!(out);
        }
        if !self.gases.is_empty() {
            gases::table(&self.gases).write(&mut out)?;
            writeln!(out, "{}", gases::NOTE)?;
            writeln!(out)?;
        }
        if !self.heaps.is_empty() {
            heaps::table(&self.heaps).write(&mut out)?;
            writeln!(out, "{}", heaps::NOTE)?;
            writeln!(out)?;
        }
        if !self.scenes.is_empty() {
            scenes::table(&self.scenes).write(&mut out)?;
            writeln!(out)?;
        }
        writeln!(out, "{}", self.machine)
    }
}
