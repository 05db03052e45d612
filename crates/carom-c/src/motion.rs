//! Impulses on spheres, and the groups and data of each.

use carom::{DVec3, Groups, Sphere, SphereId};

use crate::pointer::{Out, Rows, Strided};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// Reads three numbers of the program.
///
/// # Safety
/// `numbers` is null, or three numbers can be read there.
pub(crate) unsafe fn vector(numbers: *const f64, name: &str) -> Result<DVec3, Failure> {
    let array = Strided { stride: 0, count: 1 };
    // SAFETY: the caller promises three numbers.
    let row = unsafe { Rows::new(numbers, array, 3, name) }?;
    Ok(DVec3::from_array(row.row::<3>(0)))
}

/// Applies an impulse, three numbers [N s], to a sphere at its centre: its velocity changes by the
/// impulse over its mass.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_apply_impulse(
    world: CaromWorld,
    sphere: u64,
    impulse: *const f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let impulse = unsafe { vector(impulse, "impulse") }?;
        let id = SphereId::from_number(sphere);
        world.with(|inner| Ok(inner.world.apply_impulse(id, impulse)?))
    })
}

/// Applies an impulse [N s] to a sphere at a point [m], three numbers each: its velocity changes as
/// by carom_world_apply_impulse(), its angular velocity by (point - centre) x impulse over its
/// moment of inertia.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_apply_impulse_at(
    world: CaromWorld,
    sphere: u64,
    impulse: *const f64,
    point: *const f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let impulse = unsafe { vector(impulse, "impulse") }?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let point = unsafe { vector(point, "point") }?;
        let id = SphereId::from_number(sphere);
        world.with(|inner| Ok(inner.world.apply_impulse_at(id, impulse, point)?))
    })
}

/// Reads the groups that a sphere is in and those that it collides with, one bit for each of 32.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_groups(
    world: CaromWorld,
    sphere: u64,
    groups: *mut u32,
    collides_with: *mut u32,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut groups = unsafe { Out::new(groups, "groups") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut collides_with = unsafe { Out::new(collides_with, "collides_with") }?;
        let id = SphereId::from_number(sphere);
        let own = world.with(|inner| Ok(inner.world.sphere(id)?.groups))?;
        groups.set(own.groups);
        collides_with.set(own.collides_with);
        Ok(())
    })
}

/// Sets the groups that a sphere is in and those that it collides with, one bit for each of 32. Two
/// bodies collide if each is in a group that the other collides with.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_set_groups(
    world: CaromWorld,
    sphere: u64,
    groups: u32,
    collides_with: u32,
) -> CaromStatus {
    let groups = Groups { groups, collides_with };
    change(world, sphere, |sphere| sphere.with_groups(groups))
}

/// Reads the number of a sphere for programs; 0 unless it was set.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_user_data(
    world: CaromWorld,
    sphere: u64,
    user_data: *mut u64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(user_data, "user_data") }?;
        let id = SphereId::from_number(sphere);
        place.set(world.with(|inner| Ok(inner.world.sphere(id)?.user_data))?);
        Ok(())
    })
}

/// Sets the number of a sphere for programs; it is no part of the physics.
#[unsafe(no_mangle)]
pub extern "C" fn carom_world_set_user_data(
    world: CaromWorld,
    sphere: u64,
    user_data: u64,
) -> CaromStatus {
    change(world, sphere, |sphere| sphere.with_user_data(user_data))
}

fn change(world: CaromWorld, sphere: u64, change: impl FnOnce(Sphere) -> Sphere) -> CaromStatus {
    call(|| {
        let id = SphereId::from_number(sphere);
        world.with(|inner| {
            let sphere = change(inner.world.sphere(id)?);
            Ok(inner.world.set_sphere(id, sphere)?)
        })
    })
}
