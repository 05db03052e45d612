//! Forces of persistent contacts, as lines that join into chains.

use carom::{BodyPair, DVec3, PersistentContact, SphereId};
use carom_render::{Arrow, Drawing, Pattern};
use carom_scene::scene::Color;
use carom_session::View;

/// Width of the line of the strongest force, in pixels.
const WIDEST: f64 = 5.0;

/// Largest number of lines. Weaker forces have none: they would hide the chains.
const MOST_LINES: usize = 400;

/// Colours of the weakest and the middle force with a line, and of the strongest.
const COLORS: [Color; 3] = [[0.95, 0.72, 0.15], [0.86, 0.20, 0.15], [0.45, 0.05, 0.45]];

/// Colour towards which balls fade beside the lines, and how far.
const FADED: Color = [0.84, 0.84, 0.83];
const FADING: f64 = 0.75;

/// Adds a line for each contact with a force: from the centre of body 1, or the point of contact on
/// a surface, to the centre of body 2. Its width is proportional to the force; its colour goes from
/// yellow for weak forces over red to purple for strong ones. Balls do not hide the lines, and fade.
///
/// Balls are drawn a part `blend` of the way from their previous positions; each line moves with
/// body 2.
pub fn add(view: &View, blend: f64, drawing: &mut Drawing) {
    for ball in drawing.balls.iter_mut().filter(|ball| ball.pattern != Pattern::Glowing) {
        ball.color = mix(ball.color, FADED, FADING);
    }
    drawing.arrows.extend(lines(view, blend));
}

/// Returns the lines, the strongest last, in front of the others.
fn lines(view: &View, blend: f64) -> Vec<Arrow> {
    let bearing = view.contacts.iter().filter(|contact| contact.normal_force > 0.0);
    let mut bearing: Vec<&PersistentContact> = bearing.collect();
    bearing.sort_by(|one, other| one.normal_force.total_cmp(&other.normal_force));
    bearing.drain(..bearing.len().saturating_sub(MOST_LINES));
    let strongest = bearing.last().map_or(0.0, |contact| contact.normal_force);
    let line = |contact: &&PersistentContact| {
        let strength = contact.normal_force / strongest;
        let [start, end] = ends(view, contact).map(|end| end + shift(view, contact, blend));
        let (color, width) = (color(strength), WIDEST * strength);
        Arrow { start, end, color, width, head: false, in_front: true }
    };
    bearing.iter().map(line).collect()
}

/// Returns both ends of the line of a contact \[m\].
fn ends(view: &View, contact: &PersistentContact) -> [DVec3; 2] {
    let radius = |id: SphereId| view.spheres.index_of(id).map_or(0.0, |it| view.spheres.radii[it]);
    let (before, after) = match contact.between {
        BodyPair::Spheres(first, second) => (radius(first), radius(second)),
        BodyPair::Collider { sphere, .. } => (0.0, radius(sphere)),
    };
    [contact.point - before * contact.normal, contact.point + after * contact.normal]
}

/// Returns the colour of a force, from 0 for none to 1 for the strongest.
fn color(strength: f64) -> Color {
    let [weak, middle, strong] = COLORS;
    let part = 2.0 * strength;
    if part < 1.0 { mix(weak, middle, part) } else { mix(middle, strong, part - 1.0) }
}

fn mix(from: Color, to: Color, part: f64) -> Color {
    std::array::from_fn(|i| from[i] + part * (to[i] - from[i]))
}

/// Returns the distance from the position of body 2 of a contact to where it is drawn \[m\].
fn shift(view: &View, contact: &PersistentContact, blend: f64) -> DVec3 {
    let (BodyPair::Spheres(_, sphere) | BodyPair::Collider { sphere, .. }) = contact.between;
    let way = |index: usize| {
        let now = view.spheres.positions[index];
        view.spheres.previous_positions[index].lerp(now, blend) - now
    };
    view.spheres.index_of(sphere).map_or(DVec3::ZERO, way)
}

#[cfg(test)]
mod tests {
    use carom_scene::Scene;
    use carom_session::{Command, Driver, Session};

    use super::*;

    /// Three balls with a radius of 1 m in a column under gravity, and a fourth that flies.
    const COLUMN: &str = r#"
name = "column"
forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } }]

[[colliders]]
shape = "half-space"
restitution = 0.0

[[generators]]
row = { count = 3, start = [0.0, 1.0, 0.0], step = [0.0, 2.0, 0.0], sphere = { radius = 1.0, mass = 2.0, restitution = 0.0 } }

[[spheres]]
position = [5.0, 50.0, 0.0]
radius = 1.0
mass = 2.0
"#;

    fn column() -> Driver {
        let scene = Scene::from_toml(COLUMN, "column").unwrap();
        let mut driver = Driver::inline(Session::new(scene).unwrap());
        driver.send(Command::ShowContacts(true)).unwrap();
        driver.send(Command::Step).unwrap();
        driver.update(0.0, || false);
        driver
    }

    #[test]
    fn each_line_is_as_wide_as_the_number_of_balls_that_it_bears() {
        let lines = lines(column().view(), 1.0);
        assert_eq!(lines.len(), 3);
        // From centre to centre, and from the floor; the lowest bears most and comes last.
        for (line, (start, end, borne)) in
            lines.iter().zip([(3.0, 5.0, 1.0), (1.0, 3.0, 2.0), (0.0, 1.0, 3.0)])
        {
            // The solver of the forces has a relative error of 1e-12.
            let near = |place: DVec3, y: f64| (place - DVec3::Y * y).length() < 1e-9;
            assert!(near(line.start, start) && near(line.end, end), "{line:?}");
            assert!((line.width - WIDEST * borne / 3.0).abs() < 1e-9, "{line:?}");
        }
        assert!(lines[0].color[1] > lines[1].color[1] && lines[1].color[1] > lines[2].color[1]);
    }

    #[test]
    fn of_many_forces_the_strongest_have_lines() {
        let mut view = column().view().clone();
        view.contacts = vec![view.contacts[0]; 2 * MOST_LINES];
        for (number, contact) in view.contacts.iter_mut().enumerate() {
            contact.normal_force = 1.0 + number as f64;
        }
        let lines = lines(&view, 1.0);
        assert_eq!(lines.len(), MOST_LINES);
        // Half of the forces, plus one.
        let weakest = WIDEST * (0.5 + 0.5 / MOST_LINES as f64);
        assert!((lines[0].width - weakest).abs() < 1e-12 && lines[MOST_LINES - 1].width == WIDEST);
        view.contacts.clear();
        assert!(super::lines(&view, 1.0).is_empty());
    }

    #[test]
    fn a_line_moves_with_the_ball_that_it_pushes() {
        let driver = column();
        let mut view = driver.view().clone();
        let up = DVec3::Y;
        view.spheres.previous_positions.iter_mut().for_each(|place| *place += up);
        let (now, between) = (lines(driver.view(), 1.0), lines(&view, 0.25));
        for (now, between) in now.iter().zip(&between) {
            assert!((between.start - now.start - 0.75 * up).length() < 1e-12);
            assert!((between.end - now.end - 0.75 * up).length() < 1e-12);
        }
    }
}
