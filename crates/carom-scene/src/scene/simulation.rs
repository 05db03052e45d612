//! How a scene is stepped.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Vector, is_default};

/// Rule, frame and other settings of the simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Simulation {
    /// The rule.
    pub rule: Rule,
    /// Number of dimensions, 2 or 3. With 2 balls are discs in the plane z = 0. By default 3.
    #[schemars(range(min = 2, max = 3))]
    #[serde(skip_serializing_if = "is_three")]
    pub dimensions: u32,
    /// Length of a frame, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub frame_time: f64,
    /// Time worth watching, in s, > 0. `carom run` runs for it by default.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub duration: f64,
    /// Whether spheres collide with each other. They always collide with colliders.
    pub spheres_collide: bool,
    /// How the restitution of a contact follows from those of its bodies.
    pub combine_rule: CombineRule,
    /// How the friction of a contact follows from those of its bodies. By default `geometric-mean`.
    #[serde(skip_serializing_if = "is_geometric_mean")]
    pub friction_combine_rule: CombineRule,
    /// Whether spheres may overlap each other or colliders at the start.
    pub allow_overlap: bool,
    /// Open space or a periodic box.
    pub boundary: Boundary,
    /// Thermostat, if there is one; only under the rule `exact`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thermostat: Option<Thermostat>,
    /// Potential energy of two balls by their distance, if there is some; only under the rule `exact`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pair_potential: Option<PairPotential>,
    /// Parameters of the rule `exact`.
    pub exact: Exact,
    /// Parameters of the rule `bisect`.
    pub bisect: Bisect,
    /// Parameters of the rule `discrete`.
    pub discrete: Discrete,
    /// Parameters of the rule `contact`.
    #[serde(skip_serializing_if = "is_default")]
    pub contact: Contact,
}

fn is_three(dimensions: &u32) -> bool {
    *dimensions == 3
}

fn is_geometric_mean(rule: &CombineRule) -> bool {
    *rule == CombineRule::GeometricMean
}

impl Default for Simulation {
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            dimensions: 3,
            frame_time: 1.0 / 60.0,
            duration: 10.0,
            spheres_collide: true,
            combine_rule: CombineRule::default(),
            friction_combine_rule: CombineRule::GeometricMean,
            allow_overlap: false,
            boundary: Boundary::default(),
            thermostat: None,
            pair_potential: None,
            exact: Exact::default(),
            bisect: Bisect::default(),
            discrete: Discrete::default(),
            contact: Contact::default(),
        }
    }
}

/// How the world goes through a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// Moves every sphere by the frame, then answers overlaps (the course's rule).
    Discrete,
    /// Winds back what intersects and finds the time of contact by bisection (the tutorial's rule).
    Bisect,
    /// Flies in closed form from impact to impact, each at its own time; misses nothing.
    #[default]
    Exact,
    /// Cuts frames into sub-steps and solves all contacts of each together; for heaps and friction.
    Contact,
}

impl Rule {
    /// The names of all rules in scene files, the default first.
    pub const NAMES: [&str; 4] =
        [Self::Exact.name(), Self::Contact.name(), Self::Bisect.name(), Self::Discrete.name()];

    /// Whether friction acts under it.
    pub const fn has_friction(self) -> bool {
        matches!(self, Self::Exact | Self::Contact)
    }

    /// Returns the name in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Bisect => "bisect",
            Self::Exact => "exact",
            Self::Contact => "contact",
        }
    }
}

impl std::fmt::Display for Rule {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// Law for several impacts at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactLaw {
    /// One pair after the other, as other engines do. Breaks symmetries.
    Sequential,
    /// Newton's law at all contacts at once. Does not pass impacts on.
    Simultaneous,
    /// Generalized reflection. Keeps symmetries and passes impacts on, as Newton's cradle does.
    #[default]
    Reflection,
}

/// Open space or a periodic box.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Boundary {
    /// Open space.
    #[default]
    Open,
    /// A periodic box about the origin; only under the rules `exact` and `contact`.
    Periodic {
        /// Edges, in m, each > 0; `inf` along an open axis.
        size: Vector,
        /// Shear rate, in 1/s: what is above, along y, moves along x with this times the distance. By default 0. Only
        /// under the rules `exact` and `contact`.
        #[serde(default, skip_serializing_if = "is_default")]
        shear_rate: f64,
        /// Whether the velocities of spheres at the start are relative to the mean flow of the shear, which adds its own.
        #[serde(default, skip_serializing_if = "is_default")]
        relative_velocities: bool,
    },
}

/// What changes the velocities of all balls, at times that do not depend on frames.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Thermostat {
    /// Each ball gets a velocity of Maxwell's distribution at random times (Andersen).
    Andersen {
        /// Mean number of these times in a second, in Hz, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        frequency: f64,
        /// Temperature k T, in J, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        temperature: f64,
        /// Seed of the times and velocities. By default 0.
        #[serde(default)]
        seed: u64,
    },
    /// All velocities are scaled so that two thirds of the mean kinetic energy is the temperature.
    Rescale {
        /// Time from one change to the next, in s, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        interval: f64,
        /// Temperature k T, in J, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        temperature: f64,
    },
    /// Random changes of all velocities that keep the momentum: a driven granular gas.
    WhiteNoise {
        /// Time from one change to the next, in s, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        interval: f64,
        /// Variance that each component of a velocity gains in a second, in m2/s3, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        strength: f64,
        /// Seed of the changes. By default 0.
        #[serde(default)]
        seed: u64,
    },
}

