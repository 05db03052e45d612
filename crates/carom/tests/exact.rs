//! The rule `exact` through what it does to spheres. Proves that frames, cells and insertion order
//! leave no trace, that contacts last and end as mechanics says, and that walls move, boxes repeat
//! and forces act as they say. It proves nothing about speed.

mod common;

use carom::{
    BodyPair, Boundary, Collider, DQuat, DVec3, Emitter, Error, Exact, Force, Gravity, Pose, Rule,
    Settings, Shape, Sphere, SphereState, ViscousDrag, World, Zones,
};
use common::{G, Numbers, assert_close, assert_close_vec, discrete, vec, world};

fn exact() -> World {
    world(Rule::default())
}

fn under_gravity() -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

fn half_space(world: &mut World, point: DVec3, normal: DVec3, restitution: f64) {
    let pose = Pose::at(point).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
    let wall = Collider::new(Shape::HalfSpace, pose).with_restitution(restitution);
    world.add_collider(wall).unwrap();
}

/// Forty balls of many sizes fall through pegs onto a floor.
fn bustle(order: &[usize]) -> World {
    let mut numbers = Numbers(5);
    let mut world = under_gravity();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.8);
    for x in -2..=2 {
        let peg = Shape::Sphere { radius: 0.3 };
        let pose = Pose::at(vec(x.into(), 2.0, 0.1 * f64::from(x)));
        world.add_collider(Collider::new(peg, pose).with_restitution(0.9)).unwrap();
    }
    let balls: Vec<Sphere> = (0..40u32)
        .map(|i| {
            let place =
                vec(f64::from(i % 8) - 3.5, 3.5 + f64::from(i / 8), numbers.between(-0.1, 0.1));
            let ball = Sphere::new(place, numbers.between(0.1, 0.45)).with_density(1000.0);
            ball.with_velocity(numbers.vector()).with_restitution(0.95)
        })
        .collect();
    for &i in order {
        world.add_sphere(balls[i]).unwrap();
    }
    world
}

fn run(world: &mut World, frame: f64, frames: usize) -> usize {
    (0..frames).map(|_| world.step(frame).unwrap().impacts.len()).sum()
}

#[test]
fn frames_leave_no_trace_in_a_single_bit() {
    let order: Vec<usize> = (0..40).collect();
    // Powers of two, so that the clock adds up without rounding.
    let [coarse, fine, single] = [(1.0 / 32.0, 96), (1.0 / 256.0, 768), (3.0, 1)].map(|(h, n)| {
        let mut world = bustle(&order);
        let impacts = run(&mut world, h, n);
        (impacts, world.state_hash())
    });
    assert!(coarse.0 > 100, "{}", coarse.0);
    assert_eq!(coarse, fine);
    assert_eq!(coarse, single);
}

#[test]
fn the_order_in_which_spheres_came_leaves_no_trace() {
    let order: Vec<usize> = (0..40).collect();
    // 27 and 40 have no common factor: every ball comes once.
    let shuffled: Vec<usize> = (0..40).map(|i| i * 27 % 40).collect();
    let (mut first, mut second) = (bustle(&order), bustle(&shuffled));
    assert_eq!(run(&mut first, 1.0 / 64.0, 128), run(&mut second, 1.0 / 64.0, 128));
    for (place, &i) in shuffled.iter().enumerate() {
        assert_eq!(first.spheres().positions()[i], second.spheres().positions()[place]);
        assert_eq!(first.spheres().velocities()[i], second.spheres().velocities()[place]);
    }
}

