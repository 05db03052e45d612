//! The maze game by keys.

use carom_maze::{GameState, Maze};
use carom_session::Link;
use carom_view::{Action, Setup, Start};
use egui::Key;
use egui::epaint::Shape;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, press, setup};
use crate::links::copied_text;

/// The end wall is to the right of the start.
pub const SHORT: &str = "#######\n#S o E#\n#######\n";

pub fn playing(maze: Maze) -> Desk {
    desk(Setup { start: Some(Start::Maze(Box::new(maze))), ..setup() })
}

/// Holds the right arrow until the game is won.
pub fn win(desk: &mut Desk) {
    desk.key_down(Key::ArrowRight);
    for _ in 0..1200 {
        desk.run_steps(1);
        if desk.state().maze().is_some_and(|it| it.is_won()) {
            break;
        }
    }
    desk.key_up(Key::ArrowRight);
    desk.run_steps(2);
}

#[test]
fn each_arrow_rolls_the_ball_its_way() {
    let keys =
        [(Key::ArrowRight, 0, 1.0), (Key::A, 0, -1.0), (Key::ArrowUp, 2, -1.0), (Key::S, 2, 1.0)];
    for (key, axis, sign) in keys {
        let mut desk = playing(Maze::course().expect("the course's maze"));
        let place = |desk: &Desk| desk.state().maze().expect("a game").game().ball_in_maze().0;
        let before = place(&desk);
        desk.key_down(key);
        desk.run_steps(25);
        let way = place(&desk) - before;
        assert!(way[axis] * sign > 0.005, "{key:?}: {way}");
    }
}

#[test]
fn the_end_wall_wins_and_play_again_starts_anew() {
    let mut desk = playing(Maze::from_text(SHORT, "short").expect("a maze"));
    win(&mut desk);
    let game = desk.state().maze().expect("a game").game();
    let GameState::Won { time } = game.state() else { panic!("not won") };
    assert_eq!((game.collected(), game.best()), (1, Some(time)));
    desk.get_by_label("You win!");
    desk.get_by_label("Play again").click();
    desk.run_steps(3);
    let game = desk.state().maze().expect("a game").game();
    assert_eq!((game.state(), game.collected()), (GameState::Rolling, 0));
    assert_eq!(game.best(), Some(time));
}

#[test]
fn the_moves_of_a_link_win_again_in_the_same_time() {
    let mut desk = playing(Maze::from_text(SHORT, "short").expect("a maze"));
    win(&mut desk);
    let game = |desk: &Desk| desk.state().maze().expect("a maze").game().clone();
    let won = game(&desk).state();
    let GameState::Won { time } = won else { panic!("not won") };
    press(&mut desk, Key::U);
    desk.run_steps(2);
    desk.get_by_label("Copy the link").click();
    desk.run_steps(1);
    let copied = Link::parse(&copied_text(&desk).expect("something was copied")).expect("a link");
    assert_eq!(copied.goal(), Some(time));
    // Another player, whose options stay as they were.
    let mut desk = self::desk(Setup { start: Some(Start::Link(Box::new(copied))), ..setup() });
    desk.run_steps(2);
    desk.get_by_label("Watch it").click();
    desk.run_steps(2);
    let is_won = (0..1200).any(|_| {
        desk.run_steps(1);
        matches!(game(&desk).state(), GameState::Won { .. })
    });
    assert!(is_won);
    assert_eq!((game(&desk).state(), game(&desk).best()), (won, None));
    desk.run_steps(2);
    desk.get_by_label("This is the game to beat.");
    desk.key_press(Key::Enter);
    desk.run_steps(2);
    assert_eq!((game(&desk).state(), game(&desk).best()), (GameState::Rolling, None));
    assert!(desk.query_by_label("Watch it").is_some());
}

#[test]
fn a_maze_that_is_won_leads_to_the_next_one() {
    let mut desk = playing(Maze::from_text(SHORT, "short").expect("a maze"));
    win(&mut desk);
    desk.get_by_label("Next maze").click();
    desk.run_steps(3);
    let app = desk.state();
    let name = &app.maze().expect("another game").game().scene().name;
    assert_ne!(name, "short");
    assert!(!app.maze().is_some_and(|it| it.is_won()));
}

#[test]
fn the_help_says_how_to_tilt_a_maze_only_where_there_is_one() {
    let mut desk = playing(Maze::course().expect("the course's maze"));
    desk.key_press(Key::F1);
    desk.run_steps(3);
    desk.get_by_label("arrow keys, or W A S D");
    let mut desk = crate::desk::watching("tutorial1");
    desk.key_press(Key::F1);
    desk.run_steps(3);
    assert!(desk.query_by_label("arrow keys, or W A S D").is_none());
}

