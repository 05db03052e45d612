//! The command line and its help.

use std::path::PathBuf;

use carom_scene::{Budget, Library};
use clap::{Parser, Subcommand};

use crate::choice::{Changes, Choice, RULES};
use crate::config::Config;
use crate::failure::Failure;
use crate::grade::Grade;
use crate::length::{Length, positive};
use crate::link::Link;
use crate::pack::Pack;
#[cfg(feature = "pictures")]
use crate::pictures::args::{Maze, Picture, Record};
#[cfg(feature = "pictures")]
use crate::plot::Plot;
use crate::replacing::Replacing;
#[cfg(feature = "view")]
use crate::window::View;

/// Moves spheres exactly: runs scenes of spheres that collide with each other and with fixed
/// surfaces.
#[derive(Debug, Parser)]
#[command(name = "carom", version, propagate_version = true)]
pub struct Args {
    /// Folder with scene files of your own; may be given several times. The folders in
    /// $CAROM_SCENES are searched after these, then those of the configuration file, the built-in
    /// scenes last.
    #[arg(long, global = true, value_name = "DIR")]
    scenes: Vec<PathBuf>,
    /// Most spheres that a scene file or a link may ask for; $CAROM_MAX_SPHERES, that of the
    /// configuration file, or 2,000,000 for files and 200,000 for links, unless given.
    #[arg(long, global = true, value_name = "N")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=Budget::MOST.spheres))]
    max_spheres: Option<u64>,
    /// What to do.
    #[cfg(not(feature = "view"))]
    #[command(subcommand)]
    command: Command,
    /// What to do; by default `view`, which lets you choose a scene.
    #[cfg(feature = "view")]
    #[command(subcommand)]
    command: Option<Command>,
}

impl Args {
    /// Splits the command line into the sources of scenes and the command.
    pub fn split(self) -> (Sources, Command) {
        #[cfg(not(feature = "view"))]
        let command = self.command;
        #[cfg(feature = "view")]
        let command = self.command.unwrap_or_else(|| Command::View(View::default()));
        (Sources { folders: self.scenes, max_spheres: self.max_spheres }, command)
    }
}

/// Folders of scenes, and the limit on their spheres, from the command line.
pub struct Sources {
    folders: Vec<PathBuf>,
    max_spheres: Option<u64>,
}

impl Sources {
    /// Returns `usual` with the limit on spheres of the command line, the environment or the
    /// configuration file.
    pub fn budget(&self, usual: Budget, config: &Config) -> Result<Budget, Failure> {
        const VARIABLE: &str = "CAROM_MAX_SPHERES";
        let from_environment = std::env::var(VARIABLE).ok().filter(|it| !it.is_empty());
        let (most, source) = match (self.max_spheres, from_environment) {
            (Some(most), _) => (Some(most), "--max-spheres"),
            (None, Some(text)) => {
                let most = text.parse().ok();
                let wrong = || Failure::Usage(format!("${VARIABLE} is no number: {text}"));
                (Some(most.ok_or_else(wrong)?), VARIABLE)
            }
            (None, None) => (config.max_spheres, "max_spheres of the configuration file"),
        };
        let spheres = most.unwrap_or(usual.spheres);
        if !(1..=Budget::MOST.spheres).contains(&spheres) {
            let most = Budget::MOST.spheres;
            return Err(Failure::Usage(format!("{source} must be 1 to {most}, not {spheres}")));
        }
        Ok(Budget { spheres, ..usual })
    }

