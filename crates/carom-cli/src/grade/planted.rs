//! Lists the known mistakes, and writes runs that contain some.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use carom_grade::{Grader, Mistake, Mistakes};
use carom_scene::unfinished::create_folders_of;
use serde::Serialize;

use super::args::Grade;
use super::refusal::refused;
use crate::failure::{Failure, unwritable};

/// A mistake in the output of `--mistakes --json`.
#[derive(Serialize)]
struct Listed {
    name: &'static str,
    sentence: &'static str,
    program: &'static str,
    lecture: &'static str,
}

/// Prints the known mistakes.
pub fn list(json: bool) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    if json {
        let listed = |it: Mistake| Listed {
            name: it.name(),
            sentence: it.sentence(),
            program: it.wrong(),
            lecture: it.right(),
        };
        let all: Vec<Listed> = Mistake::all().map(listed).collect();
        serde_json::to_writer_pretty(&mut out, &all).map_err(io::Error::from)?;
        return Ok(writeln!(out)?);
    }
    for mistake in Mistake::all() {
        writeln!(out, "{:<25}{}", mistake.name(), mistake.sentence())?;
    }
    Ok(())
}

/// Writes a run with the mistakes named by the arguments.
pub fn write(grader: &Grader, args: &Grade) -> Result<(), Failure> {
    let named = args.plant.iter().filter(|name| *name != "none");
    let mistakes: Result<Mistakes, _> = named.map(|name| Mistake::named(name)).collect();
    let seconds = args.seconds.unwrap_or(grader.course().duration);
    let tracks = grader.planted(mistakes.map_err(refused)?, seconds, false);
    if args.out == Path::new("-") {
        return Ok(tracks.write(io::stdout().lock())?);
    }
    args.replacing.check([args.out.as_path()])?;
    let failed = |error: io::Error| unwritable(&args.out, &error);
    let file = create_folders_of(&args.out).and_then(|()| File::create(&args.out));
    let mut file = BufWriter::new(file.map_err(failed)?);
    tracks.write(&mut file).and_then(|()| file.flush()).map_err(failed)
}
