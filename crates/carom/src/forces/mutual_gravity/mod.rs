//! Gravity between spheres.

mod octree;

use glam::{DMat3, DVec3};
use octree::Octree;

use super::derivatives::outer;
use super::{Force, ForceDerivatives, Interaction, LinearForce, SphereState, SphereStates};
use crate::error::InvalidValue;
use crate::parallel;
use crate::sum::Sum;
use crate::validate;

/// Up to this many spheres every pair is summed: a tree gains little there.
const FEW: usize = 1000;

/// Gravity between spheres: on each the sum of `G m1 m2 r / (r² + e²)^(3/2)`, with r to each of the others.
///
/// Up to a thousand spheres, or with an opening angle of 0, that is the sum over all pairs. More are summed
/// by a tree: spheres in a cube that is seen at less than the opening angle count as one at their centre of
/// mass (Barnes and Hut, Nature 324, 446 (1986), with the criterion of Barnes, Computational Astronomy of
/// 1994: the distance is that to the centre of mass, less by how far this is from the middle of the cube).
/// By a tree momentum is kept no longer to round-off, but as well as forces are right.
///
/// The softening e takes the singularity away where spheres pass through each other's centres; spheres that
/// collide need none. A negative constant repels.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MutualGravity {
    /// Gravitational constant G \[m³/(kg s²)\].
    pub constant: f64,
    /// Softening length e \[m\], >= 0.
    pub softening: f64,
    /// Edge of a cube divided by its distance, up to which its spheres count as one, in \[0, 1\].
    pub opening_angle: f64,
}

impl MutualGravity {
    /// Newton's constant \[m³/(kg s²)\], as CODATA recommends it (2018).
    pub const NEWTON: f64 = 6.674_30e-11;

    /// Gravity of this constant \[m³/(kg s²)\], without softening, with an opening angle of 1/2.
    pub fn new(constant: f64) -> Self {
        Self { constant, softening: 0.0, opening_angle: 0.5 }
    }

    /// This gravity with another softening length \[m\].
    pub fn with_softening(self, softening: f64) -> Self {
        Self { softening, ..self }
    }

    /// This gravity with another opening angle; with 0 every pair is summed.
    pub fn with_opening_angle(self, opening_angle: f64) -> Self {
        Self { opening_angle, ..self }
    }

    fn is_direct(&self, count: usize) -> bool {
        count <= FEW || self.opening_angle == 0.0
    }

    /// Computes [`Self::sums`] to the same bits with one evaluation of each pair: faster for a few spheres.
    fn sums_of_few<T: FieldSum>(&self, spheres: &SphereStates) -> Vec<T> {
        let softening = self.softening * self.softening;
        let mut sums = vec![T::default(); spheres.len()];
        for i in 0..spheres.len() {
            for j in i + 1..spheres.len() {
                let offset = spheres.positions[j] - spheres.positions[i];
                let divisor = T::divisor(offset, softening);
                sums[i].add(offset, divisor, spheres.masses[j]);
                sums[j].add(-offset, divisor, spheres.masses[i]);
            }
        }
        sums
    }

    /// The sum over all other spheres at each sphere, in the order of the arrays.
    fn sums<T: FieldSum>(&self, spheres: &SphereStates) -> Vec<T> {
        if spheres.len() <= FEW {
            return self.sums_of_few(spheres);
        }
        let softening = self.softening * self.softening;
        if self.is_direct(spheres.len()) {
            return parallel::map(spheres.len(), |_: &mut (), i| {
                let mut sum = T::default();
                for j in (0..spheres.len()).filter(|&j| j != i) {
                    let offset = spheres.positions[j] - spheres.positions[i];
                    sum.add(offset, T::divisor(offset, softening), spheres.masses[j]);
                }
                sum
            });
        }
        let tree = Octree::new(spheres.positions, spheres.masses);
        parallel::map(spheres.len(), |_: &mut (), i| {
            let mut sum = T::default();
            tree.visit(i, spheres.positions[i], self.opening_angle, |offset, mass| {
                sum.add(offset, T::divisor(offset, softening), mass);
            });
            sum
        })
    }
}

