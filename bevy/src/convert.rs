//! Conversions between the vectors of Bevy and those of Carom, which belong to different versions of one library.

use bevy_math::{DQuat, DVec3};
use bevy_transform::components::Transform;
use carom::Pose;

pub fn to_carom(vector: DVec3) -> carom::DVec3 {
    carom::DVec3::from_array(vector.to_array())
}

pub fn to_bevy(vector: carom::DVec3) -> DVec3 {
    DVec3::from_array(vector.to_array())
}

/// Position and rotation of a place, without its scale.
pub fn pose_of(place: &Transform) -> Pose {
    let rotation = place.rotation.as_dquat().to_array();
    Pose::at(to_carom(place.translation.as_dvec3())).rotated(carom::DQuat::from_array(rotation))
}

/// A place with the position and rotation of a pose, rounded to `f32`, and this scale.
pub fn place_of(pose: Pose, scale: bevy_math::Vec3) -> Transform {
    let rotation = DQuat::from_array(pose.rotation.normalize().to_array()).as_quat();
    Transform { translation: to_bevy(pose.position).as_vec3(), rotation, scale }
}
