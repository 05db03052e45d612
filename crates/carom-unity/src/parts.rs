//! Sorts the components of a game object.

use carom_scene::import::{Omission, omit};

use crate::class;
use crate::document::Document;
use crate::graph::Node;
use crate::mapping::Mapping;
use crate::project::Project;
use crate::script::Script;
use crate::value::Value;

/// Components of a game object by kind.
#[derive(Default)]
pub(crate) struct Parts<'a> {
    pub scripts: Vec<Script<'a>>,
    pub rigid_body: Option<&'a Document>,
    /// Colliders of Unity's own physics.
    pub colliders: Vec<&'a Document>,
    pub mesh: Option<&'a Document>,
    pub renderer: Option<&'a Document>,
    pub camera: Option<&'a Document>,
    pub light: Option<&'a Document>,
}

impl<'a> Parts<'a> {
    /// Sorts the components of a node; reports those that are unknown or disabled.
    pub fn of(
        node: &Node,
        objects: &'a [Document],
        mapping: &'a Mapping,
        project: &Project,
        report: &mut Vec<Omission>,
    ) -> Self {
        let mut parts = Self::default();
        for document in node.components.iter().map(|&index| &objects[index]) {
            let enabled = document.fields.get("m_Enabled").and_then(Value::text) != Some("0");
            if !enabled && document.class != class::MESH_RENDERER {
                omit(report, &node.path, &document.class_name, "is disabled");
                continue;
            }
            match document.class {
                class::MONO_BEHAVIOUR => match Script::of(document, mapping, project) {
                    Ok(script) => parts.scripts.push(script),
                    Err(reason) => omit(report, &node.path, "script", reason),
                },
                class::RIGIDBODY => parts.rigid_body = Some(document),
                class::SPHERE_COLLIDER
                | class::BOX_COLLIDER
                | class::CAPSULE_COLLIDER
                | class::MESH_COLLIDER => {
                    parts.colliders.push(document);
                }
                class::MESH_FILTER => parts.mesh = Some(document),
                class::MESH_RENDERER => parts.renderer = Some(document),
                class::CAMERA => parts.camera = Some(document),
                class::LIGHT => parts.light = Some(document),
                _ => omit(report, &node.path, &document.class_name, "has no counterpart"),
            }
        }
        parts
    }

    /// Whether the object is a sphere moved by Unity's own physics.
    pub fn is_moving_sphere(&self) -> bool {
        let is_sphere = |it: &&Document| it.class == class::SPHERE_COLLIDER && !is_trigger(it);
        self.moves() && self.colliders.iter().any(is_sphere)
    }

    /// Whether the object is moved by Unity's own physics but is no sphere.
    pub fn is_moving_otherwise(&self) -> bool {
        self.moves() && !self.is_moving_sphere()
    }

    /// Whether Unity's own physics moves the object.
    fn moves(&self) -> bool {
        self.rigid_body.is_some_and(|body| !is_set(body, "m_IsKinematic"))
    }

    /// Reports fields of scripts that are not used.
    pub fn list_unread(&self, node: &Node, report: &mut Vec<Omission>) {
        for script in &self.scripts {
            for field in script.unread() {
                let component = format!("script \"{}\"", script.kind.name);
                omit(report, &node.path, &component, format!("its field {field} is not read"));
            }
        }
    }
}

/// Whether a collider of Unity is a trigger.
pub(crate) fn is_trigger(collider: &Document) -> bool {
    is_set(collider, "m_IsTrigger")
}

/// Whether a field exists and is not 0.
pub(crate) fn is_set(document: &Document, field: &str) -> bool {
    document.fields.get(field).and_then(Value::text).is_some_and(|it| it != "0")
}
