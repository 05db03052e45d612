//! Spheres whose radii grow (`docs/physics/growth.md`): they meet at the root of a quadratic, leave faster by twice
//! the speed of growth, never overlap, and fill a box or a container densely.

use std::iter::successors;

use carom::{
    BodyPair, Boundary, Collider, ConstantForce, Contact, DQuat, DVec3, Emitter, Error, Friction,
    Impact, Pose, Settings, Shape, Sides, Sphere, Spring, World, volume,
};

mod common;

use common::{Numbers, assert_close, vec};

/// Rounding of a time or a speed that takes some ten operations.
const ROUNDING: f64 = 1e-14;

fn cube(edge: f64) -> Settings {
    Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(edge) })
}

/// The impacts of a frame of two spheres, and the world after it.
fn impacts_of(spheres: [Sphere; 2], seconds: f64) -> (Vec<Impact>, World) {
    let mut world = World::default();
    for sphere in spheres {
        world.add_sphere(sphere).unwrap();
    }
    let impacts = world.step(seconds).unwrap().impacts.clone();
    (impacts, world)
}

/// Small spheres of `radii` on a lattice in a cube about the origin with an `edge`, with velocities of about one.
fn fill(world: &mut World, count: usize, edge: f64, radii: impl Fn(usize) -> f64) {
    let mut numbers = Numbers(7);
    let side = successors(Some(1), |side| Some(side + 1)).find(|side| side * side * side >= count);
    let side = side.unwrap();
    for number in 0..count {
        let place = [number % side, number / side % side, number / (side * side)];
        let place = place.map(|it| ((it as f64 + 0.5) / side as f64 - 0.5) * edge);
        let sphere = Sphere::new(DVec3::from_array(place), radii(number))
            .with_velocity(numbers.vector())
            .with_mass(1.0 + 0.5 * (number % 3) as f64);
        world.add_sphere(sphere).unwrap();
    }
}

fn packing_fraction(world: &World, of: f64) -> f64 {
    world.spheres().radii().iter().map(|&radius| volume(radius)).sum::<f64>() / of
}

/// The largest overlap of two bodies, in parts of the smallest radius.
fn deepest(world: &World) -> f64 {
    let smallest = world.spheres().radii().iter().copied().fold(f64::INFINITY, f64::min);
    let overlaps = world.overlaps(0.0);
    overlaps.iter().map(|overlap| overlap.depth / smallest).fold(0.0, f64::max)
}

/// Number, times and bodies of all impacts in frames of a length, with the state hash at their end.
fn run(world: &mut World, frames: usize, seconds: f64) -> (Vec<BodyPair>, f64) {
    let (mut bodies, mut gained) = (Vec::new(), 0.0);
    for _ in 0..frames {
        let report = world.step(seconds).unwrap();
        bodies.extend(report.impacts.iter().map(|impact| impact.between));
        gained += report.energy_account.growth;
    }
    (bodies, gained)
}

#[test]
fn growing_spheres_at_rest_meet_when_they_fill_the_gap() {
    let sphere = |x: f64, growth: f64| Sphere::new(vec(x, 0.0, 0.0), 1.0).with_growth_speed(growth);
    let (impacts, world) = impacts_of([sphere(-2.0, 0.25), sphere(1.0, 0.75)], 1.25);
    let [impact] = impacts[..] else { panic!("{impacts:?}") };
    // A gap of 1 closes at a speed of 1.
    assert_close(impact.time, 1.0, ROUNDING);
    assert_close(impact.approach_speed, 1.0, ROUNDING);
    assert_close(impact.separation_speed, 1.0, ROUNDING);
    // Of spheres of one mass, each gets half of twice the speed of growth.
    let speeds = world.spheres().velocities();
    assert_close(speeds[0].x, -1.0, ROUNDING);
    assert_close(speeds[1].x, 1.0, ROUNDING);
    assert_eq!(world.spheres().radii(), [1.3125, 1.9375]);
}

