//! Imports bodies of `KHR_physics_rigid_bodies`.

use std::collections::BTreeSet;

use carom::{DVec3, SOLID_BALL};
use carom_scene::import::omit;
use carom_scene::scene::{self, CombineRule, Force, Sphere};

use super::appearance::Appearance;
use super::building::Building;
use super::error::Malformed;
use super::form::Form;
use super::graph::Placed;
use super::meshes::Meshes;
use super::pose::written;
use super::solid::Solid;
use crate::document::Document;
use crate::rigid_body::{Collider, Combine, Motion, NodeBody, PhysicsMaterial};

/// Bodies of a scene.
pub(super) struct Bodies<'a> {
    document: &'a Document,
    nodes: &'a [Placed],
    /// For each node, the node of its body: itself, or the nearest ancestor that moves.
    owners: Vec<Option<usize>>,
    /// Mesh of each node: its own, or that of an ancestor in its body.
    shown: Vec<Option<usize>>,
    /// Nodes that have colliders, or descendants with colliders.
    with_colliders: BTreeSet<usize>,
    /// Nodes of bodies whose sphere was added to the scene.
    added: BTreeSet<usize>,
    /// Combine modes of friction and restitution of all added colliders.
    combine: BTreeSet<(Combine, Combine)>,
    /// Different factors of gravity.
    gravity_factors: Vec<f64>,
}

impl<'a> Bodies<'a> {
    /// Creates the bodies of a scene, none of them added yet.
    pub fn new(document: &'a Document, nodes: &'a [Placed]) -> Self {
        let mut bodies = Self {
            document,
            nodes,
            owners: Vec::new(),
            shown: Vec::new(),
            with_colliders: BTreeSet::new(),
            added: BTreeSet::new(),
            combine: BTreeSet::new(),
            gravity_factors: Vec::new(),
        };
        for (i, node) in nodes.iter().enumerate() {
            let body = bodies.body(node);
            let moves = body.is_some_and(|body| body.motion.is_some());
            let has_collider = body.is_some_and(|it| it.collider.is_some() || it.trigger.is_some());
            let above = node.parent.and_then(|parent| bodies.owners[parent]);
            bodies.owners.push(if moves { Some(i) } else { above });
            let is_part = |parent: &usize| bodies.owners[*parent] == bodies.owners[i];
            let inherited = node.parent.filter(is_part).and_then(|parent| bodies.shown[parent]);
            bodies.shown.push(document.nodes[node.index].mesh.or(inherited));
            let mut marked = has_collider.then_some(i);
            while let Some(node) = marked.filter(|&it| bodies.with_colliders.insert(it)) {
                marked = nodes[node].parent;
            }
        }
        bodies
    }

    /// Whether a node belongs to a body, or has colliders or descendants with colliders.
    pub fn has(&self, node: usize) -> bool {
        self.owners[node].is_some() || self.with_colliders.contains(&node)
    }

