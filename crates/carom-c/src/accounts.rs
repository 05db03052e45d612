//! Accounts of the last step: its work, changes of energy, impacts at one time, contacts, stepped zones.

use carom::ImpactGroup;

use crate::pointer::{Out, Room, Strided};
use crate::status::{CaromStatus, call};
use crate::world::CaromWorld;

/// Changes of the energy in the last step: the total energy changes by their sum, and by the error of
/// the integration.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromEnergyAccount {
    /// Work of contacts [J]: the energy change by restitution and friction.
    pub contacts: f64,
    /// Work of moving colliders [J].
    pub colliders: f64,
    /// Work of the kicks of colliders [J].
    pub kicks: f64,
    /// Work of growing spheres [J].
    pub growth: f64,
    /// Work of the steady shear of a periodic box [J].
    pub shear: f64,
    /// Energy that a thermostat added [J]; < 0 where it took some.
    pub thermostat: f64,
    /// Work of forces without a potential [J]: drag, wind, vortices, dampers, forces of the program.
    pub forces: f64,
    /// Work of the forces applied to single spheres [J].
    pub applied: f64,
    /// Work of the correction of overlaps [J].
    pub correction: f64,
    /// Energy of emitted spheres minus that of removed ones [J].
    pub emission: f64,
}

/// Reads the changes of the energy in the last step; all are 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_energy_account(
    world: CaromWorld,
    account: *mut CaromEnergyAccount,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(account, "account") }, |inner| {
        let account = inner.world.report().energy_account;
        CaromEnergyAccount {
            contacts: account.contacts,
            colliders: account.colliders,
            kicks: account.kicks,
            growth: account.growth,
            shear: account.shear,
            thermostat: account.thermostat,
            forces: account.forces,
            applied: account.applied,
            correction: account.correction,
            emission: account.emission,
        }
    })
}

/// Impacts at one instant among bodies that touch each other, with their common momentum and energy.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromImpactGroup {
    /// Index of its first impact in the list of carom_world_impacts().
    pub first: u64,
    /// Number of its impacts.
    pub count: u64,
    /// Momentum of its spheres before [kg m/s].
    pub momentum_before: [f64; 3],
    /// Momentum after, less what colliders gave [kg m/s]: as before, up to rounding.
    pub momentum_after: [f64; 3],
    /// Kinetic energy of its spheres before [J].
    pub energy_before: f64,
    /// Kinetic energy after, less the work of moving colliders, of kicks and of growth [J].
    pub energy_after: f64,
    /// Change of the kinetic energy that the coefficients of restitution demand [J], <= 0.
    pub energy_demanded: f64,
    /// Work of moving colliders [J].
    pub collider_work: f64,
    /// Work of the kicks of colliders, and of spheres that grow [J].
    pub kick_work: f64,
}

fn impact_group(group: &ImpactGroup) -> CaromImpactGroup {
    CaromImpactGroup {
        first: group.first as u64,
        count: group.count as u64,
        momentum_before: group.momentum_before.to_array(),
        momentum_after: group.momentum_after.to_array(),
        energy_before: group.energy_before,
        energy_after: group.energy_after,
        energy_demanded: group.energy_demanded,
        collider_work: group.collider_work,
        kick_work: group.kick_work,
    }
}

/// Reads the groups of impacts of the last step in order of time, in the way of carom_world_ids(); none
/// under the rules `discrete` and `bisect`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_impact_groups(
    world: CaromWorld,
    groups: *mut CaromImpactGroup,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(groups, array, count, "groups") }?;
        world.with(|inner| room.fill(inner.world.report().groups.iter().map(impact_group)))
    })
}

/// The work of the last step by stage: counts that depend only on the world, not on the machine.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromStageCounts {
    /// Under the rule `exact`: predictions of a sphere's next events.
    pub predictions: u64,
    /// Pairs of spheres tested for an impact, or under other rules for a contact.
    pub pair_tests: u64,
    /// Under the rule `exact`: events taken from the queue, with outdated ones.
    pub events: u64,
    /// Under the rule `exact`: cell crossings among these events.
    pub cell_crossings: u64,
    /// Under the rule `exact`: groups of touching bodies resolved as a whole.
    pub groups: u64,
    /// Iterations of the solvers of these groups, counted once per contact.
    pub solver_iterations: u64,
    /// Under the rule `contact`: neighbour searches.
    pub searches: u64,
    /// Under the rule `contact`: sweeps over all contacts.
    pub sweeps: u64,
    /// Under the rule `contact`: contacts per sweep at the end of the step.
    pub contacts: u64,
}

/// Reads the work of the last step; all counts are 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_work(
    world: CaromWorld,
    work: *mut CaromStageCounts,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(work, "work") }, |inner| {
        let work = inner.world.report().work;
        CaromStageCounts {
            predictions: work.predictions,
            pair_tests: work.pair_tests,
            events: work.events,
            cell_crossings: work.cell_crossings,
            groups: work.groups,
            solver_iterations: work.solver_iterations,
            searches: work.searches,
            sweeps: work.sweeps,
            contacts: work.contacts,
        }
    })
}

/// Quality of the solution of the last step under the rule `contact`, and in stepped zones of `exact`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromContactAccount {
    /// Sub-steps in which impulses were reduced so that they add no energy.
    pub limited_sub_steps: u64,
    /// Sleeping spheres at the end of the step.
    pub asleep: u64,
    /// How often a sphere was pressed into a surface by half its radius, summed over sub-steps.
    pub squeezed: u64,
    /// Largest change of an impulse in the last sweep, relative to the largest impulse.
    pub residual: f64,
    /// Largest overlap before its correction, relative to the sum of radii.
    pub largest_overlap: f64,
}

/// Reads the account of contacts of the last step; all is 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_contact_account(
    world: CaromWorld,
    account: *mut CaromContactAccount,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(account, "account") }, |inner| {
        let account = inner.world.report().contact_account;
        CaromContactAccount {
            limited_sub_steps: account.limited_sub_steps.into(),
            asleep: account.asleep.into(),
            squeezed: account.squeezed.into(),
            residual: account.residual,
            largest_overlap: account.largest_overlap,
        }
    })
}

/// Spheres that the rule `exact` stepped in the last step instead of moving them from impact to impact.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromZoneAccount {
    /// Spheres in a zone at the end of the step.
    pub spheres: u64,
    /// Ticks at which a zone was stepped.
    pub ticks: u64,
    /// Spheres that joined a zone.
    pub joined: u64,
    /// Spheres that left a zone.
    pub left: u64,
    /// Total time of all spheres in zones [s].
    pub sphere_seconds: f64,
}

/// Reads the account of zones of the last step; all is 0 after carom_world_restore().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_zone_account(
    world: CaromWorld,
    account: *mut CaromZoneAccount,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(account, "account") }, |inner| {
        let account = inner.world.report().zone_account;
        CaromZoneAccount {
            spheres: account.spheres.into(),
            ticks: account.ticks.into(),
            joined: account.joined.into(),
            left: account.left.into(),
            sphere_seconds: account.sphere_seconds,
        }
    })
}
