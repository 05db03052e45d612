//! A mesh of Bevy is the collider that it looks like, and one that cannot be is a typed error.

mod common;

use bevy_asset::{Assets, RenderAssetUsages};
use bevy_ecs::prelude::*;
use bevy_math::Vec3;
use bevy_math::primitives::Cuboid;
use bevy_mesh::{Mesh, Mesh3d, PrimitiveTopology};
use bevy_transform::components::Transform;
use carom_bevy::PhysicsFault;
use carom_bevy::carom::Shape;
use carom_bevy::prelude::*;
use common::{app, get, messages, steps};

fn mesh_entity(app: &mut bevy_app::App, mesh: Mesh, transform: Transform) -> Entity {
    let mut meshes = app.world_mut().get_resource_or_init::<Assets<Mesh>>();
    let mesh = Mesh3d(meshes.add(mesh));
    app.world_mut().spawn((ColliderFromMesh::default(), mesh, transform)).id()
}

#[test]
fn a_scaled_cube_is_met_at_its_faces() {
    for mirrored in [1.0, -1.0] {
        let mut app = app();
        let scale = Vec3::new(2.0 * mirrored, 1.0, 1.0);
        let place = Transform::from_xyz(4.0, 0.0, 0.0).with_scale(scale);
        let cube = mesh_entity(&mut app, Cuboid::from_length(1.0).into(), place);
        let velocity = LinearVelocity::new(64.0, 0.0, 0.0);
        let ball = app.world_mut().spawn((Ball::new(0.5), velocity)).id();
        steps(&mut app, 4);
        let collider = app.world().get::<Collider>(cube).expect("it was made");
        let Shape::Mesh(mesh) = &collider.0.shape else { panic!("a mesh") };
        assert!(mesh.is_closed());
        // 2.5 m to the face at 3 m, and back for the rest of 4 m.
        assert_eq!(get::<Transform>(&app, ball).translation.x, 1.0);
    }
}

#[test]
fn a_mesh_of_lines_is_an_error() {
    let mut app = app();
    let lines = Mesh::new(PrimitiveTopology::LineList, RenderAssetUsages::default());
    let entity = mesh_entity(&mut app, lines, Transform::IDENTITY);
    let empty = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    mesh_entity(&mut app, empty, Transform::IDENTITY);
    steps(&mut app, 3);
    let errors = messages::<PhysicsError>(&app);
    assert_eq!(errors.len(), 2, "each once: {errors:?}");
    assert_eq!(errors[0].entity, Some(entity));
    assert!(matches!(errors[0].fault, PhysicsFault::Triangles(_)));
    assert_eq!(app.world().resource::<CaromWorld>().colliders().len(), 0);
}

#[test]
fn a_flat_triangle_without_area_is_an_error() {
    let mut app = app();
    let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default());
    mesh.insert_attribute(Mesh::ATTRIBUTE_POSITION, vec![[0.0_f32; 3]; 3]);
    mesh_entity(&mut app, mesh, Transform::IDENTITY);
    steps(&mut app, 1);
    let errors = messages::<PhysicsError>(&app);
    assert!(matches!(errors[0].fault, PhysicsFault::Mesh(carom_bevy::carom::MeshError::NoArea)));
}
