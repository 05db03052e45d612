//! Episodes: rewards, ends, and independence of the balls.

mod common;

use std::sync::Arc;

use carom::{Discrete, Exact, Rule};
use carom_maze::{Arena, EpisodeError, EpisodeOptions, Episodes, Maze, Outcome, Rewards, Start};
use carom_scene::scene::Scene;
use common::{collectible, open_floor};

fn rules() -> [Rule; 2] {
    [Discrete::default().into(), Exact::default().with_max_impacts(2_000).into()]
}

fn episodes(maze: Maze, options: EpisodeOptions, count: usize) -> Episodes {
    Episodes::new(Arc::new(Arena::new(maze, options).unwrap()), count).unwrap()
}

/// Returns one episode on an open floor.
fn on(scene: &Scene, options: EpisodeOptions) -> Episodes {
    episodes(Maze::from_scene(scene).unwrap(), options, 1)
}

/// Returns an arbitrary action that depends only on ball and step.
fn action(ball: usize, step: usize) -> [f64; 2] {
    let part = |number: usize| (number * number % 1009) as f64 / 504.0 - 1.0;
    [part(31 * step + 7 * ball), part(17 * step + 11 * ball + 5)]
}

/// Repeats an action until the episode is over, at most for 20 s; returns the rewards.
fn until_over(episodes: &mut Episodes, action: [f64; 2]) -> Vec<f64> {
    let mut rewards = Vec::new();
    while episodes.outcome(0) == Outcome::Rolling && rewards.len() < 1000 {
        episodes.step(&[action]).unwrap();
        rewards.push(episodes.reward(0));
    }
    rewards
}

/// Returns the whole state of a ball as bits.
fn state(episodes: &Episodes, ball: usize) -> (Vec<u64>, u64, Outcome) {
    let ((place, velocity), tilt) = (episodes.motion(ball), episodes.tilt(ball));
    let numbers = [place.to_array(), velocity.to_array()].concat();
    let numbers = numbers.into_iter().chain([tilt.about_x, tilt.about_z, episodes.reward(ball)]);
    let bits = numbers.map(f64::to_bits).collect();
    (bits, episodes.taken(ball), episodes.outcome(ball))
}

#[test]
fn an_episode_has_the_same_bits_alone_and_among_others() {
    for (rule, friction) in rules().map(|rule| (rule, 0.0)).into_iter().chain([(rules()[1], 0.4)]) {
        let rewards = Rewards { shaping: 0.1, ..Rewards::default() };
        let options =
            EpisodeOptions { rule, friction, max_steps: Some(40), rewards, ..Default::default() };
        let arena = Arc::new(Arena::new(Maze::course().unwrap(), options).unwrap());
        let mut many = Episodes::new(Arc::clone(&arena), 5).unwrap();
        let mut alone: Vec<Episodes> =
            (0..5).map(|_| Episodes::new(Arc::clone(&arena), 1).unwrap()).collect();
        for (ball, single) in alone.iter_mut().enumerate() {
            single.seed(0, ball as u64).unwrap();
        }
        for step in 0..150 {
            let actions: Vec<_> = (0..5).map(|ball| action(ball, step)).collect();
            many.step(&actions).unwrap();
            for (ball, single) in alone.iter_mut().enumerate() {
                single.step(&[actions[ball]]).unwrap();
                assert_eq!(state(&many, ball), state(single, 0), "{rule:?}, ball {ball}");
                // Resets happen at different times and while other balls roll.
                if step % 30 == 4 * ball || single.outcome(0) != Outcome::Rolling {
                    single.reset(&[0], Start::Random).unwrap();
                    many.reset(&[ball], Start::Random).unwrap();
                }
            }
        }
    }
}

#[test]
fn a_ball_on_a_slope_gains_what_gravity_gives() {
    for rule in rules() {
        let tilt_speed_degrees_per_second = f64::INFINITY;
        let options = EpisodeOptions { rule, tilt_speed_degrees_per_second, ..Default::default() };
        let mut episodes = on(&open_floor(0.0), options);
        for _ in 0..50 {
            episodes.step(&[[0.5, 0.0]]).unwrap();
        }
        let (_, velocity) = episodes.motion(0);
        // 1 s at 10°. Fifty frames add about fifty rounding errors.
        let expected = 9.8 * libm::sin(10f64.to_radians());
        assert!((velocity.x - expected).abs() < 1e-12, "{rule:?}: {velocity}");
        assert!(velocity.z.abs() < 1e-12);
    }
}

