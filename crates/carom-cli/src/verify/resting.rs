//! Persistent contact: rest on a floor, and sliding on a fixed sphere until the ball leaves it.

use carom::{Collider, DVec3, Gravity, Pose, Rule, Shape, Sphere};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::setup::{FRAME, G, run_until, world, world_with_floor};

/// Speed below which a ball is at rest \[m/s\].
const REST: f64 = 1e-9;
const BALLS: usize = 5;

pub fn claims() -> Vec<Claim> {
    let rest = |name: &str, gap: f64, e: f64| {
        Claim::new(
            format!("a stack of {BALLS} balls {name} is at rest [m/s]"),
            Expected::no_error("equilibrium"),
            Tolerance::absolute(REST, "as demanded; at rest is 0"),
            move |rule| stack(rule, gap, e),
        )
    };
    vec![
        rest("on a floor", 0.0, 1.0),
        rest("dropped on a floor, e = 0.5, after 10 s", 0.1, 0.5),
        Claim::new(
            "a stack of balls dropped on a floor ends ball on ball [m]",
            Expected::no_error("equilibrium"),
            Tolerance::absolute(1e-9, "ten times what bounces below 1e-10 s leave at 5 m/s"),
            |rule| gaps_of_stack(rule, 0.1, 0.5),
        ),
        Claim::new(
            "a ball that slides from rest at angle a leaves a fixed sphere at cos = 2/3 cos a",
            Expected::value(2.0 / 3.0, "energy and the centripetal force"),
            Tolerance::absolute(2e-3, "the gap opens with the third power of time: 1 mm/s late"),
            |rule| leaving(rule).map(|(cosine, _)| cosine),
        ),
        Claim::new(
            "a ball that slides on a fixed sphere keeps its energy [relative]",
            Expected::no_error("no friction"),
            Tolerance::absolute(
                1e-5,
                "700 pieces of 1e-3 rad, each right to the third order, and a margin of ten",
            ),
            |rule| leaving(rule).map(|(_, energy)| energy),
        ),
    ]
}

/// Stacks balls over a floor with gaps of `gap` \[m\], and returns the world 10 s later.
fn stacked(rule: Rule, gap: f64, e: f64) -> Result<carom::World, carom::Error> {
    let mut world = world_with_floor(rule, e)?;
    let mut settings = *world.settings();
    settings.combine_rule = carom::CombineRule::Minimum;
    world.set_settings(settings)?;
    for i in 0..BALLS {
        let height = 0.5 + gap + (1.0 + gap) * i as f64;
        world.add_sphere(Sphere::new(DVec3::new(0.0, height, 0.0), 0.5).with_restitution(e))?;
    }
    run_until(&mut world, 10.0, FRAME)?;
    Ok(world)
}

fn stack(rule: Rule, gap: f64, e: f64) -> Outcome {
    let world = stacked(rule, gap, e)?;
    let fastest = world.spheres().velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
    Ok(Measured::in_world(&world, fastest))
}

fn gaps_of_stack(rule: Rule, gap: f64, e: f64) -> Outcome {
    let world = stacked(rule, gap, e)?;
    let places = world.spheres().positions().iter().enumerate();
    let errors = places.map(|(i, place)| (place.y - 0.5 - i as f64).abs());
    Ok(Measured::in_world(&world, errors.fold(0.0, f64::max)))
}

/// Slides a ball down a fixed sphere, from rest near the top. Measures the cosine of the angle
/// at which it leaves, relative to that at the start, and the largest error of the energy, relative
/// to the energy of the fall.
fn leaving(rule: Rule) -> Result<(Measured, Measured), Fault> {
    let (fixed, radius) = (1.0, 0.25);
    let reach = fixed + radius;
    let (sine, cosine) = libm::sincos(0.1);
    let mut world = world(rule)?;
    world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0)))?;
    world.add_collider(Collider::new(Shape::Sphere { radius: fixed }, Pose::at(DVec3::ZERO)))?;
    world.add_sphere(Sphere::new(reach * DVec3::new(sine, cosine, 0.0), radius))?;
    let (mut last, mut worst, energy) = (1.0, 0.0_f64, world.total_energy());
    while world.time() < 3.0 {
        world.step(1e-4)?;
        worst = worst.max((world.total_energy() - energy).abs());
        let place = world.spheres().positions()[0];
        // Larger than the deviations by rounding and by the pieces of the path.
        if place.length() - reach > 1e-9 {
            break;
        }
        last = place.y / (reach * cosine);
    }
    let relative = worst / (G * reach * cosine / 3.0);
    Ok((Measured::in_world(&world, last), Measured::in_world(&world, relative)))
}
