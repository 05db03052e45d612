//! Fields of accelerations, in which spheres move from the state at the beginning of a step.

use glam::DVec3;

use super::radau_tables::Gains;
use crate::polynomial_flight::TERMS;

/// Spheres at the beginning of a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Start<'a> {
    /// \[m\]
    pub positions: &'a [DVec3],
    /// \[m/s\]
    pub velocities: &'a [DVec3],
    /// Parts of both below their rounding.
    pub carried: &'a [[DVec3; 2]],
    /// Start of the step, on the world's clock \[s\].
    pub time: f64,
    /// When the step has to end at the latest \[s\].
    pub until: f64,
    /// Where forces are steady, steps are at most this long \[s\].
    pub steady: f64,
    /// Where forces are rough, steps are at most this long \[s\].
    pub rough: f64,
}

impl Start<'_> {
    /// Returns the position and the velocity of a sphere at a part `s` of a step of some length \[s\] under an
    /// acceleration that is a sum of powers of that part. `gains` are the contributions of the powers there.
    pub(super) fn state_at(
        &self,
        sphere: usize,
        (s, length): (f64, f64),
        (powers, gains): (&[DVec3; TERMS], &Gains),
    ) -> [DVec3; 2] {
        let t = s * length;
        let (mut way, mut change) = (DVec3::ZERO, DVec3::ZERO);
        for (&c, [of_way, of_change]) in powers.iter().zip(gains).rev() {
            way += c * *of_way;
            change += c * *of_change;
        }
        let velocity = self.velocities[sphere];
        let [left, left_velocity] = self.carried[sphere];
        let way = left + t * (velocity + (left_velocity + t * way));
        [self.positions[sphere] + way, velocity + (left_velocity + t * change)]
    }
}

/// Accelerations of some spheres \[m/s²\], and the sum of the sizes of their terms, at a time \[s\] with these
/// positions \[m\] and velocities \[m/s\].
pub(crate) trait Field {
    fn evaluate(&mut self, time: f64, positions: &[DVec3], velocities: &[DVec3], at: &mut Values);

    /// The same without what contacts add. Friction stops a slip, however small, and no longer acts then; forces damp
    /// motion at a rate.
    fn evaluate_forces(
        &mut self,
        time: f64,
        positions: &[DVec3],
        velocities: &[DVec3],
        at: &mut Values,
    ) {
        self.evaluate(time, positions, velocities, at);
    }
}

/// What a [`Field`] finds.
#[derive(Debug, Clone, Default)]
pub(crate) struct Values {
    /// \[m/s²\]
    pub accelerations: Vec<DVec3>,
    /// Sums of the sizes of what each is the sum of \[m/s²\].
    pub sizes: Vec<f64>,
}

impl Values {
    /// Zeros for this many spheres.
    pub fn of(count: usize) -> Self {
        Self { accelerations: vec![DVec3::ZERO; count], sizes: vec![0.0; count] }
    }

    pub fn is_finite(&self) -> bool {
        self.accelerations.iter().all(|it| it.is_finite())
    }
}