#[test]
fn the_tilt_follows_no_faster_than_it_may() {
    let mut episodes = on(&open_floor(0.0), EpisodeOptions::default());
    for step in 1..=30 {
        episodes.step(&[[1.0, -1.0]]).unwrap();
        // 60°/s: 1.2° per frame about both axes, until both together are 20°.
        let expected = (1.2 * step as f64).min(20.0 / 2f64.sqrt()).to_radians();
        let tilt = episodes.tilt(0);
        // Turns below 2e-5 rad are skipped.
        assert!((tilt.about_x + expected).abs() < 2.1e-5, "{tilt:?} after {step}");
        assert!((tilt.about_z + expected).abs() < 2.1e-5, "{tilt:?} after {step}");
    }
}

#[test]
fn a_collectible_counts_once() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([2.0, 0.5, 0.0]));
    for rule in rules() {
        let options = EpisodeOptions { rule, ..Default::default() };
        let mut episodes = on(&scene, options);
        let mut seen = [0.0; 7];
        episodes.observe(0, &mut seen);
        assert_eq!(seen[6], 1.0);
        let rewards = until_over(&mut episodes, [1.0, 0.0]);
        assert_eq!(rewards.iter().filter(|reward| **reward == 1.0).count(), 1);
        assert_eq!(episodes.taken(0), 1);
        episodes.observe(0, &mut seen);
        assert_eq!(seen[6], 0.0);
        assert_eq!(episodes.outcome(0), Outcome::Fell);
    }
}

#[test]
fn touching_an_end_wall_wins_and_nothing_is_earned_after_it() {
    for rule in rules() {
        let options = EpisodeOptions { rule, max_steps: Some(999), ..Default::default() };
        let mut episodes = on(&open_floor(0.0), options);
        let rewards = until_over(&mut episodes, [-1.0, 0.0]);
        assert_eq!(episodes.outcome(0), Outcome::Won);
        assert_eq!(rewards.iter().sum::<f64>(), 1.0);
        assert_eq!(rewards.last(), Some(&1.0));
        for _ in 0..100 {
            episodes.step(&[[-1.0, 0.0]]).unwrap();
            assert_eq!((episodes.outcome(0), episodes.reward(0)), (Outcome::Won, 0.0));
        }
    }
}

#[test]
fn a_ball_that_falls_ends_its_episode_and_starts_again_when_it_is_reset() {
    for rule in rules() {
        let options = EpisodeOptions { rule, ..Default::default() };
        let mut episodes = on(&open_floor(0.0), options);
        let rewards = until_over(&mut episodes, [0.0, 1.0]);
        assert_eq!(episodes.outcome(0), Outcome::Fell);
        assert_eq!(rewards.last(), Some(&-1.0));
        let (place, _) = episodes.motion(0);
        // The edge is at 10 m; a ball this fast moves less than half a metre in a frame.
        assert!((10.0..10.5).contains(&place.z), "{rule:?}: fell at {place}");
        let new = state(&on(&open_floor(0.0), options), 0);
        episodes.reset(&[0], Start::Maze).unwrap();
        assert_eq!(state(&episodes, 0), new);
    }
}

#[test]
fn an_episode_that_takes_too_long_is_over_and_did_not_end_otherwise() {
    let options = EpisodeOptions { max_steps: Some(7), ..Default::default() };
    let mut episodes = on(&open_floor(0.0), options);
    let steps = until_over(&mut episodes, [0.0; 2]).len();
    assert_eq!((steps, episodes.outcome(0)), (7, Outcome::TimeUp));
}

