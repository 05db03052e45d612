//! What closed meshes enclose: boxes of triangles against solid boxes, others against sums of solid angles. Nothing is
//! proven of how spheres bounce off them.

mod common;

use std::f64::consts::TAU;

use carom::{
    Body, Collider, Contact, DQuat, DVec3, Exact, Mesh, Pose, QueryFilter, Rule, Shape, Sphere,
    World,
};
use common::rough_mesh::{Kind, distance, mesh, triangles};
use common::solid_mesh::{block, of_parts, ring};
use common::{Numbers, assert_close, assert_close_vec, bisect, discrete, vec, world};

fn rules() -> [Rule; 4] {
    [Rule::Exact(Exact::default()), Rule::Contact(Contact::default()), discrete(), bisect()]
}

fn with(shape: Shape, pose: Pose, rule: impl Into<Rule>) -> World {
    let mut world = world(rule);
    world.add_collider(Collider::new(shape, pose)).unwrap();
    world
}

/// Whether a point is inside a mesh that is not moved, as overlaps tell it: a sphere far smaller than anything.
fn is_inside(world: &World, point: DVec3) -> bool {
    let found = world.overlapping(point, 1e-9, &QueryFilter::default()).unwrap();
    found.first().is_some_and(|it| it.distance < -2e-9)
}

#[test]
fn a_box_of_triangles_encloses_what_a_box_encloses_at_any_size() {
    for size in [1e-6, 1.0, 1e6] {
        let lengths = size * vec(0.6, 0.4, 0.5);
        let pose =
            Pose::at(size * vec(0.1, 0.2, 0.3)).rotated(DQuat::from_xyzw(0.1, -0.3, 0.2, 0.8));
        let shapes = [Shape::Mesh(block(lengths)), Shape::Box { size: lengths }];
        let worlds = shapes.map(|shape| with(shape, pose, discrete()));
        let (mut numbers, mut inside) = (Numbers(5), 0);
        // Rounding of coordinates, some of which are turned.
        let tolerance = 1e-14 * size;
        for _ in 0..400 {
            let center = pose.position + 0.4 * size * numbers.vector();
            let radius = size * numbers.between(0.01, 0.1);
            let [one, other] = [0, 1].map(|i| {
                let found = worlds[i].overlapping(center, radius, &QueryFilter::default()).unwrap();
                assert!(found.len() <= 1);
                assert_eq!(worlds[i].meets_collider(center, radius), !found.is_empty());
                found.first().copied()
            });
            let [one, other] = match (one, other) {
                (Some(one), Some(other)) => [one, other],
                (one, other) => {
                    assert_eq!(one, other);
                    continue;
                }
            };
            assert_close(one.distance, other.distance, tolerance);
            assert_close_vec(one.point, other.point, tolerance);
            let nearest = worlds.each_ref().map(|world| {
                world.nearest(center, size, &QueryFilter::default()).unwrap().unwrap().distance
            });
            assert_close(nearest[0], nearest[1], tolerance);
            if nearest[1] < 0.0 {
                inside += 1;
                assert_close_vec(one.normal, other.normal, 1e-12);
                let hit = worlds[0].cast_ray(center, size * DVec3::X, &QueryFilter::default());
                assert_eq!(hit.unwrap().unwrap().fraction, 0.0);
            }
        }
        assert!(inside > 50);
    }
}

