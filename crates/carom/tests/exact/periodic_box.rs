//! Periodic boxes: spheres meet across faces, and go round.

use carom::{Boundary, Collider, DVec3, Emitter, Gravity, Pose, Settings, Shape, Sphere, World};

use crate::common::{G, Numbers, assert_close, discrete, vec};
use crate::{exact, half_space, run};

#[test]
fn in_a_periodic_box_spheres_meet_across_its_faces() {
    let boundary = Boundary::Periodic { size: vec(10.0, 10.0, f64::INFINITY) };
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    let left = Sphere::new(vec(-4.0, 0.0, 50.0), 0.5).with_velocity(vec(-1.0, 0.0, 0.0));
    let right = Sphere::new(vec(4.0, 0.0, 50.0), 0.5).with_velocity(vec(2.0, 0.0, 0.0));
    world.add_sphere(left).unwrap();
    world.add_sphere(right).unwrap();
    // The gap across the face is 1 m and closes at 3 m/s.
    let report = world.step(0.5).unwrap();
    assert_eq!(report.impacts.len(), 1);
    assert_close(report.impacts[0].time, 1.0 / 3.0, 1e-15);
    assert_eq!(report.impacts[0].normal, DVec3::NEG_X);
    assert_eq!(world.spheres().velocities(), [vec(2.0, 0.0, 0.0), vec(-1.0, 0.0, 0.0)]);
    // They go round for ever and stay in the box; the other way they meet after 8 m at 3 m/s.
    let mut impacts = 0;
    for _ in 0..1000 {
        impacts += world.step(0.3).unwrap().impacts.len();
        assert!(world.spheres().positions().iter().all(|x| x.x.abs() <= 5.0 && x.z == 50.0));
    }
    // Centres 1 m apart on a ring of 10 m: 8 m from one impact to the next.
    assert_eq!(impacts, ((1000.0 * 0.3 + 0.5 - 1.0 / 3.0) * 3.0 / 8.0) as usize);
}

/// Where equal balls are, and how many impacts they had, after a time in a periodic box: each impact
/// is searched for among all pairs and all images nearby, and a short time at a time.
fn searched(
    (places, velocities): (&[DVec3], &[DVec3]),
    (size, diameter): (DVec3, f64),
    duration: f64,
) -> (Vec<DVec3>, usize) {
    let (mut x, mut v) = (places.to_vec(), velocities.to_vec());
    let folded = |r: DVec3| r - (r / size).round() * size;
    let images: Vec<DVec3> = (0..27)
        .map(|n| vec(f64::from(n % 3 - 1), f64::from(n / 3 % 3 - 1), f64::from(n / 9 - 1)) * size)
        .collect();
    let (mut left, mut impacts) = (duration, 0);
    while left > 0.0 {
        // No ball goes half a box in this time.
        let fastest = v.iter().map(|v| v.length()).fold(0.0, f64::max);
        let mut first = (left.min(0.2 * size.min_element() / fastest), None);
        // From further apart, two do not meet in it.
        let reach = 1.001 * (diameter + 2.0 * fastest * first.0);
        for i in 0..x.len() {
            for j in 0..i {
                let w = v[j] - v[i];
                let nearest = folded(x[j] - x[i]);
                for image in &images {
                    let r = nearest + *image;
                    if r.length_squared() > reach * reach {
                        continue;
                    }
                    let (b, c) = (r.dot(w), r.length_squared() - diameter * diameter);
                    let discriminant = b * b - w.length_squared() * c;
                    if b < 0.0 && discriminant >= 0.0 {
                        let time = (c / (discriminant.sqrt() - b)).max(0.0);
                        if time < first.0 {
                            first = (time, Some((i, j, r + w * time)));
                        }
                    }
                }
            }
        }
        x.iter_mut().zip(&v).for_each(|(x, v)| *x += *v * first.0);
        left -= first.0;
        if let (_, Some((i, j, r))) = first {
            let change = (v[j] - v[i]).project_onto(r);
            (v[i], v[j], impacts) = (v[i] + change, v[j] - change, impacts + 1);
        }
    }
    (x.into_iter().map(folded).collect(), impacts)
}

