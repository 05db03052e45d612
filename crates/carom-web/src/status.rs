//! What is shown, as plain data: for scripts of the page and for tests.

use carom::SphereId;
use carom_view::App;
use egui::Context;
use serde::Serialize;

/// What is shown.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Status<'a> {
    /// `"empty"`, `"scene"` or `"maze"`.
    screen: &'static str,
    /// Whether a scene is being chosen.
    choosing: bool,
    /// Names of all scenes that can be chosen.
    scenes: &'a [String],
    /// Messages to the user, oldest first.
    notices: Vec<String>,
    /// Whether a film is being recorded.
    recording: bool,
    /// `"WebGPU"` or `"WebGL2"`.
    graphics: &'static str,
    /// Pictures of the interface so far.
    pictures: u64,
    /// Time of the processor for the last of them \[s\].
    cpu_seconds: Option<f32>,
    /// The scene that is watched.
    watching: Option<Watching>,
    /// Another number whenever another scene is watched, or something is changed in it by hand.
    version: u32,
    /// The maze that is played.
    maze: Option<Maze>,
}

/// A scene that is watched.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Watching {
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
    /// Id of the sphere that is followed; it may have gone.
    picked: Option<u64>,
    /// Of all spheres \[J\].
    energy: f64,
    /// Of all surfaces.
    restitutions: Vec<f64>,
    /// The state as a number, where it is shown.
    state_hash: Option<String>,
    /// Whether two rules are shown side by side.
    comparing: bool,
}

/// A maze that is played.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Maze {
    scene: String,
    collected: usize,
    /// All there are to collect.
    collectibles: usize,
    /// \[s\]
    elapsed: f64,
    won: bool,
    /// The ball in the maze \[m\].
    ball: [f64; 3],
}

impl<'a> Status<'a> {
    /// Of an interface.
    pub fn of(
        app: &App,
        scenes: &'a [String],
        version: u32,
        context: &Context,
        graphics: &'static str,
    ) -> Self {
        let maze = app.maze().map(|screen| {
            let game = screen.game();
            Maze {
                scene: game.scene().name.clone(),
                collected: game.collected(),
                collectibles: game.maze().collectibles().count(),
                elapsed: game.elapsed(),
                won: screen.is_won(),
                ball: game.ball_in_maze().0.to_array(),
            }
        });
        let watching = app.watching().map(|watching| {
            let view = watching.view();
            Watching {
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
                picked: view.picked.map(SphereId::number),
                energy: view.now.total_energy(),
                restitutions: view.setup.colliders.iter().map(|it| it.1.restitution).collect(),
                state_hash: view.playback.state_hash.map(|hash| hash.to_string()),
                comparing: view.other.is_some(),
            }
        });
        Self {
            screen: match (&watching, &maze) {
                (Some(_), _) => "scene",
                (None, Some(_)) => "maze",
                (None, None) => "empty",
            },
            choosing: app.is_choosing(),
            scenes,
            notices: app.notices().texts().map(str::to_owned).collect(),
            recording: app.is_recording(),
            graphics,
            pictures: context.cumulative_frame_nr(),
            cpu_seconds: app.cpu_seconds(),
            watching,
            version,
            maze,
        }
    }
}

/// Names of all scenes that can be chosen.
pub fn scenes(app: &App) -> Vec<String> {
    let entries = app.library().entries().unwrap_or_default();
    entries.into_iter().map(|entry| entry.name).collect()
}