#[test]
fn a_sphere_that_begins_inside_overlaps_and_goes_on_as_in_a_box_under_every_rule() {
    let size = vec(0.6, 0.4, 0.5);
    for rule in rules() {
        let mut worlds = [Shape::Mesh(block(size)), Shape::Box { size }]
            .map(|shape| with(shape, Pose::at(DVec3::ZERO), rule));
        let sphere = Sphere::new(vec(0.05, 0.03, -0.02), 0.1).with_velocity(vec(0.8, 0.3, 0.5));
        let ids = worlds.each_mut().map(|world| world.add_sphere(sphere).unwrap());
        for frame in 0..60 {
            let [one, other] = worlds.each_ref().map(|world| {
                world.overlaps(0.0).iter().map(|it| (it.between, it.depth)).collect::<Vec<_>>()
            });
            assert!(frame > 0 || one.len() == 1, "{rule:?}");
            assert_eq!(one.len(), other.len(), "{rule:?} {frame}");
            for (one, other) in one.iter().zip(&other) {
                assert_eq!(one.0, other.0);
                assert_close(one.1, other.1, 1e-13);
            }
            let states = [0, 1].map(|i| {
                worlds[i].step(1.0 / 60.0).unwrap();
                worlds[i].sphere(ids[i]).unwrap()
            });
            assert_close_vec(states[0].position, states[1].position, 1e-12);
        }
    }
}

/// How often a surface goes round a point: the sum of the solid angles of its triangles (Van Oosterom and Strackee
/// 1983), over that of a sphere.
fn winding_number(point: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
    let angle = |corners: &[DVec3; 3]| {
        let [a, b, c] = corners.map(|it| it - point);
        let [x, y, z] = [a.length(), b.length(), c.length()];
        let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
        2.0 * libm::atan2(a.dot(b.cross(c)), below)
    };
    triangles.iter().map(angle).sum::<f64>() / (2.0 * TAU)
}

/// Compares inside and outside with solid angles at points anywhere and beside faces, edges and vertices.
fn compare(mesh: &Mesh, numbers: &mut Numbers) {
    let all = triangles(mesh);
    let world = with(Shape::Mesh(mesh.clone()), Pose::at(DVec3::ZERO), discrete());
    let mut seen = [0; 2];
    for number in 0..600 {
        let [a, b, c] = all[(numbers.next() * all.len() as f64) as usize];
        let beside = 1e-6 * numbers.vector();
        let point = match number % 4 {
            0 => 1.2 * numbers.vector(),
            1 => a + beside,
            2 => 0.5 * (a + b) + beside,
            _ => (a + b + c) / 3.0 + beside,
        };
        // Closer, the sum of angles does not tell.
        if distance(point, &all) > 1e-8 {
            let expected = winding_number(point, &all) > 0.5;
            assert_eq!(is_inside(&world, point), expected, "{number} {point}");
            if expected {
                let found = world.nearest(point, 10.0, &QueryFilter::default()).unwrap().unwrap();
                assert_close(-found.distance, distance(point, &all), 1e-14);
            }
            seen[usize::from(expected)] += 1;
        }
    }
    assert!(seen[0] > 100 && seen[1] > 100, "{seen:?}");
}

#[test]
fn what_is_inside_agrees_with_solid_angles() {
    let mut numbers = Numbers(7);
    compare(&ring([0.8, 0.3], [24, 12]), &mut numbers);
    for _ in 0..6 {
        compare(&mesh(Kind::Solid, &mut numbers), &mut numbers);
    }
}

#[test]
fn no_ray_is_lost_between_triangles_or_counted_twice() {
    // Places on a lattice see vertices, edges and diagonals of a box in many directions from straight ahead.
    let world = with(Shape::Mesh(block(DVec3::splat(2.0))), Pose::at(DVec3::ZERO), discrete());
    for number in 0..13 * 13 * 13 {
        let part = |by: i32| f64::from(number / by % 13 - 6) / 4.0;
        let point = vec(part(1), part(13), part(169));
        let most = point.abs().max_element();
        // On the surface either is right.
        if most != 1.0 {
            assert_eq!(is_inside(&world, point), most < 1.0, "{point}");
        }
    }
}

