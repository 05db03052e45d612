//! The command `record`: films of scenes, recorded runs and the maze game.

use std::path::Path;

use carom_maze::Maze;
use carom_scene::{Library, Scene};

use super::args::Record;
use super::film::Order;
use super::footage::Footage;
use super::maze;
use super::picture::check_ending;
use super::played::Played;
use super::replayed::Replayed;
use super::shoot::shoot;
use super::stepped::Stepped;
use super::studio::Studio;
use crate::failure::Failure;
use crate::interruption::interruption;

/// Files and scenes of `--all`, without the maze game.
const ALL: [(&str, &str); 10] = [
    ("SimTest1.mp4", "simtest1"),
    ("SimTest2.mp4", "simtest2"),
    ("SimTest3.mp4", "simtest3"),
    ("SimTest4.mp4", "simtest4"),
    ("SimTest5.mp4", "simtest5"),
    ("SimTest6.mp4", "simtest6"),
    ("Tutorial1.mp4", "tutorial1"),
    ("Tutorial2.mp4", "tutorial2"),
    ("Tutorial3.mp4", "tutorial3"),
    ("Tutorial4.mp4", "tutorial4"),
];
/// The file of the maze game.
const GAME: &str = "MazeGame.mp4";

/// Footage with the length to record \[s\].
type Take = (Box<dyn Footage>, f64);

/// Records a scene, a recorded run, a game, or all built-in films.
pub fn record(library: &Library, args: &Record) -> Result<(), Failure> {
    let Some(scene) = &args.scene else {
        return record_all(args);
    };
    check_ending(&args.out, "mp4")?;
    args.replacing.check([args.out.as_path()])?;
    let take = take(library, args, scene)?;
    let interrupted = interruption()?;
    shoot(order(args, &args.out), take, &mut Studio::new(args.look.clone())?, &interrupted)
}

/// Records all films; finished ones stay even if a later one fails.
fn record_all(args: &Record) -> Result<(), Failure> {
    let library = Library::new();
    let films = ALL.iter().map(|(file, _)| *file).chain([GAME]);
    let films: Vec<_> = films.map(|file| args.out.join(file)).collect();
    args.replacing.check(films.iter().map(|film| film.as_path()))?;
    let interrupted = interruption()?;
    let mut studio = Studio::new(args.look.clone())?;
    for (file, scene) in ALL {
        let (scene, _) = library.find(scene, &[])?;
        let path = args.out.join(file);
        shoot(order(args, &path), stepped(scene, args)?, &mut studio, &interrupted)?;
    }
    let path = args.out.join(GAME);
    shoot(order(args, &path), game(Maze::course()?, args)?, &mut studio, &interrupted)
}

fn order<'a>(args: &Record, path: &'a Path) -> Order<'a> {
    Order { path, fps: args.fps }
}

fn take(library: &Library, args: &Record, scene: &str) -> Result<Take, Failure> {
    if args.play {
        return game(maze::find(library, scene)?, args);
    }
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let (scene, _) = args.changes.find(library, scene, rule)?;
    match &args.from {
        Some(path) => replayed(path, scene, args),
        None => stepped(scene, args),
    }
}

/// Footage of a scene, of any length; with `--all`, at most the duration of the scene.
fn stepped(scene: Scene, args: &Record) -> Result<Take, Failure> {
    let duration = scene.simulation.duration;
    let wanted = args.seconds.unwrap_or(duration);
    let seconds = if args.all { wanted.min(duration) } else { wanted };
    Ok((Box::new(Stepped::new(scene)?), seconds))
}

/// Footage of a recording, at most until its end.
fn replayed(path: &Path, scene: Scene, args: &Record) -> Result<Take, Failure> {
    let replayed = Replayed::open(path, scene)?;
    let duration = replayed.duration();
    Ok((Box::new(replayed), args.seconds.map_or(duration, |wanted| wanted.min(duration))))
}

/// Footage of a game until it is won. A game that is not won needs `--seconds`.
fn game(maze: Maze, args: &Record) -> Result<Take, Failure> {
    let played = Played::new(maze, args.fps)?;
    let seconds = match (played.duration()?, args.seconds) {
        (Some(duration), Some(wanted)) => duration.min(wanted),
        (Some(duration), None) => duration,
        (None, Some(wanted)) => wanted,
        (None, None) => {
            let message = "the player does not win this maze; --seconds films what it does";
            return Err(Failure::Fault(message.to_owned()));
        }
    };
    Ok((Box::new(played), seconds))
}
