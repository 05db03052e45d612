//! Gases under `exact` on several threads: proves that reports, with their counts of work, and states have the same
//! bits for any number of threads, also where a step is stopped and after a snapshot; not that threads save time.
#![cfg(feature = "rayon")]

mod common;

use std::ops::Range;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use carom::{
    Boundary, Collider, DQuat, DVec3, Error, Gravity, Pose, Settings, Shape, Sphere, StateHash,
    StepReport, StopRequest, World,
};
use common::Numbers;
use rayon::ThreadPoolBuilder;

/// Enough spheres for several threads.
const COUNT: usize = 3_000;

/// Runs `work` on a number of threads.
fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

/// The reports of some frames of a copy of a world, and its state after them.
fn history(world: &World, frames: &[f64], threads: usize) -> (Vec<StepReport>, StateHash) {
    let mut world = world.clone();
    on(threads, || {
        let reports = frames.iter().map(|&frame| world.step(frame).unwrap().clone()).collect();
        (reports, world.state_hash())
    })
}

/// Checks that a world has the same history on 1, 2, 3 and 8 threads, and that things happen in it.
fn assert_same_history(world: &World, frames: &[f64]) {
    let on_one = history(world, frames, 1);
    assert!(on_one.0.iter().map(|report| report.impacts.len()).sum::<usize>() > COUNT / 2);
    for threads in [2, 3, 8] {
        let on_more = history(world, frames, threads);
        assert_eq!(on_more.1, on_one.1, "{threads} threads");
        assert!(on_more == on_one, "{threads} threads");
    }
}

/// Walls about a cube with this edge, for axes that are not periodic.
fn add_walls(world: &mut World, edge: f64, is_open: [bool; 3], restitution: f64) {
    let normals = DVec3::AXES.iter().zip(is_open).filter(|(_, is_open)| *is_open);
    for normal in normals.flat_map(|(axis, _)| [*axis, -*axis]) {
        let turn = DQuat::from_rotation_arc(DVec3::Y, normal);
        let pose = Pose::at(-0.5 * edge * normal).rotated(turn);
        let wall = Collider::new(Shape::HalfSpace, pose).with_restitution(restitution);
        world.add_collider(wall).unwrap();
    }
}

/// A cube of spheres at places of a lattice, with random velocities of up to 1 m/s along each axis.
struct Gas {
    packing: f64,
    is_open: [bool; 3],
    restitution: f64,
    /// Radii of two sizes \[m\], and the share of the first.
    radii: ([f64; 2], f64),
    gravity: f64,
    seed: u64,
}

impl Default for Gas {
    fn default() -> Self {
        let radii = ([0.5; 2], 1.0);
        Self { packing: 0.2, is_open: [false; 3], restitution: 1.0, radii, gravity: 0.0, seed: 1 }
    }
}

impl Gas {
    fn world(&self) -> World {
        let mut numbers = Numbers(self.seed);
        let ([one, other], share) = self.radii;
        let radii: Vec<f64> =
            (0..COUNT).map(|_| if numbers.next() < share { one } else { other }).collect();
        let per_side = libm::cbrt(COUNT as f64).ceil();
        let volume: f64 = radii.iter().map(|&radius| carom::volume(radius)).sum();
        let edge = libm::cbrt(volume / self.packing).max(2.0 * per_side * one.max(other) * 1.001);
        let along = |axis: usize| if self.is_open[axis] { f64::INFINITY } else { edge };
        let size = DVec3::new(along(0), along(1), along(2));
        let boundary = match self.is_open {
            [true, true, true] => Boundary::default(),
            _ => Boundary::Periodic { size },
        };
        let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
        add_walls(&mut world, edge, self.is_open, self.restitution);
        if self.gravity > 0.0 {
            world.add_force(Gravity::new(DVec3::new(0.0, -self.gravity, 0.0))).unwrap();
        }
        for (number, radius) in radii.into_iter().enumerate() {
            let along = |stride: f64| (number as f64 / stride).floor() % per_side;
            let cell = DVec3::new(along(1.0), along(per_side), along(per_side * per_side));
            let place = (cell + 0.5) / per_side - 0.5;
            let sphere = Sphere::new(edge * place, radius)
                .with_velocity(numbers.vector())
                .with_restitution(self.restitution);
            world.add_sphere(sphere).unwrap();
        }
        world
    }
}

