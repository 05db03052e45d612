//! What is shown, as plain data: for scripts of the page and for tests.

use carom_view::{App, MazeScreen, Watching};
use egui::Context;
use serde::Serialize;

/// What is shown.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Status {
    /// `"empty"`, `"scene"` or `"maze"`.
    screen: &'static str,
    /// The scene or maze, where there is one.
    #[serde(flatten)]
    shown: Option<Shown>,
    /// The maze that is played.
    maze: Option<Maze>,
    /// Whether the dialog is open in which scenes are chosen.
    chooser: bool,
    /// Names of all scenes that can be chosen.
    scenes: Vec<String>,
    /// Messages to the user, oldest first.
    notices: Vec<String>,
    /// Whether a film is being recorded.
    recording: bool,
    /// `"WebGPU"` or `"WebGL2"`.
    graphics: &'static str,
    /// Pictures of the interface so far.
    pictures: u64,
    /// Time of the processor for the last of them \[s\].
    frame_seconds: Option<f32>,
}

/// A scene, watched or played.
#[derive(Debug, Default, Serialize)]
#[serde(rename_all = "camelCase")]
struct Shown {
    scene: String,
    /// Where it comes from: `"built-in"`, a file's name, or else.
    source: String,
    rule: String,
    /// \[s\]
    time: f64,
    frame: u64,
    playing: bool,
    /// Whether it is on the way to another time.
    seeking: bool,
    /// Simulated seconds per second.
    speed: f64,
    spheres: usize,
    impacts: u64,
    /// Of all spheres \[J\].
    energy: f64,
    /// Coefficients of restitution of all surfaces.
    restitutions: Vec<f64>,
    /// The state as a number, where it is shown.
    state_hash: Option<String>,
    /// Whether two rules are shown side by side.
    comparing: bool,
}

/// What there is in a maze besides.
#[derive(Debug, Serialize)]
struct Maze {
    collected: usize,
    /// All that there are to collect.
    of: usize,
    won: bool,
    /// \[s\]
    elapsed: f64,
    /// Centre of the ball in the maze \[m\].
    ball: [f64; 3],
}

impl Status {
    /// Of an interface.
    pub fn of(app: &App, context: &Context, graphics: &'static str) -> Self {
        let entries = app.library().entries().unwrap_or_default();
        let (screen, shown) = match (app.watching(), app.maze()) {
            (Some(watching), _) => ("scene", Some(watched(watching))),
            (None, Some(screen)) => ("maze", Some(played(screen))),
            (None, None) => ("empty", None),
        };
        Self {
            screen,
            shown,
            maze: app.maze().map(maze),
            chooser: app.is_choosing(),
            scenes: entries.into_iter().map(|entry| entry.name).collect(),
            notices: app.notices().texts().map(str::to_owned).collect(),
            recording: app.is_recording(),
            graphics,
            pictures: context.cumulative_frame_nr(),
            frame_seconds: app.cpu_seconds(),
        }
    }
}

fn watched(watching: &Watching) -> Shown {
    let view = watching.view();
    Shown {
        scene: view.scene.name.clone(),
        source: watching.source.to_string(),
        rule: view.setup.simulation.rule.to_string(),
        time: view.time,
        frame: view.frame,
        playing: view.playback.playing,
        seeking: view.seeking.is_some(),
        speed: view.playback.speed,
        spheres: view.spheres.ids.len(),
        impacts: view.now.impacts,
        energy: view.now.total_energy(),
        restitutions: view.setup.colliders.iter().map(|it| it.1.restitution).collect(),
        state_hash: view.playback.state_hash.map(|hash| hash.to_string()),
        comparing: view.other.is_some(),
    }
}

fn played(screen: &MazeScreen) -> Shown {
    let (scene, world) = (screen.game().scene(), screen.game().world());
    Shown {
        scene: scene.name.clone(),
        rule: scene.simulation.rule.to_string(),
        time: screen.game().elapsed(),
        playing: screen.is_playing(),
        speed: 1.0,
        spheres: world.spheres().len(),
        ..Shown::default()
    }
}

fn maze(screen: &MazeScreen) -> Maze {
    let game = screen.game();
    Maze {
        collected: game.collected(),
        of: game.maze().collectibles().count(),
        won: screen.is_won(),
        elapsed: game.elapsed(),
        ball: game.ball_in_maze().0.to_array(),
    }
}
