//! Periodic boxes under the rule `contact` and in stepped zones: a face of the box is no place, so whatever goes
//! on across one goes on as in the middle.
//!
//! Says nothing of how well heaps are solved: that is in `contact_rule.rs` and `heaps.rs`.

mod common;

use carom::{
    Boundary, Collider, Contact, DVec3, Error, Exact, Friction, Gravity, Groups, Pose, Rule,
    Settings, Shape, Sphere, World,
};
use common::{Numbers, assert_close, assert_close_vec, vec};

const G: f64 = 9.81;
const FRAME: f64 = 1.0 / 60.0;

fn world_in(size: DVec3, rule: impl Into<Rule>) -> World {
    let boundary = Boundary::Periodic { size };
    World::new(Settings::default().with_rule(rule).with_boundary(boundary)).unwrap()
}

/// A world with gravity, periodic but for its height, over a floor at 0.
fn over_floor(edge: f64, rule: impl Into<Rule>, friction: f64) -> World {
    let mut world = world_in(vec(edge, f64::INFINITY, edge), rule);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(friction);
    world.add_collider(floor.with_restitution(0.0)).unwrap();
    world
}

fn run(world: &mut World, frames: u32) {
    for _ in 0..frames {
        world.step(FRAME).unwrap();
    }
}

/// The image of a way that is the shortest.
fn nearest(world: &World, way: DVec3) -> DVec3 {
    world.settings().boundary.nearest_image(way)
}

/// Balls at random places of a box that do not overlap, with random velocities and spins.
fn gas(world: &mut World, edge: f64, count: usize, radius: f64, seed: u64) {
    let mut numbers = Numbers(seed);
    let mut places: Vec<DVec3> = Vec::new();
    while places.len() < count {
        let place = 0.5 * edge * numbers.vector();
        let is_free = |it: &&DVec3| nearest(world, **it - place).length() > 2.001 * radius;
        if places.iter().filter(is_free).count() == places.len() {
            places.push(place);
        }
    }
    for place in places {
        let sphere = Sphere::new(place, radius).with_velocity(numbers.vector());
        let sphere = sphere.with_angular_velocity(5.0 * numbers.vector());
        world.add_sphere(sphere.with_friction(0.4).with_restitution(0.8)).unwrap();
    }
}

#[test]
fn a_collision_across_faces_edges_and_corners_is_one_in_the_middle() {
    // The same two rough balls everywhere: they meet off centre, with spin.
    let outcome = |place: DVec3| {
        let mut world = world_in(vec(4.0, 5.0, 6.0), Contact::default());
        let ball = |at: DVec3, velocity: DVec3| {
            let sphere = Sphere::new(world_position(at, vec(4.0, 5.0, 6.0)), 0.2);
            sphere.with_velocity(velocity).with_angular_velocity(vec(3.0, -2.0, 1.0))
        };
        let first = ball(place - vec(0.4, 0.02, -0.03), vec(2.0, 0.1, 0.3));
        let second = ball(place + vec(0.3, 0.1, 0.05), vec(-1.0, 0.2, -0.1));
        let rough = |sphere: Sphere| sphere.with_friction(0.3).with_restitution(0.7);
        let ids = [first, second].map(|it| world.add_sphere(rough(it)).unwrap());
        let mut impacts = 0;
        for _ in 0..20 {
            impacts += world.step(FRAME).unwrap().impacts.len();
        }
        let states = ids.map(|id| world.sphere(id).unwrap());
        let ways = states.map(|it| nearest(&world, it.position - place));
        assert_eq!(impacts, 1);
        (ways, states.map(|it| it.velocity), states.map(|it| it.angular_velocity))
    };
    let middle = outcome(DVec3::ZERO);
    for place in [vec(2.0, 0.0, 0.0), vec(0.0, -2.5, 3.0), vec(-2.0, 2.5, -3.0)] {
        let there = outcome(place);
        for number in 0..2 {
            // Places of some metres are known to 1e-15.
            assert_close_vec(there.0[number], middle.0[number], 1e-13);
            assert_close_vec(there.1[number], middle.1[number], 1e-13);
            assert_close_vec(there.2[number], middle.2[number], 1e-12);
        }
    }
}

