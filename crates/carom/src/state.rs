//! What persists from step to step.

use std::sync::Arc;

use crate::bodies::{Motion, Spheres};
use crate::clock::Clock;
use crate::colliders::Colliders;
use crate::detect::instant::Instant;
use crate::emitter::{EmitterId, EmitterState};
use crate::error::{Error, Subject};
use crate::forces::Force;
use crate::numbered::Numbered;
use crate::settings::Settings;
use crate::system::System;

/// Everything a world's future depends on.
#[derive(Debug, Clone, Default)]
pub(crate) struct State {
    pub settings: Settings,
    pub forces: Numbered<Arc<dyn Force>>,
    pub colliders: Colliders,
    pub emitters: Numbered<EmitterState>,
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
        (System::new(settings, forces, colliders, properties), motion)
    }

    /// All spheres as they are now.
    pub fn now(&self) -> Instant<'_> {
        let properties = &self.spheres.properties;
        let system = System::new(&self.settings, &self.forces, &self.colliders, properties);
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
        for (number, emitter) in self.emitters.iter() {
            let subject = Subject::Emitter(EmitterId(number));
            emitter.validate_at(self.clock.seconds()).map_err(|invalid| invalid.about(subject))?;
        }
        Ok(())
    }
}
