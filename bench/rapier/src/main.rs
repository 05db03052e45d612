//! Piles of balls under Rapier, as `carom bench --set heaps` has them: balls of radius 0.5 m on a lattice of
//! spacing 1.05 m fall into a box; 600 frames of 1/60 s, no restitution. `rapier-heaps BALLS FRICTION` prints
//! milliseconds for a frame, the largest overlap at the end as a part of the radius, and the root of the mean
//! square of the speeds at the end \[m/s\], as JSON. `RAYON_NUM_THREADS` says how many threads there are.

use std::time::Instant;

use rapier3d::prelude::*;

const FRAMES: u32 = 600;
const RADIUS: f32 = 0.5;
const SPACING: f32 = 1.05;

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, count, friction] = &arguments[..] else { panic!("usage: rapier-heaps BALLS FRICTION") };
    let count: usize = count.parse().expect("a number of balls");
    let friction: f32 = friction.parse().expect("a coefficient of friction");
    let (mut world, balls) = pile(count, friction);
    let began = Instant::now();
    for _ in 0..FRAMES {
        world.step();
    }
    let milliseconds = 1e3 * began.elapsed().as_secs_f64() / f64::from(FRAMES);
    let places: Vec<Vector> = balls.iter().map(|&ball| world.bodies[ball].translation()).collect();
    let squares = balls.iter().map(|&ball| world.bodies[ball].linvel().length_squared());
    let rms = (squares.sum::<f32>() / count as f32).sqrt();
    let overlap = largest_overlap(&places) / RADIUS;
    println!("{{\"frame_milliseconds\": {milliseconds}, \"overlap\": {overlap}, \"rms_speed\": {rms}}}");
}

/// Balls on a lattice, each second layer shifted by a tenth of a radius, over an open box.
fn pile(count: usize, friction: f32) -> (PhysicsWorld, Vec<RigidBodyHandle>) {
    let mut world = PhysicsWorld::default();
    world.integration_parameters.dt = 1.0 / 60.0;
    let side = (0.8 * (count as f64).cbrt() - 1e-9).ceil() as usize;
    let width = side as f32 * SPACING;
    let walls = [
        (Vector::Y, Vector::ZERO),
        (Vector::X, Vector::ZERO),
        (-Vector::X, width * Vector::X),
        (Vector::Z, Vector::ZERO),
        (-Vector::Z, width * Vector::Z),
    ];
    for (normal, point) in walls {
        let wall = ColliderBuilder::new(SharedShape::halfspace(normal));
        let material = wall.friction(friction).restitution(0.0);
        world.insert(RigidBodyBuilder::fixed().translation(point), material);
    }
    let balls = (0..count).map(|number| {
        let (layer, cell) = (number / (side * side), number % (side * side));
        let shift = 0.1 * RADIUS * (layer % 2) as f32;
        let place = Vector::new(
            RADIUS + (cell % side) as f32 * SPACING + shift,
            0.6 + layer as f32 * SPACING,
            RADIUS + (cell / side) as f32 * SPACING + shift,
        );
        let ball = ColliderBuilder::ball(RADIUS).mass(1.0).friction(friction).restitution(0.0);
        world.insert(RigidBodyBuilder::dynamic().translation(place), ball).0
    });
    let balls = balls.collect();
    (world, balls)
}

/// The deepest overlap of two balls \[m\], found by cells of their diameter.
fn largest_overlap(places: &[Vector]) -> f32 {
    use std::collections::BTreeMap;
    let cell_of = |place: &Vector| {
        [place.x, place.y, place.z].map(|along| (along / (2.0 * RADIUS)).floor() as i32)
    };
    let mut cells: BTreeMap<[i32; 3], Vec<usize>> = BTreeMap::new();
    for (number, place) in places.iter().enumerate() {
        cells.entry(cell_of(place)).or_default().push(number);
    }
    let mut deepest = 0.0_f32;
    for (number, place) in places.iter().enumerate() {
        let [x, y, z] = cell_of(place);
        for neighbour in 0..27 {
            let cell = [x + neighbour % 3 - 1, y + neighbour / 3 % 3 - 1, z + neighbour / 9 - 1];
            for &other in cells.get(&cell).into_iter().flatten().filter(|&&other| other > number) {
                deepest = deepest.max(2.0 * RADIUS - (places[other] - *place).length());
            }
        }
    }
    deepest
}
