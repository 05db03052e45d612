//! Writes and reads changes as TOML.
//!
//! ```toml
//! [[changes]]
//! frame = 30
//! change = { collider-restitution = { collider = 0, restitution = 0.5 } }
//! ```
//!
//! Ids are written as numbers. TOML preserves every number exactly.

use carom::{
    ColliderId, DQuat, DVec3, EmitterId, ForceId, Friction, Groups, Mass, Pose, SOLID_BALL,
    SphereId, SpringEnd, SpringId,
};
use carom_scene::scene::{Color, Force, Quaternion, Simulation, Vector};
use carom_scene::{from_toml_text, legible};
use serde::{Deserialize, Serialize};

use crate::change::{Change, PastChange};
use crate::edit::{Edit, SphereChange};

/// Longest error \[characters\]: enough for a list of all kinds of edits.
const LONGEST_PROBLEM: usize = 330;

/// Writes changes as TOML.
pub fn to_toml(changes: &[PastChange]) -> String {
    let changes = changes.iter().map(Dated::from).collect();
    toml::to_string(&Document { changes }).expect("ids count up from 0, so no number is too large")
}

/// Reads changes from TOML; the error is one line.
pub fn from_toml(text: &str) -> Result<Vec<PastChange>, String> {
    let document: Document = from_toml_text(text).map_err(problem_in)?;
    if !document.changes.is_sorted_by_key(|it| it.frame) {
        return Err("they are not in the order of their frames".to_owned());
    }
    Ok(document.changes.into_iter().map(PastChange::from).collect())
}

impl Edit {
    /// Reads an edit from TOML in the form of links: `change = { all-collider-restitutions = 0.5
    /// }`.
    ///
    /// # Errors
    /// A description of what is wrong, in one line.
    pub fn from_toml(text: &str) -> Result<Self, String> {
        let single: Single = from_toml_text(text).map_err(problem_in)?;
        match single.change.into() {
            Change::Edit(edit) => Ok(edit),
            Change::FailedStep => Err("a failed step is no edit".to_owned()),
        }
    }
}

/// Describes an error in one line.
fn problem_in((line, problem): (usize, String)) -> String {
    let problem = problem.lines().next().unwrap_or_default();
    format!("in line {line}, {}", legible(problem, LONGEST_PROBLEM))
}

/// A change without a frame.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Single {
    change: Written,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Document {
    changes: Vec<Dated>,
}

/// [`PastChange`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Dated {
    frame: u64,
    change: Written,
}

/// [`Change`] and [`Edit`] as written.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum Written {
    FailedStep,
    Simulation(Box<Simulation>),
    FrameTime(f64),
    Force { force: u64, is: Force },
    AddForce(Force),
    RemoveForce(u64),
    Spring { spring: u64, is: Spring },
    AddSpring(Spring),
    RemoveSpring(u64),
    ColliderRestitution { collider: u64, restitution: f64 },
    AllColliderRestitutions(f64),
    NamedColliderRestitutions { name: String, restitution: f64 },
    ColliderFriction { collider: u64, friction: SurfaceFriction },
    AllColliderFrictions(SurfaceFriction),
    NamedColliderFrictions { name: String, friction: SurfaceFriction },
    ColliderPose { collider: u64, position: Vector, rotation: Quaternion },
    ColliderScale { collider: u64, scale: f64 },
    Emitter { emitter: u64, is: Box<Emitter> },
    Sphere { sphere: u64, changes: Box<SphereFields> },
    Throw { sphere: Box<Sphere>, color: Option<Color> },
    RemoveSphere(u64),
}

/// [`carom::Spring`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Spring {
    sphere: u64,
    to: WrittenEnd,
    rest_length: f64,
    stiffness: f64,
    damping: f64,
    only_pulls: bool,
}

/// [`SpringEnd`] as written.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum WrittenEnd {
    Sphere(u64),
    Point(Vector),
}

/// [`SphereChange`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SphereFields {
    position: Option<Vector>,
    velocity: Option<Vector>,
    radius: Option<f64>,
    mass: Option<f64>,
    restitution: Option<f64>,
    friction: Option<SurfaceFriction>,
    angular_velocity: Option<Vector>,
}

