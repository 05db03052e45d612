//! Quantities of spheres that Python sees as arrays.

use carom::{DQuat, Friction, SOLID_BALL, Spheres};

/// A quantity that all spheres have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    Positions,
    Velocities,
    Radii,
    Masses,
    Restitutions,
    AppliedForces,
    Orientations,
    AngularVelocities,
    InertiaFactors,
    Frictions,
    RollingFrictions,
    SpinningFrictions,
    TangentialRestitutions,
}

/// A quantity and its values, one sphere after another.
pub type Column = (Quantity, Vec<f64>);

impl Quantity {
    pub const ALL: [Self; 13] = [
        Self::Positions,
        Self::Velocities,
        Self::Radii,
        Self::Masses,
        Self::Restitutions,
        Self::AppliedForces,
        Self::Orientations,
        Self::AngularVelocities,
        Self::InertiaFactors,
        Self::Frictions,
        Self::RollingFrictions,
        Self::SpinningFrictions,
        Self::TangentialRestitutions,
    ];

    /// Quantities that a frame changes.
    pub const MOTION: [Self; 4] =
        [Self::Positions, Self::Velocities, Self::Orientations, Self::AngularVelocities];
    /// Quantities that new spheres can get from arrays.
    pub const OF_A_SPHERE: [Self; 12] = [
        Self::Positions,
        Self::Velocities,
        Self::Radii,
        Self::Masses,
        Self::Restitutions,
        Self::Orientations,
        Self::AngularVelocities,
        Self::InertiaFactors,
        Self::Frictions,
        Self::RollingFrictions,
        Self::SpinningFrictions,
        Self::TangentialRestitutions,
    ];

    /// Returns the name in Python.
    pub fn name(self) -> &'static str {
        match self {
            Self::Positions => "positions",
            Self::Velocities => "velocities",
            Self::Radii => "radii",
            Self::Masses => "masses",
            Self::Restitutions => "restitutions",
            Self::AppliedForces => "applied_forces",
            Self::Orientations => "orientations",
            Self::AngularVelocities => "angular_velocities",
            Self::InertiaFactors => "inertia_factors",
            Self::Frictions => "frictions",
            Self::RollingFrictions => "rolling_frictions",
            Self::SpinningFrictions => "spinning_frictions",
            Self::TangentialRestitutions => "tangential_restitutions",
        }
    }

    /// Returns the number of values per sphere.
    pub fn width(self) -> usize {
        match self {
            Self::Positions | Self::Velocities => 3,
            Self::AppliedForces | Self::AngularVelocities => 3,
            Self::Orientations => 4,
            Self::Radii | Self::Masses | Self::Restitutions => 1,
            Self::InertiaFactors | Self::Frictions | Self::RollingFrictions => 1,
            Self::SpinningFrictions | Self::TangentialRestitutions => 1,
        }
    }

    /// Returns whether a world can refuse finite values; then values set before must be undone.
    pub fn is_bounded(self) -> bool {
        matches!(self, Self::Orientations) || self.width() == 1
    }

    /// Returns whether a value is valid apart from bounds: it is finite, or NaN for a sphere
    /// without its own friction.
    pub fn may_be(self, value: f64) -> bool {
        let is_friction = self.coefficient(&mut Friction::default()).is_some();
        value.is_finite() || (is_friction && value.is_nan())
    }

    /// Returns the coefficient of friction for this quantity, if it is one.
    pub fn coefficient(self, friction: &mut Friction) -> Option<&mut Option<f64>> {
        match self {
            Self::Frictions => Some(&mut friction.sliding),
            Self::RollingFrictions => Some(&mut friction.rolling),
            Self::SpinningFrictions => Some(&mut friction.spinning),
            Self::TangentialRestitutions => Some(&mut friction.tangential_restitution),
            _ => None,
        }
    }

    /// Returns the values of the sphere in a row.
    pub fn row(self, values: &[f64], row: usize) -> &[f64] {
        &values[row * self.width()..(row + 1) * self.width()]
    }

    /// Returns the shape of the array for `count` spheres.
    pub fn shape(self, count: usize) -> Vec<usize> {
        match self.width() {
            1 => vec![count],
            width => vec![count, width],
        }
    }

    /// Writes the values of all spheres, one after another.
    pub fn write(self, spheres: &Spheres, place: &mut [f64]) {
        let vectors = match self {
            Self::Positions => spheres.positions(),
            Self::Velocities => spheres.velocities(),
            Self::AppliedForces => match spheres.applied_forces() {
                // No sphere has one.
                [] => return place.fill(0.0),
                forces => forces,
            },
            Self::AngularVelocities => match spheres.angular_velocities() {
                // No sphere ever rotated.
                [] => return place.fill(0.0),
                angular_velocities => angular_velocities,
            },
            Self::Orientations => return write_orientations(spheres.orientations(), place),
            Self::Radii => return write_numbers(spheres.radii(), place),
            Self::Masses => return write_numbers(spheres.masses(), place),
            Self::Restitutions => return write_numbers(spheres.restitutions(), place),
            Self::InertiaFactors => {
                // The list is empty if all are solid balls.
                place.fill(SOLID_BALL);
                return write_numbers(spheres.inertia_factors(), place);
            }
            Self::Frictions
            | Self::RollingFrictions
            | Self::SpinningFrictions
            | Self::TangentialRestitutions => {
                return self.write_coefficients(spheres.frictions(), place);
            }
        };
        for (place, vector) in place.chunks_exact_mut(3).zip(vectors) {
            place.copy_from_slice(&vector.to_array());
        }
    }

    /// Writes a coefficient of friction; NaN for a sphere without its own.
    fn write_coefficients(self, frictions: &[Friction], place: &mut [f64]) {
        // The list is empty if no sphere has its own friction.
        place.fill(f64::NAN);
        for (place, mut friction) in place.iter_mut().zip(frictions.iter().copied()) {
            if let Some(&mut Some(coefficient)) = self.coefficient(&mut friction) {
                *place = coefficient;
            }
        }
    }
}

/// Writes quaternions x, y, z, w; the list is empty if no sphere ever rotated.
fn write_orientations(orientations: &[DQuat], place: &mut [f64]) {
    for (index, place) in place.chunks_exact_mut(4).enumerate() {
        let orientation = orientations.get(index).copied().unwrap_or(DQuat::IDENTITY);
        place.copy_from_slice(&orientation.to_array());
    }
}

fn write_numbers(numbers: &[f64], place: &mut [f64]) {
    place.iter_mut().zip(numbers).for_each(|(place, number)| *place = *number);
}
