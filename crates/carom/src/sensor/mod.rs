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
use crate::report::SensorEvent;
use crate::surface::Role;
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
            self.find_targets(&segment, system, period);
            let targets = std::mem::take(&mut self.targets);
            for of_one in targets.chunk_by(|a, b| a.collider == b.collider) {
                let crossing = Crossing { segment: &segment, targets: of_one, system, step_start };
                self.pass(&crossing, of_one[0].collider);
            }
            self.targets = targets;
        }
    }

    /// Drops spheres and triggers that are not in the world any more, and puts events in order of time.
    pub fn finish(&mut self, system: &System) {
        let ids = &system.spheres.id;
        let is_trigger = |id: ColliderId| {
            let of_collider = system.surfaces.partition_point(|it| it.collider < id);
            let surface = system.surfaces.get(of_collider);
            surface.is_some_and(|it| it.collider == id && it.role == Role::Reports)
        };
        self.presence.retain(|(sphere, id)| ids.binary_search(sphere).is_ok() && is_trigger(*id));
        self.events.sort_by(|a, b| {
            a.time.total_cmp(&b.time).then((a.sphere, a.collider).cmp(&(b.sphere, b.collider)))
        });
    }

    /// Finds the triggers that a sphere may be in or meet along a segment, sorted by collider.
    fn find_targets(&mut self, segment: &FlightSegment, system: &System, period: DVec3) {
        self.targets.clear();
        let bounds = segment.bounds();
        for shift in flight_segment::shifts(period) {
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
        // Moving triggers may come from anywhere; a sphere inside one may have been moved by a program.
        let first = (segment.sphere, ColliderId::from_number(0));
        let last = (segment.sphere, ColliderId::from_number(u64::MAX));
        let inside: BTreeSet<_> = self.presence.range(first..=last).map(|it| it.1).collect();
        for (number, surface) in (0..).zip(system.surfaces) {
            if surface.role != Role::Reports {
                continue;
            }
            let moves = !surface.motion.is_at_rest();
            let is_left = inside.contains(&surface.collider)
                && !self.targets.iter().any(|it| it.collider == surface.collider);
            if moves || is_left {
                self.targets.push(Target::new(number, DVec3::ZERO, system));
            }
        }
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
