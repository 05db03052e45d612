//! Flights of the rule `exact` on springs and threads: against closed forms, conserved quantities and themselves in
//! other frames.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::PI;

use carom::{
    Boundary, Collider, DQuat, DVec3, Emitter, Gravity, PointAttractor, Pose, QuadraticDrag,
    Settings, Shape, Sphere, SphereId, Spring, World,
};
use common::{G, Numbers, assert_close, exact, run, vec};

const FRAME: f64 = 1.0 / 64.0;

fn elastic(place: DVec3, radius: f64) -> Sphere {
    Sphere::new(place, radius).with_restitution(1.0)
}

/// Two balls of 1 and 3 kg on a spring of 2 m and 6 N/m, let go at a length, at a scale of lengths.
fn pair(length: f64, scale: f64) -> (World, [SphereId; 2]) {
    let mut world = exact();
    let light = elastic(DVec3::ZERO, 0.5 * scale).with_mass(1.0);
    let light = world.add_sphere(light).unwrap();
    let heavy = elastic(vec(length * scale, 0.0, 0.0), 0.5 * scale).with_mass(3.0);
    let heavy = world.add_sphere(heavy).unwrap();
    world.add_spring(Spring::between(light, heavy, 2.0 * scale).with_stiffness(6.0)).unwrap();
    (world, [light, heavy])
}

fn place(world: &World, id: SphereId) -> DVec3 {
    world.sphere(id).unwrap().position
}

#[test]
fn two_balls_on_a_spring_oscillate_by_the_cosine() {
    // w² = k (1/m + 1/M)
    let w = 8.0f64.sqrt();
    for scale in [1e-6, 1.0, 1e6] {
        let (mut world, [light, heavy]) = pair(2.5, scale);
        for _ in 0..10 {
            world.step(0.7).unwrap();
            let length = (place(&world, heavy) - place(&world, light)).x / scale;
            // Rounding of some hundred steps.
            assert_close(length, 2.0 + 0.5 * (w * world.time()).cos(), 1e-12);
        }
    }
}

#[test]
fn balls_on_a_spring_that_meet_elastically_keep_their_energy() {
    // Let go at 3.5 m, they meet at 1 m, and are back at once.
    let w = 8.0f64.sqrt();
    let to_impact = (-1.0f64 / 1.5).acos() / w;
    let (mut world, [light, heavy]) = pair(3.5, 1.0);
    let energy = world.total_energy();
    let mut impacts = 0;
    for _ in 0..40 * 64 {
        impacts += world.step(FRAME).unwrap().impacts.len();
        assert_close(world.total_energy(), energy, 1e-12 * energy);
        let phase = world.time() % (2.0 * to_impact);
        let since_top = phase.min(2.0 * to_impact - phase);
        let length = (place(&world, heavy) - place(&world, light)).x;
        // Each impact adds a rounding of the time to the phase.
        assert_close(length, 2.0 + 1.5 * (w * since_top).cos(), 1e-11);
    }
    assert_eq!(impacts, (40.0 / (2.0 * to_impact) + 0.5) as usize);
}

/// Mass of a ball \[kg\].
const BUNGEE: f64 = 4.0;

/// A ball that falls from the point where its thread is fixed.
fn bungee(damping: f64) -> (World, SphereId) {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    let ball = Sphere::new(DVec3::ZERO, 0.1).with_mass(BUNGEE);
    let ball = world.add_sphere(ball).unwrap();
    let thread = Spring::to_point(ball, DVec3::ZERO, 0.9).with_stiffness(1e4);
    world.add_spring(thread.with_damping(damping).with_only_pulls(true)).unwrap();
    (world, ball)
}

#[test]
fn a_ball_on_a_thread_comes_back_to_where_it_fell_from() {
    let (mut world, ball) = bungee(0.0);
    let energy = world.total_energy();
    // The period: two falls of 0.9 m, and the time in which the thread is taut.
    let (speed, w) = ((2.0 * G * 0.9).sqrt(), (1e4 / BUNGEE).sqrt());
    let taut = 2.0 / w * (PI - (speed * w / G).atan());
    let period = 2.0 * speed / G + taut;
    for period_number in 1..=40 {
        let until = f64::from(period_number) * period;
        while world.time() + FRAME < until {
            world.step(FRAME).unwrap();
        }
        world.step(until - world.time()).unwrap();
        let ball = world.sphere(ball).unwrap();
        // It hardly moves there: v = g dt of rounding, and v² / 2 g.
        assert!(ball.position.y.abs() < 1e-10, "{}", ball.position.y);
        assert_close(world.total_energy(), energy, 1e-11 * BUNGEE * G * 0.9);
    }
}

