//! The most recent impacts, for tables and for marks in pictures.

use std::collections::VecDeque;

use carom::{BodyPair, DVec3, Impact, StepReport, World};

/// Number of impacts that are kept: more than a table or a picture can show.
pub const REMEMBERED: usize = 1024;

/// An impact in the list.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListedImpact {
    /// Number of the frame in which it happened; the first is 1.
    pub frame: u64,
    /// Time since the beginning \[s\].
    pub time: f64,
    /// The two bodies.
    pub between: BodyPair,
    /// Point of contact \[m\].
    pub point: DVec3,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Speed of approach along the normal, before the impact \[m/s\].
    pub approach_speed: f64,
    /// Impulse on body 2 along the normal \[N s\].
    pub impulse: f64,
    /// Change of kinetic energy \[J\]. If the rule keeps a ledger, it is that of the whole group of
    /// impacts at that instant; otherwise [`energy_change_alone`]. `None` without a ledger if
    /// friction acted or a sphere has been removed.
    pub energy_change: Option<f64>,
    /// Number of impacts in the group; 1 without a ledger.
    pub group_size: usize,
}

/// Change of kinetic energy \[J\] by a single impact of bodies with this reduced mass \[kg\]: `m
/// (v_s² - v_a²) / 2`, with the speeds of separation and approach. Only the relative motion along
/// the normal changes.
pub fn energy_change_alone(impact: &Impact, reduced_mass: f64) -> f64 {
    let Impact { approach_speed: before, separation_speed: after, .. } = *impact;
    0.5 * reduced_mass * (after - before) * (after + before)
}

/// Reduced mass \[kg\] of two bodies, `m1 m2 / (m1 + m2)`; the mass of a collider is infinite.
/// `None` if a sphere has been removed.
fn reduced_mass(between: BodyPair, world: &World) -> Option<f64> {
    let mass = |id| Some(world.sphere(id).ok()?.kilograms());
    match between {
        BodyPair::Collider { sphere, .. } => mass(sphere),
        BodyPair::Spheres(first, second) => {
            let (first, second) = (mass(first)?, mass(second)?);
            Some(first / (1.0 + first / second))
        }
    }
}

/// The most recent impacts, oldest first.
#[derive(Debug, Clone, Default)]
pub(crate) struct LastImpacts(VecDeque<ListedImpact>);

impl LastImpacts {
    /// Adds the impacts of a frame that began at `start` \[s\] and led to `world`.
    pub fn note(&mut self, report: &StepReport, frame: u64, start: f64, world: &World) {
        let first = report.impacts.len().saturating_sub(REMEMBERED);
        for (i, impact) in report.impacts.iter().enumerate().skip(first) {
            let group = report.groups.partition_point(|group| group.first + group.count <= i);
            let group = report.groups.get(group).filter(|group| group.first <= i);
            let energy_change = match group {
                Some(group) => Some(group.energy_after - group.energy_before),
                // With friction, the energy also depends on the slip.
                None if impact.tangential_impulse != DVec3::ZERO => None,
                None => reduced_mass(impact.between, world)
                    .map(|reduced_mass| energy_change_alone(impact, reduced_mass)),
            };
            if self.0.len() == REMEMBERED {
                self.0.pop_front();
            }
            self.0.push_back(ListedImpact {
                frame,
                time: start + impact.time,
                between: impact.between,
                point: impact.point,
                normal: impact.normal,
                approach_speed: impact.approach_speed,
                impulse: impact.impulse,
                energy_change,
                group_size: group.map_or(1, |group| group.count),
            });
        }
    }

    /// Removes the impacts after this frame.
    pub fn cut(&mut self, frame: u64) {
        while self.0.back().is_some_and(|impact| impact.frame > frame) {
            self.0.pop_back();
        }
    }

    /// Iterates over the impacts, oldest first.
    pub fn iter(&self) -> impl Iterator<Item = &ListedImpact> {
        self.0.iter()
    }
}
