//! The last impacts, for a table and for marks in the picture.

use std::collections::VecDeque;

use carom::{BodyPair, DVec3, Impact, StepReport, World};

/// Impacts that are remembered: more than a table shows or a picture can mark.
pub const REMEMBERED: usize = 1024;

/// An impact as it is listed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListedImpact {
    /// Number of the frame in which it happened; the first is 1.
    pub frame: u64,
    /// When, since the beginning \[s\].
    pub time: f64,
    /// The two bodies.
    pub between: BodyPair,
    /// Where \[m\].
    pub point: DVec3,
    /// Unit normal from body 1 to body 2.
    pub normal: DVec3,
    /// Along the normal, before \[m/s\].
    pub approach_speed: f64,
    /// On body 2, along the normal \[N s\].
    pub impulse: f64,
    /// Change of kinetic energy \[J\]: of the whole group of impacts at that instant where the rule
    /// keeps account of them; otherwise [`energy_change_alone`]. `None` without account where friction
    /// acts, or for a sphere that has gone since.
    pub energy_change: Option<f64>,
    /// How many impacts that group is made of; 1 without account.
    pub group_size: usize,
}

/// Change of kinetic energy \[J\] by an impact that is alone in its place and time, of bodies whose
/// reduced mass is `reduced_mass` \[kg\]: `m (v_s² - v_a²) / 2`, of the speeds of separation and
/// approach. Only the motion along the normal, relative to each other, changes.
pub fn energy_change_alone(impact: &Impact, reduced_mass: f64) -> f64 {
    let Impact { approach_speed: before, separation_speed: after, .. } = *impact;
    0.5 * reduced_mass * (after - before) * (after + before)
}

/// Mass \[kg\] that answers to an impulse between two bodies, `m1 m2 / (m1 + m2)`; a collider never
/// gives way. `None` for a sphere that is not in the world any more.
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

/// The last impacts, oldest first.
#[derive(Debug, Clone, Default)]
pub(crate) struct LastImpacts(VecDeque<ListedImpact>);

impl LastImpacts {
    /// Remembers what happened in a frame that began at `start` \[s\] and led to `world`.
    pub fn note(&mut self, report: &StepReport, frame: u64, start: f64, world: &World) {
        let first = report.impacts.len().saturating_sub(REMEMBERED);
        for (i, impact) in report.impacts.iter().enumerate().skip(first) {
            let group = report.groups.partition_point(|group| group.first + group.count <= i);
            let group = report.groups.get(group).filter(|group| group.first <= i);
            let energy_change = match group {
                Some(group) => Some(group.energy_after - group.energy_before),
                // What friction takes depends on slip, too.
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

    /// Forgets what came after this frame.
    pub fn cut(&mut self, frame: u64) {
        while self.0.back().is_some_and(|impact| impact.frame > frame) {
            self.0.pop_back();
        }
    }

    /// Oldest first.
    pub fn iter(&self) -> impl Iterator<Item = &ListedImpact> {
        self.0.iter()
    }
}
