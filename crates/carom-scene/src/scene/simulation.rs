//! Settings of the simulation.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Vector, is_default};

/// Settings of the simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Simulation {
    /// The step rule.
    pub rule: Rule,
    /// Length of a frame, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub frame_time: f64,
    /// Duration of the scene, in s, > 0: `carom run` runs for this time by default.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub duration: f64,
    /// Whether spheres collide with one another; they always collide with colliders.
    pub spheres_collide: bool,
    /// Restitution of a contact from that of its two bodies.
    pub combine_rule: CombineRule,
    /// Friction of a contact from that of its two bodies.
    #[serde(skip_serializing_if = "is_geometric_mean")]
    pub friction_combine_rule: CombineRule,
    /// Whether spheres may overlap each other or colliders at the start.
    pub allow_overlap: bool,
    /// Boundary of the space.
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

/// Law for simultaneous impacts of spheres that touch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ImpactLaw {
    /// Pair after pair, as in other engines; this breaks symmetries.
    Sequential,
    /// Newton's law of restitution at all contacts at once; impacts are not passed on through a
    /// row.
    Simultaneous,
    /// Generalized reflection: it keeps symmetries, and passes impacts on as Newton's cradle does.
    #[default]
    Reflection,
}

/// Boundary of the space.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Boundary {
    /// No boundary.
    #[default]
    Open,
    /// A periodic box about the origin; only with the rule `exact`.
    Periodic {
        /// Edges, in m, each > 0; `inf` along an open axis.
        size: Vector,
    },
}

/// Parameters of the rule `exact`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Exact {
    /// Law for simultaneous impacts of spheres that touch.
    pub impact_law: ImpactLaw,
    /// Shortest duration of a contact, in s, > 0: bodies that would collide again sooner stay
    /// together.
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
    /// Time between two force ticks, in s, > 0: springs, forces between spheres and other forces
    /// that are not linear are held constant from one tick to the next. It is halved if springs
    /// need it.
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
    /// The spheres are stepped as by the rule `contact`, until they have separated.
    #[default]
    Automatic,
    /// Every impact is answered, whatever work it takes.
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
    /// The square root of their product.
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
    /// Most halvings in the search for a contact, >= 1.
    #[schemars(range(min = 1))]
    pub max_halvings: u32,
    /// Most impacts of two bodies in a frame, >= 1; after them, the rest of the frame is taken in
    /// one step.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
    /// Spheres that are stepped in parts if a contact divides the frame.
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

/// Spheres that are stepped in parts if a contact divides the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WindBack {
    /// Spheres that take part in contacts of the same group.
    #[default]
    Touched,
    /// All spheres, as in the tutorial; slow for many spheres.
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
    /// Sub-steps of a frame, >= 1: overlaps are proportional to the square of their length.
    #[schemars(range(min = 1))]
    pub sub_steps: u32,
    /// Sweeps over all contacts in a sub-step, >= 1.
    #[schemars(range(min = 1))]
    pub sweeps: u32,
    /// Whether sweeps continue until the solution has converged; slow, for comparisons.
    pub converged: bool,
    /// Speed below which a ball that rests on others or carries them may fall asleep, as a fraction
    /// of `sqrt(a r)`, the speed after falling through half its radius, >= 0; with 0 no ball
    /// sleeps.
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