/// [`Friction`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SurfaceFriction {
    sliding: Option<f64>,
    rolling: Option<f64>,
    spinning: Option<f64>,
    tangential_restitution: Option<f64>,
}

/// [`carom::Sphere`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Sphere {
    position: Vector,
    velocity: Vector,
    radius: f64,
    mass: WrittenMass,
    restitution: f64,
    friction: Option<f64>,
    rolling_friction: Option<f64>,
    spinning_friction: Option<f64>,
    tangential_restitution: Option<f64>,
    /// `None` for the identity.
    orientation: Option<Quaternion>,
    /// `None` for zero.
    angular_velocity: Option<Vector>,
    /// `None` for a solid ball.
    inertia_factor: Option<f64>,
    /// `None` for the first group.
    groups: Option<u32>,
    /// `None` for all.
    collides_with: Option<u32>,
    /// `None` for zero.
    user_data: Option<u64>,
}

/// [`Mass`] as written.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum WrittenMass {
    Kilograms(f64),
    Density(f64),
}

/// [`carom::Emitter`] as written.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Emitter {
    position: Vector,
    rotation: Quaternion,
    period: f64,
    max_spheres: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    count: Option<u32>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    needs_room: Option<bool>,
    sphere: Sphere,
}

impl From<&PastChange> for Dated {
    fn from(past: &PastChange) -> Self {
        Self { frame: past.frame, change: (&past.change).into() }
    }
}

impl From<Dated> for PastChange {
    fn from(dated: Dated) -> Self {
        Self { frame: dated.frame, change: dated.change.into() }
    }
}

impl From<&Change> for Written {
    fn from(change: &Change) -> Self {
        let edit = match change {
            Change::FailedStep => return Self::FailedStep,
            Change::Edit(edit) => edit,
        };
        match edit {
            Edit::Simulation(simulation) => Self::Simulation(simulation.clone()),
            Edit::FrameTime(frame_time) => Self::FrameTime(*frame_time),
            Edit::Force(id, force) => Self::Force { force: id.number(), is: force.clone() },
            Edit::AddForce(force) => Self::AddForce(force.clone()),
            Edit::RemoveForce(id) => Self::RemoveForce(id.number()),
            Edit::Spring(id, spring) => Self::Spring { spring: id.number(), is: spring.into() },
            Edit::AddSpring(spring) => Self::AddSpring(spring.into()),
            Edit::RemoveSpring(id) => Self::RemoveSpring(id.number()),
            Edit::ColliderRestitution(id, restitution) => {
                Self::ColliderRestitution { collider: id.number(), restitution: *restitution }
            }
            Edit::AllColliderRestitutions(restitution) => {
                Self::AllColliderRestitutions(*restitution)
            }
            Edit::NamedColliderRestitutions(name, restitution) => {
                Self::NamedColliderRestitutions { name: name.clone(), restitution: *restitution }
            }
            Edit::ColliderFriction(id, friction) => {
                Self::ColliderFriction { collider: id.number(), friction: (*friction).into() }
            }
            Edit::AllColliderFrictions(friction) => Self::AllColliderFrictions((*friction).into()),
            Edit::NamedColliderFrictions(name, friction) => {
                Self::NamedColliderFrictions { name: name.clone(), friction: (*friction).into() }
            }
            Edit::ColliderPose(id, pose) => Self::ColliderPose {
                collider: id.number(),
                position: pose.position.to_array(),
                rotation: pose.rotation.to_array(),
            },
            Edit::ColliderScale(id, scale) => {
                Self::ColliderScale { collider: id.number(), scale: *scale }
            }
            Edit::Emitter(id, emitter) => {
                Self::Emitter { emitter: id.number(), is: Box::new((&**emitter).into()) }
            }
            Edit::Sphere(id, change) => {
                Self::Sphere { sphere: id.number(), changes: Box::new((&**change).into()) }
            }
            Edit::Throw { sphere, color } => {
                Self::Throw { sphere: Box::new((&**sphere).into()), color: *color }
            }
            Edit::RemoveSphere(id) => Self::RemoveSphere(id.number()),
        }
    }
}

