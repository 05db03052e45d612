//! The command `plot`: runs a scene and draws quantities over time.

mod args;
mod axis;
mod sheet;
mod subject;
mod terminal;

use std::io::Write;
use std::path::Path;
use std::sync::atomic::Ordering;

use carom::{SphereId, StopRequest};
use carom_render::Picture;
use carom_scene::Library;
use carom_scene::unfinished::create_folders_of;
use carom_session::figures::{self, Figure, TableStyle};
use carom_session::{Session, SessionError, View};

pub use args::Plot;
use sheet::Sheet;
use subject::Subject;

use crate::failure::{Failure, unwritable};
use crate::interruption::interruption;
use crate::progress::Progress;
use crate::standard_input::is_standard;

/// Pixels of a PNG file per point: as fine as print and dense screens show.
const FINENESS: u32 = 2;

/// Formats of a plot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Format {
    Png,
    Svg,
    Csv,
}

impl Format {
    /// Returns the format that the ending of a file names.
    fn of(file: &Path) -> Result<Self, Failure> {
        let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match ending.as_str() {
            "png" => Ok(Self::Png),
            "svg" => Ok(Self::Svg),
            "csv" => Ok(Self::Csv),
            _ => {
                let text = format!("{} must end in .png, .svg or .csv", file.display());
                Err(Failure::Usage(text))
            }
        }
    }
}

/// Runs a scene and plots what was asked for.
pub fn plot(library: &Library, args: &Plot) -> Result<(), Failure> {
    if args.out.as_deref().is_some_and(is_standard) {
        let text =
            "--out: a plot goes into a file, .png, .svg or .csv; without --out it is drawn here";
        return Err(Failure::Usage(text.to_owned()));
    }
    let out = match &args.out {
        Some(out) => Some((out.as_path(), Format::of(out)?)),
        None => None,
    };
    if args.digits.is_some() && out.is_none_or(|(_, format)| format != Format::Csv) {
        return Err(Failure::Usage("--digits is for tables: --out must end in .csv".to_owned()));
    }
    args.replacing.check(args.out.as_deref())?;
    let subjects = subjects(args)?;
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let scene = args.choice.find(library, rule.chain(args.length.overrides()))?;
    let frames = args.length.frames(scene.simulation.duration, scene.simulation.frame_time)?;
    let mut session = Session::new(scene)?;
    session.pick(args.ball.map(SphereId::from_number));
    let interrupted = run(&mut session, frames)?;

    let mut view = View::default();
    session.fill(&mut view);
    if let Some(ball) = args.ball.filter(|_| view.picked_readings.is_empty()) {
        return Err(Failure::Usage(format!("there is no ball {ball} in this run")));
    }
    let found = subjects.iter().flat_map(|subject| subject.figures(&view));
    let figures: Vec<Figure> = found.map(|it| Figure { mark: None, ..it }).collect();
    let (heading, decimal_comma) = (heading(&view), args.decimal_comma);
    let sheet = Sheet { heading, figures, size: args.size, decimal_comma };
    match out {
        Some((path, format)) => write(path, format, &sheet, args.digits)?,
        None => anstream::stdout().write_all(terminal::text(&sheet).as_bytes())?,
    }
    if interrupted { Err(Failure::Interrupted) } else { Ok(()) }
}

/// Returns what to plot.
fn subjects(args: &Plot) -> Result<Vec<Subject>, Failure> {
    let subjects = match (&args.of[..], args.ball) {
        ([], None) => vec![Subject::Energy],
        ([], Some(_)) => vec![Subject::Height, Subject::Speed],
        (of, _) => of.to_vec(),
    };
    let has_one = |needed: bool| subjects.iter().any(|it| it.needs_ball() == needed);
    match args.ball {
        None if has_one(true) => {
            Err(Failure::Usage("--ball must name the ball of this quantity".to_owned()))
        }
        Some(_) if !has_one(true) => {
            Err(Failure::Usage("--ball needs a quantity of a ball, like --of height".to_owned()))
        }
        _ => Ok(subjects),
    }
}

/// Takes a number of frames. Returns whether a signal ended the run early.
fn run(session: &mut Session, frames: u64) -> Result<bool, Failure> {
    let interrupted = interruption()?;
    session.set_stop_request(Some(StopRequest::from(interrupted.clone())));
    let progress = Progress::new(frames);
    for frame in 1..=frames {
        match session.step() {
            Ok(()) => progress.show(frame, session.time()),
            // The frame was abandoned; earlier ones count.
            Err(SessionError::World(carom::Error::Stopped { .. })) => break,
            Err(error) => return Err(error.into()),
        }
    }
    Ok(interrupted.load(Ordering::Relaxed))
}

/// Returns what stands above the figures.
fn heading(view: &View) -> String {
    let title = if view.scene.title.is_empty() { &view.scene.name } else { &view.scene.title };
    format!("{title}, rule {}", view.setup.simulation.rule)
}

/// Writes the figures.
fn write(path: &Path, format: Format, sheet: &Sheet, digits: Option<u8>) -> Result<(), Failure> {
    let style = TableStyle { digits, decimal_comma: sheet.decimal_comma };
    let text = match format {
        Format::Csv => figures::table(&sheet.figures, style),
        Format::Svg => sheet.svg()?,
        Format::Png => {
            let ([width, height], pixels) = sheet.pixels(FINENESS)?;
            Picture { width, height, pixels }.save_png(path)?;
            return Ok(());
        }
    };
    let written = create_folders_of(path).and_then(|()| std::fs::write(path, text));
    written.map_err(|error| unwritable(path, &error))
}