#[test]
fn a_bouncing_ball_comes_to_rest_at_the_sum_of_its_flights() {
    for e in [0.3, 0.8, 0.95] {
        let mut world = under_gravity();
        half_space(&mut world, DVec3::ZERO, DVec3::Y, e);
        let ball = world.add_sphere(Sphere::new(vec(0.0, 2.5, 0.0), 0.5)).unwrap();
        let rest = (2.0 * 2.0 / G).sqrt() * (1.0 + e) / (1.0 - e);
        let mut last = 0.0;
        while world.time() < rest + 1.0 {
            let start = world.time();
            let report = world.step(0.25).unwrap();
            last = report.impacts.last().map_or(last, |impact| start + impact.time);
        }
        // The bounces shorter than the duration of a contact are left out: those no higher than 256
        // roundings of the coordinates, half a metre, and the radius.
        let contact_duration = (8.0 * 256.0 * f64::EPSILON * (0.5 + 0.5) / G).sqrt();
        assert_close(last, rest, 1.1 * contact_duration / (1.0 - e));
        assert_eq!(world.sphere(ball).unwrap().velocity, DVec3::ZERO);
        assert_close(world.sphere(ball).unwrap().position.y, 0.5, 1e-14);
    }
}

#[test]
fn a_ball_slides_down_a_ramp_as_if_there_were_no_third_dimension() {
    let angle: f64 = 0.3;
    let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
    let mut world = under_gravity();
    let normal = vec(sine, cosine, 0.0);
    half_space(&mut world, DVec3::ZERO, normal, 0.5);
    let ball = world.add_sphere(Sphere::new(0.25 * normal, 0.25)).unwrap();
    assert_eq!(run(&mut world, 0.1, 20), 0);
    // g sin a along the ramp, to the rounding of some hundred operations on tens of metres.
    let along = 0.5 * G * sine * 4.0;
    let end = world.sphere(ball).unwrap();
    assert_close_vec(end.position, 0.25 * normal + along * vec(cosine, -sine, 0.0), 1e-13);
    assert_close(end.velocity.length(), G * sine * 2.0, 1e-13);
}

#[test]
fn a_ball_that_slides_off_a_plate_flies_on_and_lands_where_a_parabola_does() {
    let mut world = under_gravity();
    let plate = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    world.add_collider(Collider::new(plate, Pose::at(vec(0.0, 5.0, 0.0)))).unwrap();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.0);
    let (radius, speed) = (0.1, 3.0);
    let ball = Sphere::new(vec(0.0, 5.0 + radius, 0.0), radius).with_velocity(vec(speed, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    // Faster than sqrt(g r), it leaves the edge at once.
    let fall = (2.0 * 5.0 / G).sqrt();
    let landing = 1.0 / speed + fall;
    run(&mut world, landing / 100.0, 101);
    let end = world.sphere(ball).unwrap();
    assert_close(end.position.y, radius, 1e-12);
    assert_close(end.velocity.x, speed, 1e-12);
    assert_close(end.position.x, speed * world.time(), 1e-12);
}

#[test]
fn a_ball_leaves_a_fixed_sphere_two_thirds_of_the_way_down() {
    let (radius, ball_radius, start): (f64, f64, f64) = (1.0, 0.2, 0.05);
    let mut world = under_gravity();
    let dome = Collider::new(Shape::Sphere { radius }, Pose::at(DVec3::ZERO));
    world.add_collider(dome.with_restitution(0.0)).unwrap();
    let distance = radius + ball_radius;
    let place = distance * vec(libm::sin(start), libm::cos(start), 0.0);
    let ball = world.add_sphere(Sphere::new(place, ball_radius)).unwrap();
    // In flight the horizontal velocity is constant: it tells the height at which it left, for
    // v² = 2 g d (cos a - y) with v_x = v y and y = 2/3 cos a.
    run(&mut world, 0.01, 400);
    let y = 2.0 / 3.0 * libm::cos(start);
    let expected = y * (2.0 * G * distance * (libm::cos(start) - y)).sqrt();
    // Forces are found anew every 1e-3 rad: errors of the second order in it, over one radian.
    assert_close(world.sphere(ball).unwrap().velocity.x, expected, 1e-5 * expected);
}

#[test]
fn stacks_rest_without_any_speed_whatever_their_restitution() {
    for e in [0.0, 0.4, 1.0] {
        let mut world = under_gravity();
        half_space(&mut world, DVec3::ZERO, DVec3::Y, e);
        for i in 0..12 {
            let ball = Sphere::new(vec(0.0, 0.5 + f64::from(i), 0.0), 0.5);
            world.add_sphere(ball.with_restitution(e).with_mass(1.0 + f64::from(i % 3))).unwrap();
        }
        assert_eq!(run(&mut world, 0.02, 500), 0);
        assert!(world.spheres().velocities().iter().all(|&v| v == DVec3::ZERO));
        assert_close(world.spheres().positions()[11].y, 11.5, 1e-13);
    }
}

#[test]
fn a_shot_stack_falls_apart_and_keeps_its_momentum_across() {
    let mut world = under_gravity();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.0);
    for i in 0..5 {
        world.add_sphere(Sphere::new(vec(0.0, 0.5 + f64::from(i), 0.0), 0.5)).unwrap();
    }
    let shot = Sphere::new(vec(-5.0, 2.6, 0.0), 0.5).with_velocity(vec(20.0, 3.0, 0.0));
    world.add_sphere(shot).unwrap();
    assert!(run(&mut world, 1.0 / 60.0, 300) > 1);
    // Nothing but the shot moves along x, and no force acts that way.
    assert_close(world.momentum().x, 20.0, 1e-11);
    assert_eq!(world.overlaps(1e-9), []);
}

