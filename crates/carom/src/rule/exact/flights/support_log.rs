//! Log of the persistent contacts of spheres during a step, for derivatives.

use glam::DVec3;

use super::state::Flights;
use super::support_change::{HeldMotion, SupportChange};

impl Flights {
    /// Starts the log with the persistent contacts at `now` \[s\].
    pub fn begin_support_log(&mut self, now: f64) {
        let slots: Vec<u32> =
            self.clusters.iter().flat_map(|cluster| cluster.members.iter().copied()).collect();
        self.support_log = Some(Vec::new());
        slots.into_iter().for_each(|slot| self.note_support(slot, now, true));
    }

    /// Ends the log. Returns its changes in order of time.
    pub fn end_support_log(&mut self) -> Vec<SupportChange> {
        self.support_log.take().unwrap_or_default()
    }

    /// Adds the present contact of a sphere to the log, if there is one.
    #[inline]
    pub(super) fn note_support(&mut self, slot: u32, now: f64, is_old: bool) {
        if self.support_log.is_some() {
            let change = self.support_of(slot, now, is_old);
            self.support_log.get_or_insert_default().push(change);
        }
    }

    #[inline(never)]
    fn support_of(&self, slot: u32, now: f64, is_old: bool) -> SupportChange {
        let index = self.index_of[slot as usize];
        let species = self.species_of(slot);
        let held = species.cluster.map(|number| {
            let (position, velocity) = self.state_of(slot, now);
            let cluster = self.clusters.get(number);
            let rotation = self.rotations.get(index as usize);
            HeldMotion {
                position,
                velocity,
                angular_velocity: self.angular_velocity_of(slot, now),
                acceleration: species.acceleration,
                angular_acceleration: rotation.map_or(DVec3::ZERO, |it| it.angular_acceleration()),
                contact: match cluster.contacts[..] {
                    [contact] => Some(contact),
                    _ => None,
                },
                is_old,
            }
        });
        SupportChange { index, time: now, held }
    }
}
