//! Additions of a frame to a file: nodes, meshes and their parts are only ever added.

use super::arrays::Arrays;
use super::nodes::Nodes;
use crate::document::{Document, Scene};
use crate::rigid_body::{RigidBodies, Shapes};

/// Lengths of the lists of a file at one time.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Marks {
    nodes: usize,
    roots: usize,
    cameras: usize,
    meshes: usize,
    materials: usize,
    accessors: usize,
    views: usize,
    bytes: usize,
    shapes: usize,
    physics_materials: usize,
}

impl Marks {
    /// Moves the marks to the present lengths. Returns what was added since the last call, with the
    /// bytes of new arrays; `None` if nothing was added.
    pub fn advance(&mut self, nodes: &Nodes, arrays: &Arrays) -> Option<(Document, Vec<u8>)> {
        let Nodes { document, bodies, .. } = nodes;
        let is_start = self.nodes == 0;
        if document.nodes.len() == self.nodes {
            return None;
        }
        let roots = document.scenes.first().map_or(&[][..], |scene| &scene.nodes);
        let scene = Scene { nodes: since(roots, &mut self.roots), ..Scene::default() };
        let mut added = Document {
            scene: document.scene,
            scenes: vec![scene],
            nodes: since(&document.nodes, &mut self.nodes),
            cameras: since(&document.cameras, &mut self.cameras),
            meshes: since(&document.meshes, &mut self.meshes),
            materials: since(&document.materials, &mut self.materials),
            accessors: since(&arrays.accessors, &mut self.accessors),
            buffer_views: since(&arrays.views, &mut self.views),
            ..Document::default()
        };
        if is_start {
            added.extensions.lights.clone_from(&document.extensions.lights);
        }
        if !bodies.shapes.shapes.is_empty() {
            let shapes = since(&bodies.shapes.shapes, &mut self.shapes);
            let materials = &bodies.materials.physics_materials;
            let physics_materials = since(materials, &mut self.physics_materials);
            added.extensions.shapes = Some(Shapes { shapes });
            added.extensions.bodies = Some(RigidBodies { physics_materials, ..Default::default() });
        }
        Some((added, since(&arrays.bytes, &mut self.bytes)))
    }
}

/// Returns the part of a list after `mark`, and sets the mark to its end.
fn since<T: Clone>(list: &[T], mark: &mut usize) -> Vec<T> {
    let before = std::mem::replace(mark, list.len());
    list[before..].to_vec()
}

/// Appends the additions of a frame to a document.
pub(super) fn extend(whole: &mut Document, added: Document) {
    whole.scene = whole.scene.or(added.scene);
    let mut roots = added.scenes.into_iter();
    match (whole.scenes.first_mut(), roots.next()) {
        (Some(scene), Some(more)) => scene.nodes.extend(more.nodes),
        (None, Some(first)) => whole.scenes.push(first),
        (_, None) => {}
    }
    whole.nodes.extend(added.nodes);
    whole.cameras.extend(added.cameras);
    whole.meshes.extend(added.meshes);
    whole.materials.extend(added.materials);
    whole.accessors.extend(added.accessors);
    whole.buffer_views.extend(added.buffer_views);
    let (to, from) = (&mut whole.extensions, added.extensions);
    to.lights = to.lights.take().or(from.lights);
    if let Some(more) = from.shapes {
        to.shapes.get_or_insert_default().shapes.extend(more.shapes);
    }
    if let Some(more) = from.bodies {
        let materials = &mut to.bodies.get_or_insert_default().physics_materials;
        materials.extend(more.physics_materials);
    }
}
