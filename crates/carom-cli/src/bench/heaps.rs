//! Heaps under the rule `contact`, and in stepped zones of `exact`: time per frame, depth of
//! overlaps, and whether balls come to rest.

use std::time::Instant;

use carom::{
    Collider, Contact, DQuat, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, World,
};
use carom_scene::scene::Rule;
use serde::Serialize;

use super::median::median;
use super::threads;
use crate::failure::Failure;
use crate::table::{Side, Table};

/// Length of a frame \[s\].
const FRAME: f64 = 1.0 / 60.0;
const FRAMES: u32 = 600;
const RADIUS: f64 = 0.5;
/// Distance of balls in a pile \[m\].
const SPACING: f64 = 1.05;
/// Radius of the balls that fall onto a fixed sphere, and of that sphere \[m\].
const DROP_RADIUS: f64 = 0.15;
const TARGET_RADIUS: f64 = 10.0;
/// Distance of these balls, horizontally and vertically \[m\].
const DROP_SPACING: [f64; 2] = [0.57, 0.8];

pub const NOTE: &str = "pile: balls of radius 0.5 m on a lattice fall into a box; rain: balls of radius 0.15 m \
                        fall onto a fixed sphere of 10 m; 600 frames of 1/60 s, e = 0; overlap as a part \
                        of the radius at the end and at worst";

/// A heap to measure.
#[derive(Debug, Clone, Copy)]
struct Heap {
    rule: Rule,
    kind: Kind,
    count: usize,
    friction: f64,
}

/// Surface onto which balls fall.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Kind {
    /// A box.
    Pile,
    /// A large fixed sphere.
    Rain,
}

/// Results of a heap.
#[derive(Debug, Clone, Serialize)]
pub struct HeapRow {
    rule: Rule,
    kind: Kind,
    balls: usize,
    friction: f64,
    /// Mean time per frame of each run on one thread \[ms\].
    runs: Vec<f64>,
    /// Median of the runs \[ms\].
    frame_milliseconds: f64,
    /// Threads of [`Self::threads_frame_milliseconds`].
    threads: usize,
    /// Time per frame on all threads, the median of the same number of runs \[ms\].
    threads_frame_milliseconds: f64,
    /// Time per frame in the last hundred frames \[ms\].
    last_milliseconds: f64,
    /// Longest time of a frame \[ms\].
    longest_milliseconds: f64,
    /// Largest overlap at the end, as a fraction of the radius.
    overlap: f64,
    /// Largest overlap in any sub-step, as a fraction of the radius.
    worst_overlap: f64,
    /// Root mean square of the speeds at the end \[m/s\].
    rms_speed: f64,
    /// Number of sleeping balls at the end.
    asleep: u32,
    state: String,
}

/// Measures each heap of the set on one thread and on all; the largest heap only if `full`.
pub fn measure_set(runs: u32, full: bool) -> Result<Vec<HeapRow>, Failure> {
    let pile = |count, friction| Heap { rule: Rule::Contact, kind: Kind::Pile, count, friction };
    let smooth = [2_000, 10_000].map(|count| pile(count, 0.0));
    let rough = [2_000, 10_000].map(|count| pile(count, 0.4));
    let rain = Heap { kind: Kind::Rain, ..pile(10_000, 0.0) };
    let large = full.then_some(pile(100_000, 0.0));
    let exact = |heap| Heap { rule: Rule::Exact, ..heap };
    let under_contact = smooth.into_iter().chain(rough).chain([rain]).chain(large);
    let all = under_contact.chain(smooth.into_iter().chain([rain]).map(exact));
    all.map(|heap| Ok(measure(heap, runs)?)).collect()
}

fn measure(heap: Heap, runs: u32) -> Result<HeapRow, Error> {
    let several = || (0..runs).map(|_| run(heap)).collect::<Result<Vec<_>, _>>();
    let rows = threads::on(1, several)?;
    let all: Vec<f64> = rows.iter().map(|row| row.frame_milliseconds).collect();
    let last = rows.iter().map(|row| row.last_milliseconds).collect();
    let threads = threads::most();
    let side_by_side = if threads > 1 { threads::on(threads, several)? } else { rows.clone() };
    let row = rows.into_iter().next_back();
    row.map(|row| HeapRow {
        frame_milliseconds: median(all.clone()),
        last_milliseconds: median(last),
        runs: all,
        threads,
        threads_frame_milliseconds: median(
            side_by_side.iter().map(|row| row.frame_milliseconds).collect(),
        ),
        ..row
    })
    .ok_or(Error::Stopped { time: 0.0 })
}

