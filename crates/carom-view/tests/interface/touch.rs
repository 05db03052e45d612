//! Touch gestures in the picture.

use carom_maze::Maze;
use egui::{Event, PointerButton, Pos2, Rect, TouchDeviceId, TouchId, TouchPhase, Vec2};

use crate::desk::{Desk, scene, watching};
use crate::maze::playing;

const PICTURE: Rect = Rect { min: Pos2::ZERO, max: Pos2::new(700.0, 560.0) };

/// In the middle of the picture.
pub const PLACE: Pos2 = Pos2::new(300.0, 330.0);

/// Sends the events of a finger: the touch, and for the first finger also a pointer event.
pub fn finger(desk: &mut Desk, id: u64, phase: TouchPhase, pos: Pos2) {
    let events = &mut desk.input_mut().events;
    let button = |pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Default::default(),
    };
    if id == 0 {
        match phase {
            TouchPhase::Start => events.push(button(true)),
            TouchPhase::Move => events.push(Event::PointerMoved(pos)),
            TouchPhase::End => events.extend([button(false), Event::PointerGone]),
            TouchPhase::Cancel => {}
        }
    }
    events.push(Event::Touch {
        device_id: TouchDeviceId(0),
        id: TouchId(id),
        phase,
        pos,
        force: None,
    });
    desk.run_steps(1);
}

/// Returns the position of the first ball on the screen.
fn shown_at(desk: &Desk) -> Pos2 {
    desk.state().place_of(0, PICTURE).expect("a ball is before the eye")
}

#[test]
fn one_finger_turns_the_camera_of_a_scene_and_two_come_nearer() {
    let mut desk = watching("tutorial1");
    let before = shown_at(&desk);
    finger(&mut desk, 0, TouchPhase::Start, PLACE);
    for i in 1..=5 {
        finger(&mut desk, 0, TouchPhase::Move, PLACE + Vec2::new(12.0 * i as f32, 0.0));
    }
    finger(&mut desk, 0, TouchPhase::End, PLACE + Vec2::new(60.0, 0.0));
    let turned = shown_at(&desk);
    assert!((turned - before).length() > 5.0, "{before} {turned}");
    let radius =
        |desk: &Desk| desk.state().radius_of(0, PICTURE).expect("a ball is before the eye");
    let far = radius(&desk);
    finger(&mut desk, 0, TouchPhase::Start, PLACE);
    finger(&mut desk, 1, TouchPhase::Start, PLACE + Vec2::new(40.0, 0.0));
    for i in 1..=10 {
        let way = Vec2::new(4.0 * i as f32, 0.0);
        finger(&mut desk, 0, TouchPhase::Move, PLACE - way);
        finger(&mut desk, 1, TouchPhase::Move, PLACE + Vec2::new(40.0, 0.0) + way);
    }
    assert!(radius(&desk) > 1.3 * far, "from {far} to {} points", radius(&desk));
    // The subject keeps its place, but for the way of the fingers' middle: two points per event.
    let moved = shown_at(&desk).distance(turned);
    assert!(moved < 40.0, "by {moved} points");
    assert_eq!(scene(&desk).view().frame, 0);
}

#[test]
fn one_finger_tilts_a_maze_the_way_it_goes() {
    let mut desk = playing(Maze::course().expect("the course's maze"));
    let tilt = |desk: &Desk| desk.state().maze().expect("a game").game().tilt();
    finger(&mut desk, 0, TouchPhase::Start, PLACE);
    for i in 1..=20 {
        finger(&mut desk, 0, TouchPhase::Move, PLACE + Vec2::new(6.0 * i as f32, 0.0));
    }
    // A drag to the right turns the maze about -z.
    let held = tilt(&desk);
    assert!(held.z < -0.01 && held.x.abs() < 1e-9, "{held}");
    finger(&mut desk, 0, TouchPhase::End, PLACE);
    desk.run_steps(120);
    assert!(tilt(&desk).z.abs() < 0.2 * held.z.abs(), "it levels back");
}