    fn body(&self, node: &Placed) -> Option<&'a NodeBody> {
        self.document.nodes[node.index].extensions.body.as_deref()
    }

    /// Adds a node as a moving sphere, or as colliders.
    ///
    /// # Errors
    /// [`Malformed`] if the file is invalid.
    pub fn add(
        &mut self,
        index: usize,
        meshes: &mut Meshes<'_>,
        building: &mut Building,
    ) -> Result<(), Malformed> {
        let node = &self.nodes[index];
        let Some(body) = self.body(node) else { return Ok(()) };
        if body.joint.is_some() {
            omit(&mut building.report, &node.path, "joint", "has no counterpart");
        }
        if body.motion.is_some() && !self.with_colliders.contains(&index) {
            omit(&mut building.report, &node.path, "motion", "it has no collider");
        }
        let described = [(&body.collider, "collider", false), (&body.trigger, "trigger", true)];
        for (collider, component, is_trigger) in described {
            let Some(collider) = collider else { continue };
            if collider.collision_filter.is_some() {
                let reason = "its collision filter has no counterpart: it meets all bodies";
                omit(&mut building.report, &node.path, component, reason);
            }
            let (form, double_sided) = match self.form(collider, node, meshes)? {
                Ok(form) => form,
                Err(reason) => {
                    omit(&mut building.report, &node.path, component, reason);
                    continue;
                }
            };
            let solid = match Solid::of(&form, &node.pose) {
                Ok(solid) => solid,
                Err(reason) => {
                    omit(&mut building.report, &node.path, component, reason);
                    continue;
                }
            };
            if let Some(reason) = solid.inexact {
                omit(&mut building.report, &node.path, component, reason);
            }
            let material = self.material(collider, node, building)?;
            if !is_trigger {
                self.combine.insert((material.restitution_combine, material.friction_combine));
            }
            let look = self.look(index)?;
            let part = Part { solid, double_sided, is_trigger, material, look };
            match self.owners[index] {
                Some(owner) if !self.is_kinematic(owner) => {
                    self.add_moving(index, owner, &part, building);
                }
                owner => self.add_fixed(index, owner, part, building),
            }
        }
        Ok(())
    }

    /// Whether the motion of a body is not affected by collisions.
    fn is_kinematic(&self, owner: usize) -> bool {
        self.motion(owner).is_kinematic || self.motion(owner).mass == Some(0.0)
    }

    fn motion(&self, owner: usize) -> Motion {
        self.body(&self.nodes[owner]).and_then(|body| body.motion.clone()).unwrap_or_default()
    }

    fn add_moving(&mut self, index: usize, owner: usize, part: &Part, building: &mut Building) {
        let (node, moving) = (&self.nodes[index], &self.nodes[owner]);
        let mut list = |component: &str, reason: &str| {
            omit(&mut building.report, &node.path, component, reason);
        };
        let scene::Shape::Sphere { radius } = part.solid.shape else {
            return list("collider", "only spheres move");
        };
        if part.is_trigger {
            return list("trigger", "moves with a body; triggers that move so have no counterpart");
        }
        if !self.added.insert(owner) {
            return list("collider", "a body of several colliders moves as its first sphere");
        }
        let motion = self.motion(owner);
        let world = |local: Option<[f64; 3]>| match local {
            Some(local) => {
                (moving.pose.rotation * DVec3::from_array(local.map(written))).to_array()
            }
            None => [0.0; 3],
        };
        let mut sphere = Sphere::at(part.solid.position, radius);
        sphere.velocity = world(motion.linear_velocity);
        sphere.angular_velocity = world(motion.angular_velocity);
        sphere.orientation = part.solid.rotation;
        sphere.mass = motion.mass.map(written);
        sphere.restitution = part.material.restitution;
        sphere.friction = Some(part.material.dynamic_friction);
        (sphere.color, sphere.finish) = (part.look.color, part.look.finish);
        if let Some(inertia) = motion.inertia_diagonal {
            match inertia_factor(inertia, motion.mass.unwrap_or(1.0), radius) {
                Some(factor) => sphere.inertia_factor = factor,
                None => list("motion", "its inertia is not that of a ball; that of one is taken"),
            }
        }
        if motion.center_of_mass.is_some_and(|it| it != [0.0; 3]) {
            list("motion", "its centre of mass is not in the middle; here it is");
        }
        let factor = motion.gravity_factor.unwrap_or(1.0);
        if !self.gravity_factors.contains(&factor) {
            self.gravity_factors.push(factor);
        }
        building.push_sphere(sphere, node);
    }

    fn add_fixed(&self, index: usize, owner: Option<usize>, part: Part, building: &mut Building) {
        let node = &self.nodes[index];
        let Part { solid, double_sided, is_trigger, material, look } = part;
        let mut collider = scene::Collider::new(solid.shape.clone());
        (collider.position, collider.rotation) = (solid.position, solid.rotation);
        (collider.color, collider.finish) = (look.color, look.finish);
        // Colliders without a mesh are not drawn.
        collider.visible = self.mesh(index).is_some();
        collider.trigger = is_trigger;
        if !is_trigger {
            collider.restitution = material.restitution;
            collider.friction = Some(material.dynamic_friction);
        }
        if let Some(owner) = owner {
            let (motion, moving) = (self.motion(owner), &self.nodes[owner]);
            let world = |local: Option<[f64; 3]>| {
                moving.pose.rotation * DVec3::from_array(local.unwrap_or_default().map(written))
            };
            collider.velocity = world(motion.linear_velocity).to_array();
            collider.angular_velocity = world(motion.angular_velocity).to_array();
            let turns = collider.angular_velocity != [0.0; 3];
            if turns && moving.pose.position != node.pose.position {
                let reason = "turns about a point beside it; here it turns about its own centre";
                omit(&mut building.report, &node.path, "motion", reason);
            }
        }
        if double_sided && matches!(solid.shape, scene::Shape::Rectangle { .. }) {
            let mut back = collider.clone();
            back.rotation = solid.back().rotation;
            back.visible = false;
            building.push_collider(back, node);
        }
        building.push_collider(collider, node);
    }

    /// Form of a collider, and whether both of its sides are solid.
    fn form(
        &self,
        collider: &Collider,
        node: &Placed,
        meshes: &mut Meshes<'_>,
    ) -> Result<Result<(Form, bool), &'static str>, Malformed> {
        let geometry = collider.geometry.clone().unwrap_or_default();
        if let Some(index) = geometry.shape.or(collider.shape) {
            let shapes = self.document.extensions.shapes.as_ref();
            let place = format!("extensions.KHR_implicit_shapes.shapes[{index}]");
            let shape = shapes.and_then(|it| it.shapes.get(index));
            return Ok(shape_form(shape.ok_or_else(|| Malformed::at(place, "is not there"))?));
        }
        let mesh = match (geometry.mesh, geometry.node) {
            (Some(mesh), _) => Some(mesh),
            (None, Some(index)) => {
                let place = format!("nodes[{index}]");
                let of = self.document.nodes.get(index);
                of.ok_or_else(|| Malformed::at(place, "is not there"))?.mesh
            }
            (None, None) => None,
        };
        match mesh {
            Some(mesh) => Ok(meshes.form(mesh)?.map(|form| (form, false))),
            None if !collider.nodes.is_empty() => {
                Ok(Err("is put together of its nodes; each of them is a trigger of its own here"))
            }
            None => Err(Malformed::at(node.place(), "has a collider without geometry")),
        }
    }

    fn material(
        &self,
        collider: &Collider,
        node: &Placed,
        building: &mut Building,
    ) -> Result<PhysicsMaterial, Malformed> {
        let material = match collider.physics_material {
            None => PhysicsMaterial::default(),
            Some(index) => {
                let materials = self.document.extensions.bodies.as_ref();
                let material = materials.and_then(|it| it.physics_materials.get(index));
                let missing = || Malformed::at(node.place(), "its physicsMaterial is not there");
                material.cloned().ok_or_else(missing)?
            }
        };
        if material.static_friction != material.dynamic_friction {
            let reason = "its friction at rest differs; that of sliding is taken";
            omit(&mut building.report, &node.path, "physics material", reason);
        }
        Ok(material)
    }

    /// Mesh of a collider: that of its node, of an ancestor in its body, or of a child.
    fn mesh(&self, index: usize) -> Option<usize> {
        let below = || {
            let children = &self.document.nodes[self.nodes[index].index].children;
            children.iter().find_map(|&child| self.document.nodes.get(child)?.mesh)
        };
        self.shown[index].or_else(below)
    }

    fn look(&self, index: usize) -> Result<Appearance, Malformed> {
        self.mesh(index)
            .map_or(Ok(Appearance::default()), |mesh| Appearance::of(self.document, mesh))
    }

    /// Sets gravity and combine rules, which hold for the whole scene.
    pub fn finish(self, building: &mut Building) {
        /// \[m/s²\]
        const GRAVITY: f64 = 9.81;
        let file = building.scene.name.clone();
        let has_balls = !building.scene.spheres.is_empty();
        let factor = self.gravity_factors.first().copied().unwrap_or(1.0);
        if has_balls && factor != 0.0 {
            let acceleration = [0.0, -GRAVITY * factor, 0.0];
            building.scene.forces.push(Force::Gravity { acceleration });
        }
        if self.gravity_factors.len() > 1 {
            let reason = "bodies have several; here the first acts on every sphere";
            omit(&mut building.report, &file, "gravityFactor", reason);
        }
        let simulation = &mut building.scene.simulation;
        if let Some(first) = self.combine.iter().map(|it| it.0).min() {
            simulation.combine_rule = combine_rule(first);
        }
        if let Some(first) = self.combine.iter().map(|it| it.1).min() {
            simulation.friction_combine_rule = combine_rule(first);
        }
        if self.combine.len() > 1 {
            let reason = "materials combine in several ways; the scene takes the first of average, \
                          minimum, maximum, multiply for all";
            omit(&mut building.report, &file, "physics materials", reason);
        }
        let has_joints = |it: &crate::rigid_body::RigidBodies| !it.physics_joints.is_empty();
        if self.document.extensions.bodies.as_ref().is_some_and(has_joints) {
            omit(&mut building.report, &file, "physicsJoints", "have no counterpart");
        }
    }
}