impl From<Written> for Change {
    fn from(written: Written) -> Self {
        Self::Edit(match written {
            Written::FailedStep => return Self::FailedStep,
            Written::Simulation(simulation) => Edit::Simulation(simulation),
            Written::FrameTime(frame_time) => Edit::FrameTime(frame_time),
            Written::Force { force, is } => Edit::Force(ForceId::from_number(force), is),
            Written::AddForce(force) => Edit::AddForce(force),
            Written::RemoveForce(force) => Edit::RemoveForce(ForceId::from_number(force)),
            Written::Spring { spring, is } => {
                Edit::Spring(SpringId::from_number(spring), is.into())
            }
            Written::AddSpring(spring) => Edit::AddSpring(spring.into()),
            Written::RemoveSpring(spring) => Edit::RemoveSpring(SpringId::from_number(spring)),
            Written::ColliderRestitution { collider, restitution } => {
                Edit::ColliderRestitution(ColliderId::from_number(collider), restitution)
            }
            Written::AllColliderRestitutions(restitution) => {
                Edit::AllColliderRestitutions(restitution)
            }
            Written::NamedColliderRestitutions { name, restitution } => {
                Edit::NamedColliderRestitutions(name, restitution)
            }
            Written::ColliderFriction { collider, friction } => {
                Edit::ColliderFriction(ColliderId::from_number(collider), friction.into())
            }
            Written::AllColliderFrictions(friction) => Edit::AllColliderFrictions(friction.into()),
            Written::NamedColliderFrictions { name, friction } => {
                Edit::NamedColliderFrictions(name, friction.into())
            }
            Written::ColliderPose { collider, position, rotation } => {
                let pose = Pose::at(DVec3::from_array(position));
                let pose = pose.rotated(DQuat::from_array(rotation));
                Edit::ColliderPose(ColliderId::from_number(collider), pose)
            }
            Written::ColliderScale { collider, scale } => {
                Edit::ColliderScale(ColliderId::from_number(collider), scale)
            }
            Written::Emitter { emitter, is } => {
                Edit::Emitter(EmitterId::from_number(emitter), Box::new((*is).into()))
            }
            Written::Sphere { sphere, changes } => {
                Edit::Sphere(SphereId::from_number(sphere), Box::new((*changes).into()))
            }
            Written::Throw { sphere, color } => {
                Edit::Throw { sphere: Box::new((*sphere).into()), color }
            }
            Written::RemoveSphere(sphere) => Edit::RemoveSphere(SphereId::from_number(sphere)),
        })
    }
}

impl From<&carom::Spring> for Spring {
    fn from(spring: &carom::Spring) -> Self {
        Self {
            sphere: spring.sphere.number(),
            to: match spring.to {
                SpringEnd::Sphere(sphere) => WrittenEnd::Sphere(sphere.number()),
                SpringEnd::Point(point) => WrittenEnd::Point(point.to_array()),
            },
            rest_length: spring.rest_length,
            stiffness: spring.stiffness,
            damping: spring.damping,
            only_pulls: spring.only_pulls,
        }
    }
}

impl From<Spring> for carom::Spring {
    fn from(spring: Spring) -> Self {
        Self {
            sphere: SphereId::from_number(spring.sphere),
            to: match spring.to {
                WrittenEnd::Sphere(sphere) => SpringEnd::Sphere(SphereId::from_number(sphere)),
                WrittenEnd::Point(point) => SpringEnd::Point(DVec3::from_array(point)),
            },
            rest_length: spring.rest_length,
            stiffness: spring.stiffness,
            damping: spring.damping,
            only_pulls: spring.only_pulls,
        }
    }
}

impl From<&SphereChange> for SphereFields {
    fn from(change: &SphereChange) -> Self {
        Self {
            position: change.position.map(|it| it.to_array()),
            velocity: change.velocity.map(|it| it.to_array()),
            radius: change.radius,
            mass: change.mass,
            restitution: change.restitution,
            friction: change.friction.map(SurfaceFriction::from),
            angular_velocity: change.angular_velocity.map(|it| it.to_array()),
        }
    }
}

impl From<SphereFields> for SphereChange {
    fn from(fields: SphereFields) -> Self {
        Self {
            position: fields.position.map(DVec3::from_array),
            velocity: fields.velocity.map(DVec3::from_array),
            radius: fields.radius,
            mass: fields.mass,
            restitution: fields.restitution,
            friction: fields.friction.map(Friction::from),
            angular_velocity: fields.angular_velocity.map(DVec3::from_array),
        }
    }
}

