//! Replaces six planes that enclose a box by the box.

use carom::{DQuat, DVec3};
use carom_scene::scene::{Collider, Shape};

/// A rectangle in Unity's coordinates, from a group with the same parent.
pub(crate) struct Face<'a> {
    pub collider: &'a Collider,
    pub position: DVec3,
    pub rotation: DQuat,
}

/// Finds centre and size of the box with these faces, along the axes of `frame`. Returns `None`
/// unless the rectangles are all faces of a box, face outward and have equal properties.
pub(crate) fn enclosed(faces: &[Face<'_>; 6], frame: DQuat) -> Option<(DVec3, DVec3)> {
    let first = faces[0].collider;
    let alike = |it: &Face<'_>| {
        let it = it.collider;
        (it.restitution, it.friction, it.trigger)
            == (first.restitution, first.friction, first.trigger)
    };
    if !faces.iter().all(alike) {
        return None;
    }
    let center = faces.iter().map(|it| it.position).sum::<DVec3>() / 6.0;
    let mut halves = [[None; 2]; 3];
    for face in faces {
        let normal = frame.inverse() * (face.rotation * DVec3::Y);
        let axis = (0..3).find(|&axis| is_near(normal[axis].abs(), 1.0, 1.0))?;
        let offset = frame.inverse() * (face.position - center);
        let side = &mut halves[axis][usize::from(normal[axis] > 0.0)];
        if side.replace(offset[axis] * normal[axis].signum()).is_some() {
            return None;
        }
    }
    let mut size = DVec3::ZERO;
    for (axis, [low, high]) in halves.into_iter().enumerate() {
        size[axis] = low? + high?;
    }
    let scale = size.max_element();
    let fits =
        size.min_element() > 0.0 && faces.iter().all(|face| is_face(face, center, size, frame));
    (fits && scale.is_finite()).then_some((center, size))
}

/// Whether a rectangle is a whole face of the box.
fn is_face(face: &Face<'_>, center: DVec3, size: DVec3, frame: DQuat) -> bool {
    let Shape::Rectangle { size_x, size_z } = face.collider.shape else { return false };
    let inward = frame.inverse();
    let (along_x, along_z) =
        (inward * (face.rotation * DVec3::X), inward * (face.rotation * DVec3::Z));
    let normal = inward * (face.rotation * DVec3::Y);
    let scale = size.max_element();
    let offset = inward * (face.position - center);
    let expected = 0.5 * size * normal;
    is_near((along_x * size).length(), size_x, scale)
        && is_near((along_z * size).length(), size_z, scale)
        && (offset - expected).length() <= NEAR * scale
}

/// Largest distance between equal points, relative to the size of the box: numbers have 24 bits.
const NEAR: f64 = 1e-5;

fn is_near(number: f64, other: f64, scale: f64) -> bool {
    (number - other).abs() <= NEAR * scale
}
