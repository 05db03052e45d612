//! Balls that touch on planes and push each other while they slide or roll, under the rule `exact` with
//! friction: they stay in contact instead of chattering, as closed forms say where there are some.

mod common;

use carom::{
    Collider, CombineRule, DVec3, Friction, Gravity, Pose, Settings, Shape, Sphere, SphereId, World,
};
use common::{G, Numbers, assert_close, vec};

const RADIUS: f64 = 0.03;

/// A level floor at y = 0 under any gravity: an incline, seen from one that is tilted with it.
fn on_floor_under(gravity: DVec3, friction: impl Into<Friction>, restitution: f64) -> World {
    // Of a ball with a coefficient of 1 the plane's counts.
    let settings = Settings::default().with_friction_combine_rule(CombineRule::Product);
    let mut world = World::new(settings).unwrap();
    world.add_force(Gravity::new(gravity)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO));
    world.add_collider(floor.with_restitution(restitution).with_friction(friction)).unwrap();
    world
}

/// Kinetic energy with that of rotation, and potential energy \[J\].
fn energy_of(world: &World) -> f64 {
    world.kinetic_energy() + world.potential_energy()
}

/// The deepest overlap of two balls, in radii.
fn deepest(world: &World, radius: f64) -> f64 {
    let depths = world.overlaps(0.0).into_iter().map(|overlap| overlap.depth / radius);
    depths.fold(0.0, f64::max)
}

/// A ball catches one before it that turns like this \[rad/s\], at a size; the second is aside by `offset` radii.
fn catching(size: f64, friction: f64, offset: f64, turning: f64) -> World {
    let rolling = Friction::sliding(0.2).with_rolling(0.01);
    let mut world = on_floor_under(vec(0.0, -9.81 * size, 0.0), rolling, 0.5);
    world.set_settings(Settings::default()).unwrap();
    let radius = 0.028575 * size;
    let ball = |x: f64, z: f64, speed: f64| {
        Sphere::new(vec(x * size, radius, z * size), radius)
            .with_mass(0.17)
            .with_restitution(if turning == 0.0 { 0.95 } else { 0.5 })
            .with_velocity(vec(speed * size, 0.0, 0.0))
            .with_friction(Friction::sliding(friction).with_rolling(0.01))
    };
    world.add_sphere(ball(0.0, 0.0, 1.0)).unwrap();
    let before = ball(2.0 * 0.028575 + 1e-4, offset * 0.028575, 0.99);
    world.add_sphere(before.with_angular_velocity(turning * DVec3::Z)).unwrap();
    world
}

#[test]
fn a_ball_that_catches_another_one_does_not_chatter() {
    let cases = [0.0, 0.05, 0.2].map(|friction| [0.0, 0.01].map(|offset| (friction, offset)));
    // With backspin the one before is slower all the time, and presses on.
    let cases = cases.into_iter().flatten().flat_map(|it| [0.0, 40.0].map(|spin| (it, spin)));
    for ((friction, offset), turning) in cases {
        let case = format!("friction {friction}, offset {offset}, spin {turning}");
        let run = |size: f64, rate: u32| {
            let mut world = catching(size, friction, offset, turning);
            let (mut impacts, mut pressed) = (0, false);
            for _ in 0..3 * rate / 2 {
                impacts += world.step(1.0 / f64::from(rate)).unwrap().impacts.len();
                pressed |= world.contacts().len() == 3;
                let overlap = deepest(&world, 0.028575 * size);
                assert!(overlap <= 1e-9, "overlap {overlap} at {} s, {case}", world.time());
            }
            assert!(impacts < 100, "{impacts} impacts, {case}, size {size}");
            assert_eq!(pressed, turning != 0.0 && friction > 0.0, "{case}, size {size}");
            assert!(!world.was_stepped(), "{case}, size {size}");
            world.state_hash()
        };
        // Frames that add up to the same times.
        for size in [1.0, 1e-6, 1e6] {
            assert_eq!(run(size, 256), run(size, 16), "size {size}, {case}");
        }
    }
}