#[test]
fn a_damped_thread_takes_energy_and_never_pushes() {
    let (mut world, ball) = bungee(2000.0);
    let mut before = world.total_energy();
    for _ in 0..640 {
        world.step(FRAME).unwrap();
        assert!(world.total_energy() <= before + 1e-10, "{}", world.total_energy());
        before = world.total_energy();
    }
    let Sphere { position, velocity, .. } = world.sphere(ball).unwrap();
    assert_close(position.y, -0.9 - BUNGEE * G / 1e4, 1e-9);
    assert!(velocity.length() < 1e-8);
}

#[test]
fn a_chain_of_balls_and_springs_moves_in_its_normal_modes() {
    const COUNT: usize = 7;
    let (mut world, stiffness) = (exact(), 40.0);
    let spacing = 1.0;
    let mut numbers = Numbers(5);
    let mut balls = Vec::new();
    let mut displaced = [0.0; COUNT];
    for (i, displaced) in displaced.iter_mut().enumerate() {
        *displaced = numbers.between(-0.2, 0.2);
        let place = vec((i as f64 + 1.0) * spacing + *displaced, 0.0, 0.0);
        balls.push(world.add_sphere(Sphere::new(place, 0.1).with_mass(1.0)).unwrap());
    }
    let spring = |spring: Spring| spring.with_stiffness(stiffness);
    world.add_spring(spring(Spring::to_point(balls[0], DVec3::ZERO, 0.7))).unwrap();
    for two in balls.windows(2) {
        world.add_spring(spring(Spring::between(two[0], two[1], 0.7))).unwrap();
    }
    let end = vec((COUNT as f64 + 1.0) * spacing, 0.0, 0.0);
    world.add_spring(spring(Spring::to_point(balls[COUNT - 1], end, 0.7))).unwrap();
    let angle = |i: usize, n: usize| (i * n) as f64 * PI / (COUNT as f64 + 1.0);
    for _ in 0..20 {
        world.step(0.5).unwrap();
        for (i, &ball) in balls.iter().enumerate() {
            let mode = |n: usize| {
                let part: f64 = (0..COUNT).map(|j| displaced[j] * angle(j + 1, n).sin()).sum();
                let rate = 2.0 * f64::sqrt(stiffness) * (0.5 * angle(1, n)).sin();
                part * angle(i + 1, n).sin() * (rate * world.time()).cos()
            };
            let modes: f64 = (1..=COUNT).map(mode).sum();
            let expected = (i as f64 + 1.0) * spacing + 2.0 / (COUNT as f64 + 1.0) * modes;
            // Rounding of some thousand steps, which adds to phases.
            assert_close(place(&world, ball).x, expected, 1e-11);
        }
    }
}

/// Where a pendulum on a spring of 1 m swings through its lowest point for the first time \[s\], let go at an angle
/// \[rad\] with a stiffness of `k` times its weight by metre.
fn quarter_period(angle: f64, k: f64) -> f64 {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    // The spring bears the ball from the start.
    let length = 1.0 + angle.cos() / k;
    let start = length * vec(angle.sin(), -angle.cos(), 0.0);
    let ball = world.add_sphere(Sphere::new(start, 0.1).with_mass(1.0)).unwrap();
    world.add_spring(Spring::to_point(ball, DVec3::ZERO, 1.0).with_stiffness(k * G)).unwrap();
    world.step(0.53).unwrap();
    for _ in 0..4 {
        let Sphere { position, velocity, .. } = world.sphere(ball).unwrap();
        let left = position.x / -velocity.x;
        if left.abs() < 1e-3 {
            return world.time() + left;
        }
        world.step(left.max(1e-3)).unwrap();
    }
    panic!("it does not come down");
}

