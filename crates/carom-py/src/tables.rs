//! Events as tables of 64-bit words, so that NumPy gets many rows without an object each.
//!
//! NumPy reads the words as records. `python/carom/_run/tables.py` has their fields in the order in
//! which they are written here.

use std::collections::TryReserveError;

use carom::{
    Body, BodyPair, DVec3, Hit, Impact, LedgerEntry, NearBody, Overlap, PathLeg, PersistentContact,
    SensorEvent, StepReport, TriggerContact, WellEvent, WellEventKind,
};

/// Rows of words; floating-point numbers are stored as their bits.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Table(Vec<u64>);

impl Table {
    /// Returns the words.
    pub fn into_words(self) -> Vec<u64> {
        self.0
    }

    /// Appends the impacts of a frame that started at `start` \[s\].
    pub fn push_impacts(&mut self, start: f64, impacts: &[Impact]) {
        impacts.iter().for_each(|impact| self.push_impact(start, impact));
    }

    /// Reserves memory for `count` more impacts.
    ///
    /// # Errors
    /// If there is no memory for them.
    pub fn reserve_impacts(&mut self, count: usize) -> Result<(), TryReserveError> {
        self.0.try_reserve(count * IMPACT_WORDS)
    }

    /// Appends the ledger of a frame that started at `start` \[s\].
    pub fn push_ledger(&mut self, start: f64, report: &StepReport) {
        for LedgerEntry { impact, group } in report.ledger() {
            self.push_impact(start, impact);
            let number = report.groups.partition_point(|it| it.first < group.first);
            self.integers([number as i64, group.count as i64]);
            self.numbers(group.momentum_before.to_array());
            self.numbers(group.momentum_after.to_array());
            self.numbers([group.energy_before, group.energy_after, group.energy_demanded]);
        }
    }

    /// Appends spheres inside triggers.
    pub fn push_triggers(&mut self, triggers: &[TriggerContact]) {
        for contact in triggers {
            self.integers([contact.collider.number() as i64, contact.sphere.number() as i64]);
            self.numbers(contact.point.to_array());
            self.numbers(contact.normal.to_array());
        }
    }

    /// Reserves memory for `count` more events of sensors.
    ///
    /// # Errors
    /// If there is no memory for them.
    pub fn reserve_sensor_events(&mut self, count: usize) -> Result<(), TryReserveError> {
        self.0.try_reserve(count * SENSOR_EVENT_WORDS)
    }

    /// Appends the events of sensors of a frame that started at `start` \[s\].
    pub fn push_sensor_events(&mut self, start: f64, events: &[SensorEvent]) {
        for event in events {
            self.numbers([start + event.time]);
            self.integers([event.collider.number() as i64, event.sphere.number() as i64]);
            self.integers([i64::from(event.enters)]);
            self.numbers(event.point.to_array());
            self.numbers(event.normal.to_array());
            self.numbers([event.speed]);
        }
    }

    /// Appends the events of wells of a frame that started at `start` \[s\].
    pub fn push_well_events(&mut self, start: f64, events: &[WellEvent]) {
        for event in events {
            self.numbers([start + event.time]);
            self.integers(event.between.map(|sphere| sphere.number() as i64));
            self.integers([match event.kind {
                WellEventKind::Capture => 0,
                WellEventKind::Dissociation => 1,
                _ => 2,
            }]);
            self.numbers(event.normal.to_array());
            self.numbers([event.distance, event.impulse]);
        }
    }

    /// Appends what a ray or a sphere meets, or a row that says that it meets nothing.
    pub fn push_hit(&mut self, hit: Option<Hit>) {
        self.push_body(hit.map(|hit| hit.body));
        self.numbers(hit.map_or(DVec3::NAN, |hit| hit.point).to_array());
        self.numbers(hit.map_or(DVec3::NAN, |hit| hit.normal).to_array());
        self.numbers([hit.map_or(f64::INFINITY, |hit| hit.fraction)]);
    }

    /// Appends a near body, or a row that says that there is none.
    pub fn push_near(&mut self, near: Option<NearBody>) {
        self.push_body(near.map(|near| near.body));
        self.numbers(near.map_or(DVec3::NAN, |near| near.point).to_array());
        self.numbers(near.map_or(DVec3::NAN, |near| near.normal).to_array());
        self.numbers([near.map_or(f64::INFINITY, |near| near.distance)]);
    }

    /// Appends the number of a row.
    pub fn push_row(&mut self, row: usize) {
        self.integers([row as i64]);
    }

    /// Appends legs of a path.
    pub fn push_legs(&mut self, legs: &[PathLeg]) {
        for leg in legs {
            self.numbers([leg.start, leg.end, leg.flight_start]);
            self.numbers(leg.flight.position.to_array());
            self.numbers(leg.flight.velocity.to_array());
            self.numbers(leg.flight.acceleration.to_array());
            self.numbers([leg.flight.drag_rate]);
        }
    }

    /// Appends persistent contacts.
    pub fn push_contacts(&mut self, contacts: &[PersistentContact]) {
        for contact in contacts {
            self.push_bodies(contact.between);
            self.numbers(contact.point.to_array());
            self.numbers(contact.normal.to_array());
            self.numbers([contact.gap, contact.normal_force]);
            self.numbers(contact.tangential_force.to_array());
            self.integers([i64::from(contact.is_sliding)]);
        }
    }

    /// Appends overlaps.
    pub fn push_overlaps(&mut self, overlaps: &[Overlap]) {
        for overlap in overlaps {
            self.push_bodies(overlap.between);
            self.numbers([overlap.depth]);
        }
    }

    fn push_impact(&mut self, start: f64, impact: &Impact) {
        self.numbers([start + impact.time]);
        self.push_bodies(impact.between);
        self.numbers(impact.point.to_array());
        self.numbers(impact.normal.to_array());
        self.numbers([impact.approach_speed, impact.separation_speed, impact.impulse]);
        self.numbers(impact.tangential_impulse.to_array());
    }

    /// Appends the ids of two bodies: body 1 is a collider or a sphere, body 2 a sphere.
    fn push_bodies(&mut self, between: BodyPair) {
        let (collider, sphere_1, sphere_2) = match between {
            BodyPair::Spheres(first, second) => (NOBODY, first.number() as i64, second),
            BodyPair::Collider { collider, sphere } => (collider.number() as i64, NOBODY, sphere),
        };
        self.integers([collider, sphere_1, sphere_2.number() as i64]);
    }

    /// Appends the ids of a body, of which it has one.
    fn push_body(&mut self, body: Option<Body>) {
        self.integers(match body {
            Some(Body::Collider(collider)) => [collider.number() as i64, NOBODY],
            Some(Body::Sphere(sphere)) => [NOBODY, sphere.number() as i64],
            None => [NOBODY, NOBODY],
        });
    }

    fn integers<const N: usize>(&mut self, values: [i64; N]) {
        self.0.extend(values.map(i64::cast_unsigned));
    }

    fn numbers<const N: usize>(&mut self, values: [f64; N]) {
        self.0.extend(values.map(f64::to_bits));
    }
}

/// Words per impact.
const IMPACT_WORDS: usize = 16;
/// Words per event of a sensor.
const SENSOR_EVENT_WORDS: usize = 11;
/// Replaces the id if body 1 is of the other kind.
const NOBODY: i64 = -1;
