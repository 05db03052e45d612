//! Grains in a silo: force on the floor, and rate of discharge.

use carom::{Collider, ColliderId, Contact, DVec3, Error, Pose, Rule, Shape, SphereId, World};

use super::claim::{Claim, Expected, Fault, Measured, Outcome, Tolerance};
use super::grains::{
    DIAMETER, add_floor, add_shaft, contacts_with, empty, fill, grain, settle, top,
};
use super::setup::{FRAME, G, run_until};

/// Coefficient of friction between grains.
const MU: f64 = 0.5;
/// Coefficient of friction at the walls of a column: so low that grains slide there instead of
/// rolling.
const WALL_MU: f64 = 0.2;
/// Width of a column \[diameters\].
const COLUMN_WIDTH: f64 = 7.0;

/// Number of grains in the silo.
const COUNT: usize = 3_000;
/// Width of the silo \[diameters\].
const SILO_WIDTH: f64 = 12.0;
/// Coefficients of Beverloo's law: of the rate through a circular opening, and of the part of its
/// width that the edge blocks \[diameters\].
const BEVERLOO: [f64; 2] = [0.58, 1.4];

pub fn claims() -> Vec<Claim> {
    let source = "Janssen (1895), with the ratio of pressures that is measured";
    let reason = "friction at the walls is used up to 95 %, and pressures are taken to be even";
    let janssen = |count: usize, widths: &str| {
        Claim::new(
            format!("floor under a column {widths} times as high as wide: force [Janssen's]"),
            Expected::value(1.0, source),
            Tolerance::absolute(0.1, reason),
            move |_| column(count),
        )
    };
    let source = "Beverloo, Chem. Eng. Sci. 15, 260 (1961): C = 0.58, k = 1.4, by area";
    let reason =
        "by material C is 0.55 to 0.65, k 1.3 to 1.5: 0.12 and 0.1; some hundred grains: 0.04";
    let rate = |opening: f64| {
        Claim::new(
            format!("silo with an opening of {opening} diameters: rate [Beverloo's]"),
            Expected::value(1.0, source),
            Tolerance::absolute(0.2, reason),
            move |_| discharge(opening),
        )
        .slow()
    };
    let claims = vec![
        janssen(750, "2"),
        janssen(1_500, "4").slow(),
        janssen(3_000, "8").slow(),
        rate(4.0),
        rate(5.0),
        rate(7.0),
    ];
    claims.into_iter().map(|claim| claim.about(Rule::Contact(Contact::default()))).collect()
}

/// Force on the floor of a column, relative to Janssen's formula. The floor sinks slowly, so that
/// the friction at the walls points upwards and is fully mobilized.
fn column(count: usize) -> Outcome {
    let mut world = empty()?;
    let floor = add_floor(&mut world, MU)?;
    let width = COLUMN_WIDTH * DIAMETER;
    let walls = add_shaft(&mut world, width, WALL_MU)?;
    fill(&mut world, grain(DIAMETER, MU), count, width)?;
    settle(&mut world, 8.0)?;
    let speed = 0.1 * DIAMETER;
    let sinking = world.collider(floor)?.moving(-speed * DVec3::Y, DVec3::ZERO);
    world.set_collider(floor, sinking)?;
    let (looks, apart) = (20, 0.2);
    // A tall column moves by several diameters before it slides along all walls.
    let begin = world.time() + 30.0;
    let mut sums = [0.0; 2];
    for look in 0..looks {
        run_until(&mut world, begin + apart * f64::from(look), FRAME)?;
        let forces = floor_forces(&world, floor, &walls)?;
        sums = [0, 1].map(|i| sums[i] + forces[i]);
    }
    Ok(Measured::in_world(&world, sums[0] / sums[1]))
}

