//! Apps for tests: no window, and time that a test advances.
#![allow(dead_code)]

use std::time::Duration;

use bevy_app::App;
use bevy_ecs::message::Messages;
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time, TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use carom_bevy::carom::{Bisect, Contact, Discrete, Exact, Rule, Settings};
use carom_bevy::prelude::*;

/// Frames of 1/64 s, a number without rounding.
pub const DT: f64 = 1.0 / 64.0;

pub const RULES: [fn() -> Rule; 4] = [
    || Rule::Exact(Exact::default()),
    || Rule::Contact(Contact::default()),
    || Rule::Discrete(Discrete::default()),
    || Rule::Bisect(Bisect::default()),
];

pub fn settings(rule: Rule) -> Settings {
    let mut settings = Settings::default();
    settings.rule = rule;
    settings
}

/// An app without gravity, whose frames are as long as its steps.
pub fn app_with(settings: Settings) -> App {
    let mut app = App::new();
    app.add_plugins((TimePlugin, TransformPlugin, CaromPlugin::new(settings)));
    app.world_mut().remove_resource::<Gravity>();
    app.insert_resource(Time::<Fixed>::from_duration(Duration::from_secs_f64(DT)));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(DT)));
    app
}

pub fn app() -> App {
    app_with(Settings::default())
}

pub fn steps(app: &mut App, count: u32) {
    for _ in 0..count {
        app.world_mut().step_physics();
    }
}

/// All messages of a type that are still there.
pub fn messages<M: Message + Clone>(app: &App) -> Vec<M> {
    let messages = app.world().resource::<Messages<M>>();
    messages.iter_current_update_messages().cloned().collect()
}

pub fn get<C: Component + Copy>(app: &App, entity: Entity) -> C {
    *app.world().get::<C>(entity).expect("the component is there")
}

pub fn hash(app: &App) -> carom_bevy::carom::StateHash {
    app.world().resource::<CaromWorld>().state_hash()
}
