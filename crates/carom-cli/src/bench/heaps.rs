//! Heaps under the rule `contact`: how long a frame takes, how deep balls overlap, and whether they come to
//! rest.

use std::time::Instant;

use carom::{
    Collider, Contact, DQuat, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, World,
};
use serde::Serialize;

use super::median::median;
use crate::failure::Failure;
use crate::table::{Side, Table};

/// Length of a frame \[s\].
const FRAME: f64 = 1.0 / 60.0;
const FRAMES: u32 = 600;
const RADIUS: f64 = 0.5;
/// Distance of balls in a pile \[m\].
const SPACING: f64 = 1.05;

pub const NOTE: &str = "pile: balls of radius 0.5 m on a lattice fall into a box; 600 frames of 1/60 s, \
                        e = 0; overlap as a part of the radius at the end and at worst";

/// A pile that is measured.
#[derive(Debug, Clone, Copy)]
struct Pile {
    count: usize,
    friction: f64,
}

/// What came out of a pile.
#[derive(Debug, Clone, Serialize)]
pub struct HeapRow {
    balls: usize,
    friction: f64,
    /// Milliseconds for a frame, of each run.
    runs: Vec<f64>,
    /// Their median \[ms\].
    frame_milliseconds: f64,
    /// Milliseconds for a frame among the last hundred.
    last_milliseconds: f64,
    /// Largest overlap at the end, as a part of the radius.
    overlap: f64,
    /// Largest overlap in any sub-step, as a part of the radius.
    worst_overlap: f64,
    /// Root of the mean square of the speeds at the end \[m/s\].
    rms_speed: f64,
    /// Balls that sleep at the end.
    asleep: u32,
    state: String,
}

/// Measures the piles of the set; the largest only where `full`.
pub fn measure_set(runs: u32, full: bool) -> Result<Vec<HeapRow>, Failure> {
    let smooth = [2_000, 10_000].map(|count| Pile { count, friction: 0.0 });
    let rough = [2_000, 10_000].map(|count| Pile { count, friction: 0.4 });
    let large = full.then_some(Pile { count: 100_000, friction: 0.0 });
    smooth.into_iter().chain(rough).chain(large).map(|pile| Ok(measure(pile, runs)?)).collect()
}

fn measure(pile: Pile, runs: u32) -> Result<HeapRow, Error> {
    let rows = (0..runs).map(|_| run(pile)).collect::<Result<Vec<_>, _>>()?;
    let all: Vec<f64> = rows.iter().map(|row| row.frame_milliseconds).collect();
    let last = rows.iter().map(|row| row.last_milliseconds).collect();
    let row = rows.into_iter().next_back();
    row.map(|row| HeapRow {
        frame_milliseconds: median(all.clone()),
        last_milliseconds: median(last),
        runs: all,
        ..row
    })
    .ok_or(Error::Stopped { time: 0.0 })
}

fn run(pile: Pile) -> Result<HeapRow, Error> {
    let mut world = piled(pile)?;
    let (mut worst, mut times) = (0.0_f64, Vec::new());
    for _ in 0..FRAMES {
        let began = Instant::now();
        let report = world.step(FRAME)?;
        times.push(1e3 * began.elapsed().as_secs_f64());
        // Of the sum of two radii.
        worst = worst.max(2.0 * report.contact_account.largest_overlap);
    }
    let spheres = world.spheres();
    let squares = spheres.velocities().iter().map(|v| v.length_squared()).sum::<f64>();
    let mean = |times: &[f64]| times.iter().sum::<f64>() / times.len() as f64;
    let depths = world.overlaps(0.0).into_iter().map(|overlap| overlap.depth);
    Ok(HeapRow {
        balls: pile.count,
        friction: pile.friction,
        runs: Vec::new(),
        frame_milliseconds: mean(&times),
        last_milliseconds: mean(&times[times.len() - 100..]),
        overlap: depths.fold(0.0, f64::max) / RADIUS,
        worst_overlap: worst,
        rms_speed: (squares / pile.count as f64).sqrt(),
        asleep: world.report().contact_account.asleep,
        state: world.state_hash().to_string(),
    })
}

/// Balls on a lattice, each second layer shifted by a tenth of a radius, over an open box.
fn piled(Pile { count, friction }: Pile) -> Result<World, Error> {
    let mut world = World::new(Settings::default().with_rule(Contact::default()))?;
    world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
    let side = (0.8 * libm::cbrt(count as f64) - 1e-9).ceil() as usize;
    let width = side as f64 * SPACING;
    let walls = [
        (DVec3::Y, DVec3::ZERO),
        (DVec3::X, DVec3::ZERO),
        (DVec3::NEG_X, width * DVec3::X),
        (DVec3::Z, DVec3::ZERO),
        (DVec3::NEG_Z, width * DVec3::Z),
    ];
    for (normal, point) in walls {
        let pose = Pose::at(point).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
        let wall = Collider::new(Shape::HalfSpace, pose).with_friction(friction);
        world.add_collider(wall)?;
    }
    for number in 0..count {
        let (layer, cell) = (number / (side * side), number % (side * side));
        let shift = 0.1 * RADIUS * (layer % 2) as f64;
        let place = DVec3::new(
            RADIUS + (cell % side) as f64 * SPACING + shift,
            0.6 + layer as f64 * SPACING,
            RADIUS + (cell / side) as f64 * SPACING + shift,
        );
        let ball = Sphere::new(place, RADIUS).with_restitution(0.0);
        world.add_sphere(ball.with_friction(friction))?;
    }
    Ok(world)
}

pub fn table(rows: &[HeapRow]) -> Table {
    let columns =
        ["balls", "friction", "ms/frame", "last 100", "overlap", "worst", "rms [m/s]", "asleep"];
    let columns = columns.map(|name| (name, Side::Right));
    let mut table = Table::new(&columns);
    for row in rows {
        table.push(vec![
            row.balls.to_string(),
            row.friction.to_string(),
            format!("{:.3}", row.frame_milliseconds),
            format!("{:.3}", row.last_milliseconds),
            format!("{:.4}", row.overlap),
            format!("{:.4}", row.worst_overlap),
            format!("{:.1e}", row.rms_speed),
            row.asleep.to_string(),
        ]);
    }
    table
}
