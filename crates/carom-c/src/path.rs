//! Predicted paths of spheres, by handle.

use carom::{PathEnd, PathLeg, PredictedPath, SphereId};

use crate::handle::Registry;
use crate::pointer::{Out, Room, RowsMut, Strided};
use crate::report::{CaromImpact, impact};
use crate::status::{CaromStatus, Failure, call};
use crate::world::CaromWorld;

/// A handle of a predicted path. It is never reused; zero is no path.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CaromPath {
    /// The handle.
    pub id: u64,
}

/// All paths of this process.
static PATHS: Registry<PredictedPath> = Registry::new("path");

/// Where a predicted path ends.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CaromPathEnd {
    /// At the end of the time asked for.
    Horizon = 0,
    /// At the last impact asked for.
    Impacts = 1,
    /// Where a step would take the sphere in a stepped zone.
    NoClosedForm = 2,
}

/// A piece of a predicted path: a flight from an event to the next.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CaromPathLeg {
    /// When it begins, on the world's clock [s].
    pub start: f64,
    /// When it ends, on the world's clock [s].
    pub end: f64,
    /// When the flight's own time is 0, on the world's clock [s]; it may be before `start`.
    pub flight_start: f64,
    /// Centre then [m].
    pub position: [f64; 3],
    /// Velocity then [m/s].
    pub velocity: [f64; 3],
    /// Acceleration by everything but drag [m/s^2]; along a round surface that of its beginning.
    pub acceleration: [f64; 3],
    /// Drag coefficient over mass [1/s], >= 0.
    pub drag_rate: f64,
}

fn leg(leg: &PathLeg) -> CaromPathLeg {
    CaromPathLeg {
        start: leg.start,
        end: leg.end,
        flight_start: leg.flight_start,
        position: leg.flight.position.to_array(),
        velocity: leg.flight.velocity.to_array(),
        acceleration: leg.flight.acceleration.to_array(),
        drag_rate: leg.flight.drag_rate,
    }
}

/// Predicts the path of a sphere for `horizon` [s], or up to its impact number `most_impacts`, and
/// writes its handle. The world does not change. The other spheres keep to their flights, but for
/// those that the sphere strikes. While nothing else interferes, steps under the rule `exact` give
/// the same to the bit. Springs, and forces that are not linear, are refused.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_predict(
    world: CaromWorld,
    sphere: u64,
    horizon: f64,
    most_impacts: usize,
    path: *mut CaromPath,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut place = unsafe { Out::new(path, "path") }?;
        let sphere = SphereId::from_number(sphere);
        let path = world.with(|inner| Ok(inner.world.predict(sphere, horizon, most_impacts)?))?;
        place.set(CaromPath { id: PATHS.add(path) });
        Ok(())
    })
}

/// Frees a path.
#[unsafe(no_mangle)]
pub extern "C" fn carom_path_free(path: CaromPath) -> CaromStatus {
    call(|| PATHS.take(path.id).map(drop))
}

/// Reads where a path ends (CaromPathEnd), and when, on the world's clock [s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_path_end(
    path: CaromPath,
    end: *mut i32,
    time: *mut f64,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut end = unsafe { Out::new(end, "end") }?;
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let mut time = unsafe { Out::new(time, "time") }?;
        let path = PATHS.get(path.id)?;
        let reason = match path.end {
            PathEnd::Impacts => CaromPathEnd::Impacts,
            PathEnd::NoClosedForm => CaromPathEnd::NoClosedForm,
            // `PathEnd` may get further ends.
            _ => CaromPathEnd::Horizon,
        };
        end.set(reason as i32);
        time.set(path.end_time());
        Ok(())
    })
}

/// Reads centre [m] and velocity [m/s], three numbers each, at a time on the world's clock [s]; at
/// an event those after it. In a periodic box the centre is within it. A time outside of the path
/// is CAROM_STATUS_INVALID.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_path_at(
    path: CaromPath,
    time: f64,
    position: *mut f64,
    velocity: *mut f64,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride: 0, count: 1 };
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let mut position = unsafe { RowsMut::new(position, array, 3, "position") }?;
        // SAFETY: the caller's array is null or has this layout, as the header demands.
        let mut velocity = unsafe { RowsMut::new(velocity, array, 3, "velocity") }?;
        let path = PATHS.get(path.id)?;
        let (Some(center), Some(speed)) = (path.position_at(time), path.velocity_at(time)) else {
            let problem = format!("`time` must be one of the path, not {time}");
            return Err(Failure::new(CaromStatus::Invalid, problem));
        };
        position.set_row(0, center.to_array());
        velocity.set_row(0, speed.to_array());
        Ok(())
    })
}

/// Reads the impacts of the sphere on its way in the way of carom_world_ids(). Their times are from
/// the prediction on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_path_impacts(
    path: CaromPath,
    impacts: *mut CaromImpact,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(impacts, array, count, "impacts") }?;
        room.fill(PATHS.get(path.id)?.impacts.iter().map(impact))
    })
}

/// Reads the legs of a path, one after the other without gaps in time, in the way of
/// carom_world_ids().
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_path_legs(
    path: CaromPath,
    legs: *mut CaromPathLeg,
    stride: usize,
    capacity: usize,
    count: *mut usize,
) -> CaromStatus {
    call(|| {
        let array = Strided { stride, count: capacity };
        // SAFETY: the caller's array and pointer are null or valid, as the header demands.
        let room = unsafe { Room::new(legs, array, count, "legs") }?;
        room.fill(PATHS.get(path.id)?.legs.iter().map(leg))
    })
}
