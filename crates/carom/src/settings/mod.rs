//! How a world is stepped: plain values, chosen for each scene. `rule`, `integrate` and `respond` have their
//! effects.

mod bisect;
mod boundary;
mod combine_rule;
mod contact;
mod discrete;
mod exact;
mod impact_law;
mod integrator;
mod pair_potential;
mod rule;
mod thermostat;
mod zones;

pub use bisect::{Bisect, WindBack};
pub use boundary::Boundary;
pub(crate) use boundary::nearest_image;
pub use combine_rule::CombineRule;
pub use contact::Contact;
pub use discrete::Discrete;
pub use exact::Exact;
pub use impact_law::ImpactLaw;
pub use integrator::Integrator;
pub use pair_potential::PairPotential;
pub use rule::Rule;
pub use thermostat::Thermostat;
pub use zones::Zones;

use crate::error::InvalidValue;
use crate::validate;

/// Settings of a world.
///
/// Values that only one rule reads are parameters of that [`Rule`]. The others describe the world itself, or hold
/// under every rule.
///
/// ```
/// use carom::{CombineRule, Exact, Rule, Settings, World};
///
/// let settings = Settings::default()
///     .with_rule(Exact::default().with_max_impacts(10_000))
///     .with_combine_rule(CombineRule::Minimum);
/// let world = World::new(settings)?;
/// assert!(matches!(world.settings().rule, Rule::Exact(exact) if exact.max_impacts == 10_000));
/// assert!(World::new(settings.with_rule(Exact::default().with_max_impacts(0))).is_err());
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Settings {
    /// The step rule, with its parameters.
    pub rule: Rule,
    /// Number of dimensions, 2 or 3. With 2 the spheres are discs in the plane z = 0, and temperatures, stresses and
    /// packing fractions are those of the plane; a sphere that leaves it is refused.
    pub dimensions: u32,
    /// Restitution of a contact, from that of its two bodies.
    pub combine_rule: CombineRule,
    /// Friction of a contact, from that of its two bodies; each coefficient separately.
    pub friction_combine_rule: CombineRule,
    /// Whether spheres collide with one another. They always collide with colliders.
    pub spheres_collide: bool,
    /// The boundary of space. It is part of the world, as its colliders are, and not of the rule, although
    /// `discrete` and `bisect` have no periodic box.
    pub boundary: Boundary,
    /// Shear rate of the periodic box \[1/s\]: its images above and below, along y, move along x with this times their
    /// distance, and so does the mean flow (Lees and Edwards, J. Phys. C 5, 1921 (1972)). Zero: no shear. Only under
    /// the rules `exact` and `contact`, in a box with finite edges along x and y.
    pub shear_rate: f64,
    /// The thermostat, if there is one. Only under the rule `exact`.
    pub thermostat: Option<Thermostat>,
    /// Potential energy between spheres besides their hard cores, if there is some. Only under the rule `exact`.
    pub pair_potential: Option<PairPotential>,
}

impl Default for Settings {
    /// Rule `exact`, three dimensions, product of restitutions, geometric mean of frictions, spheres collide, open space, no shear, no thermostat, no
    /// pair potential.
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            dimensions: 3,
            combine_rule: CombineRule::default(),
            friction_combine_rule: CombineRule::GeometricMean,
            spheres_collide: true,
            boundary: Boundary::default(),
            shear_rate: 0.0,
            thermostat: None,
            pair_potential: None,
        }
    }
}

impl Settings {
    /// Returns the settings with this rule, or the rule of these parameters.
    pub fn with_rule(self, rule: impl Into<Rule>) -> Self {
        Self { rule: rule.into(), ..self }
    }

    /// Returns the settings in 2 or 3 dimensions.
    pub fn with_dimensions(self, dimensions: u32) -> Self {
        Self { dimensions, ..self }
    }

    /// Returns the settings with this rule for the restitution of a contact.
    pub fn with_combine_rule(self, combine_rule: CombineRule) -> Self {
        Self { combine_rule, ..self }
    }