#[test]
fn oblique_growing_spheres_meet_at_the_root_and_leave_twice_the_growth_faster() {
    let mut numbers = Numbers(11);
    let mut met = 0;
    for _ in 0..400 {
        let [g1, g2] = [numbers.between(0.0, 0.8), numbers.between(0.0, 0.8)];
        let first = Sphere::new(numbers.vector(), 0.5).with_velocity(numbers.vector());
        let offset = numbers.between(1.5, 4.0) * numbers.unit_vector();
        let second = Sphere::new(first.position + offset, 0.7).with_velocity(numbers.vector());
        let spheres = [first.with_growth_speed(g1), second.with_growth_speed(g2).with_mass(2.5)];
        let (impacts, world) = impacts_of(spheres, 3.0);
        let (r, v) = (offset, second.velocity - first.velocity);
        let (sum, growth) = (1.2, g1 + g2);
        let gap = |t: f64| (r + t * v).length() - (sum + growth * t);
        let Some(impact) = impacts.first() else {
            // Looked for at a thousand times: a contact between two of them is shorter than rounding of the eye.
            assert!((0..=1000).all(|k| gap(3.0 * f64::from(k) / 1000.0) > -1e-5));
            continue;
        };
        met += 1;
        let t = impact.time;
        assert!(gap(t).abs() < 1e-12, "{}", gap(t));
        assert!((1..100).all(|k| gap(t * f64::from(k) / 100.0) > 0.0), "met before");
        let normal = (r + t * v).normalize();
        let before = v.dot(normal);
        let velocities = world.spheres().velocities();
        if impacts.len() == 1 {
            let after = (velocities[1] - velocities[0]).dot(normal);
            assert_close(after, 2.0 * growth - before, 1e-12);
            let momentum = first.velocity + 2.5 * second.velocity;
            assert!((velocities[0] + 2.5 * velocities[1] - momentum).length() < 1e-12);
        }
    }
    assert!(met > 100, "{met}");
}

#[test]
fn spheres_that_part_slower_than_they_grow_are_overtaken() {
    let first = Sphere::new(DVec3::ZERO, 1.0).with_growth_speed(1.0);
    let second = Sphere::new(vec(3.0, 0.0, 0.0), 1.0).with_velocity(vec(0.5, 0.0, 0.0));
    let (impacts, _) = impacts_of([first, second], 4.0);
    // A gap of 1 closes at a speed of 1 - 0.5; then they part at 1.5, and growth does not come after.
    assert_eq!(impacts.len(), 1);
    assert_close(impacts[0].time, 2.0, ROUNDING);
    assert_close(impacts[0].separation_speed, 0.5, ROUNDING);
    let faster = second.with_velocity(vec(1.25, 0.0, 0.0));
    assert!(impacts_of([first, faster], 4.0).0.is_empty());
}

#[test]
fn growing_sphere_leaves_walls_twice_the_growth_faster() {
    let half_space = Collider::new(Shape::HalfSpace, Pose::at(vec(0.0, -2.0, 0.0)));
    let container = Shape::Container { size: DVec3::splat(4.0), open: Sides::NONE };
    let bowl = Shape::Bowl { radius: 2.0, opening: 0.0 };
    let ball = Collider::new(Shape::Sphere { radius: 0.5 }, Pose::at(vec(0.0, -2.5, 0.0)));
    let at_origin = |shape| Collider::new(shape, Pose::at(DVec3::ZERO));
    for collider in [half_space, at_origin(container), at_origin(bowl), ball] {
        let mut world = World::default();
        world.add_collider(collider).unwrap();
        let sphere = Sphere::new(DVec3::ZERO, 0.5).with_growth_speed(0.25);
        world.add_sphere(sphere.with_velocity(vec(0.0, -1.0, 0.0))).unwrap();
        let impacts = &world.step(1.5).unwrap().impacts;
        // A gap of 1.5 closes at a speed of 1.25.
        assert_eq!(impacts.len(), 1);
        assert_close(impacts[0].time, 1.2, ROUNDING);
        assert_close(impacts[0].approach_speed, 1.25, ROUNDING);
        assert_close(world.spheres().velocities()[0].y, 1.5, ROUNDING);
    }
}

#[test]
fn growing_spheres_never_overlap_in_a_periodic_box_nor_in_walls() {
    let container = Shape::Container { size: DVec3::splat(4.0), open: Sides::NONE };
    let bowl = Shape::Bowl { radius: 3.5, opening: 0.0 };
    let pipe = Shape::Pipe { radius: 2.9, length: 4.2, closed: carom::Ends::BOTH };
    for shape in [None, Some(container), Some(bowl), Some(pipe)] {
        let settings = if shape.is_none() { cube(4.0) } else { Settings::default() };
        let mut world = World::new(settings).unwrap();
        fill(&mut world, 120, 3.9, |number| [0.05, 0.1, 0.02][number % 3]);
        if let Some(shape) = shape {
            world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
        }
        world.set_growth_rate(1.8).unwrap();
        let mut count = 0;
        for _ in 0..120 {
            count += world.step(0.02).unwrap().impacts.len();
            // Radii, places and the distances made of them are rounded, some ten times each.
            assert!(deepest(&world) < 1e-12, "{}", deepest(&world));
        }
        assert!(count > 250, "{count}");
    }
}

