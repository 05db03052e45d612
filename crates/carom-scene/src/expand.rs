//! Replaces generators by their spheres and colliders.

use crate::error::SceneError;
use crate::materials::MaterialNumbers;
use crate::scene::Scene;

impl Scene {
    /// Returns the scene with each generator replaced by the spheres and colliders that it creates.
    ///
    /// # Errors
    /// The same as those of [`Scene::world`].
    pub fn expanded(&self) -> Result<Self, SceneError> {
        // Random fillings keep clear of the colliders and of the spheres added so far.
        let colliders = self.all_colliders().into_owned();
        let mut scene = Self { generators: Vec::new(), colliders, ..self.clone() };
        scene.simulation.allow_overlap = true;
        // Springs may refer to spheres that are not yet added.
        let springs = std::mem::take(&mut scene.springs);
        let materials = MaterialNumbers::of(self);
        for (i, generator) in self.generators.iter().enumerate() {
            let path = format!("generators[{i}].{}", generator.kind());
            let spheres = generator.spheres(&scene.world()?, &path, &materials);
            scene.spheres.extend(spheres.map_err(|problem| problem.in_code(&self.name))?);
        }
        scene.springs = springs;
        scene.simulation.allow_overlap = self.simulation.allow_overlap;
        Ok(scene)
    }
}
