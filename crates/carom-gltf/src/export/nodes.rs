//! Nodes of a file: colliders, camera, light and balls, with their meshes and materials.

use carom::{Collider, DQuat, DVec3, Shape, Sides, Sphere, World};
use carom_scene::outline::{half_lengths, is_round};
use carom_scene::scene::Scene;
use carom_scene::{Coat, Palette};

use super::arrays::Arrays;
use super::bodies::{Bodies, place_of};
use super::geometry::{Form, Geometry};
use super::look;
use super::tracks::Placement;
use crate::document::{Camera, Document, LightReference, Lights, Mesh, Node, NodeExtensions};

/// Properties by which meshes are shared.
#[derive(Debug, Clone, PartialEq)]
struct MeshKey {
    form: Form,
    coat: Coat,
}

/// The document of a file during the recording.
pub(super) struct Nodes {
    pub document: Document,
    pub bodies: Bodies,
    geometry: Geometry,
    /// Keys of the document's meshes.
    meshes: Vec<MeshKey>,
    /// Extent of the scene from the origin \[m\]; half-spaces are drawn larger than that.
    extent: f64,
}

impl Nodes {
    /// Creates the nodes of camera and light.
    pub fn new(scene: &Scene, world: &World) -> Self {
        let mut nodes = Self {
            document: Document::default(),
            bodies: Bodies::new(scene),
            geometry: Geometry::default(),
            meshes: Vec::new(),
            extent: extent(world),
        };
        if let Some(camera) = &scene.camera {
            let (position, rotation) = (camera.position, DQuat::from_array(camera.rotation));
            nodes.document.cameras.push(look::camera(camera) as Camera);
            nodes.push(Node {
                camera: Some(0),
                ..placed("camera", DVec3::from_array(position), rotation, [1.0; 3])
            });
        }
        let sun = look::sun(scene);
        nodes.document.extensions.lights = Some(Lights { lights: vec![look::light(&sun)] });
        let rotation = DQuat::from_array(sun.rotation);
        let extensions =
            NodeExtensions { light: Some(LightReference { light: 0 }), ..Default::default() };
        nodes.push(Node { extensions, ..placed("sun", DVec3::ZERO, rotation, [1.0; 3]) });
        nodes
    }

    /// Adds the node of a collider, with the walls of a container as children. Returns its index.
    pub fn push_collider(
        &mut self,
        name: &str,
        collider: &Collider,
        coat: Option<Coat>,
        arrays: &mut Arrays,
    ) -> usize {
        let place = self.collider_place(collider);
        let form = match &collider.shape {
            Shape::Sphere { .. } => Form::Sphere,
            Shape::Box { .. } => Form::Cube,
            Shape::Container { open, .. } => Form::Walls { open: *open },
            shape if is_round(shape) => Form::Round { shape: shape.clone() },
            _ => Form::Square,
        };
        let body = self.bodies.collider(collider);
        let walls = match collider.shape {
            Shape::Container { open, .. } => self.push_walls(collider, open),
            _ => Vec::new(),
        };
        let mesh = coat.and_then(|coat| self.mesh(MeshKey { form, coat }, arrays));
        let extensions = NodeExtensions { body, ..Default::default() };
        let Placement { position, rotation, scale } = place;
        let node = placed(name, position, rotation, scale);
        self.push(Node { children: walls, mesh, extensions, ..node })
    }

    /// Adds the node of a collider that appears later, with scale 0. Returns its index.
    pub fn push_later_collider(
        &mut self,
        name: &str,
        collider: &Collider,
        coat: Coat,
        arrays: &mut Arrays,
    ) -> usize {
        let node = self.push_collider(name, collider, Some(coat), arrays);
        self.document.nodes[node].scale = Some([0.0; 3]);
        node
    }

    /// Placement of the node of a collider, whose mesh has size 1.
    pub fn collider_place(&self, collider: &Collider) -> Placement {
        let scale = match collider.shape {
            Shape::Sphere { radius } => [radius; 3],
            Shape::Rectangle { size_x, size_z } => [size_x, 1.0, size_z],
            Shape::Box { size } | Shape::Container { size, .. } => size.to_array(),
            ref shape if is_round(shape) => [1.0; 3],
            _ => [8.0 * self.extent, 1.0, 8.0 * self.extent],
        };
        let (position, rotation) = (collider.pose.position, collider.pose.rotation.normalize());
        Placement { position, rotation, scale }
    }

