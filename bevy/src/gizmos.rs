//! Outlines of balls and colliders.

use bevy_app::prelude::*;
use bevy_color::Color;
use bevy_ecs::prelude::*;
use bevy_gizmos::config::{GizmoConfigGroup, GizmoConfigStore};
use bevy_gizmos::gizmos::Gizmos;
use bevy_gizmos::prelude::{AppGizmoBuilder, GizmoPrimitive3d};
use bevy_math::primitives::{
    Capsule3d, ConicalFrustum, Cuboid, Cylinder, Plane3d, Sphere, Torus, Triangle3d,
};
use bevy_math::{Isometry3d, Quat, Vec2, Vec3};
use bevy_reflect::Reflect;
use bevy_transform::TransformSystems;
use bevy_transform::components::GlobalTransform;
use carom::Shape;

use crate::components::{Ball, Collider};

/// Draws the outlines of balls and colliders by Bevy's gizmos.
#[derive(Debug, Clone, Copy, Default)]
pub struct CaromGizmosPlugin;

/// Colours of the outlines; line width and other settings are in Bevy's `GizmoConfigStore`.
#[derive(Reflect, GizmoConfigGroup, Debug, Clone, PartialEq)]
pub struct CaromGizmos {
    /// Of balls.
    pub balls: Color,
    /// Of colliders.
    pub colliders: Color,
    /// Of sensors.
    pub sensors: Color,
}

impl Default for CaromGizmos {
    fn default() -> Self {
        Self {
            balls: Color::srgb(1.0, 0.6, 0.1),
            colliders: Color::srgb(0.3, 0.7, 1.0),
            sensors: Color::srgb(0.4, 0.9, 0.4),
        }
    }
}

impl Plugin for CaromGizmosPlugin {
    fn build(&self, app: &mut App) {
        app.init_gizmo_group::<CaromGizmos>();
        app.add_systems(PostUpdate, draw.after(TransformSystems::Propagate));
    }
}

type Lines<'w, 's> = Gizmos<'w, 's, CaromGizmos>;

fn draw(
    mut lines: Lines,
    store: Res<GizmoConfigStore>,
    balls: Query<(&Ball, &GlobalTransform)>,
    colliders: Query<(&Collider, &GlobalTransform), Without<Ball>>,
) {
    let (_, colors) = store.config::<CaromGizmos>();
    for (ball, place) in &balls {
        lines.sphere(place.to_isometry(), ball.0.radius as f32, colors.balls);
    }
    for (collider, place) in &colliders {
        let color = if collider.0.trigger { colors.sensors } else { colors.colliders };
        outline(&mut lines, &collider.0.shape, place.to_isometry(), color);
    }
}

/// Draws the outline of a shape.
fn outline(lines: &mut Lines, shape: &Shape, place: Isometry3d, color: Color) {
    // Gizmos draw flat figures in the xy plane; ours lie in the xz plane.
    let flat =
        place * Isometry3d::from_rotation(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2));
    match *shape {
        Shape::Sphere { radius } | Shape::Bowl { radius, .. } => {
            lines.primitive_3d(&Sphere::new(radius as f32), place, color);
        }
        Shape::Rectangle { size_x, size_z } => {
            lines.rect(flat, Vec2::new(size_x as f32, size_z as f32), color);
        }
        Shape::HalfSpace => {
            lines.primitive_3d(&Plane3d::new(Vec3::Y, Vec2::ONE), place, color);
        }
        Shape::Box { size } | Shape::Container { size, .. } => {
            let size = size.as_vec3().to_array();
            lines.primitive_3d(&Cuboid::from_size(size.into()), place, color);
        }
        Shape::Cylinder { radius, height: length } | Shape::Pipe { radius, length, .. } => {
            lines.primitive_3d(&Cylinder::new(radius as f32, length as f32), place, color);
        }
        Shape::Cone { bottom_radius, top_radius, height }
        | Shape::Funnel { bottom_radius, top_radius, height } => {
            let [radius_bottom, radius_top] = [bottom_radius as f32, top_radius as f32];
            let frustum = ConicalFrustum { radius_top, radius_bottom, height: height as f32 };
            lines.primitive_3d(&frustum, place, color);
        }
        Shape::Capsule { radius, length } => {
            lines.primitive_3d(&Capsule3d::new(radius as f32, length as f32), place, color);
        }
        Shape::Disc { radius } => drop(lines.circle(flat, radius as f32, color)),
        Shape::Torus { ring_radius, tube_radius } => {
            let torus =
                Torus { minor_radius: tube_radius as f32, major_radius: ring_radius as f32 };
            lines.primitive_3d(&torus, place, color);
        }
        Shape::Mesh(ref mesh) => {
            for triangle in mesh.triangles() {
                let corner =
                    |index: u32| mesh.vertices()[index as usize].as_vec3().to_array().into();
                let [a, b, c] = triangle.map(corner);
                lines.primitive_3d(&Triangle3d::new(a, b, c), place, color);
            }
        }
        _ => {}
    }
}