#[test]
fn a_ball_shot_into_a_block_at_rest_keeps_the_clock_going_and_the_momentum_across() {
    // Spheres that roll on each other lean, open and close by next to nothing: the bound is far above
    // what they need, and far below events that come one rounding of the clock after another.
    let rule = Rule::Exact(Exact::default().with_max_impacts(20_000));
    let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    half_space(&mut world, DVec3::ZERO, DVec3::Y, 0.5);
    let ball = |place: DVec3| Sphere::new(place, 0.5).with_mass(1.0).with_restitution(0.5);
    for n in 0..8u8 {
        let corner = vec(f64::from(n & 1), f64::from(n >> 1 & 1), f64::from(n >> 2));
        world.add_sphere(ball(corner + vec(0.0, 0.5, 0.0))).unwrap();
    }
    world.add_sphere(ball(vec(-3.0, 1.1, 1.3)).with_velocity(vec(5.0, 0.0, 0.0))).unwrap();
    run(&mut world, 1.0 / 60.0, 120);
    let momentum: DVec3 = world.spheres().velocities().iter().sum();
    // Corrections of persistent contacts push both bodies alike, each time to a rounding.
    assert!((momentum.x - 5.0).abs() < 1e-9 && momentum.z.abs() < 1e-9, "{momentum}");
}

