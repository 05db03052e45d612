//! The command `maze`, and finding mazes by name.

use std::fmt::Display;
use std::io::{self, Write};
use std::path::Path;

use carom_maze::random_text;
use carom_scene::{Library, text_of};

use super::args;
use crate::config::Config;
use crate::failure::Failure;

/// Plays the maze game in a window, or prints a random maze.
pub fn maze(library: Library, args: &args::Maze, config: &Config) -> Result<(), Failure> {
    if let Some(seed) = args.random.filter(|_| args.print) {
        let [columns, rows] = args.size;
        io::stdout().lock().write_all(random_text(seed, columns, rows)?.as_bytes())?;
        return Ok(());
    }
    play(library, args, config)
}

#[cfg(feature = "view")]
fn play(library: Library, args: &args::Maze, config: &Config) -> Result<(), Failure> {
    use carom_maze::Maze;

    let [columns, rows] = args.size;
    let maze = match (&args.file, args.random) {
        (Some(file), _) => find(&library, file)?,
        (None, Some(seed)) => Maze::random(seed, columns, rows)?,
        (None, None) => Maze::course()?,
    };
    crate::window::play(library, maze, config)
}

#[cfg(not(feature = "view"))]
fn play(_: Library, _: &args::Maze, _: &Config) -> Result<(), Failure> {
    let message = "this build has no window (feature `view`); --random SEED --print prints a maze";
    Err(Failure::Usage(message.to_owned()))
}

/// Reads the maze in a drawing, .txt, or in a scene.
pub fn find(library: &Library, name: &str) -> Result<carom_maze::Maze, Failure> {
    if !name.ends_with(".txt") {
        return Ok(carom_maze::Maze::from_scene(&library.find(name, &[])?.0)?);
    }
    let unreadable = |error: &dyn Display| Failure::Fault(format!("cannot read {name}: {error}"));
    let bytes = std::fs::read(name).map_err(|error| unreadable(&error))?;
    let text = text_of(bytes).map_err(|error| unreadable(&error))?;
    let stem = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    Ok(carom_maze::Maze::from_text(&text, &stem)?)
}
