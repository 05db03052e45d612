//! Messages about what happened in a step.

use bevy_ecs::message::MessageWriter;
use bevy_ecs::prelude::*;
use bevy_math::DVec3;
use carom::BodyPair;
use thiserror::Error;

use crate::convert::to_bevy;
use crate::physics::CaromWorld;

/// An impact of two balls, or of a collider and a ball.
#[derive(Message, Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// The two bodies: two balls in the order in which they were added, or a collider and a ball.
    pub entities: [Entity; 2],
    /// Time since the start of the step \[s\]. Under the rule `exact` it is that of the impact itself.
    pub time: f64,
    /// Contact point on the first body \[m\].
    pub point: DVec3,
    /// Unit normal from the first body to the second.
    pub normal: DVec3,
    /// Speed of approach along the normal before the impact \[m/s\].
    pub approach_speed: f64,
    /// Impulse on the second body along the normal, and against it on the first \[N s\].
    pub impulse: f64,
    /// Impulse of friction on the second body, and against it on the first \[N s\].
    pub tangential_impulse: DVec3,
}

impl Impact {
    /// Returns the other body of the impact; `None` if this entity is neither.
    pub fn other(&self, entity: Entity) -> Option<Entity> {
        let [first, second] = self.entities;
        match entity {
            it if it == first => Some(second),
            it if it == second => Some(first),
            _ => None,
        }
    }

    /// Converts an impact of a report; `None` for a body without an entity.
    fn of(impact: &carom::Impact, physics: &CaromWorld) -> Option<Self> {
        let of_sphere = |id| physics.entity(carom::Body::Sphere(id));
        let entities = match impact.between {
            BodyPair::Spheres(first, second) => [of_sphere(first)?, of_sphere(second)?],
            BodyPair::Collider { collider, sphere } => {
                [physics.entity(carom::Body::Collider(collider))?, of_sphere(sphere)?]
            }
        };
        Some(Self {
            entities,
            time: impact.time,
            point: to_bevy(impact.point),
            normal: to_bevy(impact.normal),
            approach_speed: impact.approach_speed,
            impulse: impact.impulse,
            tangential_impulse: to_bevy(impact.tangential_impulse),
        })
    }
}

/// A ball that enters a sensor, or leaves it.
#[derive(Message, Debug, Clone, Copy, PartialEq)]
pub struct SensorEvent {
    /// The entity with the sensor.
    pub sensor: Entity,
    /// The ball. Where the sensor captures it, its entity is despawned after the step.
    pub ball: Entity,
    /// Whether the ball enters; else it leaves.
    pub enters: bool,
    /// Time since the start of the step \[s\].
    pub time: f64,
    /// Where on the surface of the sensor \[m\].
    pub point: DVec3,
    /// Unit normal from the surface of the sensor to the ball.
    pub normal: DVec3,
    /// Speed of the ball relative to the sensor \[m/s\].
    pub speed: f64,
}

impl SensorEvent {
    /// Converts an event of a report; `None` for a body without an entity.
    fn of(event: &carom::SensorEvent, physics: &CaromWorld) -> Option<Self> {
        Some(Self {
            sensor: physics.entity(carom::Body::Collider(event.collider))?,
            ball: physics.entity(carom::Body::Sphere(event.sphere))?,
            enters: event.enters,
            time: event.time,
            point: to_bevy(event.point),
            normal: to_bevy(event.normal),
            speed: event.speed,
        })
    }
}

/// Something that the physics refused. It is also logged; the world is as it was before.
#[derive(Message, Debug, Clone, PartialEq)]
pub struct PhysicsError {
    /// The entity that it is about; `None` for a step as a whole.
    pub entity: Option<Entity>,
    /// What was wrong.
    pub fault: PhysicsFault,
}

/// What was wrong.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum PhysicsFault {
    /// An invalid component, or a step that was refused.
    #[error(transparent)]
    World(#[from] carom::Error),
    /// A mesh that cannot be a collider.
    #[error(transparent)]
    Mesh(#[from] carom::MeshError),
    /// A mesh without a list of triangles with positions of three `f32`, or one that only the renderer has.
    #[error("a collider needs a mesh with a list of triangles: {0}")]
    Triangles(String),
}

/// Logs an error and returns it as a message.
pub fn logged(entity: Option<Entity>, fault: impl Into<PhysicsFault>) -> PhysicsError {
    let fault = fault.into();
    match entity {
        Some(entity) => tracing::error!("{entity}: {fault}"),
        None => tracing::error!("{fault}"),
    }
    PhysicsError { entity, fault }
}

/// Writes the messages of the last step, if it was taken.
pub fn write(
    physics: Res<CaromWorld>,
    mut impacts: MessageWriter<Impact>,
    mut sensor_events: MessageWriter<SensorEvent>,
) {
    if physics.was_refused() {
        return;
    }
    let report = physics.report();
    impacts.write_batch(report.impacts.iter().filter_map(|it| Impact::of(it, &physics)));
    let events = report.sensor_events.iter().filter_map(|it| SensorEvent::of(it, &physics));
    sensor_events.write_batch(events);
}
