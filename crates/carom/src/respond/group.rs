//! A group of touching bodies, scaled for computing, and what one instant does to it.

use glam::DVec3;

use super::order_free;
use super::problem::{self, Link, Tolerance};
use super::touching::TouchingContact;
use crate::work::Work;

/// Speeds are distinguished down to these multiples of the rounding of the largest speed. A velocity
/// that went through a handful of operations is off by a few roundings: below `FINE` an iteration
/// gains nothing; `COARSE` leaves room for sums over many contacts.
const FINE: f64 = 4.0 * f64::EPSILON;
const COARSE: f64 = 64.0 * f64::EPSILON;

/// The contacts of a group. Speeds are in units of about the largest, impulses in kilograms of
/// these.
#[derive(Debug)]
pub(super) struct Group<'a> {
    pub links: Vec<Link>,
    /// One per contact, in \[0, 1\].
    pub restitutions: Vec<f64>,
    /// Masses \[kg\], one per body.
    pub masses: &'a [f64],
    /// Work of the step: solvers count their own, and end early on a stop request.
    pub work: &'a Work<'a>,
}

/// Velocities, and the impulses that led to them.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Motion {
    /// One per body.
    pub velocities: Vec<DVec3>,
    /// One per contact: what has been given so far.
    pub impulses: Vec<f64>,
}

/// What a law answers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Answer {
    pub motion: Motion,
    /// Change of kinetic energy that the law demands, measured against the surfaces.
    pub energy: f64,
    /// Whether it is the answer of the law proper, not what it falls back on.
    pub complete: bool,
}

impl<'a> Group<'a> {
    /// The group with all speeds divided by the `unit`.
    pub fn new(
        contacts: &[TouchingContact],
        masses: &'a [f64],
        unit: f64,
        work: &'a Work<'a>,
    ) -> Self {
        let links = contacts.iter().map(|contact| Link {
            first: contact.first.map(|body| body as u32),
            second: contact.second as u32,
            normal: contact.normal,
            surface_velocity: match contact.first {
                Some(_) => DVec3::ZERO,
                None => contact.surface_velocity / unit,
            },
            target: 0.0,
        });
        let restitutions = contacts.iter().map(|contact| contact.restitution.clamp(0.0, 1.0));
        Self { links: links.collect(), restitutions: restitutions.collect(), masses, work }
    }

    /// The group where velocities of surfaces do not count.
    pub fn at_rest(contacts: &[TouchingContact], masses: &'a [f64], work: &'a Work<'a>) -> Self {
        let mut group = Self::new(contacts, masses, 1.0, work);
        group.links.iter_mut().for_each(|link| link.surface_velocity = DVec3::ZERO);
        group
    }

    /// Rate of opening of a contact.
    pub fn rate(&self, contact: usize, velocities: &[DVec3]) -> f64 {
        self.links[contact].rate(velocities)
    }

    /// Returns whether a contact closes faster than rounding can explain.
    pub fn is_closing(&self, contact: usize, velocities: &[DVec3]) -> bool {
        let link = &self.links[contact];
        let bodies = link.first.into_iter().chain([link.second]);
        let speed = speed_scale(bodies.map(|body| velocities[body as usize]));
        link.rate(velocities) < -tolerance(speed).coarse
    }

    /// Whether any contact closes.
    pub fn closes(&self, velocities: &[DVec3]) -> bool {
        (0..self.links.len()).any(|contact| self.is_closing(contact, velocities))
    }

    /// What impulses do to the kinetic energy, measured against the surfaces, from the rates of
    /// opening before and after: `Σ p (u⁻ + u⁺) / 2` (Thomson and Tait, "Treatise on Natural
    /// Philosophy", 1867, § 308).
    pub fn work(&self, impulses: &[f64], before: &[DVec3], after: &[DVec3]) -> f64 {
        order_free::sum(impulses.iter().enumerate().map(|(contact, impulse)| {
            0.5 * impulse * (self.rate(contact, before) + self.rate(contact, after))
        }))
    }

    /// `Σ m |a − b|² / 2`: kinetic energy of the difference of two motions.
    pub fn energy_between(&self, a: &[DVec3], b: &[DVec3]) -> f64 {
        order_free::sum(self.masses.iter().enumerate().map(|(body, mass)| {
            let difference = a[body] - b[body];
            0.5 * mass * difference.dot(difference)
        }))
    }

    /// Applies these impulses to the bodies, one for each contact.
    pub fn push(&self, impulses: &[f64], velocities: &mut [DVec3]) {
        let (mut steps, mut moved) =
            (vec![Default::default(); self.masses.len()], velocities.to_vec());
        let inverse_mass = |body: usize| 1.0 / self.masses[body];
        problem::push(&self.links, inverse_mass, |i| impulses[i], &mut steps, &mut moved);
        for (velocity, moved) in velocities.iter_mut().zip(moved) {
            *velocity += moved;
        }
    }
}

impl Motion {
    /// Adds a multiple of these impulses.
    pub fn add(&mut self, impulses: &[f64], factor: f64) {
        for (total, impulse) in self.impulses.iter_mut().zip(impulses) {
            *total += factor * impulse;
        }
    }

    /// The motion so far along the way to another: 0 is this one, 1 the other.
    pub fn towards(&self, other: &Self, part: f64) -> Self {
        let pairs = self.velocities.iter().zip(&other.velocities);
        let velocities = pairs.map(|(a, b)| *a + part * (*b - *a)).collect();
        let pairs = self.impulses.iter().zip(&other.impulses);
        let impulses = pairs.map(|(a, b)| (a + part * (b - a)).max(0.0)).collect();
        Self { velocities, impulses }
    }
}

impl Answer {
    /// Returns the answer in which nothing changes.
    pub fn unchanged(group: &Group, velocities: &[DVec3]) -> Self {
        let impulses = vec![0.0; group.links.len()];
        let motion = Motion { velocities: velocities.to_vec(), impulses };
        Self { motion, energy: 0.0, complete: true }
    }
}

/// The scale of speeds that rounding goes by: at least 1, the largest at the start.
pub(super) fn speed_scale(velocities: impl Iterator<Item = DVec3>) -> f64 {
    velocities.map(|velocity| velocity.abs().max_element()).fold(1.0, f64::max)
}

/// Returns the speeds that cannot be distinguished from zero at this scale of speeds.
pub(super) fn tolerance(speed: f64) -> Tolerance {
    Tolerance { scale: speed, fine: FINE * speed, coarse: COARSE * speed }
}

/// Closing speed \[m/s\] below which a contact of a sphere with this velocity \[m/s\] may close by
/// rounding alone.
pub(crate) fn rounding_of(velocity: DVec3) -> f64 {
    COARSE * velocity.abs().max_element()
}
