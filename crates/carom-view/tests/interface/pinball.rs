//! Pinball by keys and by fingers.

use carom_pinball::{Game, GameState, Table};
use carom_session::Link;
use carom_view::{Setup, Start};
use egui::{Key, TouchPhase, Vec2};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, press, setup};
use crate::links::copied_text;
use crate::touch::{PLACE, finger};

pub fn start() -> Option<Start> {
    let table = Table::built_in().expect("the built-in table");
    Some(Start::Pinball(Box::new(table)))
}

fn playing() -> Desk {
    desk(Setup { start: start(), ..setup() })
}

fn game(desk: &Desk) -> &Game {
    desk.state().pinball().expect("a game").game()
}

/// Pulls the plunger for four frames of the interface, a second, and lets go.
pub fn shoot(desk: &mut Desk) {
    desk.key_down(Key::ArrowDown);
    desk.run_steps(4);
    desk.key_up(Key::ArrowDown);
}

/// Shoots each ball, and lets it go down the drain.
pub fn lose(desk: &mut Desk) {
    while game(desk).state() == GameState::Playing {
        if game(desk).waits() {
            shoot(desk);
        }
        desk.run_steps(4);
    }
}

/// Returns how far up the table a flipper reaches, by the z of its pose \[m\].
fn height(desk: &Desk, name: &str) -> f64 {
    let game = game(desk);
    let place = game.scene().colliders.iter().position(|it| it.name == name).expect("a flipper");
    let (_, flipper) = game.world().colliders().nth(place).expect("a flipper");
    -flipper.pose.position.z
}

#[test]
fn each_key_raises_its_flipper_while_it_is_held() {
    let keys = [
        (Key::ArrowLeft, "left flipper"),
        (Key::A, "left flipper"),
        (Key::ArrowRight, "right flipper"),
        (Key::D, "right flipper"),
    ];
    for (key, name) in keys {
        let mut desk = playing();
        desk.run_steps(2);
        let rest = height(&desk, name);
        desk.key_down(key);
        desk.run_steps(6);
        assert!(height(&desk, name) > rest + 0.02, "{key:?}");
        desk.key_up(key);
        desk.run_steps(10);
        assert!((height(&desk, name) - rest).abs() < 1e-12, "{key:?}");
    }
}

#[test]
fn fingers_raise_the_flippers_of_their_halves_and_shoot_a_ball_that_waits() {
    let mut desk = playing();
    desk.run_steps(2);
    let rest = height(&desk, "left flipper");
    finger(&mut desk, 0, TouchPhase::Start, PLACE);
    finger(&mut desk, 1, TouchPhase::Start, PLACE + Vec2::new(500.0, 0.0));
    desk.run_steps(6);
    for name in ["left flipper", "right flipper"] {
        assert!(height(&desk, name) > rest + 0.02, "{name}");
    }
    assert!(game(&desk).waits());
    finger(&mut desk, 1, TouchPhase::End, PLACE + Vec2::new(500.0, 0.0));
    finger(&mut desk, 0, TouchPhase::End, PLACE);
    let is_shot = (0..20).any(|_| {
        desk.run_steps(1);
        !game(&desk).waits()
    });
    assert!(is_shot);
    desk.run_steps(6);
    assert!((height(&desk, "right flipper") - rest).abs() < 1e-12);
}

#[test]
fn after_the_last_ball_enter_plays_again() {
    let mut desk = playing();
    lose(&mut desk);
    desk.run_steps(2);
    desk.get_by_label("Game over");
    let score = game(&desk).score();
    desk.key_press(Key::Enter);
    desk.run_steps(3);
    assert_eq!((game(&desk).state(), game(&desk).balls()), (GameState::Playing, 3));
    assert_eq!((game(&desk).score(), game(&desk).best()), (0, Some(score)));
    assert!(desk.query_by_label("Game over").is_none());
}

#[test]
fn the_last_screen_leads_to_the_scene() {
    let mut desk = playing();
    lose(&mut desk);
    desk.run_steps(2);
    desk.get_by_label("Watch it as a scene").click();
    desk.run_steps(3);
    let watching = desk.state().watching().expect("a scene");
    assert_eq!(watching.view().scene.name, "pinball");
}

#[test]
fn the_help_says_how_to_raise_the_flippers() {
    let mut desk = playing();
    desk.key_press(Key::F1);
    desk.run_steps(3);
    desk.get_by_label("left and right arrow, or A and D");
}

#[test]
fn the_best_score_is_kept_when_the_table_is_opened_again() {
    let mut desk = playing();
    lose(&mut desk);
    let score = game(&desk).score();
    for text in ["scene=cradle", "scene=pinball&goal=999999"] {
        desk.state_mut().follow(&Link::parse(text).expect("a link"));
        desk.run_steps(3);
    }
    assert_eq!((game(&desk).state(), game(&desk).best()), (GameState::Playing, Some(score)));
    desk.get_by_label(&format!("Best {score}"));
    desk.get_by_label("To beat 999999");
}

#[test]
fn a_link_to_a_game_has_the_best_score_as_the_one_to_beat() {
    let link = Link::parse("scene=pinball&goal=999999").expect("a link");
    let mut desk = desk(Setup { start: Some(Start::Link(Box::new(link))), ..setup() });
    lose(&mut desk);
    desk.run_steps(2);
    desk.get_by_label("999999 points are still to beat.");
    let score = game(&desk).score();
    press(&mut desk, Key::U);
    desk.run_steps(2);
    desk.get_by_label("Copy the link").click();
    desk.run_steps(1);
    let copied = copied_text(&desk).expect("something was copied");
    let copied = Link::parse(&copied).expect("a link");
    assert_eq!(copied.goal(), Some(score as f64));
    // Its moves are the same game once more, which is none of the player's.
    desk.state_mut().follow(&copied);
    desk.run_steps(2);
    desk.get_by_label("Watch it").click();
    desk.run_steps(2);
    while game(&desk).state() == GameState::Playing {
        desk.run_steps(4);
    }
    assert_eq!((game(&desk).score(), game(&desk).best()), (score, Some(score)));
    desk.run_steps(2);
    desk.get_by_label("This is the game to beat.");
    desk.key_press(Key::Enter);
    desk.run_steps(2);
    assert_eq!((game(&desk).state(), game(&desk).score()), (GameState::Playing, 0));
}

#[test]
fn moves_that_are_no_keys_do_no_harm() {
    let link = Link::parse("scene=pinball").expect("a link").with_moves("4 X").expect("short");
    let mut desk = desk(Setup { start: Some(Start::Link(Box::new(link))), ..setup() });
    desk.run_steps(2);
    desk.get_by_label("Watch it").click();
    desk.run_steps(2);
    desk.get_by_label("The moves of the link cannot be read");
    assert_eq!(game(&desk).state(), GameState::Playing);
}
