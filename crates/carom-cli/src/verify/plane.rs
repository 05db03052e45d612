//! Discs in a plane, against an equation of state.

use carom::{Boundary, DVec3, Exact, Rule, Settings, Sphere, StressMeter, World};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use crate::numbers::Numbers;

/// Discs along an edge of the square.
const SIDE: usize = 32;
/// Frames before the measurement and in it, each the time in which a disc flies its diameter.
const FRAMES: [u32; 2] = [40, 200];

pub fn claims() -> Vec<Claim> {
    let claim = |packing_fraction: f64| {
        let free = 1.0 - packing_fraction;
        let z = (1.0 + packing_fraction * packing_fraction / 8.0) / (free * free);
        let source = "Henderson 1975, (1 + p²/8)/(1 - p)²";
        let reason = "statistics 0.3 %, the equation itself 0.3 %";
        Claim::new(
            format!("compressibility factor of discs that fill {packing_fraction} of a plane"),
            Expected::value(z, source),
            Tolerance::relative(0.01, reason),
            move |_| compressibility(packing_fraction),
        )
        .about(Rule::Exact(Exact::default()))
    };
    [0.2, 0.4, 0.5].map(claim).into()
}

/// Discs of diameter 1 on a lattice, with momentum zero and k T of 1 J.
fn gas(packing_fraction: f64) -> Result<World, carom::Error> {
    let count = SIDE * SIDE;
    let spacing = (std::f64::consts::FRAC_PI_4 / packing_fraction).sqrt();
    let edge = spacing * SIDE as f64;
    let boundary = Boundary::Periodic { size: DVec3::new(edge, edge, f64::INFINITY) };
    let mut world = World::new(Settings::default().with_dimensions(2).with_boundary(boundary))?;
    let mut numbers = Numbers::new(1);
    let mut velocities: Vec<DVec3> =
        (0..count).map(|_| numbers.normal_vector().with_z(0.0)).collect();
    let mean = velocities.iter().sum::<DVec3>() / count as f64;
    velocities.iter_mut().for_each(|velocity| *velocity -= mean);
    let square: f64 = velocities.iter().map(|velocity| velocity.length_squared()).sum();
    let factor = (2.0 * (count - 1) as f64 / square).sqrt();
    for (number, velocity) in velocities.into_iter().enumerate() {
        let place = [number % SIDE, number / SIDE];
        let [x, y] = place.map(|it| (it as f64 + 0.5) * spacing - 0.5 * edge);
        let disc = Sphere::new(DVec3::new(x, y, 0.0), 0.5).with_velocity(factor * velocity);
        world.add_sphere(disc)?;
    }
    Ok(world)
}

fn compressibility(packing_fraction: f64) -> Outcome {
    let mut world = gas(packing_fraction)?;
    let [before, measured] = FRAMES;
    for _ in 0..before {
        world.step(1.0)?;
    }
    let mut meter = StressMeter::new(&world);
    for _ in 0..measured {
        world.step(1.0)?;
        meter.add_frame(&world);
    }
    let area = meter.volume().unwrap_or(f64::NAN);
    // The momentum is zero, so one disc is not free.
    let free = (SIDE * SIDE - 1) as f64;
    Ok(Measured::in_world(&world, meter.stress(None)?.pressure() * area / free))
}
