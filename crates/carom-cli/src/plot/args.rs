//! Arguments of the command `plot`.

use std::path::PathBuf;

use super::subject::Subject;
use crate::choice::{Choice, RULES};
use crate::length::Length;
use crate::replacing::Replacing;

/// Run a scene and plot quantities over time.
#[derive(Debug, clap::Args)]
pub struct Plot {
    /// The scene.
    #[command(flatten)]
    pub choice: Choice,
    /// Step rule, instead of the scene's own.
    #[arg(long, short, value_parser = RULES)]
    pub rule: Option<String>,
    /// Length of the run and of its frames.
    #[command(flatten)]
    pub length: Length,
    /// What to plot, each in a figure of its own; several with commas between them. Without it, the
    /// energy, or height and speed of the ball of --ball.
    #[arg(long, value_enum, value_delimiter = ',', value_name = "QUANTITY")]
    pub of: Vec<Subject>,
    /// The ball whose height, speed, position, velocity or path in phase space is plotted, by its number
    /// in tables; the first ball is 0.
    #[arg(long, value_name = "N")]
    pub ball: Option<u64>,
    /// The plot, .png or .svg, or its numbers, .csv. Without it, the plot is drawn in the terminal.
    #[arg(long, short, value_name = "PATH")]
    pub out: Option<PathBuf>,
    /// Significant digits of the numbers in .csv; unless given, all.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=17))]
    pub digits: Option<u8>,
    /// Write numbers with a decimal comma; cells of .csv then have semicolons between them.
    #[arg(long)]
    pub decimal_comma: bool,
    /// Width of a figure and its height, in points: a pixel of .svg, two of .png.
    #[arg(long, value_name = "WIDTHxHEIGHT", default_value = "720x320", value_parser = sides)]
    pub size: [u32; 2],
    /// Whether an existing file is replaced.
    #[command(flatten)]
    pub replacing: Replacing,
}

/// Sides of a figure in points: smaller ones have no room for their axes.
const SIDES: std::ops::RangeInclusive<u32> = 160..=1600;

fn sides(text: &str) -> Result<[u32; 2], String> {
    let parse = |side: &str| side.trim().parse().ok().filter(|side| SIDES.contains(side));
    let found = text.split_once(['x', 'X']);
    let found = found.and_then(|(width, height)| Some([parse(width)?, parse(height)?]));
    let [least, most] = [SIDES.start(), SIDES.end()];
    found.ok_or_else(|| format!("two numbers of {least} to {most} are needed, like 720x320"))
}
