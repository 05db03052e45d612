//! Builds a scene from game objects.

use std::collections::BTreeMap;

use carom_scene::import::{Omission, omit, plain_name};
use carom_scene::scene::{Collider, Emitter, Finish, Force, Scene, Shape, Sphere};

use crate::document::Document;
use crate::error::{ImportError, Place};
use crate::graph::Node;
use crate::look;
use crate::mapping::{EmitterFields, ForceFields, SphereFields};
use crate::material::{self, Appearance};
use crate::parts::Parts;
use crate::placed::Placed;
use crate::pose::{mirrored, mirrored_rotation};
use crate::project::Project;
use crate::script::Script;
use crate::shape::{Mesh, of_collider, of_mesh};
use crate::value::Value;
use crate::walls::{Face, enclosed};

/// A scene during the import.
pub(crate) struct Building<'a> {
    pub scene: Scene,
    /// Places of parts in Unity's files, by their paths in the scene.
    pub places: BTreeMap<String, Place>,
    pub report: Vec<Omission>,
    pub project: &'a Project,
    /// Colliders in Unity's coordinates, in the order of the scene's colliders.
    placed: Vec<(Placed, Node)>,
    /// Forces of the first script that states some.
    forces: Option<Vec<Force>>,
    /// Mass of spheres whose script states none \[kg\].
    mass: Option<f64>,
    /// Looks of materials, by guid.
    looks: BTreeMap<String, Option<Appearance>>,
}

impl<'a> Building<'a> {
    /// Creates an empty scene.
    pub fn new(name: &str, project: &'a Project, report: Vec<Omission>) -> Self {
        Self {
            scene: Scene::new(name),
            places: BTreeMap::new(),
            report,
            project,
            placed: Vec::new(),
            forces: None,
            mass: None,
            looks: BTreeMap::new(),
        }
    }

    /// Adds the cameras, lights and scripts of an object.
    ///
    /// # Errors
    /// [`ImportError`] with the line of an invalid value.
    pub fn add(&mut self, node: &Node, parts: &Parts<'_>) -> Result<(), ImportError> {
        let Self { scene, report, places, .. } = self;
        if let Some(camera) = parts.camera
            && look::camera(camera, node, scene, report)?
        {
            places.insert("camera".to_owned(), camera.fields.place.clone());
        }
        if let Some(light) = parts.light
            && look::light(light, node, scene, report)?
        {
            places.insert("sun".to_owned(), light.fields.place.clone());
        }
        for script in &parts.scripts {
            self.add_script(script, node, parts)?;
        }
        parts.list_unread(node, &mut self.report);
        Ok(())
    }

    fn add_script(
        &mut self,
        script: &Script<'_>,
        node: &Node,
        parts: &Parts<'_>,
    ) -> Result<(), ImportError> {
        let kind = script.kind;
        if let Some(fields) = &kind.emitter {
            self.add_emitter(fields, script, node)?;
        }
        if let Some(fields) = &kind.sphere {
            self.add_sphere(fields, script, node, parts)?;
        }
        if let Some(fields) = &kind.collider {
            let restitution = script.number(&fields.restitution)?;
            self.add_scripted_collider(restitution, script, node, parts)?;
        }
        if let Some(fields) = &kind.properties {
            self.mass = self.mass.or(script.some_number(fields.mass.as_ref())?);
        }
        if let Some(fields) = &kind.forces {
            self.add_forces(fields, script, node)?;
        }
        Ok(())
    }

    fn add_emitter(
        &mut self,
        fields: &EmitterFields,
        script: &Script<'_>,
        node: &Node,
    ) -> Result<(), ImportError> {
        let max_spheres = script.some_number(fields.max_spheres.as_ref())?;
        let max_spheres = max_spheres.map(|number| match number as u32 {
            whole if f64::from(whole) == number && whole > 0 => Ok(whole),
            _ => Err(self.refusal(script, format!("max spheres cannot be {number}"))),
        });
        let mut sphere = Sphere::at([0.0; 3], 0.0);
        sphere.radius = None;
        sphere.diameter = Some(script.number(&fields.diameter)?);
        sphere.mass = script.some_number(fields.mass.as_ref())?;
        sphere.velocity =
            mirrored(script.some_vector(fields.velocity.as_ref())?.unwrap_or_default());
        let place = format!("emitters[{}]", self.scene.emitters.len());
        self.places.insert(place, script.document.fields.place.clone());
        self.scene.emitters.push(Emitter {
            name: plain_name(&node.name),
            position: mirrored(node.pose.position),
            rotation: mirrored_rotation(node.pose.rotation),
            period: script.number(&fields.period)?,
            max_spheres: max_spheres.transpose()?,
            count: None,
            needs_room: None,
            sphere,
        });
        Ok(())
    }

