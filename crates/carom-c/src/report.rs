//! Events of the last step, and persistent contacts.

use carom::{
    BodyPair, Impact, Overlap, PersistentContact, SensorEvent, SphereId, TriggerContact, WellEvent,
    WellEventKind,
};

use crate::pointer::{Out, Room, Strided};
use crate::status::{CaromStatus, call};
use crate::world::CaromWorld;

/// Two bodies: two spheres, or a collider and a sphere.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromBodyPair {
    /// Id of body 1: a collider, or the sphere with the smaller id.
    pub body_1: u64,
    /// Id of body 2: a sphere.
    pub body_2: u64,
    /// 1 if body 1 is a collider, 0 if it is a sphere.
    pub body_1_is_collider: u64,
}

impl From<BodyPair> for CaromBodyPair {
    fn from(pair: BodyPair) -> Self {
        match pair {
            BodyPair::Spheres(first, second) => {
                Self { body_1: first.number(), body_2: second.number(), body_1_is_collider: 0 }
            }
            BodyPair::Collider { collider, sphere } => {
                Self { body_1: collider.number(), body_2: sphere.number(), body_1_is_collider: 1 }
            }
        }
    }
}

/// One impact.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromImpact {
    /// Time since the start of the step [s].
    pub time: f64,
    /// The two bodies.
    pub bodies: CaromBodyPair,
    /// Point on the surface of body 1 [m].
    pub point: [f64; 3],
    /// Unit normal from body 1 to body 2.
    pub normal: [f64; 3],
    /// Speed of approach along the normal before the impact [m/s], > 0.
    pub approach_speed: f64,
    /// Speed of separation along the normal after the impact and all simultaneous ones in its group
    /// [m/s].
    pub separation_speed: f64,
    /// Impulse along the normal [N s], on body 2; the opposite acts on body 1.
    pub impulse: f64,
    /// Impulse of friction across the normal [N s], on body 2; the opposite acts on body 1.
    pub tangential_impulse: [f64; 3],
}

/// Converts an impact for C.
pub(crate) fn impact(impact: &Impact) -> CaromImpact {
    CaromImpact {
        time: impact.time,
        bodies: impact.between.into(),
        point: impact.point.to_array(),
        normal: impact.normal.to_array(),
        approach_speed: impact.approach_speed,
        separation_speed: impact.separation_speed,
        impulse: impact.impulse,
        tangential_impulse: impact.tangential_impulse.to_array(),
    }
}

/// A contact that persists from step to step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromContact {
    /// The two bodies.
    pub bodies: CaromBodyPair,
    /// Point on the surface of body 1 [m].
    pub point: [f64; 3],
    /// Unit normal from body 1 to body 2.
    pub normal: [f64; 3],
    /// Distance of the two surfaces [m], negative if they overlap.
    pub gap: f64,
    /// Force along the normal on body 2 [N], >= 0; the opposite acts on body 1.
    pub normal_force: f64,
    /// Force of friction on body 2, across the normal [N].
    pub tangential_force: [f64; 3],
    /// 1 if the surfaces slide on each other, or would under the smallest tangential force; else 0.
    pub is_sliding: u64,
}

fn contact(contact: &PersistentContact) -> CaromContact {
    CaromContact {
        bodies: contact.between.into(),
        point: contact.point.to_array(),
        normal: contact.normal.to_array(),
        gap: contact.gap,
        normal_force: contact.normal_force,
        tangential_force: contact.tangential_force.to_array(),
        is_sliding: contact.is_sliding.into(),
    }
}

/// A sphere inside a trigger at the end of the last step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromTrigger {
    /// Id of the trigger.
    pub collider: u64,
    /// Id of the sphere.
    pub sphere: u64,
    /// Unit normal from the trigger's surface to the sphere.
    pub normal: [f64; 3],
    /// Point on the trigger's surface [m].
    pub point: [f64; 3],
}

fn trigger(trigger: &TriggerContact) -> CaromTrigger {
    CaromTrigger {
        collider: trigger.collider.number(),
        sphere: trigger.sphere.number(),
        normal: trigger.normal.to_array(),
        point: trigger.point.to_array(),
    }
}

/// A sphere that enters a trigger or leaves it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromSensorEvent {
    /// Time since the start of the step [s].
    pub time: f64,
    /// Id of the trigger.
    pub collider: u64,
    /// Id of the sphere.
    pub sphere: u64,
    /// 1 if the sphere enters, 0 if it leaves.
    pub enters: u64,
    /// Point on the trigger's surface [m].
    pub point: [f64; 3],
    /// Unit normal from the trigger's surface to the sphere.
    pub normal: [f64; 3],
    /// Speed of the sphere relative to the trigger [m/s].
    pub speed: f64,
}

fn sensor_event(event: &SensorEvent) -> CaromSensorEvent {
    CaromSensorEvent {
        time: event.time,
        collider: event.collider.number(),
        sphere: event.sphere.number(),
        enters: event.enters.into(),
        point: event.point.to_array(),
        normal: event.normal.to_array(),
        speed: event.speed,
    }
}

/// Two spheres at the edge of the well between them, which a pair potential of a scene makes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromWellEvent {
    /// Time since the start of the step [s].
    pub time: f64,
    /// Ids of the spheres, ascending.
    pub spheres: [u64; 2],
    /// 0 if they enter the well, 1 if they leave it, 2 if they turn back.
    pub kind: u64,
    /// Unit vector from the first centre to the second.
    pub normal: [f64; 3],
    /// Distance of the centres [m].
    pub distance: f64,
    /// Impulse that drives the spheres apart [N s]; negative if it draws them together.
    pub impulse: f64,
}

