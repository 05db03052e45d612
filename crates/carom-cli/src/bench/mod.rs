//! The command `bench`: how fast gases and scenes run on one core.

mod gases;
mod median;
mod scenes;
mod work_columns;

use std::io::{self, Write};

use serde::Serialize;

use crate::args::Bench;
use crate::failure::Failure;
use crate::gas::Filling;
use crate::machine::Machine;
use gases::GasRow;
use scenes::SceneRow;

/// Measures and prints what came out.
pub fn bench(args: &Bench) -> Result<(), Failure> {
    let mut figures = Figures { machine: Machine::this(), gases: Vec::new(), scenes: Vec::new() };
    if let (Some(count), Some(packing_fraction)) = (args.n, args.packing_fraction) {
        let filling = Filling { count: count as usize, packing_fraction };
        figures.gases.push(gases::measure(filling, args)?);
    } else {
        if args.set != "scenes" {
            figures.gases = gases::measure_set(args)?;
        }
        if args.set != "gas" {
            figures.scenes = scenes::measure_set(args.runs)?;
        }
    }
    figures.print(args.json)?;
    Ok(())
}

/// All that was measured, and where.
#[derive(Debug, Serialize)]
struct Figures {
    machine: Machine,
    gases: Vec<GasRow>,
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
        if !self.scenes.is_empty() {
            scenes::table(&self.scenes).write(&mut out)?;
            writeln!(out)?;
        }
        writeln!(out, "{}", self.machine)
    }
}
