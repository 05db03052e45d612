//! Open one-sided meshes: spheres pass them from behind and may turn back on the way, and none passes them from the
//! front, over ridges, edges and corners, slow or fast.

use carom::{
    Bisect, Collider, Contact, DVec3, Discrete, Exact, Gravity, Mesh, Pose, Rule, Settings, Shape,
    Sphere, World,
};

mod common;

use common::{Numbers, vec};

const GRAVITY: f64 = 10.0;
const RADIUS: f64 = 0.1;
const FRAME: f64 = 1.0 / 64.0;

/// Heights of a terrain on a square lattice.
struct Terrain {
    /// Rows along x, the first at the lowest z.
    heights: Vec<Vec<f64>>,
    /// Edge of the square \[m\].
    edge: f64,
}

impl Terrain {
    /// Heights that follow from places in units of the half edge.
    fn of(count: usize, edge: f64, height: impl Fn(f64, f64) -> f64) -> Self {
        let place = |number: usize| 2.0 * number as f64 / (count - 1) as f64 - 1.0;
        let row = |z: usize| (0..count).map(|x| height(place(x), place(z))).collect();
        Self { heights: (0..count).map(row).collect(), edge }
    }

    fn shape(&self) -> Shape {
        Shape::Mesh(Mesh::from_heights([self.edge; 2], &self.heights).unwrap())
    }

    /// The height of the terrain under a place \[m\].
    fn height_under(&self, place: DVec3) -> f64 {
        let last = self.heights.len() - 1;
        let along = |at: f64| ((at / self.edge + 0.5) * last as f64).clamp(0.0, last as f64);
        let (x, z) = (along(place.x), along(place.z));
        let (column, row) = ((x as usize).min(last - 1), (z as usize).min(last - 1));
        let (u, v) = (x - column as f64, z - row as f64);
        let at = |right: usize, up: usize| self.heights[row + up][column + right];
        // Each square is split along u = v.
        let (first, second) = if u >= v {
            (at(1, 0) - at(0, 0), at(1, 1) - at(1, 0))
        } else {
            (at(1, 1) - at(0, 1), at(0, 1) - at(0, 0))
        };
        at(0, 0) + u * first + v * second
    }
}

/// Meshes with their highest place at the origin: a plane, a ridge, a peak, a saddle of bumps, and a border.
fn meshes(size: f64) -> [Shape; 5] {
    let terrain = |height: fn(f64, f64) -> f64| {
        Terrain::of(5, 2.0 * size, |x, z| size * height(x, z)).shape()
    };
    let corners = [[0.0, -1.0], [0.0, 1.0], [2.0, 1.0], [2.0, -1.0]];
    let vertices = corners.map(|[x, z]| size * vec(x, 0.0, z)).to_vec();
    let beside = Mesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]).unwrap().one_sided();
    [
        terrain(|_, _| 0.0),
        terrain(|x, _| -0.3 * x.abs()),
        terrain(|x, z| -0.4 * x.abs().max(z.abs())),
        terrain(|x, z| -0.2 * (x * x - 0.5 * z * z).abs()),
        Shape::Mesh(beside),
    ]
}

/// A world of this size with gravity, this ball and the mesh if there is one.
fn world(rule: impl Into<Rule>, size: f64, mesh: Option<Shape>, ball: Sphere) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(-GRAVITY * size * DVec3::Y)).unwrap();
    if let Some(mesh) = mesh {
        world.add_collider(Collider::new(mesh, Pose::at(DVec3::ZERO))).unwrap();
    }
    world.add_sphere(ball).unwrap();
    world
}

/// A ball that is thrown up from below, turns back at a `height` of its centre and moves along x meanwhile.
fn thrown_to([x, height, z]: [f64; 3], aside: f64, size: f64) -> Sphere {
    let from = -0.6;
    let time = (2.0 * (height - from) / GRAVITY).sqrt();
    let velocity = vec(aside, GRAVITY * time, 0.0);
    let place = vec(x - aside * time, from, z);
    Sphere::new(size * place, RADIUS * size).with_velocity(size * velocity)
}

/// Asserts that balls which turn back within a mesh move as they do without it, to the bit.
fn assert_turn_back(rule: Rule, size: f64) {
    for (number, mesh) in meshes(size).into_iter().enumerate() {
        for height in [-0.05, 0.0, 0.03, 0.06] {
            for (x, z, aside) in [(0.0, 0.0, 0.0), (0.02, 0.03, 0.0), (0.0, 0.01, 0.5)] {
                let ball = thrown_to([x, height, z], aside, size);
                let what = format!("{rule:?}, mesh {number}, {height} at {x}, {z}, {aside}");
                let [mut with, mut without] =
                    [Some(mesh.clone()), None].map(|it| world(rule, size, it, ball));
                for _ in 0..64 {
                    let impacts = with.step(FRAME).unwrap().impacts.len();
                    assert_eq!(impacts, 0, "{what} at {}", with.time());
                    without.step(FRAME).unwrap();
                }
                assert_eq!(with.spheres().positions(), without.spheres().positions(), "{what}");
                assert_eq!(with.spheres().velocities(), without.spheres().velocities(), "{what}");
            }
        }
    }
}