#[test]
fn only_what_triangles_face_away_from_is_inside() {
    let (origin, two, one) = (DVec3::ZERO, DVec3::splat(2.0), DVec3::ONE);
    let is_inside_at = |mesh: Mesh, x: f64| {
        let world = with(Shape::Mesh(mesh), Pose::at(DVec3::ZERO), discrete());
        is_inside(&world, vec(x, 0.01, 0.02))
    };
    let room = || of_parts(&[(origin, two, true)]);
    assert!(room().is_closed());
    assert_eq!([0.0, 0.6, 1.5].map(|x| is_inside_at(room(), x)), [false; 3]);
    let shell = || of_parts(&[(origin, two, false), (origin, one, true)]);
    assert_eq!([0.0, 0.6, 1.5].map(|x| is_inside_at(shell(), x)), [false, true, false]);
    let crossed = || of_parts(&[(origin, one, false), (vec(0.5, 0.0, 0.0), one, false)]);
    assert_eq!(
        [0.25, 0.6, 0.9, 1.1].map(|x| is_inside_at(crossed(), x)),
        [true, true, true, false]
    );
    let open = || {
        let whole = block(two);
        Mesh::new(whole.vertices().to_vec(), whole.triangles()[1..].to_vec()).unwrap()
    };
    assert_eq!([0.0, 1.5].map(|x| is_inside_at(open(), x)), [false; 2]);
    let ground = || Mesh::from_heights([4.0; 2], &[vec![1.0, 1.0], vec![1.0, 1.0]]).unwrap();
    assert!(!is_inside_at(ground(), 0.3));
}

#[test]
fn a_closed_mesh_that_moves_carries_what_it_encloses() {
    for rule in rules() {
        let mut world = world(rule);
        let mesh = Shape::Mesh(block(vec(2.0, 0.2, 0.2)));
        let turning = Collider::new(mesh, Pose::at(DVec3::ZERO));
        // A quarter turn about y, on a way of 3 m along x.
        world.add_collider(turning.moving(3.0 * DVec3::X, 0.25 * TAU * DVec3::Y)).unwrap();
        world.step(1.0).unwrap();
        assert!(is_inside(&world, vec(3.0, 0.0, 0.9)));
        assert!(!is_inside(&world, vec(3.9, 0.0, 0.0)));
        assert!(!is_inside(&world, vec(0.0, 0.0, 0.0)));
    }
}

#[test]
fn a_closed_mesh_that_is_a_trigger_reports_what_is_inside_as_a_box_does() {
    let size = vec(2.0, 1.6, 1.8);
    for rule in rules() {
        let [one, other] = [Shape::Mesh(block(size)), Shape::Box { size }].map(|shape| {
            let mut world = world(rule);
            let trigger = Collider::new(shape, Pose::at(DVec3::ZERO)).as_trigger();
            let id = world.add_collider(trigger).unwrap();
            let start = vec(-3.05, 0.13, 0.07);
            world.add_sphere(Sphere::new(start, 0.1).with_velocity(2.0 * DVec3::X)).unwrap();
            let (mut inside, mut events) = (Vec::new(), Vec::new());
            for frame in 0..200 {
                let report = world.step(1.0 / 60.0).unwrap();
                inside.push(report.triggers.len());
                assert!(report.triggers.iter().all(|it| it.collider == id));
                let time = |it: &carom::SensorEvent| (it.enters, f64::from(frame) / 60.0 + it.time);
                events.extend(report.sensor_events.iter().map(time));
            }
            (inside, events)
        });
        assert_eq!(one.0, other.0, "{rule:?}");
        assert_eq!(one.1.len(), 2, "{rule:?} {:?}", one.1);
        for (one, other) in one.1.iter().zip(&other.1) {
            assert_eq!(one.0, other.0);
            assert_close(one.1, other.1, 1e-12);
        }
    }
}

#[test]
fn a_ray_from_inside_a_mesh_meets_it_at_once() {
    let world = with(Shape::Mesh(ring([0.8, 0.3], [24, 12])), Pose::at(DVec3::Y), discrete());
    let cast =
        |from: DVec3| world.cast_ray(from, -3.0 * DVec3::Y, &QueryFilter::default()).unwrap();
    let hit = cast(vec(0.8, 1.0, 0.0)).unwrap();
    assert_eq!((hit.fraction, matches!(hit.body, Body::Collider(_))), (0.0, true));
    // Through the hole.
    assert_eq!(cast(vec(0.0, 1.0, 0.0)), None);
}
