//! Makes meshes of what scenes say of them.

use std::path::Path;

use carom::{DVec3, Mesh, MeshFaults};

use crate::budget::Budget;
use crate::error::Problem;
use crate::mesh_file;
use crate::scene::values::vector;
use crate::scene::{self, Scene};

/// Numbers of triangles or edges that a message shows.
const SHOWN: usize = 5;

/// Refuses meshes from files where none may be opened.
pub(crate) fn check_files(scene: &Scene, budget: Budget) -> Result<(), Problem> {
    if budget.opens_files {
        return Ok(());
    }
    let own = scene.colliders.iter().enumerate();
    let own = own.map(|(i, collider)| (format!("colliders[{i}]"), collider));
    let made = scene.generators.iter().enumerate().filter_map(|(i, generator)| {
        Some((format!("generators[{i}].{}.collider", generator.kind()), generator.collider()?))
    });
    for (path, collider) in own.chain(made) {
        if let scene::Shape::Mesh(scene::Mesh { file: Some(_), .. }) = collider.shape {
            return Err(Problem::new(
                format!("{path}.shape.mesh"),
                "a link opens no file: list `vertices` and `triangles`",
            ));
        }
    }
    Ok(())
}

/// Makes a mesh of what a scene says of it.
///
/// # Errors
/// What is wrong with it, in words.
pub(crate) fn made(mesh: &scene::Mesh) -> Result<Mesh, String> {
    let scene::Mesh { file, vertices, triangles, scale, one_sided, .. } = mesh;
    if !(scale.is_finite() && *scale > 0.0) {
        return Err(format!("`scale` must be positive and finite, not {scale}"));
    }
    let is_listed = !(vertices.is_empty() && triangles.is_empty());
    let (vertices, triangles) = match file {
        Some(_) if is_listed => {
            return Err("has a `file` and lists: one of them is enough".to_owned());
        }
        Some(file) => mesh_file::read(Path::new(file))
            .map_err(|error| format!("cannot read \"{file}\": {error}"))?,
        None => (vertices.iter().map(|it| vector(*it)).collect(), triangles.clone()),
    };
    let vertices = vertices.into_iter().map(|it: DVec3| *scale * it).collect();
    let made = Mesh::new(vertices, triangles).map_err(|error| error.to_string())?;
    Ok(if *one_sided { made.one_sided() } else { made })
}

/// Says what of a mesh may not be as meant, a line for each kind, by the numbers of triangles and vertices.
pub fn remarks(mesh: &Mesh) -> Vec<String> {
    let MeshFaults { degenerate, repeated, flipped, open_edges, crowded_edges, .. } = mesh.faults();
    let numbers = |numbers: &[usize]| listed(numbers.len(), numbers.iter().map(usize::to_string));
    let edges =
        |edges: &[[usize; 2]]| listed(edges.len(), edges.iter().map(|[a, b]| format!("{a}-{b}")));
    let is_open = !open_edges.is_empty() && !mesh.is_one_sided();
    let kinds = [
        (degenerate.is_empty(), "without an area, left out: triangles", numbers(&degenerate)),
        (repeated.is_empty(), "given twice, left out once: triangles", numbers(&repeated)),
        (flipped.is_empty(), "facing otherwise than a neighbour: triangles", numbers(&flipped)),
        (!is_open, "open, so it is met from both sides: edges", edges(&open_edges)),
        (crowded_edges.is_empty(), "with more than two triangles: edges", edges(&crowded_edges)),
    ];
    let is_there = |kind: &&(bool, &str, String)| !kind.0;
    kinds.iter().filter(is_there).map(|(_, kind, which)| format!("{kind} {which}")).collect()
}

/// The first few of a list, and how many there are.
fn listed(count: usize, items: impl Iterator<Item = String>) -> String {
    let shown: Vec<String> = items.take(SHOWN).collect();
    let more = if count > SHOWN { format!(" ... ({count})") } else { String::new() };
    format!("{}{more}", shown.join(", "))
}