/// A place in the box about the origin.
fn world_position(place: DVec3, size: DVec3) -> DVec3 {
    place - size * (place / size).round()
}

#[test]
fn what_leaves_through_a_face_comes_in_through_the_opposite_one() {
    let mut world = world_in(vec(2.0, f64::INFINITY, 3.0), Contact::default());
    let ball = Sphere::new(DVec3::ZERO, 0.25).with_velocity(vec(7.0, 1.0, -11.0));
    let id = world.add_sphere(ball).unwrap();
    for number in 1..=120 {
        world.step(FRAME).unwrap();
        let position = world.sphere(id).unwrap().position;
        assert!(position.x.abs() <= 1.0 && position.z.abs() <= 1.5, "{position}");
        let expected = f64::from(number) * FRAME * vec(7.0, 1.0, -11.0);
        let off = nearest(&world, position - expected);
        assert!(off.length() < 1e-12, "{off}");
    }
}

#[test]
fn a_gas_of_rough_balls_keeps_its_momentum_and_gains_no_energy() {
    let mut world = world_in(DVec3::splat(2.0), Contact::default());
    gas(&mut world, 2.0, 150, 0.1, 3);
    let (momentum, mass) = (world.momentum(), 150.0);
    let mut energy = world.total_energy();
    let mut account = 0.0;
    let start = energy;
    for _ in 0..120 {
        let report = world.step(FRAME).unwrap();
        account += report.energy_account.contacts;
        assert!(world.total_energy() <= energy * (1.0 + 1e-12));
        energy = world.total_energy();
    }
    // Rounding of some thousand impacts.
    assert!((world.momentum() - momentum).length() < 1e-12 * mass);
    assert_close(energy - start, account, 1e-9 * start);
    let deepest = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
    assert!(deepest < 0.002, "{deepest}");
}

#[test]
fn a_layer_without_walls_bears_itself_sleeps_and_presses_with_its_weight() {
    // Three layers, of which each ball lies in a hollow: across the faces as everywhere.
    for rule in [Rule::Contact(Contact::default()), Rule::Exact(Exact::default())] {
        let mut world = over_floor(0.8, rule, 0.5);
        for layer in 0..3 {
            for number in 0..16 {
                let (row, column) = (f64::from(number / 4), f64::from(number % 4));
                let shift = 0.1 * f64::from(layer % 2);
                let place =
                    vec(0.2 * row + shift, 0.1 + 0.145 * f64::from(layer), 0.2 * column + shift);
                let ball = Sphere::new(place - vec(0.4, 0.0, 0.4), 0.1).with_density(1000.0);
                world.add_sphere(ball.with_friction(0.5).with_restitution(0.0)).unwrap();
            }
        }
        run(&mut world, 240);
        let weight: f64 = world.spheres().masses().iter().sum::<f64>() * G;
        let contacts = world.contacts();
        let colliders =
            contacts.iter().filter(|it| matches!(it.between, carom::BodyPair::Collider { .. }));
        let borne: f64 = colliders.map(|it| it.normal_force).sum();
        // Sleepers press as when they fell asleep, to some percent (docs/physics/contact.md).
        assert_close(borne, weight, 0.03 * weight);
        let fastest = world.spheres().velocities().iter().map(|v| v.length()).fold(0.0, f64::max);
        assert!(fastest < 1e-9, "{fastest}");
        let lowest =
            world.spheres().positions().iter().map(|it| it.y).fold(f64::INFINITY, f64::min);
        let highest = world.spheres().positions().iter().map(|it| it.y).fold(0.0, f64::max);
        assert!(lowest > 0.0995 && highest > 0.375, "{lowest} {highest}");
    }
}

