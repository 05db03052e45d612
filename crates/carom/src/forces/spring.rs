use glam::{DMat3, DVec3};

use super::SphereStates;
use super::derivatives::outer;
use crate::error::InvalidValue;
use crate::id::SphereId;
use crate::norm::Norm;
use crate::validate;

/// A spring with a damper beside it, between the centres of two spheres or from one to a fixed point.
///
/// At the length l it pulls with `k (l - l0) + c dl/dt`. A thread only pulls: it is slack up to its rest
/// length, and its damper never pushes.
///
/// ```
/// use carom::{DVec3, Sphere, Spring, World};
///
/// let mut world = World::default();
/// let ball = world.add_sphere(Sphere::new(DVec3::X, 0.1))?;
/// let spring = world.add_spring(Spring::to_point(ball, DVec3::ZERO, 0.5).with_stiffness(8.0))?;
/// // Half of k (l - l0)².
/// assert_eq!(world.potential_energy(), 1.0);
/// world.remove_spring(spring)?;
/// assert_eq!(world.potential_energy(), 0.0);
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spring {
    /// The sphere at its first end.
    pub sphere: SphereId,
    /// The second end.
    pub to: SpringEnd,
    /// Length without force l0 \[m\], >= 0.
    pub rest_length: f64,
    /// Stiffness k \[N/m\], >= 0.
    pub stiffness: f64,
    /// Damping c \[kg/s\], >= 0.
    pub damping: f64,
    /// Whether it is a thread, which only pulls.
    pub only_pulls: bool,
}

/// The second end of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum SpringEnd {
    /// The centre of another sphere.
    Sphere(SphereId),
    /// A fixed point \[m\].
    Point(DVec3),
}

impl Spring {
    /// A spring between two spheres of this rest length \[m\] and 1 N/m, without damping.
    pub fn between(first: SphereId, second: SphereId, rest_length: f64) -> Self {
        Self::new(first, SpringEnd::Sphere(second), rest_length)
    }

    /// A spring from a sphere to a fixed point \[m\], of this rest length \[m\] and 1 N/m, without damping.
    pub fn to_point(sphere: SphereId, point: DVec3, rest_length: f64) -> Self {
        Self::new(sphere, SpringEnd::Point(point), rest_length)
    }

    fn new(sphere: SphereId, to: SpringEnd, rest_length: f64) -> Self {
        Self { sphere, to, rest_length, stiffness: 1.0, damping: 0.0, only_pulls: false }
    }

    /// This spring with another stiffness \[N/m\].
    pub fn with_stiffness(self, stiffness: f64) -> Self {
        Self { stiffness, ..self }
    }

    /// This spring with another damping \[kg/s\].
    pub fn with_damping(self, damping: f64) -> Self {
        Self { damping, ..self }
    }

    /// This spring as a thread, which only pulls, or as one that pushes, too.
    pub fn with_only_pulls(self, only_pulls: bool) -> Self {
        Self { only_pulls, ..self }
    }

    /// The spheres that it joins.
    pub fn spheres(&self) -> impl Iterator<Item = SphereId> {
        let second = match self.to {
            SpringEnd::Sphere(id) => Some(id),
            SpringEnd::Point(_) => None,
        };
        [self.sphere].into_iter().chain(second)
    }

    /// Returns an error for invalid numbers, or for both ends at one sphere.
    pub(crate) fn validate(&self) -> Result<(), InvalidValue> {
        validate::non_negative("rest_length", self.rest_length)?;
        validate::non_negative("stiffness", self.stiffness)?;
        validate::non_negative("damping", self.damping)?;
        match self.to {
            SpringEnd::Sphere(other) => {
                let requirement = "another sphere than at the first end";
                validate::require(other != self.sphere, "to", requirement, other)
            }
            SpringEnd::Point(point) => validate::finite("to", point),
        }
    }

    /// Adds the force on each of its spheres \[N\].
    pub(super) fn add_forces(&self, spheres: &SphereStates, forces: &mut [DVec3]) {
        let Some(ends) = self.ends(spheres) else { return };
        let along = self.pull(ends.offset, ends.velocity);
        forces[ends.first] += along;
        if let Some(second) = ends.second {
            forces[second] -= along;
        }
    }

    /// The force on its first end \[N\], over the offset to the second \[m\], which moves with this velocity as seen
    /// from the first \[m/s\].
    pub(crate) fn pull(&self, offset: DVec3, velocity: DVec3) -> DVec3 {
        let stretch = Stretch::of(offset, velocity);
        stretch.tension(self) * stretch.direction
    }

    /// [`Self::pull`] of a thread as if it pushed, too.
    pub(crate) fn pull_or_push(&self, offset: DVec3, velocity: DVec3) -> DVec3 {
        let stretch = Stretch::of(offset, velocity);
        stretch.elastic_tension(self) * stretch.direction
    }

    /// The part of [`Self::pull`] that the damper adds \[N\], the nonconservative one.
    pub(crate) fn damping_pull(&self, offset: DVec3, velocity: DVec3) -> DVec3 {
        let stretch = Stretch::of(offset, velocity);
        let undamped = Self { damping: 0.0, ..*self };
        (stretch.tension(self) - stretch.tension(&undamped)) * stretch.direction
    }

