//! Sensors: when spheres enter and leave triggers, along their flights.

mod crossing;
mod flight_segment;
mod tracks;

use std::collections::BTreeSet;

use glam::DVec3;

pub(crate) use flight_segment::FlightSegment;
pub(crate) use tracks::Tracks;

use crate::detect::surface_tree;
use crate::id::{ColliderId, SphereId};
use crate::norm::Norm;
use crate::report::SensorEvent;
use crate::surface::{LastCarriage, Role};
use crate::system::System;
use crossing::{Crossing, Target};

/// Largest number of crossings of a trigger by a flight; only one with many turns in a long frame gets near it.
const MOST_CROSSINGS: usize = 100_000;

/// Pairs of a trigger and a sphere inside.
pub(crate) type Presence = BTreeSet<(SphereId, ColliderId)>;

/// State of the sensors: spheres inside triggers, and the events of the step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sensors {
    /// Spheres inside triggers now.
    pub presence: Presence,
    /// Events in the order of spheres.
    pub events: Vec<SensorEvent>,
    near: Vec<u32>,
    targets: Vec<Target>,
}

impl Sensors {
    /// Sensors with these spheres inside and no events.
    pub fn with(presence: Presence) -> Self {
        Self { presence, ..Self::default() }
    }

    /// Notes when a sphere enters and leaves triggers along a segment. Events count their time from `step_start` \[s\],
    /// when surfaces are where the system says.
    pub fn watch(&mut self, segment: &FlightSegment, system: &System, step_start: f64) {
        let period = system.settings.boundary.period();
        for segment in segment.pieces(period) {
            self.find_targets(&segment, system, step_start);
            let targets = std::mem::take(&mut self.targets);
            for of_one in targets.chunk_by(|a, b| a.collider == b.collider) {
                let (segment, last) = (&segment, &LastCarriage::default());
                let crossing = Crossing { segment, targets: of_one, system, step_start, last };
                self.pass(&crossing, of_one[0].collider);
            }
            self.targets = targets;
        }
    }

    /// Drops spheres and triggers that are not in the world any more, and puts events in order of time.
    pub fn finish(&mut self, system: &System) {
        let ids = &system.spheres.id;
        let is_trigger = |id: ColliderId| triggers_of(id, system).next().is_some();
        self.presence.retain(|(sphere, id)| ids.binary_search(sphere).is_ok() && is_trigger(*id));
        self.events.sort_by(|a, b| {
            a.time.total_cmp(&b.time).then((a.sphere, a.collider).cmp(&(b.sphere, b.collider)))
        });
    }

    /// Finds the triggers that a sphere may be in or meet along a segment, sorted by collider; surfaces are where the
    /// system says at `step_start` \[s\].
    fn find_targets(&mut self, segment: &FlightSegment, system: &System, step_start: f64) {
        self.targets.clear();
        let bounds = segment.bounds();
        for shift in flight_segment::shifts(system.settings.boundary.period()) {
            let bounds = bounds.moved(-shift);
            system.trigger_tree.near(&bounds, &mut self.near);
            let repeats = |surface: &u32| {
                let surface = &system.surfaces[*surface as usize];
                let is_repeated = surface_tree::bounds(&surface.form).is_some();
                surface.motion.is_at_rest() && (shift == DVec3::ZERO || is_repeated)
            };
            let of_tree = self.near.iter().copied().filter(repeats);
            self.targets.extend(of_tree.map(|surface| Target::new(surface, shift, system)));
        }
        self.near.clear();
        let (place, reach) = (bounds.center(), bounds.half().norm());
        let times = [segment.from - step_start, segment.to - segment.from];
        for tree in system.moving_triggers_after(times[0], &LastCarriage::default()) {
            let beside = tree.way_beside(place, reach, times);
            tree.add_near(place, reach + beside, &mut self.near);
        }
        // A program may have moved a sphere that was inside a trigger away from it.
        let first = (segment.sphere, ColliderId::from_number(0));
        let last = (segment.sphere, ColliderId::from_number(u64::MAX));
        for (_, collider) in self.presence.range(first..=last) {
            let near = self.near.iter().map(|&it| system.surfaces[it as usize].collider);
            if self.targets.iter().map(|it| it.collider).chain(near).all(|it| it != *collider) {
                self.near.extend(triggers_of(*collider, system));
            }
        }
        let near = self.near.iter().map(|&surface| Target::new(surface, DVec3::ZERO, system));
        self.targets.extend(near);
        let groups = system.spheres.groups(segment.index as usize);
        let is_seen = |it: &Target| system.surfaces[it.surface as usize].groups.collides(groups);
        self.targets.retain(is_seen);
        self.targets.sort_by_key(|target| (target.collider, target.surface));
    }

    /// Notes when a sphere enters and leaves one trigger.
    fn pass(&mut self, crossing: &Crossing, collider: ColliderId) {
        let key = (crossing.segment.sphere, collider);
        let mut now = crossing.segment.from;
        // Changes by a program, or by the start of a new flight.
        let is_in = self.presence.contains(&key);
        if is_in != crossing.is_in_at(now, is_in) {
            self.note(crossing, key, now);
        }
        let mut at_once = 0;
        for _ in 0..MOST_CROSSINGS {
            let is_in = self.presence.contains(&key);
            let next = if is_in { crossing.exit(now) } else { crossing.entry(now) };
            let Some(time) = next else { return };
            // A graze may come in and go at one time, but not again.
            at_once = if time > now { 0 } else { at_once + 1 };
            if at_once > 2 {
                return;
            }
            now = time.max(now);
            self.note(crossing, key, now);
        }
    }

    /// Notes that a sphere enters or leaves a trigger at `time` \[s\].
    fn note(&mut self, crossing: &Crossing, key: (SphereId, ColliderId), time: f64) {
        let enters = !self.presence.remove(&key);
        if enters {
            self.presence.insert(key);
        }
        self.events.push(crossing.event(key, enters, time));
    }
}

/// The numbers of the surfaces of a collider that report.
fn triggers_of(collider: ColliderId, system: &System) -> impl Iterator<Item = u32> {
    let first = system.surfaces.partition_point(|it| it.collider < collider);
    let own = system.surfaces[first..].iter().take_while(move |it| it.collider == collider);
    let numbered = (first as u32..).zip(own);
    numbered.filter(|(_, it)| it.role == Role::Reports).map(|(number, _)| number)
}
