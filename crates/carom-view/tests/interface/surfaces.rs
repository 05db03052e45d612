//! Surfaces are picked by a click, shown with what they are, changed, and dragged with Ctrl.

use carom::DVec3;
use carom_scene::{Scene, Source};
use carom_session::Command;
use carom_view::{Setup, Start};
use egui::accesskit::Role as Named;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, Role, Theme, Vec2};
use egui_kittest::SnapshotResults;
use egui_kittest::kittest::Queryable;

use crate::desk::{
    Desk, SIZE, desk_for_picture, go_to, press, quick_desk, scene, setup, setup_for_pictures,
};
use crate::pictures::{compare, set_theme};

/// A tetrahedron.
const MESH: &str = "{ mesh = { vertices = [[0, 0, 1], [1, 0, -1], [-1, 0, -1], [0, 1, 0]], \
    triangles = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] } }";
const GROUND: &str = "{ height-field = { size_x = 3.0, size_z = 2.0, heights = \
    [[0.0, 0.1, 0.0], [0.2, 0.3, 0.1], [0.0, 0.1, 0.0]] } }";
const TRACK: &str = "{ track = { radius = 0.3, sides = 5, facet_degrees = 15.0, pieces = [\
    { straight = { length = 1.0 } }, { gap = { length = 0.2 } }, \
    { curve = { radius = 1.0, degrees = 90.0 } }] } }";

/// Lengths of a shape in units.
fn scaled(shape: &str, unit: f64) -> String {
    match shape.strip_suffix("] } }") {
        Some(mesh) => format!("{mesh}], scale = {unit:?} }} }}"),
        None => shape.to_owned(),
    }
}

/// A desk with a scene of a surface at the origin and a ball aside, in units of this length \[m\].
fn text(shape: &str, more: &str, unit: f64) -> String {
    let [aside, above, radius] = [3.0, 0.2, 0.2].map(|it| it * unit);
    let place = [0.0, 5.0 * unit, 7.0 * unit];
    format!(
        "name = \"surface\"\nspheres = [{{ position = [{aside:?}, {above:?}, 0], radius = {radius:?} }}]\n\
         [[colliders]]\nname = \"thing\"\nrestitution = 0.5\n{more}\nshape = {shape}\n\
         [camera]\nposition = {place:?}\nlook_at = [0, 0, 0]\nnear = {:?}\n",
        0.01 * unit
    )
}

fn start(text: &str) -> Option<Start> {
    let scene = Scene::from_toml(text, "surface.toml").expect("a scene");
    Some(Start::Scene(Box::new(scene), Source::Registered))
}

fn desk(text: &str) -> Desk {
    let mut desk = quick_desk(Setup { start: start(text), ..setup() });
    desk.run_steps(20);
    desk
}

fn picture(desk: &Desk) -> Rect {
    desk.get_by_role_and_label(Named::Image, "Scene").rect()
}

/// Presses or lets go of the first button.
fn button(desk: &mut Desk, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    desk.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
    desk.run_steps(1);
}

fn click(desk: &mut Desk, place: Pos2) {
    desk.event(Event::PointerMoved(place));
    desk.run_steps(2);
    button(desk, place, true, Modifiers::NONE);
    button(desk, place, false, Modifiers::NONE);
    desk.run_steps(4);
}

/// Drags from a place by steps of 8 points to the right.
fn drag(desk: &mut Desk, from: Pos2, steps: usize, modifiers: Modifiers) {
    desk.event(Event::PointerMoved(from));
    desk.run_steps(2);
    desk.event(Event::ModifiersChanged(modifiers));
    button(desk, from, true, modifiers);
    let mut place = from;
    for _ in 0..steps {
        place += Vec2::new(8.0, 0.0);
        desk.event(Event::PointerMoved(place));
        desk.run_steps(1);
    }
    button(desk, place, false, modifiers);
    desk.event(Event::ModifiersChanged(Modifiers::NONE));
    desk.run_steps(4);
}

fn place_of_surface(desk: &Desk) -> DVec3 {
    scene(desk).view().poses[0].position
}