#[test]
fn shaping_gives_no_more_than_the_way_there_was_to_go() {
    // Without discount, shaping adds the final potential, 0, minus the initial one.
    let rewards = Rewards { shaping: 1.0, discount: 1.0, ..Rewards::default() };
    let options = EpisodeOptions { rewards, ..Default::default() };
    let mut episodes = on(&open_floor(0.0), options);
    let earned: f64 = until_over(&mut episodes, [-1.0, 0.0]).iter().sum();
    assert_eq!(episodes.outcome(0), Outcome::Won);
    // From 0 to the end wall's face at -2.9, which the ball touches half a metre earlier. The way
    // ends up to 1.5 cells, 0.125 m, before that, and begins in the middle of a cell.
    let way = earned - 1.0;
    assert!((2.2..=2.45).contains(&way), "{way} m");
}

#[test]
fn a_ball_is_shown_on_the_tilted_ground_without_what_it_has_taken() {
    let mut scene = open_floor(0.0);
    scene.colliders.push(collectible([2.0, 0.5, 0.0]));
    let mut episodes = on(&scene, EpisodeOptions::default());
    assert_eq!(episodes.scene(0).colliders.len(), 3);
    while episodes.taken(0) == 0 {
        episodes.step(&[[1.0, 0.3]]).unwrap();
    }
    let shown = episodes.scene(0);
    assert_eq!(shown.colliders.len(), 2);
    let world = shown.world().unwrap();
    let (ball, (_, ground)) = (world.spheres().get(0), world.colliders().next().unwrap());
    let up = ground.pose.rotation * carom::DVec3::Y;
    // 20° towards +x, and less towards +z.
    assert!(up.x > 0.3 && up.z > 0.05 && up.y > 0.9, "{up}");
    // The ball touches the ground, up to rounding of metres.
    assert!((ball.position.dot(up) - 0.5).abs() < 1e-9);
}

#[test]
fn balls_start_anywhere_but_in_walls_and_where_something_is_to_be_had() {
    for maze in [Maze::course().unwrap(), Maze::random(3, 6, 5).unwrap()] {
        let arena = Arc::new(Arena::new(maze.clone(), EpisodeOptions::default()).unwrap());
        let count = arena.starts().len();
        assert!(count > 500, "{count} places");
        let mut episodes = Episodes::new(Arc::clone(&arena), 300).unwrap();
        let all: Vec<usize> = (0..300).collect();
        episodes.reset(&all, Start::Random).unwrap();
        let mut world = maze.scene().world().unwrap();
        let ball = world.spheres().get(0);
        for &place in arena.starts() {
            world.set_sphere(world.spheres().ids()[0], ball.with_position(place)).unwrap();
            // Rounding of sums of metres.
            assert_eq!(world.overlaps(1e-9), []);
        }
        episodes.step(&[[0.0; 2]; 300]).unwrap();
        assert!(all.iter().all(|&ball| episodes.taken(ball) == 0));
        assert!(all.iter().all(|&ball| episodes.outcome(ball) == Outcome::Rolling));
        let places: Vec<_> = all.iter().map(|&ball| episodes.motion(ball).0.to_array()).collect();
        let different = all.iter().filter(|&&ball| !places[..ball].contains(&places[ball])).count();
        assert!(different > 200, "{different} different places");
    }
}

#[test]
fn observations_keep_to_their_bounds() {
    let options = EpisodeOptions { rule: Discrete::default().into(), ..Default::default() };
    for maze in [Maze::course().unwrap(), Maze::from_scene(&open_floor(0.0)).unwrap()] {
        let mut episodes = episodes(maze, options, 20);
        let length = episodes.arena().observation_length();
        let mut seen = vec![f32::NAN; length];
        for step in 0..500 {
            let actions: Vec<_> = (0..20).map(|ball| action(ball, step / 20)).collect();
            episodes.step(&actions).unwrap();
            for ball in 0..20 {
                episodes.observe(ball, &mut seen);
                let [low, high] = episodes.arena().observation_bounds();
                for (index, value) in seen.iter().enumerate() {
                    let is_within = (low[index]..=high[index]).contains(value);
                    assert!(is_within, "number {index}: {value}");
                }
            }
        }
    }
}

