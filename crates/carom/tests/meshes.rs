//! Triangle meshes against the surfaces that they stand for: flat floors against half-spaces, boxes against boxes,
//! round ones against spheres. What is meant is that nothing is felt of how a surface is cut into triangles.

mod common;

use std::f64::consts::TAU;

use carom::{
    Collider, Contact, DQuat, DVec3, Exact, Gravity, Mesh, MeshError, Pose, QuadraticDrag, Rule,
    Shape, Sphere, SphereId, World,
};
use common::solid_mesh::block;
use common::{G, Numbers, vec, world};

/// A flat floor of `count` by `count` cells between -2 and 2, cut along either diagonal, with vertices anywhere.
fn flat(count: usize, seed: u64) -> Mesh {
    let mut numbers = Numbers(seed);
    let step = 4.0 / count as f64;
    let mut vertices = Vec::new();
    for row in 0..=count {
        for column in 0..=count {
            let mut moved = |number: usize| {
                let is_rim = number == 0 || number == count;
                let by = numbers.between(-0.3, 0.3);
                -2.0 + step * (number as f64 + if is_rim { 0.0 } else { by })
            };
            let (x, z) = (moved(column), moved(row));
            vertices.push(vec(x, 0.0, z));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..count {
        for column in 0..count {
            let a = (row * (count + 1) + column) as u32;
            let [b, c, d] = [a + 1, a + count as u32 + 1, a + count as u32 + 2];
            if numbers.between(0.0, 1.0) < 0.5 {
                triangles.extend([[a, c, d], [a, d, b]]);
            } else {
                triangles.extend([[a, c, b], [b, c, d]]);
            }
        }
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// A flat floor between -2 and 2 of `4 * count` triangles with one common vertex.
fn star(count: usize) -> Mesh {
    let mut vertices = vec![vec(0.15, 0.0, -0.2)];
    for side in 0..4 {
        for number in 0..count {
            let along = -2.0 + 4.0 * number as f64 / count as f64;
            let [x, z] = [[along, 2.0], [2.0, -along], [-along, -2.0], [-2.0, along]][side];
            vertices.push(vec(x, 0.0, z));
        }
    }
    let around = 4 * count as u32;
    let triangles = (1..=around).map(|it| [0, it, it % around + 1]).collect();
    Mesh::new(vertices, triangles).unwrap()
}

/// A flat floor between -2 and 2 of `2 * count` triangles as long as the floor.
fn strips(count: usize) -> Mesh {
    let x = |number: usize| -2.0 + 4.0 * number as f64 / count as f64;
    let vertices = (0..=count).flat_map(|it| [vec(x(it), 0.0, -2.0), vec(x(it), 0.0, 2.0)]);
    let of_strip = |it: u32| [[2 * it, 2 * it + 1, 2 * it + 3], [2 * it, 2 * it + 3, 2 * it + 2]];
    let triangles = (0..count as u32).flat_map(of_strip).collect();
    Mesh::new(vertices.collect(), triangles).unwrap()
}

fn rules() -> [Rule; 2] {
    [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())]
}

fn on(shape: Shape, rule: impl Into<Rule>, restitution: f64, friction: f64) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(shape, Pose::at(DVec3::ZERO)).with_restitution(restitution);
    world.add_collider(floor.with_friction(friction)).unwrap();
    world
}

/// The farthest that two worlds come apart over `frames`, and the impacts of both.
fn apart(mut worlds: [World; 2], sphere: Sphere, frames: usize) -> (f64, [usize; 2]) {
    let ids: [SphereId; 2] = [0, 1].map(|i| worlds[i].add_sphere(sphere).unwrap());
    let (mut most, mut impacts) = (0.0f64, [0; 2]);
    for _ in 0..frames {
        for (world, count) in worlds.iter_mut().zip(&mut impacts) {
            *count += world.step(1.0 / 60.0).unwrap().impacts.len();
        }
        let [one, other] = [0, 1].map(|i| worlds[i].sphere(ids[i]).unwrap());
        most = most.max((one.position - other.position).length());
        most = most.max((one.velocity - other.velocity).length());
    }
    (most, impacts)
}

#[test]
fn a_flat_floor_of_many_triangles_is_a_half_space() {
    // 10,082 and twice 10,000 triangles.
    let meshes = [flat(71, 1), star(2500), strips(5000)];
    let mut numbers = Numbers(2);
    for (mesh, rule) in meshes.iter().flat_map(|mesh| rules().map(|rule| (mesh, rule))) {
        for (restitution, friction, height) in [(0.0, 0.0, 0.0), (0.0, 0.4, 0.0), (0.8, 0.3, 0.3)] {
            let shapes = [Shape::Mesh(mesh.clone()), Shape::HalfSpace];
            let worlds = shapes.map(|shape| on(shape, rule, restitution, friction));
            let direction = TAU * numbers.between(0.0, 1.0);
            let velocity = 1.2 * vec(libm::cos(direction), 0.0, libm::sin(direction));
            let sphere = Sphere::new(vec(0.1, 0.1 + height, 0.03), 0.1).with_velocity(velocity);
            let (most, impacts) = apart(worlds, sphere, 80);
            // The plane of the floor is exact, so only what is counted differently is rounded differently.
            assert!(most <= 1e-12, "{rule:?} {restitution} {friction}: {most}");
            assert_eq!(impacts[0], impacts[1], "{rule:?} {restitution} {friction}");
        }
    }
}

#[test]
fn balls_bounce_off_a_box_of_triangles_as_off_a_box() {
    let size = vec(0.6, 0.4, 0.5);
    let mesh = block(size);
    assert!(mesh.is_closed() && mesh.faults() == Default::default());
    let mut numbers = Numbers(3);
    let turned = Pose::at(vec(0.1, 0.2, 0.3)).rotated(DQuat::from_xyzw(0.1, -0.3, 0.2, 0.8));
    for rule in rules() {
        for number in 0..60 {
            let from =
                2.0 * DVec3::from_array([0; 3].map(|_| numbers.between(-1.0, 1.0))).normalize();
            let aim = 0.45 * DVec3::from_array([0; 3].map(|_| numbers.between(-1.0, 1.0)));
            let sphere = Sphere::new(from + turned.position, 0.15).with_velocity(aim - from);
            let worlds = [Shape::Mesh(mesh.clone()), Shape::Box { size }].map(|shape| {
                let mut world = world(rule);
                world.add_collider(Collider::new(shape, turned)).unwrap();
                world
            });
            let (most, impacts) = apart(worlds, sphere, 100);
            // An edge of a box is one of each of its faces.
            assert!(impacts[0] <= impacts[1], "{number} {rule:?} {impacts:?}");
            // Sub-steps may answer what those say one after the other.
            let tolerance = if matches!(rule, Rule::Exact(_)) { 1e-11 } else { 1e-2 };
            assert!(most <= tolerance, "{number} {rule:?} {most}");
        }
    }
}

/// A ridge or a valley along z: two plates that rise towards x = 0, or fall, by the tangent of an angle.
fn fold(slope: f64) -> Mesh {
    let vertices = [-3.0, 0.0, 3.0]
        .into_iter()
        .flat_map(|x: f64| [-1.0, 1.0].map(|z| vec(x, -slope * x.abs(), z)));
    let triangles = vec![[0, 1, 3], [0, 3, 2], [2, 3, 5], [2, 5, 4]];
    Mesh::new(vertices.collect(), triangles).unwrap()
}

#[test]
fn a_ball_rolls_over_a_low_ridge_without_an_impact_or_a_loss() {
    for friction in [0.0, 0.5] {
        let mut world = on(Shape::Mesh(fold(0.02)), Exact::default(), 0.0, friction);
        let (radius, speed) = (0.1, 1.0);
        let slope = 0.02f64.atan();
        let along = vec(libm::cos(slope), libm::sin(slope), 0.0);
        let up = vec(-libm::sin(slope), libm::cos(slope), 0.0);
        let foot = -1.0 * along;
        let spin = -speed / radius * DVec3::Z;
        let sphere = Sphere::new(foot + radius * up, radius).with_velocity(speed * along);
        let id = world.add_sphere(sphere.with_angular_velocity(spin)).unwrap();
        let before = world.total_energy();
        for _ in 0..120 {
            let report = world.step(1.0 / 60.0).unwrap();
            assert!(report.impacts.is_empty(), "{:?}", report.impacts);
            assert_eq!(world.contacts().len(), 1);
            assert!(!world.was_stepped());
        }
        assert!(world.sphere(id).unwrap().position.x > 0.5);
        let change = (world.total_energy() - before).abs() / before.abs();
        // Pieces of path over the edge are right to the third order of a thousandth.
        assert!(change <= 1e-9, "{friction}: {change}");
    }
}

#[test]
fn a_ball_slides_across_a_valley_that_is_hardly_one_at_its_speed() {
    // Below 1e-9 rad both sides are one face; near 1e-6 rad what the second side takes is no impact any more.
    for slope in [1e-8_f64, 1e-7, 2e-7, 3e-7, 5e-7, 1e-6, 1e-5] {
        for skew in [0.0, 0.3] {
            let mut world = on(Shape::Mesh(fold(-slope)), Exact::default(), 0.0, 0.0);
            let velocity = vec(1.0, -slope, skew);
            let height = 0.5 * slope + 0.1 * (1.0 + slope * slope).sqrt();
            let ball = Sphere::new(vec(-0.5, height, 0.0), 0.1).with_velocity(velocity);
            let id = world.add_sphere(ball).unwrap();
            let before = world.total_energy();
            let mut account = 0.0;
            for _ in 0..60 {
                account += world.step(1.0 / 60.0).unwrap().energy_account.contacts;
            }
            let after = world.sphere(id).unwrap();
            // As much up as down, but for the way that is gained downward, of second order in the slope.
            let across = (after.velocity.x - 1.0).abs();
            assert!(across < G * G * slope * slope + 1e-10, "{slope} {skew}: {across}");
            assert!((after.velocity.z - skew).abs() < 1e-10, "{slope} {skew}: {}", after.velocity);
            let energy = world.total_energy() - before;
            assert!((energy - account).abs() < 1e-11, "{slope} {skew}: {energy}");
        }
    }
}

#[test]
fn a_ball_comes_to_rest_in_a_valley() {
    for rule in rules() {
        let mut world = on(Shape::Mesh(fold(-0.3)), rule, 0.0, 0.0);
        let id = world.add_sphere(Sphere::new(vec(0.5, 0.8, 0.1), 0.1)).unwrap();
        for _ in 0..600 {
            world.step(1.0 / 60.0).unwrap();
        }
        let height = 0.1 / libm::cos(libm::atan(0.3));
        let ball = world.sphere(id).unwrap();
        // A ball without spin loses its speed in impacts with the other side.
        assert!((ball.position - vec(0.0, height, 0.1)).length() <= 1e-3, "{rule:?} {ball:?}");
    }
}

#[test]
fn an_open_mesh_is_met_from_both_sides_unless_it_is_one_sided() {
    for rule in rules() {
        for is_one_sided in [false, true] {
            let mesh = flat(3, 5);
            let mesh = if is_one_sided { mesh.one_sided() } else { mesh };
            let mut world = world(rule);
            world.add_collider(Collider::new(Shape::Mesh(mesh), Pose::at(DVec3::ZERO))).unwrap();
            let rising = Sphere::new(vec(0.2, -1.0, 0.4), 0.1).with_velocity(DVec3::Y);
            let falling = Sphere::new(vec(1.2, 1.0, 0.4), 0.1).with_velocity(DVec3::NEG_Y);
            let ids = [rising, falling].map(|sphere| world.add_sphere(sphere).unwrap());
            for _ in 0..100 {
                world.step(0.02).unwrap();
            }
            let [rising, falling] = ids.map(|id| world.sphere(id).unwrap());
            let expected = if is_one_sided { 1.0 } else { -1.0 };
            assert_eq!(rising.velocity.y, expected, "{rule:?}");
            assert_eq!(falling.velocity.y, 1.0, "{rule:?}");
        }
    }
}

/// A valley along z that is met from above: its sides go down to x = 0 and up again, at 45 degrees.
fn valley() -> Shape {
    Shape::Mesh(fold(-1.0).one_sided())
}

/// A ball below the left side of a valley, on its way to the right one, both in motion; the valley turns, too. Returns
/// the velocity of the ball at the end and the times of its impacts \[s\]. In air its path is a polynomial.
fn into_valley(
    radius: f64,
    [motion, turning]: [DVec3; 2],
    has_air: bool,
    frame: f64,
) -> (DVec3, Vec<f64>) {
    let mut world = world(Exact::default());
    if has_air {
        // So thin that it slows nothing down.
        world.add_force(QuadraticDrag::new(1e-14)).unwrap();
    }
    let valley = Collider::new(valley(), Pose::at(DVec3::ZERO)).moving(motion, turning);
    world.add_collider(valley).unwrap();
    let ball = Sphere::new(vec(-1.0, 0.2, 0.1), radius).with_velocity(DVec3::X + motion);
    let ball = world.add_sphere(ball).unwrap();
    let (frames, mut times) = ((1.5 / frame).round() as usize, Vec::new());
    for number in 0..frames {
        let report = world.step(frame).unwrap();
        times.extend(report.impacts.iter().map(|impact| number as f64 * frame + impact.time));
    }
    (world.sphere(ball).unwrap().velocity, times)
}

#[test]
fn a_ball_from_behind_meets_the_other_side_of_a_valley_unless_it_reaches_into_it_already() {
    // Its centre passes the left side from behind at x = -0.2, and is over the right one from there on: that turns a
    // small ball up, while a large one passes both.
    let motion = vec(0.5, 0.25, 0.0);
    // So slowly that it does not matter.
    let turning = vec(0.0, 0.0, 1e-14);
    for (motions, has_air) in [
        ([DVec3::ZERO; 2], false),
        ([motion, DVec3::ZERO], false),
        ([motion, DVec3::ZERO], true),
        ([motion, turning], false),
        ([motion, turning], true),
    ] {
        let [motion, _] = motions;
        for frame in [0.25, 0.0625, 1.5] {
            let (velocity, times) = into_valley(0.5, motions, has_air, frame);
            assert_eq!(times, [0.0; 0]);
            assert!((velocity - motion - DVec3::X).length() < 1e-13, "{velocity}");
            let (velocity, times) = into_valley(0.25, motions, has_air, frame);
            let [time] = times[..] else { panic!("{times:?}") };
            // Some roundings of coordinates up to 6 m, at 1 m/s, and what the turning does.
            assert!((time - 1.2 + 0.25 * 2.0f64.sqrt()).abs() < 1e-13, "{time}");
            assert!((velocity - motion - DVec3::Y).length() < 1e-13, "{velocity}");
        }
    }
}

#[test]
fn what_is_no_mesh_is_refused_by_number() {
    let triangle = || vec![DVec3::ZERO, DVec3::X, DVec3::Z];
    let error = Mesh::new(triangle(), vec![[0, 1, 2], [0, 1, 3]]).unwrap_err();
    assert_eq!(error, MeshError::UnknownVertex { triangle: 1, vertex: 3, count: 3 });
    let error = Mesh::new(triangle(), vec![[0, 1, 1]]).unwrap_err();
    assert_eq!(error, MeshError::NoArea);
    let infinite = vec![DVec3::ZERO, f64::INFINITY * DVec3::X, DVec3::Z];
    let error = Mesh::new(infinite, vec![[0, 1, 2]]).unwrap_err();
    assert!(matches!(error, MeshError::VertexNotFinite { vertex: 1, .. }));
    let rows = [vec![0.0, 1.0], vec![0.0]];
    let error = Mesh::from_heights([1.0, 1.0], &rows).unwrap_err();
    assert_eq!(error, MeshError::UnequalRows { row: 1, columns: 2, found: 1 });
    let with_faults =
        Mesh::new(triangle(), vec![[0, 1, 2], [0, 1, 1], [2, 1, 0]]).unwrap().faults();
    assert_eq!((with_faults.degenerate, with_faults.repeated), (vec![1], vec![2]));
    assert_eq!(with_faults.open_edges.len(), 3);
}

#[test]
fn a_mesh_behaves_the_same_at_any_size() {
    let mut paths = Vec::new();
    // Powers of two scale without rounding.
    for size in [1.0 / 1_048_576.0, 1.0, 1_048_576.0] {
        let heights = [[0.0, 0.3, 0.1], [0.2, -0.2, 0.3], [0.4, 0.1, 0.0]];
        let rows = heights.map(|row| row.map(|height| size * height).to_vec());
        let mesh = Mesh::from_heights([4.0 * size; 2], &rows).unwrap();
        let mut world = world(Exact::default());
        world.add_force(Gravity::new(vec(0.0, -8.0 * size, 0.0))).unwrap();
        let ground = Collider::new(Shape::Mesh(mesh), Pose::at(DVec3::ZERO));
        world.add_collider(ground.with_restitution(0.5)).unwrap();
        let mut numbers = Numbers(8);
        for _ in 0..6 {
            let place = vec(numbers.between(-1.0, 1.0), 1.0, numbers.between(-1.0, 1.0));
            world.add_sphere(Sphere::new(size * place, 0.125 * size)).unwrap();
        }
        for _ in 0..60 {
            world.step(1.0 / 64.0).unwrap();
        }
        let scaled = |it: &DVec3| *it / size;
        paths.push(world.spheres().positions().iter().map(scaled).collect::<Vec<DVec3>>());
    }
    assert!(paths[0] == paths[1] && paths[1] == paths[2]);
}