#[test]
fn a_blow_wakes_what_sleeps_on_the_other_side_of_a_face() {
    let mut world = over_floor(1.0, Contact::default(), 0.5);
    let ball = |x: f64| {
        let sphere = Sphere::new(vec(x, 0.1, 0.0), 0.1).with_restitution(0.0);
        sphere.with_friction(Friction::sliding(0.5).with_rolling(0.05))
    };
    // Three balls in a row across the face at 0.5.
    let last = world.add_sphere(ball(-0.4)).unwrap();
    let middle = world.add_sphere(ball(0.4)).unwrap();
    world.add_sphere(ball(0.2)).unwrap();
    run(&mut world, 120);
    assert_eq!(world.report().contact_account.asleep, 3);
    let before = world.sphere(last).unwrap().position;
    world.add_sphere(ball(-0.1).with_velocity(vec(4.0, 0.0, 0.0))).unwrap();
    run(&mut world, 20);
    let [after, beside] = [last, middle].map(|id| world.sphere(id).unwrap().position);
    assert!(nearest(&world, after - before).x > 0.05, "{before} {after}");
    assert!(nearest(&world, after - beside).x > 0.199, "{beside} {after}");
}

#[test]
fn a_plate_goes_on_in_its_image_and_a_post_is_met_from_the_other_side() {
    // A rough ball rolls over the gap between a plate and its image, or a second plate in open space; then it
    // bounces off a fixed ball at a face, or off one where the image would be. Without a gap the two plates would be
    // one surface, which a plate and its image are not.
    let state_after = |boundary: Boundary| {
        let settings = Settings::default().with_rule(Contact::default()).with_boundary(boundary);
        let mut world = World::new(settings).unwrap();
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        let is_open = boundary == Boundary::Open;
        let plates = if is_open { vec![0.0, 1.0] } else { vec![0.0] };
        for x in plates {
            let plate = Shape::Rectangle { size_x: 0.999, size_z: 1.0 };
            let plate = Collider::new(plate, Pose::at(vec(x, 0.0, 0.0)));
            // In another group, so that it is no more flush with the first than an image is.
            let groups = Groups { groups: if x > 0.0 { 2 } else { 1 }, ..Groups::DEFAULT };
            let plate = plate.with_groups(groups);
            world.add_collider(plate.with_friction(0.5).with_restitution(0.2)).unwrap();
        }
        let post = vec(if is_open { 1.4 } else { 0.4 }, 0.1, 0.1);
        let post = Collider::new(Shape::Sphere { radius: 0.1 }, Pose::at(post));
        world.add_collider(post.with_restitution(0.5)).unwrap();
        let rolling = Sphere::new(vec(0.0, 0.1, -0.3), 0.1).with_velocity(vec(2.0, 0.0, 0.5));
        let rolling = rolling.with_angular_velocity(vec(5.0, 0.0, -20.0)).with_friction(0.5);
        let id = world.add_sphere(rolling.with_restitution(0.5)).unwrap();
        let mut struck = false;
        for _ in 0..60 {
            let impacts = &world.step(FRAME).unwrap().impacts;
            struck |= impacts.iter().any(|it| it.normal.x < -0.1);
        }
        assert!(struck);
        world.sphere(id).unwrap()
    };
    let size = vec(1.0, f64::INFINITY, f64::INFINITY);
    let (open, boxed) = (state_after(Boundary::Open), state_after(Boundary::Periodic { size }));
    let way = boxed.position - open.position;
    assert_close_vec(way - size.with_y(0.0).with_z(0.0) * way.x.round(), DVec3::ZERO, 1e-12);
    assert_close_vec(boxed.velocity, open.velocity, 1e-12);
    assert!(open.velocity.x < 1.5);
}

#[test]
fn a_box_that_is_too_narrow_is_refused() {
    for rule in [Rule::Contact(Contact::default()), Rule::Exact(Exact::default())] {
        let mut world = world_in(vec(0.39, f64::INFINITY, 1.0), rule);
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
        for refused in [world.check_step(FRAME), world.step(FRAME).map(|_| ())] {
            let Err(Error::Invalid { source, .. }) = refused else { panic!("{refused:?}") };
            assert_eq!(source.field, "size");
        }
    }
}

