//! Places the nodes of a scene in the world.

use carom_scene::import::plain_name;

use super::error::Malformed;
use super::pose::Pose;
use crate::document::Document;

/// A node with its pose in the world.
#[derive(Debug)]
pub(super) struct Placed {
    /// Index in the file.
    pub index: usize,
    /// Path of names from the root of the scene, such as `Maze/Wall`.
    pub path: String,
    /// Name of the node.
    pub name: String,
    /// Pose in the world.
    pub pose: Pose,
    /// Index of its parent in the list of placed nodes.
    pub parent: Option<usize>,
}

impl Placed {
    /// Place of the node in the file, for errors.
    pub fn place(&self) -> String {
        format!("nodes[{}] ({})", self.index, self.name)
    }
}

/// Longest path of names \[bytes\].
const LONGEST: usize = 200;

/// Places the nodes of the default scene; parents come before their children.
///
/// # Errors
/// [`Malformed`] if a node is missing, has several parents or itself as an ancestor, or has an
/// invalid transformation.
pub(super) fn nodes(document: &Document) -> Result<Vec<Placed>, Malformed> {
    let mut seen = vec![false; document.nodes.len()];
    let mut placed: Vec<Placed> = Vec::new();
    // Nodes that are still to be placed, in reverse order, so that the result is in the order of
    // the file.
    let mut waiting: Vec<(usize, Option<usize>)> =
        roots(document)?.into_iter().rev().map(|root| (root, None)).collect();
    while let Some((index, parent)) = waiting.pop() {
        let place = || format!("nodes[{index}]");
        let node = document.nodes.get(index);
        let node = node.ok_or_else(|| Malformed::at(place(), "is not there"))?;
        if std::mem::replace(&mut seen[index], true) {
            return Err(Malformed::at(place(), "hangs on two nodes, or on itself"));
        }
        let name = match node.name.as_str() {
            "" => format!("node {index}"),
            name => plain_name(name),
        };
        let above = parent.map(|parent| &placed[parent]);
        let path = match above {
            Some(above) if above.path.len() < LONGEST => format!("{}/{name}", above.path),
            Some(above) => above.path.clone(),
            None => name.clone(),
        };
        let pose = above.map_or(Pose::WORLD, |above| above.pose).child(node);
        let no_pose = || Malformed::at(place(), "has an invalid place, rotation or scale");
        let pose = pose.ok_or_else(no_pose)?;
        let itself = placed.len();
        placed.push(Placed { index, path, name, pose, parent });
        waiting.extend(node.children.iter().rev().map(|&child| (child, Some(itself))));
    }
    Ok(placed)
}

/// Nodes without parents.
fn roots(document: &Document) -> Result<Vec<usize>, Malformed> {
    if document.scenes.is_empty() {
        let mut is_child = vec![false; document.nodes.len()];
        for &child in document.nodes.iter().flat_map(|node| &node.children) {
            if let Some(is_child) = is_child.get_mut(child) {
                *is_child = true;
            }
        }
        return Ok((0..document.nodes.len()).filter(|&node| !is_child[node]).collect());
    }
    let scene = document.scenes.get(document.scene.unwrap_or(0));
    scene.map(|scene| scene.nodes.clone()).ok_or_else(|| Malformed::at("scene", "is not there"))
}