    /// Adds the force of the damper on each of the spheres \[N\].
    pub(super) fn add_damping(&self, spheres: &SphereStates, forces: &mut [DVec3]) {
        let Some(ends) = self.ends(spheres).filter(|_| self.damping > 0.0) else { return };
        let along = self.damping_pull(ends.offset, ends.velocity);
        forces[ends.first] += along;
        if let Some(second) = ends.second {
            forces[second] -= along;
        }
    }

    /// `k (l - l0)² / 2` \[J\]; none where it is slack.
    pub(crate) fn potential_energy(&self, spheres: &SphereStates) -> f64 {
        self.ends(spheres).map_or(0.0, |ends| self.energy_over(ends.offset))
    }

    /// The potential energy \[J\] of the spring over this offset of its ends \[m\].
    pub(crate) fn energy_over(&self, offset: DVec3) -> f64 {
        let stretch = offset.norm() - self.rest_length;
        if self.only_pulls && stretch <= 0.0 {
            return 0.0;
        }
        0.5 * self.stiffness * stretch * stretch
    }

    /// Returns the derivatives of [`Self::pull`]; `None` if the ends are in one place. A thread that does not pull
    /// has none.
    pub(crate) fn pull_derivatives(
        &self,
        offset: DVec3,
        velocity: DVec3,
    ) -> Option<PullDerivatives> {
        let stretch = Stretch::of(offset, velocity);
        let Stretch { length, direction, lengthening } = stretch;
        if length == 0.0 {
            return None;
        }
        if self.only_pulls && stretch.tension(self) == 0.0 {
            return Some(PullDerivatives::ZERO);
        }
        let aside = (velocity - lengthening * direction) / length;
        let along = outer(direction, self.stiffness * direction + self.damping * aside);
        let turned = DMat3::IDENTITY - outer(direction, direction);
        Some(PullDerivatives {
            by_offset: along + (stretch.elastic_tension(self) / length) * turned,
            by_velocity: outer(direction, self.damping * direction),
            by_stiffness: (length - self.rest_length) * direction,
            by_rest_length: -self.stiffness * direction,
            by_damping: lengthening * direction,
        })
    }

    /// `None` if one of its spheres is not in the world.
    fn ends(&self, spheres: &SphereStates) -> Option<Ends> {
        let first = spheres.index_of(self.sphere)?;
        let (second, position, velocity) = match self.to {
            SpringEnd::Point(point) => (None, point, DVec3::ZERO),
            SpringEnd::Sphere(id) => {
                let index = spheres.index_of(id)?;
                (Some(index), spheres.positions[index], spheres.velocities[index])
            }
        };
        let offset = spheres.offset_between(spheres.positions[first], position);
        Some(Ends { first, second, offset, velocity: velocity - spheres.velocities[first] })
    }
}

/// Derivatives of the force of a spring on its first end.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PullDerivatives {
    /// Derivatives by the offset to the second end \[N/m\] and by its relative velocity \[N s/m\].
    pub by_offset: DMat3,
    pub by_velocity: DMat3,
    /// Derivatives by the stiffness \[m\], the rest length \[N/m\] and the damping \[m/s\].
    pub by_stiffness: DVec3,
    pub by_rest_length: DVec3,
    pub by_damping: DVec3,
}

impl PullDerivatives {
    /// Derivatives of no force.
    const ZERO: Self = Self {
        by_offset: DMat3::ZERO,
        by_velocity: DMat3::ZERO,
        by_stiffness: DVec3::ZERO,
        by_rest_length: DVec3::ZERO,
        by_damping: DVec3::ZERO,
    };
}

/// The ends of a spring.
struct Ends {
    /// Indices of its spheres.
    first: usize,
    second: Option<usize>,
    /// Offset from the first end to the second \[m\].
    offset: DVec3,
    /// Velocity of the second end relative to the first \[m/s\].
    velocity: DVec3,
}

/// The stretch of a spring.
struct Stretch {
    /// Length \[m\].
    length: f64,
    /// Unit vector from the first end to the second.
    direction: DVec3,
    /// Rate of change of the length \[m/s\].
    lengthening: f64,
}

impl Stretch {
    fn of(offset: DVec3, velocity: DVec3) -> Self {
        let length = offset.norm();
        // A spring of no length has no direction and exerts no force.
        let direction = if length > 0.0 { offset / length } else { DVec3::ZERO };
        Self { length, direction, lengthening: velocity.dot(direction) }
    }

    /// The force that pulls its ends together \[N\].
    fn tension(&self, spring: &Spring) -> f64 {
        let tension = self.elastic_tension(spring);
        match spring.only_pulls {
            true if self.length <= spring.rest_length => 0.0,
            true => tension.max(0.0),
            false => tension,
        }
    }

    /// `k (l - l0) + c dl/dt` \[N\]
    fn elastic_tension(&self, spring: &Spring) -> f64 {
        let stretch = self.length - spring.rest_length;
        spring.stiffness * stretch + spring.damping * self.lengthening
    }
}