#[test]
fn a_ball_that_turns_back_in_an_open_mesh_falls_through_as_if_there_were_none() {
    for size in [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)] {
        for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
            assert_turn_back(rule, size);
        }
    }
}

#[test]
fn under_rules_of_frames_a_ball_turns_back_in_an_open_mesh_as_if_there_were_none() {
    for rule in [Rule::Discrete(Discrete::default()), Rule::Bisect(Bisect::default())] {
        assert_turn_back(rule, 1.0);
    }
}

#[test]
fn a_ball_does_not_turn_back_in_a_closed_mesh_or_one_met_from_both_sides() {
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        let vertices = [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0], [1.0, -1.0]];
        let floor = vertices.map(|[x, z]| vec(x, 0.0, z)).to_vec();
        let floor = Mesh::new(floor, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let mut world = world(rule, 1.0, Some(Shape::Mesh(floor)), thrown_to([0.0; 3], 0.0, 1.0));
        for _ in 0..64 {
            world.step(FRAME).unwrap();
            assert!(world.spheres().positions()[0].y <= -RADIUS * (1.0 - 1e-3), "{rule:?}");
        }
    }
}

/// A terrain of bumps with ridges of up to some 50 degrees.
fn bumps(numbers: &mut Numbers, size: f64) -> Terrain {
    let steep = numbers.between(0.02, 0.3);
    let mut terrain = Terrain::of(9, 2.0 * size, |_, _| 0.0);
    for height in terrain.heights.iter_mut().flatten() {
        *height = steep * size * numbers.between(-1.0, 1.0);
    }
    terrain
}

/// Places a terrain in a box without a lid, and balls over it or under it that move at random.
fn with_balls(
    (rule, terrain): (Rule, &Terrain),
    numbers: &mut Numbers,
    size: f64,
    is_above: bool,
) -> World {
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(-GRAVITY * size * DVec3::Y)).unwrap();
    let friction = if numbers.between(0.0, 1.0) < 0.5 { 0.0 } else { 0.3 };
    let restitution = numbers.between(0.0, 0.9);
    let ground = Collider::new(terrain.shape(), Pose::at(DVec3::ZERO))
        .with_friction(friction)
        .with_restitution(restitution);
    world.add_collider(ground).unwrap();
    for normal in [DVec3::X, -DVec3::X, DVec3::Z, -DVec3::Z] {
        let turn = carom::DQuat::from_rotation_arc(DVec3::Y, normal);
        let wall = Collider::new(Shape::HalfSpace, Pose::at(-0.95 * size * normal).rotated(turn));
        world.add_collider(wall).unwrap();
    }
    let speed = if numbers.between(0.0, 1.0) < 0.5 { 1.0 } else { 30.0 };
    for number in 0..6 {
        let (column, row) = (number % 3, number / 3);
        let radius = numbers.between(0.04, 0.15);
        let height = if is_above { 0.6 } else { -0.6 };
        let place = vec(0.55 * (f64::from(column) - 1.0), height, 0.6 * f64::from(row) - 0.3);
        let mut part = || numbers.between(-1.0, 1.0);
        let velocity = match is_above {
            true => speed * vec(part(), -part().abs(), part()),
            false => vec(part(), 3.0 + part(), part()),
        };
        let ball = Sphere::new(size * place, size * radius)
            .with_velocity(size * velocity)
            .with_restitution(restitution)
            .with_friction(friction);
        world.add_sphere(ball).unwrap();
    }
    world
}

#[test]
fn no_ball_passes_the_front_of_an_open_mesh() {
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        for seed in 0..24 {
            let size = [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)][seed as usize % 3];
            let mut numbers = Numbers(seed);
            let terrain = bumps(&mut numbers, size);
            let mut world = with_balls((rule, &terrain), &mut numbers, size, true);
            for frame in 0..120 {
                world.step(FRAME).unwrap();
                for (number, &place) in world.spheres().positions().iter().enumerate() {
                    let above = place.y - terrain.height_under(place);
                    let what = format!("{rule:?}, seed {seed}, frame {frame}, ball {number}");
                    assert!(above > 0.0, "{what}: {:e}", above / size);
                }
            }
        }
    }
}

#[test]
fn balls_from_behind_gain_no_energy_in_an_open_mesh() {
    for seed in 0..24 {
        let size = [1.0, libm::ldexp(1.0, -20), libm::ldexp(1.0, 20)][seed as usize % 3];
        let mut numbers = Numbers(seed);
        let terrain = bumps(&mut numbers, size);
        let rule = Rule::Exact(Exact::default());
        let mut world = with_balls((rule, &terrain), &mut numbers, size, false);
        let start = world.total_energy();
        let scale = world.kinetic_energy();
        for frame in 0..120 {
            world.step(FRAME).unwrap();
            let gained = (world.total_energy() - start) / scale;
            // Persistent contacts add 1e-7 of the energy in a frame at most; zones a part of a slow impact.
            assert!(gained <= 1e-5, "seed {seed}, frame {frame}: {gained:e}");
        }
    }
}
