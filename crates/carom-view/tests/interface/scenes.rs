//! Scenes are chosen, and changed while they run.

use carom_scene::scene::{Collider, Rule, Scene, Shape};
use carom_scene::{Library, Source};
use carom_session::{Command, Edit};
use carom_view::{Setup, Start};
use egui::{Key, Role};
use egui_kittest::kittest::{NodeT, Queryable};

use crate::desk::{
    Desk, choosing, desk, go_to, just_opened, press, scene, setup, setup_for_pixels, watching,
    watching_on,
};

#[test]
fn the_chooser_comes_on_enter_and_again() {
    let mut desk = choosing(setup());
    desk.get_by_label("Choose a scene");
    press(&mut desk, Key::Enter);
    assert!(desk.query_by_label("Choose a scene").is_none());
    assert_eq!(scene(&desk).view().scene.name, "billiards");
    press(&mut desk, Key::Enter);
    desk.get_by_label("Choose a scene");
    press(&mut desk, Key::Escape);
    assert!(desk.query_by_label("Choose a scene").is_none());
}

/// Otherwise a click could miss what the user saw, above all where a frame takes a second.
#[test]
fn dialogs_stand_still_from_their_first_picture_on() {
    let mut desk = just_opened([1280.0, 800.0], setup());
    desk.key_press(Key::Enter);
    let stands_still = |desk: &mut Desk, label: &str| {
        // The first frame is not shown: it measures.
        desk.run_steps(2);
        let first = desk.get_by_label(label).rect();
        desk.run_steps(20);
        assert_eq!(desk.get_by_label(label).rect(), first, "{label}");
    };
    stands_still(&mut desk, "Open a file...");
    press(&mut desk, Key::Escape);
    desk.key_press(Key::F1);
    stands_still(&mut desk, "Keys and mouse");
}

#[test]
fn what_is_typed_filters_by_name_and_description() {
    let mut desk = choosing(setup());
    desk.event(egui::Event::Text("cradle".to_owned()));
    desk.run_steps(3);
    assert!(desk.query_by_label("simtest1").is_none());
    press(&mut desk, Key::Enter);
    assert_eq!(scene(&desk).view().scene.name, "cradle");
    desk.run_steps(4);
    let view = scene(&desk).view();
    assert!(view.playback.playing && view.frame > 0, "a chosen scene plays");
}

mod every_scene_opens_from_the_chooser {
    // The halves run in parallel.
    #[test]
    fn one_half() {
        super::open_from_the_chooser(0);
    }

    #[test]
    fn the_other_half() {
        super::open_from_the_chooser(1);
    }
}

/// Opens every second scene, starting at `first`.
fn open_from_the_chooser(first: usize) {
    let mut desk = choosing(setup());
    for entry in Library::new().entries().expect("built-in scenes").iter().skip(first).step_by(2) {
        if desk.query_by_label("Choose a scene").is_none() {
            press(&mut desk, Key::Enter);
        }
        desk.event(egui::Event::Text(entry.name.clone()));
        desk.run_steps(3);
        press(&mut desk, Key::Enter);
        let app = desk.state();
        let opened = app.watching().map(|it| it.view().scene.name.clone());
        let opened = opened.or_else(|| app.maze().map(|it| it.game().scene().name.clone()));
        let opened = opened.or_else(|| app.pinball().map(|it| it.game().scene().name.clone()));
        let billiards = || app.billiards().map(|it| it.game().table().scene().name.clone());
        let opened = opened.or_else(billiards);
        assert_eq!(opened.as_deref(), Some(entry.name.as_str()));
        assert!(!app.notices().any_error());
    }
}

#[test]
fn restitution_changes_while_the_scene_runs() {
    let mut desk = watching("simtest1");
    press(&mut desk, Key::P);
    desk.run_steps(30);
    type_into(&mut desk, "Bounciness (restitution) of PlaneCollider", "0.05");
    let view = scene(&desk).view();
    let (_, plane) = &view.setup.colliders[0];
    assert_eq!(plane.restitution, 0.05);
    assert!(view.playback.playing && view.time > 0.3, "it went on");
}

