//! Arguments of `carom grade`.

use std::path::PathBuf;

use carom_grade::{Columns, Reading, TOLERANCE};
use clap::ValueEnum;

use crate::choice::Changes;
use crate::length::positive;
use crate::replacing::Replacing;

/// Grade recorded runs against the course's rule.
#[derive(Debug, clap::Args)]
pub struct Grade {
    /// Recorded runs: CSV files or spreadsheets (.xlsx) with a row for each ball after each frame, and the
    /// columns t, ball, x, y, z (vx, vy, vz); or particle files (.xyz, .extxyz, .lammpstrj, .dump, .gsd); `-` is
    /// a table in the standard input, which needs --scene.
    #[arg(required_unless_present_any = ["mistakes", "plant"], value_name = "RUN")]
    pub runs: Vec<PathBuf>,
    /// The scene: name, title or file; without it, the scene whose name is in the name of the run's file.
    #[arg(long)]
    pub scene: Option<String>,
    /// Overrides of the scene.
    #[command(flatten)]
    pub changes: Changes,
    /// Format of the files.
    #[command(flatten)]
    pub format: Format,
    /// Tolerance of positions, in m, in addition to rounding in single precision.
    #[arg(long, value_name = "M", default_value_t = TOLERANCE, value_parser = positive)]
    pub tolerance: f64,
    /// Write a page about the run; for several runs, or if this is a folder, a page for each run
    /// into the folder, and index.html about all of several runs.
    #[arg(long, value_name = "PATH")]
    pub report: Option<PathBuf>,
    /// Write a row for each run to a .csv file.
    #[arg(long, value_name = "PATH")]
    pub table: Option<PathBuf>,
    /// List the known mistakes.
    #[arg(long, conflicts_with_all = ["runs", "plant"])]
    pub mistakes: bool,
    /// Instead of grading, write a run with these known mistakes to --out, as an example; `none` is the rule
    /// itself.
    #[arg(
        long,
        value_name = "NAME",
        value_delimiter = ',',
        requires = "scene",
        conflicts_with = "runs"
    )]
    pub plant: Vec<String>,
    /// File of --plant; `-` is the standard output.
    #[arg(long, short, value_name = "PATH", default_value = "-")]
    pub out: PathBuf,
    /// Length of the run of --plant, instead of the scene's own duration.
    #[arg(long, short, value_name = "S", value_parser = positive, requires = "plant")]
    pub seconds: Option<f64>,
    /// Whether existing files are replaced.
    #[command(flatten)]
    pub replacing: Replacing,
    /// Print JSON instead of text.
    #[arg(long)]
    pub json: bool,
}

/// How files of recorded runs are read.
#[derive(Debug, clap::Args)]
pub struct Format {
    /// Names of columns, where they are not the usual ones: t=time,ball=id,x=px,y=py,z=pz,vx=...
    #[arg(long, value_name = "KEY=NAME,...", value_parser = columns, default_value = "")]
    #[arg(hide_default_value = true)]
    columns: Columns,
    /// Unit of lengths, and of the lengths in velocities.
    #[arg(long, value_name = "UNIT", default_value = "m")]
    length_unit: LengthUnit,
    /// Unit of times, and of the times in velocities; `frames` are numbers of frames.
    #[arg(long, value_name = "UNIT", default_value = "s")]
    time_unit: TimeUnit,
    /// Added to all times, in s.
    #[arg(long, value_name = "S", default_value_t = 0.0, allow_negative_numbers = true)]
    time_offset: f64,
    /// The run is in Unity's left-handed coordinates: z is mirrored.
    #[arg(long)]
    unity: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum LengthUnit {
    M,
    Cm,
    Mm,
    Km,
    In,
    Ft,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum TimeUnit {
    S,
    Ms,
    Min,
    Frames,
}

fn columns(text: &str) -> Result<Columns, String> {
    text.parse().map_err(|error: carom_grade::GradeError| error.to_string())
}

impl Format {
    /// Describes how to read a run with frames of this length \[s\].
    pub fn reading(&self, frame_time: f64) -> Reading {
        let length_unit = match self.length_unit {
            LengthUnit::M => 1.0,
            LengthUnit::Cm => 0.01,
            LengthUnit::Mm => 1e-3,
            LengthUnit::Km => 1e3,
            LengthUnit::In => 0.0254,
            LengthUnit::Ft => 0.3048,
        };
        let time_unit = match self.time_unit {
            TimeUnit::S => 1.0,
            TimeUnit::Ms => 1e-3,
            TimeUnit::Min => 60.0,
            TimeUnit::Frames => frame_time,
        };
        let (columns, time_offset) = (self.columns.clone(), self.time_offset);
        Reading { columns, length_unit, time_unit, time_offset, unity: self.unity }
    }
}