impl Force for MutualGravity {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        DVec3::ZERO
    }

    /// Nothing acts on a sphere by itself.
    fn linear(&self, _radius: f64, _mass: f64) -> Option<LinearForce> {
        Some(LinearForce { acceleration: DVec3::ZERO, drag_rate: 0.0 })
    }

    fn derivatives(&self, _sphere: &SphereState, _time: f64) -> Option<ForceDerivatives> {
        Some(ForceDerivatives::ZERO)
    }

    fn interaction(&self) -> Option<&dyn Interaction> {
        Some(self)
    }

    fn is_conservative(&self) -> bool {
        true
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        validate::finite_number("constant", self.constant)?;
        validate::non_negative("softening", self.softening)?;
        validate::unit_interval("opening_angle", self.opening_angle)
    }
}

impl Interaction for MutualGravity {
    fn add_forces(&self, spheres: &SphereStates, _time: f64, forces: &mut [DVec3]) {
        let fields: Vec<Field> = self.sums(spheres);
        for (i, Field(field)) in fields.into_iter().enumerate() {
            forces[i] += (self.constant * spheres.masses[i]) * field;
        }
    }

    /// `-G m1 m2 / sqrt(r² + e²)`, summed over all pairs as the forces are.
    fn potential_energy(&self, spheres: &SphereStates, _time: f64) -> f64 {
        let potentials: Vec<Potential> = self.sums(spheres);
        let terms = potentials.iter().zip(spheres.masses).map(|(it, mass)| mass * it.0);
        -0.5 * self.constant * terms.collect::<Sum>().value()
    }

    fn add_derivatives(
        &self,
        spheres: &SphereStates,
        _time: f64,
        add: &mut dyn FnMut([usize; 2], &ForceDerivatives),
    ) -> bool {
        if !self.is_direct(spheres.len()) {
            return false;
        }
        let softening = self.softening * self.softening;
        for i in 0..spheres.len() {
            for j in (0..spheres.len()).filter(|&j| j != i) {
                let offset = spheres.positions[j] - spheres.positions[i];
                let [own, other] = [i, j].map(|sphere| spheres.masses[sphere]);
                let field = self.constant / Field::divisor(offset, softening) * offset;
                let square = offset.length_squared() + softening;
                let stretch = DMat3::IDENTITY - outer(3.0 / square * offset, offset);
                let by_other = self.constant * own * other / (square * square.sqrt()) * stretch;
                let of = |by_position, by_mass| ForceDerivatives {
                    by_position,
                    by_mass,
                    ..ForceDerivatives::ZERO
                };
                add([i, i], &of(-by_other, other * field));
                add([i, j], &of(by_other, own * field));
            }
        }
        true
    }

    fn depends_on_velocity(&self) -> bool {
        false
    }

    /// The sum over all images of a box has no end.
    fn suits_periodic_box(&self) -> bool {
        false
    }
}

/// A sum over masses at a place.
trait FieldSum: Default + Clone + Send {
    /// Divisor of a mass at an offset \[m\], with the square of the softening length \[m²\].
    fn divisor(offset: DVec3, softening: f64) -> f64;

    /// Adds a mass \[kg\] at an offset \[m\] by its divisor.
    fn add(&mut self, offset: DVec3, divisor: f64, mass: f64);
}

/// Sum of `m r / (r² + e²)^(3/2)` \[kg/m²\].
#[derive(Default, Clone)]
struct Field(DVec3);

/// Sum of `m / sqrt(r² + e²)` \[kg/m\].
#[derive(Default, Clone)]
struct Potential(f64);

impl FieldSum for Field {
    #[inline]
    fn divisor(offset: DVec3, softening: f64) -> f64 {
        let square = offset.length_squared() + softening;
        // Two spheres in one point exert no force.
        if square > 0.0 { square * square.sqrt() } else { f64::INFINITY }
    }

    #[inline]
    fn add(&mut self, offset: DVec3, divisor: f64, mass: f64) {
        self.0 += mass / divisor * offset;
    }
}

impl FieldSum for Potential {
    #[inline]
    fn divisor(offset: DVec3, softening: f64) -> f64 {
        (offset.length_squared() + softening).sqrt()
    }

    #[inline]
    fn add(&mut self, _offset: DVec3, divisor: f64, mass: f64) {
        self.0 += mass / divisor;
    }
}