/// Types a number into the last field with this label; the name of its row has the same label.
fn type_into(desk: &mut Desk, label: &str, number: &str) {
    desk.get_all_by_label(label).last().unwrap().click();
    desk.run_steps(2);
    desk.event(egui::Event::Text(number.to_owned()));
    desk.run_steps(2);
    press(desk, Key::Enter);
}

/// Opens a running scene under the rule `contact`.
fn watching_contacts() -> Desk {
    let mut desk = watching("simtest1");
    let mut simulation = scene(&desk).view().setup.simulation.clone();
    simulation.rule = Rule::Contact;
    desk.state_mut().command(Command::Edit(Edit::Simulation(Box::new(simulation))));
    press(&mut desk, Key::P);
    desk.run_steps(30);
    desk
}

#[test]
fn friction_of_a_surface_changes_while_the_scene_runs() {
    let mut desk = watching_contacts();
    desk.get_by_label("Friction of PlaneCollider").click();
    desk.run_steps(30);
    desk.get_by_label("Sliding friction is given").click();
    desk.run_steps(4);
    type_into(&mut desk, "Sliding friction", "0.35");
    let view = scene(&desk).view();
    let plane = view.setup.colliders[0].1.clone();
    assert_eq!((plane.friction, plane.rolling_friction), (Some(0.35), None));
    assert!(view.playback.playing && view.time > 0.3, "it went on");
    // Without a tick the value is absent again.
    desk.get_by_label("Sliding friction is given").click();
    desk.run_steps(4);
    assert_eq!(scene(&desk).view().setup.colliders[0].1.friction, None);
}

#[test]
fn friction_and_spin_of_the_picked_ball_change() {
    let mut desk = watching_contacts();
    // Paused: balls leave the scene, and a step of the desk is longer than a frame.
    press(&mut desk, Key::P);
    let id = *scene(&desk).view().spheres.ids.last().unwrap();
    desk.state_mut().command(Command::Pick(Some(id)));
    desk.run_steps(4);
    desk.get_by_label(&format!("Friction of ball {id}")).click();
    desk.run_steps(30);
    desk.get_by_label("Rolling friction is given").click();
    desk.run_steps(4);
    type_into(&mut desk, "Rolling friction", "0.02");
    let spheres = &scene(&desk).view().spheres;
    let friction = spheres.friction(spheres.index_of(id).unwrap());
    assert_eq!((friction.rolling, friction.sliding), (Some(0.02), None));
    type_into(&mut desk, "Spin (angular velocity) z, rad/s", "7.5");
    let spheres = &scene(&desk).view().spheres;
    assert_eq!(spheres.angular_velocity(spheres.index_of(id).unwrap()).z, 7.5);
}

#[test]
fn friction_is_shown_only_where_it_acts() {
    let mut desk = watching("simtest1");
    desk.run_steps(4);
    assert!(desk.query_by_label("Friction of PlaneCollider").is_none());
}

#[test]
fn looking_at_values_changes_none() {
    let mut scene_file = Scene::new("odd");
    for restitution in [2.0 / 3.0, 0.123_456_789] {
        scene_file.colliders.push(Collider {
            position: [0.0, -1.0, 0.0],
            restitution,
            ..Collider::new(Shape::HalfSpace)
        });
    }
    let start = Some(Start::Scene(Box::new(scene_file.clone()), Source::Registered));
    let mut desk = desk(Setup { start, ..setup() });
    desk.run_steps(6);
    assert_eq!(scene(&desk).view().setup.colliders[0].1, scene_file.colliders[0]);
    assert_eq!(scene(&desk).view().setup.colliders[1].1, scene_file.colliders[1]);
}

#[test]
fn a_key_that_is_held_plays_or_pauses_once() {
    let mut desk = watching("simtest1");
    for repeat in [false, true, true] {
        desk.event(egui::Event::Key {
            key: Key::P,
            physical_key: None,
            pressed: true,
            repeat,
            modifiers: egui::Modifiers::NONE,
        });
        desk.run_steps(2);
    }
    assert!(scene(&desk).view().playback.playing);
}

/// Sends an edit that the session refuses.
fn ask_for_negative_frames(desk: &mut Desk) {
    let mut simulation = scene(desk).view().setup.simulation.clone();
    simulation.frame_time = -1.0;
    desk.state_mut().command(Command::Edit(Edit::Simulation(Box::new(simulation))));
    desk.run_steps(4);
}

