//! Games on the built-in table: shots that are computed beforehand are judged as they were meant, and moves decide
//! everything.

use carom::DVec3;
use carom_billiards::{BallInHand, Foul, Game, GameError, Move, MoveError, Stage, Table, Verdict};
use carom_scene::scene::{Rule, Strike};
use carom_scene::{Library, Scene};

const RADIUS: f64 = 0.028575;

fn game(players: usize) -> Game {
    Game::new(Table::built_in().unwrap(), players).unwrap()
}

/// Returns a table with the balls at these places (x, z); all others lie along the head rail.
fn table(places: &[(u64, [f64; 2])]) -> Table {
    let (mut scene, _) = Library::new().find("nine-ball", &[]).unwrap();
    set_out(&mut scene, places);
    Table::from_scene(&scene).unwrap()
}

fn set_out(scene: &mut Scene, places: &[(u64, [f64; 2])]) {
    for ball in &mut scene.spheres {
        let aside = [-1.2, -0.5 + 0.1 * ball.user_data as f64];
        let place = places.iter().find(|(it, _)| *it == ball.user_data);
        let [x, z] = place.map_or(aside, |it| it.1);
        ball.position = [x, RADIUS, z];
    }
}

/// Returns a strike of this speed from a place towards another.
fn towards(from: [f64; 2], to: [f64; 2], speed: f64) -> Strike {
    let azimuth_degrees = libm::atan2(from[1] - to[1], to[0] - from[0]).to_degrees();
    Strike { azimuth_degrees, ..Strike::new(speed) }
}

/// Strikes, and returns the verdict.
fn shoot(game: &mut Game, strike: Strike) -> Verdict {
    game.play(Move::Strike(strike)).unwrap();
    loop {
        if let Some(verdict) = game.step().unwrap() {
            return verdict;
        }
    }
}

/// The upper right corner pocket, and a ball and a cue ball on a line with it.
const POCKET: [f64; 2] = [1.301841, -0.666841];
const ON_LINE: [f64; 2] = [1.101841, -0.466841];
const BEHIND: [f64; 2] = [0.801841, -0.166841];

#[test]
fn the_break_of_the_scene_is_legal_and_the_push_out_may_follow() {
    let mut game = game(2);
    let break_shot = Strike { azimuth_degrees: 0.9, offset: [0.0, 0.15], ..Strike::new(8.0) };
    assert_eq!(shoot(&mut game, break_shot).foul, None);
    assert_eq!(game.rack().stage(), Stage::AfterBreak);
    let fallen = (1..10).filter(|ball| !game.rack().has(*ball)).count();
    assert_eq!(game.balls().count(), 10 - fallen);
    game.play(Move::PushOut).unwrap();
}

#[test]
fn a_straight_shot_pockets_the_ball_under_every_rule() {
    for rule in [Rule::Exact, Rule::Contact, Rule::Discrete, Rule::Bisect] {
        let (mut scene, _) = Library::new().find("nine-ball", &[]).unwrap();
        set_out(&mut scene, &[(0, BEHIND), (1, ON_LINE)]);
        scene.simulation.rule = rule;
        // Rules without rolling friction never stop a ball; short frames keep it out of the surfaces.
        scene.simulation.frame_time = 1.0 / 240.0;
        let mut game = Game::new(Table::from_scene(&scene).unwrap(), 2).unwrap();
        let aim = towards(BEHIND, POCKET, 1.5);
        // Below the middle: the cue ball stops where it meets the ball.
        let verdict = shoot(&mut game, Strike { offset: [0.0, -0.2], ..aim });
        assert!(!game.rack().has(1), "{rule}");
        assert!(game.rack().has(2), "{rule}");
        if matches!(rule, Rule::Exact | Rule::Contact) {
            assert_eq!((verdict.foul, verdict.continues), (None, true), "{rule}");
        }
    }
}

#[test]
fn a_ball_that_is_not_the_lowest_is_a_foul_and_the_cue_ball_is_in_hand() {
    let mut game = Game::new(table(&[(0, BEHIND), (4, ON_LINE)]), 2).unwrap();
    let verdict = shoot(&mut game, towards(BEHIND, ON_LINE, 1.5));
    assert_eq!(verdict.foul, Some(Foul::WrongBall { hit: 4, lowest: 1 }));
    assert_eq!(game.rack().in_hand(), BallInHand::Anywhere);
    assert_eq!(game.rack().shooter(), 1);
    game.play(Move::Place { x: 0.5, z: 0.25 }).unwrap();
    let (_, cue_ball) = game.cue_ball().unwrap();
    assert_eq!(cue_ball.position, DVec3::new(0.5, RADIUS, 0.25));
    // Into a ball, a cushion, a pocket, off the table.
    for (x, z) in [(-1.2, -0.4), (1.27, 0.0), POCKET.into(), (2.0, 0.0), (f64::NAN, 0.0)] {
        let refused = game.play(Move::Place { x, z }).unwrap_err();
        assert!(matches!(refused, GameError::Move(MoveError::Place)), "{x} {z}");
    }
}

#[test]
fn a_scratch_puts_the_cue_ball_back_and_a_nine_on_it_to_the_foot_spot() {
    // The nine falls first, and the cue ball, struck with topspin, follows it.
    let mut game = Game::new(table(&[(0, BEHIND), (9, ON_LINE), (1, [0.6, 0.3])]), 2).unwrap();
    let strike = Strike { offset: [0.0, 0.4], ..towards(BEHIND, POCKET, 3.0) };
    let verdict = shoot(&mut game, strike);
    assert_eq!((verdict.foul, verdict.spots_nine), (Some(Foul::Scratch), true));
    let place = |game: &Game, wanted: u8| {
        let (id, _) = game.balls().find(|(_, ball)| *ball == wanted).unwrap();
        game.world().sphere(id).unwrap().position
    };
    // Behind ball 1, which is on the spot, by a sixteenth of a radius at most.
    let behind = place(&game, 9).distance(place(&game, 1)) / RADIUS;
    assert!((2.0..2.0 + 1.0 / 16.0 + 1e-9).contains(&behind), "{behind}");
    assert_eq!(place(&game, 0), game.table().ball(0).unwrap().position);
    assert!(game.world().overlaps(0.0).is_empty());
}

