//! The state of the interface as plain data, for scripts of the page and for tests.

use carom::SphereId;
use carom_view::{App, BilliardsScreen, MazeScreen, PinballScreen};
use egui::Context;
use serde::Serialize;

/// The state of the interface.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Status<'a> {
    /// `"empty"`, `"scene"`, `"maze"`, `"pinball"` or `"billiards"`.
    screen: &'static str,
    /// Whether the chooser is open.
    choosing: bool,
    /// Names of all scenes to choose from.
    scenes: &'a [String],
    /// Messages to the user, oldest first.
    notices: Vec<String>,
    /// Whether a film is being recorded.
    recording: bool,
    /// `"WebGPU"` or `"WebGL2"`.
    graphics: &'static str,
    /// Number of frames drawn.
    pictures: u64,
    /// Processor time for the last frame \[s\].
    cpu_seconds: Option<f32>,
    /// The watched scene.
    watching: Option<Watching>,
    /// Changes whenever another scene is watched or the user changes something in it.
    version: u32,
    /// The maze being played.
    maze: Option<Maze>,
    /// The pinball game being played.
    pinball: Option<Pinball>,
    /// The game of nine-ball being played.
    billiards: Option<Billiards>,
}

/// A watched scene.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Watching {
    scene: String,
    /// Origin of the scene: `"built-in"`, a file's name, or another text.
    source: String,
    rule: String,
    /// Time \[s\].
    time: f64,
    frame: u64,
    playing: bool,
    /// Whether a seek is in progress.
    seeking: bool,
    /// Simulated seconds per second.
    speed: f64,
    spheres: usize,
    impacts: u64,
    /// Id of the picked sphere, which may no longer exist.
    picked: Option<u64>,
    /// Energy of all spheres \[J\].
    energy: f64,
    /// Restitutions of all surfaces.
    restitutions: Vec<f64>,
    /// Hash of the state, if it is shown.
    state_hash: Option<String>,
    /// Whether two rules are shown side by side.
    comparing: bool,
}

/// A maze being played.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Maze {
    scene: String,
    collected: usize,
    /// Number of collectibles, taken or not.
    collectibles: usize,
    /// \[s\]
    elapsed: f64,
    won: bool,
    /// Position of the ball along the axes of the maze \[m\].
    ball: [f64; 3],
}

/// A pinball game being played.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Pinball {
    scene: String,
    score: u64,
    /// The most points of a game that is over.
    best: Option<u64>,
    /// Points to beat, if the link states them.
    goal: Option<f64>,
    /// Number of balls left, with the one in play.
    balls: usize,
    /// \[s\]
    elapsed: f64,
    over: bool,
    /// Position of the ball in play \[m\].
    ball: Option<[f64; 3]>,
}

/// A game of nine-ball being played.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
struct Billiards {
    scene: String,
    /// Number of players.
    players: usize,
    /// Player at the table, counted from 0.
    shooter: usize,
    /// Shots of this rack, each foul counted as one more.
    strokes: u32,
    /// The fewest strokes of a rack of one player alone.
    best: Option<u32>,
    /// Strokes to beat, if the link states them.
    goal: Option<f64>,
    /// The lowest ball on the table.
    lowest: u8,
    /// Whether balls roll.
    rolling: bool,
    over: bool,
}

impl<'a> Status<'a> {
    /// Reads the state of an interface.
    pub fn of(
        app: &App,
        scenes: &'a [String],
        version: u32,
        context: &Context,
        graphics: &'static str,
    ) -> Self {
        let maze = app.maze().map(Maze::of);
        let pinball = app.pinball().map(Pinball::of);
        let billiards = app.billiards().map(Billiards::of);
        let watching = app.watching().map(Watching::of);
        Self {
            screen: match (&watching, &maze, &pinball, &billiards) {
                (Some(_), ..) => "scene",
                (None, Some(_), ..) => "maze",
                (None, None, Some(_), _) => "pinball",
                (None, None, None, Some(_)) => "billiards",
                (None, None, None, None) => "empty",
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
            pinball,
            billiards,
        }
    }
}

impl Maze {
    /// Reads the state of the maze.
    fn of(screen: &MazeScreen) -> Self {
        let game = screen.game();
        Self {
            scene: game.scene().name.clone(),
            collected: game.collected(),
            collectibles: game.maze().collectibles().count(),
            elapsed: game.elapsed(),
            won: screen.is_won(),
            ball: game.ball_in_maze().0.to_array(),
        }
    }
}

impl Pinball {
    /// Reads the state of pinball.
    fn of(screen: &PinballScreen) -> Self {
        let game = screen.game();
        Self {
            scene: game.scene().name.clone(),
            score: game.score(),
            best: game.best(),
            goal: screen.goal(),
            balls: game.balls(),
            elapsed: game.elapsed(),
            over: screen.is_over(),
            ball: game.world().spheres().positions().first().map(|it| it.to_array()),
        }
    }
}

impl Billiards {
    /// Reads the state of a game of billiards.
    fn of(screen: &BilliardsScreen) -> Self {
        let (game, rack) = (screen.game(), screen.game().rack());
        Self {
            scene: game.table().scene().name.clone(),
            players: rack.players(),
            shooter: rack.shooter(),
            strokes: rack.strokes(),
            best: game.best().map(|best| best.strokes),
            goal: screen.goal(),
            lowest: rack.lowest(),
            rolling: game.is_rolling(),
            over: screen.is_over(),
        }
    }
}

impl Watching {
    /// Reads the state of a watched scene.
    fn of(watching: &carom_view::Watching) -> Self {
        let view = watching.view();
        Self {
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
    }
}

/// Returns the names of all scenes to choose from.
pub fn scenes(app: &App) -> Vec<String> {
    let entries = app.library().entries().unwrap_or_default();
    entries.into_iter().map(|entry| entry.name).collect()
}