#[test]
fn a_ball_that_meets_walls_too_often_takes_the_frame_otherwise_and_others_do_not_feel_it() {
    let few = Exact::default().with_max_impacts(3).into();
    let maze = || Maze::course().unwrap();
    let mut narrow = episodes(maze(), EpisodeOptions { rule: few, ..Default::default() }, 8);
    let mut wide = episodes(maze(), EpisodeOptions::default(), 8);
    let mut rough = [false; 8];
    for step in 0..300 {
        let actions: Vec<_> = (0..8).map(|ball| action(ball, step / 10)).collect();
        let before = narrow.rough_frames();
        narrow.step(&actions).unwrap();
        wide.step(&actions).unwrap();
        for (ball, rough) in rough.iter_mut().enumerate() {
            *rough |= state(&narrow, ball) != state(&wide, ball);
        }
        let differs = rough.iter().filter(|rough| **rough).count() as u64;
        assert!(differs <= narrow.rough_frames(), "{differs} differ after {before} rough frames");
    }
    assert!(narrow.rough_frames() > 0, "nothing was rescued");
    for ball in 0..8 {
        assert_eq!(narrow.outcome(ball), Outcome::Rolling);
        assert!((narrow.motion(ball).0.y - maze().start().y).abs() < 0.1);
    }
}

#[test]
fn what_makes_no_sense_is_refused_and_nothing_is_done() {
    let arena = |options| Arena::new(Maze::course().unwrap(), options);
    let rewards = Rewards { discount: 1.5, ..Rewards::default() };
    let default = EpisodeOptions::default();
    for (field, options) in [
        ("frame_time", EpisodeOptions { frame_time: f64::NAN, ..default }),
        ("frames_per_step", EpisodeOptions { frames_per_step: 0, ..default }),
        ("max_tilt_degrees", EpisodeOptions { max_tilt_degrees: 46.0, ..default }),
        ("max_steps", EpisodeOptions { max_steps: Some(0), ..default }),
        ("reset_height", EpisodeOptions { reset_height: 3.0, ..default }),
        ("discount", EpisodeOptions { rewards, ..default }),
    ] {
        let said = arena(options).unwrap_err().to_string();
        assert!(said.contains(field), "{said}");
    }
    let arena = Arc::new(arena(default).unwrap());
    assert!(matches!(Episodes::new(Arc::clone(&arena), 0), Err(EpisodeError::Count { .. })));
    let mut episodes = Episodes::new(arena, 2).unwrap();
    let before = [state(&episodes, 0), state(&episodes, 1)];
    let wrong = episodes.step(&[[0.0; 2]]).unwrap_err();
    assert!(matches!(wrong, EpisodeError::Count { balls: 2, count: 1, .. }));
    let wrong = episodes.step(&[[1.0; 2], [0.0, f64::NAN]]).unwrap_err();
    assert!(matches!(wrong, EpisodeError::Action { ball: 1, .. }));
    let wrong = episodes.reset(&[0, 2], Start::Random).unwrap_err();
    assert!(matches!(wrong, EpisodeError::NoBall { ball: 2, balls: 2 }));
    assert_eq!(before, [state(&episodes, 0), state(&episodes, 1)]);
}

#[test]
fn a_ball_with_friction_rolls_and_starts_anew_without_spin() {
    let options = EpisodeOptions {
        friction: 0.4,
        tilt_speed_degrees_per_second: f64::INFINITY,
        ..Default::default()
    };
    let mut rolling = on(&open_floor(0.0), options);
    let sliding = EpisodeOptions { friction: 0.0, ..options };
    let mut sliding = on(&open_floor(0.0), sliding);
    for _ in 0..50 {
        rolling.step(&[[0.2, 0.0]]).unwrap();
        sliding.step(&[[0.2, 0.0]]).unwrap();
    }
    let speeds = [&rolling, &sliding].map(|it| it.motion(0).1.x);
    assert!((speeds[0] / speeds[1] - 5.0 / 7.0).abs() < 1e-6, "{speeds:?}");
    rolling.reset(&[0], Start::Maze).unwrap();
    rolling.step(&[[0.0, 0.0]]).unwrap();
    assert_eq!(rolling.motion(0).1.x, 0.0);
}
