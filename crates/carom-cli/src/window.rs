//! The commands that open a window: `view` and `maze`, and `carom` alone.

use std::path::PathBuf;

use carom_maze::Maze;
use carom_render::Quality;
use carom_scene::{Budget, Library, Scene, Source};
use carom_view::{Desktop, Setup, Start, default_folder, window};

use crate::choice::{Changes, RULES};
use crate::config::Config;
use crate::failure::Failure;
use crate::link;
use crate::pictures::args::quality;

/// Watch a scene.
#[derive(Debug, Default, clap::Args)]
pub struct View {
    /// Name or title of a scene, or a scene file; unless given, it is chosen in the window.
    scene: Option<String>,
    /// Open the run that a link leads to, at its time, instead; - reads the link from the standard
    /// input.
    #[arg(long, value_name = "URL", conflicts_with_all = ["scene", "rule", "watch"])]
    link: Option<String>,
    /// Overrides of the scene.
    #[command(flatten)]
    changes: Changes,
    /// Step rule, instead of the scene's own.
    #[arg(long, short, value_parser = RULES, requires = "scene")]
    rule: Option<String>,
    /// Watch a scene that is a game, too, instead of playing it.
    #[arg(long, requires = "scene")]
    watch: bool,
    /// Folder for pictures and films; Pictures/carom in your own folder, unless given.
    #[arg(long, short, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Address of the page that opens links; $CAROM_PAGE, that of the configuration file, or that of
    /// `cargo xtask web --serve`, unless given.
    #[arg(long, value_name = "URL")]
    page: Option<String>,
    /// How much work goes into the pictures; `draft` is for slow machines.
    #[arg(long, value_parser = quality(), default_value = "good")]
    quality: Quality,
}

/// Opens the window with a scene, or with the list of scenes.
pub fn view(
    library: Library,
    args: &View,
    config: &Config,
    link_budget: Budget,
) -> Result<(), Failure> {
    let rule = args.rule.iter().map(|rule| format!("simulation.rule={rule}"));
    let found = args.scene.as_deref().map(|scene| args.changes.find(&library, scene, rule));
    let start = match &args.link {
        Some(link) => Some(Start::Link(Box::new(link::read(link)?))),
        None => found.transpose()?.map(|(scene, source)| start(scene, source, args.watch)),
    };
    let folder = args.out.clone().or_else(|| config.pictures.clone());
    let page = link::page(args.page.as_deref(), config)?;
    open(Setup { link_budget, ..setup(library, start, desktop(folder, page), args.quality) })
}

/// Opens the window with the maze game.
pub fn play(library: Library, maze: Maze, config: &Config) -> Result<(), Failure> {
    let desktop = desktop(config.pictures.clone(), link::page(None, config)?);
    open(setup(library, Some(Start::Maze(Box::new(maze))), desktop, Quality::default()))
}

/// Starts a scene that is a game as a game, unless `watch` is set.
fn start(scene: Scene, source: Source, watch: bool) -> Start {
    let game = if watch { None } else { Start::game(&scene) };
    game.unwrap_or_else(|| Start::Scene(Box::new(scene), source))
}

/// Creates the desktop with a folder for pictures and a page for links.
fn desktop(folder: Option<PathBuf>, page: String) -> Desktop {
    Desktop::new(folder.unwrap_or_else(default_folder)).with_page(page)
}

fn setup(library: Library, start: Option<Start>, desktop: Desktop, quality: Quality) -> Setup {
    let host = Box::new(desktop);
    Setup { library, start, host, quality, inline_budget: None, link_budget: Budget::LINK }
}

fn open(setup: Setup) -> Result<(), Failure> {
    window::open(setup).map_err(|error| Failure::Fault(error.to_string()))
}
