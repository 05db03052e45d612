//! Runs under the rule `exact` that several claims measure alike.

use std::f64::consts::TAU;

use carom::{Error, Exact, Rule, StateHash, World};

use super::claim::{Measured, Outcome};

pub fn exact() -> Rule {
    Exact::default().into()
}

/// Measures the largest change of the total energy in frames of this length \[s\], as a part of that at the start.
pub fn change_of_energy(mut world: World, frames: u32, frame: f64) -> Outcome {
    let before = world.total_energy();
    let mut largest = 0.0_f64;
    for _ in 0..frames {
        world.step(frame)?;
        largest = largest.max((world.total_energy() / before - 1.0).abs());
    }
    Ok(Measured::in_world(&world, largest))
}

/// Measures by how many periods the first sphere, which starts in the apocentre of its ellipse and moves along z there,
/// is off after `periods` of 2 pi s.
pub fn periods_off(mut world: World, periods: u32) -> Outcome {
    for _ in 0..periods {
        world.step(TAU)?;
    }
    let z = world.spheres().positions()[0].z;
    let speed = world.spheres().velocities()[0].z;
    Ok(Measured::in_world(&world, (z / speed / TAU).abs()))
}

/// Returns the speed \[m/s\] in the apocentre of an ellipse with a semi-major axis of 1 m and a period of 2 pi s.
pub fn speed_in_apocentre(eccentricity: f64) -> f64 {
    libm::sqrt((1.0 - eccentricity) / (1.0 + eccentricity))
}

/// Counts the runs of 10 s in frames of 1/32, 1/64 and 1/256 s that end in another state than the first.
pub fn other_states(start: impl Fn() -> Result<World, Error>) -> Outcome {
    let mut states: Vec<StateHash> = Vec::new();
    let mut last = start()?;
    for frames in [32, 64, 256] {
        last = start()?;
        for _ in 0..10 * frames {
            last.step(1.0 / f64::from(frames))?;
        }
        states.push(last.state_hash());
    }
    let others = states.iter().filter(|&&state| state != states[0]).count();
    Ok(Measured::in_world(&last, others as f64))
}