#[test]
fn growth_has_the_same_bits_in_frames_of_any_length() {
    let after = |frames: u32| {
        let mut world = World::new(cube(4.0)).unwrap();
        fill(&mut world, 100, 4.0, |number| 0.1 + 0.001 * (number % 7) as f64);
        world.set_growth_rate(1.0).unwrap();
        let (bodies, _) = run(&mut world, frames as usize, 3.0 / f64::from(frames));
        (bodies, world.state_hash())
    };
    let (bodies, hash) = after(1);
    assert!(bodies.len() > 1000, "{}", bodies.len());
    for frames in [2, 16, 256] {
        assert!(after(frames) == (bodies.clone(), hash), "{frames} frames");
    }
}

#[test]
fn growth_goes_on_from_a_snapshot_with_the_same_bits() {
    let mut world = World::new(cube(4.0)).unwrap();
    fill(&mut world, 60, 4.0, |_| 0.1);
    world.set_growth_rate(1.0).unwrap();
    world.step(1.3).unwrap();
    let snapshot = world.snapshot();
    world.step(1.3).unwrap();
    let hash = world.state_hash();
    world.restore(&snapshot);
    world.step(1.3).unwrap();
    assert_eq!(world.state_hash(), hash);
}

#[test]
fn growth_is_the_same_at_any_size() {
    let at_scale = |scale: f64| {
        let mut world = World::new(cube(4.0 * scale)).unwrap();
        let mut other = World::new(cube(4.0)).unwrap();
        fill(&mut other, 100, 4.0, |number| 0.1 + 0.001 * (number % 7) as f64);
        let spheres = other.spheres();
        for index in 0..spheres.len() {
            let sphere = spheres.get(index);
            let sphere = sphere
                .with_position(scale * sphere.position)
                .with_radius(scale * sphere.radius)
                .with_velocity(scale * sphere.velocity);
            world.add_sphere(sphere).unwrap();
        }
        world.set_growth_rate(1.0).unwrap();
        run(&mut world, 3, 1.0).0
    };
    let bodies = at_scale(1.0);
    assert!(bodies.len() > 1000);
    // Powers of two round nothing.
    let million = f64::from(1 << 20);
    for scale in [1.0 / million, million] {
        assert!(at_scale(scale) == bodies, "{scale}");
    }
}

#[test]
fn energy_that_growth_gives_is_in_the_account() {
    let mut world = World::new(Settings::default()).unwrap();
    let size = DVec3::splat(4.0);
    let shape = Shape::Container { size, open: Sides::NONE };
    world.add_collider(Collider::new(shape, Pose::at(DVec3::ZERO))).unwrap();
    fill(&mut world, 100, 3.9, |_| 0.1);
    world.set_growth_rate(1.0).unwrap();
    let before = world.kinetic_energy();
    let (bodies, gained) = run(&mut world, 10, 0.3);
    assert!(bodies.len() > 1000 && gained > before);
    // Some thousand impacts, each with some roundings.
    assert_close(world.kinetic_energy(), before + gained, 1e-12 * gained);
}

#[test]
fn five_hundred_spheres_grow_to_a_packing_fraction_of_six_tenths() {
    let mut world = World::new(cube(10.0)).unwrap();
    fill(&mut world, 500, 10.0, |_| 0.1);
    // 1 + 2.75 rate t is the radius then, in parts of that now.
    let larger = libm::cbrt(0.6 / packing_fraction(&world, 1000.0));
    world.set_growth_rate(0.25).unwrap();
    world.step((larger - 1.0) / 0.25).unwrap();
    assert_close(packing_fraction(&world, 1000.0), 0.6, 1e-12);
    assert!(deepest(&world) < 1e-12);
}

#[test]
fn spheres_that_grow_at_speeds_of_their_own_change_their_order_of_size() {
    // The smallest one becomes the largest one by far.
    let mut world = World::new(cube(8.0)).unwrap();
    fill(&mut world, 60, 8.0, |number| if number == 31 { 0.01 } else { 0.2 });
    let id = world.spheres().ids()[31];
    let sphere = world.sphere(id).unwrap();
    world.set_sphere(id, sphere.with_growth_speed(0.4)).unwrap();
    for _ in 0..60 {
        world.step(0.05).unwrap();
        assert!(deepest(&world) < 1e-11, "{}", deepest(&world));
    }
    assert_close(world.sphere(id).unwrap().radius, 1.21, 1e-12);
    assert_eq!(world.sphere(world.spheres().ids()[0]).unwrap().radius, 0.2);
}

