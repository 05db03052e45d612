//! The player finds its way in the course's, random and drawn mazes.

mod common;

use carom_maze::{BUILT_IN_DRAWINGS, Game, GameEvent, GameState, Maze, Options, PlanError, Player};
use common::{collectible, open_floor, wall};

/// Plays until the game is won; returns the time and the number of collectibles taken.
fn played(maze: Maze, wanted: usize, seconds: f64) -> (f64, usize) {
    played_with(Options::default(), maze, wanted, seconds)
}

fn played_with(options: Options, maze: Maze, wanted: usize, seconds: f64) -> (f64, usize) {
    let mut player = Player::new(&maze, wanted).unwrap();
    let mut game = Game::new(maze, options).unwrap();
    for _ in 0..(seconds / game.frame_time()) as usize {
        let steering = player.steer(&game);
        assert!(!game.step(steering).unwrap().contains(&GameEvent::Fell));
        if let GameState::Won { time } = game.state() {
            assert_eq!(game.rough_frames(), 0);
            return (time, game.collected());
        }
    }
    panic!("not won in {seconds} s");
}

#[test]
fn the_player_wins_the_course_with_three_collectibles_within_a_minute() {
    let (time, collected) = played(Maze::course().unwrap(), 3, 60.0);
    assert!(collected >= 3 && time > 30.0, "{collected} in {time} s");
}

#[test]
fn the_player_wins_random_mazes() {
    for seed in 2..5 {
        let (_, collected) = played(Maze::random(seed, 5, 4).unwrap(), 1, 60.0);
        assert!(collected >= 1);
    }
}

#[test]
fn the_player_wins_with_a_ball_that_rolls() {
    let options = Options { friction: 0.15, ..Options::default() };
    for seed in 2..5 {
        let maze = Maze::random(seed, 5, 4).unwrap();
        let (_, collected) = played_with(options, maze, 1, 90.0);
        assert!(collected >= 1);
    }
}

#[test]
fn the_player_gets_everything_in_a_spiral() {
    let (name, text) = BUILT_IN_DRAWINGS[0];
    let (_, collected) = played(Maze::from_text(text, name).unwrap(), 4, 60.0);
    assert_eq!(collected, 4);
}

#[test]
fn every_collectible_of_the_course_is_within_reach() {
    let player = Player::new(&Maze::course().unwrap(), 4).unwrap();
    assert_eq!(player.reachable().collect::<Vec<_>>(), [0, 1, 2, 3]);
}

#[test]
fn a_collectible_behind_a_narrow_gap_is_not_within_reach() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([5.0, 0.5, 0.0]));
    // A wall across the whole floor with a gap of 0.9 m, less than the ball.
    scene.colliders.push(wall("wall", [2.0, 0.5, -5.45], [0.2, 1.0, 10.0]));
    scene.colliders.push(wall("wall", [2.0, 0.5, 5.45], [0.2, 1.0, 10.0]));
    let maze = Maze::from_scene(&scene).unwrap();
    let expected = PlanError::TooFewCollectibles { wanted: 1, reachable: 0 };
    assert_eq!(Player::new(&maze, 1).unwrap_err(), expected);
    let (_, collected) = played(maze, 0, 30.0);
    assert_eq!(collected, 0);
}

#[test]
fn without_a_way_there_is_no_plan() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(wall("wall", [-2.0, 0.5, 0.0], [0.2, 1.0, 30.0]));
    let maze = Maze::from_scene(&scene).unwrap();
    assert_eq!(Player::new(&maze, 0).unwrap_err(), PlanError::NoWay);
}
