//! Materials, and what their contacts do.

use schemars::JsonSchema;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::finish::Finish;
use super::values::Color;

/// Fields that spheres and colliders of a material share; a body's own fields win.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Restitution by the speed of approach; beside it `restitution` does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_law: Option<RestitutionLaw>,
    /// Coulomb's coefficient of friction, >= 0.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Coefficient of rolling friction, >= 0.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f64>,
    /// Coefficient of spinning friction, >= 0.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spinning_friction: Option<f64>,
    /// Coefficient of tangential restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_restitution: Option<f64>,
    /// Density of spheres without `mass`, in kg/m³, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Colour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// How surfaces reflect light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub finish: Option<Finish>,
}

/// Coefficients of the contacts of two materials, instead of those that combine rules give.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialPair {
    /// Names of the two materials, which may be the same.
    #[serde(deserialize_with = "two_names")]
    pub materials: [String; 2],
    /// Coefficient of restitution in [0, 1]. If missing, the combine rule gives it.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Restitution by the speed of approach; beside it `restitution` does not count.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution_law: Option<RestitutionLaw>,
    /// Coulomb's coefficient of friction, >= 0. If missing, the combine rule gives it.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Coefficient of rolling friction, >= 0. If missing, the combine rule gives it.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolling_friction: Option<f64>,
    /// Coefficient of spinning friction, >= 0. If missing, the combine rule gives it.
    #[schemars(range(min = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spinning_friction: Option<f64>,
    /// Coefficient of tangential restitution in [0, 1]. If missing, the combine rule gives it.
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tangential_restitution: Option<f64>,
    /// Non-additivity parameter D from -0.9 to 9: spheres touch where their centres are (1 + D) times the sum of their
    /// radii apart.
    #[schemars(range(min = -0.9, max = 9.0))]
    #[serde(default)]
    pub non_additivity: f64,
}

/// Reads the names of a pair; the error of lists of another length speaks of names.
fn two_names<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[String; 2], D::Error> {
    let names = Vec::<String>::deserialize(deserializer)?;
    <[String; 2]>::try_from(names)
        .map_err(|names| D::Error::custom(format!("has {} names, not two", names.len())))
}

/// Restitution that depends on the speed of approach v along the normal.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum RestitutionLaw {
    /// Plastic impacts: `restitution (v/speed)^-exponent` above `speed`, `restitution` below.
    PowerLaw {
        /// Coefficient at low speeds, in [0, 1]; by default 1, with which nothing comes to rest.
        #[schemars(range(min = 0.0, max = 1.0))]
        #[serde(default = "one")]
        restitution: f64,
        /// In m/s, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        speed: f64,
        /// In [0, 1]; by default 1/4, that of spheres that yield.
        #[schemars(range(min = 0.0, max = 1.0))]
        #[serde(default = "quarter")]
        exponent: f64,
    },
    /// Viscoelastic spheres: 1 - 1.153 (v/speed)^(1/5) at low speeds.
    Viscoelastic {
        /// Speed at which the coefficient is 0.3987, in m/s, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        speed: f64,
    },
    /// `restitution` from `speed` on, and 1 below it.
    Cutoff {
        /// Coefficient at high speeds, in [0, 1].
        #[schemars(range(min = 0.0, max = 1.0))]
        restitution: f64,
        /// In m/s, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        speed: f64,
    },
}

fn one() -> f64 {
    1.0
}

fn quarter() -> f64 {
    0.25
}
