//! Grains in a drum that turns about its horizontal axis: the regimes of their motion by the Froude number R w²/g.

use std::f64::consts::FRAC_PI_2;

use carom::{
    BodyPair, Collider, ColliderId, Contact, DQuat, DVec3, Ends, Error, Friction, Pose, Rule,
    Shape, World,
};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};
use super::grains::{DIAMETER, empty, grain};
use super::setup::{FRAME, G, half_space, run_until};

/// Radius of the drum, and the distance of its smooth ends.
const RADIUS: f64 = 8.0 * DIAMETER;
const LENGTH: f64 = 6.0 * DIAMETER;
/// Number of grains: they fill a fifth of the drum.
const COUNT: usize = 300;
/// Rate at which a drum raises its bed to where it flows, within seconds \[rad/s\].
const RAISING: f64 = 0.15;
/// Distance of grains before they fall.
const SPACING: f64 = 1.1 * DIAMETER;

pub fn claims() -> Vec<Claim> {
    let source = "Mellmann, Powder Technology 118, 251 (2001)";
    let regimes = Claim::new(
        "drum at R w²/g = 2e-5, 1e-2, 0.5, 4: slumps, rolls, is flung, is held [that are so]",
        Expected::value(4.0, source),
        Tolerance::none("each is so or is not"),
        |_| regimes(),
    );
    let held = Claim::new(
        "drum at R w²/g = 4: turning of the grains [that of the drum]",
        Expected::value(1.0, "Mellmann (2001): centrifuging"),
        Tolerance::absolute(0.02, "grains within the layer roll past each other"),
        |_| {
            let drum = turned(4.0, [6.0, 3.0])?;
            Ok(Measured::in_world(&drum.world, drum.turning))
        },
    );
    let claims = [regimes, held];
    claims.map(|claim| claim.slow().about(Rule::Contact(Contact::default()))).into()
}

/// How grains move in a drum that has turned for a while.
struct Drum {
    world: World,
    /// Mean turning about the axis relative to that of the drum, by the moment of inertia.
    turning: f64,
    /// Part of the frames in which grains turn with the drum nearly as one body.
    solid: f64,
    /// Mean number of contacts of a grain.
    contacts: f64,
}

/// Counts the Froude numbers at which grains move as they should: the bed turns as one body between avalanches, flows
/// all the time, leaves the wall, or is held at it.
fn regimes() -> Outcome {
    let slumping = turned(2e-5, [10.0, 30.0])?;
    let rolling = turned(1e-2, [8.0, 6.0])?;
    let flung = turned(0.5, [5.0, 5.0])?;
    let held = turned(4.0, [6.0, 3.0])?;
    let are_so = [
        slumping.solid > 0.7 && slumping.turning < 0.95 && slumping.contacts > 2.0,
        rolling.solid < 0.4 && rolling.turning < 0.6 && rolling.contacts > 1.7,
        flung.turning < 0.6 && flung.contacts < 0.6 * rolling.contacts,
        held.turning > 0.95,
    ];
    let worlds = [&slumping, &rolling, &flung, &held].map(|it| Measured::in_world(&it.world, 0.0));
    let count = are_so.iter().filter(|&&is_so| is_so).count();
    Ok(Measured { value: count as f64, ..Measured::sum(worlds) })
}

/// Turns a drum at a Froude number for a time \[s\], most of it not slower than [`RAISING`], and measures it for
/// another.
fn turned(froude: f64, [begin, time]: [f64; 2]) -> Result<Drum, Error> {
    let rate = (froude * G / RADIUS).sqrt();
    let (mut world, drum) = filled(rate.max(RAISING))?;
    run_until(&mut world, 0.8 * begin, FRAME)?;
    let steady = world.collider(drum)?.moving(DVec3::ZERO, rate * DVec3::Z);
    world.set_collider(drum, steady)?;
    run_until(&mut world, begin, FRAME)?;
    let (mut turning, mut solid, mut contacts, mut frames) = (0.0, 0.0, 0.0, 0.0);
    while world.time() < begin + time {
        world.step(FRAME)?;
        let of_bed = turning_of(&world) / rate;
        turning += of_bed;
        solid += f64::from(u8::from(of_bed > 0.8));
        contacts += contacts_of_grains(&world) / COUNT as f64;
        frames += 1.0;
    }
    let [turning, solid, contacts] = [turning, solid, contacts].map(|sum: f64| sum / frames);
    Ok(Drum { world, turning, solid, contacts })
}

/// Creates a drum about the z axis that turns at a rate \[rad/s\], with grains that fall to its bottom.
fn filled(rate: f64) -> Result<(World, ColliderId), Error> {
    let mut world = empty()?;
    let along = DQuat::from_rotation_x(FRAC_PI_2);
    let pipe = Shape::Pipe { radius: RADIUS, length: 2.0 * LENGTH, closed: Ends::NONE };
    let drum = Collider::new(pipe, Pose::at(DVec3::ZERO).rotated(along)).with_restitution(0.0);
    let drum = drum.with_friction(1.0).moving(DVec3::ZERO, rate * DVec3::Z);
    let drum = world.add_collider(drum)?;
    for normal in [DVec3::Z, DVec3::NEG_Z] {
        world.add_collider(half_space(-0.5 * LENGTH * normal, normal).with_restitution(0.0))?;
    }
    let rough = grain(DIAMETER, Friction::sliding(1.0).with_rolling(0.02));
    places().take(COUNT).try_for_each(|place| {
        world.add_sphere(rough.with_position(place))?;
        Ok(())
    })?;
    Ok((world, drum))
}

/// Places in layers from the bottom of the drum on; every second layer is shifted.
fn places() -> impl Iterator<Item = DVec3> {
    let layers = (2.0 * RADIUS / SPACING) as u32;
    let across = (LENGTH / SPACING) as u32;
    let grid = (0..layers).flat_map(move |layer| {
        (0..layers).flat_map(move |column| (0..across).map(move |row| [layer, column, row]))
    });
    let place = move |[layer, column, row]: [u32; 3]| {
        let shift = 0.25 * f64::from(layer % 2) + 0.1 * f64::from(row % 2);
        let x = (f64::from(column) + 0.5 + shift) * SPACING - RADIUS;
        let y = (f64::from(layer) + 0.5) * SPACING - RADIUS;
        DVec3::new(x, y, (f64::from(row) + 0.5) * SPACING - 0.5 * LENGTH)
    };
    let is_inside = |place: &DVec3| place.with_z(0.0).length() < RADIUS - 0.55 * DIAMETER;
    grid.map(place).filter(is_inside)
}

/// Turning of all grains about the z axis \[rad/s\], by the moment of inertia.
fn turning_of(world: &World) -> f64 {
    let spheres = world.spheres();
    let states = spheres.positions().iter().zip(spheres.velocities());
    let (mut momentum, mut inertia) = (0.0, 0.0);
    for (position, velocity) in states {
        momentum += position.x * velocity.y - position.y * velocity.x;
        inertia += position.with_z(0.0).length_squared();
    }
    momentum / inertia
}

/// Number of contacts of all grains: those of two count for each.
fn contacts_of_grains(world: &World) -> f64 {
    let count = |pair: &BodyPair| match pair {
        BodyPair::Spheres(..) => 2.0,
        BodyPair::Collider { .. } => 1.0,
    };
    world.contacts().iter().map(|contact| count(&contact.between)).sum()
}
