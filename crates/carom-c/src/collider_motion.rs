//! Motions of colliders through poses at given times.

use carom::{Collider, ColliderId, DQuat, DVec3, Keyframe, Keyframes, Motion, MotionPart};

use crate::collider::replace;
use crate::motion::vector;
use crate::pointer::{Plain, Rows, Strided};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A pose that a collider reaches at a time.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromKeyframe {
    /// Time on the world's clock [s].
    pub time: f64,
    /// Displacement from the pose at rest [m], along the axes of the world.
    pub position: [f64; 3],
    /// Rotation from the pose at rest, about the axes of the world: a quaternion x, y, z, w of any
    /// length but zero.
    pub rotation: [f64; 4],
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromKeyframe {}

impl From<CaromKeyframe> for Keyframe {
    fn from(keyframe: CaromKeyframe) -> Self {
        let CaromKeyframe { time, position, rotation } = keyframe;
        let rotation = DQuat::from_array(rotation);
        Self { time, position: DVec3::from_array(position), rotation }
    }
}

/// Moves a collider through two or more poses, ascending by time and without gaps in memory;
/// velocities are continuous, and it rests before and after. It turns about `pivot`, three numbers
/// [m] from the position at rest, along the axes of the world. If `repeats` is 1, the motion repeats
/// before and after; the last pose has to be the first. The pose at rest is the one that the
/// collider had without a motion. A `count` of 0 removes any motion, and the collider is at rest.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_keyframes(
    world: CaromWorld,
    collider: u64,
    keyframes: *const CaromKeyframe,
    count: usize,
    pivot: *const f64,
    repeats: u32,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let keyframes = unsafe { Rows::new(keyframes, array, 1, "keyframes") }?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let pivot = unsafe { vector(pivot, "pivot") }?;
        if repeats > 1 {
            return Err(Failure::new(CaromStatus::Invalid, "`repeats` must be 0 or 1"));
        }
        let keyframes: Vec<Keyframe> = keyframes.values().map(Keyframe::from).collect();
        let is_moved = !keyframes.is_empty();
        let keyframes = Keyframes::new(keyframes).about(pivot);
        let keyframes = if repeats == 1 { keyframes.repeating() } else { keyframes };
        let part = is_moved.then_some(MotionPart::Keyframes(keyframes));
        world.with(|inner| {
            let own = ColliderId::from_number(collider);
            let rest = at_rest(inner.world.collider(own)?);
            replace(inner, own, rest.with_motion(Motion::new(part)))
        })
    })
}

/// Returns the collider without its motion.
fn at_rest(collider: Collider) -> Collider {
    match collider.motion.rest() {
        Some(rest) => collider.with_pose(rest),
        None => collider,
    }
}
