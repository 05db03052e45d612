//! Measured quantities of a world: energies, momenta, overlaps.

use crate::pointer::{Out, Room, Strided};
use crate::report::{CaromOverlap, overlap};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// Sums over all spheres.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromTotals {
    /// Kinetic energy, with rotation [J].
    pub kinetic_energy: f64,
    /// Kinetic energy of rotation [J].
    pub rotational_energy: f64,
    /// Potential energy in all forces that have one [J].
    pub potential_energy: f64,
    /// Momentum [kg m/s].
    pub momentum: [f64; 3],
    /// Angular momentum about the origin, with spin [kg m^2/s].
    pub angular_momentum: [f64; 3],
}

/// Reads the total energies and momenta of all spheres.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_totals(
    world: CaromWorld,
    totals: *mut CaromTotals,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(totals, "totals") }, |inner| CaromTotals {
        kinetic_energy: inner.world.kinetic_energy(),
        rotational_energy: inner.world.rotational_energy(),
        potential_energy: inner.world.potential_energy(),
        momentum: inner.world.momentum().to_array(),
        angular_momentum: inner.world.angular_momentum().to_array(),
    })
}

/// Reads whether spheres are rotated or rotate, or may start to by friction: 1, else 0. Otherwise a
/// program need not draw their orientations.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_has_spin(
    world: CaromWorld,
    has_spin: *mut u32,
) -> CaromStatus {
    // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
    world.measure(unsafe { Out::new(has_spin, "has_spin") }, |inner| inner.world.has_spin().into())
}

/// Reads which spheres overlap each other (if spheres collide) or a solid collider by more than
/// `tolerance` [m], in the way of carom_world_ids().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_overlaps(
    world: CaromWorld,
    tolerance: f64,
    overlaps: *mut CaromOverlap,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(overlaps, array, count, "overlaps") }?;
        if tolerance.is_nan() || tolerance < 0.0 {
            let problem = format!("`tolerance` must be zero or positive, not {tolerance}");
            return Err(Failure::new(CaromStatus::Invalid, problem));
        }
        world.with(|inner| room.fill(inner.world.overlaps(tolerance).iter().map(overlap)))
    })
}
