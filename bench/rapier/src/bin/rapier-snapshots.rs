//! Snapshots of Rapier, beside `cargo bench -p carom --bench snapshots`: the same 800 balls, fallen for a second onto
//! a floor. Prints bytes for a ball, and microseconds to write a world as bytes (into memory that is used again) and
//! to read it, and to copy its parts and take them over, without bytes.

use std::hint::black_box;
use std::time::Instant;

use rapier3d::prelude::*;

const BALLS: usize = 800;
const RUNS: u32 = 300;

fn main() {
    let world = fallen();
    let mut bytes = Vec::new();
    let write = microseconds(|| {
        bytes.clear();
        bincode::serialize_into(&mut bytes, &world).expect("a world in bytes");
    });
    let read = microseconds(|| {
        black_box(bincode::deserialize::<PhysicsWorld>(&bytes).expect("a world"));
    });
    let mut parts = Parts::of(&world);
    let copy = microseconds(|| parts = Parts::of(&world));
    let copy_into = microseconds(|| parts.copy_from(&world));
    let size = bytes.len() / BALLS;
    println!("{size} bytes for a ball; write {write:.1} us, read {read:.1} us");
    println!("without bytes: copy {copy:.1} us, into used memory {copy_into:.1} us");
}

/// The median time of a task.
fn microseconds(mut task: impl FnMut()) -> f64 {
    let mut times: Vec<f64> = (0..RUNS)
        .map(|_| {
            let began = Instant::now();
            task();
            1e6 * began.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// What a world without joints depends on.
struct Parts {
    islands: IslandManager,
    broad_phase: BroadPhaseBvh,
    narrow_phase: NarrowPhase,
    bodies: RigidBodySet,
    colliders: ColliderSet,
}

impl Parts {
    fn of(world: &PhysicsWorld) -> Self {
        Self {
            islands: world.islands.clone(),
            broad_phase: world.broad_phase.clone(),
            narrow_phase: world.narrow_phase.clone(),
            bodies: world.bodies.clone(),
            colliders: world.colliders.clone(),
        }
    }

    fn copy_from(&mut self, world: &PhysicsWorld) {
        self.islands.clone_from(&world.islands);
        self.broad_phase.clone_from(&world.broad_phase);
        self.narrow_phase.clone_from(&world.narrow_phase);
        self.bodies.clone_from(&world.bodies);
        self.colliders.clone_from(&world.colliders);
    }
}

/// Balls that have fallen for a second onto a floor, in ten layers.
fn fallen() -> PhysicsWorld {
    let mut world = PhysicsWorld::default();
    world.integration_parameters.dt = 1.0 / 60.0;
    let floor = ColliderBuilder::new(SharedShape::halfspace(Vector::Y)).restitution(0.5);
    world.insert(RigidBodyBuilder::fixed(), floor);
    for number in 0..BALLS {
        let [x, y, z] = [number % 10, number / 80, number / 10 % 8].map(|it| it as f32);
        let place = Vector::new(1.1 * x + 0.01 * y, 0.6 + 1.1 * y, 1.1 * z + 0.01 * y);
        let ball = ColliderBuilder::ball(0.5).mass(1.0).friction(0.0).restitution(0.5);
        world.insert(RigidBodyBuilder::dynamic().translation(place), ball);
    }
    for _ in 0..60 {
        world.step();
    }
    world
}