#[test]
fn spheres_a_thousand_times_as_large_meet_the_small_ones() {
    let mut numbers = Numbers(3);
    let mut world = exact();
    for normal in [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z] {
        half_space(&mut world, -3.0 * normal, normal, 1.0);
    }
    world.add_sphere(Sphere::new(DVec3::ZERO, 1.0).with_mass(1e6)).unwrap();
    for i in 0..300u32 {
        let cell = vec((i % 8).into(), (i / 8 % 8).into(), (i / 64).into());
        let place = vec(-2.5, -2.5, 1.5) + cell * vec(0.6, 0.6, 0.25);
        let radius = [0.001, 0.01, 0.1][i as usize % 3];
        let ball = Sphere::new(place, radius).with_density(1000.0);
        world.add_sphere(ball.with_velocity(30.0 * numbers.vector())).unwrap();
    }
    let energy = world.kinetic_energy();
    let mut with_large = 0;
    for _ in 0..120 {
        let report = world.step(1.0 / 60.0).unwrap();
        let is_with_large = |between: &BodyPair| match between {
            BodyPair::Spheres(first, _) => first.number() == 0,
            BodyPair::Collider { .. } => false,
        };
        with_large += report.impacts.iter().filter(|it| is_with_large(&it.between)).count();
        assert_eq!(world.overlaps(1e-12), []);
    }
    assert!(with_large > 200, "{with_large}");
    assert_close(world.kinetic_energy() / energy, 1.0, 1e-12);
}

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
fn a_moving_wall_throws_a_ball_at_twice_its_speed() {
    let mut world = exact();
    let wall = Shape::Rectangle { size_x: 4.0, size_z: 4.0 };
    let pose = Pose::at(vec(-2.0, 0.0, 0.0)).rotated(DQuat::from_rotation_arc(DVec3::Y, DVec3::X));
    let wall = Collider::new(wall, pose).moving(vec(3.0, 0.0, 0.0), DVec3::ZERO);
    let wall = world.add_collider(wall).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5)).unwrap();
    let mut hits = Vec::new();
    for _ in 0..60 {
        let start = world.time();
        hits.extend(world.step(1.0 / 60.0).unwrap().impacts.iter().map(|it| start + it.time));
    }
    assert_eq!(hits.len(), 1);
    // The wall's position is added up over frames.
    assert_close(hits[0], 0.5, 1e-14);
    assert_close_vec(world.sphere(ball).unwrap().velocity, vec(6.0, 0.0, 0.0), 1e-14);
    assert_close(world.collider(wall).unwrap().pose.position.x, 1.0, 1e-14);
}

#[test]
fn a_turning_paddle_hits_with_the_speed_of_its_surface() {
    let mut world = exact();
    let paddle = Shape::Rectangle { size_x: 4.0, size_z: 1.0 };
    let spin = vec(0.0, 0.0, 2.0);
    let paddle = Collider::new(paddle, Pose::at(DVec3::ZERO)).moving(DVec3::ZERO, spin);
    world.add_collider(paddle).unwrap();
    // It sweeps upwards on the side of positive x; the ball waits above.
    let ball = world.add_sphere(Sphere::new(vec(1.0, 0.8, 0.0), 0.1)).unwrap();
    let mut impacts = Vec::new();
    for _ in 0..40 {
        impacts.extend(world.step(0.01).unwrap().impacts.clone());
    }
    assert_eq!(impacts.len(), 1);
    let arm = (1.0f64 + 0.64 - 0.01).sqrt();
    // Where the ball touches, the paddle moves along its normal at w times the arm.
    assert_close(impacts[0].approach_speed, 2.0 * arm, 1e-9);
    assert_close(world.sphere(ball).unwrap().velocity.length(), 4.0 * arm, 1e-9);
}