#[test]
fn a_pendulum_on_a_stiff_spring_swings_by_the_elliptic_integral() {
    // What the spring gives way falls with its stiffness: two of them tell that of a rod.
    let [soft, stiff] = [1e5, 2e5].map(|k| quarter_period(1.0, k));
    let rod = 2.0 * stiff - soft;
    // K(sin(a/2)) by the arithmetic-geometric mean.
    let (mut a, mut b) = (1.0f64, 0.5f64.cos());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let expected = (1.0 / G).sqrt() * 0.5 * PI / a;
    // Of the second order in 1e-5.
    assert_close(rod, expected, 1e-10);
}

/// Balls of 0.1 m on pairs of threads of 1 m from hooks at these places, the first of them swung out.
fn on_threads(hooks: &[f64], scale: f64) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G * scale, 0.0))).unwrap();
    for (number, &x) in hooks.iter().enumerate() {
        let (across, down) = if number == 0 { (-0.55, -0.78) } else { (0.0, -0.954) };
        let place = scale * vec(0.2 * number as f64 + across, down, 0.0);
        let ball = world.add_sphere(elastic(place, 0.1 * scale).with_mass(1.0)).unwrap();
        for side in [-0.3, 0.3] {
            let thread = Spring::to_point(ball, scale * vec(x, 0.0, side), scale);
            let thread = thread.with_stiffness(2e4).with_only_pulls(true);
            world.add_spring(thread).unwrap();
        }
    }
    world
}

#[test]
fn balls_of_a_cradle_that_touch_keep_their_energy() {
    let mut world = on_threads(&[0.0, 0.2, 0.4, 0.6, 0.8], 1.0);
    let start = world.total_energy();
    let (mut largest, mut impacts) = (0.0f64, 0);
    for _ in 0..10 * 64 {
        impacts += world.step(FRAME).unwrap().impacts.len();
        largest = largest.max((world.total_energy() - start).abs());
    }
    // Rounding of some thousand steps at 45 J; contacts swallow bounces below 1e-13 m.
    assert!(largest < 1e-11, "{largest}");
    assert!(impacts > 40, "{impacts}");
}

#[test]
fn a_ball_on_a_spring_and_a_free_one_on_it_swing_as_one() {
    // Two balls of 1 kg on 100 N/m, which press on each other all the time: half of it would have to pull beyond g.
    let (stiffness, amplitude) = (100.0, 0.05);
    for scale in [1e-6, 1.0, 1e6] {
        let mut world = exact();
        world.add_force(Gravity::new(vec(0.0, -G * scale, 0.0))).unwrap();
        let start = -2.0 * G / stiffness - amplitude;
        let lower = world.add_sphere(elastic(vec(0.0, start, 0.0) * scale, 0.1 * scale)).unwrap();
        let place = vec(0.0, start + 0.2, 0.0) * scale;
        let upper = world.add_sphere(elastic(place, 0.1 * scale).with_restitution(0.0)).unwrap();
        let spring = Spring::to_point(lower, vec(0.0, -1.0, 0.0) * scale, scale);
        world.add_spring(spring.with_stiffness(stiffness)).unwrap();
        let rate = (stiffness / 2.0).sqrt();
        for frame in 1..=300 {
            world.step(1.0 / 60.0).unwrap();
            let fallen = amplitude * (rate * f64::from(frame) / 60.0).cos();
            let height = 0.2 - 2.0 * G / stiffness - fallen;
            let is = world.sphere(upper).unwrap().position.y / scale;
            // Rounding of some hundred steps.
            assert_close(is, height, 1e-13);
        }
    }
}

/// Two balls on springs of 1 m to one hook, which press them together.
fn pressed(scale: f64) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G * scale, 0.0))).unwrap();
    let (sin, cos) = 0.4f64.sin_cos();
    for side in [-1.0, 1.0] {
        let down = (1.0f64 - 0.01).sqrt();
        let place = vec(-down * sin + side * 0.1 * cos, -down * cos - side * 0.1 * sin, 0.0);
        let ball = Sphere::new(place * scale, 0.1 * scale).with_mass(1.0).with_restitution(0.0);
        let ball = world.add_sphere(ball).unwrap();
        let spring = Spring::to_point(ball, DVec3::ZERO, scale).with_stiffness(500.0);
        world.add_spring(spring).unwrap();
    }
    world
}