    fn add_sphere(
        &mut self,
        fields: &SphereFields,
        script: &Script<'_>,
        node: &Node,
        parts: &Parts<'_>,
    ) -> Result<(), ImportError> {
        let SphereFields { position, diameter, mass, velocity, restitution } = fields;
        let position = script.some_vector(position.as_ref())?.unwrap_or(node.pose.position);
        let diameter = script.some_number(diameter.as_ref())?;
        let mut sphere = Sphere::at(mirrored(position), 0.0);
        sphere.radius = None;
        sphere.diameter = Some(diameter.unwrap_or(node.pose.scale().max_element()));
        sphere.mass = script.some_number(mass.as_ref())?;
        sphere.velocity = mirrored(script.some_vector(velocity.as_ref())?.unwrap_or_default());
        sphere.restitution = script.some_number(restitution.as_ref())?.unwrap_or(1.0);
        let look = self.look(node, parts)?;
        (sphere.color, sphere.finish) = (look.color, look.finish);
        self.push_sphere(sphere, script.document);
        Ok(())
    }

    fn add_scripted_collider(
        &mut self,
        restitution: f64,
        script: &Script<'_>,
        node: &Node,
        parts: &Parts<'_>,
    ) -> Result<(), ImportError> {
        let component = format!("script \"{}\"", script.kind.name);
        let of_file = |it: &Document| of_mesh(it.fields.get("m_Mesh"), &node.pose, self.project);
        // In the course, the tag determines the form.
        let of_tag = match node.tag.as_str() {
            "SphereCollider" => Some(Mesh::Sphere),
            "PlaneCollider" => Some(Mesh::Plane),
            _ => None,
        };
        let placed = match (of_tag, parts.mesh.map(of_file), parts.colliders.first()) {
            (Some(mesh), ..) => Ok(mesh.placed(&node.pose)),
            (None, Some(Ok(placed)), _) => Ok(placed),
            (None, _, Some(collider)) => of_collider(collider, &node.pose, self.project)?,
            (None, Some(Err(reason)), None) => Err(reason),
            (None, None, None) => Err("it has no mesh that tells its form".to_owned()),
        };
        let placed = match placed {
            Ok(placed) => placed,
            Err(reason) => {
                omit(&mut self.report, &node.path, &component, reason);
                return Ok(());
            }
        };
        let mut collider = Collider::new(placed.shape.clone());
        // With -1, the course's formula does not change the velocity.
        collider.trigger = restitution == -1.0;
        if !collider.trigger {
            if !(0.0..=1.0).contains(&restitution) {
                let problem = format!("the restitution must be in [0, 1] or -1, not {restitution}");
                return Err(self.refusal(script, problem));
            }
            collider.restitution = restitution;
        }
        let look = self.look(node, parts)?;
        (collider.color, collider.finish, collider.visible) =
            (look.color, look.finish, look.visible);
        self.push_collider(collider, placed, node, script.document);
        Ok(())
    }

    fn add_forces(
        &mut self,
        fields: &ForceFields,
        script: &Script<'_>,
        node: &Node,
    ) -> Result<(), ImportError> {
        let constant = script.some_vector(fields.constant.as_ref())?;
        let gravity = script.some_vector(fields.gravity.as_ref())?;
        let drag = script.some_number(fields.viscous_drag.as_ref())?;
        let mut forces = Vec::new();
        forces.extend(constant.map(|it| Force::Constant { force: mirrored(it) }));
        forces.extend(gravity.map(|it| Force::Gravity { acceleration: mirrored(it) }));
        forces.extend(drag.map(|coefficient| Force::ViscousDrag { coefficient }));
        if forces.is_empty() {
            return Ok(());
        }
        match &self.forces {
            None => {
                for index in 0..forces.len() {
                    let place = script.document.fields.place.clone();
                    self.places.insert(format!("forces[{index}]"), place);
                }
                self.forces = Some(forces);
            }
            Some(first) if *first != forces => {
                let component = format!("script \"{}\"", script.kind.name);
                let reason = "its forces differ from those of a script before; forces act on every \
                              sphere of a scene";
                omit(&mut self.report, &node.path, &component, reason);
            }
            Some(_) => {}
        }
        Ok(())
    }

    /// Adds a sphere that `document` describes.
    pub fn push_sphere(&mut self, sphere: Sphere, document: &Document) {
        let place = format!("spheres[{}]", self.scene.spheres.len());
        self.places.insert(place, document.fields.place.clone());
        self.scene.spheres.push(sphere);
    }

