//! **Carom moves spheres exactly.** Spheres under forces that collide with each other and with
//! surfaces, at rest or moving at velocities of their own.
//!
//! A [`World`] holds [`Spheres`], forces ([`Force`]), [`Collider`]s and [`Emitter`]s.
//! [`World::step`] advances it by a frame and reports every [`Impact`]. The stages of a step are
//! free functions, put together by a [`Rule`]:
//!
//! 1. **emit** the spheres that are due (`emitter`)
//! 2. **integrate** motion under the forces, without contacts (`forces`, `integrate`)
//! 3. **detect** which bodies touch: broad phase, distance, classification ([`detect`])
//! 4. find the **time of contact** ([`contact_time`])
//! 5. **respond** with impulses, or with forces where contacts persist ([`respond`])
//!
//! [`Rule::Discrete`] and [`Rule::Bisect`] go through a frame in these stages. The default, [`Rule::Exact`], has the
//! motion between impacts in closed form ([`Flight`]) and goes from event to event: **predict** the next event of
//! each sphere, take the first one from a **queue**, **respond**, and predict again what changed. Each sphere is
//! emitted at its own time.
//!
//! Right-handed coordinate system, y up, SI units, double precision. The same input gives the same
//! bits on every platform: only `+ - * /`, `sqrt` and the `libm` crate are used, in a fixed order
//! ([`World::state_hash`]). The formulas and their sources are in
//! `docs/physics/` of the repository.
//!
//! What is promised is what stands at the root of this crate: [`World`], [`Settings`], what is put into a
//! world, reports and snapshots. The modules [`contact_time`], [`detect`] and [`respond`] are public so that
//! the formulas can be read and tried alone; their functions may change in any version.

#![warn(clippy::unwrap_used)]

mod axis_motion;
mod axis_polynomial;
mod band;
mod bodies;
mod bounds;
mod bounds_tree;
mod clock;
mod collider;
mod collider_motion;
mod colliders;
mod compliant_impact;
mod connected;
mod contact_matrix;
mod contact_tangents;
pub mod contact_time;
pub mod detect;
mod emitter;
mod error;
mod flight;
mod force_work;
mod forces;
mod friction;
mod groups;
mod hash;
mod id;
mod integrate;
mod interval;
mod invariants;
mod lanes;
mod material_pair;
mod mesh;
mod moving_bounds;
mod non_additivity;
mod norm;
mod numbered;
pub mod packing;
mod parallel;
mod path;
mod persistent_contact;
mod polynomial_flight;
mod pose;
mod query;
mod random;
mod real;
mod rectangle;
mod report;
pub mod respond;
mod restitution;
mod rotation;
mod round_solid;
mod rule;
mod seams;
mod sensor;
mod settings;
mod shear;
mod solid_box;
mod sphere;
mod state;
mod step;
mod stress;
mod sum;
mod surface;
mod surface_motion;
mod system;
mod tangent;
mod thermostat;
mod validate;
mod well_event;
mod work;
mod world;

pub use glam::{DMat3, DQuat, DVec3};

pub use bodies::Spheres;
pub use collider::{Collider, Ends, Shape, Sides};
pub use collider_motion::{Keyframe, Keyframes, Motion, MotionPart};
pub use emitter::Emitter;
pub use error::{Error, InvalidValue, Subject};
pub use flight::Flight;
pub use forces::{
    Buoyancy, ConstantForce, Force, ForceDerivatives, ForceEdge, Gravity, Interaction, LinearForce,
    MutualGravity, PointAttractor, QuadraticDrag, SphereState, SphereStates, Spring, SpringEnd,
    ViscousDrag, Vortex, Wind,
};
pub use friction::Friction;
pub use groups::Groups;
pub use hash::StateHash;
pub use id::{ColliderId, EmitterId, ForceId, SphereId, SpringId};
pub use material_pair::MaterialPair;
pub use mesh::{Mesh, MeshError, MeshFaults};
pub use path::{PathEnd, PathLeg, PredictedPath};
pub use persistent_contact::PersistentContact;
pub use pose::Pose;
pub use query::{Body, Hit, NearBody, Queries, QueryFilter};
pub use report::{
    BodyPair, ContactAccount, EnergyAccount, Impact, ImpactGroup, LedgerEntry, Overlap,
    SensorEvent, StageCounts, StepReport, TriggerContact, ZoneAccount,
};
pub use respond::Strike;
pub use restitution::RestitutionLaw;
pub use rotation::rotation_vector;
pub use settings::{
    Bisect, Boundary, CombineRule, Contact, Discrete, Exact, ImpactLaw, Integrator, PairPotential,
    Rule, Settings, Thermostat, WindBack, Zones,
};
pub use sphere::{Mass, SOLID_BALL, Sphere, SphereMotion, THIN_SHELL, volume};
pub use stress::{Stress, StressMeter};
pub use tangent::{
    ColliderVariation, DerivativeError, Margin, SphereTangent, SphereVariation, SpringVariation,
    Tangents, Tape, Variation,
};
pub use well_event::{WellEvent, WellEventKind};
pub use work::StopRequest;
pub use world::World;
pub use world::snapshot::Snapshot;

/// The program of the README that this crate is published with.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct CrateReadme;
