//! What a scene file says: one type per table of the file.
//!
//! The doc comments here are the descriptions in the JSON Schema that editors show.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Three numbers x, y, z.
pub type Vector = [f64; 3];
/// A rotation as a quaternion x, y, z, w; any length but zero.
pub type Quaternion = [f64; 4];
/// Red, green, blue, each in [0, 1] (sRGB).
pub type Color = [f64; 3];

/// A Carom scene: spheres, what acts on them, what they bounce off, and how to look at it.
/// Right-handed frame, y up, SI units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Short name, as typed on the command line.
    pub name: String,
    /// Name as shown to people; the scene is found by it too.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// What there is to see, in a sentence or two.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Where the scene comes from.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub origin: String,
    /// How the scene is stepped.
    #[serde(default)]
    pub simulation: Simulation,
    /// Forces on every sphere; they add up.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forces: Vec<Force>,
    /// Single spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub spheres: Vec<Sphere>,
    /// Rows, lattices and random fillings of spheres, placed after the single ones.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub generators: Vec<Generator>,
    /// Fixed shapes, in the order in which the rule `discrete` looks at them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub colliders: Vec<Collider>,
    /// Sources of spheres.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub emitters: Vec<Emitter>,
    /// Where to look from; fitted to the scene where it is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub camera: Option<Camera>,
    /// The light.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sun: Option<Sun>,
    /// Colours of what has none of its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colors: Option<Colors>,
}

impl Scene {
    /// An empty scene of this name, to be filled by code.
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            title: String::new(),
            description: String::new(),
            origin: String::new(),
            simulation: Simulation::default(),
            forces: Vec::new(),
            spheres: Vec::new(),
            generators: Vec::new(),
            colliders: Vec::new(),
            emitters: Vec::new(),
            camera: None,
            sun: None,
            colors: None,
        }
    }
}

/// How a scene is stepped.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Simulation {
    /// The step rule.
    pub rule: Rule,
    /// Length of a frame, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub frame_time: f64,
    /// Time worth watching, in s, > 0: what `carom run` takes unless told.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub duration: f64,
    /// Whether spheres collide with one another; with colliders they always do.
    pub spheres_collide: bool,
    /// Restitution of a contact from that of its two bodies.
    pub combine_rule: CombineRule,
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
}

impl Default for Simulation {
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            frame_time: 1.0 / 60.0,
            duration: 10.0,
            spheres_collide: true,
            combine_rule: CombineRule::default(),
            allow_overlap: false,
            boundary: Boundary::default(),
            exact: Exact::default(),
            bisect: Bisect::default(),
            discrete: Discrete::default(),
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
}

impl Rule {
    /// The names of all rules in scene files, the default first.
    pub const NAMES: [&str; 3] = [Self::Exact.name(), Self::Bisect.name(), Self::Discrete.name()];

    /// Its name in scene files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Discrete => "discrete",
            Self::Bisect => "bisect",
            Self::Exact => "exact",
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
    /// Impacts and other work per sphere in a frame, >= 1; more is refused.
    #[schemars(range(min = 1))]
    pub max_impacts: u32,
}

impl Default for Exact {
    fn default() -> Self {
        let carom::Exact { contact_duration, max_impacts, .. } = carom::Exact::default();
        Self { impact_law: ImpactLaw::default(), contact_duration, max_impacts }
    }
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

/// Restitution of a contact from that of its two bodies.
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

/// A force on every sphere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Force {
    /// The same force on every sphere, whatever its mass.
    Constant {
        /// In N.
        force: Vector,
    },
    /// The same acceleration for every sphere.
    Gravity {
        /// In m/s².
        acceleration: Vector,
    },
    /// Drag against the velocity and proportional to it.
    ViscousDrag {
        /// In kg/s, >= 0
        #[schemars(range(min = 0.0))]
        coefficient: f64,
    },
}

/// A sphere, or what the spheres of a generator or an emitter have in common.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend(
    "oneOf" = [{ "required": ["radius"] }, { "required": ["diameter"] }],
    "not" = { "required": ["mass", "density"] }
))]
pub struct Sphere {
    /// Centre, in m; in a generator or an emitter an offset from the place it gives.
    #[serde(default)]
    pub position: Vector,
    /// Velocity, in m/s; in an emitter in the emitter's frame.
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
    /// Mass, in kg, > 0; 1 unless this or `density` is given.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mass: Option<f64>,
    /// Density, in kg/m³, > 0, instead of `mass`.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default = "one")]
    pub restitution: f64,
    /// Colour; by density or the scene's own where it is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

impl Sphere {
    /// A sphere at rest at a place \[m\], of 1 kg.
    pub fn at(position: Vector, radius: f64) -> Self {
        Self {
            position,
            velocity: [0.0; 3],
            radius: Some(radius),
            diameter: None,
            mass: None,
            density: None,
            restitution: 1.0,
            color: None,
        }
    }
}

fn one() -> f64 {
    1.0
}

fn yes() -> bool {
    true
}

fn is_true(value: &bool) -> bool {
    *value
}

fn is_false(value: &bool) -> bool {
    !*value
}

/// Places for many spheres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Generator {
    /// Spheres one after the other along a line.
    Row {
        /// How many, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Centre of the first, in m.
        start: Vector,
        /// From each centre to the next, in m.
        step: Vector,
        /// What they have in common.
        sphere: Sphere,
    },
    /// Spheres on a box-shaped lattice; x runs fastest, then y, then z.
    Lattice {
        /// How many along x, y and z, each >= 1.
        counts: [u32; 3],
        /// Centre of the first, in m.
        start: Vector,
        /// Distance of neighbours along x, y and z, in m.
        spacing: Vector,
        /// What they have in common.
        sphere: Sphere,
    },
    /// Spheres scattered in a box, none overlapping another sphere or a collider.
    Random {
        /// How many, >= 1.
        #[schemars(range(min = 1))]
        count: u32,
        /// Lower corner of the box that holds the whole spheres, in m.
        min: Vector,
        /// Upper corner of the box, in m.
        max: Vector,
        /// The same seed gives the same scene.
        seed: u32,
        /// Speed, in m/s, >= 0, in a random direction, on top of the common velocity.
        #[schemars(range(min = 0.0))]
        #[serde(default)]
        speed: f64,
        /// Smallest and largest radius, in m, evenly distributed, instead of the common one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        radius_range: Option<[f64; 2]>,
        /// What they have in common.
        sphere: Sphere,
    },
}