#[test]
fn in_periodic_boxes_of_any_width_balls_meet_as_in_a_search_among_all_images() {
    // Boxes of few cells, one to six along an axis, dilute and crowded; then of more, where flights go
    // round several times without an impact, and where no ball gets far.
    for (balls, size, speed) in [
        ([1, 8, 8], vec(2.0, 9.6, 9.6), 2.0),
        ([2, 5, 5], vec(2.9, 6.0, 6.0), 2.0),
        ([3, 3, 4], vec(4.0, 3.5, 7.0), 2.0),
        ([4, 4, 4], vec(4.4, 4.4, 4.4), 2.0),
        ([5, 5, 5], vec(6.5, 6.5, 6.5), 2.0),
        ([5, 4, 4], vec(32.0, 31.0, 30.0), 100.0),
        ([7, 6, 6], vec(7.7, 7.69, 7.69), 0.2),
    ] {
        let boundary = Boundary::Periodic { size };
        let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
        let mut numbers = Numbers(7);
        let [nx, ny, nz] = balls;
        for n in 0..nx * ny * nz {
            let cell = vec(f64::from(n % nx), f64::from(n / nx % ny), f64::from(n / nx / ny));
            let count = vec(f64::from(nx), f64::from(ny), f64::from(nz));
            let place = (cell + 0.5) / count * size - 0.5 * size;
            let ball = Sphere::new(place, 0.5).with_velocity(speed * numbers.vector());
            world.add_sphere(ball).unwrap();
        }
        let spheres = world.spheres();
        let start = (spheres.positions(), spheres.velocities());
        let (expected, impacts) = searched(start, (size, 1.0), 1.0);
        assert_eq!(run(&mut world, 1.0 / 16.0, 16), impacts, "{size}");
        assert!(impacts > balls.iter().product::<i32>() as usize / 4, "{impacts} in {size}");
        for (found, expected) in world.spheres().positions().iter().zip(expected) {
            // Each impact makes rounding some ten times as large.
            let apart = (*found - expected) / size;
            assert!((apart - apart.round()).length() < 1e-9, "{found} not {expected} in {size}");
        }
    }
}

#[test]
fn overlaps_are_seen_across_the_faces_of_a_periodic_box() {
    let periodic = Boundary::Periodic { size: vec(6.0, f64::INFINITY, 8.0) };
    let overlaps = |places: &[DVec3], shape: Option<Shape>| {
        let mut world = World::new(Settings::default().with_boundary(periodic)).unwrap();
        for &place in places {
            world.add_sphere(Sphere::new(place, 0.5)).unwrap();
        }
        if let Some(shape) = shape {
            world.add_collider(Collider::new(shape, Pose::at(vec(2.8, 0.0, 0.0)))).unwrap();
        }
        let overlaps = world.overlaps(1e-12);
        overlaps.iter().map(|overlap| overlap.depth).collect::<Vec<_>>()
    };
    let assert_depths = |found: Vec<f64>, expected: &[f64]| {
        assert_eq!(found.len(), expected.len(), "{found:?}");
        // Roundings of coordinates of a few metres.
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
    };
    // Through a face, an edge of the box, and from outside of it; not along the open axis.
    assert_depths(overlaps(&[vec(-2.9, 0.0, 0.0), vec(2.9, 0.0, 0.0)], None), &[0.8]);
    let apart = 0.2 * 2f64.sqrt();
    assert_depths(overlaps(&[vec(-2.9, 0.0, -3.9), vec(2.9, 0.0, 3.9)], None), &[1.0 - apart]);
    assert_depths(overlaps(&[vec(8.0, 0.0, 0.0), vec(2.0, 0.0, 0.0)], None), &[1.0]);
    assert_depths(overlaps(&[vec(0.0, -2.9, 0.0), vec(0.0, 2.9, 0.0)], None), &[]);
    assert_depths(overlaps(&[vec(-2.5, 0.0, 0.0), vec(2.5, 0.0, 0.0)], None), &[]);
    // Each two once, also where they overlap without a face between them.
    assert_depths(overlaps(&[vec(2.0, 0.0, 0.0), vec(2.75, 0.0, 0.0)], None), &[0.25]);
    // Images of colliders that are at rest, but not of half-spaces.
    let sphere = Shape::Sphere { radius: 0.4 };
    assert_depths(overlaps(&[vec(-2.8, 0.0, 0.0)], Some(sphere.clone())), &[0.5]);
    assert_depths(overlaps(&[vec(8.8, 0.0, 0.0)], Some(sphere)), &[0.9]);
    let large = Shape::Sphere { radius: 2.0 };
    assert_depths(overlaps(&[vec(-1.0, 0.0, 0.0)], Some(large)), &[0.3]);
    assert_depths(overlaps(&[vec(-2.8, 2.0, 0.0)], Some(Shape::HalfSpace)), &[]);
}

