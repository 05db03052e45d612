//! How a world is stepped: values chosen per scene.

use glam::DVec3;

use crate::error::InvalidValue;
use crate::integrate::Integrator;
use crate::respond::ImpactLaw;
use crate::rule::Rule;
use crate::validate;

/// How a world is stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The step rule.
    pub rule: Rule,
    /// The integrator that `discrete` and `bisect` move spheres with; `exact` needs none.
    pub integrator: Integrator,
    /// Restitution of a contact, from that of its two bodies.
    pub combine_rule: CombineRule,
    /// Whether spheres collide with one another; colliders they always collide with.
    pub spheres_collide: bool,
    /// How impacts at one instant in one group of touching bodies are answered.
    pub impact_law: ImpactLaw,
    /// What is around the spheres.
    pub boundary: Boundary,
}

/// What is around the spheres, besides colliders.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Boundary {
    /// Nothing: space without end.
    #[default]
    Open,
    /// A box about the origin that repeats itself: what leaves through a face comes in through the
    /// opposite one, and spheres meet across faces. Only under the rule `exact`.
    Periodic {
        /// Edges \[m\], each > 0; infinite along an axis that is open.
        size: DVec3,
    },
}

impl Boundary {
    /// Edges of the periodic box \[m\], infinite along open axes.
    pub(crate) fn period(self) -> DVec3 {
        match self {
            Self::Open => DVec3::INFINITY,
            Self::Periodic { size } => size,
        }
    }
}

impl Default for Settings {
    /// Rule `exact`, impact law `reflection`, product of restitutions, spheres collide, open space.
    fn default() -> Self {
        Self {
            rule: Rule::default(),
            integrator: Integrator::default(),
            combine_rule: CombineRule::default(),
            spheres_collide: true,
            impact_law: ImpactLaw::default(),
            boundary: Boundary::default(),
        }
    }
}

impl Settings {
    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        if let Boundary::Periodic { size } = self.boundary {
            let requirement = "positive along every axis; infinite where it is open";
            validate::require(size.cmpgt(DVec3::ZERO).all(), "size", requirement, size)?;
            let is_exact = matches!(self.rule, Rule::Exact(_));
            let requirement = "used with the rule `exact`: others know no periodic box";
            validate::require(is_exact, "boundary", requirement, "periodic")?;
        }
        match self.rule {
            Rule::Discrete => Ok(()),
            Rule::Exact(parameters) => {
                validate::positive("contact_duration", parameters.contact_duration)?;
                validate::at_least_one("max_impacts", parameters.max_impacts)
            }
            Rule::Bisect(parameters) => {
                validate::non_negative("tolerance", parameters.tolerance)?;
                validate::at_least_one("max_halvings", parameters.max_halvings)?;
                validate::at_least_one("max_impacts", parameters.max_impacts)
            }
        }
    }
}

/// Coefficient of restitution of a contact, from those of the two bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum CombineRule {
    /// `e1 e2`: with a sphere of 1, the collider's value governs.
    #[default]
    Product,
    /// The smaller of the two.
    Minimum,
    /// The larger of the two.
    Maximum,
    /// `(e1 + e2) / 2`.
    Average,
}

impl CombineRule {
    /// Restitution of a contact between bodies of restitution `e1` and `e2`.
    pub fn combine(self, e1: f64, e2: f64) -> f64 {
        match self {
            Self::Product => e1 * e2,
            Self::Minimum => e1.min(e2),
            Self::Maximum => e1.max(e2),
            Self::Average => 0.5 * (e1 + e2),
        }
    }
}
