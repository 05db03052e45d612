//! Sleep: heaps fall asleep, wake where something changes, and keep their places.

use carom::{Contact, DVec3, Emitter, Gravity, Settings, Sphere, World};

use crate::{FRAME, G, add_box, add_wall, poured, run, under_gravity};

#[test]
fn a_heap_at_rest_sleeps_does_not_creep_and_wakes_when_touched() {
    let mut world = poured(200);
    run(&mut world, 480);
    assert_eq!(world.report().contact_account.asleep, 200);
    let before = world.spheres().positions().to_vec();
    let contacts = world.contacts();
    assert!(contacts.len() > 300, "{}", contacts.len());
    // Ten minutes.
    run(&mut world, 36_000);
    assert_eq!(world.spheres().positions(), before);
    assert_eq!(world.contacts(), contacts);
    // A ball comes down on it.
    let ball = Sphere::new(DVec3::new(0.0, 3.0, 0.0), 0.1)
        .with_density(1000.0)
        .with_restitution(0.0)
        .with_friction(0.4);
    world.add_sphere(ball).unwrap();
    let mut fewest = u32::MAX;
    for _ in 0..600 {
        fewest = fewest.min(world.step(FRAME).unwrap().contact_account.asleep);
    }
    assert!(fewest < 200, "nothing woke: {fewest}");
    assert_eq!(world.report().contact_account.asleep, 201);
    let moved = world.spheres().positions().iter().zip(&before).map(|(a, b)| (*a - *b).length());
    let farthest = moved.fold(0.0, f64::max);
    assert!((1e-6..0.2).contains(&farthest), "{farthest}");
}

/// A column of balls in a shaft, at rest, without friction; the lowest is that of an emitter, which takes it away
/// after this time.
fn column(count: u32, radius: f64, restitution: f64, seconds: f64) -> World {
    let mut world = under_gravity();
    add_box(&mut world, radius, 0.0);
    let ball = |height: f64| {
        let place = DVec3::new(0.0, height * radius, 0.0);
        Sphere::new(place, radius).with_restitution(restitution)
    };
    let away = Emitter::new(ball(1.0), seconds).with_max_spheres(1);
    let emitter = world.add_emitter(away).unwrap();
    world.step(FRAME).unwrap();
    for number in 1..count {
        world.add_sphere(ball(f64::from(2 * number + 1))).unwrap();
    }
    // The next one comes far away, and the first one goes.
    world.set_emitter(emitter, away.with_sphere(ball(1e3))).unwrap();
    world
}

#[test]
fn what_bounces_on_a_column_keeps_only_its_top_awake() {
    let (count, radius) = (12, 0.1);
    let mut world = column(count, radius, 1.0, 1e3);
    // It falls for longer than the column takes to fall asleep.
    let place = DVec3::new(0.0, f64::from(2 * count + 80) * radius, 0.0);
    let light = Sphere::new(place, 0.5 * radius).with_mass(0.02).with_restitution(1.0);
    let light = world.add_sphere(light).unwrap();
    run(&mut world, 72);
    let (mut fewest, mut bounces, mut before) = (u32::MAX, 0, -1.0);
    for _ in 0..300 {
        fewest = fewest.min(world.step(FRAME).unwrap().contact_account.asleep);
        let speed = world.sphere(light).unwrap().velocity.y;
        bounces += u32::from(before < -0.5 && speed > 0.1);
        before = speed;
    }
    assert!(bounces > 0, "it lies");
    assert!((count / 2..count).contains(&fewest), "{fewest} sleep");
}

#[test]
fn a_column_falls_as_a_whole_when_its_foot_is_taken_away() {
    let (count, radius) = (12, 0.1);
    // Without restitution: they wake one after the other, so that small gaps open, and close on the ground.
    let mut world = column(count, radius, 0.0, 2.0);
    run(&mut world, 110);
    assert_eq!(world.report().contact_account.asleep, count);
    let before = world.spheres().positions().to_vec();
    // Free fall by a diameter takes 0.2 s; 2 s are over after ten frames.
    run(&mut world, 10 + 24);
    for (now, before) in world.spheres().positions().iter().zip(&before[1..]) {
        let sunk = before.y - now.y;
        // Each of them lies within the slop of 0.001 r on the one below.
        assert!((sunk - 2.0 * radius).abs() < 0.02 * radius, "{sunk}");
    }
}

#[test]
fn sleepers_far_from_an_impact_sleep_on() {
    let mut world = under_gravity();
    add_wall(&mut world, DVec3::Y, DVec3::ZERO, 0.0);
    for number in 0..10 {
        let place = DVec3::new(f64::from(number), 0.1, 0.0);
        world.add_sphere(Sphere::new(place, 0.1)).unwrap();
    }
    run(&mut world, 60);
    assert_eq!(world.report().contact_account.asleep, 10);
    world.add_sphere(Sphere::new(DVec3::new(0.0, 0.5, 0.0), 0.1).with_restitution(0.0)).unwrap();
    let mut fewest = u32::MAX;
    for _ in 0..120 {
        fewest = fewest.min(world.step(FRAME).unwrap().contact_account.asleep);
    }
    // To add a sphere wakes all once; they fall asleep again but for the one that is hit.
    assert_eq!(world.report().contact_account.asleep, 11, "{fewest}");
    // Without gravity they wake.
    let force = world.forces().next().unwrap().0;
    world.remove_force(force).unwrap();
    assert_eq!(world.step(FRAME).unwrap().contact_account.asleep, 0);
}