#[test]
fn an_overlap_is_found_without_a_list_of_all() {
    let mut world = exact();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -0.4, 0.0)));
    world.add_collider(floor).unwrap();
    for i in 0..40 {
        world.add_sphere(Sphere::new(vec(1.1 * f64::from(i), 0.2, 0.0), 0.5)).unwrap();
    }
    assert_eq!(world.find_overlap(|_| true), None);
    world.add_sphere(Sphere::new(vec(11.2, 0.2, 0.0), 0.5)).unwrap();
    world.add_sphere(Sphere::new(vec(99.0, 0.0, 0.0), 0.5)).unwrap();
    // Two pairs and the floor, each found if it is what is sought.
    let all = world.overlaps(0.0);
    assert_eq!(all.len(), 3);
    for one in &all {
        assert_eq!(world.find_overlap(|it| it.between == one.between), Some(*one));
    }
    let found = world.find_overlap(|_| true).expect("there are some");
    assert!(all.contains(&found), "{found:?}");
    assert_eq!(world.find_overlap(|it| it.depth > 10.0), None);
}

#[test]
fn a_periodic_box_needs_the_rule_and_the_room() {
    let boundary = Boundary::Periodic { size: DVec3::splat(3.0) };
    let settings = Settings::default().with_boundary(boundary).with_rule(discrete());
    assert!(World::new(settings).unwrap_err().to_string().contains("`exact`"));
    let size = vec(1.0, -1.0, 1.0);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    assert!(World::new(settings).unwrap_err().to_string().contains("size"));
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.8)).unwrap();
    let error = world.step(0.1).unwrap_err().to_string();
    assert!(error.contains("size") && error.contains("four times"), "{error}");
    assert_eq!(world.time(), 0.0);
}

#[test]
fn balls_on_a_floor_meet_across_the_faces_of_a_box_and_stay_on_the_floor() {
    let boundary = Boundary::Periodic { size: vec(10.0, f64::INFINITY, 10.0) };
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.5);
    for (x, v) in [(-4.0, -1.0), (4.0, 2.0), (4.0, 0.25)] {
        let z = if v == 0.25 { 3.0 } else { 0.0 };
        let ball = Sphere::new(vec(x, 0.5, z), 0.5).with_velocity(vec(v, 0.0, 0.0));
        world.add_sphere(ball).unwrap();
    }
    let mut impacts = 0;
    for _ in 0..300 {
        impacts += world.step(0.3).unwrap().impacts.len();
        for place in world.spheres().positions() {
            assert_close(place.y, 0.5, 1e-12);
            assert!(place.x.abs() <= 5.0);
        }
    }
    // The first after 1 m at 3 m/s, then one every 8 m.
    assert_eq!(impacts, 1 + ((90.0 - 1.0 / 3.0) * 3.0 / 8.0) as usize);
    assert_close(world.momentum().x, 1.25, 1e-12);
}

#[test]
fn a_sphere_goes_round_a_periodic_box_as_often_as_it_likes() {
    let boundary = Boundary::Periodic { size: DVec3::ONE };
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(1e7, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    run(&mut world, 1.0 / 64.0, 2);
    // 312,500 times round, without rounding.
    assert_eq!(world.sphere(ball).unwrap().position, DVec3::ZERO);
}

#[test]
fn balls_however_far_outside_a_periodic_box_are_their_images_within() {
    let boundary = Boundary::Periodic { size: vec(8.0, 8.0, f64::INFINITY) };
    let ball = |x: f64| Sphere::new(vec(x, 0.0, 0.0), 0.25).with_velocity(DVec3::X);
    let target = Sphere::new(vec(2.0, 0.0, 0.0), 0.25);
    let image = |first: Sphere, is_put: bool| {
        let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
        let id = world.add_sphere(if is_put { ball(0.0) } else { first }).unwrap();
        world.add_sphere(target).unwrap();
        if is_put {
            world.step(1.0 / 64.0).unwrap();
            world.set_sphere(id, first).unwrap();
        }
        let impacts = run(&mut world, 1.0 / 64.0, 256);
        (impacts, world.spheres().positions().to_vec())
    };
    for is_put in [false, true] {
        let expected = image(ball(0.0), is_put);
        assert_eq!(expected.0, 1);
        // Multiples of 8, as far as the box is counted and farther; the last one has no digit left.
        for away in [8.0, libm::exp2(40.0), -libm::exp2(55.0), libm::exp2(1000.0)] {
            assert_eq!(image(ball(away), is_put), expected, "{away} m away");
        }
    }
    let emitter = Emitter::new(ball(libm::exp2(50.0)), 1.0).with_count(1);
    let mut world = World::new(Settings::default().with_boundary(boundary)).unwrap();
    world.add_emitter(emitter).unwrap();
    world.step(0.5).unwrap();
    assert_eq!(world.spheres().positions(), [vec(0.5, 0.0, 0.0)]);
}