/// Properties of a collider in the file.
struct Part {
    solid: Solid,
    double_sided: bool,
    is_trigger: bool,
    material: PhysicsMaterial,
    look: Appearance,
}

fn shape_form(shape: &crate::rigid_body::Shape) -> Result<(Form, bool), &'static str> {
    let (center, rotation) = (DVec3::ZERO, carom::DQuat::IDENTITY);
    match shape.kind.as_str() {
        "sphere" => {
            let radius = written(shape.sphere.clone().unwrap_or_default().radius);
            Ok((Form::Sphere { center, radius }, false))
        }
        "box" => {
            let size = shape.solid_box.clone().unwrap_or_default().size;
            let size = DVec3::from_array(size.map(written));
            Ok((Form::Box { center, rotation, size }, false))
        }
        "plane" => {
            let plane = shape.plane.clone().unwrap_or_default();
            match (plane.size_x, plane.size_z) {
                (Some(x), Some(z)) => {
                    let size = [written(x), written(z)];
                    Ok((Form::Rectangle { center, rotation, size }, plane.double_sided))
                }
                (None, None) if plane.double_sided => Err("a plane without end has one side here"),
                (None, None) => Ok((Form::HalfSpace, false)),
                _ => Err("a plane that has an end one way only has no counterpart"),
            }
        }
        "capsule" => Err("a capsule has no counterpart"),
        "cylinder" => Err("a cylinder has no counterpart"),
        _ => Err("its shape is not known"),
    }
}

/// Moment of inertia of a ball divided by m r²; `None` if it differs between axes.
fn inertia_factor([x, y, z]: [f64; 3], mass: f64, radius: f64) -> Option<f64> {
    // Rounding error of 32-bit numbers, which other programs write.
    const EQUAL: f64 = 1e-6;
    let equals = |a: f64, b: f64| (a - b).abs() <= EQUAL * a.abs();
    let factor = x / (mass * radius * radius);
    let is_ball = equals(x, y) && equals(x, z) && factor.is_finite() && factor > 0.0;
    is_ball.then_some(if equals(factor, SOLID_BALL) { SOLID_BALL } else { factor })
}

fn combine_rule(combine: Combine) -> CombineRule {
    match combine {
        Combine::Average => CombineRule::Average,
        Combine::Minimum => CombineRule::Minimum,
        Combine::Maximum => CombineRule::Maximum,
        Combine::Multiply => CombineRule::Product,
    }
}
