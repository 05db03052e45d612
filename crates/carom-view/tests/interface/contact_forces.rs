//! Forces of persistent contacts are switched on and off by key and button, and drawn.

use carom_scene::{Scene, Source};
use carom_view::{Setup, Start};
use egui::Key;
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, go_to, press, scene, setup_for_pixels};

/// A column of three balls at rest on the floor, and a ball that pushes two others apart.
const PRESSING: &str = r#"
name = "pressing"
forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } }]

[[colliders]]
shape = "half-space"
restitution = 0.0

[[generators]]
row = { count = 3, start = [2.5, 1.0, 0.0], step = [0.0, 2.0, 0.0], sphere = { radius = 1.0, restitution = 0.0 } }

[[generators]]
row = { count = 2, start = [-3.0, 1.0, 0.0], step = [2.4, 0.0, 0.0], sphere = { radius = 1.0, restitution = 0.0 } }

[[spheres]]
position = [-1.8, 2.6, 0.0]
radius = 1.0
restitution = 0.0

[simulation]
rule = "exact"
"#;

fn watching_balls_that_press() -> Desk {
    let pressing = Scene::from_toml(PRESSING, "pressing").expect("a scene");
    let start = Some(Start::Scene(Box::new(pressing), Source::Registered));
    let mut desk = desk(Setup { start, ..setup_for_pixels() });
    go_to(&mut desk, 0.5);
    desk
}

/// Counts pixels in the colours of the lines, from yellow to red: much red, less green, little blue.
fn glowing_pixels(desk: &mut Desk) -> usize {
    desk.remove_cursor();
    let picture = desk.render().expect("a picture");
    let is_one =
        |red: u8, green: u8, blue: u8| red > 200 && green < 180 && blue < 60 && red - green > 40;
    picture.pixels().filter(|pixel| is_one(pixel[0], pixel[1], pixel[2])).count()
}

#[test]
fn lines_are_in_the_picture_while_they_are_switched_on() {
    let mut desk = watching_balls_that_press();
    let before = glowing_pixels(&mut desk);
    press(&mut desk, Key::C);
    assert!(scene(&desk).view().contacts.len() >= 5);
    let shown = glowing_pixels(&mut desk);
    assert!(shown > before + 150, "{before} {shown}");
    desk.get_by_label("Measure").click();
    desk.run_steps(3);
    desk.get_by_label("Contact forces").click();
    desk.run_steps(3);
    assert!(scene(&desk).view().contacts.is_empty());
    assert_eq!(glowing_pixels(&mut desk), before);
}
