//! **Exact physics of spheres for Bevy**, by [Carom](carom).
//!
//! An entity with a [`Ball`] is a sphere of the physics; an entity with a [`Collider`] is a surface off which
//! balls bounce, at rest or moving. Their places are in [`Transform`](bevy_transform::components::Transform), as
//! everywhere in Bevy; velocities are in [`LinearVelocity`] and [`AngularVelocity`]. [`CaromPlugin`] advances them in
//! Bevy's fixed schedule.
//!
//! ```
//! use bevy_app::{App, FixedUpdate, TaskPoolPlugin};
//! use bevy_ecs::prelude::*;
//! use bevy_time::{Fixed, Time, TimePlugin};
//! use bevy_transform::components::Transform;
//! use carom_bevy::prelude::*;
//!
//! let mut app = App::new();
//! app.add_plugins((TaskPoolPlugin::default(), TimePlugin, CaromPlugin::default()));
//! app.insert_resource(Time::<Fixed>::from_hz(64.0));
//! app.world_mut().spawn(Collider::half_space());
//! let ball = Ball::new(0.5).with(|sphere| sphere.with_restitution(0.5));
//! let ball = app.world_mut().spawn((ball, Transform::from_xyz(0.0, 2.0, 0.0))).id();
//! for _ in 0..640 {
//!     app.world_mut().step_physics();
//! }
//! // It has come to rest on the floor.
//! assert_eq!(app.world().get::<Transform>(ball).map(|it| it.translation.y), Some(0.5));
//! ```
//!
//! # What is where
//!
//! | for | there is |
//! |---|---|
//! | bodies | [`Ball`], [`Collider`], [`ColliderFromMesh`], [`Kinematic`], [`LinearVelocity`], [`AngularVelocity`] |
//! | forces | [`Gravity`], [`ExternalForce`]; drag, wind, springs and others by [`CaromWorld`] |
//! | what happened | messages: [`Impact`], [`SensorEvent`], [`PhysicsError`] |
//! | questions | [`SpatialQuery`]: rays, moving spheres, neighbours |
//! | smooth pictures | [`TransformInterpolation`] |
//! | returning to an earlier frame | [`Rollback`], [`PhysicsWorldExt`] |
//! | scene files | `load_physics_scene` of [`PhysicsWorldExt`], feature `scene` |
//! | outlines | `CaromGizmosPlugin`, feature `gizmos` |
//!
//! # Precision
//!
//! The physics holds positions and velocities as `f64`; a `Transform` holds `f32`. A `Transform` is read only where a
//! program changed it, so its rounding never enters the physics: the state is the same to the bit as in a
//! [`carom::World`] without Bevy.

mod components;
mod convert;
#[cfg(feature = "gizmos")]
mod gizmos;
mod interpolation;
mod messages;
mod physics;
mod plugin;
mod query;
mod read;
mod rollback;
#[cfg(feature = "scene")]
mod scene;
mod step;
mod world_ext;
mod write;

pub use carom;
#[cfg(feature = "scene")]
pub use carom_scene;

pub use components::{
    AngularVelocity, Ball, Collider, ColliderFromMesh, ExternalForce, Gravity, Kinematic,
    LinearVelocity, PhysicsBody,
};
#[cfg(feature = "gizmos")]
pub use gizmos::{CaromGizmos, CaromGizmosPlugin};
pub use interpolation::TransformInterpolation;
pub use messages::{Impact, PhysicsError, PhysicsFault, SensorEvent};
pub use physics::CaromWorld;
pub use plugin::{CaromPlugin, CaromSystems, PhysicsSchedule};
pub use query::{BodyHit, NearestBody, SpatialQuery};
pub use rollback::{PhysicsSnapshot, Rollback, RollbackError};
pub use world_ext::PhysicsWorldExt;

/// What most programs use.
pub mod prelude {
    #[cfg(feature = "gizmos")]
    pub use crate::CaromGizmosPlugin;
    pub use crate::{
        AngularVelocity, Ball, CaromPlugin, CaromSystems, CaromWorld, Collider, ColliderFromMesh,
        ExternalForce, Gravity, Impact, Kinematic, LinearVelocity, PhysicsError, PhysicsWorldExt,
        Rollback, SensorEvent, SpatialQuery, TransformInterpolation,
    };
}

/// The program of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