#[test]
fn threads_change_no_bit_of_a_dilute_gas() {
    assert_same_history(&Gas::default().world(), &[0.4; 6]);
}

#[test]
fn threads_change_no_bit_of_a_dense_fluid() {
    let gas = Gas { packing: 0.49, ..Gas::default() };
    assert_same_history(&gas.world(), &[0.1; 6]);
}

#[test]
fn threads_change_no_bit_of_a_gas_that_falls_in_a_box_and_cools() {
    let gas = Gas { is_open: [true; 3], restitution: 0.9, gravity: 2.0, ..Gas::default() };
    assert_same_history(&gas.world(), &[0.25; 10]);
}

#[test]
fn threads_change_no_bit_of_a_gas_between_two_walls() {
    let gas = Gas { is_open: [false, true, false], packing: 0.3, ..Gas::default() };
    assert_same_history(&gas.world(), &[0.3, 0.01, 0.5]);
}

#[test]
fn threads_change_no_bit_of_a_mixture_of_sizes_one_to_ten() {
    let gas = Gas { radii: ([0.5, 0.05], 0.03), packing: 0.02, ..Gas::default() };
    assert_same_history(&gas.world(), &[4.0; 6]);
}

#[test]
fn threads_change_no_bit_after_a_snapshot() {
    let mut world = Gas { packing: 0.4, ..Gas::default() }.world();
    let frames = [0.05; 4];
    on(3, || frames.iter().for_each(|&frame| drop(world.step(frame).unwrap().clone())));
    let snapshot = world.snapshot();
    let then = history(&world, &frames, 2);
    on(3, || world.step(1.0).map(|report| report.impacts.len())).unwrap();
    world.restore(&snapshot);
    assert!(history(&world, &frames, 1) == then && history(&world, &frames, 8) == then);
}

#[test]
fn a_step_that_is_stopped_on_several_threads_leaves_the_world_as_before_it() {
    let world = Gas::default().world();
    let run = |threads: usize| {
        let mut world = world.clone();
        let before = world.state_hash();
        let looks = Arc::new(AtomicU32::new(0));
        let count = looks.clone();
        // In the middle of the step.
        let is_made = move || count.fetch_add(1, Ordering::Relaxed) == 4;
        world.set_stop_request(Some(StopRequest::new(is_made)));
        let stopped = on(threads, || world.step(8.0).map(|report| report.impacts.len()));
        assert!(matches!(stopped, Err(Error::Stopped { .. })), "{threads} threads: {stopped:?}");
        assert_eq!(world.state_hash(), before, "{threads} threads");
        world.set_stop_request(None);
        (history(&world, &[0.2; 3], threads), looks.load(Ordering::Relaxed))
    };
    let on_one = run(1);
    assert!(on_one.1 > 4);
    for threads in [2, 3, 8] {
        assert!(run(threads) == on_one, "{threads} threads");
    }
}

/// Checks that random gases have the same history on one thread and on two.
fn assert_random_gases_are_alike(seeds: Range<u64>) {
    for seed in seeds {
        let mut numbers = Numbers(seed);
        let is_open = [0; 3].map(|_| numbers.next() < 0.4);
        let size = numbers.between(0.3, 1.0);
        let gas = Gas {
            packing: numbers.between(0.02, 0.5),
            is_open,
            restitution: if numbers.next() < 0.5 { 1.0 } else { numbers.between(0.0, 1.0) },
            radii: ([0.5, 0.5 * size], numbers.next()),
            gravity: if numbers.next() < 0.5 { 0.0 } else { numbers.between(0.0, 4.0) },
            seed,
        };
        let world = gas.world();
        let frames = [0; 2].map(|_| numbers.between(0.02, 0.3));
        let [one, two] = [1, 2].map(|threads| history(&world, &frames, threads));
        assert!(one == two, "world {seed}");
    }
}

#[test]
fn random_gases_have_the_same_report_on_one_thread_and_on_two() {
    assert_random_gases_are_alike(0..40);
}

#[test]
#[ignore = "some minutes"]
fn a_thousand_random_gases_have_the_same_report_on_one_thread_and_on_two() {
    assert_random_gases_are_alike(0..1000);
}