#[test]
fn an_error_that_is_closed_stays_closed() {
    let mut desk = watching("simtest1");
    ask_for_negative_frames(&mut desk);
    desk.get_by_label("Close").click();
    desk.run_steps(4);
    assert!(!desk.state().notices().any_error());
}

#[test]
fn a_refused_change_is_told_and_changes_nothing() {
    let mut desk = watching("simtest1");
    ask_for_negative_frames(&mut desk);
    assert!(desk.state().notices().any_error());
    assert_eq!(scene(&desk).view().setup.simulation.frame_time, 0.02);
}

#[test]
fn every_shortcut_is_in_the_help() {
    let mut desk = watching("tutorial1");
    press(&mut desk, Key::F1);
    for shortcut in carom_view::SHORTCUTS {
        desk.get_by_label(shortcut.text);
    }
}

#[test]
fn the_help_opens_while_a_number_is_being_typed() {
    let mut desk = watching("simtest1");
    desk.get_all_by_label("Bounciness (restitution) of PlaneCollider").last().unwrap().click();
    desk.run_steps(2);
    press(&mut desk, Key::F1);
    desk.get_by_label("Keys and mouse");
}

#[test]
fn panels_that_were_opened_stay_open_in_the_next_scene() {
    let mut desk = watching("simtest1");
    press(&mut desk, Key::I);
    press(&mut desk, Key::L);
    press(&mut desk, Key::Enter);
    desk.event(egui::Event::Text("tutorial1".to_owned()));
    desk.run_steps(3);
    press(&mut desk, Key::Enter);
    assert_eq!(scene(&desk).view().scene.name, "tutorial1");
    desk.get_by_label("Approach, m/s");
    assert!(desk.query_by_label("Method (rule)").is_none());
}

#[test]
fn a_number_of_many_digits_that_is_clicked_on_and_left_stays_as_it_is() {
    let mut desk = watching("tutorial1");
    let before = scene(&desk).view().setup.simulation.frame_time;
    assert_eq!(before, 1.0 / 60.0, "more digits than are shown");
    desk.get_by_label("More settings").click();
    desk.run_steps(30);
    desk.get_by_role_and_label(Role::SpinButton, "Frame time, s").click();
    desk.run_steps(3);
    press(&mut desk, Key::Enter);
    desk.run_steps(3);
    assert_eq!(scene(&desk).view().setup.simulation.frame_time, before);
    assert_eq!(scene(&desk).view().undoable, 0);
}

/// Throws a ball towards a place on the screen.
fn throw_at(desk: &mut Desk, place: egui::Pos2) {
    let control = egui::Modifiers::COMMAND;
    desk.event(egui::Event::ModifiersChanged(control));
    desk.hover_at(place);
    desk.run_steps(1);
    for pressed in [true, false] {
        let event = egui::Event::PointerButton {
            pos: place,
            button: egui::PointerButton::Primary,
            pressed,
            modifiers: control,
        };
        desk.event(event);
        desk.run_steps(1);
    }
    desk.run_steps(4);
}

#[test]
fn a_ball_that_is_clicked_is_picked_and_one_is_thrown_with_control() {
    let mut desk = watching("tutorial1");
    let balls = scene(&desk).view().spheres.ids.len();
    let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
    let place = desk.state().place_of(0, picture).expect("the ball is in the picture");
    desk.hover_at(place);
    desk.drag_at(place);
    desk.run_steps(1);
    desk.drop_at(place);
    desk.run_steps(4);
    assert_eq!(scene(&desk).view().picked, scene(&desk).view().spheres.ids.first().copied());

    throw_at(&mut desk, picture.left_bottom() + egui::Vec2::new(30.0, -30.0));
    assert_eq!(scene(&desk).view().spheres.ids.len(), balls + 1);
    assert!(!desk.root().accesskit_node().is_hidden());
}

#[test]
fn a_picked_ball_shows_the_restitution_of_its_contacts() {
    let mut desk = watching("simtest1");
    go_to(&mut desk, 2.0);
    let ball = scene(&desk).view().spheres.ids[0];
    desk.state_mut().command(Command::Pick(Some(ball)));
    let change = carom_session::SphereChange { restitution: Some(0.5), ..Default::default() };
    desk.state_mut().command(Command::Edit(Edit::Sphere(ball, Box::new(change))));
    desk.run_steps(3);
    // 0.8 times 0.5, and 0.2 times 0.5.
    desk.get_by_label(&format!("with ball {ball}: 0.40"));
    desk.get_by_label(&format!("with ball {ball}: 0.10"));
}

