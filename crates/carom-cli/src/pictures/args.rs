//! Arguments of the commands that draw.

use std::path::PathBuf;

use carom_render::Quality;
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::viewpoint::Viewpoint;
use crate::choice::{Changes, Choice, RULES};
use crate::length::positive;
use crate::replacing::Replacing;

/// How a scene is seen.
#[derive(Debug, Clone, clap::Args)]
pub struct PictureOptions {
    /// In pixels; both even for a film.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "1280x720", value_parser = sides)]
    pub size: [u32; 2],
    /// Where from: the scene's own camera (`fit` where it has none), from the front, from above,
    /// from where everything fits into the picture, or from one point to another, in m.
    #[arg(long, value_name = "scene|front|top|fit|X,Y,Z,TX,TY,TZ", default_value = "scene")]
    #[arg(allow_hyphen_values = true)]
    pub camera: Viewpoint,
    /// Leave out scene and time at the lower left.
    #[arg(long)]
    pub no_stamp: bool,
    /// How much work goes into a picture; `draft` is for slow machines.
    #[arg(long, value_parser = quality(), default_value = "fine")]
    pub quality: Quality,
}

/// Draw a scene.
#[derive(Debug, clap::Args)]
pub struct Picture {
    /// The scene.
    #[command(flatten)]
    pub choice: Choice,
    /// Step rule, instead of the scene's own.
    #[arg(long, short, value_parser = RULES)]
    pub rule: Option<String>,
    /// When: the frame of the scene nearest to this time. The start, unless given.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = not_negative)]
    // The names that other commands use for times.
    #[arg(allow_negative_numbers = true, aliases = ["seconds", "time"])]
    pub at: f64,
    /// Camera, size and quality.
    #[command(flatten)]
    pub look: PictureOptions,
    /// The picture, .png.
    #[arg(long, short, value_name = "PATH")]
    pub out: PathBuf,
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// What is filmed, and how.
#[derive(Debug, clap::Args)]
pub struct Record {
    /// Name or title of a scene, or a scene file; with --play also a drawn maze, .txt.
    #[arg(required_unless_present = "all")]
    pub scene: Option<String>,
    /// Overrides of the scene.
    #[command(flatten)]
    pub changes: Changes,
    /// Step rule, instead of the scene's own.
    #[arg(long, short, value_parser = RULES, requires = "scene")]
    pub rule: Option<String>,
    /// How long; unless given, the scene's own duration, all of a recording, or until a game is
    /// won.
    #[arg(long, short, value_parser = positive, allow_negative_numbers = true)]
    pub seconds: Option<f64>,
    /// Frames per second: 24, 25, 30, 50, 60, 120 or another divisor of 90,000 up to 240.
    #[arg(long, default_value_t = 30)]
    pub fps: u32,
    /// Camera, size and quality.
    #[command(flatten)]
    pub look: PictureOptions,
    /// Film a recorded run of this scene: a table that `carom run --out` wrote, .csv. Between its
    /// frames, balls move on curves given by their positions and velocities.
    #[arg(long, value_name = "CSV")]
    pub from: Option<PathBuf>,
    /// Film the maze game in this scene: a player tilts the maze, collects everything within
    /// reach, and wins.
    #[arg(long, conflicts_with_all = ["from", "overrides", "rule"])]
    pub play: bool,
    /// Film the scenes of the course, the maze game, and the scenes of the tutorial, each into its
    /// own file in the folder --out.
    #[arg(long, conflicts_with_all = ["scene", "overrides", "rule", "from", "play"])]
    pub all: bool,
    /// The film, .mp4; with --all, a folder.
    #[arg(long, short, value_name = "PATH")]
    pub out: PathBuf,
    /// Whether existing files are replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Play the maze game.
#[derive(Debug, clap::Args)]
pub struct Maze {
    /// A drawn maze, .txt, or a scene with a maze; the course's, unless given.
    #[arg(conflicts_with = "random")]
    pub file: Option<String>,
    /// A random maze; the same seed and size give the same maze.
    #[arg(long, value_name = "SEED")]
    pub random: Option<u64>,
    /// Size of a random maze in cells.
    #[arg(long, value_name = "COLUMNSxROWS", default_value = "8x6", value_parser = cells)]
    #[arg(requires = "random")]
    pub size: [usize; 2],
    /// Print the random maze as text, to be saved, changed and played.
    #[arg(long, requires = "random")]
    pub print: bool,
}

/// Parses two whole numbers with an x between them.
fn pair<T: std::str::FromStr>(text: &str) -> Option<[T; 2]> {
    let (first, second) = text.split_once(['x', 'X'])?;
    Some([first.trim().parse().ok()?, second.trim().parse().ok()?])
}

fn sides(text: &str) -> Result<[u32; 2], String> {
    pair(text).ok_or_else(|| "width and height in pixels are needed, like 1280x720".to_owned())
}

fn cells(text: &str) -> Result<[usize; 2], String> {
    pair(text).ok_or_else(|| "columns and rows are needed, like 8x6".to_owned())
}

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("a number of at least 0 is needed".to_owned()),
    }
}

/// Reads the name of a quality.
pub fn quality() -> impl TypedValueParser<Value = Quality> {
    PossibleValuesParser::new(["fine", "good", "draft"]).map(|name| match name.as_str() {
        "draft" => Quality::DRAFT,
        "good" => Quality::GOOD,
        _ => Quality::FINE,
    })
}