/// Force on the floor of a column, and the force by Janssen's formula \[N\].
fn floor_forces(world: &World, floor: ColliderId, walls: &[ColliderId]) -> Result<[f64; 2], Error> {
    let spheres = world.spheres();
    let bottom = world.collider(floor)?.pose.position.y;
    let borne = contacts_with(world, floor).map(|(_, normal, _)| normal).sum();
    // Integral over the height of the vertical force: the weight above each height, minus the force
    // of the walls above it.
    let (mut weight, mut moment) = (0.0, 0.0);
    for (position, mass) in spheres.positions().iter().zip(spheres.masses()) {
        weight += G * mass;
        moment += G * mass * (position.y - bottom);
    }
    let height = 2.0 * moment / weight;
    let mut pressing = 0.0;
    for &wall in walls {
        for (point, normal, tangential) in contacts_with(world, wall) {
            pressing += normal;
            moment -= tangential.y * (point.y - bottom);
        }
    }
    // Ratio of horizontal to vertical pressure.
    let width = COLUMN_WIDTH * DIAMETER;
    let ratio = pressing * width / (4.0 * moment);
    let length = width / (4.0 * WALL_MU * ratio);
    Ok([borne, weight * length / height * (1.0 - libm::exp(-height / length))])
}

/// Creates a full silo that is closed by a lid below.
fn silo() -> Result<(World, ColliderId), Error> {
    let mut world = empty()?;
    let lid = add_floor(&mut world, MU)?;
    let width = SILO_WIDTH * DIAMETER;
    add_shaft(&mut world, width, MU)?;
    fill(&mut world, grain(DIAMETER, MU), COUNT, width)?;
    settle(&mut world, 6.0)?;
    Ok((world, lid))
}

/// Rate of discharge through an opening of this width \[diameters\], relative to Beverloo's law.
fn discharge(opening: f64) -> Outcome {
    let (mut world, lid) = silo()?;
    let part = discharge_from(&mut world, lid, opening)?;
    Ok(Measured::in_world(&world, part))
}

/// Opens a silo; returns its rate relative to Beverloo's law, measured while between a tenth and
/// half of the grains have left.
fn discharge_from(world: &mut World, lid: ColliderId, opening: f64) -> Result<f64, Fault> {
    let width = SILO_WIDTH * DIAMETER;
    let density = COUNT as f64 / (width * width * top(world));
    add_floor_with_opening(world, opening * DIAMETER)?;
    world.remove_collider(lid)?;
    let (mut removed, mut left) = (0, 0);
    let (mut begin, mut before) = (world.time(), 0);
    for frame in 1.. {
        if left > COUNT / 2 {
            break;
        }
        if world.time() > 100.0 {
            return Err("the opening is blocked".into());
        }
        world.step(FRAME)?;
        // Rarely, because removal rebuilds the neighbour lists.
        if frame % 32 == 0 {
            removed += remove_fallen(world)?;
        }
        left = removed + fallen(world).count();
        if before == 0 && left > COUNT / 10 {
            (begin, before) = (world.time(), left);
        }
    }
    let rate = (left - before) as f64 / (world.time() - begin);
    let [c, k] = BEVERLOO;
    // The area of a square is 4/pi times that of the circle.
    let c = c * 4.0 / std::f64::consts::PI;
    let free = (opening - k) * DIAMETER;
    Ok(rate / (c * density * G.sqrt() * free * free * free.sqrt()))
}

/// Ids of the grains that fell out of a silo.
fn fallen(world: &World) -> impl Iterator<Item = SphereId> {
    let spheres = world.spheres().ids().iter().zip(world.spheres().positions());
    spheres.filter(|(_, position)| position.y < -2.0 * DIAMETER).map(|(&id, _)| id)
}

/// Removes the grains that fell out of a silo; returns their number.
fn remove_fallen(world: &mut World) -> Result<usize, Error> {
    let out: Vec<SphereId> = fallen(world).collect();
    for &id in &out {
        world.remove_sphere(id)?;
    }
    Ok(out.len())
}

/// Adds a floor at height 0 with a square opening of this width \[m\] in its middle.
fn add_floor_with_opening(world: &mut World, opening: f64) -> Result<(), Error> {
    let width = SILO_WIDTH * DIAMETER;
    let border = 0.5 * (width - opening);
    let middle = 0.5 * (opening + border);
    for (x, z, size_x, size_z) in [
        (middle, 0.0, border, width),
        (-middle, 0.0, border, width),
        (0.0, middle, opening, border),
        (0.0, -middle, opening, border),
    ] {
        let pose = Pose::at(DVec3::new(x, 0.0, z));
        let plate = Collider::new(Shape::Rectangle { size_x, size_z }, pose);
        world.add_collider(plate.with_restitution(0.0).with_friction(MU))?;
    }
    Ok(())
}
