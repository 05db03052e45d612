//! How the maze tilts, and how its motion acts on the ball.

mod common;

use carom::DVec3;
use carom_maze::{Game, Maze, Options, Steering, Tilt};
use common::{game, game_with, open_floor, play, wall};

const RIGHT: Steering = Steering::Turn { about_x: 0.0, about_z: -1.0 };

fn degrees(game: &Game) -> f64 {
    game.tilt_angles().angle().to_degrees()
}

#[test]
fn the_tilt_goes_by_time_and_not_by_frames() {
    for frame_time in [1.0 / 100.0, 1.0 / 60.0, 1.0 / 50.0] {
        let options = Options { frame_time, ..Options::default() };
        let mut game = game_with(&open_floor(0.0), options);
        play(&mut game, RIGHT, 1.0);
        // A hundred rounding errors of a number of this size.
        assert!((degrees(&game) - 10.0).abs() < 1e-12, "{}", degrees(&game));
    }
}

#[test]
fn the_tilt_stays_within_its_limit_in_every_direction() {
    let mut game =
        game_with(&open_floor(0.0), Options { max_tilt_degrees: 3.0, ..Options::default() });
    for steering in [RIGHT, Steering::roll(1.0, 1.0), Steering::Towards(Tilt::down(-1.0, 2.0))] {
        play(&mut game, steering, 1.0);
        assert!((degrees(&game) - 3.0).abs() < 1e-12, "{}", degrees(&game));
    }
}

#[test]
fn a_released_maze_eases_back_to_level_unless_told_to_stay() {
    for levels_back in [true, false] {
        let mut game = game_with(&open_floor(0.0), Options { levels_back, ..Options::default() });
        play(&mut game, RIGHT, 0.5);
        play(&mut game, Steering::NONE, 0.25);
        let expected = if levels_back { 2.5 } else { 5.0 };
        assert!((degrees(&game) - expected).abs() < 1e-12, "{}", degrees(&game));
        play(&mut game, Steering::NONE, 0.5);
        assert_eq!(game.tilt_angles() == Tilt::LEVEL, levels_back);
    }
}

#[test]
fn the_tilt_follows_a_target_at_the_tilt_speed_and_stops_there() {
    let mut game = game(&open_floor(0.0));
    let target = Tilt { about_x: 0.05, about_z: -0.02 };
    play(&mut game, Steering::Towards(target), 0.1);
    let Tilt { about_x, about_z } = game.tilt_angles();
    let turned = 1f64.to_radians();
    assert!((about_x - turned).abs() < 1e-12 && (about_z + turned).abs() < 1e-12);
    play(&mut game, Steering::Towards(target), 0.5);
    assert_eq!(game.tilt_angles(), target);
}

#[test]
fn the_ball_rolls_where_it_is_steered_to() {
    for (to_x, to_z) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        let mut game = game(&open_floor(0.0));
        play(&mut game, Steering::roll(to_x, to_z), 0.5);
        let (_, velocity) = game.ball_in_maze();
        assert!(velocity.dot(DVec3::new(to_x, 0.0, to_z)) > 0.1, "{to_x} {to_z}: {velocity}");
    }
}

#[test]
fn a_ball_on_a_tilted_floor_accelerates_by_g_sin_of_the_tilt() {
    let mut game = game(&open_floor(0.0));
    let tilt = Tilt::down(4f64.to_radians(), 3f64.to_radians());
    play(&mut game, Steering::Towards(tilt), 0.5);
    assert_eq!(game.tilt_angles(), tilt);
    let before = game.ball_in_maze().1;
    play(&mut game, Steering::Towards(tilt), 0.5);
    let gained = game.ball_in_maze().1 - before;
    let expected = 0.5 * 9.8 * libm::sin(5f64.to_radians()) * DVec3::new(0.8, 0.0, 0.6);
    // The floor is at rest, so only rounding counts and the rest of its turning: the ball may have
    // been 1e-9 m above it.
    assert!((gained - expected).length() < 1e-7, "{gained} is not {expected}");
}

#[test]
fn a_floor_that_rises_takes_the_ball_along() {
    let mut scene = open_floor(0.0);
    scene.spheres[0].position = [5.0, 0.5, 0.0];
    let mut game = game(&scene);
    game.step(Steering::roll(-1.0, 0.0)).unwrap();
    // About z at 10°/s, a point 5 m from the axis moves at 0.8727 m/s.
    let expected = 10f64.to_radians() * 5.0;
    let rise = game.world().spheres().velocities()[0].y;
    // It turns by 0.17°: the direction changes by 3e-3.
    assert!((rise / expected - 1.0).abs() < 5e-3, "{rise} is not {expected}");
}