#[test]
fn surfaces_of_one_name_are_one_row_and_change_together() {
    let mut desk = watching("galton");
    desk.get_by_label("peg, 148");
    assert!(desk.query_by_label_contains("peg 1-1").is_none());
    type_into(&mut desk, "Bounciness (restitution) of peg", "0.25");
    let view = scene(&desk).view();
    for (_, collider) in &view.setup.colliders {
        assert_eq!(
            collider.restitution == 0.25,
            collider.name.starts_with("peg"),
            "{}",
            collider.name
        );
    }
    assert_eq!(view.undoable, 1);
}

#[test]
fn a_ball_is_thrown_and_its_speed_is_read_by_keyboard_alone() {
    let mut desk = watching("bounce");
    let before = scene(&desk).view().spheres.ids.len();
    press(&mut desk, Key::B);
    press(&mut desk, Key::Period);
    desk.run_steps(3);
    let view = scene(&desk).view();
    assert_eq!(view.spheres.ids.len(), before + 1);
    assert_eq!(view.picked, view.spheres.ids.last().copied());
    let speed = view.spheres.velocities[before].length();
    let picture = desk.get_by_role_and_label(Role::Image, "Scene");
    let label = picture.value().expect("the label of the ball");
    let shown = label.split(' ').rev().nth(1).and_then(|it| it.parse::<f64>().ok());
    // Three digits are shown.
    assert!(shown.is_some_and(|it| (it - speed).abs() < 6e-3 * speed), "{speed}: {label}");
}

#[test]
fn a_thrown_ball_is_as_large_as_the_others() {
    for name in ["gas", "tutorial4"] {
        let mut desk = watching(name);
        let mut radii = scene(&desk).view().spheres.radii.clone();
        radii.sort_by(f64::total_cmp);
        let usual = radii[radii.len() / 2];
        let picture = desk.get_by_role_and_label(Role::Image, "Scene").rect();
        throw_at(&mut desk, picture.left_bottom() + egui::Vec2::new(30.0, -30.0));
        let thrown = *scene(&desk).view().spheres.radii.last().expect("a ball");
        assert_eq!(thrown, usual, "{name}");
    }
}

#[test]
fn a_picked_ball_has_a_ring_and_a_label_with_its_speed() {
    let mut desk = watching_on(setup_for_pixels(), "gas");
    go_to(&mut desk, 0.2);
    // A ball in the middle of the others, which hide it.
    let id = scene(&desk).view().spheres.ids[99];
    desk.state_mut().command(Command::Pick(Some(id)));
    desk.remove_cursor();
    desk.run_steps(4);
    let (rect, label) = {
        let picture = desk.get_by_role_and_label(Role::Image, "Scene");
        (picture.rect(), picture.value().expect("a label"))
    };
    assert!(label.starts_with("ball 99, ") && label.ends_with(" m/s"), "{label}");
    let place = desk.state().place_of(99, rect).expect("it is in the picture");
    let radius = desk.state().radius_of(99, rect).expect("it is before the camera").max(7.0) + 2.0;
    let pixels = desk.render().expect("a picture");
    // All around, a light and a dark line lie side by side; the label covers a part.
    let (mut light, mut dark) = (0, 0);
    for degrees in (0..360).step_by(5) {
        let (sine, cosine) = f64::from(degrees).to_radians().sin_cos();
        let direction = egui::Vec2::new(cosine as f32, sine as f32);
        let seen: Vec<u32> = (-3..=3)
            .map(|offset| {
                let at = place + direction * (radius + offset as f32);
                let pixel = pixels.get_pixel(at.x.round() as u32, at.y.round() as u32);
                pixel.0[..3].iter().map(|part| u32::from(*part)).sum()
            })
            .collect();
        light += usize::from(seen.iter().any(|it| *it > 690));
        dark += usize::from(seen.iter().any(|it| *it < 250));
    }
    assert!(light > 60 && dark > 60, "{light} {dark} of 72");
}