/// Two balls in a row down an incline: masses, inertia factors and sliding friction of the rear and the front
/// one.
struct Row {
    masses: [f64; 2],
    inertia_factors: [f64; 2],
    frictions: [f64; 2],
    plane: Friction,
}

impl Row {
    /// The balls at rest in contact, on a plane that draws them along x \[m/s²\].
    fn world(&self, pull: f64) -> (World, [SphereId; 2]) {
        let mut world = on_floor_under(vec(pull, -G, 0.0), self.plane, 0.0);
        let mut add = |number: usize, x: f64| {
            let friction = Friction::sliding(self.frictions[number]).with_rolling(1.0);
            let ball = Sphere::new(vec(x, RADIUS, 0.0), RADIUS)
                .with_mass(self.masses[number])
                .with_inertia_factor(self.inertia_factors[number])
                .with_restitution(0.0)
                .with_friction(friction);
            world.add_sphere(ball).unwrap()
        };
        let ids = [add(0, 0.0), add(1, 2.0 * RADIUS)];
        (world, ids)
    }
}

#[test]
fn a_ball_that_rolls_faster_pushes_the_one_before_it_down_an_incline() {
    // Friction μ N between them presses the front one on and lifts the rear one, and slows both:
    // (1 + κ) m a = m p ± N − μ N − μ_r (m g ± μ N), with the upper signs for the front ball.
    for (rolling, pair_friction) in [(0.0, 0.0), (0.0, 0.25), (0.02, 0.25), (0.02, 0.5)] {
        let own = f64::sqrt(pair_friction);
        let row = Row {
            masses: [1.3, 0.7],
            inertia_factors: [0.4, 2.0 / 3.0],
            frictions: [own, own],
            plane: Friction::sliding(4.0).with_rolling(rolling),
        };
        // Without friction of the balls the plane has none either: products.
        let rolls = f64::from(u8::from(own > 0.0));
        let pull = 2.0;
        let (mut world, ids) = row.world(pull);
        let [rear, front] = [0, 1].map(|i| (1.0 + rolls * row.inertia_factors[i]) * row.masses[i]);
        let [m1, m2] = row.masses;
        let (mu, mu_r) = (pair_friction, rolls * rolling);
        // a = (p1 − N c1)/rear = (p2 + N c2)/front
        let [p1, p2] = [m1, m2].map(|m| m * (pull - mu_r * G));
        let [c1, c2] = [1.0 + mu - mu_r * mu, 1.0 - mu - mu_r * mu];
        let normal = (p1 / rear - p2 / front) / (c1 / rear + c2 / front);
        let acceleration = if normal > 0.0 { (p2 + normal * c2) / front } else { pull };
        let time = 0.8;
        world.step(time).unwrap();
        let balls = ids.map(|id| world.sphere(id).unwrap());
        let case = format!("rolling friction {rolling}, friction {pair_friction}");
        for (ball, start) in balls.iter().zip([0.0, 2.0 * RADIUS]) {
            assert!(
                (ball.velocity.x / (acceleration * time) - 1.0).abs() < 1e-9,
                "{case}: {ball:?}"
            );
            assert_close(ball.position.x - start, 0.5 * acceleration * time * time, 1e-9);
        }
        assert!(!world.was_stepped());
        if normal > 0.0 {
            let contacts = world.contacts();
            assert_eq!(contacts.len(), 3, "{case}");
            assert_close(contacts[0].normal_force, normal, 1e-9);
            assert_close(contacts[0].tangential_force.y, -mu * normal, 1e-9);
            assert_close(contacts[1].normal_force, m1 * G - mu * normal, 1e-9);
            assert_close(contacts[2].normal_force, m2 * G + mu * normal, 1e-9);
        }
    }
}

