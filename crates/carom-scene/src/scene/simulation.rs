//! Settings of the simulation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Vector, is_default};

/// How a scene is stepped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Simulation {
    /// The step rule.
    pub rule: Rule,
    /// Length of a frame, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub frame_time: f64,
    /// Time worth watching, in s, > 0: what `carom run` takes by default.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub duration: f64,
    /// Whether spheres collide with one another; with colliders they always do.
    pub spheres_collide: bool,
    /// Restitution of a contact from that of its two bodies.
    pub combine_rule: CombineRule,
    /// Friction of a contact from that of its two bodies.
    #[serde(skip_serializing_if = "is_geometric_mean")]
    pub friction_combine_rule: CombineRule,
    /// Whether spheres may overlap each other or colliders at the start.
    pub allow_overlap: bool,
    /// What is around the spheres, besides colliders.
    pub boundary: Boundary,
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

fn is_geometric_mean(rule: &CombineRule) -> bool {
    *rule == CombineRule::GeometricMean
}

impl Default for Simulation {
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            frame_time: 1.0 / 60.0,
            duration: 10.0,
            spheres_collide: true,
            combine_rule: CombineRule::default(),
            friction_combine_rule: CombineRule::GeometricMean,
            allow_overlap: false,
            boundary: Boundary::default(),
            exact: Exact::default(),
            bisect: Bisect::default(),
            discrete: Discrete::default(),
            contact: Contact::default(),
        }
    }
}

/// A step rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// Move every sphere by the frame, then answer what overlaps (the course's rule).
    Discrete,
    /// Wind back what intersects and find the time of contact by bisection (the tutorial's rule).
    Bisect,
    /// Fly in closed form from impact to impact, each at its own time: nothing is missed.
    #[default]
    Exact,
    /// Cut frames into sub-steps and solve all contacts of each together: for heaps and friction.
    Contact,
}

impl Rule {
    /// The names of all rules in scene files, the default first.
    pub const NAMES: [&str; 4] =
        [Self::Exact.name(), Self::Contact.name(), Self::Bisect.name(), Self::Discrete.name()];

    /// Whether friction acts under this rule.
    pub const fn has_friction(self) -> bool {
        matches!(self, Self::Exact | Self::Contact)
    }

    /// Name of the rule in scene files.
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

/// How impacts at one instant among spheres that touch are answered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactLaw {
    /// Pair after pair, as other engines do; it breaks symmetries.
    Sequential,
    /// Newton's law of restitution at all contacts at once; it does not pass impacts on.
    Simultaneous,
    /// Generalized reflection: keeps symmetries, and passes impacts on as Newton's cradle does.
    #[default]
    Reflection,
}

/// What is around the spheres, besides colliders.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Boundary {
    /// Nothing.
    #[default]
    Open,
    /// A box about the origin that repeats itself without end; only with the rule `exact`.
    Periodic {
        /// Edges, in m, each > 0; `inf` along an axis that is open.
        size: Vector,
    },
}

/// Parameters of the rule `exact`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Exact {
    /// How impacts at one instant among spheres that touch are answered.
    pub impact_law: ImpactLaw,
    /// How long a contact lasts at least, in s, > 0: bodies that would meet again sooner stay together.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub contact_duration: f64,
    /// Most impacts and other work per sphere in a frame, >= 1: above it, the spheres become a
    /// stepped zone or, without zones, the step is refused.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
    /// Whether spheres in contact that take too much work are stepped.
    #[serde(skip_serializing_if = "is_default")]
    pub zones: Zones,
    /// Most work of a group of spheres in a tick, in contacts times iterations, >= 1: above it, the
    /// group becomes a stepped zone.
    #[schemars(range(min = 1))]
    #[serde(skip_serializing_if = "is_default_zone_budget")]
    pub zone_budget: u32,
    /// Time between two ticks, at which zones are stepped, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(skip_serializing_if = "is_default_zone_tick")]
    pub zone_tick: f64,
    /// Time between two force ticks, in s, > 0: springs, forces between spheres and others that are not linear
    /// are held constant from one to the next. It is halved where springs need it.
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
    /// They are stepped as by the rule `contact`, until they have come apart.
    #[default]
    Automatic,
    /// Every impact is answered, whatever it takes.
    Never,
}

/// How spheres move under forces.
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
    /// How spheres move under forces.
    pub integrator: Integrator,
    /// Distance of surfaces that counts as touching, in m, >= 0.
    #[schemars(range(min = 0.0))]
    pub tolerance: f64,
    /// Halvings in search of a contact, >= 1.
    #[schemars(range(min = 1))]
    pub max_halvings: u32,
    /// How often two bodies may meet in a frame, >= 1; then the rest of it is taken in one piece.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
    /// Which spheres go through the pieces into which a contact cuts the frame.
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

/// Which spheres go through the pieces into which a contact cuts the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WindBack {
    /// Those that take part in contacts of the same group.
    #[default]
    Touched,
    /// All, as the tutorial does; slow for many spheres.
    All,
}

/// Parameters of the rule `discrete`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Discrete {
    /// How spheres move under forces.
    pub integrator: Integrator,
}

/// Parameters of the rule `contact`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Contact {
    /// Sub-steps of a frame, >= 1: overlaps fall with the square of their length.
    #[schemars(range(min = 1))]
    pub sub_steps: u32,
    /// Sweeps over all contacts in a sub-step, >= 1.
    #[schemars(range(min = 1))]
    pub sweeps: u32,
    /// Whether sweeps go on until the solution has converged: slow, to compare with.
    pub converged: bool,
    /// Speed below which a ball that bears or is borne may fall asleep, as a part of `sqrt(a r)`, the speed after
    /// falling through half its radius, >= 0; with 0 none sleeps.
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
