//! Balls thrown into random meshes under `exact`: none comes into a mesh, by distances to all of its triangles. Found
//! a ball that met a face of a valley late, because its highest vertex was missed.

mod common;

use carom::{Collider, DVec3, Exact, Gravity, Mesh, Pose, Shape, Sphere, SphereId, World};
use common::rough_mesh::{Kind, distance, mesh, triangles};
use common::{G, Numbers, vec, world};

const FRAME: f64 = 1.0 / 240.0;

/// A mesh with balls over it, or inside.
struct Thrown {
    world: World,
    /// With their radii \[m\].
    balls: Vec<(SphereId, f64)>,
    triangles: Vec<[DVec3; 3]>,
    /// Where the mesh is met from one side only, half its width along x and z \[m\].
    half_width: f64,
}

/// What was seen of a world.
#[derive(Debug, Default, PartialEq)]
struct Seen {
    /// How far a ball came into a triangle, as a part of its radius.
    deepest: f64,
    /// The most energy that a frame added, as a part of all energy.
    largest_gain: f64,
    was_stepped: bool,
}

fn world_on(mesh: Mesh, [restitution, friction]: [f64; 2]) -> World {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let ground = Collider::new(Shape::Mesh(mesh), Pose::at(DVec3::ZERO));
    world.add_collider(ground.with_restitution(restitution).with_friction(friction)).unwrap();
    world
}

fn thrown(seed: u64, count: usize, friction: f64) -> Thrown {
    let kind = Kind::ALL[seed as usize % Kind::ALL.len()];
    let mut numbers = Numbers(seed);
    let mesh = mesh(kind, &mut numbers);
    let triangles = triangles(&mesh);
    let mut world = world_on(mesh, [[0.0, 0.6, 1.0][seed as usize / 5 % 3], friction]);
    let mut balls: Vec<(DVec3, SphereId, f64)> = Vec::new();
    while balls.len() < count {
        let radius = numbers.between(0.05, 0.25);
        let place = match kind {
            Kind::Room => 0.6 * numbers.vector(),
            Kind::Pit => numbers.vector() + vec(0.0, 1.4, 0.0),
            _ => 1.5 * numbers.vector() + vec(0.0, 2.2, 0.0),
        };
        let is_free = balls.iter().all(|ball| (ball.0 - place).length() > radius + ball.2);
        if is_free && distance(place, &triangles) > radius {
            let sphere = Sphere::new(place, radius).with_velocity(2.0 * numbers.vector());
            let id = world.add_sphere(sphere.with_restitution(1.0)).unwrap();
            balls.push((place, id, radius));
        }
    }
    let balls = balls.into_iter().map(|ball| (ball.1, ball.2)).collect();
    let half_width = if kind == Kind::Pit { 2.0 } else { f64::INFINITY };
    Thrown { world, balls, triangles, half_width }
}

impl Thrown {
    /// Runs some frames and looks at all balls after each.
    fn watch(&mut self, frames: usize) -> Seen {
        let mut seen = Seen::default();
        let scale = self.world.total_energy().abs() + self.world.kinetic_energy();
        let mut energy = self.world.total_energy();
        for _ in 0..frames {
            self.world.step(FRAME).unwrap();
            let now = self.world.total_energy();
            seen.largest_gain = seen.largest_gain.max((now - energy) / scale);
            seen.deepest = seen.deepest.max(self.deepest());
            seen.was_stepped |= self.world.was_stepped();
            energy = now;
        }
        seen
    }

    fn deepest(&self) -> f64 {
        let depth = |&(id, radius): &(SphereId, f64)| {
            let place = self.world.sphere(id).unwrap().position;
            let is_beyond = place.x.abs().max(place.z.abs()) > self.half_width;
            // What has fallen off is far.
            let is_far = place.length() > 5.0;
            let depth = || 1.0 - distance(place, &self.triangles) / radius;
            if is_beyond || is_far { 0.0 } else { depth() }
        };
        self.balls.iter().map(depth).fold(0.0, f64::max)
    }
}

#[test]
fn a_ball_that_slides_into_a_valley_meets_its_other_side_in_time() {
    let heights =
        [[1.0, 0.5, 0.5, 1.0], [0.5, 0.0, 0.1, 0.5], [0.5, 0.2, 0.0, 0.5], [1.0, 0.5, 0.5, 1.0]];
    let mesh = Mesh::from_heights([4.0; 2], &heights.map(Vec::from)).unwrap();
    let triangles = triangles(&mesh);
    let mut world = world_on(mesh, [0.6, 0.0]);
    let balls = [(vec(0.3, 2.0, 0.2), 0.2), (vec(-0.9, 2.0, 0.7), 0.15)];
    let balls = balls.map(|it| (world.add_sphere(Sphere::new(it.0, it.1)).unwrap(), it.1)).into();
    let half_width = f64::INFINITY;
    let seen = Thrown { world, balls, triangles, half_width }.watch(720);
    // Rounding of places, over the radius.
    assert!(seen.deepest <= 1e-12, "{seen:?}");
}

#[test]
fn no_ball_comes_into_a_random_mesh_without_friction_or_gains_energy() {
    for seed in 0..30 {
        let seen = thrown(seed, 3, 0.0).watch(480);
        assert!(!seen.was_stepped, "{seed}");
        // A path over an edge or about a corner is made of pieces.
        assert!(seen.deepest <= 1e-9 && seen.largest_gain <= 1e-9, "{seed} {seen:?}");
    }
}

#[test]
fn a_rough_ball_comes_into_a_random_mesh_by_no_more_than_zones_leave() {
    let mut count = 0;
    for seed in 0..30 {
        let seen = thrown(seed, 3, 0.3).watch(480);
        // Where a ball rolls in a valley it is in a zone, whose sub-steps correct what overlaps.
        let [tolerance, gain] = if seen.was_stepped { [0.01, 5e-3] } else { [1e-9, 1e-7] };
        assert!(seen.deepest <= tolerance && seen.largest_gain <= gain, "{seed} {seen:?}");
        count += usize::from(!seen.was_stepped);
    }
    assert!(count >= 10, "{count} worlds without a zone");
}
