//! Outlines of balls and colliders.

use bevy_app::prelude::*;
use bevy_color::Color;
use bevy_ecs::prelude::*;
use bevy_gizmos::config::{GizmoConfigGroup, GizmoConfigStore};
use bevy_gizmos::gizmos::{GizmoBuffer, Gizmos};
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

/// Draws the outlines of balls and colliders by Bevy's gizmos; needs its `GizmoPlugin`, which is in `DefaultPlugins`.
#[derive(Debug, Clone, Copy, Default)]
pub struct CaromGizmosPlugin;

/// Colours of the outlines; line width and other settings are in Bevy's `GizmoConfigStore`.
#[derive(Reflect, GizmoConfigGroup, Debug, Clone, PartialEq)]
pub struct CaromGizmos {
    /// Colour of balls.
    pub balls: Color,
    /// Colour of colliders.
    pub colliders: Color,
    /// Colour of sensors.
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

type Lines = GizmoBuffer<CaromGizmos, ()>;

fn draw(
    mut lines: Gizmos<CaromGizmos>,
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

#[cfg(test)]
mod tests {
    use bevy_app::{App, TaskPoolPlugin};
    use bevy_asset::AssetPlugin;
    use bevy_gizmos::GizmoPlugin;
    use bevy_math::Isometry3d;
    use bevy_time::TimePlugin;
    use bevy_transform::TransformPlugin;
    use carom::{DVec3, Ends, Mesh, Shape, Sides};

    use super::{CaromGizmos, CaromGizmosPlugin, Lines, outline};
    use crate::{Ball, CaromPlugin, Collider};

    fn shapes() -> Vec<Shape> {
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let size = DVec3::ONE;
        let (radius, height, length) = (0.5, 1.0, 1.0);
        let (bottom_radius, top_radius) = (0.5, 0.25);
        vec![
            Shape::Sphere { radius },
            Shape::Rectangle { size_x: 1.0, size_z: 2.0 },
            Shape::HalfSpace,
            Shape::Box { size },
            Shape::Container { size, open: Sides::NONE },
            Shape::Cylinder { radius, height },
            Shape::Cone { bottom_radius, top_radius, height },
            Shape::Capsule { radius, length },
            Shape::Disc { radius },
            Shape::Torus { ring_radius: 1.0, tube_radius: 0.25 },
            Shape::Pipe { radius, length, closed: Ends::NONE },
            Shape::Bowl { radius, opening: 1.0 },
            Shape::Funnel { bottom_radius, top_radius, height },
            Shape::Mesh(Mesh::new(corners, vec![[0, 1, 2]]).expect("a triangle")),
        ]
    }

    #[test]
    fn every_shape_has_an_outline() {
        for shape in shapes() {
            let mut lines = Lines::default();
            let color = CaromGizmos::default().colliders;
            outline(&mut lines, &shape, Isometry3d::IDENTITY, color);
            let drawn = lines.buffer();
            let corners = drawn.list_positions.len() + drawn.strip_positions.len();
            assert!(corners > 0, "{shape:?}");
        }
    }

    #[test]
    fn the_plugin_draws_without_a_renderer() {
        let mut app = App::new();
        app.add_plugins((TaskPoolPlugin::default(), AssetPlugin::default(), GizmoPlugin));
        let physics = CaromPlugin::default();
        app.add_plugins((TimePlugin, TransformPlugin, physics, CaromGizmosPlugin));
        app.world_mut().spawn(Ball::new(1.0));
        app.world_mut().spawn(Collider::half_space());
        app.update();
        app.update();
    }
}