#[test]
fn a_ball_that_slides_faster_pushes_the_one_before_it_down_an_incline() {
    // m a = m p ± N − μ (m g ± μ_b N), the upper signs for the front ball, on which the plane has more friction.
    let row = Row {
        masses: [1.0, 1.0],
        inertia_factors: [0.4, 0.4],
        frictions: [0.3, 0.6],
        plane: Friction::sliding(0.5),
    };
    let (pull, time) = (14.0, 0.5);
    let (mut world, ids) = row.world(pull);
    let [mu1, mu2, mu] = [0.15, 0.3, 0.18];
    let normal = (mu2 - mu1) * G / (2.0 - mu * (mu1 + mu2));
    let acceleration = pull + normal - mu2 * (G + mu * normal);
    world.step(time).unwrap();
    for id in ids {
        let ball = world.sphere(id).unwrap();
        assert!((ball.velocity.x / (acceleration * time) - 1.0).abs() < 1e-9, "{ball:?}");
    }
    assert!(!world.was_stepped());
}

#[test]
fn balls_that_push_each_other_lose_energy_and_keep_momentum_but_for_what_the_plane_does() {
    let mut numbers = Numbers(5);
    for case in 0..40 {
        let plane = Friction::sliding(numbers.between(0.1, 0.5)).with_rolling(0.01);
        let mut world = on_floor_under(vec(0.0, -G, 0.0), plane, 0.0);
        let mut masses = Vec::new();
        let count = 2 + case % 4;
        for i in 0..count {
            // Each is faster than the one before it, so that they press on.
            let speed = 1.0 - 0.3 * f64::from(i);
            let place = vec(2.0 * RADIUS * f64::from(i), RADIUS, 0.0);
            let mass = numbers.between(0.5, 2.0);
            masses.push(mass);
            let ball = Sphere::new(place, RADIUS)
                .with_mass(mass)
                .with_restitution(0.0)
                .with_velocity(vec(speed, 0.0, 0.05 * numbers.next()))
                .with_angular_velocity(20.0 * numbers.vector())
                .with_friction(Friction::sliding(numbers.between(0.1, 1.0)).with_rolling(1.0));
            world.add_sphere(ball).unwrap();
        }
        world.step(1e-6).unwrap();
        let (mut last, mut events) = (energy_of(&world), 0);
        for _ in 0..200 {
            events += world.step(1e-3).unwrap().work.events;
            let energy = energy_of(&world);
            assert!(energy <= last * (1.0 + 1e-7), "case {case}: {last} to {energy}");
            last = energy;
            let overlap = deepest(&world, RADIUS);
            assert!(overlap <= 1e-9, "case {case}: overlap {overlap} at {} s", world.time());
        }
        assert!(!world.was_stepped(), "case {case}");
        assert!(events < 10_000, "case {case}: {events} events");
    }
}

#[test]
fn forces_between_balls_and_planes_change_momentum_as_they_say() {
    let plane = Friction::sliding(0.5).with_rolling(0.01);
    let mut world = on_floor_under(vec(0.0, -G, 0.0), plane, 0.0);
    for (x, friction, velocity) in
        [(0.0, 0.2, vec(1.0, 0.0, 0.02)), (2.0 * RADIUS, 0.8, vec(0.2, 0.0, 0.0))]
    {
        let ball = Sphere::new(vec(x, RADIUS, 0.0), RADIUS).with_restitution(0.0);
        let friction = Friction::sliding(friction).with_rolling(1.0);
        world.add_sphere(ball.with_velocity(velocity).with_friction(friction)).unwrap();
    }
    world.step(1e-3).unwrap();
    let h = 1e-5;
    let pressing =
        |world: &World| world.contacts().iter().filter(|it| it.normal_force > 0.0).count();
    assert_eq!(pressing(&world), 3);
    for _ in 0..20 {
        let (momentum, contacts) = (world.momentum(), world.contacts());
        let masses: f64 = world.spheres().masses().iter().sum();
        world.step(h).unwrap();
        let force: DVec3 = contacts[1..]
            .iter()
            .map(|contact| contact.normal_force * contact.normal + contact.tangential_force)
            .sum();
        let expected = momentum + h * (force - masses * G * DVec3::Y);
        assert!((world.momentum() - expected).length() <= 1e-9, "{expected}");
    }
}