#[test]
fn growth_without_room_ends_in_an_error_and_keeps_the_state() {
    let mut world = World::new(cube(6.0)).unwrap();
    // Twenty-seven spheres in a lattice touch at a radius of one, and cannot become larger than a few hundredths more.
    fill(&mut world, 27, 6.0, |_| 0.5);
    world.set_growth_rate(1.0).unwrap();
    world.step(0.75).unwrap();
    let before = world.state_hash();
    let error = world.step(0.6).map(drop).unwrap_err();
    assert!(matches!(error, Error::NoRoomToGrow { .. }), "{error}");
    assert_eq!(world.state_hash(), before);
}

#[test]
fn a_sphere_between_walls_is_refused_at_256_times_its_speed_in_frames_of_any_length() {
    // At an impact the sphere becomes 2 G faster, and the gap to the opposite wall times v - G stays the same.
    let (growth, gap): (f64, f64) = (0.125, 1.0);
    let first = 0.5 * gap / (1.0 + growth);
    let gap_after_first = gap - 2.0 * growth * first;
    let impacts = (255.0 / (2.0 * growth)).floor() + 1.0;
    let fastest = 1.0 + 2.0 * growth * impacts;
    let last_gap = gap_after_first * (1.0 + growth) / (fastest - growth);
    let expected = (gap - last_gap) / (2.0 * growth);
    for frame in [1.0 / 240.0, 1.0 / 7.0, 100.0] {
        let mut world = World::default();
        for (x, turn) in [(-1.0, -0.25), (1.0, 0.25)] {
            let rotation = DQuat::from_rotation_z(turn * std::f64::consts::TAU);
            let pose = Pose { position: vec(x, 0.0, 0.0), rotation };
            world.add_collider(Collider::new(Shape::HalfSpace, pose)).unwrap();
        }
        let sphere = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X);
        world.add_sphere(sphere.with_growth_speed(growth)).unwrap();
        let error = loop {
            if let Err(error) = world.step(frame) {
                break error;
            }
        };
        let Error::NoRoomToGrow { at, .. } = error else { panic!("{error}") };
        // A thousand impacts, each rounded.
        assert_close(at, expected, 1e-12);
        assert!(!error.to_string().contains("restitution"), "{error}");
    }
}

/// What a step says of growth in a world that was changed.
fn refusal(change: impl FnOnce(&mut World)) -> String {
    let mut world = World::default();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_growth_speed(0.1)).unwrap();
    change(&mut world);
    let before = world.state_hash();
    let error = world.step(0.1).unwrap_err();
    assert!(matches!(error, Error::Invalid { .. }));
    assert_eq!(world.state_hash(), before);
    error.to_string()
}

#[test]
fn growth_is_refused_where_it_is_not_known() {
    let plate = Shape::Rectangle { size_x: 1.0, size_z: 1.0 };
    let below = Collider::new(plate, Pose::at(vec(0.0, -3.0, 0.0)));
    let inelastic = below.clone().with_restitution(0.5);
    let trigger = below.clone().as_trigger();
    let moving = below.moving(DVec3::X, DVec3::ZERO);
    let far = Sphere::new(vec(9.0, 0.0, 0.0), 0.5);
    let says = |text: String, part: &str| assert!(text.contains(part), "{text}");
    says(
        refusal(|it| it.set_settings(Settings::default().with_rule(Contact::default())).unwrap()),
        "rules",
    );
    says(refusal(|it| drop(it.add_force(ConstantForce { force: DVec3::X }))), "forces");
    says(refusal(|it| drop(it.add_sphere(far.with_restitution(0.9)))), "restitution");
    says(refusal(|it| drop(it.add_collider(inelastic))), "restitution");
    says(refusal(|it| drop(it.add_sphere(far.with_friction(Friction::sliding(0.5))))), "friction");
    says(refusal(|it| drop(it.add_sphere(far.with_angular_velocity(DVec3::X)))), "turn");
    says(refusal(|it| drop(it.add_collider(trigger))), "triggers");
    says(refusal(|it| drop(it.add_collider(moving))), "move");
    says(refusal(|it| drop(it.add_emitter(Emitter::new(far, 1.0)))), "emitters");
    says(
        refusal(|it| {
            let id = it.add_sphere(far).unwrap();
            drop(it.add_spring(Spring::to_point(id, DVec3::ZERO, 1.0)));
        }),
        "forces",
    );
    let mut world = World::new(cube(2.5)).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_growth_speed(0.1)).unwrap();
    // Four times the radius are in the box for 1.25 s.
    assert!(world.step(1.25).is_ok());
    says(world.step(0.01).unwrap_err().to_string(), "four times");
    for speed in [-0.1, f64::NAN, f64::INFINITY] {
        let refused = world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_growth_speed(speed));
        says(refused.unwrap_err().to_string(), "growth_speed");
        says(world.set_growth_rate(speed).unwrap_err().to_string(), "growth rate");
    }
}