    /// Adds a collider that `document` describes, with the shape and pose of `placed`.
    pub fn push_collider(
        &mut self,
        mut collider: Collider,
        placed: Placed,
        node: &Node,
        document: &Document,
    ) {
        if let Some(reason) = placed.inexact {
            omit(&mut self.report, &node.path, &document.class_name, reason);
        }
        collider.name = plain_name(&node.name);
        collider.position = mirrored(placed.position);
        if !matches!(collider.shape, Shape::Sphere { .. }) {
            collider.rotation = mirrored_rotation(placed.rotation);
        }
        let place = format!("colliders[{}]", self.scene.colliders.len());
        self.places.insert(place, document.fields.place.clone());
        self.scene.colliders.push(collider);
        self.placed.push((placed, node.clone()));
    }

    /// Appearance of an object, by its first material.
    pub fn look(&mut self, node: &Node, parts: &Parts<'_>) -> Result<Appearance, ImportError> {
        /// Start of the guids of files that come with Unity.
        const BUILT_IN: &str = "0000000000000000";
        let plain = |visible| Appearance { color: None, finish: Finish::default(), visible };
        let Some(renderer) = parts.renderer else { return Ok(plain(false)) };
        let enabled = renderer.fields.get("m_Enabled").and_then(Value::text) != Some("0");
        let materials = renderer.fields.get("m_Materials").map(Value::items).unwrap_or_default();
        if materials.len() > 1 {
            let reason = "the first of its materials is taken";
            omit(&mut self.report, &node.path, &renderer.class_name, reason);
        }
        let material = materials.first();
        let guid = material.and_then(Value::reference).and_then(|it| it.guid);
        let (Some(material), Some(guid)) = (material, guid) else { return Ok(plain(enabled)) };
        let look = match self.looks.get(&guid) {
            Some(look) => look.clone(),
            None => {
                let found = material::appearance(material, self.project)?;
                for reason in found.iter().flat_map(|it| &it.left_out) {
                    omit(&mut self.report, &node.path, "Material", *reason);
                }
                found.map(|it| it.look)
            }
        };
        if look.is_none() && !guid.starts_with(BUILT_IN) {
            let reason = "its material is not in the project, or has no colour";
            omit(&mut self.report, &node.path, &renderer.class_name, reason);
        }
        self.looks.insert(guid, look.clone());
        let look = look.unwrap_or_else(|| plain(true));
        Ok(Appearance { visible: enabled && look.visible, ..look })
    }

    /// Completes the scene: forces, masses, and planes that enclose a box.
    pub fn finish(&mut self) {
        self.scene.forces.extend(self.forces.take().into_iter().flatten());
        let emitted = self.scene.emitters.iter_mut().map(|emitter| &mut emitter.sphere);
        for sphere in emitted.chain(&mut self.scene.spheres) {
            sphere.mass = sphere.mass.or(self.mass);
        }
        self.merge_boxes();
    }

    fn merge_boxes(&mut self) {
        let mut groups: BTreeMap<i64, Vec<usize>> = BTreeMap::new();
        for (index, (placed, node)) in self.placed.iter().enumerate() {
            if matches!(placed.shape, Shape::Rectangle { .. }) {
                groups.entry(node.parent).or_default().push(index);
            }
        }
        let mut absorbed = Vec::new();
        for group in groups.into_values() {
            let Ok(group) = <[usize; 6]>::try_from(group) else { continue };
            let node = &self.placed[group[0]].1;
            let faces = group.map(|index| {
                let Placed { position, rotation, .. } = self.placed[index].0;
                Face { collider: &self.scene.colliders[index], position, rotation }
            });
            let frame = node.parent_rotation;
            let Some((center, size)) = enclosed(&faces, frame) else { continue };
            let name = box_name(&node.path);
            let collider = &mut self.scene.colliders[group[0]];
            collider.name = name;
            collider.shape = Shape::Box { size: carom_scene::import::shortened(size.to_array()) };
            collider.position = mirrored(center);
            collider.rotation = mirrored_rotation(frame);
            absorbed.extend(&group[1..]);
        }
        absorbed.sort_unstable();
        let mut index = 0;
        let mut places = Vec::new();
        self.scene.colliders.retain(|_| {
            let keep = absorbed.binary_search(&index).is_err();
            if keep {
                places.push(self.places.get(&format!("colliders[{index}]")).cloned());
            }
            index += 1;
            keep
        });
        for (index, place) in places.into_iter().enumerate() {
            self.places.extend(place.map(|place| (format!("colliders[{index}]"), place)));
        }
    }

    fn refusal(&self, script: &Script<'_>, problem: String) -> ImportError {
        script.document.fields.place.malformed(problem)
    }
}

/// Name of a box: the names of its two nearest ancestors, because boxes made of planes are often
/// scaled by a parent.
fn box_name(path: &str) -> String {
    let mut names: Vec<&str> = path.rsplit('/').skip(1).take(2).collect();
    names.reverse();
    if names.is_empty() { "box".to_owned() } else { plain_name(&names.join("/")) }
}
