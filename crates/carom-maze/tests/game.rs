//! Every transition of the game: contacts of the ball, falls, wins, and the end of time.

mod common;

use carom_maze::{Game, GameError, GameEvent, GameState, Maze, Options, Progress, Role, Steering};
use common::{collectible, game, game_with, open_floor, play, until_event};

const LEFT: Steering = Steering::Turn { about_x: 0.0, about_z: 1.0 };
const RIGHT: Steering = Steering::Turn { about_x: 0.0, about_z: -1.0 };

#[test]
fn a_touched_collectible_vanishes_and_counts_once() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([8.0, 0.5, 8.0]));
    scene.colliders.push(collectible([1.2, 0.5, 0.0]));
    let mut game = game(&scene);
    let events = until_event(&mut game, RIGHT, 10.0);
    assert_eq!(events, [GameEvent::Collected { index: 1, count: 1 }]);
    assert_eq!(game.collected(), 1);
    assert_eq!(game.remaining().collect::<Vec<_>>(), [0]);
    assert_eq!(game.world().colliders().len(), 3);
    assert_eq!(game.scene().colliders.len(), 3);
    // It passes the same position again on its way back to the end wall.
    let events = until_event(&mut game, LEFT, 20.0);
    assert!(matches!(events[..], [GameEvent::Won { collected: 1, .. }]), "{events:?}");
}

#[test]
fn touching_an_end_wall_wins_and_then_nothing_moves() {
    let mut game = game(&open_floor(0.0));
    let events = until_event(&mut game, LEFT, 10.0);
    let time = game.elapsed();
    assert_eq!(events, [GameEvent::Won { time, collected: 0, is_best: true }]);
    assert_eq!(game.state(), GameState::Won { time });
    let hash = game.world().state_hash();
    play(&mut game, RIGHT, 1.0);
    assert_eq!(game.world().state_hash(), hash);
    assert_eq!(game.elapsed(), time);
}

#[test]
fn only_with_all_collectibles_a_game_is_the_best() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([1.0, 0.5, 0.0]));
    let mut game = game(&scene);
    let events = until_event(&mut game, LEFT, 10.0);
    assert!(
        matches!(events[..], [GameEvent::Won { collected: 0, is_best: false, .. }]),
        "{events:?}"
    );
    assert_eq!(game.best(), None);
}

#[test]
fn playing_again_starts_anew_and_keeps_the_best_time() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([-1.0, 0.5, 0.0]));
    let mut game = game(&scene);
    let start = game.world().state_hash();
    assert_eq!(game.best(), None);
    until_event(&mut game, LEFT, 10.0);
    until_event(&mut game, LEFT, 10.0);
    let GameState::Won { time: first } = game.state() else { panic!("not won") };

    game.play_again();
    assert_eq!(game.world().state_hash(), start);
    assert_eq!((game.state(), game.collected(), game.elapsed()), (GameState::Rolling, 0, 0.0));
    assert_eq!(game.scene(), game.maze().scene());
    // A detour makes the second game longer.
    play(&mut game, RIGHT, 0.3);
    until_event(&mut game, LEFT, 10.0);
    let events = until_event(&mut game, LEFT, 10.0);
    assert!(matches!(events[..], [GameEvent::Won { is_best: false, .. }]), "{events:?}");
    assert_eq!(game.best(), Some(first));

    game.play_again();
    until_event(&mut game, LEFT, 10.0);
    let events = until_event(&mut game, LEFT, 10.0);
    let same = GameEvent::Won { time: first, collected: 1, is_best: false };
    assert_eq!(events, [same], "as long as the first is no better than it");
}

#[test]
fn a_ball_that_falls_starts_again_on_a_level_maze_and_keeps_what_it_has() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([2.0, 0.5, 0.0]));
    let mut game = game(&scene);
    until_event(&mut game, RIGHT, 10.0);
    let before = game.elapsed();
    assert_eq!(until_event(&mut game, RIGHT, 10.0), [GameEvent::Fell]);
    assert_eq!(game.ball_in_maze(), (game.maze().start(), carom::DVec3::ZERO));
    assert_eq!(game.tilt(), carom::DQuat::IDENTITY);
    for ((_, now), level) in game.world().colliders().zip(&game.scene().colliders) {
        assert_eq!(now.pose.position.to_array(), level.position);
        assert_eq!(now.angular_velocity, carom::DVec3::ZERO);
    }
    assert_eq!((game.collected(), game.state()), (1, GameState::Rolling));
    assert!(game.elapsed() > before);
}

#[test]
fn time_runs_from_the_first_steering() {
    let mut game = game(&open_floor(0.0));
    play(&mut game, Steering::NONE, 1.0);
    assert_eq!(game.elapsed(), 0.0);
    play(&mut game, RIGHT, 0.5);
    play(&mut game, Steering::NONE, 0.5);
    assert_eq!(game.elapsed(), 60.0 * game.frame_time());
}

#[test]
fn a_ball_that_nobody_tilts_stays_at_its_start_for_ever() {
    let mut game = Game::new(Maze::course().unwrap(), Options::default()).unwrap();
    let start = game.ball_in_maze();
    play(&mut game, Steering::NONE, 2.0);
    assert_eq!(game.ball_in_maze(), start);
}

#[test]
fn the_ball_of_the_course_starts_on_the_ground_under_its_place() {
    // In the course's scene the ball falls from y = 0.5, its top through the ceiling; the ground is
    // at -0.2672.
    let start = Maze::course().unwrap().start();
    assert_eq!(start.to_array(), [2.23, -0.2672 + 0.5, 0.7]);
}

