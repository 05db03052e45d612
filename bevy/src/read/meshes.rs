//! Colliders from meshes.

use bevy_asset::Assets;
use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use bevy_math::Vec3;
use bevy_mesh::{Mesh, Mesh3d, PrimitiveTopology};
use bevy_transform::components::Transform;
use carom::Shape;

use super::places::Places;
use crate::components::{Collider, ColliderFromMesh};
use crate::convert::to_carom;
use crate::messages::{PhysicsError, PhysicsFault, logged};

type WaitingForMesh<'a> = (Entity, &'a ColliderFromMesh, &'a Mesh3d, &'a Transform);

/// Makes the colliders whose meshes are there. An entity whose mesh is refused loses its [`ColliderFromMesh`].
pub fn make_colliders(
    mut commands: Commands,
    waiting: Query<WaitingForMesh, Without<Collider>>,
    meshes: Option<Res<Assets<Mesh>>>,
    places: Places,
    mut errors: MessageWriter<PhysicsError>,
) {
    let Some(meshes) = meshes else { return };
    for (entity, wanted, handle, transform) in &waiting {
        let Some(mesh) = meshes.get(&handle.0) else { continue };
        let scale = places.of(entity, transform).scale;
        match carom_mesh(mesh, scale) {
            Ok(mesh) => {
                warn_of_faults(entity, &mesh);
                let mesh = if wanted.is_one_sided { mesh.one_sided() } else { mesh };
                let made = wanted.collider.clone().with(|it| it.with_shape(Shape::Mesh(mesh)));
                commands.entity(entity).insert(made);
            }
            Err(fault) => {
                errors.write(logged(Some(entity), fault));
                commands.entity(entity).remove::<ColliderFromMesh>();
            }
        }
    }
}

/// Converts the triangles of a mesh, scaled.
fn carom_mesh(mesh: &Mesh, scale: Vec3) -> Result<carom::Mesh, PhysicsFault> {
    let refused = |reason: &dyn std::fmt::Display| PhysicsFault::Triangles(reason.to_string());
    if mesh.primitive_topology() != PrimitiveTopology::TriangleList {
        return Err(refused(&format!("this one is a {:?}", mesh.primitive_topology())));
    }
    let positions =
        mesh.try_attribute(Mesh::ATTRIBUTE_POSITION).map_err(|error| refused(&error))?;
    let positions = positions.as_float3().ok_or_else(|| refused(&"positions are not `f32`"))?;
    let scaled =
        |&position: &[f32; 3]| to_carom(Vec3::from_array(position).as_dvec3() * scale.as_dvec3());
    let vertices: Vec<_> = positions.iter().map(scaled).collect();
    let indices = mesh.try_indices_option().map_err(|error| refused(&error))?;
    let corners: Vec<u32> = match indices {
        Some(indices) => indices.iter().map(|index| index as u32).collect(),
        None => (0..vertices.len() as u32).collect(),
    };
    // A scale that mirrors turns the triangles round.
    let is_mirrored = scale.x * scale.y * scale.z < 0.0;
    let (triangles, _) = corners.as_chunks::<3>();
    let turned = triangles.iter().map(|&[a, b, c]| if is_mirrored { [a, c, b] } else { [a, b, c] });
    Ok(carom::Mesh::new(vertices, turned.collect())?)
}

/// Logs the probable mistakes of a mesh.
fn warn_of_faults(entity: Entity, mesh: &carom::Mesh) {
    let faults = mesh.faults();
    if !faults.flipped.is_empty() {
        tracing::warn!("{entity}: triangles with another orientation: {:?}", faults.flipped);
    }
    if !faults.crowded_edges.is_empty() {
        tracing::warn!("{entity}: edges of more than two triangles: {:?}", faults.crowded_edges);
    }
}
