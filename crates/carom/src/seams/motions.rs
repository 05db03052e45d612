//! Finds the colliders that move as one.

use glam::DVec3;

use crate::collider::Collider;
use crate::collider_motion::MotionPart;
use crate::norm::Norm;
use crate::pose::Pose;

/// Distance between pivots that are one place, at most, as a part of their coordinates: their rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Returns whether two colliders are at rest, or move as one body does.
pub(super) fn are_one(first: &Collider, second: &Collider) -> bool {
    if first.motion.is_empty() && second.motion.is_empty() {
        let turns = first.angular_velocity != DVec3::ZERO;
        return first.velocity == second.velocity
            && first.angular_velocity == second.angular_velocity
            && (!turns || first.pose.position == second.pose.position);
    }
    let [parts, others] = [first, second].map(|it| it.motion.parts());
    let rests = [first, second].map(|it| rest_pose(it).position);
    let is_same = |(part, other): (&MotionPart, &MotionPart)| are_same([part, other], rests);
    parts.len() == others.len() && parts.iter().zip(others).all(is_same)
}

/// Returns whether a collider moves steadily, so that each step rounds its pose.
pub(super) fn is_steady(collider: &Collider) -> bool {
    let moves = collider.velocity != DVec3::ZERO || collider.angular_velocity != DVec3::ZERO;
    collider.motion.is_empty() && moves
}

/// Pose of a collider without its motion.
pub(super) fn rest_pose(collider: &Collider) -> Pose {
    collider.motion.rest().unwrap_or(collider.pose)
}

/// Returns whether two parts move colliders with these positions at rest \[m\] in the same way.
fn are_same(parts: [&MotionPart; 2], rests: [DVec3; 2]) -> bool {
    let [(first, pivot), (second, other)] = parts.map(without_pivot);
    let is_one_place = match (pivot, other) {
        (Some(pivot), Some(other)) => {
            let places = [rests[0] + pivot, rests[1] + other];
            let coordinates = rests[0].norm() + pivot.norm() + rests[1].norm() + other.norm();
            (places[0] - places[1]).norm() <= ROUNDING * coordinates
        }
        _ => true,
    };
    first == second && is_one_place
}

/// A part of a motion with its pivot at the position at rest, and the pivot \[m\].
fn without_pivot(part: &MotionPart) -> (MotionPart, Option<DVec3>) {
    let zero = DVec3::ZERO;
    match *part {
        MotionPart::Turn { axis, pivot, rate } => {
            (MotionPart::Turn { axis, pivot: zero, rate }, Some(pivot))
        }
        MotionPart::Swing { axis, pivot, amplitude, frequency, phase } => {
            (MotionPart::Swing { axis, pivot: zero, amplitude, frequency, phase }, Some(pivot))
        }
        MotionPart::Keyframes(ref keyframes) => {
            let at_rest = keyframes.clone().about(zero);
            (MotionPart::Keyframes(at_rest), Some(keyframes.pivot()))
        }
        MotionPart::Steady { .. } | MotionPart::Oscillate { .. } => (part.clone(), None),
    }
}