#[test]
fn balls_that_springs_press_together_swing_as_one_at_any_size() {
    let mut ends = Vec::new();
    for scale in [1e-6, 1.0, 1e6] {
        let mut world = pressed(scale);
        // Rounding of the places at the start may leave a gap, or an overlap, for a moment.
        world.step(FRAME).unwrap();
        let start = world.total_energy();
        for _ in 0..4 * 64 {
            world.step(FRAME).unwrap();
            // Their energy is some 20 J times the square of the size.
            assert_close(world.total_energy() / scale / scale, start / scale / scale, 1e-11);
            let [first, second] = [0, 1].map(|it| world.spheres().positions()[it] / scale);
            assert_close((second - first).length(), 0.2, 1e-12);
        }
        ends.push(world.spheres().positions()[0] / scale);
    }
    // Rounding of some hundred steps.
    assert!((ends[0] - ends[1]).length() < 1e-10 && (ends[2] - ends[1]).length() < 1e-10);
}

#[test]
fn balls_pressed_together_have_the_same_bits_in_other_frames() {
    let hash = |frames: u32| {
        let mut world = pressed(1.0);
        run(&mut world, 3.0, 1.0 / f64::from(frames));
        world.state_hash()
    };
    assert_eq!(hash(32), hash(64));
    assert_eq!(hash(32), hash(256));
}

/// Balls in a box on springs and threads, with other forces.
fn net(numbers: &mut Numbers) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -3.0, 0.0))).unwrap();
    let wall = |normal: DVec3| {
        let rotation = DQuat::from_rotation_arc(DVec3::Y, normal);
        let pose = Pose::at(-2.0 * normal).rotated(rotation);
        Collider::new(Shape::HalfSpace, pose).with_restitution(1.0)
    };
    for normal in [DVec3::X, -DVec3::X, DVec3::Y, -DVec3::Y, DVec3::Z, -DVec3::Z] {
        world.add_collider(wall(normal)).unwrap();
    }
    let mut balls = Vec::new();
    for i in 0..12 {
        let place =
            vec(f64::from(i % 3) - 1.0, f64::from(i / 3) - 1.5, 0.0) + 0.2 * numbers.vector();
        let ball = elastic(place, 0.1)
            .with_velocity(numbers.vector())
            .with_mass(numbers.between(0.5, 2.0));
        balls.push(world.add_sphere(ball).unwrap());
    }
    for i in 0..9 {
        let spring = Spring::between(balls[i], balls[i + 1 + i % 3], numbers.between(0.3, 1.0));
        let spring = spring.with_stiffness(numbers.between(10.0, 500.0));
        world.add_spring(spring.with_only_pulls(i % 2 == 0)).unwrap();
    }
    let thread = Spring::to_point(balls[0], DVec3::Y, 0.5).with_stiffness(1e3);
    world.add_spring(thread.with_only_pulls(true)).unwrap();
    world
}

#[test]
fn nets_of_springs_and_threads_in_boxes_keep_their_energy() {
    for seed in 1..=3 {
        let mut world = net(&mut Numbers(seed));
        let energy = world.total_energy();
        let scale = energy.abs().max(world.kinetic_energy());
        let impacts = run(&mut world, 3.0, FRAME);
        assert!(impacts > 20, "{impacts}");
        // Rounding of some thousand steps and some hundred impacts.
        assert_close(world.total_energy(), energy, 1e-12 * scale);
    }
}

#[test]
fn frames_do_not_change_a_bit() {
    let state_of = |frame: f64| {
        let mut world = net(&mut Numbers(3));
        run(&mut world, 2.0, frame);
        world.state_hash()
    };
    let expected = state_of(FRAME);
    for frame in [1.0 / 32.0, 1.0 / 256.0, 0.25] {
        assert_eq!(state_of(frame), expected, "{frame}");
    }
}

