//! What a scene says besides its spheres, as changed since it was opened.

use carom::{ColliderId, EmitterId, ForceId, World};
use carom_scene::scene::{Collider, Emitter, Force, Scene, Simulation, Sphere};

/// What a scene says besides its spheres, as changed since it was opened: what a world does not
/// know (names, kinds of force, colours), under the ids by which the world knows it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Setup {
    /// How the scene is stepped.
    pub simulation: Simulation,
    /// In the order in which they are added up.
    pub forces: Vec<(ForceId, Force)>,
    /// In their order, each where it was when the scene was opened; the world knows where it is.
    pub colliders: Vec<(ColliderId, Collider)>,
    /// In the order in which they emit.
    pub emitters: Vec<(EmitterId, Emitter)>,
}

impl Setup {
    /// Of a scene and the world that was made of it.
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

    /// The scene `opened`, changed to this, without any sphere or spring.
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

/// Writes into a description of spheres what the physics calls them.
pub(crate) fn describe_sphere(sphere: &carom::Sphere, description: &mut Sphere) {
    *description = Sphere::of(sphere).painted((&*description).into());
}

/// Writes into the description of an emitter what the physics calls it.
pub(crate) fn describe_emitter(emitter: &carom::Emitter, description: &mut Emitter) {
    describe_sphere(&emitter.sphere, &mut description.sphere);
    description.position = emitter.position.to_array();
    description.rotation = emitter.rotation.to_array();
    description.period = emitter.period;
    description.max_spheres = emitter.max_spheres;
    description.count = emitter.count;
    description.needs_room = emitter.needs_room;
}
