//! What persists from step to step.

use std::sync::{Arc, OnceLock};

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::collider::{Collider, ColliderId};
use crate::detect::contacts::Instant;
use crate::emitter::{EmitterId, EmitterState};
use crate::error::{Error, Subject};
use crate::forces::Force;
use crate::settings::Settings;
use crate::surface::{self, Surface, SurfaceTree};
use crate::system::System;

/// Everything a world's future depends on.
#[derive(Debug, Clone, Default)]
pub(crate) struct State {
    pub settings: Settings,
    pub forces: Vec<Arc<dyn Force>>,
    pub colliders: Colliders,
    pub emitters: Vec<EmitterState>,
    pub clock: Clock,
    pub spheres: Spheres,
    /// The id of the next sphere.
    pub next_id: u64,
}

impl State {
    /// What a step reads, and what it moves.
    pub fn split(&mut self) -> (System<'_>, &mut Motion) {
        let Self { settings, forces, colliders, spheres, .. } = self;
        let Spheres { properties, motion } = spheres;
        (System::new((settings, forces), colliders, properties), motion)
    }

    /// All spheres as they are now.
    pub fn now(&self) -> Instant<'_> {
        let properties = &self.spheres.properties;
        let system = System::new((&self.settings, &self.forces), &self.colliders, properties);
        Instant { system, motion: &self.spheres.motion, time: self.clock.seconds() }
    }

    /// Refuses positions or velocities that are not finite.
    pub fn check_finite(&self) -> Result<(), Error> {
        let quantities =
            [("velocity", self.spheres.velocities()), ("position", self.spheres.positions())];
        for (quantity, values) in quantities {
            if let Some(index) = values.iter().position(|value| !value.is_finite()) {
                let sphere = self.spheres.ids()[index];
                return Err(Error::NonFiniteState { sphere, quantity, time: self.clock.seconds() });
            }
        }
        Ok(())
    }

    /// Refuses emitters that would have too many spheres due in the next frame.
    pub fn check_emitters(&self) -> Result<(), Error> {
        for (index, emitter) in self.emitters.iter().enumerate() {
            let subject = Subject::Emitter(EmitterId(index));
            emitter.validate_at(self.clock.seconds()).map_err(|invalid| invalid.about(subject))?;
        }
        Ok(())
    }
}

/// Colliders, and what follows from them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Colliders {
    list: Vec<Collider>,
    surfaces: Vec<Surface>,
    /// Made when first asked for after a change.
    tree: OnceLock<SurfaceTree>,
}

impl Colliders {
    pub fn list(&self) -> &[Collider] {
        &self.list
    }

    /// The surfaces of all colliders, in their order.
    pub fn surfaces(&self) -> &[Surface] {
        &self.surfaces
    }

    /// Finds surfaces, by their index in [`Self::surfaces`].
    pub fn tree(&self) -> &SurfaceTree {
        self.tree.get_or_init(|| SurfaceTree::new(&self.surfaces))
    }

    pub fn push(&mut self, collider: Collider) {
        surface::place(ColliderId(self.list.len()), &collider, &mut self.surfaces);
        self.list.push(collider);
        self.tree.take();
    }

    pub fn set(&mut self, index: usize, collider: Collider) {
        self.list[index] = collider;
        self.surfaces.clear();
        for (index, collider) in self.list.iter().enumerate() {
            surface::place(ColliderId(index), collider, &mut self.surfaces);
        }
        self.tree.take();
    }
}
