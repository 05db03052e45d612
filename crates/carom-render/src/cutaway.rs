//! Cuts surfaces away so that the balls of a scene are visible: half-spaces end where other
//! half-spaces begin, and surfaces between the eye and the balls are not drawn in full.

use carom::{DVec3, Shape};

use crate::bounds::Bounds;
use crate::drawing::{Drawing, Panel};

/// Largest number of half-spaces that cut others off; the first ones are taken.
pub(crate) const MOST_CUTS: usize = 8;

/// Part of the test points in the balls' box that must stay visible for a surface to be drawn in
/// full.
const IN_SIGHT: f64 = 2.0 / 3.0;

/// Returns the planes of the half-spaces that cut others off: unit normal, and distance of the
/// plane from the eye along it \[m\]. Unused entries cut nothing.
pub(crate) fn cuts(drawing: &Drawing, eye: DVec3) -> [[f32; 4]; MOST_CUTS] {
    let solid =
        drawing.panels.iter().filter(|it| it.shape == Shape::HalfSpace && it.opacity == 1.0);
    let mut cuts = [[0.0, 0.0, 0.0, -1.0]; MOST_CUTS];
    for (cut, panel) in cuts.iter_mut().zip(solid) {
        let normal = panel.normal();
        let height = normal.dot(panel.pose.position - eye);
        *cut = normal.as_vec3().extend(height as f32).to_array();
    }
    cuts
}

/// Returns whether a surface hides more than a third of the box in which the balls move.
pub(crate) fn hides(panel: &Panel, eye: DVec3, balls: &Bounds) -> bool {
    let half = match panel.shape {
        Shape::Rectangle { size_x, size_z } => 0.5 * DVec3::new(size_x, 0.0, size_z),
        Shape::Box { size } => 0.5 * size,
        _ => return false,
    };
    let to_local = panel.pose.rotation.normalize().inverse();
    let from = to_local * (eye - panel.pose.position);
    let places = places(balls);
    let hidden = places.iter().filter(|place| {
        let way = to_local * (**place - eye);
        crosses(from, way, half)
    });
    let most = (1.0 - IN_SIGHT) * places.len() as f64;
    hidden.count() as f64 > most
}

/// Returns points spread evenly over a box.
fn places(within: &Bounds) -> [DVec3; 27] {
    std::array::from_fn(|i| {
        let parts = DVec3::new((i % 3) as f64, (i / 3 % 3) as f64, (i / 9) as f64);
        within.min + (within.max - within.min) * ((parts + 0.5) / 3.0)
    })
}

/// Returns whether the segment from `from` along `way` crosses a box of these half lengths about
/// the origin from side to side. A segment that ends inside the box does not cross it.
fn crosses(from: DVec3, way: DVec3, half: DVec3) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..3 {
        let (start, along, half) = (from[axis], way[axis], half[axis]);
        if along == 0.0 {
            if start.abs() > half {
                return false;
            }
            continue;
        }
        let [a, b] = [(-half - start) / along, (half - start) / along];
        enter = enter.max(a.min(b));
        leave = leave.min(a.max(b));
    }
    enter <= leave && enter > 0.0 && leave < 1.0
}

#[cfg(test)]
mod tests {
    use carom::{DQuat, Pose};
    use carom_scene::scene::Finish;

    use super::*;

    const BALLS: Bounds = Bounds { min: DVec3::NEG_ONE, max: DVec3::ONE };

    fn panel(shape: Shape, position: DVec3, rotation: DQuat) -> Panel {
        let (pose, finish) = (Pose { position, rotation }, Finish::default());
        Panel { shape, pose, color: [1.0; 3], finish, opacity: 1.0 }
    }

    #[test]
    fn a_wall_before_the_balls_hides_them_and_one_behind_or_below_does_not() {
        let eye = DVec3::new(0.5, 1.0, 9.0);
        let wall = Shape::Box { size: DVec3::new(3.0, 3.0, 0.2) };
        let at = |position| hides(&panel(wall.clone(), position, DQuat::IDENTITY), eye, &BALLS);
        assert!(at(DVec3::Z * 1.2));
        assert!(!at(DVec3::Z * -1.2));
        assert!(!at(DVec3::new(4.0, 0.0, 1.2)));
        let floor = Shape::Rectangle { size_x: 9.0, size_z: 9.0 };
        assert!(!hides(&panel(floor.clone(), DVec3::Y * -1.0, DQuat::IDENTITY), eye, &BALLS));
        let below = DVec3::new(0.5, -9.0, 0.2);
        assert!(hides(&panel(floor, DVec3::Y * -1.0, DQuat::IDENTITY), below, &BALLS));
    }

    #[test]
    fn what_hides_little_of_the_balls_stays_whole() {
        let pin = Shape::Box { size: DVec3::new(0.2, 3.0, 0.2) };
        assert!(!hides(&panel(pin, DVec3::Z * 1.5, DQuat::IDENTITY), DVec3::Z * 9.0, &BALLS));
        // Neither a box around the balls nor a box around the eye hides them.
        let around = Shape::Box { size: DVec3::splat(4.0) };
        assert!(!hides(
            &panel(around.clone(), DVec3::ZERO, DQuat::IDENTITY),
            DVec3::Z * 9.0,
            &BALLS
        ));
        assert!(!hides(&panel(around, DVec3::ZERO, DQuat::IDENTITY), DVec3::Z * 1.5, &BALLS));
    }
}