#[test]
fn a_maze_that_is_opened_again_goes_on_when_the_player_does() {
    let mut desk = playing(Maze::course().expect("the course's maze"));
    let elapsed = |desk: &Desk| desk.state().maze().expect("a game").game().elapsed();
    let open_again = |desk: &mut Desk| {
        desk.state_mut().play(Maze::course().expect("the course's maze"));
        desk.run_steps(3);
    };
    // Nothing was played, so there is no game to continue.
    open_again(&mut desk);
    assert!(desk.query_by_label("Here you were").is_none());
    desk.key_down(Key::ArrowRight);
    desk.run_steps(25);
    desk.key_up(Key::ArrowRight);
    desk.run_steps(1);
    let before = elapsed(&desk);
    assert!(before > 0.0);
    open_again(&mut desk);
    desk.get_by_label("Here you were");
    desk.run_steps(10);
    assert_eq!(elapsed(&desk), before);
    desk.key_down(Key::ArrowLeft);
    desk.run_steps(5);
    assert!(elapsed(&desk) > before && desk.query_by_label("Here you were").is_none());
    desk.key_up(Key::ArrowLeft);
    open_again(&mut desk);
    desk.get_by_label("Start again").click();
    desk.run_steps(3);
    assert_eq!(elapsed(&desk), 0.0);
    // Another maze is another game.
    desk.state_mut().play(Maze::from_text(SHORT, "short").expect("a maze"));
    desk.run_steps(3);
    assert!(desk.query_by_label("Here you were").is_none());
}

/// Returns the number of rings in the picture.
fn rings(desk: &Desk) -> usize {
    let is_ring = |shape: &Shape| matches!(shape, Shape::Circle(it) if it.stroke.width > 4.0);
    desk.output().shapes.iter().filter(|it| is_ring(&it.shape)).count()
}

#[test]
fn a_ball_behind_a_wall_has_a_ring_and_one_in_sight_has_none() {
    let mut desk = playing(Maze::from_text(SHORT, "short").expect("a maze"));
    assert_eq!(rings(&desk), 0, "first");
    // From the front, the near wall hides the ball.
    desk.state_mut().act(Action::FrontCamera);
    desk.run_steps(3);
    assert_eq!(rings(&desk), 1);
    desk.state_mut().act(Action::TopCamera);
    desk.run_steps(3);
    assert_eq!(rings(&desk), 0);
}

/// Returns the part of the picture that shows anything but sky and ground: what is warm or red is floor and end wall.
fn warm_part(desk: &mut Desk) -> f64 {
    desk.remove_cursor();
    desk.run_steps(2);
    let picture = desk.render().expect("a picture");
    let is_warm = |pixel: &[u8]| i32::from(pixel[0]) > i32::from(pixel[2]) + 8;
    let all = (picture.width() * picture.height()) as usize;
    picture.as_raw().chunks_exact(4).filter(|it| is_warm(it)).count() as f64 / all as f64
}

#[test]
fn the_floor_of_a_maze_stays_whole_however_it_is_tilted() {
    let mazes = [Maze::course(), Maze::random(1, 8, 6), Maze::random(7, 5, 5)];
    for maze in mazes {
        let mut desk = playing(maze.expect("a maze"));
        let level = warm_part(&mut desk);
        assert!(level > 0.1, "{level}");
        for keys in [[Key::ArrowLeft, Key::ArrowUp], [Key::ArrowRight, Key::ArrowDown]] {
            keys.iter().for_each(|key| desk.key_down(*key));
            desk.run_steps(8);
            // Walls hide more or less of the tilted floor, up to the half; glass would show none.
            let tilted = warm_part(&mut desk);
            assert!((0.4..1.6).contains(&(tilted / level)), "{keys:?}: {tilted} of {level}");
            keys.iter().for_each(|key| desk.key_up(*key));
            desk.run_steps(12);
        }
    }
}

/// The ground ends to the right of the start.
const OPEN: &str = "#######\n#E   S \n#######\n";

#[test]
fn a_ball_that_falls_off_is_announced() {
    let mut desk = playing(Maze::from_text(OPEN, "open").expect("a maze"));
    desk.key_down(Key::ArrowRight);
    let message = "Off the edge - once more from the start";
    let found = (0..600).any(|_| {
        desk.run_steps(1);
        desk.query_by_label(message).is_some()
    });
    assert!(found);
}