#[test]
fn what_is_drawn_is_what_is_there() {
    let mut game = Game::new(Maze::course().unwrap(), Options::default()).unwrap();
    play(&mut game, Steering::roll(1.0, 1.0), 0.5);
    let tilt = game.tilt();
    for ((_, now), level) in game.world().colliders().zip(&game.scene().colliders) {
        let place = tilt * carom::DVec3::from_array(level.position);
        // Poses were moved by their velocities for a frame: some rounding errors of 10 m.
        assert!(now.pose.position.distance(place) < 1e-13);
    }
    assert!(game.scene().colliders.iter().all(|collider| collider.color.is_some()));
}

#[test]
fn steering_that_is_no_number_is_refused_and_changes_nothing() {
    let mut game = game(&open_floor(0.0));
    play(&mut game, RIGHT, 0.5);
    let (hash, tilt) = (game.world().state_hash(), game.tilt());
    let steering = Steering::Turn { about_x: f64::NAN, about_z: 1.0 };
    assert!(matches!(game.step(steering), Err(GameError::Steering { .. })));
    assert_eq!((game.world().state_hash(), game.tilt()), (hash, tilt));
}

#[test]
fn options_that_make_no_sense_are_refused_by_name() {
    let good = Options::default();
    for (options, name) in [
        (Options { frame_time: 0.0, ..good }, "frame_time"),
        (Options { max_tilt_degrees: 46.0, ..good }, "max_tilt_degrees"),
        (
            Options { tilt_speed_degrees_per_second: f64::NAN, ..good },
            "tilt_speed_degrees_per_second",
        ),
        (Options { reset_height: 1.0, ..good }, "reset_height"),
    ] {
        let error = Game::new(Maze::course().unwrap(), options).unwrap_err();
        assert!(matches!(error, GameError::Option { field, .. } if field == name), "{error}");
    }
}

#[test]
fn the_course_has_four_collectibles_and_one_end_wall() {
    let maze = Maze::course().unwrap();
    let count = |role: fn(&&Role) -> bool| maze.roles().iter().filter(role).count();
    assert_eq!(maze.collectibles().count(), 4);
    assert_eq!(count(|role| **role == Role::EndWall), 1);
    assert_eq!(count(|role| **role == Role::Ground), 1);
    assert_eq!(count(|role| **role == Role::Ceiling), 1);
}

#[test]
fn a_game_goes_on_where_it_had_got_to() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([8.0, 0.5, 8.0]));
    scene.colliders.push(collectible([1.2, 0.5, 0.0]));
    // The ball slides without friction, and rolls with it.
    for friction in [0.0, 0.15] {
        let options = Options { friction, ..Options::default() };
        let mut first = game_with(&scene, options);
        until_event(&mut first, RIGHT, 10.0);
        play(&mut first, LEFT, 0.4);
        let mut second = game_with(&scene, options);
        second.resume(&first.progress()).unwrap();
        assert_eq!(second.progress(), first.progress());
        assert_eq!(second.scene(), first.scene());
        let events = [&mut first, &mut second].map(|game| until_event(game, LEFT, 20.0));
        // Setting a sphere restarts its flight, with the same motion up to rounding; `contact`
        // starts its contacts without the impulses of the frame before.
        let tolerance = if friction == 0.0 { 1e-9 } else { 0.05 };
        let [GameEvent::Won { time, collected, .. }] = events[0][..] else { panic!("{events:?}") };
        let [GameEvent::Won { time: other, collected: also, .. }] = events[1][..] else {
            panic!("{events:?}")
        };
        assert_eq!((collected, also), (1, 1));
        assert!((time - other).abs() <= tolerance, "{time} {other}");
    }
}

#[test]
fn of_a_game_that_is_won_the_best_time_stays() {
    let mut first = game(&open_floor(0.0));
    until_event(&mut first, LEFT, 10.0);
    let mut second = game(&open_floor(0.0));
    let start = second.world().state_hash();
    second.resume(&first.progress()).unwrap();
    assert_eq!((second.state(), second.elapsed()), (GameState::Rolling, 0.0));
    assert_eq!((second.best(), second.world().state_hash()), (first.best(), start));
}

#[test]
fn what_no_game_comes_to_is_refused_and_changes_nothing() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([8.0, 0.5, 8.0]));
    let mut game = game(&scene);
    play(&mut game, RIGHT, 0.4);
    let good = game.progress();
    let wrong = [
        Progress { tilt: [1.5, 0.0], ..good.clone() },
        Progress { tilt: [f64::NAN, 0.0], ..good.clone() },
        Progress { position: [f64::INFINITY; 3], ..good.clone() },
        Progress { velocity: [f64::NAN; 3], ..good.clone() },
        Progress { orientation: [0.0; 4], ..good.clone() },
        // Inside the end wall.
        Progress { position: [-3.0, 0.5, 0.0], tilt: [0.0; 2], ..good.clone() },
    ];
    for progress in wrong {
        game.resume(&progress).unwrap_err();
        assert_eq!(game.progress(), good);
    }
    // Indices without a collectible are ignored.
    let Progress { remaining, .. } = &good;
    assert_eq!(remaining[..], [0]);
    game.resume(&Progress { remaining: vec![7], best: Some(f64::NAN), ..good.clone() }).unwrap();
    assert_eq!((game.collected(), game.best()), (1, None));
    game.resume(&good).unwrap();
    assert_eq!(game.progress(), good);
}
