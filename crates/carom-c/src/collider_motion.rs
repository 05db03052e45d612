//! Motions of colliders.

use std::ffi::c_char;

use carom::{Collider, ColliderId, DQuat, DVec3, Keyframe, Keyframes, Motion, MotionPart, Pose};
use carom_scene::part;

use crate::collider::replace;
use crate::motion::vector;
use crate::pointer::{Plain, Rows, Strided, text};
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

/// Sets the motion of a collider from the field `motion` of a scene file (TOML), such as
/// "{ turn = { rate = 2.0 } }", or several in brackets; "[]" removes any motion, and the collider is at
/// rest. The pose at rest is the one that the collider had without a motion.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_motion(
    world: CaromWorld,
    collider: u64,
    motion: *const c_char,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's text is null or ends in a zero, as the header demands.
        let motion = unsafe { text(motion, "motion") }?;
        let part =
            part::read(&format!("[[colliders]]\nshape = \"half-space\"\nmotion = {motion}"))?;
        let described = part.world()?;
        part::only(&part.colliders)?;
        let moving = described.colliders().map(|(_, collider)| collider.motion.parts().to_vec());
        // A motion that was in a world knows the pose of its collider there; its parts do not.
        let motion = Motion::new(moving.flatten());
        world.with(|inner| {
            let own = ColliderId::from_number(collider);
            let rest = at_rest(inner.world.collider(own)?);
            replace(inner, own, rest.with_motion(motion))
        })
    })
}

/// Moves a collider to a pose that it reaches `dt` [s] from now, at a steady velocity that strikes
/// spheres on the way: the position is three numbers [m], the rotation a quaternion x, y, z, w. Call it
/// before each step of `dt`; after that time the collider moves on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_set_next_pose(
    world: CaromWorld,
    collider: u64,
    position: *const f64,
    rotation: *const f64,
    dt: f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let position = unsafe { vector(position, "position") }?;
        let array = Strided { stride: 0, count: 1 };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let rotation = unsafe { Rows::new(rotation, array, 4, "rotation") }?.row::<4>(0);
        let pose = Pose::at(position).rotated(DQuat::from_array(rotation));
        world.with(|inner| {
            let own = ColliderId::from_number(collider);
            let moving = inner.world.moving_to(own, pose, dt)?;
            replace(inner, own, moving)
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
