//! Transforms between two steps, for smooth pictures.

use bevy_app::{App, RunFixedMainLoop, RunFixedMainLoopSystems};
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

/// Draws the entity between its last two steps, at the time of the picture, instead of at the last step.
///
/// Its `Transform` is interpolated after the fixed schedules of a frame, and is that of the physics again before the
/// next ones: systems in `FixedUpdate` see the physics, those in `Update` the picture. A place that a program sets is
/// taken at once.
#[derive(Component, Debug, Clone, Copy, Default)]
#[require(Transform)]
pub struct TransformInterpolation {
    /// Before and after the last step.
    ends: Option<[Transform; 2]>,
    /// What was written for the picture.
    shown: Option<Transform>,
}

impl TransformInterpolation {
    /// Returns the `Transform` of the physics, where `now` is that of the entity.
    pub(crate) fn physical(&self, now: Transform) -> Transform {
        match (self.ends, self.shown) {
            (Some([_, end]), Some(shown)) if shown == now => end,
            _ => now,
        }
    }
}

pub fn add(app: &mut App) {
    let before = RunFixedMainLoopSystems::BeforeFixedMainLoop;
    let after = RunFixedMainLoopSystems::AfterFixedMainLoop;
    app.add_systems(RunFixedMainLoop, hide.in_set(before));
    app.add_systems(RunFixedMainLoop, show.in_set(after));
}

/// Sets each `Transform` to that of the physics.
fn hide(mut bodies: Query<(&mut Transform, &mut TransformInterpolation)>) {
    for (mut transform, mut interpolation) in &mut bodies {
        let physical = interpolation.physical(*transform);
        transform.set_if_neq(physical);
        interpolation.shown = None;
    }
}

/// Notes where bodies are before a step.
pub fn begin_step(mut bodies: Query<(&Transform, &mut TransformInterpolation)>) {
    for (transform, mut interpolation) in &mut bodies {
        interpolation.ends = Some([*transform; 2]);
    }
}

/// Notes where bodies are after a step.
pub fn end_step(mut bodies: Query<(&Transform, &mut TransformInterpolation)>) {
    for (transform, mut interpolation) in &mut bodies {
        let [before, _] = interpolation.ends.unwrap_or([*transform; 2]);
        interpolation.ends = Some([before, *transform]);
    }
}

/// Sets each `Transform` to that at the time of the picture.
fn show(time: Res<Time<Fixed>>, mut bodies: Query<(&mut Transform, &mut TransformInterpolation)>) {
    let fraction = time.overstep_fraction();
    for (mut transform, mut interpolation) in &mut bodies {
        let Some([before, after]) = interpolation.ends else { continue };
        if *transform != after {
            // A program moved it after the step.
            interpolation.ends = None;
            continue;
        }
        let shown = Transform {
            translation: before.translation.lerp(after.translation, fraction),
            rotation: before.rotation.slerp(after.rotation, fraction),
            ..after
        };
        transform.set_if_neq(shown);
        interpolation.shown = Some(shown);
    }
}
