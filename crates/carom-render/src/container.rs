//! The walls of a container.

use carom::{DQuat, DVec3, Pose, Shape, Sides};

use crate::drawing::Panel;

/// How much of a wall is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Seen {
    /// The wall is behind what the container holds: the eye sees its inner side.
    Whole,
    /// The wall is in front of what the container holds: only its rim is drawn.
    Rim,
}

/// Returns the walls of a container as rectangles that face the eye.
pub(crate) fn walls(
    container: &Panel,
    size: DVec3,
    open: Sides,
    eye: DVec3,
) -> impl Iterator<Item = (Panel, Seen)> {
    const OUTWARD: [DVec3; 6] =
        [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y, DVec3::NEG_Z, DVec3::Z];
    let (Panel { pose, .. }, half) = (container.clone(), 0.5 * size);
    let rotation = pose.rotation.normalize();
    let closed = OUTWARD.into_iter().zip(open.to_array()).filter(|(_, is_open)| !is_open);
    closed.map(move |(outward, _)| {
        // A rectangle's normal is its local y, so two axes of the container swap.
        let across = DVec3::Y.cross(outward);
        let (size_x, size_z) = match outward.abs().to_array() {
            [1.0, _, _] => (size.y, size.z),
            [_, 1.0, _] => (size.x, size.z),
            _ => (size.x, size.y),
        };
        let turn = match outward.y {
            0.0 => DQuat::from_axis_angle(across, std::f64::consts::FRAC_PI_2),
            y if y < 0.0 => DQuat::from_rotation_x(std::f64::consts::PI),
            _ => DQuat::IDENTITY,
        };
        let position = pose.position + rotation * (outward * half);
        let shape = Shape::Rectangle { size_x, size_z };
        let out = Pose { position, rotation: rotation * turn };
        let wall = Panel { shape, pose: out, ..*container };
        if wall.height_of(eye) > 0.0 {
            return (wall, Seen::Rim);
        }
        let inward = out.rotated(out.rotation * DQuat::from_rotation_x(std::f64::consts::PI));
        (Panel { pose: inward, ..wall }, Seen::Whole)
    })
}

#[cfg(test)]
mod tests {
    use carom_scene::scene::Finish;

    use super::*;

    const SIZE: DVec3 = DVec3::new(2.0, 4.0, 6.0);

    fn seen(open: Sides, eye: DVec3) -> Vec<(Panel, Seen)> {
        let rotation = DQuat::from_rotation_y(0.3);
        let pose = Pose { position: DVec3::new(5.0, 0.0, 0.0), rotation };
        let shape = Shape::Container { size: SIZE, open };
        let container =
            Panel { shape, pose, color: [1.0; 3], finish: Finish::default(), opacity: 1.0 };
        walls(&container, SIZE, open, pose.position + rotation * eye).collect()
    }

    #[test]
    fn every_wall_bounds_the_container_and_faces_the_eye() {
        let container = DQuat::from_rotation_y(-0.3);
        for eye in [DVec3::ZERO, DVec3::new(9.0, 8.0, 7.0), DVec3::new(0.0, -9.0, 0.0)] {
            for (wall, _) in seen(Sides::NONE, eye) {
                let Shape::Rectangle { size_x, size_z } = wall.shape else { panic!("{wall:?}") };
                let local = |way: DVec3| container * (wall.pose.rotation * way);
                let (x, z) = (local(DVec3::X * size_x), local(DVec3::Z * size_z));
                let place = container * (wall.pose.position - DVec3::new(5.0, 0.0, 0.0));
                let reach = (place.abs() + 0.5 * (x.abs() + z.abs())) - 0.5 * SIZE;
                assert!(reach.abs().max_element() < 1e-14, "{wall:?}");
                assert!(local(DVec3::Y).dot(eye - place) > 0.0);
            }
        }
    }

    #[test]
    fn walls_between_the_eye_and_the_inside_are_rims() {
        let rims =
            |eye: DVec3| seen(Sides::NONE, eye).iter().filter(|it| it.1 == Seen::Rim).count();
        assert_eq!(rims(DVec3::ZERO), 0);
        assert_eq!(rims(DVec3::new(0.0, 0.0, 9.0)), 1);
        assert_eq!(rims(DVec3::new(9.0, -9.0, 9.0)), 3);
        let open = Sides { top: true, front: true, ..Sides::NONE };
        assert_eq!(seen(open, DVec3::new(9.0, 9.0, 9.0)).len(), 4);
    }
}
