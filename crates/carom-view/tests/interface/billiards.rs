//! Nine-ball by the pointer, and racks that are played again.

use carom_billiards::{BallInHand, Game, Stage, Table};
use carom_scene::Library;
use carom_session::Link;
use carom_view::{Setup, Start};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Vec2};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, press, setup};
use crate::links::copied_text;

/// A rack with one stroke: a combination of ball 1 and the nine, which lie before a corner pocket.
const COMBINATION: &str = "strike 3 45 0 0 0";

/// A table with the cue ball, ball 1 and the nine on a line with a corner pocket.
fn combination() -> Table {
    let (mut scene, _) = Library::new().find("nine-ball", &[]).expect("a built-in scene");
    for ball in &mut scene.spheres {
        let [x, z] = match ball.user_data {
            0 => [0.801841, -0.166841],
            1 => [0.951841, -0.316841],
            9 => [1.101841, -0.466841],
            other => [-1.2, -0.5 + 0.1 * other as f64],
        };
        ball.position = [x, 0.028575, z];
    }
    Table::from_scene(&scene).expect("a table")
}

pub fn start() -> Option<Start> {
    Some(Start::Billiards(Box::new(Table::built_in().expect("the built-in table"))))
}

/// A game of one player a stroke before its end.
pub fn start_of_combination() -> Option<Start> {
    Some(Start::Billiards(Box::new(combination())))
}

fn playing(start: Option<Start>) -> Desk {
    let mut desk = desk(Setup { start, ..setup() });
    desk.run_steps(3);
    desk
}

fn game(desk: &Desk) -> &Game {
    desk.state().billiards().expect("a game").game()
}

/// Returns the place of the cue ball on the screen.
fn cue_ball(desk: &Desk) -> Pos2 {
    let picture: Rect = desk.get_by_role_and_label(Role::Image, "Billiard table").rect();
    let screen = desk.state().billiards().expect("a game");
    screen.cue_ball_in(picture).expect("in view")
}

fn button(desk: &mut Desk, pos: Pos2, pressed: bool) {
    let (button, modifiers) = (PointerButton::Primary, Modifiers::NONE);
    desk.event(Event::PointerButton { pos, button, pressed, modifiers });
    desk.run_steps(1);
}

/// Drags from the cue ball by `way` in five steps; returns where the pointer is.
pub fn drag(desk: &mut Desk, way: Vec2) -> Pos2 {
    let from = cue_ball(desk);
    desk.event(Event::PointerMoved(from));
    desk.run_steps(1);
    button(desk, from, true);
    for i in 1..=5 {
        desk.event(Event::PointerMoved(from + way * (0.2 * i as f32)));
        desk.run_steps(1);
    }
    from + way
}

/// Waits until all balls are at rest.
fn roll(desk: &mut Desk) {
    while game(desk).is_rolling() {
        desk.run_steps(4);
    }
    desk.run_steps(1);
}

/// Strikes by a drag, and waits until all balls are at rest.
pub fn shoot(desk: &mut Desk, way: Vec2) {
    let pointer = drag(desk, way);
    button(desk, pointer, false);
    roll(desk);
}

/// Wins the rack of the combination.
pub fn win(desk: &mut Desk) {
    let wanted = COMBINATION.parse().expect("a move");
    let screen = desk.state_mut().billiards_mut().expect("a game");
    screen.play(wanted).expect("a strike");
    roll(desk);
    desk.run_steps(2);
}

#[test]
fn a_drag_from_the_cue_ball_strikes_and_the_rules_judge() {
    let mut desk = playing(start());
    desk.get_by_label("Strokes 0");
    // The camera is behind the ball: up on the screen is towards the rack.
    shoot(&mut desk, Vec2::new(0.0, -200.0));
    assert_eq!(game(&desk).moves().len(), 1);
    assert_ne!(game(&desk).rack().stage(), Stage::Break);
}

#[test]
fn a_drag_back_to_the_ball_strikes_nothing() {
    let mut desk = playing(start());
    let pointer = drag(&mut desk, Vec2::new(0.0, 1.0));
    button(&mut desk, pointer, false);
    assert_eq!(game(&desk).moves(), []);
}

#[test]
fn after_a_foul_the_cue_ball_is_dragged_to_its_place() {
    let mut desk = playing(start());
    desk.get_by_label("Two players").click();
    desk.run_steps(2);
    desk.get_by_label("Player 1");
    // Away from the rack: no ball is hit.
    shoot(&mut desk, Vec2::new(-60.0, 0.0));
    assert_eq!(game(&desk).rack().in_hand(), BallInHand::Anywhere);
    desk.run_steps(2);
    desk.get_by_label("Player 2");
    let before = game(&desk).cue_ball().expect("on the table").1.position;
    let pointer = drag(&mut desk, Vec2::new(30.0, -60.0));
    button(&mut desk, pointer, false);
    let after = game(&desk).cue_ball().expect("on the table").1.position;
    assert!(before.distance(after) > 0.05 && after.y == before.y, "{before} {after}");
    desk.get_by_label("Aim").click();
    desk.run_steps(2);
    desk.get_by_label("Drag from the cue ball, and let go to strike.");
}

/// Follows a link to the combination with moves.
fn follow(moves: &str) -> Desk {
    let link = Link::to_scene(combination().scene()).with_goal(1.0).expect("a goal");
    let link = link.with_moves(moves).expect("short moves");
    playing(Some(Start::Link(Box::new(link))))
}

#[test]
fn the_rack_of_a_link_is_played_again_and_is_none_of_the_player() {
    let mut desk = follow(COMBINATION);
    desk.get_by_label("To beat 1");
    desk.get_by_label("Watch it").click();
    desk.run_steps(20);
    roll(&mut desk);
    desk.get_by_label("This is the rack to beat.");
    assert_eq!(game(&desk).best(), None);
    desk.key_press(Key::Enter);
    desk.run_steps(3);
    assert_eq!((game(&desk).rack().stage(), game(&desk).moves().len()), (Stage::Break, 0));
}

#[test]
fn moves_that_cannot_be_read_or_made_do_no_harm() {
    for moves in ["strike", "push-out", "strike 1e300 0 0 0 0", "\u{0}", ""] {
        let mut desk = follow(moves);
        desk.get_by_label("Watch it").click();
        desk.run_steps(30);
        assert!(!desk.state().billiards().expect("a game").is_replaying(), "{moves:?}");
        assert_eq!(game(&desk).moves(), [], "{moves:?}");
    }
}

#[test]
fn a_link_has_the_moves_of_the_best_rack() {
    // The same combination beside the rack.
    let link = Link::parse("scene=nine-ball").expect("a link").with_overrides([
        "spheres.0.position=[0.801841, 0.028575, -0.166841]".parse().expect("an override"),
        "spheres.1.position=[0.951841, 0.028575, -0.316841]".parse().expect("an override"),
        "spheres.5.position=[1.101841, 0.028575, -0.466841]".parse().expect("an override"),
    ]);
    let mut desk = playing(Some(Start::Link(Box::new(link))));
    win(&mut desk);
    desk.get_by_label("The best rack so far.");
    press(&mut desk, Key::U);
    desk.run_steps(2);
    desk.get_by_label("Copy the link").click();
    desk.run_steps(1);
    let copied = copied_text(&desk).expect("something was copied");
    let link = Link::parse(&copied).expect("a link");
    assert_eq!((link.goal(), link.moves()), (Some(1.0), Some(COMBINATION)));
}
