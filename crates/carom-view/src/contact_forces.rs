//! Forces of persistent contacts, as arrows.

use carom::{BodyPair, DVec3, PersistentContact};
use carom_render::Arrow;
use carom_scene::scene::{Color, Force};
use carom_session::View;

const FORCE: Color = [0.62, 0.16, 0.78];

/// Gravity that sets the scale of the arrows in a scene without steady forces \[m/s²\].
const STANDARD_GRAVITY: f64 = 9.81;

/// Returns an arrow for each contact with a force: from the point of contact along the normal,
/// towards body 2. Its length is proportional to the force, see [`meters_per_newton`].
///
/// Balls are drawn a part `blend` of the way from their previous positions; each arrow moves with
/// body 2. Balls do not hide it, because most of it lies inside one.
pub fn arrows(view: &View, blend: f64) -> impl Iterator<Item = Arrow> {
    let scale = meters_per_newton(view);
    let bearing = view.contacts.iter().filter(|contact| contact.normal_force > 0.0);
    bearing.map(move |contact| {
        let start = contact.point + shift(view, contact, blend);
        let end = start + scale * contact.normal_force * contact.normal;
        Arrow { start, end, color: FORCE, width: 3.0, head: true, in_front: true }
    })
}

/// Returns the length of the arrow of 1 N \[m\]. The mean steady force on a ball, in most scenes
/// its weight, makes an arrow as long as the mean radius: the arrow of a single ball at rest on the
/// floor ends at its centre, and that below a column of two balls is twice as long. The scale
/// changes only when balls appear or disappear.
fn meters_per_newton(view: &View) -> f64 {
    let masses = &view.spheres.masses;
    let forces: f64 = masses.iter().map(|&mass| steady_force(view, mass).length()).sum();
    let forces = if forces > 0.0 { forces } else { STANDARD_GRAVITY * masses.iter().sum::<f64>() };
    let radii: f64 = view.spheres.radii.iter().sum();
    if forces > 0.0 { radii / forces } else { 0.0 }
}

/// Returns the force on a ball of this mass \[kg\] that depends neither on position nor on velocity
/// \[N\].
fn steady_force(view: &View, mass: f64) -> DVec3 {
    let of_one = |force: &Force| match force {
        Force::Constant { force } => DVec3::from_array(*force),
        Force::Gravity { acceleration } => mass * DVec3::from_array(*acceleration),
        _ => DVec3::ZERO,
    };
    view.setup.forces.iter().map(|(_, force)| of_one(force)).sum()
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
    use std::sync::Arc;

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

    fn column(gravity: f64) -> Driver {
        let mut scene = Scene::from_toml(COLUMN, "column").unwrap();
        scene.forces = vec![Force::Gravity { acceleration: [0.0, -gravity, 0.0] }];
        let mut driver = Driver::inline(Session::new(scene).unwrap());
        driver.send(Command::ShowContacts(true)).unwrap();
        driver.send(Command::Step).unwrap();
        driver.update(0.0, || false);
        driver
    }

    #[test]
    fn each_arrow_is_one_radius_long_for_every_ball_that_it_bears() {
        for gravity in [9.81, 1.62] {
            let driver = column(gravity);
            let mut arrows: Vec<Arrow> = arrows(driver.view(), 1.0).collect();
            arrows.sort_by(|one, other| one.start.y.total_cmp(&other.start.y));
            assert_eq!(arrows.len(), 3);
            for (arrow, (height, borne)) in arrows.iter().zip([(0.0, 3.0), (2.0, 2.0), (4.0, 1.0)])
            {
                // The solver of the forces has a relative error of 1e-12.
                let near = |place: DVec3, y: f64| (place - DVec3::Y * y).length() < 1e-9;
                assert!(near(arrow.start, height) && near(arrow.end, height + borne), "{arrow:?}");
            }
        }
    }

    #[test]
    fn an_arrow_moves_with_the_ball_that_it_pushes() {
        let driver = column(9.81);
        let mut view = driver.view().clone();
        let up = DVec3::Y;
        view.spheres.previous_positions.iter_mut().for_each(|place| *place += up);
        let now: Vec<Arrow> = arrows(driver.view(), 1.0).collect();
        let between: Vec<Arrow> = arrows(&view, 0.25).collect();
        for (now, between) in now.iter().zip(&between) {
            assert!((between.start - now.start - 0.75 * up).length() < 1e-12);
            assert!((between.end - now.end - 0.75 * up).length() < 1e-12);
        }
    }

    #[test]
    fn without_steady_forces_the_scale_is_that_of_weights_on_earth() {
        let mut view = column(9.81).view().clone();
        let under_gravity = meters_per_newton(&view);
        Arc::make_mut(&mut view.setup).forces.clear();
        assert_eq!(meters_per_newton(&view), under_gravity);
    }
}