impl From<Friction> for SurfaceFriction {
    fn from(friction: Friction) -> Self {
        Self {
            sliding: friction.sliding,
            rolling: friction.rolling,
            spinning: friction.spinning,
            tangential_restitution: friction.tangential_restitution,
        }
    }
}

impl From<SurfaceFriction> for Friction {
    fn from(written: SurfaceFriction) -> Self {
        let mut friction = Self::default();
        friction.sliding = written.sliding;
        friction.rolling = written.rolling;
        friction.spinning = written.spinning;
        friction.tangential_restitution = written.tangential_restitution;
        friction
    }
}

impl From<&carom::Sphere> for Sphere {
    fn from(sphere: &carom::Sphere) -> Self {
        Self {
            position: sphere.position.to_array(),
            velocity: sphere.velocity.to_array(),
            radius: sphere.radius,
            mass: match sphere.mass {
                Mass::Kilograms(mass) => WrittenMass::Kilograms(mass),
                Mass::Density(density) => WrittenMass::Density(density),
            },
            restitution: sphere.restitution,
            friction: sphere.friction.sliding,
            rolling_friction: sphere.friction.rolling,
            spinning_friction: sphere.friction.spinning,
            tangential_restitution: sphere.friction.tangential_restitution,
            orientation: unusual(sphere.orientation, DQuat::IDENTITY).map(|it| it.to_array()),
            angular_velocity: unusual(sphere.angular_velocity, DVec3::ZERO).map(|it| it.to_array()),
            inertia_factor: unusual(sphere.inertia_factor, SOLID_BALL),
            groups: unusual(sphere.groups.groups, Groups::DEFAULT.groups),
            collides_with: unusual(sphere.groups.collides_with, Groups::DEFAULT.collides_with),
            user_data: unusual(sphere.user_data, 0),
        }
    }
}

/// Returns a value that differs from its default and so has to be written.
fn unusual<T: PartialEq>(value: T, usual: T) -> Option<T> {
    (value != usual).then_some(value)
}

impl From<Sphere> for carom::Sphere {
    fn from(sphere: Sphere) -> Self {
        let friction = SurfaceFriction {
            sliding: sphere.friction,
            rolling: sphere.rolling_friction,
            spinning: sphere.spinning_friction,
            tangential_restitution: sphere.tangential_restitution,
        };
        let mass = match sphere.mass {
            WrittenMass::Kilograms(mass) => Mass::Kilograms(mass),
            WrittenMass::Density(density) => Mass::Density(density),
        };
        let groups = Groups {
            groups: sphere.groups.unwrap_or(Groups::DEFAULT.groups),
            collides_with: sphere.collides_with.unwrap_or(Groups::DEFAULT.collides_with),
        };
        Self::new(DVec3::from_array(sphere.position), sphere.radius)
            .with_velocity(DVec3::from_array(sphere.velocity))
            .with_mass(mass)
            .with_restitution(sphere.restitution)
            .with_friction(friction)
            .with_orientation(sphere.orientation.map_or(DQuat::IDENTITY, DQuat::from_array))
            .with_angular_velocity(sphere.angular_velocity.map_or(DVec3::ZERO, DVec3::from_array))
            .with_inertia_factor(sphere.inertia_factor.unwrap_or(SOLID_BALL))
            .with_groups(groups)
            .with_user_data(sphere.user_data.unwrap_or_default())
    }
}

impl From<&carom::Emitter> for Emitter {
    fn from(emitter: &carom::Emitter) -> Self {
        Self {
            position: emitter.position.to_array(),
            rotation: emitter.rotation.to_array(),
            period: emitter.period,
            max_spheres: emitter.max_spheres,
            count: emitter.count,
            needs_room: emitter.needs_room,
            sphere: (&emitter.sphere).into(),
        }
    }
}

impl From<Emitter> for carom::Emitter {
    fn from(emitter: Emitter) -> Self {
        Self::new(emitter.sphere.into(), emitter.period)
            .with_position(DVec3::from_array(emitter.position))
            .with_rotation(DQuat::from_array(emitter.rotation))
            .with_max_spheres(emitter.max_spheres)
            .with_count(emitter.count)
            .with_needs_room(emitter.needs_room)
    }
}