fn run(heap: Heap) -> Result<HeapRow, Error> {
    let mut world = heap.world()?;
    let (mut worst, mut times) = (0.0_f64, Vec::new());
    for _ in 0..FRAMES {
        let began = Instant::now();
        let report = world.step(FRAME)?;
        times.push(1e3 * began.elapsed().as_secs_f64());
        // The report states overlaps as a fraction of the sum of two radii.
        worst = worst.max(2.0 * report.contact_account.largest_overlap);
    }
    let spheres = world.spheres();
    let squares = spheres.velocities().iter().map(|v| v.length_squared()).sum::<f64>();
    let mean = |times: &[f64]| times.iter().sum::<f64>() / times.len() as f64;
    let depths = world.overlaps(0.0).into_iter().map(|overlap| overlap.depth);
    Ok(HeapRow {
        rule: heap.rule,
        kind: heap.kind,
        balls: heap.count,
        friction: heap.friction,
        runs: Vec::new(),
        frame_milliseconds: mean(&times),
        threads: 1,
        threads_frame_milliseconds: mean(&times),
        last_milliseconds: mean(&times[times.len() - 100..]),
        longest_milliseconds: times.iter().copied().fold(0.0, f64::max),
        overlap: depths.fold(0.0, f64::max) / heap.radius(),
        worst_overlap: worst,
        rms_speed: (squares / heap.count as f64).sqrt(),
        asleep: world.report().contact_account.asleep,
        state: world.state_hash().to_string(),
    })
}

impl Heap {
    /// Radius of the balls \[m\].
    fn radius(self) -> f64 {
        match self.kind {
            Kind::Pile => RADIUS,
            Kind::Rain => DROP_RADIUS,
        }
    }

    fn world(self) -> Result<World, Error> {
        let settings = Settings::default();
        let mut world = World::new(match self.rule {
            Rule::Contact => settings.with_rule(Contact::default()),
            _ => settings,
        })?;
        world.add_force(Gravity::new(DVec3::new(0.0, -9.81, 0.0)))?;
        match self.kind {
            Kind::Pile => self.add_pile(&mut world)?,
            Kind::Rain => self.add_rain(&mut world)?,
        }
        Ok(world)
    }

    /// Adds balls on a lattice above an open box; every second layer is shifted by a tenth of a
    /// radius.
    fn add_pile(self, world: &mut World) -> Result<(), Error> {
        let side = (0.8 * libm::cbrt(self.count as f64) - 1e-9).ceil() as usize;
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
            let wall = Collider::new(Shape::HalfSpace, pose).with_friction(self.friction);
            world.add_collider(wall)?;
        }
        for number in 0..self.count {
            let (layer, cell) = (number / (side * side), number % (side * side));
            let shift = 0.1 * RADIUS * (layer % 2) as f64;
            let place = DVec3::new(
                RADIUS + (cell % side) as f64 * SPACING + shift,
                0.6 + layer as f64 * SPACING,
                RADIUS + (cell / side) as f64 * SPACING + shift,
            );
            world.add_sphere(self.ball(place))?;
        }
        Ok(())
    }

    /// Adds balls on a lattice above a larger fixed sphere, like `tutorial4` with more balls.
    fn add_rain(self, world: &mut World) -> Result<(), Error> {
        let ball = Shape::Sphere { radius: TARGET_RADIUS };
        world.add_collider(Collider::new(ball, Pose::at(DVec3::ZERO)))?;
        let side = libm::cbrt(self.count as f64).ceil() as usize;
        let [across, up] = DROP_SPACING;
        let start = -0.5 * across * (side - 1) as f64;
        for number in 0..self.count {
            let (layer, cell) = (number / (side * side), number % (side * side));
            let place = DVec3::new(
                start + (cell % side) as f64 * across,
                TARGET_RADIUS + up * (layer + 2) as f64,
                start + (cell / side) as f64 * across,
            );
            world.add_sphere(self.ball(place))?;
        }
        Ok(())
    }

    fn ball(self, place: DVec3) -> Sphere {
        Sphere::new(place, self.radius()).with_restitution(0.0).with_friction(self.friction)
    }
}

pub fn table(rows: &[HeapRow]) -> Table {
    let threads = rows.first().map_or(1, |row| row.threads);
    let side_by_side = format!("{threads} threads");
    let columns = [
        "",
        "",
        "balls",
        "friction",
        "ms/frame",
        &side_by_side,
        "last 100",
        "longest",
        "overlap",
        "worst",
        "rms [m/s]",
        "asleep",
    ];
    let columns = columns.map(|name| (name, Side::Right));
    let mut table = Table::new(&columns);
    for row in rows {
        let kind = match row.kind {
            Kind::Pile => "pile",
            Kind::Rain => "rain",
        };
        table.push(vec![
            row.rule.name().to_string(),
            kind.to_string(),
            row.balls.to_string(),
            row.friction.to_string(),
            format!("{:.3}", row.frame_milliseconds),
            format!("{:.3}", row.threads_frame_milliseconds),
            format!("{:.3}", row.last_milliseconds),
            format!("{:.1}", row.longest_milliseconds),
            format!("{:.4}", row.overlap),
            format!("{:.4}", row.worst_overlap),
            format!("{:.1e}", row.rms_speed),
            row.asleep.to_string(),
        ]);
    }
    table
}