#[test]
fn in_the_narrowest_box_no_ball_comes_into_two_images_of_another() {
    // A ball between two images of the next one, shaken for a while.
    let mut world = world_in(DVec3::splat(0.4), Contact::default());
    let mut numbers = Numbers(5);
    for place in [vec(-0.1, 0.0, 0.0), vec(0.1, 0.0, 0.01)] {
        let ball = Sphere::new(place, 0.0999).with_velocity(numbers.vector());
        world.add_sphere(ball.with_restitution(0.9)).unwrap();
    }
    let momentum = world.momentum();
    for _ in 0..300 {
        world.step(FRAME).unwrap();
        let deepest = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
        assert!(deepest < 2e-3, "{deepest}");
    }
    assert!((world.momentum() - momentum).length() < 1e-13);
}

#[test]
fn a_snapshot_goes_on_with_the_same_bits_across_faces() {
    let mut world = over_floor(1.0, Contact::default(), 0.4);
    let mut numbers = Numbers(9);
    for number in 0..60 {
        let layer = 0.11 + 0.22 * f64::from(number / 16);
        let (row, column) = (f64::from(number % 4), f64::from(number / 4 % 4));
        let place = vec(0.25 * row - 0.4, layer, 0.25 * column - 0.4);
        let ball = Sphere::new(place, 0.1).with_velocity(3.0 * numbers.vector());
        world.add_sphere(ball.with_friction(0.4).with_restitution(0.5)).unwrap();
    }
    run(&mut world, 40);
    let snapshot = world.snapshot();
    run(&mut world, 20);
    let hash = world.state_hash();
    world.restore(&snapshot);
    run(&mut world, 20);
    assert_eq!(world.state_hash(), hash);
}

#[test]
fn bits_in_a_periodic_box_depend_on_no_thread() {
    // Enough balls for several slabs. Run with the feature `rayon`, too, on several numbers of threads.
    let mut world = over_floor(3.0, Contact::default(), 0.3);
    let mut numbers = Numbers(2);
    for number in 0..1200 {
        let cell =
            vec(f64::from(number % 12), f64::from(number / 144), f64::from(number / 12 % 12));
        let place = 0.25 * cell + vec(-1.4, 0.15, -1.4);
        let ball = Sphere::new(place, 0.12).with_velocity(2.0 * numbers.vector());
        world.add_sphere(ball.with_restitution(0.3).with_friction(0.3)).unwrap();
    }
    run(&mut world, 40);
    assert_eq!(world.state_hash().to_string(), "ac5ea0714a932cd2");
}

/// Balls on a bed of fixed ones that is tilted by an angle [degrees], periodic along and across: after Silbert et
/// al., Phys. Rev. E 64, 051302 (2001), but few.
fn chute(rule: impl Into<Rule>, degrees: f64, layers: u32) -> World {
    let mut world = world_in(vec(1.2, f64::INFINITY, 0.8), rule);
    let tilt = degrees.to_radians();
    let down = vec(G * libm::sin(tilt), -G * libm::cos(tilt), 0.0);
    world.add_force(Gravity::new(down)).unwrap();
    let mut numbers = Numbers(4);
    for number in 0..24 {
        let (row, column) = (f64::from(number % 6), f64::from(number / 6));
        let place = vec(0.2 * row - 0.5, 0.05 * numbers.next(), 0.2 * column - 0.3);
        let fixed = Collider::new(Shape::Sphere { radius: 0.1 }, Pose::at(place));
        world.add_collider(fixed.with_friction(0.5).with_restitution(0.9)).unwrap();
    }
    let floor = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -0.05, 0.0)));
    world.add_collider(floor.with_friction(0.5).with_restitution(0.9)).unwrap();
    for number in 0..24 * layers {
        let (row, column) = (f64::from(number % 6), f64::from(number / 6 % 4));
        let layer = f64::from(number / 24);
        let jitter = 0.02 * numbers.vector();
        let place = vec(0.2 * row - 0.5, 0.28 + 0.25 * layer, 0.2 * column - 0.3) + jitter;
        let ball = Sphere::new(place, 0.09).with_velocity(vec(0.5 * layer, 0.0, 0.0));
        world.add_sphere(ball.with_friction(0.5).with_restitution(0.9)).unwrap();
    }
    world
}