#[test]
fn a_nine_behind_the_lowest_ball_wins_by_a_combination() {
    let one = [0.951841, -0.316841];
    let mut game = Game::new(table(&[(0, BEHIND), (1, one), (9, ON_LINE)]), 1).unwrap();
    let verdict = shoot(&mut game, towards(BEHIND, POCKET, 3.0));
    assert_eq!((verdict.foul, verdict.winner), (None, Some(0)));
    assert_eq!(game.best().unwrap().strokes, 1);
    assert_eq!(game.racks_won(), [1, 0]);
    let over = game.play(Move::Strike(Strike::new(1.0))).unwrap_err();
    assert!(matches!(over, GameError::Move(MoveError::Shot)));
    game.play_again();
    assert_eq!((game.rack().stage(), game.balls().count()), (Stage::Break, 10));
}

#[test]
fn a_ball_that_jumps_off_the_table_is_a_foul() {
    let mut game = Game::new(table(&[(0, [1.0, 0.2]), (1, [0.3, 0.3])]), 2).unwrap();
    let mut strike = towards([1.0, 0.2], [2.0, 0.2], 9.0);
    strike.elevation_degrees = 35.0;
    let verdict = shoot(&mut game, strike);
    assert_eq!(verdict.foul, Some(Foul::Scratch));
    assert!(game.cue_ball().is_some());
}

#[test]
fn the_same_moves_by_their_texts_give_the_same_bits() {
    let mut game = game(1);
    let lines = ["place -0.8 0.1", "strike 7.5 3.25 0 0.1 0.2", "strike 2 200.125 5 -0.3 -0.1"];
    for line in lines {
        game.play(line.parse().unwrap()).unwrap();
        while game.is_rolling() {
            game.step().unwrap();
        }
    }
    let again: Vec<Move> = game.moves().iter().map(|it| it.to_string().parse().unwrap()).collect();
    assert_eq!(again, game.moves());
    let hash = game.world().state_hash();
    game.play_again();
    for wanted in again {
        game.play(wanted).unwrap();
        while game.is_rolling() {
            game.step().unwrap();
        }
    }
    assert_eq!(game.world().state_hash(), hash);
}

#[test]
fn the_path_of_a_strike_is_where_the_cue_ball_then_goes() {
    let mut game = game(1);
    let strike =
        Strike { offset: [0.2, -0.1], ..Strike { azimuth_degrees: 75.0, ..Strike::new(3.0) } };
    let path = game.path(&strike);
    assert!(path.len() > 100, "{}", path.len());
    game.play(Move::Strike(strike)).unwrap();
    // Points are 1/40 s apart: two of them are three frames.
    for (index, point) in path.iter().enumerate().skip(2).step_by(2) {
        for _ in 0..3 {
            game.step().unwrap();
        }
        let (_, ball) = game.cue_ball().unwrap();
        // The times are sums of frames here, and a product there.
        assert!((ball.position - *point).length() < 1e-12, "{index}");
    }
}

#[test]
fn moves_that_no_player_can_make_are_refused_and_change_nothing() {
    let mut game = game(1);
    let hash = game.world().state_hash();
    for text in [
        "strike -1 0 0 0 0",
        "strike 1e9 0 0 0 0",
        "strike NaN 0 0 0 0",
        "strike 1 inf 0 0 0",
        "strike 1 0 91 0 0",
        "strike 1 0 0 0.6 0",
        "place 0.5 0",
        "push-out",
        "shoot",
        "leave",
    ] {
        let wanted: Move = text.parse().unwrap();
        assert!(matches!(game.play(wanted), Err(GameError::Move(_))), "{text}");
    }
    for text in ["", "place", "place 1", "place a b", "strike 1 2 3 4", "jump", "push-out 1"] {
        assert_eq!(text.parse::<Move>(), Err(MoveError::Text), "{text}");
    }
    assert_eq!((game.world().state_hash(), game.moves().len()), (hash, 0));
}

#[test]
fn scenes_without_balls_cloth_cushions_or_pockets_are_no_tables() {
    let (scene, _) = Library::new().find("nine-ball", &[]).unwrap();
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut changed = scene.clone();
        change(&mut changed);
        Table::from_scene(&changed).unwrap_err().to_string()
    };
    assert!(refused(&|it| it.spheres.truncate(9)).contains("ten single spheres"));
    assert!(refused(&|it| it.spheres[3].user_data = 1).contains("user_data"));
    assert!(refused(&|it| it.spheres[3].user_data = u64::MAX).contains("user_data"));
    assert!(refused(&|it| it.colliders.retain(|it| it.name != "cloth")).contains("cloth"));
    assert!(refused(&|it| it.colliders.retain(|it| !it.capture)).contains("pockets"));
    let is_cushion = |name: &str| ["cushion", "jaw", "rail"].iter().any(|it| name.ends_with(it));
    assert!(refused(&|it| it.colliders.retain(|it| !is_cushion(&it.name))).contains("cushion"));
    assert!(Table::from_scene(&Library::new().find("billiards", &[]).unwrap().0).is_err());
}
