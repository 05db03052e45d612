//! Parts of a scene other than its spheres, as edited.

use carom::{ColliderId, EmitterId, ForceId, World};
use carom_scene::scene::{Collider, Emitter, Force, Scene, Simulation, Sphere};

/// Parts of a scene other than its spheres, as edited: everything that a world does not store
/// (names, kinds of force, colours), under the ids of the world.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Setup {
    /// Settings of the simulation.
    pub simulation: Simulation,
    /// Forces, in the order in which they are summed.
    pub forces: Vec<(ForceId, Force)>,
    /// Colliders in their order, with their poses as opened or last edited; the world has the present ones.
    pub colliders: Vec<(ColliderId, Collider)>,
    /// Emitters, in the order in which they emit.
    pub emitters: Vec<(EmitterId, Emitter)>,
}

impl Setup {
    /// Creates the setup of a scene and its world.
    pub fn new(scene: &Scene, world: &World) -> Self {
        let forces = world.forces().map(|(id, _)| id).zip(scene.forces.iter().cloned());
        let all = scene.all_colliders();
        let colliders = world.colliders().map(|(id, _)| id).zip(all.iter().cloned());
        let emitters = world.emitters().map(|(id, _)| id).zip(scene.emitters.iter().cloned());
        Self {
            simulation: scene.simulation.clone(),
            forces: forces.collect(),
            colliders: colliders.collect(),
            emitters: emitters.collect(),
        }
    }

    /// Returns the scene `opened` with this setup, without spheres and springs.
    pub fn scene(&self, opened: &Scene) -> Scene {
        Scene {
            simulation: self.simulation.clone(),
            forces: self.forces.iter().map(|(_, force)| force.clone()).collect(),
            spheres: Vec::new(),
            generators: Vec::new(),
            springs: Vec::new(),
            colliders: self.colliders.iter().map(|(_, collider)| collider.clone()).collect(),
            emitters: self.emitters.iter().map(|(_, emitter)| emitter.clone()).collect(),
            ..opened.clone()
        }
    }
}

/// Writes the properties of a sphere into its description.
pub(crate) fn describe_sphere(sphere: &carom::Sphere, description: &mut Sphere) {
    *description = Sphere::of(sphere).painted((&*description).into());
}

/// Writes the properties of an emitter into its description.
pub(crate) fn describe_emitter(emitter: &carom::Emitter, description: &mut Emitter) {
    describe_sphere(&emitter.sphere, &mut description.sphere);
    description.position = emitter.position.to_array();
    description.rotation = emitter.rotation.to_array();
    description.period = emitter.period;
    description.max_spheres = emitter.max_spheres;
    description.count = emitter.count;
    description.needs_room = emitter.needs_room;
}

/// Returns the name of a collider without the numbers that generators add: "peg" for "peg 3-12".
/// Colliders of the same group name are changed together.
pub fn group_name(name: &str) -> &str {
    let is_number = |text: &str| {
        let mut parts = text.split('-');
        parts.all(|it| !it.is_empty() && it.bytes().all(|byte| byte.is_ascii_digit()))
    };
    match name.rsplit_once(' ') {
        Some((group, number)) if !group.is_empty() && is_number(number) => group,
        _ => name,
    }
}