/// A rope of threads from a point to a ball on a rough floor, with balls that emitters let fall onto it.
fn rope_to_the_floor(stiffness: f64) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(QuadraticDrag::new(1.2)).unwrap();
    world.add_force(PointAttractor::new(vec(0.0, 0.0, 3.0), 0.1)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.5);
    world.add_collider(floor).unwrap();
    let ball = |x: f64, y: f64| Sphere::new(vec(x, y, 0.0), 0.1).with_mass(0.2);
    let balls: Vec<SphereId> =
        (0..6).map(|i| world.add_sphere(ball(0.25 * f64::from(i), 0.15)).unwrap()).collect();
    let thread = |spring: Spring| spring.with_stiffness(stiffness).with_only_pulls(true);
    world.add_spring(thread(Spring::to_point(balls[0], vec(0.0, 1.5, 0.0), 1.2))).unwrap();
    for two in balls.windows(2) {
        let spring = Spring::between(two[0], two[1], 0.26).with_damping(0.5);
        world.add_spring(thread(spring)).unwrap();
    }
    let emitter = Emitter::new(ball(0.0, 0.0), 0.3).with_position(vec(0.6, 2.0, 0.01));
    world.add_emitter(emitter.with_max_spheres(4)).unwrap();
    world
}

#[test]
fn ropes_rest_on_floors_beside_emitters_in_frames_of_any_length() {
    let state_of = |frame: f64| {
        let mut world = rope_to_the_floor(300.0);
        run(&mut world, 2.0, frame);
        let lowest = world.spheres().positions().iter().map(|it| it.y).fold(1.0, f64::min);
        assert!(lowest > 0.1 - 1e-9, "{lowest}");
        world.state_hash()
    };
    let expected = state_of(FRAME);
    for frame in [1.0 / 32.0, 1.0 / 256.0] {
        assert_eq!(state_of(frame), expected, "{frame}");
    }
}

#[test]
fn a_spring_longer_than_half_a_periodic_box_does_not_hang() {
    let periodic =
        Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(4.0) });
    let mut world = World::new(periodic).unwrap();
    let [one, other] = [-0.9, 0.9].map(|x| {
        let ball = Sphere::new(vec(x, 0.1 * x, 0.0), 0.1).with_mass(0.05);
        world.add_sphere(ball).unwrap()
    });
    // Whichever image is the nearest one, it is pushed away, to where the other is nearer.
    world.add_spring(Spring::between(one, other, 3.0).with_stiffness(40.0)).unwrap();
    run(&mut world, 0.25, FRAME);
    let offset = place(&world, other) - place(&world, one);
    assert!((offset.x.abs() - 2.0).abs() < 0.1, "{offset}");
}

/// Balls of 1 kg joined by threads of exactly their distances, in free fall; a chain, or a ring.
fn in_free_fall(damping: f64, is_ring: bool, scale: f64) -> World {
    let mut world = exact();
    world.add_force(Gravity::new(scale * vec(1.1, -G, 0.7))).unwrap();
    let place = |i: usize| match is_ring {
        true => {
            let angle = 2.0 * PI * i as f64 / 8.0;
            vec(angle.cos(), angle.sin(), 0.3 * angle.cos())
        }
        false => i as f64 * vec(0.3, 0.7, -0.2),
    };
    let ball = |i: usize| {
        let ball = Sphere::new(scale * place(i), 0.1 * scale).with_mass(1.0);
        ball.with_velocity(scale * vec(0.3, 2.0, 0.1))
    };
    let balls: Vec<SphereId> = (0..8).map(|i| world.add_sphere(ball(i)).unwrap()).collect();
    let last = [balls[7], balls[0]];
    for two in balls.windows(2).chain(is_ring.then_some(&last[..])) {
        let length = self::place(&world, two[0]).distance(self::place(&world, two[1]));
        let thread = Spring::between(two[0], two[1], length).with_stiffness(1e6);
        world.add_spring(thread.with_damping(damping).with_only_pulls(true)).unwrap();
    }
    world
}

#[test]
fn threads_at_exactly_their_length_in_free_fall_take_the_steps_of_no_threads() {
    for (damping, is_ring) in [(0.0, false), (0.0, true), (20.0, false), (20.0, true)] {
        for scale in [1e-6, 1.0, 1e6] {
            let mut world = in_free_fall(damping, is_ring, scale);
            let events: u64 = (0..128).map(|_| world.step(FRAME).unwrap().work.events).sum();
            // Steps of 16 radii, and as many neighbour regions: some tens in 2 s. Changes at each rounding make 10⁵.
            assert!(events < 1000, "{damping} {is_ring} {scale}: {events}");
        }
    }
}