#[test]
fn a_wall_holds_a_ball_that_spins_towards_it_until_its_spin_ends() {
    // P = m g − μ_w N and N = μ P: friction of the wall bears a part of the weight. Both take spin.
    let (mu, wall_friction, spin) = (0.3, 0.5, 40.0);
    let mut world = on_floor_under(vec(0.0, -G, 0.0), mu, 0.0);
    let wall = Collider::new(
        Shape::Box { size: vec(0.1, 1.0, 1.0) },
        Pose::at(vec(0.05 + RADIUS, 0.5, 0.0)),
    );
    world.add_collider(wall.with_restitution(0.0).with_friction(wall_friction)).unwrap();
    let ball = Sphere::new(vec(0.0, RADIUS, 0.0), RADIUS).with_restitution(0.0);
    let ball = ball.with_friction(1.0).with_angular_velocity(vec(0.0, 0.0, -spin));
    let id = world.add_sphere(ball).unwrap();
    let pressing = G / (1.0 + mu * wall_friction);
    let ends = 0.4 * RADIUS * spin / (mu * pressing * (1.0 + wall_friction));
    world.step(0.5 * ends).unwrap();
    assert_close(world.sphere(id).unwrap().angular_velocity.z, -0.5 * spin, 1e-9);
    let contacts = world.contacts();
    assert_close(contacts[0].normal_force, pressing, 1e-9);
    assert_close(contacts[1].normal_force, mu * pressing, 1e-9);
    assert_close(contacts[1].tangential_force.y, wall_friction * mu * pressing, 1e-9);
    world.step(ends).unwrap();
    let after = world.sphere(id).unwrap();
    assert_eq!((after.velocity, after.angular_velocity), (DVec3::ZERO, DVec3::ZERO));
    assert_close((after.position - ball.position).length(), 0.0, 1e-12);
    assert!(!world.was_stepped());
}

/// A cue ball before a rack of fifteen balls with small gaps, on a table with cushions.
fn table(friction: f64) -> World {
    let radius = 0.028575;
    let mut world = World::new(Settings::default()).unwrap();
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let cloth = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    let rolling = |sliding: f64| Friction::sliding(sliding).with_rolling(0.01);
    world.add_collider(cloth.with_friction(rolling(0.2))).unwrap();
    for (size, at) in
        [(vec(0.1, 0.4, 1.4), vec(1.32, 0.2, 0.0)), (vec(2.8, 0.4, 0.1), vec(0.0, 0.2, 0.685))]
    {
        for side in [-1.0, 1.0] {
            let cushion =
                Collider::new(Shape::Box { size }, Pose::at(vec(side * at.x, at.y, side * at.z)));
            world.add_collider(cushion.with_restitution(0.8).with_friction(0.1)).unwrap();
        }
    }
    let ball = |x: f64, z: f64| {
        let ball = Sphere::new(vec(x, radius, z), radius).with_mass(0.17).with_restitution(0.95);
        ball.with_friction(rolling(friction))
    };
    let angle: f64 = 0.01;
    let cue = ball(-0.635, 0.0).with_velocity(3.0 * vec(libm::cos(angle), 0.0, libm::sin(angle)));
    world.add_sphere(cue.with_friction(rolling(0.2))).unwrap();
    for (row, place) in (0..5).flat_map(|row| (0..=row).map(move |place| (row, place))) {
        let side = f64::from(place) - 0.5 * f64::from(row);
        let x = 0.6 + f64::from(row) * 2.0 * radius * 0.8660254 * 1.0005;
        world.add_sphere(ball(x, side * 2.0 * radius * 1.0005)).unwrap();
    }
    world
}

#[test]
fn a_break_takes_some_hundred_impacts_and_no_zone() {
    for friction in [0.05, 0.3] {
        let mut world = table(friction);
        let (mut impacts, mut events) = (0, 0);
        for _ in 0..200 {
            let report = world.step(0.05).unwrap();
            impacts += report.impacts.len();
            events += report.work.events;
        }
        assert!(impacts < 1000, "{impacts} impacts, friction {friction}");
        assert!(events < 20_000, "{events} events, friction {friction}");
        assert!(!world.was_stepped(), "friction {friction}");
    }
}