    /// Adds the node of a ball: `is_there` at the start, `banded` to make its rotation visible.
    /// Returns its index.
    pub fn push_ball(
        &mut self,
        number: u64,
        sphere: &Sphere,
        look: (Coat, bool),
        is_there: bool,
        arrays: &mut Arrays,
    ) -> usize {
        let (coat, banded) = look;
        let form = if banded { Form::BandedSphere } else { Form::Sphere };
        let mesh = self.mesh(MeshKey { form, coat }, arrays);
        // A ball that appears later has no body.
        let body = is_there.then(|| self.bodies.sphere(sphere));
        let radius = if is_there { sphere.radius } else { 0.0 };
        let rotation = sphere.orientation.normalize();
        let node = placed(&format!("ball {number}"), sphere.position, rotation, [radius; 3]);
        let extensions = NodeExtensions { body, ..Default::default() };
        self.push(Node { mesh, extensions, ..node })
    }

    /// Adds the walls of a container, each in the coordinates of a box of size 1.
    fn push_walls(&mut self, container: &Collider, open: Sides) -> Vec<usize> {
        let is_open = open.to_array();
        let names = ["left", "right", "bottom", "top", "back", "front"];
        let outward = [DVec3::NEG_X, DVec3::X, DVec3::NEG_Y, DVec3::Y, DVec3::NEG_Z, DVec3::Z];
        let closed = (0..6).filter(|&side| !is_open[side]);
        let walls: Vec<Node> = closed
            .map(|side| {
                let inward = DQuat::from_rotation_arc(DVec3::Y, -outward[side]);
                let body = Some(self.bodies.wall(container));
                let extensions = NodeExtensions { body, ..Default::default() };
                Node { extensions, ..placed(names[side], 0.5 * outward[side], inward, [1.0; 3]) }
            })
            .collect();
        walls
            .into_iter()
            .map(|wall| {
                self.document.nodes.push(wall);
                self.document.nodes.len() - 1
            })
            .collect()
    }

    /// Index of the mesh of a form in a coat; `None` if it has no triangles.
    fn mesh(&mut self, key: MeshKey, arrays: &mut Arrays) -> Option<usize> {
        if let Some(known) = self.meshes.iter().position(|it| *it == key) {
            return Some(known);
        }
        let double_sided = matches!(key.form, Form::Square | Form::Round { .. });
        let mut primitives = self.geometry.triangles(&key.form, arrays);
        for (i, primitive) in primitives.iter_mut().enumerate() {
            let material = look::material(key.coat, double_sided, i == 1);
            primitive.material = Some(place_of(&mut self.document.materials, material));
        }
        if primitives.is_empty() {
            return None;
        }
        self.meshes.push(key);
        self.document.meshes.push(Mesh { name: String::new(), primitives });
        Some(self.meshes.len() - 1)
    }

    /// Adds a node without a parent; returns its index.
    fn push(&mut self, node: Node) -> usize {
        if self.document.scenes.is_empty() {
            self.document.scenes.push(Default::default());
            self.document.scene = Some(0);
        }
        let index = self.document.nodes.len();
        self.document.nodes.push(node);
        self.document.scenes[0].nodes.push(index);
        index
    }
}

/// Coat of a sphere of a world.
pub(super) fn coat_of(palette: &Palette, number: u64, sphere: &Sphere) -> Coat {
    palette.sphere(number, sphere.radius, sphere.kilograms())
}

fn placed(name: &str, position: DVec3, rotation: DQuat, scale: [f64; 3]) -> Node {
    let rotation = rotation.normalize();
    Node {
        name: name.to_owned(),
        translation: (position != DVec3::ZERO).then_some(position.to_array()),
        rotation: (rotation != DQuat::IDENTITY).then_some(rotation.to_array()),
        scale: (scale != [1.0; 3]).then_some(scale),
        ..Node::default()
    }
}

/// Largest distance of spheres and finite colliders from the origin \[m\]; at least 1.
fn extent(world: &World) -> f64 {
    let spheres = world.spheres();
    let balls = spheres.positions().iter().zip(spheres.radii());
    let balls = balls.map(|(position, radius)| position.length() + radius);
    let colliders = world.colliders().map(|(_, collider)| {
        let half = match collider.shape {
            Shape::Sphere { radius } => radius,
            Shape::Rectangle { size_x, size_z } => DVec3::new(size_x, 0.0, size_z).length() / 2.0,
            Shape::Box { size } | Shape::Container { size, .. } => size.length() / 2.0,
            ref shape => half_lengths(shape).map_or(0.0, |half| half.length()),
        };
        collider.pose.position.length() + half
    });
    balls.chain(colliders).fold(1.0, f64::max)
}