/// Potential energy of two balls besides their hard cores.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PairPotential {
    /// A well around each ball; a short one makes sticky balls.
    SquareWell {
        /// Depth of the well, in J; below 0 a shoulder, which repels.
        depth: f64,
        /// Range of the well, between centres, as a multiple of the sum of the radii, from 1.000001 to 100.
        #[schemars(range(min = 1.000001, max = 100.0))]
        range_ratio: f64,
    },
}

/// Parameters of the rule `exact`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Exact {
    /// Law for several impacts at one instant.
    pub impact_law: ImpactLaw,
    /// Shortest duration of a contact, in s, > 0. Bodies that would meet again sooner stay in contact.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub contact_duration: f64,
    /// Most impacts and other work of a sphere in a frame, >= 1. More makes a stepped zone; without zones the step is
    /// refused.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
    /// Whether spheres in contact that take too much work are stepped. By default `automatic`.
    #[serde(skip_serializing_if = "is_default")]
    pub zones: Zones,
    /// Most work of a group of spheres in a tick, in contacts times iterations, >= 1. More makes a stepped zone. By
    /// default 300,000.
    #[schemars(range(min = 1))]
    #[serde(skip_serializing_if = "is_default_zone_budget")]
    pub zone_budget: u32,
    /// Time between two ticks, at which zones are stepped, in s, > 0. Small spheres shorten it, and so do short
    /// frames; long frames lengthen it. By default 1/480.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(skip_serializing_if = "is_default_zone_tick")]
    pub zone_tick: f64,
    /// Time between two force ticks, in s, > 0. Forces on spheres in persistent contact that are not linear, and mutual
    /// gravity of more than 32 spheres, are constant from one to the next. Stiff springs shorten it. By default 1/240.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(skip_serializing_if = "is_default_force_tick")]
    pub force_tick: f64,
}

fn is_default_zone_budget(zone_budget: &u32) -> bool {
    *zone_budget == Exact::default().zone_budget
}

fn is_default_zone_tick(zone_tick: &f64) -> bool {
    *zone_tick == Exact::default().zone_tick
}

fn is_default_force_tick(force_tick: &f64) -> bool {
    *force_tick == Exact::default().force_tick
}

impl Default for Exact {
    fn default() -> Self {
        let carom::Exact {
            contact_duration, max_impacts, zone_budget, zone_tick, force_tick, ..
        } = carom::Exact::default();
        Self {
            impact_law: ImpactLaw::default(),
            contact_duration,
            max_impacts,
            zones: Zones::default(),
            zone_budget,
            zone_tick,
            force_tick,
        }
    }
}

/// Treatment of spheres in contact whose impacts take too much work.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Zones {
    /// They are stepped by sub-steps of `contact` until they come apart.
    #[default]
    Automatic,
    /// Every impact is answered.
    Never,
}

/// Scheme that moves spheres under forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// Velocity first, then position with the new velocity. First order.
    #[default]
    SemiImplicitEuler,
    /// Position with the old velocity, then velocity. First order.
    ExplicitEuler,
    /// Second order.
    VelocityVerlet,
    /// Fourth order.
    #[serde(rename = "runge-kutta-4", alias = "rk4")]
    RungeKutta4,
}

/// Coefficient of a contact from those of its two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CombineRule {
    /// Their product: with a sphere of 1, the collider's value governs.
    #[default]
    Product,
    /// The smaller one.
    Minimum,
    /// The larger one.
    Maximum,
    /// Their mean.
    Average,
    /// The root of their product.
    GeometricMean,
}

/// Parameters of the rule `bisect`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Bisect {
    /// Scheme that moves spheres under forces.
    pub integrator: Integrator,
    /// Distance of surfaces that counts as touching, in m, >= 0.
    #[schemars(range(min = 0.0))]
    pub tolerance: f64,
    /// Halvings of a search for a contact, >= 1.
    #[schemars(range(min = 1))]
    pub max_halvings: u32,
    /// Most impacts of two bodies in a frame, >= 1. After them the rest of the frame is one piece.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
    /// Which spheres a contact winds back.
    pub wind_back: WindBack,
}

impl Default for Bisect {
    fn default() -> Self {
        let carom::Bisect { tolerance, max_halvings, max_impacts, .. } = carom::Bisect::default();
        Self {
            integrator: Integrator::default(),
            tolerance,
            max_halvings,
            max_impacts,
            wind_back: WindBack::default(),
        }
    }
}

/// Which spheres a contact winds back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WindBack {
    /// Spheres of the same island.
    #[default]
    Touched,
    /// All spheres, as the tutorial does; slow for many.
    All,
}

/// Parameters of the rule `discrete`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Discrete {
    /// Scheme that moves spheres under forces.
    pub integrator: Integrator,
}

/// Parameters of the rule `contact`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Contact {
    /// Sub-steps of a frame, >= 1. Overlaps fall with the square of their length.
    #[schemars(range(min = 1))]
    pub sub_steps: u32,
    /// Sweeps over all contacts in a sub-step, >= 1.
    #[schemars(range(min = 1))]
    pub sweeps: u32,
    /// Whether sweeps go on until the solution converges. Slow; for comparison.
    pub converged: bool,
    /// Speed below which a supported ball may fall asleep, as a part of `sqrt(a r)`, >= 0. With 0 none sleeps. By
    /// default 0.02.
    #[schemars(range(min = 0.0))]
    #[serde(skip_serializing_if = "is_default_sleep_speed")]
    pub sleep_speed: f64,
}

fn is_default_sleep_speed(sleep_speed: &f64) -> bool {
    *sleep_speed == Contact::default().sleep_speed
}

impl Default for Contact {
    fn default() -> Self {
        let carom::Contact { sub_steps, sweeps, converged, sleep_speed, .. } =
            carom::Contact::default();
        Self { sub_steps, sweeps, converged, sleep_speed }
    }
}
