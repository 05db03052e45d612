//! Strikes by a cue.

use carom::SphereId;
use carom_scene::scene::Strike;

use crate::pointer::{Plain, read};
use crate::status::{CaromStatus, call};
use crate::world::CaromWorld;

/// A blow of a cue on a sphere, at one instant and one point, without loss of energy.
/// carom_strike() returns one with default values.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaromStrike {
    /// Speed of the cue [m/s], >= 0.
    pub speed: f64,
    /// Direction of the cue from above, from +x towards -z, counterclockwise [degrees].
    pub azimuth_degrees: f64,
    /// Angle by which the cue points down, in [0, 90] [degrees].
    pub elevation_degrees: f64,
    /// Offset of the cue from the centre to the right and up, as seen along it, in parts of the
    /// radius; its size is below 1.
    pub offset: [f64; 2],
    /// Mass of the cue [kg], > 0.
    pub cue_mass: f64,
}

// SAFETY: a structure of numbers.
unsafe impl Plain for CaromStrike {}

impl From<CaromStrike> for Strike {
    fn from(strike: CaromStrike) -> Self {
        let CaromStrike { speed, azimuth_degrees, elevation_degrees, offset, cue_mass } = strike;
        Self { speed, azimuth_degrees, elevation_degrees, offset, cue_mass }
    }
}

/// Returns a level strike at the middle along +x with the speed 0 by a cue of 0.567 kg.
#[unsafe(no_mangle)]
pub extern "C" fn carom_strike() -> CaromStrike {
    let Strike { speed, azimuth_degrees, elevation_degrees, offset, cue_mass } = Strike::new(0.0);
    CaromStrike { speed, azimuth_degrees, elevation_degrees, offset, cue_mass }
}

/// Strikes a sphere with a cue: changes its velocity and its angular velocity at once. A part that
/// presses it onto a table is answered by the table in the next step.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn carom_world_strike(
    world: CaromWorld,
    sphere: u64,
    strike: *const CaromStrike,
) -> CaromStatus {
    call(|| {
        // SAFETY: the caller's pointer is null or leads to its value, as the header demands.
        let strike = Strike::from(unsafe { read(strike, "strike") }?);
        let id = SphereId::from_number(sphere);
        world.with(|inner| {
            let strike = strike.on_radius(inner.world.sphere(id)?.radius);
            Ok(inner.world.strike(id, strike).map(drop)?)
        })
    })
}
