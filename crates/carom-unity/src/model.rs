//! Meshes of models that lie in a project.

use std::path::Path;

use carom::DVec3;
use carom_scene::import::wavefront;
use carom_scene::scene::{self, Shape};

use crate::placed::Placed;
use crate::pose::{Pose, mirrored};
use crate::project::Project;

/// Shape of the model with this guid at a pose; the error is the reason for the report.
///
/// Only Wavefront files are read. Unity mirrors x when it reads one. Its vertices take the scale of the pose, so that
/// uneven and sheared ones are exact.
pub(crate) fn placed(guid: &str, pose: &Pose, project: &Project) -> Result<Placed, String> {
    let file = project.file(guid).ok_or("its mesh is not in the project")?;
    let shown = project.shown(file);
    if !file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj")) {
        return Err(format!("its mesh is in \"{shown}\"; of models, only .obj files are read"));
    }
    let (vertices, mut triangles) = wavefront(file)
        .map_err(|problem| format!("its mesh \"{shown}\" is not read: {problem}"))?;
    let unit = import_scale(file);
    let back = pose.rotation.inverse();
    let local = |it: &DVec3| {
        let in_unity = unit * DVec3::new(-it.x, it.y, it.z);
        mirrored(back * (pose.point(in_unity) - pose.position))
    };
    let vertices = vertices.iter().map(local).collect();
    if pose.is_mirrored() {
        triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    }
    let mut mesh = scene::Mesh::listed(vertices, triangles);
    // Unity's meshes are passed from behind.
    mesh.one_sided = true;
    let (position, rotation) = (pose.position, pose.rotation);
    Ok(Placed { shape: Shape::Mesh(mesh), position, rotation, inexact: None })
}

/// Scale in the import settings of a model.
fn import_scale(file: &Path) -> f64 {
    let scale = Project::import_setting(file, "globalScale");
    scale.and_then(|it| it.parse().ok()).unwrap_or(1.0)
}
