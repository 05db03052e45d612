//! The maze game as footage: a player tilts the maze.

use carom::DVec3;
use carom_maze::{Game, GameError, GameState, Maze, Options, Player};
use carom_render::{Drawing, Roll, draw_world};
use carom_scene::{Palette, Scene};

use super::error::ShootError;
use super::footage::{Footage, Words};
use crate::failure::Failure;

/// Fewest frames of the game per second: the rate for which it is made.
const FRAMES_PER_SECOND: u32 = 60;
/// Time for which the end is shown \[s\].
const AFTER_THE_END: f64 = 3.0;
/// Longest game \[s\]: a player that has not won by then will not.
const PATIENCE: f64 = 600.0;

/// A game that is played while it is recorded.
///
/// A frame of the film is a whole number of frames of the game, so every picture shows a frame of
/// the game.
pub struct Played {
    game: Game,
    player: Player,
    palette: Palette,
    roll: Roll,
    frames: u64,
    title: String,
}

impl Played {
    /// Creates a game for a film of `fps` frames per second. Its player collects everything within
    /// reach.
    pub fn new(maze: Maze, fps: u32) -> Result<Self, Failure> {
        let reachable = Player::new(&maze, 0)?.reachable().count();
        let player = Player::new(&maze, reachable)?;
        let fps = fps.max(1);
        let frame_time = 1.0 / f64::from(fps * FRAMES_PER_SECOND.div_ceil(fps));
        let title = maze.title().to_owned();
        let game = Game::new(maze, Options { frame_time, ..Options::default() })?;
        let palette = Palette::new(game.scene())?;
        Ok(Self { game, player, palette, roll: Roll::START, frames: 0, title })
    }

    /// Length of the film \[s\]: until the game is won, and a little longer. Returns `None` if the
    /// player does not win.
    pub fn duration(&self) -> Result<Option<f64>, Failure> {
        let (mut game, mut player) = (self.game.clone(), self.player.clone());
        let mut time = 0.0;
        while !is_won(&game) {
            if time > PATIENCE {
                return Ok(None);
            }
            let steering = player.steer(&game);
            game.step(steering)?;
            time += game.frame_time();
        }
        Ok(Some(time + AFTER_THE_END))
    }

    fn step(&mut self) -> Result<(), GameError> {
        let before = self.game.ball_in_maze().0;
        let steering = self.player.steer(&self.game);
        self.game.step(steering)?;
        let way = self.game.ball_in_maze().0 - before;
        let radius = self.game.maze().ball_radius();
        // A jump to the start is no rolling.
        if way.length() < radius {
            self.roll.on(way, DVec3::Y, radius);
        }
        self.frames += 1;
        Ok(())
    }
}

impl Footage for Played {
    fn title(&self) -> &str {
        &self.title
    }

    fn scene(&self) -> &Scene {
        self.game.scene()
    }

    fn draw(&mut self, time: f64, drawing: &mut Drawing) -> Result<Words, ShootError> {
        let due = (time / self.game.frame_time()).round();
        while (self.frames as f64) < due {
            self.step()?;
        }
        let game = &self.game;
        // The pattern shows the motion relative to the maze, however it is tilted.
        let rotation = game.tilt() * self.roll.rotation;
        draw_world(game.scene(), game.world(), &self.palette, |_| Some(rotation), drawing);
        let of = game.maze().collectibles().count();
        let (elapsed, collected) = (game.elapsed(), game.collected());
        Ok(Words {
            stamp: format!("t = {elapsed:.1} s   {collected} of {of} collected"),
            caption: is_won(game).then_some("You win!"),
        })
    }
}

fn is_won(game: &Game) -> bool {
    matches!(game.state(), GameState::Won { .. })
}