    /// Creates the library of all scenes, including those in the folders of the configuration file.
    pub fn library(&self, config: &Config) -> Result<Library, Failure> {
        let mut library = Library::new().within(self.budget(Budget::FILE, config)?);
        let from_environment = std::env::var_os("CAROM_SCENES").unwrap_or_default();
        let from_environment = std::env::split_paths(&from_environment);
        let folders = self.folders.iter().cloned().chain(from_environment);
        let folders = folders.chain(config.scenes.iter().cloned());
        for folder in folders.filter(|folder| !folder.as_os_str().is_empty()) {
            library.add_folder(&folder).map_err(|error| Failure::Usage(error.to_string()))?;
        }
        Ok(library)
    }
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List every scene found: name, description, origin.
    Scenes {
        /// Print JSON instead of text.
        #[arg(long)]
        json: bool,
    },
    /// Write a scene file to start from: balls fall into a box, with a comment on every part.
    New(New),
    /// Make a scene file from a scene of Unity, a glTF file, or the last frame of a particle file (extended XYZ,
    /// dump of LAMMPS, GSD); list the parts without a counterpart.
    Import(Import),
    /// Make a dense packing or a dense fluid in a periodic box, by spheres that grow (Lubachevsky and Stillinger). Ends
    /// with code 1 if they jam before they have the density.
    Pack(Pack),
    /// Check scenes; print each error with its line.
    Check {
        /// Scene files, or names of scenes; `-` is the standard input.
        #[arg(required = true, value_name = "SCENE")]
        files: Vec<PathBuf>,
    },
    /// Print a scene as TOML, with every default.
    Show(Show),
    /// Run a scene, or the run of a link, and print a summary.
    Run(Box<Run>),
    /// Complete the file that a killed run left unfinished: an .npz file from
    /// NAME.npz.0.unfinished, a film from NAME.mp4.0.unfinished. In a .csv table, remove a last
    /// line that is cut short; in a particle file, a last frame.
    Recover(Recover),
    /// Print a link that opens a run of a scene in a browser; `carom run --link` runs it here.
    Link(Link),
    /// Grade recorded runs of students against the course's rule: where a run departs, and which known mistake
    /// explains it. Ends with code 1 if one departs, with 2 if one cannot be read.
    Grade(Box<Grade>),
    /// Check this build against exact results and published values of physics. Ends with code 1 if
    /// it misses one, whichever rule `--rule` names.
    Verify(Verify),
    /// Run a scene under several rules and print the distances between their results.
    Compare(Box<Compare>),
    /// Measure how fast gases of spheres and the built-in scenes run on one core.
    Bench(Bench),
    /// Print a script with which a shell completes words of this command line.
    Completions(Completions),
    /// Write manual pages, one for each command, into a folder.
    Man {
        /// The folder; it is made where it is missing.
        folder: PathBuf,
    },
    /// Draw a scene into a PNG file.
    #[cfg(feature = "pictures")]
    Picture(Box<Picture>),
    /// Run a scene and plot its energy, or other quantities, over time: PNG, SVG, or the numbers as CSV.
    #[cfg(feature = "pictures")]
    Plot(Box<Plot>),
    /// Film a scene, a recorded run, or the maze game: H.264 in an mp4 file.
    ///
    /// Frames of the film are exactly 1/fps of simulated time apart. The scene is stepped by its
    /// own frame time, as in `carom run`. If a frame of the film falls between two of these, balls
    /// and colliders are interpolated linearly. Ctrl-C ends the film early.
    ///
    /// Until the film is complete, its frames are in PATH.0.unfinished, which players can open, too.
    /// After a killed run, `carom recover PATH` creates the film from it.
    #[cfg(feature = "pictures")]
    Record(Box<Record>),
    /// Play the maze game in a window, or print a random maze.
    #[cfg(feature = "pictures")]
    Maze(Maze),
    /// Watch and change a scene in a window; without a scene, choose one there.
    #[cfg(feature = "view")]
    View(View),
}