fn well_event(event: &WellEvent) -> CaromWellEvent {
    CaromWellEvent {
        time: event.time,
        spheres: event.between.map(SphereId::number),
        kind: match event.kind {
            WellEventKind::Capture => 0,
            WellEventKind::Dissociation => 1,
            _ => 2,
        },
        normal: event.normal.to_array(),
        distance: event.distance,
        impulse: event.impulse,
    }
}

/// Two bodies that overlap.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromOverlap {
    /// The two bodies.
    pub bodies: CaromBodyPair,
    /// Depth of the overlap of their surfaces [m], > 0.
    pub depth: f64,
}

/// Converts an overlap for C.
pub(crate) fn overlap(overlap: &Overlap) -> CaromOverlap {
    CaromOverlap { bodies: overlap.between.into(), depth: overlap.depth }
}

/// Counts and energies of the last step.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromReport {
    /// Number of impacts.
    pub impacts: u64,
    /// Under the rule `exact`: number of spheres in a stepped zone at the end of the step, which
    /// are not moved from impact to impact.
    pub zone_spheres: u64,
    /// Under the rule `exact`: 1 if any sphere was in a stepped zone in any step so far, else 0.
    pub was_stepped: u64,
    /// Under the rule `bisect`: number of groups in which two bodies met as often as a frame
    /// allows.
    pub unfinished_islands: u64,
    /// Under the rule `contact`: number of sleeping spheres at the end of the step.
    pub asleep: u64,
    /// Under the rule `contact`: how often a sphere was pressed into a surface by half its radius,
    /// summed over sub-steps.
    pub squeezed: u64,
    /// Work of contacts [J]: the energy change by restitution and friction.
    pub contact_work: f64,
    /// Work of moving colliders [J].
    pub collider_work: f64,
    /// Work of the correction of overlaps [J].
    pub correction_work: f64,
    /// Energy of emitted spheres minus that of removed ones [J]. carom_world_energy_account() has
    /// all that changes the total energy.
    pub emission_energy: f64,
    /// Under the rule `contact`: largest change of an impulse in the last sweep, relative to the
    /// largest impulse.
    pub residual: f64,
    /// Under the rule `contact`: largest overlap before its correction, relative to the sum of
    /// radii.
    pub largest_overlap: f64,
}

/// Reads counts and energies of the last step; all are 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_report(
    world: CaromWorld,
    report: *mut CaromReport,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(report, "report") }, |inner| {
        let report = inner.world.report();
        let account = report.contact_account;
        CaromReport {
            impacts: report.impacts.len() as u64,
            zone_spheres: report.zone_account.spheres.into(),
            was_stepped: inner.world.was_stepped().into(),
            unfinished_islands: report.unfinished_islands.into(),
            asleep: account.asleep.into(),
            squeezed: account.squeezed.into(),
            contact_work: report.energy_account.contacts,
            collider_work: report.energy_account.colliders,
            correction_work: report.energy_account.correction,
            emission_energy: report.energy_account.emission,
            residual: account.residual,
            largest_overlap: account.largest_overlap,
        }
    })
}

/// Reads the work of the kicks of colliders in the last step [J]; 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_kick_work(world: CaromWorld, work: *mut f64) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    let place = unsafe { Out::new(work, "work") };
    world.measure(place, |inner| inner.world.report().energy_account.kicks)
}

/// Reads the energy that held forces added in the last step under the rule `exact` [J], besides
/// carom_world_energy_account(); 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_integration_energy(
    world: CaromWorld,
    energy: *mut f64,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    let place = unsafe { Out::new(energy, "energy") };
    world.measure(place, |inner| inner.world.report().energy_account.integration)
}

/// Reads the impacts of the last step in order of time, in the way of carom_world_ids().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_impacts(
    world: CaromWorld,
    impacts: *mut CaromImpact,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(impacts, array, count, "impacts") }?;
        world.with(|inner| room.fill(inner.world.report().impacts.iter().map(impact)))
    })
}

/// Reads the persistent contacts with their forces, in the way of carom_world_ids(). They exist
/// under the rules `exact` and `contact` after a step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_contacts(
    world: CaromWorld,
    contacts: *mut CaromContact,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(contacts, array, count, "contacts") }?;
        world.with(|inner| room.fill(inner.world.contacts().iter().map(contact)))
    })
}

/// Reads which spheres are inside triggers at the end of the last step, in the way of
/// carom_world_ids().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_triggers(
    world: CaromWorld,
    triggers: *mut CaromTrigger,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(triggers, array, count, "triggers") }?;
        world.with(|inner| room.fill(inner.world.report().triggers.iter().map(trigger)))
    })
}

/// Reads which spheres entered and left triggers in the last step, in order of time, in the way of
/// carom_world_ids(): all of them, however small the trigger and however fast the sphere.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_sensor_events(
    world: CaromWorld,
    events: *mut CaromSensorEvent,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(events, array, count, "events") }?;
        world.with(|inner| room.fill(inner.world.report().sensor_events.iter().map(sensor_event)))
    })
}

/// Reads which spheres entered wells, left them or turned back at their edge in the last step, in order
/// of time, in the way of carom_world_ids().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_well_events(
    world: CaromWorld,
    events: *mut CaromWellEvent,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(events, array, count, "events") }?;
        world.with(|inner| room.fill(inner.world.report().well_events.iter().map(well_event)))
    })
}