#[test]
fn a_click_shows_what_a_surface_is() {
    let cases = [
        (MESH, ["mesh", "4 triangles, closed", "2 m × 1 m × 2 m"]),
        (
            GROUND,
            [
                "height field, 3 × 3 heights",
                "8 triangles, open, met from the front",
                "3 m × 0.3 m × 2 m",
            ],
        ),
    ];
    for (shape, facts) in cases {
        let mut desk = desk(&text(shape, "", 1.0));
        let middle = picture(&desk).center();
        assert!(desk.query_by_label(facts[0]).is_none(), "{shape}");
        click(&mut desk, middle);
        for fact in facts {
            assert!(desk.query_by_label(fact).is_some(), "{fact}");
        }
        desk.get_by_label("Let go").click();
        desk.run_steps(4);
        assert!(desk.query_by_label(facts[0]).is_none(), "{shape}");
    }
    let lower = "position = [-0.5, 0, 0]";
    let mut desk = desk(&text(TRACK, lower, 1.0));
    let middle = picture(&desk).center();
    click(&mut desk, middle);
    desk.get_by_label("track, radius 0.3 m, pieces 2, gaps 1");
    // A click into the sky lets go of it.
    let sky = picture(&desk).left_top() + Vec2::splat(12.0);
    click(&mut desk, sky);
    assert!(desk.query_by_label("track, radius 0.3 m, pieces 2, gaps 1").is_none());
}

#[test]
fn the_picked_surface_follows_a_drag_with_ctrl_in_small_and_large_and_undo_brings_it_back() {
    for unit in [1e-6, 1.0] {
        let mut desk = desk(&text(&scaled(MESH, unit), "", unit));
        let middle = picture(&desk).center();
        // Not picked yet: the camera turns.
        let camera = scene(&desk).camera();
        drag(&mut desk, middle, 4, Modifiers::COMMAND);
        assert_ne!(scene(&desk).camera(), camera, "{unit}");
        assert_eq!(place_of_surface(&desk), DVec3::ZERO, "{unit}");
        click(&mut desk, middle);
        let camera = scene(&desk).camera();
        drag(&mut desk, middle, 10, Modifiers::COMMAND);
        assert_eq!(scene(&desk).camera(), camera, "{unit}");
        let moved = place_of_surface(&desk);
        // Ten steps of 8 points, of which egui takes the first 6 for a click.
        assert!(moved.length() > 0.3 * unit && moved.length() < 1.5 * unit, "{unit}: {moved}");
        assert_eq!(scene(&desk).view().undoable, 1, "{unit}");
        desk.state_mut().command(Command::Undo);
        desk.run_steps(4);
        assert_eq!(place_of_surface(&desk), DVec3::ZERO, "{unit}");
    }
}

#[test]
fn typed_numbers_put_and_turn_the_picked_surface() {
    let mut desk = desk(&text(MESH, "", 1.0));
    let middle = picture(&desk).center();
    click(&mut desk, middle);
    for (label, number) in [
        ("Position y, m", "0.25"),
        ("Rotation y, °", "90"),
        ("Scale", "1.5"),
        ("Bounciness (restitution)", "0.75"),
    ] {
        desk.get_by_role_and_label(Role::SpinButton, label).click();
        desk.run_steps(2);
        desk.event(Event::Text(number.to_owned()));
        desk.run_steps(2);
        press(&mut desk, Key::Enter);
        desk.run_steps(4);
    }
    let view = scene(&desk).view();
    let pose = view.poses[0];
    assert_eq!(pose.position, DVec3::new(0.0, 0.25, 0.0));
    // Rounding of a sine.
    assert!((pose.rotation * DVec3::X - DVec3::NEG_Z).length() < 1e-12, "{pose:?}");
    assert_eq!(view.setup.colliders[0].1.restitution, 0.75);
    assert_eq!(view.setup.colliders[0].1.shape.scale(), Some(1.5));
    assert!(desk.query_by_label("3 m × 1.5 m × 3 m").is_some());
    let before = view.scene_now();
    go_to(&mut desk, 0.5);
    go_to(&mut desk, 0.0);
    assert_eq!(scene(&desk).view().scene_now(), before);
}

#[test]
fn a_picked_track_is_blue_and_described() {
    let start = start(&text(TRACK, "position = [-0.5, 0, 0]", 1.0));
    let setup = Setup { start, ..setup_for_pictures() };
    let mut desk = desk_for_picture(SIZE, 0.6, setup);
    set_theme(&mut desk, Theme::Light);
    let middle = picture(&desk).center();
    click(&mut desk, middle);
    let mut results = SnapshotResults::new();
    compare(&mut desk, "surface_light", &mut results);
    results.unwrap();
}
