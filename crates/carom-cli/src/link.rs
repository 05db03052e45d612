//! The command `link`, and reading links for `run --link`.

use std::io::{self, Write};
use std::path::Path;

use carom_scene::{Budget, Library, SceneText, Source};
use carom_session::{LOCAL_PAGE, LinkSource, Replay};

use crate::choice::{Choice, RULES};
use crate::config::Config;
use crate::failure::Failure;
use crate::length::whole_frames;
use crate::standard_input::{self, STANDARD};

/// Print a link.
#[derive(Debug, clap::Args)]
pub struct Link {
    /// The scene; the link contains the whole text of a scene file.
    #[command(flatten)]
    choice: Choice,
    /// Step rule, instead of the scene's own.
    #[arg(long, short, value_parser = RULES)]
    rule: Option<String>,
    /// Time that the run has come to when it is opened; taken up to whole frames. Without it, the
    /// page opens the scene at its beginning, and `carom run` runs it for its own duration.
    #[arg(long, visible_alias = "time", value_parser = non_negative, allow_negative_numbers = true)]
    seconds: Option<f64>,
    /// Address of the page that opens the link; $CAROM_PAGE, that of the configuration file, or that
    /// of `cargo xtask web --serve`, unless given.
    #[arg(long, value_name = "URL")]
    page: Option<String>,
}

fn non_negative(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value >= 0.0 && value.is_finite() => Ok(value),
        _ => Err("a number that is zero or positive is needed".to_owned()),
    }
}

/// Prints a link to a run of a scene.
pub fn link(library: &Library, args: &Link, config: &Config) -> Result<(), Failure> {
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let overrides = args.choice.changes().overrides(rule.clone())?;
    let (scene, source) = args.choice.changes().find(library, args.choice.scene(), rule)?;
    let link = match source {
        _ if args.choice.scene() == STANDARD => {
            let (name, text) = (format!("{}.toml", scene.name), standard_input::text()?.to_owned());
            carom_session::Link::new(LinkSource::File { name, text }).with_overrides(overrides)
        }
        Source::BuiltIn => {
            // The name without overrides, because they may change the name.
            let name = library.find(args.choice.scene(), &[])?.0.name;
            carom_session::Link::new(LinkSource::BuiltIn(name)).with_overrides(overrides)
        }
        Source::File(path) => carom_session::Link::new(file(&path)?).with_overrides(overrides),
        Source::Registered => carom_session::Link::to_scene(&scene),
    };
    let link = match args.seconds {
        Some(seconds) => {
            let h = scene.simulation.frame_time;
            link.with_frame(whole_frames(seconds, h)?, h)?
        }
        None => link,
    };
    writeln!(io::stdout().lock(), "{}#{link}", page(args.page.as_deref(), config)?)?;
    Ok(())
}

/// Reads a scene file together with the files that it includes.
fn file(path: &Path) -> Result<LinkSource, Failure> {
    let text = SceneText::from_file(path)?.whole().into_owned();
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(LinkSource::File { name, text })
}

/// Address of the page that opens links: `given`, else that of the environment, of the
/// configuration file, or of this machine.
pub fn page(given: Option<&str>, config: &Config) -> Result<String, Failure> {
    let from_environment = || std::env::var("CAROM_PAGE").ok().filter(|page| !page.is_empty());
    let page = given.map(str::to_owned).or_else(from_environment).or_else(|| config.page.clone());
    let page = page.unwrap_or_else(|| LOCAL_PAGE.to_owned());
    if page.contains('#') {
        let message = format!("the address of a page must not contain #, as {page} does");
        return Err(Failure::Usage(message));
    }
    Ok(page)
}

/// Opens a link within `budget`; returns the run at its start and the number of frames to take.
pub fn begin(link: &str, budget: Budget) -> Result<(Replay, u64), Failure> {
    let link = read(link)?;
    let scene = link.open_within(budget)?;
    let (duration, h) = (scene.simulation.duration, scene.simulation.frame_time);
    let replay = Replay::of(&link, scene)?;
    let frames = match link.time() {
        Some(time) => replay.frame_at(time)?,
        None => whole_frames(duration, h)?,
    };
    Ok((replay, frames))
}

/// Reads a link; `-` stands for one on the standard input.
pub fn read(link: &str) -> Result<carom_session::Link, Failure> {
    Ok(carom_session::Link::parse(&written(link)?)?)
}

/// Returns the text of a link; reads it from the standard input if it is `-`.
fn written(link: &str) -> Result<String, Failure> {
    Ok(if link == STANDARD { standard_input::text()?.to_owned() } else { link.to_owned() })
}