#[test]
fn a_wall_that_moves_pushes_the_ball() {
    // 3 m above the axis the maze moves sideways. The ball touches a wall on its left.
    let speed_after_a_frame = |with_wall: bool| {
        let mut scene = open_floor(3.0);
        scene.spheres[0].position = [0.0, 3.5, 0.0];
        if with_wall {
            scene.colliders.push(wall("wall", [-0.6, 3.5, 0.0], [0.2, 1.0, 2.0]));
        }
        let mut game = game(&scene);
        game.step(RIGHT).unwrap();
        game.world().spheres().velocities()[0].x
    };
    // The wall has restitution 0, so the ball gets its speed, ω times 3.5 m, up to the turn.
    let wall_speed = 10f64.to_radians() * 3.5;
    assert!((speed_after_a_frame(true) / wall_speed - 1.0).abs() < 5e-3);
    assert!(speed_after_a_frame(false) < 0.01 * wall_speed);
}

#[test]
fn the_same_steering_gives_the_same_bits() {
    let hash = || {
        let mut game = Game::new(Maze::course().unwrap(), Options::default()).unwrap();
        for frame in 0..400_u32 {
            let part = |number: u32| f64::from(number % 3) - 1.0;
            game.step(Steering::roll(part(frame / 40), part(frame / 70))).unwrap();
        }
        game.world().state_hash()
    };
    assert_eq!(hash(), hash());
}

#[test]
fn however_it_is_tilted_the_ball_stays_in_the_maze() {
    let mazes = [Maze::course().unwrap(), Maze::random(3, 5, 4).unwrap()];
    for maze in mazes {
        let mut game = Game::new(maze, Options::default()).unwrap();
        let mut state = 1_u64;
        for frame in 0..1200 {
            // Knuth's generator; keys change every third of a second.
            if frame % 20 == 0 {
                state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            }
            let key = |shift: u32| ((state >> shift) % 3) as f64 - 1.0;
            game.step(Steering::roll(key(33), key(40))).unwrap();
            // The error at turning surfaces is about 1e-8 m.
            assert!(game.world().overlaps(1e-6).is_empty(), "frame {frame}");
        }
        assert_eq!(game.rough_frames(), 0);
    }
}

/// Returns a game with friction on an open floor.
fn rolling() -> Game {
    game_with(&open_floor(0.0), Options { friction: 0.4, ..Options::default() })
}

#[test]
fn with_friction_the_ball_rolls_with_five_sevenths_of_the_acceleration() {
    let (mut sliding, mut rolling) = (game(&open_floor(0.0)), rolling());
    // Tilted first, so that the turning floor does no work in the measured second.
    for game in [&mut sliding, &mut rolling] {
        play(game, Steering::Towards(Tilt::down(0.05, 0.0)), 1.0);
    }
    let start = [&sliding, &rolling].map(|game| game.ball_in_maze().1.x);
    for game in [&mut sliding, &mut rolling] {
        play(game, Steering::Towards(Tilt::down(0.05, 0.0)), 1.0);
    }
    let gained = [&sliding, &rolling].map(|game| game.ball_in_maze().1.x);
    let part = (gained[1] - start[1]) / (gained[0] - start[0]);
    // Frames and sub-steps differ by at most a frame's part of the second.
    assert!((part - 5.0 / 7.0).abs() < 0.02, "{part}");
    let ball = rolling.world().spheres().get(0);
    let slip = ball.velocity.length() - 0.5 * ball.angular_velocity.length();
    assert!(slip.abs() < 0.01 * ball.velocity.length(), "{slip}");
    assert_eq!(rolling.rough_frames(), 0);
}

#[test]
fn friction_can_be_chosen_while_a_game_is_played() {
    let mut game = game(&open_floor(0.0));
    play(&mut game, Steering::roll(1.0, 0.0), 0.5);
    game.set_options(Options { friction: 0.4, ..*game.options() }).unwrap();
    play(&mut game, Steering::roll(1.0, 0.0), 0.5);
    assert!(game.world().spheres().get(0).angular_velocity.length() > 0.1);
    game.play_again();
    play(&mut game, Steering::roll(1.0, 0.0), 0.5);
    assert!(game.world().spheres().get(0).angular_velocity.length() > 0.1);
    game.set_options(Options { friction: 0.0, ..*game.options() }).unwrap();
    game.play_again();
    play(&mut game, Steering::roll(1.0, 0.0), 0.5);
    assert_eq!(game.world().spheres().get(0).angular_velocity, DVec3::ZERO);
    let refused = game.set_options(Options { friction: -1.0, ..*game.options() });
    assert!(refused.unwrap_err().to_string().contains("friction"));
}

#[test]
fn a_ball_with_friction_that_rolls_up_to_the_end_wall_wins() {
    let mut game = rolling();
    let towards = Steering::Towards(Tilt::down(-0.02, 0.0));
    let events = common::until_event(&mut game, towards, 30.0);
    assert!(matches!(events[..], [carom_maze::GameEvent::Won { .. }]), "{events:?}");
    assert_eq!(game.rough_frames(), 0);
}
