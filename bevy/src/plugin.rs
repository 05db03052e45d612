//! The plugin, and the order of its systems.

use bevy_app::prelude::*;
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{InternedScheduleLabel, ScheduleLabel};
use bevy_time::{Fixed, Time};
use carom::{Settings, World};

use crate::components::Gravity;
use crate::messages::{self, Impact, PhysicsError, SensorEvent, logged};
use crate::physics::CaromWorld;
use crate::{interpolation, read, rollback, step, write};

/// Adds the physics to an app: by default under the rule `exact`, in [`FixedPostUpdate`], with [`Gravity`].
///
/// A step is as long as the timestep of `Time<Fixed>`.
///
/// ```
/// use bevy_app::App;
/// use carom_bevy::CaromPlugin;
/// use carom_bevy::carom::{Contact, Rule, Settings};
///
/// // The rule for large heaps.
/// let mut settings = Settings::default();
/// settings.rule = Rule::Contact(Contact::default());
/// App::new().add_plugins(CaromPlugin::new(settings));
/// ```
#[derive(Debug, Clone)]
pub struct CaromPlugin {
    settings: Settings,
    schedule: InternedScheduleLabel,
}

impl CaromPlugin {
    /// The physics with these settings. If they are invalid, the app has the default ones and an error is logged.
    pub fn new(settings: Settings) -> Self {
        Self { settings, schedule: FixedPostUpdate.intern() }
    }

    /// Returns the plugin with its step in another schedule, such as `FixedUpdate`.
    #[must_use]
    pub fn in_schedule(self, schedule: impl ScheduleLabel) -> Self {
        Self { schedule: schedule.intern(), ..self }
    }
}

impl Default for CaromPlugin {
    fn default() -> Self {
        Self::new(Settings::default())
    }
}

/// One step of the physics: components are read, the world advances, components are written.
#[derive(ScheduleLabel, Debug, Clone, PartialEq, Eq, Hash)]
pub struct PhysicsSchedule;

/// The parts of a step, in this order, to put systems before or after them in [`PhysicsSchedule`].
#[derive(SystemSet, Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CaromSystems {
    /// Reads what programs changed: new and despawned bodies, places, velocities, forces.
    Read,
    /// Advances the world.
    Step,
    /// Writes messages, places and velocities.
    Write,
}

impl Plugin for CaromPlugin {
    fn build(&self, app: &mut App) {
        app.init_schedule(PhysicsSchedule)
            .init_resource::<Time<Fixed>>()
            .init_resource::<Gravity>()
            .add_message::<Impact>()
            .add_message::<SensorEvent>()
            .add_message::<PhysicsError>();
        let world = World::new(self.settings).unwrap_or_else(|error| {
            app.world_mut().write_message(logged(None, error));
            World::default()
        });
        app.insert_resource(CaromWorld { world, ..CaromWorld::default() });
        app.add_systems(self.schedule, run_step);
        add_step(app);
        interpolation::add(app);
    }
}

/// Adds the systems of a step, in their order.
fn add_step(app: &mut App) {
    let sets = (CaromSystems::Read, CaromSystems::Step, CaromSystems::Write);
    app.configure_sets(PhysicsSchedule, sets.chain());
    let read = (
        interpolation::begin_step,
        read::removed::remove_bodies,
        read::gravity::read_gravity,
        read::meshes::make_colliders,
        read::colliders::add_colliders,
        read::colliders::change_colliders,
        read::balls::add_balls,
        read::balls::change_balls,
        read::forces::apply_forces,
    );
    let write = (
        write::adopt_bodies,
        messages::write,
        write::despawn_bodies,
        write::write_balls,
        write::write_colliders,
        interpolation::end_step,
        rollback::record,
    );
    app.add_systems(PhysicsSchedule, read.chain().in_set(CaromSystems::Read));
    app.add_systems(PhysicsSchedule, step::advance.in_set(CaromSystems::Step));
    app.add_systems(PhysicsSchedule, write.chain().in_set(CaromSystems::Write));
}

fn run_step(world: &mut bevy_ecs::world::World) {
    world.run_schedule(PhysicsSchedule);
}