#[test]
fn a_heap_wakes_when_an_emitter_takes_a_sleeper_out() {
    // The second ball of an emitter makes the first one go, on which another has fallen asleep.
    let mut world = under_gravity();
    add_box(&mut world, 0.1, 0.0);
    let emitted = Sphere::new(DVec3::new(0.0, 0.1, 0.0), 0.1).with_restitution(0.0);
    let away = Emitter::new(emitted, 2.5).with_max_spheres(1);
    let emitter = world.add_emitter(away).unwrap();
    world.step(FRAME).unwrap();
    let upper = Sphere::new(DVec3::new(0.0, 0.3, 0.0), 0.1).with_restitution(0.0);
    let upper = world.add_sphere(upper).unwrap();
    // The next one comes far away.
    let place = DVec3::new(0.0, 50.0, 0.0);
    world.set_emitter(emitter, away.with_sphere(emitted.with_position(place))).unwrap();
    run(&mut world, 120);
    assert_eq!(world.report().contact_account.asleep, 2);
    run(&mut world, 60);
    assert!(world.contacts().iter().all(|it| it.gap < 1e-3), "what holds it is there");
    let height = world.sphere(upper).unwrap().position.y;
    assert!(height < 0.11, "it hangs in the air: {height}");
}

#[test]
fn spheres_can_be_taken_out_while_others_sleep_and_one_comes_near() {
    let mut world = under_gravity();
    add_wall(&mut world, DVec3::Y, DVec3::ZERO, 0.0);
    let ball = Sphere::new(DVec3::new(0.0, 0.1, 0.0), 0.1).with_restitution(0.0);
    for number in 0..30 {
        let place = DVec3::new(0.3 * f64::from(number), 0.1, 0.0);
        world.add_sphere(Sphere::new(place, 0.1).with_restitution(0.0)).unwrap();
    }
    let above = Emitter::new(ball, 3.0).with_position(DVec3::new(0.3 * 28.0, 0.7, 0.0));
    world.add_emitter(above).unwrap();
    run(&mut world, 180);
    // The next one falls.
    for _ in 0..20 {
        run(&mut world, 1);
        let before = world.snapshot();
        let ids = world.spheres().ids().to_vec();
        for id in &ids[..20] {
            world.remove_sphere(*id).unwrap();
        }
        run(&mut world, 2);
        assert_eq!(world.spheres().len(), ids.len() - 20);
        world.restore(&before);
    }
}

#[test]
fn a_ball_that_is_emitted_falls_though_all_others_sleep() {
    let mut world = under_gravity();
    add_wall(&mut world, DVec3::Y, DVec3::ZERO, 0.0);
    let ball = Sphere::new(DVec3::new(0.0, 0.1, 0.0), 0.1).with_restitution(0.0);
    world.add_sphere(ball).unwrap();
    world.add_emitter(Emitter::new(ball, 3.0).with_position(DVec3::new(5.0, 2.0, 0.0))).unwrap();
    run(&mut world, 179);
    assert_eq!(world.report().contact_account.asleep, 2);
    run(&mut world, 16);
    let height = world.spheres().positions()[2].y;
    assert!(height < 2.0, "it hangs where it was emitted: {height}");
}

#[test]
fn without_a_speed_of_sleep_nothing_sleeps() {
    for (sleep_speed, asleep) in [(0.0, 0), (0.02, 1)] {
        let rule = Contact::default().with_sleep_speed(sleep_speed);
        let mut world = World::new(Settings::default().with_rule(rule)).unwrap();
        world.add_force(Gravity::new(DVec3::new(0.0, -G, 0.0))).unwrap();
        add_wall(&mut world, DVec3::Y, DVec3::ZERO, 0.0);
        // So slow that it moves by less than a thousandth of its radius in sqrt(r / g).
        let ball = Sphere::new(0.1 * DVec3::Y, 0.1).with_velocity(9e-4 * DVec3::X);
        let id = world.add_sphere(ball).unwrap();
        for _ in 0..120 {
            world.step(FRAME).unwrap();
        }
        assert_eq!(world.report().contact_account.asleep, asleep);
        let speed = world.sphere(id).unwrap().velocity.x;
        assert_eq!(speed, if asleep == 1 { 0.0 } else { 9e-4 });
    }
    let refused = Contact::default().with_sleep_speed(-1.0);
    let refused = World::new(Settings::default().with_rule(refused)).unwrap_err();
    assert!(refused.to_string().contains("sleep_speed"), "{refused}");
}
