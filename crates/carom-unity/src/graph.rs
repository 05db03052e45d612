//! Places game objects in the world, with their names and components.

use std::collections::BTreeMap;
use std::rc::Rc;

use carom::{DQuat, DVec3};
use carom_scene::import::{Omission, omit};

use crate::class;
use crate::document::Document;
use crate::error::ImportError;
use crate::pose::{Pose, rounded};
use crate::value::Value;

/// A game object in the world.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    /// Path of names from the root of the scene, such as `Maze/Wall`.
    pub path: Rc<str>,
    /// Name of the object.
    pub name: String,
    /// Tag of the object.
    pub tag: String,
    /// Id of the parent transform; 0 at the root.
    pub parent: i64,
    /// Rotation of the parent in Unity's coordinates.
    pub parent_rotation: DQuat,
    /// Pose in the world.
    pub pose: Pose,
    /// Whether the object and all its ancestors are active.
    pub active: bool,
    /// Indices of its components, in the order of the file.
    pub components: Vec<usize>,
}

/// Finds the game objects with transforms, in the order of their first documents.
///
/// # Errors
/// [`ImportError`] for a transform that has itself or too many others as ancestors, or that
/// contains an invalid number.
pub(crate) fn nodes(
    objects: &[Document],
    report: &mut Vec<Omission>,
) -> Result<Vec<Node>, ImportError> {
    let index: BTreeMap<i64, usize> =
        objects.iter().enumerate().map(|(index, object)| (object.id, index)).collect();
    let mut graph = Graph { objects, index, placed: BTreeMap::new() };
    let mut nodes: Vec<Node> = Vec::new();
    let mut of_object: BTreeMap<i64, usize> = BTreeMap::new();
    for object in objects.iter().filter(|object| class::is_transform(object.class)) {
        let Some(owner) = graph.owner(object) else {
            omit(report, &object.class_name, "transform", "its game object is not in the file");
            continue;
        };
        let Some(node) = graph.place(object.id)? else {
            let reason = "hangs on an object that is not in the file, or in no known prefab";
            omit(report, name(owner), "game object", reason);
            continue;
        };
        of_object.insert(owner.id, nodes.len());
        nodes.push(node);
    }
    for (place, object) in objects.iter().enumerate() {
        let Some(owner) = object.fields.get("m_GameObject").and_then(Value::reference) else {
            continue;
        };
        if class::is_transform(object.class) {
            continue;
        }
        match of_object.get(&owner.id) {
            Some(&node) => nodes[node].components.push(place),
            // The report already contains this game object.
            None if graph.index.contains_key(&owner.id) => {}
            None => {
                let reason = "its game object is not in the file, or in no known prefab";
                omit(report, &object.class_name, "component", reason);
            }
        }
    }
    Ok(nodes)
}

struct Graph<'a> {
    objects: &'a [Document],
    /// Objects by id.
    index: BTreeMap<i64, usize>,
    /// Nodes by the ids of their transforms; `None` if an ancestor is missing.
    placed: BTreeMap<i64, Option<Node>>,
}

impl<'a> Graph<'a> {
    fn object(&self, id: i64) -> Option<&'a Document> {
        Some(&self.objects[*self.index.get(&id)?])
    }

    fn owner(&self, transform: &Document) -> Option<&'a Document> {
        let owner = self.object(transform.fields.get("m_GameObject")?.reference()?.id)?;
        (owner.class == class::GAME_OBJECT).then_some(owner)
    }

    /// Returns the node of a transform.
    fn place(&mut self, id: i64) -> Result<Option<Node>, ImportError> {
        const DEEPEST: usize = 1000;
        // Go up to an ancestor that is already placed, then down again.
        let mut chain = Vec::new();
        let mut next = id;
        let mut above = loop {
            if next == 0 {
                break Some(root());
            }
            if let Some(node) = self.placed.get(&next) {
                break node.clone();
            }
            let Some(object) = self.object(next).filter(|it| class::is_transform(it.class)) else {
                break None;
            };
            if chain.contains(&next) {
                return Err(object.fields.place.malformed("the transform hangs on itself"));
            }
            if chain.len() == DEEPEST {
                return Err(object.fields.place.malformed("hangs on more than 1000 transforms"));
            }
            chain.push(next);
            next = object.fields.get("m_Father").and_then(Value::reference).map_or(0, |it| it.id);
        };
        while let Some(id) = chain.pop() {
            let node = match (above, self.object(id)) {
                (Some(above), Some(transform)) => {
                    self.owner(transform).map(|owner| node(owner, transform, &above)).transpose()?
                }
                _ => None,
            };
            let node = node.map(|node| Node { parent: next, ..node });
            self.placed.insert(id, node.clone());
            (above, next) = (node, id);
        }
        Ok(above)
    }
}

/// Parent of objects without a parent.
fn root() -> Node {
    Node {
        path: "".into(),
        name: String::new(),
        tag: String::new(),
        parent: 0,
        parent_rotation: DQuat::IDENTITY,
        pose: Pose::WORLD,
        active: true,
        components: Vec::new(),
    }
}

fn node(owner: &Document, transform: &Document, above: &Node) -> Result<Node, ImportError> {
    /// Longest path; names of ancestors are left out of longer ones \[characters\].
    const LONGEST: usize = 400;
    let name = name(owner).to_owned();
    let path = match above.path.is_empty() || above.path.len() + name.len() > LONGEST {
        true => name.clone(),
        false => format!("{}/{name}", above.path),
    };
    let position = transform.fields.vector_at("m_LocalPosition", DVec3::ZERO)?;
    let scale = transform.fields.vector_at("m_LocalScale", DVec3::ONE)?;
    let active = owner.fields.get("m_IsActive").and_then(Value::text) != Some("0");
    Ok(Node {
        path: path.into(),
        name,
        tag: owner.fields.get("m_TagString").and_then(Value::text).unwrap_or_default().to_owned(),
        parent: 0,
        parent_rotation: above.pose.rotation,
        pose: above.pose.child(position, rotation(transform)?, scale),
        active: active && above.active,
        components: Vec::new(),
    })
}

fn name(owner: &Document) -> &str {
    let name = owner.fields.get("m_Name").and_then(Value::text).unwrap_or_default();
    if name.is_empty() { "(without a name)" } else { name }
}

/// Reads the local rotation. Unity computes in 32 bits, in which a unit quaternion has 7 decimals.
/// Its versions write 7 to 9 digits; rounding makes equal rotations equal again.
fn rotation(transform: &Document) -> Result<DQuat, ImportError> {
    let field = "m_LocalRotation";
    let Some(written) = transform.fields.get(field) else { return Ok(DQuat::IDENTITY) };
    let parts = written.numbers(field, ["x", "y", "z", "w"])?;
    let quaternion = DQuat::from_array(parts.map(|part| rounded(part, 1e7)));
    let length = quaternion.length();
    if !(length > 0.5 && length < 2.0) {
        return Err(written.place.malformed("m_LocalRotation must be a quaternion of length 1"));
    }
    Ok(quaternion * (1.0 / length))
}
