//! Games by keys alone on the built-in table: no ball gets off it, and keys decide everything.

mod common;

use carom_pinball::{Game, GameEvent, GameState, Keys, Role, Table};
use common::{Fingers, shoot};

/// Inner sides of the walls of the built-in table along x and z \[m\]; the plunger closes the lane.
const TABLE: [[f64; 2]; 2] = [[-0.25, 0.30], [-0.50, 0.57]];

/// Error of a ball's place \[m\]: a contact with a turning surface is found to far less.
const ERROR: f64 = 1e-9;

fn game() -> Game {
    Game::new(Table::built_in().unwrap()).unwrap()
}

/// Plays games by random keys to their end or for `frames` frames each; returns the number of games with points.
fn play(seeds: std::ops::Range<u64>, frames: u32) -> u64 {
    let mut scored = 0;
    for seed in seeds {
        let (mut game, mut fingers) = (game(), Fingers::new(seed));
        let radius = game.table().scene().spheres[0].radius.unwrap();
        for frame in 0..frames {
            game.step(fingers.press()).unwrap_or_else(|error| panic!("{seed}, {frame}: {error}"));
            for place in game.world().spheres().positions() {
                let is_within = |value: f64, [least, most]: [f64; 2]| {
                    least - ERROR <= value - radius && value + radius <= most + ERROR
                };
                let lies = (place.y - radius).abs() <= ERROR;
                let is_on_it = lies && is_within(place.x, TABLE[0]) && is_within(place.z, TABLE[1]);
                assert!(is_on_it, "seed {seed}, frame {frame}: {place}");
            }
            if game.state() == GameState::Over {
                break;
            }
        }
        scored += u64::from(game.score() > 0);
    }
    scored
}

#[test]
fn random_keys_never_let_a_ball_leave_the_table() {
    // Most random shots reach a bumper.
    assert!(play(0..8, 900) > 4);
}

#[test]
#[ignore = "takes minutes; `cargo xtask test --full` runs it"]
fn a_thousand_games_of_random_keys_never_let_a_ball_leave_the_table() {
    assert!(play(0..1_000, 3_600) > 500);
}

#[test]
fn the_same_keys_give_the_same_bits() {
    let play = || {
        let (mut game, mut fingers) = (game(), Fingers::new(7));
        let mut all = Vec::new();
        for _ in 0..400 {
            game.step(fingers.press()).unwrap();
            let ball = game.world().spheres();
            let numbers = ball.positions().iter().chain(ball.velocities());
            all.extend(numbers.flat_map(|it| it.to_array()).map(f64::to_bits));
            all.push(game.score());
        }
        all
    };
    assert_eq!(play(), play());
}

#[test]
fn a_ball_that_nothing_holds_goes_down_the_drain() {
    for pull in [24, 32, 40, 48] {
        let mut game = game();
        shoot(&mut game, pull);
        let mut frames = 0;
        while game.balls() == 3 {
            game.step(Keys::NONE).unwrap();
            frames += 1;
            // The longest of them takes ten seconds.
            assert!(frames < 3_600, "pulled for {pull} frames");
        }
    }
}

#[test]
fn points_are_those_of_the_events() {
    let (mut game, mut fingers) = (game(), Fingers::new(3));
    let (mut points, mut lit, mut lost) = (0, 0, 0);
    for _ in 0..3_600 {
        for event in game.step(fingers.press()).unwrap() {
            match *event {
                GameEvent::Kicked { points: more, .. } | GameEvent::AllLit { points: more } => {
                    points += more;
                }
                GameEvent::Lit { points: more, .. } => {
                    points += more;
                    lit += 1;
                }
                GameEvent::Lost { .. } | GameEvent::Over { .. } => lost += 1,
            }
        }
        assert_eq!((game.score(), game.balls()), (points, 3 - lost));
    }
    assert!(points > 0 && lit > 0);
}

#[test]
fn a_player_with_two_keys_scores_and_plays_again() {
    let mut game = game();
    let mut frames = 0;
    while game.state() == GameState::Playing {
        frames += 1;
        assert!(frames < 60 * 600);
        let ball = game.world().spheres().get(0);
        // Raises the flipper that the ball is above.
        let is_above = |side: f64| {
            let across = side * ball.position.x;
            ball.velocity.z > -0.2 && ball.position.z > 0.34 && (-0.01..0.085).contains(&across)
        };
        let plunger = game.waits() && frames % 70 < 50;
        game.step(Keys { left: is_above(-1.0), right: is_above(1.0), plunger }).unwrap();
    }
    let score = game.score();
    assert!(score > 1_000, "{score}");
    assert_eq!(game.events(), [GameEvent::Over { score, is_best: true }]);
    assert_eq!(game.step(Keys { left: true, ..Keys::NONE }).unwrap(), []);
    game.play_again();
    assert_eq!((game.score(), game.balls(), game.best()), (0, 3, Some(score)));
    assert_eq!(game.state(), GameState::Playing);
    // The second game is as the first would be.
    let mut other = self::game();
    shoot(&mut game, 30);
    shoot(&mut other, 30);
    assert_eq!(game.world().state_hash(), other.world().state_hash());
}

#[test]
fn all_targets_give_points_and_go_out() {
    let mut game = game();
    let count = game.table().targets();
    assert_eq!(game.lit(), vec![false; count]);
    let mut fingers = Fingers::new(11);
    let is_target = |role: &Role| matches!(role, Role::Target(_));
    let color = |game: &Game, target: usize| {
        let place = game.table().roles().iter().position(|it| *it == Role::Target(target)).unwrap();
        game.scene().colliders[place].color
    };
    assert_eq!(game.table().roles().iter().filter(|it| is_target(it)).count(), count);
    let dark = color(&game, 0);
    for _ in 0..3_600 {
        for event in game.step(fingers.press()).unwrap().to_vec() {
            if let GameEvent::Lit { target, .. } = event
                && game.lit()[target]
            {
                assert_ne!(color(&game, target), dark);
                return;
            }
        }
    }
    panic!("no target was lit");
}