    /// Returns the settings with this rule for the friction of a contact.
    pub fn with_friction_combine_rule(self, friction_combine_rule: CombineRule) -> Self {
        Self { friction_combine_rule, ..self }
    }

    /// Returns the settings, with or without collisions between spheres.
    pub fn with_spheres_collide(self, spheres_collide: bool) -> Self {
        Self { spheres_collide, ..self }
    }

    /// Returns the settings with this boundary.
    pub fn with_boundary(self, boundary: Boundary) -> Self {
        Self { boundary, ..self }
    }

    /// Returns the settings with this shear rate of the periodic box \[1/s\].
    pub fn with_shear_rate(self, shear_rate: f64) -> Self {
        Self { shear_rate, ..self }
    }

    /// Returns the settings with this thermostat, or without one.
    pub fn with_thermostat(self, thermostat: Option<Thermostat>) -> Self {
        Self { thermostat, ..self }
    }

    /// Returns the settings with this potential between spheres, or without one.
    pub fn with_pair_potential(self, pair_potential: Option<PairPotential>) -> Self {
        Self { pair_potential, ..self }
    }

    /// Returns an error for invalid parameters of the rule, or for a boundary, thermostat or pair potential that the rule
    /// does not have.
    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        self.boundary.validate()?;
        let is_known = matches!(self.dimensions, 2 | 3);
        validate::require(is_known, "dimensions", "2 or 3", self.dimensions)?;
        let is_flat = self.dimensions == 3 || self.boundary.period().z == f64::INFINITY;
        let requirement = "infinite along z in two dimensions";
        validate::require(is_flat, "size", requirement, self.boundary.period())?;
        if self.boundary != Boundary::Open {
            let is_known = matches!(self.rule, Rule::Exact(_) | Rule::Contact(_));
            let requirement = "open under rules other than `exact` and `contact`";
            validate::require(is_known, "boundary", requirement, "periodic")?;
        }
        self.validate_shear()?;
        if let Some(thermostat) = self.thermostat {
            let is_known = matches!(self.rule, Rule::Exact(_));
            let requirement = "left out under rules other than `exact`";
            validate::require(is_known, "thermostat", requirement, "given")?;
            thermostat.validate()?;
        }
        self.validate_pair_potential()?;
        match self.rule {
            Rule::Discrete(_) => Ok(()),
            Rule::Bisect(parameters) => parameters.validate(),
            Rule::Exact(parameters) => parameters.validate(),
            Rule::Contact(parameters) => parameters.validate(),
        }
    }

    /// Returns an error for a potential between spheres with invalid parameters, or that the rule does not have.
    fn validate_pair_potential(&self) -> Result<(), InvalidValue> {
        let Some(potential) = self.pair_potential else { return Ok(()) };
        let is_known = matches!(self.rule, Rule::Exact(_));
        let requirement = "left out under rules other than `exact`";
        validate::require(is_known, "pair_potential", requirement, "given")?;
        let requirement = "left out where spheres do not collide";
        validate::require(self.spheres_collide, "pair_potential", requirement, "given")?;
        potential.validate()
    }

    /// Returns an error for a shear rate that is not a number, or where no box can be sheared.
    fn validate_shear(&self) -> Result<(), InvalidValue> {
        let (rate, size) = (self.shear_rate, self.boundary.period());
        validate::finite_number("shear_rate", rate)?;
        let is_known = matches!(self.rule, Rule::Exact(_) | Rule::Contact(_));
        let requirement = "zero under rules other than `exact` and `contact`";
        validate::require(rate == 0.0 || is_known, "shear_rate", requirement, rate)?;
        let is_closed = size.x.is_finite() && size.y.is_finite();
        let requirement = "zero without a periodic box with finite edges along x and y";
        validate::require(rate == 0.0 || is_closed, "shear_rate", requirement, rate)
    }
}
