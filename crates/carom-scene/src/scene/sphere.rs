//! Single spheres.

use carom::SOLID_BALL;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::finish::Finish;
use super::material::RestitutionLaw;
use super::rotation;
use super::strike::Strike;
use super::values::{
    Color, Quaternion, Vector, all_groups, are_all_groups, first_group, is_default, is_first_group,
    is_unturned, one, unturned,
};

/// A sphere, or what the spheres of a generator or an emitter have in common.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "oneOf" = [{ "required": ["radius"] }, { "required": ["diameter"] }],
    "not" = { "required": ["mass", "density"] }
))]
pub struct Sphere {
    /// Centre, in m. In a generator or an emitter: an offset from the place that it gives.
    #[serde(default)]
    pub position: Vector,
    /// Velocity, in m/s. In an emitter: in the emitter's coordinates.
    #[serde(default)]
    pub velocity: Vector,
    /// Radius, in m, > 0. Give this or `diameter`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
    /// Diameter, in m, > 0. Give this or `radius`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diameter: Option<f64>,
    /// Speed at which the radius grows, in m/s, >= 0, under the rule `exact`. By default 0.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "is_default")]
    pub growth_speed: f64,
    /// Mass, in kg, > 0; 1 if neither this nor `density` is given.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Density, in kg/m³, > 0. Give this or `mass`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Name of its material, whose fields count where its own are missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default = "one")]
    pub restitution: f64,
    /// Restitution by the speed of approach; beside it `restitution` does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_law: Option<RestitutionLaw>,
    /// Coulomb's coefficient of friction, >= 0, under the rules `exact` and `contact`. If missing, the other body's
    /// value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Coefficient of rolling friction, >= 0. If missing, the other body's value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f64>,
    /// Coefficient of spinning friction, >= 0. If missing, the other body's value counts.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spinning_friction: Option<f64>,
    /// Coefficient of tangential restitution in [0, 1]. If missing, the other body's value counts.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_restitution: Option<f64>,
    /// Orientation at the start.
    #[schemars(with = "rotation::Rotation")]
    #[serde(default = "unturned", deserialize_with = "rotation::read")]
    #[serde(skip_serializing_if = "is_unturned")]
    pub orientation: Quaternion,
    /// Angular velocity, in rad/s. In an emitter: in the emitter's coordinates.
    #[serde(default, skip_serializing_if = "is_default")]
    pub angular_velocity: Vector,
    /// The blow of a cue that sets it in motion, besides its velocities. In an emitter: in the emitter's coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strike: Option<Strike>,
    /// Moment of inertia divided by mass and square of the radius, > 0: 0.4 for a solid ball (default), 2/3 for a
    /// thin shell.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "solid_ball", skip_serializing_if = "is_solid_ball")]
    pub inertia_factor: f64,
    /// Groups that it is in, one bit for each of 32: `0b101` is the first and the third. By default the first.
    #[serde(default = "first_group", skip_serializing_if = "is_first_group")]
    pub groups: u32,
    /// Groups that it collides with, one bit for each; by default all. Two bodies collide if each is in a group that the
    /// other collides with.
    #[serde(default = "all_groups", skip_serializing_if = "are_all_groups")]
    pub collides_with: u32,
    /// A number for programs to find it by; no part of the physics.
    #[serde(default, skip_serializing_if = "is_default")]
    pub user_data: u64,
    /// Colour. If missing, that of its density, else that of the scene's spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// How its surface reflects light.
    #[serde(default, skip_serializing_if = "is_default")]
    pub finish: Finish,
}

impl Sphere {
    /// A sphere at rest at a place \[m\], of 1 kg.
    pub fn at(position: Vector, radius: f64) -> Self {
        Self {
            position,
            velocity: [0.0; 3],
            radius: Some(radius),
            diameter: None,
            growth_speed: 0.0,
            mass: None,
            density: None,
            material: None,
            restitution: 1.0,
            restitution_law: None,
            friction: None,
            rolling_friction: None,
            spinning_friction: None,
            tangential_restitution: None,
            orientation: unturned(),
            strike: None,
            angular_velocity: [0.0; 3],
            inertia_factor: SOLID_BALL,
            groups: first_group(),
            collides_with: all_groups(),
            user_data: 0,
            color: None,
            finish: Finish::default(),
        }
    }
}

fn solid_ball() -> f64 {
    SOLID_BALL
}

fn is_solid_ball(factor: &f64) -> bool {
    *factor == SOLID_BALL
}
