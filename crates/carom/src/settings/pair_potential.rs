use crate::error::InvalidValue;
use crate::validate;

/// Ranges nearer to 1 would leave no number between contact and the edge of the well.
const SHORTEST_RANGE: f64 = 1.0 + 1e-6;
/// Longer ranges make each sphere a neighbour of all.
const LONGEST_RANGE: f64 = 100.0;

/// Potential energy of two spheres that changes in steps with the distance of their centres, besides the hard cores.
/// Only under the rule `exact`.
///
/// ```
/// use carom::{DVec3, PairPotential, Settings, Sphere, World};
///
/// let well = PairPotential::SquareWell { depth: 1.5, range_ratio: 1.5 };
/// let mut world = World::new(Settings::default().with_pair_potential(Some(well)))?;
/// let (first, second) = (Sphere::new(DVec3::ZERO, 0.5), Sphere::new(DVec3::X * 2.0, 0.5));
/// world.add_sphere(first.with_mass(1.0).with_velocity(DVec3::X))?;
/// world.add_sphere(second.with_mass(1.0).with_velocity(DVec3::NEG_X))?;
/// // They enter the well after 0.25 s: each has 0.5 J, and 0.75 J more then.
/// world.step(0.3)?;
/// assert_eq!(world.potential_energy(), -1.5);
/// assert!((world.kinetic_energy() - 2.5).abs() < 1e-15);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum PairPotential {
    /// A square well around the hard core: the potential energy is `-depth` where two centres are nearer than
    /// `range_ratio` times the sum of the radii, and 0 beyond (Alder and Wainwright, J. Chem. Phys. 31, 459 (1959)).
    /// A range just above 1 makes sticky spheres.
    SquareWell {
        /// Depth of the well \[J\]; < 0 for a shoulder, which repels.
        depth: f64,
        /// Range of the well as a multiple of the sum of the radii, from 1.000001 to 100.
        range_ratio: f64,
    },
}

impl PairPotential {
    /// Distance at which the potential ends, as a multiple of the sum of the radii.
    pub(crate) fn range_ratio(self) -> f64 {
        let Self::SquareWell { range_ratio, .. } = self;
        range_ratio
    }

    pub(super) fn validate(self) -> Result<(), InvalidValue> {
        let Self::SquareWell { depth, range_ratio } = self;
        validate::finite_number("depth", depth)?;
        let is_known = (SHORTEST_RANGE..=LONGEST_RANGE).contains(&range_ratio);
        validate::require(is_known, "range_ratio", "from 1.000001 to 100", range_ratio)
    }
}