/// Mean velocity along the chute of the lower and the upper half of the balls, by height [m/s].
fn halves(world: &World) -> [f64; 2] {
    let spheres = world.spheres();
    let mut rows: Vec<_> = spheres.positions().iter().zip(spheres.velocities()).collect();
    rows.sort_by(|a, b| a.0.y.total_cmp(&b.0.y));
    let (low, high) = rows.split_at(rows.len() / 2);
    [low, high].map(|half| half.iter().map(|it| it.1.x).sum::<f64>() / half.len() as f64)
}

#[test]
fn grains_on_a_rough_chute_flow_at_27_degrees_and_stop_at_12() {
    for rule in [Rule::Contact(Contact::default()), Rule::Exact(Exact::default())] {
        let mut steep = chute(rule, 27.0, 5);
        run(&mut steep, 240);
        let [low, high] = halves(&steep);
        // The lower half is held by the bed; the shear is what makes it a flow.
        assert!(high > 0.3 && high > 1.5 * low, "{low} {high}");
        let mut gentle = chute(rule, 12.0, 5);
        run(&mut gentle, 240);
        let [low, high] = halves(&gentle);
        assert!(low.abs() < 0.01 && high.abs() < 0.02, "{low} {high}");
        for world in [steep, gentle] {
            let deepest = world.overlaps(0.0).iter().map(|it| it.depth).fold(0.0, f64::max);
            assert!(deepest < 0.01 * 0.09, "{deepest}");
        }
    }
}

#[test]
fn a_chute_gains_what_gravity_gives_across_the_faces() {
    // Potential energy jumps at a face by m g L; the rest of the account is closed.
    let mut world = chute(Contact::default().with_sub_steps(64), 22.0, 3);
    let (mut given, mut start) = (0.0, world.total_energy());
    let slope = G * libm::sin(22.0_f64.to_radians());
    let mut largest: f64 = 0.0;
    for _ in 0..60 {
        let before = world.spheres().positions().to_vec();
        let account = world.step(FRAME).unwrap().energy_account;
        given += account.contacts + account.correction;
        let spheres = world.spheres();
        let moved = before.iter().zip(spheres.positions()).zip(spheres.masses());
        start += moved
            .map(|((from, to), mass)| {
                let jump = nearest(&world, *to - *from) - (*to - *from);
                mass * slope * jump.x
            })
            .sum::<f64>();
        largest = largest.max(world.total_energy().abs()).max(given.abs());
        // Grains that bear each other move by their last velocities: an error of first order in the sub-step,
        // far below one jump.
        assert_close(world.total_energy(), start + given, 1e-3 * largest);
    }
}

#[test]
fn images_of_plates_bear_beside_a_paddle_that_moves() {
    // The search within the first sub-step finds the images, when it is known already where the paddle ends.
    let mut world = world_in(vec(1.0, f64::INFINITY, 1.0), Contact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let plate = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
    world.add_collider(Collider::new(plate, Pose::at(DVec3::ZERO)).with_friction(0.5)).unwrap();
    let paddle = Shape::Box { size: vec(0.1, 0.1, 0.1) };
    let paddle = Collider::new(paddle, Pose::at(vec(0.0, 0.5, 0.0)));
    world.add_collider(paddle.moving(vec(0.1, 0.0, 0.0), DVec3::ZERO)).unwrap();
    let ball = Sphere::new(vec(0.49, 0.1, 0.2), 0.1).with_velocity(vec(1.0, 0.0, 0.0));
    let id = world.add_sphere(ball.with_friction(0.5).with_restitution(0.0)).unwrap();
    run(&mut world, 20);
    // On the image of the plate it lies as on the plate: the slop of an overlap is left.
    assert_close(world.sphere(id).unwrap().position.y, 0.1, 1e-3);
}