#[test]
fn a_ball_rides_on_a_platform_that_rises() {
    let mut world = under_gravity();
    let platform = Shape::Rectangle { size_x: 2.0, size_z: 2.0 };
    let platform = Collider::new(platform, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(platform.moving(vec(0.0, 1.5, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(vec(0.0, 0.25, 0.0), 0.25).with_velocity(vec(0.0, 1.5, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    run(&mut world, 1.0 / 60.0, 120);
    let end = world.sphere(ball).unwrap();
    assert_close(end.position.y, 0.25 + 1.5 * world.time(), 1e-12);
    assert_close(end.velocity.y, 1.5, 1e-12);
}

#[test]
fn three_balls_in_line_collapse_and_time_goes_on() {
    let mut world = exact();
    for (x, v) in [(-2.0, 1.0), (0.0, 0.0), (1.5, -1.0)] {
        let ball = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(v, 0.0, 0.0));
        world.add_sphere(ball.with_restitution(0.2)).unwrap();
    }
    let momentum = world.momentum();
    let impacts = run(&mut world, 0.1, 100);
    assert!((3..200).contains(&impacts), "{impacts}");
    assert_close_vec(world.momentum(), momentum, 1e-15);
    assert_eq!(world.overlaps(1e-12), []);
}

#[test]
fn the_ledger_accounts_for_every_impact() {
    let mut world = bustle(&(0..40).collect::<Vec<_>>());
    let mut entries = 0;
    for _ in 0..180 {
        let report = world.step(1.0 / 60.0).unwrap();
        assert_eq!(report.ledger().count(), report.impacts.len());
        for entry in report.ledger() {
            // Sums over the few bodies of a group, each term rounded once or twice.
            assert!(entry.group.momentum_error() <= 1e-14, "{entry:?}");
            assert!(entry.group.energy_error() <= 1e-13, "{entry:?}");
            assert!(entry.group.energy_after <= entry.group.energy_before * (1.0 + 1e-14));
            entries += 1;
        }
    }
    assert!(entries > 100);
}

#[test]
fn emitters_emit_within_a_frame_at_their_own_time() {
    let sphere = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(2.0, 0.0, 0.0));
    let mut world = under_gravity();
    world.add_emitter(Emitter::new(sphere, 0.3).with_max_spheres(3)).unwrap();
    let report = world.step(1.0).unwrap();
    assert_eq!((report.emitted.len(), report.retired.len()), (4, 1));
    for (place, due) in world.spheres().positions().iter().zip([0.3, 0.6, 0.9]) {
        let age = 1.0 - due;
        assert_close_vec(*place, vec(2.0 * age, -0.5 * G * age * age, 0.0), 1e-15);
    }
}

#[test]
fn more_impacts_than_allowed_are_an_error_that_changes_nothing() {
    let rule = Rule::Exact(Exact::default().with_max_impacts(50).with_zones(Zones::Never));
    let mut world = world(rule);
    half_space(&mut world, DVec3::ZERO, DVec3::X, 1.0);
    half_space(&mut world, vec(1.0, 0.0, 0.0), DVec3::NEG_X, 1.0);
    let ball = Sphere::new(vec(0.5, 0.0, 0.0), 0.1).with_velocity(vec(1e3, 0.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.step(0.01).unwrap();
    let before = (world.sphere(ball).unwrap(), world.time());
    let error = world.step(1.0).unwrap_err();
    assert!(matches!(error, Error::TooManyImpacts { limit: 50, .. }), "{error}");
    assert_eq!((world.sphere(ball).unwrap(), world.time()), before);
    assert!(world.report().impacts.is_empty());
    world.step(0.01).unwrap();
}

/// A spring of 1 N/m to the origin.
#[derive(Debug)]
struct Spring;

impl Force for Spring {
    fn on(&self, sphere: &SphereState, _time: f64) -> DVec3 {
        -sphere.position
    }
}

#[test]
fn a_force_of_its_own_is_followed_to_rounding() {
    let mut world = exact();
    world.add_force(Spring).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::X, 0.1)).unwrap();
    run(&mut world, 0.01, 100);
    // A few steps, with a few roundings each.
    let position = world.sphere(ball).unwrap().position;
    assert_close_vec(position, vec(libm::cos(1.0), 0.0, 0.0), 1e-14);
}

#[test]
fn a_force_of_its_own_acts_on_while_others_come() {
    let mut world = exact();
    world.add_force(Spring).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::X, 0.1)).unwrap();
    let far = vec(0.0, 50.0, 0.0);
    let emitter = Emitter::new(Sphere::new(DVec3::ZERO, 0.1), 0.003).with_position(far);
    world.add_emitter(emitter.with_max_spheres(1)).unwrap();
    run(&mut world, 0.01, 100);
    // As without the emitter.
    let position = world.sphere(ball).unwrap().position;
    assert_close_vec(position, vec(libm::cos(1.0), 0.0, 0.0), 1e-14);
}

#[test]
fn restitution_is_that_of_the_first_impact_under_a_force_of_its_own_too() {
    let mut world = exact();
    world.add_force(Spring).unwrap();
    half_space(&mut world, vec(0.0, -1e-12, 0.0), DVec3::Y, 0.5);
    let ball = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_velocity(vec(0.0, -1.0, 0.0));
    let ball = world.add_sphere(ball).unwrap();
    world.step(1e-6).unwrap();
    // The spring changes the speed by some 1e-7 m/s.
    assert_close(world.sphere(ball).unwrap().velocity.y, 0.5, 1e-6);
}

#[test]
fn plastic_impacts_far_from_the_origin_do_not_repeat_without_end() {
    let mut numbers = Numbers(11);
    for _ in 0..200 {
        let rule = Rule::Exact(Exact::default().with_max_impacts(100));
        let mut world = world(rule);
        let (place, way) = (10.0 * numbers.vector(), numbers.vector().normalize());
        let drift = numbers.vector();
        for side in [-1.0, 1.0] {
            let ball = Sphere::new(place + 0.02 * side * way, 0.01).with_restitution(0.0);
            world.add_sphere(ball.with_velocity(drift - side * way)).unwrap();
        }
        let impacts = run(&mut world, 0.1, 2);
        assert!((1..10).contains(&impacts), "{impacts}");
        let [a, b] = [0, 1].map(|index| world.spheres().velocities()[index]);
        assert_close_vec(a, b, 1e-12);
    }
}

#[test]
fn spheres_as_far_apart_as_numbers_go_do_no_harm() {
    let mut world = exact();
    for i in 0..40 {
        world.add_sphere(Sphere::new(vec(f64::from(i), 0.0, 0.0), 0.1)).unwrap();
    }
    for side in [-1.5e308, 1.5e308] {
        world.add_sphere(Sphere::new(vec(side, 0.0, 0.0), 0.1)).unwrap();
    }
    assert_eq!(run(&mut world, 0.1, 3), 0);
}

/// Three thousand spheres in a periodic box drawn to its middle: as many as threads share.
#[test]
fn the_state_is_the_same_to_the_last_bit_on_any_number_of_threads() {
    let size = DVec3::splat(16.0);
    let boundary = Boundary::Periodic { size };
    let rule = Exact::default().with_force_tick(1.0 / 16.0);
    let settings = Settings::default().with_boundary(boundary).with_rule(rule);
    let mut world = World::new(settings).unwrap();
    world.add_force(Spring).unwrap();
    let mut numbers = Numbers(3);
    for i in 0..3375 {
        let cell = vec(f64::from(i % 15), f64::from(i / 15 % 15), f64::from(i / 225));
        let place = (cell - 7.0) * (16.0 / 15.0);
        world.add_sphere(Sphere::new(place, 0.5).with_velocity(numbers.vector())).unwrap();
    }
    assert!(run(&mut world, 1.0 / 16.0, 8) > 500);
    assert_eq!(world.state_hash().to_string(), "5ac0c3dbd47f55df");
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
fn a_moving_trigger_reports_and_lets_pass() {
    let mut world = exact();
    let gate = Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(vec(3.0, 0.0, 0.0)));
    world.add_collider(gate.as_trigger().moving(vec(-1.0, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X);
    let ball = world.add_sphere(ball).unwrap();
    let (mut impacts, mut inside) = (0, 0);
    for _ in 0..40 {
        let report = world.step(0.1).unwrap();
        impacts += report.impacts.len();
        inside += report.triggers.len();
    }
    assert_eq!(impacts, 0);
    // They touch from 0.75 to 2.25 s.
    assert_eq!(inside, 15);
    assert_eq!(world.sphere(ball).unwrap().velocity, DVec3::X);
}

#[test]
fn a_ball_slides_on_a_plate_that_turns_in_its_own_plane() {
    let mut world = under_gravity();
    let plate = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(plate.moving(DVec3::ZERO, vec(0.0, 3.0, 0.0))).unwrap();
    let ball = Sphere::new(vec(1.0, 0.25, 0.0), 0.25).with_velocity(vec(0.0, 0.0, 1.0));
    let ball = world.add_sphere(ball).unwrap();
    // Without friction the plate may turn as it likes.
    assert_eq!(run(&mut world, 0.05, 40), 0);
    let end = world.sphere(ball).unwrap();
    assert_close_vec(end.position, vec(1.0, 0.25, 2.0), 1e-12);
    assert_close_vec(end.velocity, vec(0.0, 0.0, 1.0), 1e-12);
}

#[test]
fn with_drag_frames_leave_no_trace_either() {
    let [coarse, single] = [(1.0 / 32.0, 64), (2.0, 1)].map(|(frame, frames)| {
        let mut world = bustle(&(0..40).collect::<Vec<_>>());
        world.add_force(ViscousDrag::new(3.0)).unwrap();
        (run(&mut world, frame, frames), world.state_hash())
    });
    assert!(coarse.0 > 50, "{}", coarse.0);
    assert_eq!(coarse, single);
}

#[test]
fn a_ball_that_slides_on_a_floor_stays_on_it_however_slowly_that_turns() {
    for exponent in 0..20 {
        let mut world = under_gravity();
        let rate = libm::pow(10.0, -f64::from(exponent));
        let floor = Shape::Rectangle { size_x: 10.0, size_z: 10.0 };
        let floor = Collider::new(floor, Pose::at(DVec3::ZERO)).with_restitution(0.0);
        let floor = world.add_collider(floor.moving(DVec3::ZERO, vec(0.0, 0.0, rate))).unwrap();
        let ball = Sphere::new(vec(2.0, 0.5, 0.5), 0.5).with_velocity(vec(-2.0, 0.0, 0.0));
        let ball = world.add_sphere(ball).unwrap();
        world.step(1.0 / 60.0).unwrap();
        let into_floor = world.collider(floor).unwrap().pose.rotation.inverse();
        let height = (into_floor * world.sphere(ball).unwrap().position).y;
        // Turning surfaces are followed to 1e-10 of the radius of the curve, here some 10 m.
        assert_close(height, 0.5, 1e-8);
    }
}

#[test]
fn a_ball_that_slides_over_the_edge_of_a_turning_box_goes_no_farther_than_its_speed_takes_it() {
    // In the edge, two faces of the box have normals that differ by rounding only.
    let frame = 1.0 / 60.0;
    let turned = |angle: f64| {
        let (sine, cosine) = libm::sincos(0.5 * angle);
        DQuat::from_xyzw(0.0, 0.0, sine, cosine)
    };
    let (before, after) = (0.0931, 0.0931 - 0.1745 * frame);
    for step in 0..100 {
        let mut world = under_gravity();
        let mut add = |shape, place: DVec3, restitution| {
            let position = turned(before) * place;
            let velocity = (turned(after) * place - position) / frame;
            let spin = vec(0.0, 0.0, (after - before) / frame);
            let pose = Pose::at(position).rotated(turned(before));
            let collider = Collider::new(shape, pose).with_restitution(restitution);
            world.add_collider(collider.moving(velocity, spin)).unwrap();
        };
        let floor = Shape::Rectangle { size_x: 10.0, size_z: 10.0 };
        add(floor, vec(0.0, -0.2672, 0.0), 0.0);
        let wall = Shape::Box { size: vec(1.665, 1.6, 0.25) };
        add(wall, vec(-2.4, 0.4, 1.68), 0.2);
        let place = turned(before) * vec(-1.0675, 0.2328, 1.8 + 5e-5 * f64::from(step));
        let velocity = turned(before) * vec(0.04, 0.186, 0.437);
        let ball = Sphere::new(place, 0.5).with_velocity(velocity);
        let ball = world.add_sphere(ball).unwrap();
        world.step(frame).unwrap();
        let way = world.sphere(ball).unwrap().position.distance(place);
        assert!(way < 0.6 * frame, "{way} m from {place}");
    }
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