/// A fixed shape that spheres bounce off.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Collider {
    /// What it is called.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Its form.
    pub shape: Shape,
    /// Where its centre is, in m.
    #[serde(default)]
    pub position: Vector,
    /// How it is turned.
    #[serde(default = "unturned")]
    pub rotation: Quaternion,
    /// How fast its centre moves, in m/s.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub velocity: Vector,
    /// How fast it turns about its centre, along the axis, in rad/s.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub angular_velocity: Vector,
    /// Coefficient of restitution in [0, 1].
    #[schemars(range(min = 0.0, max = 1.0))]
    #[serde(default = "one")]
    pub restitution: f64,
    /// A trigger reports contact and deflects nothing.
    #[serde(default, skip_serializing_if = "is_false")]
    pub trigger: bool,
    /// Whether it is drawn.
    #[serde(default = "yes", skip_serializing_if = "is_true")]
    pub visible: bool,
    /// Its colour; the scene's own for surfaces where it is missing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
}

fn is_zero(vector: &Vector) -> bool {
    *vector == [0.0; 3]
}

fn unturned() -> Quaternion {
    [0.0, 0.0, 0.0, 1.0]
}

/// Form of a collider in its own frame.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Shape {
    /// A sphere.
    Sphere {
        /// In m, > 0
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        radius: f64,
    },
    /// A rectangle in its local xz plane that faces local +y; from behind spheres pass it.
    Rectangle {
        /// Full length along local x, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_x: f64,
        /// Full length along local z, in m, > 0.
        #[schemars(extend("exclusiveMinimum" = 0.0))]
        size_z: f64,
    },
    /// Everything below the local xz plane.
    HalfSpace,
    /// A box of six rectangles that face outward.
    Box {
        /// Full lengths along local x, y, z, in m, each > 0.
        size: Vector,
    },
}

/// Emits a sphere at the times 0, period, 2 period, ...
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Emitter {
    /// What it is called.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub name: String,
    /// Where spheres appear, in m.
    #[serde(default)]
    pub position: Vector,
    /// How the emitter, and with it the velocity of its spheres, is turned.
    #[serde(default = "unturned")]
    pub rotation: Quaternion,
    /// Time between two spheres, in s, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub period: f64,
    /// With this many of its spheres alive, the oldest makes place; no limit where it is missing.
    #[schemars(range(min = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_spheres: Option<u32>,
    /// What is emitted.
    pub sphere: Sphere,
}

/// Where to look from. The camera looks along its local -z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// In m.
    pub position: Vector,
    /// Rotation of the camera.
    #[serde(default = "unturned")]
    pub rotation: Quaternion,
    /// Vertical field of view, in degrees, in (0, 180).
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 180.0))]
    #[serde(default = "sixty")]
    pub vertical_fov_degrees: f64,
    /// Nearest distance drawn, in m, > 0.
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    #[serde(default = "near")]
    pub near: f64,
    /// Farthest distance drawn, in m, > near.
    #[serde(default = "far")]
    pub far: f64,
}

fn sixty() -> f64 {
    60.0
}

fn near() -> f64 {
    0.3
}

fn far() -> f64 {
    1000.0
}

/// The light. It travels along its local -z.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sun {
    /// Rotation of the light.
    pub rotation: Quaternion,
    /// Colour of the light.
    pub color: Color,
    /// Brightness, >= 0; 1 is plain daylight.
    #[schemars(range(min = 0.0))]
    #[serde(default = "one")]
    pub intensity: f64,
}

/// Colours of what has none of its own.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Colors {
    /// Behind everything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub background: Option<Color>,
    /// Colliders.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colliders: Option<Color>,
    /// Spheres whose density is not listed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spheres: Option<Color>,
    /// Spheres by their density.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub densities: Vec<DensityColor>,
}

/// The colour of spheres of one density.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DensityColor {
    /// In kg/m³, > 0
    #[schemars(extend("exclusiveMinimum" = 0.0))]
    pub density: f64,
    /// Their colour.
    pub color: Color,
}