/// Write a scene file to start from.
#[derive(Debug, clap::Args)]
pub struct New {
    /// What the scene is called; the file is NAME.toml.
    pub name: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Make scene files of scenes of Unity, of a glTF file, or of a particle file.
#[derive(Debug, clap::Args)]
pub struct Import {
    /// A scene of Unity (.unity, saved as text), a folder such as Assets: every scene of Unity in it, a
    /// glTF file (.gltf, .glb), or a particle file (.xyz, .extxyz, .lammpstrj, .dump, .gsd).
    pub path: PathBuf,
    /// Frame of a particle file that the scene begins with, from 0; the last one by default.
    #[arg(long, value_name = "N")]
    pub frame: Option<u64>,
    /// Radius of every particle in m, for a particle file without radii.
    #[arg(long, value_name = "M", value_parser = positive)]
    pub radius: Option<f64>,
    /// The scene file to write, without it the standard output; for a folder the folder to write into, without
    /// it the current one.
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// A file that says what the fields of other scripts of Unity than the course's mean.
    #[arg(long, value_name = "FILE")]
    pub map: Option<PathBuf>,
    /// Step rule; by default `discrete` where scripts move the spheres, as in the course, `exact` else.
    #[arg(long, short, value_parser = RULES)]
    pub rule: Option<String>,
    /// Length of a frame in s; by default the fixed time step of a project of Unity, or 0.02; of glTF, that
    /// of a new scene.
    #[arg(long, value_name = "S", value_parser = positive)]
    pub frame_time: Option<f64>,
    /// Time worth watching in s; 10 by default.
    #[arg(long, value_name = "S", value_parser = positive)]
    pub seconds: Option<f64>,
    /// Whether existing files are replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Write what shells read to complete words of the command line.
#[derive(Debug, clap::Args)]
pub struct Completions {
    /// Which shell.
    pub shell: clap_complete::Shell,
}

/// Print a scene.
#[derive(Debug, clap::Args)]
pub struct Show {
    /// The scene.
    #[command(flatten)]
    pub choice: Choice,
    /// Write out every sphere that generators make.
    #[arg(long)]
    pub expand: bool,
}

/// Run a scene.
#[derive(Debug, clap::Args)]
pub struct Run {
    /// Name or title of a scene, or a scene file; `-` reads the file from the standard input.
    #[arg(required_unless_present = "link")]
    pub scene: Option<String>,
    /// Overrides of the scene.
    #[command(flatten)]
    pub changes: Changes,
    /// Run the scene of a link for the time of the link, with the edits made during its run; `-`
    /// reads the link from the standard input, if it is too long for a command line.
    #[arg(long, value_name = "URL")]
    #[arg(conflicts_with_all = ["scene", "overrides", "rule", "frame_time", "seconds", "frames"])]
    pub link: Option<String>,
    /// Step rule, instead of the scene's own. `bisect` winds back only the spheres that meet
    /// unless the scene says simulation.bisect.wind_back = "all", the tutorial's way.
    #[arg(long, short, value_parser = RULES)]
    pub rule: Option<String>,
    /// Length of the run and of its frames.
    #[command(flatten)]
    pub length: Length,
    /// Write the trajectory; the ending selects the format: .csv, .npz (NumPy), .pvd (a series
    /// of .vtp files for ParaView, in a folder beside it), .xyz (extended XYZ, for OVITO and ASE), .lammpstrj (a
    /// dump of LAMMPS), .gsd (of HOOMD-blue), or .glb (an animation in glTF, for Blender, three.js and Unity). `-` writes CSV to the standard output, and
    /// the summary to the standard error stream.
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Add columns to the table of --out (.csv): the derivatives of each ball's place and velocity by a number that
    /// the run starts with, exact through impacts. It is `acceleration`, or a `position`, `velocity`,
    /// `angular_velocity`, `radius`, `mass`, `restitution` or `friction` of `spheres.N` or `colliders.N`, as
    /// `spheres.0.velocity` (all of x, y, z) or `spheres.0.velocity.1` (y); repeatable. Known under `exact`.
    #[arg(long, value_name = "NUMBER", requires = "out", conflicts_with = "link")]
    pub sensitivity: Vec<String>,
    /// Write only every N-th frame of the trajectory.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    pub every: u64,
    /// Write every impact to a .csv or an .npz file; `-` as by --out.
    #[arg(long, value_name = "PATH")]
    pub impacts: Option<PathBuf>,
    /// Write every capture, dissociation and bounce at the edge of a square well to a .csv file; `-` as by --out.
    #[arg(long, value_name = "PATH")]
    pub wells: Option<PathBuf>,
    /// Write the ledger to a .csv file: every impact with the momentum and energy of its group
    /// before and after; `-` as by --out. Kept by the rule `exact` only.
    #[arg(long, value_name = "PATH")]
    pub ledger: Option<PathBuf>,
    /// Print the mean stress of the run, and its pressure; in VOLUME m³, by default that of the periodic box or of the
    /// first closed container.
    #[arg(long, value_name = "VOLUME", num_args = 0..=1, require_equals = true, value_parser = positive)]
    pub stress: Option<Option<f64>>,
    /// Whether existing files are replaced.
    #[command(flatten)]
    pub replacing: Replacing,
    /// Run again whenever the scene file is changed, until Ctrl-C; files are rewritten each time.
    #[arg(long, short, conflicts_with = "link")]
    pub watch: bool,
    /// End with code 1 if the run violates a guarantee of its rule: balls overlap under `exact`, an
    /// impact loses momentum, balls are pressed through surfaces, `bisect` gives up. The summary
    /// reports it in any case.
    #[arg(long)]
    pub strict: bool,
    /// Print the summary as JSON.
    #[arg(long)]
    pub json: bool,
}

/// What is recovered, and where it goes.
#[derive(Debug, clap::Args)]
pub struct Recover {
    /// The unfinished file, or the name of the file that it was to become.
    pub file: PathBuf,
    /// Write here, instead of under the name that the file was to have.
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Check this build against physics.
#[derive(Debug, clap::Args)]
pub struct Verify {
    /// Only claims whose names hold this text, or of this topic, like `fluid`.
    #[arg(long, value_name = "TEXT")]
    pub filter: Option<String>,
    /// The rule to hold to the claims; those about a rule or scheme of their own keep it.
    #[arg(long, value_parser = RULES, default_value = "exact")]
    pub rule: String,
    /// Check the claims that take minutes, too.
    #[arg(long)]
    pub full: bool,
    /// Check all claims, also those that take up to an hour each.
    #[arg(long)]
    pub long: bool,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
    /// Print comma-separated values instead of a table, with run times and the reasons of tolerances.
    #[arg(long, conflicts_with = "json")]
    pub csv: bool,
}

/// Run a scene under several rules, or with changed values.
#[derive(Debug, clap::Args)]
pub struct Compare {
    /// The scene.
    #[command(flatten)]
    pub choice: Choice,
    /// The rules; the others are compared with the first.
    #[arg(long, value_delimiter = ',', value_parser = RULES, default_values = RULES)]
    pub rules: Vec<String>,
    /// Compare the scene with itself after this change, written as for --set, instead of rules; may
    /// be given several times, for a run each.
    #[arg(long, value_name = "PATH=VALUE", conflicts_with = "rules")]
    pub with: Vec<String>,
    /// Length of the run and of its frames.
    #[command(flatten)]
    pub length: Length,
    /// Write a row for each frame to a .csv file.
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
}

/// Measure speed.
#[derive(Debug, clap::Args)]
pub struct Bench {
    /// Measure only a gas of this many spheres.
    #[arg(long, value_name = "N", requires = "packing_fraction")]
    #[arg(value_parser = clap::value_parser!(u32).range(2..=10_000_000))]
    pub n: Option<u32>,
    /// Part of the volume that the spheres of that gas fill.
    #[arg(long, value_name = "P", requires = "n", value_parser = positive)]
    pub packing_fraction: Option<f64>,
    /// Impacts in each run of a gas; two for each sphere, but 200,000 at least, unless given.
    #[arg(long, value_name = "M")]
    #[arg(value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    pub impacts: Option<u64>,
    /// Runs of each measurement, whose median is taken.
    #[arg(long, value_name = "R", default_value_t = 3)]
    #[arg(value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub runs: u32,
    /// What to measure.
    #[arg(long, value_parser = ["gas", "heaps", "scenes", "all"], default_value = "all")]
    #[arg(conflicts_with = "n")]
    pub set: String,
    /// Measure the gas of a million spheres and the heap of a hundred thousand, too.
    #[arg(long, conflicts_with = "n")]
    pub full: bool,
    /// Print JSON instead of a table.
    #[arg(long)]
    pub json: bool,
}
