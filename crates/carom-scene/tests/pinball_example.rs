//! The pinball of `examples/pinball`, without its window. It has the keys of a game of ten seconds and the bits that it
//! leads to; the tests of the JavaScript package and of the C interface play the same game.

#[path = "../../../examples/pinball/src/table.rs"]
#[expect(dead_code, reason = "the window uses more of it")]
mod table;

use table::{Keys, Role, Table};

/// The state hash and the score after [`keys`] of ten seconds, as the other languages read them.
const TEN_SECONDS: &str = include_str!("../../../examples/pinball/ten_seconds.txt");

/// Keys of a player who draws the plunger again and again, and hammers on both flippers.
fn keys(frame: usize) -> Keys {
    let [left, right] = [20, 27].map(|period: usize| (frame / period).is_multiple_of(2));
    Keys { left, right, plunger: frame % 90 < 60 }
}

fn played(frames: usize) -> Table {
    let mut table = Table::new().unwrap();
    for frame in 0..frames {
        table.step(keys(frame)).unwrap();
    }
    table
}

#[test]
fn ten_seconds_lead_to_the_bits_that_other_languages_reach() {
    let table = played(1200);
    let reached = format!("{} {}", table.world.state_hash(), table.score());
    assert_eq!(reached, TEN_SECONDS.trim());
}

#[test]
fn the_ball_stays_on_the_table_in_its_plane_and_everything_scores() {
    let mut table = Table::new().unwrap();
    let mut hit = [Role::Bumper, Role::Slingshot, Role::Target, Role::Drain].map(|it| (it, 0));
    for frame in 0..6000 {
        for sound in table.step(keys(frame)).unwrap() {
            for (role, count) in &mut hit {
                *count += usize::from(*role == Role::of(sound.collider));
            }
        }
        let ball = table.ball();
        // The arch is the highest and widest part; an overlap of the rule stays far below this.
        let inside = (-0.251..=0.301).contains(&ball.x) && (0.0..=0.901).contains(&ball.y);
        assert!(inside && ball.z == 0.0, "frame {frame}: {ball}");
    }
    assert!(hit.iter().all(|(_, count)| *count > 0), "{hit:?}");
}

#[test]
fn a_full_pull_brings_the_ball_over_the_gate_and_a_short_one_does_not() {
    let leaves_lane = |pulled: usize| {
        let mut table = Table::new().unwrap();
        (0..360).any(|frame| {
            table.step(Keys { plunger: frame < pulled, ..Keys::default() }).unwrap();
            table.ball().x < 0.2
        })
    };
    assert!(leaves_lane(64) && !leaves_lane(20));
}

#[test]
fn a_flipper_throws_a_ball_that_rolls_on_it_past_the_bumpers() {
    let highest = |raises: bool| {
        let mut table = Table::new().unwrap();
        let id = table.world.spheres().ids()[0];
        let mut ball = table.world.sphere(id).unwrap();
        ball.position = carom::DVec3::new(-0.12, 0.19, 0.0);
        table.world.set_sphere(id, ball).unwrap();
        let raised = |x: f64| raises && x > -0.065;
        let heights = (0..240).map(|_| {
            let left = raised(table.ball().x);
            table.step(Keys { left, ..Keys::default() }).unwrap();
            table.ball().y
        });
        heights.fold(0.0, f64::max)
    };
    assert!(highest(true) > 0.6, "{}", highest(true));
    assert!(highest(false) < 0.2, "{}", highest(false));
}

#[test]
fn a_game_ends_with_its_third_ball_and_the_plunger_begins_the_next() {
    let mut table = Table::new().unwrap();
    let mut lost = Vec::new();
    // Without flippers.
    for frame in 0..20_000 {
        let before = table.balls();
        let plunger = frame % 90 < 60 && before > 0;
        table.step(Keys { plunger, ..Keys::default() }).unwrap();
        if table.balls() < before {
            lost.push(table.balls());
        }
    }
    assert_eq!(lost, [2, 1, 0]);
    let score = table.score();
    assert!(score > 0 && table.is_ball_waiting());
    for frame in 0..70 {
        table.step(Keys { plunger: frame < 60, ..Keys::default() }).unwrap();
    }
    assert_eq!((table.balls(), table.score()), (3, 0));
}

#[test]
fn a_game_that_goes_back_and_repeats_its_keys_ends_in_the_same_bits() {
    let mut table = played(900);
    let end = (table.world.state_hash(), table.score(), table.balls());
    // Twice, in two parts, over more frames than are kept.
    for _ in 0..2 {
        table.go_back(100);
        table.go_back(1000);
        for frame in 540..900 {
            table.step(keys(frame)).unwrap();
        }
        assert_eq!((table.world.state_hash(), table.score(), table.balls()), end);
    }
}
