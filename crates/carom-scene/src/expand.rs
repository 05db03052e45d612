//! Generators written out.

use crate::error::SceneError;
use crate::scene::Scene;

impl Scene {
    /// The scene with every sphere and collider of its generators written out.
    ///
    /// # Errors
    /// As [`Scene::world`].
    pub fn expanded(&self) -> Result<Self, SceneError> {
        // Random fillings keep clear of colliders and of the spheres before them.
        let colliders = self.all_colliders().into_owned();
        let mut scene = Self { generators: Vec::new(), colliders, ..self.clone() };
        scene.simulation.allow_overlap = true;
        // They may join spheres that are still to be written out.
        let springs = std::mem::take(&mut scene.springs);
        for (i, generator) in self.generators.iter().enumerate() {
            let path = format!("generators[{i}].{}", generator.kind());
            let spheres = generator.spheres(&scene.world()?, &path);
            scene.spheres.extend(spheres.map_err(|problem| problem.in_code(&self.name))?);
        }
        scene.springs = springs;
        scene.simulation.allow_overlap = self.simulation.allow_overlap;
        Ok(scene)
    }
}
