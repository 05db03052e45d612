//! Lists of ids: spheres, colliders, forces, emitters and springs.

use carom::SphereId;

use crate::pointer::{Room, Strided};
use crate::status::{CaromStatus, Failure, call};
use crate::world::{CaromWorld, Inner};

/// A list of ids.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaromList {
    /// Spheres, ascending: the order of all arrays.
    Spheres = 0,
    /// Colliders, in their order.
    Colliders = 1,
    /// Forces, in the order in which they add up.
    Forces = 2,
    /// Emitters, in the order in which they emit.
    Emitters = 3,
    /// Spheres that emitters added in the last step, ascending.
    Emitted = 4,
    /// Spheres that emitters removed in the last step.
    Retired = 5,
    /// Ids of spheres that emitters left out in the last step for lack of space; no sphere ever has
    /// them.
    LeftOut = 6,
    /// Springs, in the order in which their forces add up.
    Springs = 7,
}

/// Reads a list of ids (CaromList), with `stride` bytes from one to the next (0: no gaps), and
/// writes their number to `count`. If `ids` is null, only the number is written. More than
/// `capacity` ids are an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_ids(
    world: CaromWorld,
    list: i32,
    ids: *mut u64,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(ids, Strided { stride, count: capacity }, count, "ids") }?;
        world.with(|inner| room.fill(of_list(inner, list)?.into_iter()))
    })
}

fn of_list(inner: &Inner, list: i32) -> Result<Vec<u64>, Failure> {
    let (world, report) = (&inner.world, inner.world.report());
    let sphere_numbers = |ids: &[SphereId]| ids.iter().map(|id| id.number()).collect();
    let lists = [
        CaromList::Spheres,
        CaromList::Colliders,
        CaromList::Forces,
        CaromList::Emitters,
        CaromList::Emitted,
        CaromList::Retired,
        CaromList::LeftOut,
        CaromList::Springs,
    ];
    let found = lists.into_iter().find(|it| *it as i32 == list);
    Ok(match found {
        Some(CaromList::Spheres) => sphere_numbers(world.spheres().ids()),
        Some(CaromList::Colliders) => world.colliders().map(|(id, _)| id.number()).collect(),
        Some(CaromList::Forces) => world.forces().map(|(id, _)| id.number()).collect(),
        Some(CaromList::Emitters) => world.emitters().map(|(id, _)| id.number()).collect(),
        Some(CaromList::Emitted) => sphere_numbers(&report.emitted),
        Some(CaromList::Retired) => sphere_numbers(&report.retired),
        Some(CaromList::LeftOut) => sphere_numbers(&report.left_out),
        Some(CaromList::Springs) => world.springs().map(|(id, _)| id.number()).collect(),
        None => {
            let problem = format!("there is no list {list}");
            return Err(Failure::new(CaromStatus::Argument, problem));
        }
    })
}
