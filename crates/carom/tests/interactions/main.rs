//! Forces between spheres: springs, threads and gravity, under every rule, against closed forms, and against
//! sums over all pairs. Says nothing about scene files.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

#[path = "../common/mod.rs"]
mod common;
mod gravity;

use std::f64::consts::{PI, TAU};

use carom::{
    Bisect, Boundary, Collider, Contact, DVec3, Discrete, Emitter, Exact, Gravity, Integrator,
    MutualGravity, Pose, Rule, Settings, Shape, Sphere, SphereId, Spring, World,
};
use common::{G, assert_close, vec, world, world_with};

const DISCRETE: [(Integrator, f64); 4] = [
    (Integrator::SemiImplicitEuler, 1.0),
    (Integrator::ExplicitEuler, 1.0),
    (Integrator::VelocityVerlet, 2.0),
    (Integrator::RungeKutta4, 4.0),
];

/// Every rule, with the order in which it follows smooth forces.
fn rules() -> Vec<(Rule, f64)> {
    let discrete =
        DISCRETE.map(|(it, order)| (Discrete::default().with_integrator(it).into(), order));
    let bisect = DISCRETE.map(|(it, order)| (Bisect::default().with_integrator(it).into(), order));
    let others = [(Rule::Exact(Exact::default()), 2.0), (Rule::Contact(Contact::default()), 1.0)];
    discrete.into_iter().chain(bisect).chain(others).collect()
}

/// The rule with frames of `h` \[s\], which `exact` has for force ticks, so that every rule has its error.
fn in_frames(rule: Rule, h: f64) -> Rule {
    match rule {
        Rule::Exact(parameters) => parameters.with_force_tick(h).into(),
        others => others,
    }
}

fn run(world: &mut World, duration: f64, frames: u32) {
    for _ in 0..frames {
        world.step(duration / f64::from(frames)).unwrap();
    }
}

fn position(world: &World, id: SphereId) -> DVec3 {
    world.sphere(id).unwrap().position
}

/// Two spheres of 1 and 3 kg on a spring, which are let go at a length of 3 m.
fn pair_on_spring(rule: Rule, damping: f64) -> (World, [SphereId; 2]) {
    let mut world = world(rule);
    let light = world.add_sphere(Sphere::new(vec(0.0, 0.0, 0.0), 0.1)).unwrap();
    let heavy = world.add_sphere(Sphere::new(vec(3.0, 0.0, 0.0), 0.1).with_mass(3.0)).unwrap();
    let spring = Spring::between(light, heavy, 2.0).with_stiffness(6.0).with_damping(damping);
    world.add_spring(spring).unwrap();
    (world, [light, heavy])
}

#[test]
fn two_spheres_on_a_damped_spring_oscillate_with_their_reduced_mass() {
    // m = 3/4 kg: w² = k/m, b = c / (2 m); x(t) = e^(-b t) (cos w' t + b/w' sin w' t).
    let (mass, duration): (f64, f64) = (0.75, 2.0);
    for (rule, order) in rules() {
        for damping in [0.0, 0.9] {
            let b = damping / (2.0 * mass);
            let w = (6.0 / mass - b * b).sqrt();
            let phase = w * duration;
            let stretch = (-b * duration).exp() * (phase.cos() + b / w * phase.sin());
            let error = |frames| {
                let rule = in_frames(rule, duration / f64::from(frames));
                let (mut world, [light, heavy]) = pair_on_spring(rule, damping);
                run(&mut world, duration, frames);
                // The centre of mass rests.
                assert!(world.momentum().length() < 1e-13, "{rule:?}");
                let length = position(&world, heavy).x - position(&world, light).x;
                (length - 2.0 - stretch).abs()
            };
            if matches!(rule, Rule::Exact(_)) {
                // Rounding of some tens of steps of 15th order.
                assert!(error(4) < 1e-13);
                continue;
            }
            let (coarse, fine) = (error(512), error(1024));
            assert!(fine < 0.1, "{rule:?}: {fine}");
            let measured = (coarse / fine).log2();
            // The next term of the series at these steps; without damping some orders come out higher.
            assert!(measured > order - 0.2, "{rule:?}, damping {damping}: {measured}");
        }
    }
}

#[test]
fn the_energy_of_a_pair_on_a_spring_is_kinetic_and_half_k_stretch_squared() {
    for (rule, order) in rules().into_iter().filter(|(_, order)| *order >= 2.0) {
        let (mut world, _) = pair_on_spring(rule, 0.0);
        assert_close(world.total_energy(), 3.0, 1e-15);
        let mut largest: f64 = 0.0;
        for _ in 0..2000 {
            world.step(0.01).unwrap();
            largest = largest.max((world.total_energy() - 3.0).abs());
        }
        // Leapfrog schemes keep an energy whose elastic (or kinetic) part has the factor 1 - (w h)² / 4, so
        // that the true one swings by that, here 2e-4, of it, and the next order; Runge-Kutta loses
        // (w h)^6 / 72 = 7e-12 of it per step, and swings by (w h)^4.
        let bound = if order == 2.0 { 3.0 * 2e-4 * 1.001 } else { 3.0 * 6.4e-7 };
        assert!(largest < bound, "{rule:?}: {largest}");
    }
}

#[test]
fn a_thread_pulls_and_never_pushes() {
    // Explicit Euler gains energy by an oscillation, which is no matter of threads.
    let is_stable = |rule: &Rule| match rule {
        Rule::Discrete(it) => it.integrator != Integrator::ExplicitEuler,
        Rule::Bisect(it) => it.integrator != Integrator::ExplicitEuler,
        _ => true,
    };
    for (rule, _) in rules().into_iter().filter(|(rule, _)| is_stable(rule)) {
        let mut world = world(rule);
        let ball = Sphere::new(vec(0.5, 0.0, 0.0), 0.1).with_velocity(vec(-1.0, 0.0, 0.0));
        let ball = world.add_sphere(ball).unwrap();
        let thread = Spring::to_point(ball, DVec3::ZERO, 1.0)
            .with_stiffness(1e4)
            .with_damping(1.0)
            .with_only_pulls(true);
        world.add_spring(thread).unwrap();
        // Slack until it is 1 m to the other side, after 1.5 s.
        run(&mut world, 1.4, 140);
        // A rounding in each of 140 frames.
        assert_close(position(&world, ball).x, -0.9, 4e-14);
        assert_eq!(world.potential_energy(), 0.0);
        run(&mut world, 0.4, 800);
        let speed = world.sphere(ball).unwrap().velocity.x;
        // Half an oscillation damped by c / (2 sqrt(k m)) = 0.005; w h / 2 = 0.025 is the error of the first
        // order.
        assert_close(speed, (-PI * 0.005).exp(), 0.035);
        assert_eq!(world.potential_energy(), 0.0);
    }
}

#[test]
fn a_spring_of_no_length_pulls_nowhere() {
    for (rule, _) in rules() {
        let mut world = world(rule);
        let ball = world.add_sphere(Sphere::new(DVec3::ONE, 0.1)).unwrap();
        let spring = Spring::to_point(ball, DVec3::ONE, 1.0).with_damping(1.0);
        world.add_spring(spring).unwrap();
        world.step(0.1).unwrap();
        assert_eq!(position(&world, ball), DVec3::ONE);
    }
}

#[test]
fn springs_go_with_their_spheres() {
    let mut world = world(Exact::default());
    let balls =
        [0.0, 1.0, 2.0].map(|x| world.add_sphere(Sphere::new(vec(x, 0.0, 0.0), 0.1)).unwrap());
    let first = world.add_spring(Spring::between(balls[0], balls[1], 0.5)).unwrap();
    let second = world.add_spring(Spring::between(balls[1], balls[2], 0.5)).unwrap();
    let third = world.add_spring(Spring::to_point(balls[2], DVec3::Y, 0.5)).unwrap();
    world.step(0.01).unwrap();
    let snapshot = world.snapshot();
    world.remove_sphere(balls[0]).unwrap();
    assert!(world.spring(first).is_err());
    assert_eq!(world.springs().map(|(id, _)| id).collect::<Vec<_>>(), [second, third]);
    world.step(0.01).unwrap();
    world.restore(&snapshot);
    assert_eq!(world.springs().len(), 3);
    world.remove_spheres(&balls[1..]).unwrap();
    assert_eq!(world.springs().len(), 0);
    world.step(0.01).unwrap();
}

#[test]
fn springs_go_with_spheres_that_emitters_retire() {
    for (rule, _) in rules() {
        let mut world = world(rule);
        let sphere = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(4.0, 0.0, 0.0));
        let emitter = Emitter::new(sphere, 0.1).with_max_spheres(2);
        world.add_emitter(emitter).unwrap();
        world.step(0.05).unwrap();
        let emitted = world.spheres().ids()[0];
        let spring = Spring::to_point(emitted, vec(0.0, 5.0, 0.0), 5.0);
        let id = world.add_spring(spring).unwrap();
        assert_eq!(world.spring(id).unwrap(), spring);
        run(&mut world, 0.5, 10);
        assert!(world.sphere(emitted).is_err() && world.spring(id).is_err(), "{rule:?}");
    }
}

#[test]
fn springs_refuse_numbers_that_make_no_sense_and_spheres_that_are_not_there() {
    let mut world = world(Exact::default());
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
    let gone = SphereId::from_number(7);
    let good = Spring::to_point(ball, DVec3::X, 1.0);
    let bad = [
        (good.with_stiffness(-1.0), "spring 0: `stiffness` must be zero or positive"),
        (good.with_damping(f64::NAN), "spring 0: `damping` must be zero or positive"),
        (
            Spring::to_point(ball, DVec3::X, -1.0),
            "spring 0: `rest_length` must be zero or positive",
        ),
        (Spring::to_point(ball, DVec3::INFINITY, 1.0), "spring 0: `to` must be finite"),
        (Spring::between(ball, ball, 1.0), "spring 0: `to` must be another sphere"),
        (Spring::between(ball, gone, 1.0), "there is no sphere 7"),
        (Spring::to_point(gone, DVec3::X, 1.0), "there is no sphere 7"),
    ];
    for (spring, message) in bad {
        let error = world.add_spring(spring).unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
    let id = world.add_spring(good).unwrap();
    assert!(world.set_spring(id, good.with_stiffness(-1.0)).is_err());
    assert_eq!(world.spring(id).unwrap(), good);
    world.remove_spring(id).unwrap();
    assert_eq!(
        world.remove_spring(id).unwrap_err().to_string(),
        "there is no spring 0 in this world"
    );
}

#[test]
fn a_spring_in_a_periodic_box_goes_to_the_nearest_image() {
    let periodic =
        Settings::default().with_boundary(Boundary::Periodic { size: DVec3::splat(8.0) });
    let mut world = World::new(periodic).unwrap();
    let left = world.add_sphere(Sphere::new(vec(-3.5, 0.0, 0.0), 0.1)).unwrap();
    let right = world.add_sphere(Sphere::new(vec(3.5, 0.0, 0.0), 0.1)).unwrap();
    world.add_spring(Spring::between(left, right, 0.5).with_stiffness(4.0)).unwrap();
    // Across the face it is 1 m long.
    assert_eq!(world.potential_energy(), 0.5);
    world.step(0.01).unwrap();
    assert!(world.sphere(left).unwrap().velocity.x < 0.0);
    assert_eq!(world.momentum(), DVec3::ZERO);
}

#[test]
fn a_sphere_on_a_spring_that_presses_it_to_the_floor_rests_there() {
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        let mut world = world(rule);
        world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
        let ball = world.add_sphere(Sphere::new(vec(0.0, 0.5, 0.0), 0.5)).unwrap();
        let spring = Spring::to_point(ball, vec(0.0, 2.0, 0.0), 2.5).with_stiffness(20.0);
        world.add_spring(spring).unwrap();
        run(&mut world, 1.0, 60);
        // The weight, and a spring that is 1 m too short.
        assert_close(world.contacts()[0].normal_force, G + 20.0, 1e-9);
        assert_close(position(&world, ball).y, 0.5, 1e-3);
    }
}

/// A column that friction keeps in a zone, each ball hung on a spring that bears most of its weight.
fn hung_column() -> (World, Vec<SphereId>) {
    let mut world = world(Exact::default().with_max_impacts(50));
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_restitution(0.0);
    world.add_collider(floor).unwrap();
    let mut balls = Vec::new();
    for i in 0..6 {
        let place = vec(1e-3 * f64::from(i), 0.5 + f64::from(i), 0.0);
        balls.push(world.add_sphere(Sphere::new(place, 0.5).with_restitution(0.5)).unwrap());
    }
    for &ball in &balls {
        let above = position(&world, ball) + vec(0.0, 10.0, 0.0);
        let spring = Spring::to_point(ball, above, 10.0 - G / 100.0).with_stiffness(100.0);
        world.add_spring(spring.with_damping(5.0)).unwrap();
    }
    (world, balls)
}

#[test]
fn spheres_in_a_stepped_zone_feel_their_springs() {
    let (mut world, balls) = hung_column();
    run(&mut world, 2.0, 120);
    for (i, &ball) in balls.iter().enumerate() {
        // Each hangs where it was: its spring bears it.
        assert_close(position(&world, ball).y, 0.5 + i as f64, 5e-3);
    }
}

#[test]
fn springs_that_are_removed_pull_nothing_in_a_stepped_zone() {
    let (mut world, balls) = hung_column();
    run(&mut world, 1.0, 60);
    for (id, _) in world.springs().map(|(id, spring)| (id, *spring)).collect::<Vec<_>>() {
        world.remove_spring(id).unwrap();
    }
    // The lowest balls taken out, the others fall freely, by half a metre within this time.
    world.remove_spheres(&balls[..3]).unwrap();
    let (top, fall) = (balls[5], 0.3);
    let (start, speed) = (position(&world, top).y, world.sphere(top).unwrap().velocity.y);
    run(&mut world, fall, 18);
    let expected = start + speed * fall - 0.5 * G * fall * fall;
    // A zone moves them in ticks of 1/480 s, g t dt / 2 = 3e-3 m late at most; a spring would halve the way.
    assert_close(position(&world, top).y, expected, 5e-3);
}

#[test]
fn a_pendulum_on_a_stiff_spring_has_the_period_of_its_amplitude() {
    let (length, angle, stiffness): (f64, f64, f64) = (1.0, 0.6, 1e7);
    let mut world = world_with(Integrator::RungeKutta4);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let start = length * vec(angle.sin(), -angle.cos(), 0.0);
    let ball = world.add_sphere(Sphere::new(start, 0.1)).unwrap();
    world
        .add_spring(Spring::to_point(ball, DVec3::ZERO, length).with_stiffness(stiffness))
        .unwrap();
    let a = angle * angle;
    let series = 1.0 + a / 16.0 + 11.0 / 3072.0 * a * a + 173.0 / 737_280.0 * a * a * a;
    let quarter = 0.5 * PI * (length / G).sqrt() * series;
    run(&mut world, quarter, 4000);
    // At the bottom after a quarter; stretched by up to 2 m g / k = 2e-6, as much again for the next term.
    assert_close(position(&world, ball).x, 0.0, 1e-5);
}

#[test]
fn bits_do_not_depend_on_how_a_run_is_cut() {
    for (rule, _) in rules() {
        let (mut world, _) = pair_on_spring(rule, 0.1);
        world.add_force(MutualGravity::new(0.5)).unwrap();
        run(&mut world, 0.5, 30);
        let snapshot = world.snapshot();
        run(&mut world, 0.5, 30);
        let hash = world.state_hash();
        world.restore(&snapshot);
        run(&mut world, 0.5, 30);
        assert_eq!(world.state_hash(), hash, "{rule:?}");
    }
}

/// A rope of twenty balls of 0.1 kg on springs of `stiffness` \[N/m\], let go from level, under the rule
/// `exact`; and the energy that it has at the start.
fn rope(stiffness: f64) -> World {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    let balls: Vec<SphereId> = (0..20)
        .map(|i| {
            let place = vec(0.2 * f64::from(i + 1), 0.0, 0.0);
            world.add_sphere(Sphere::new(place, 0.05).with_mass(0.1)).unwrap()
        })
        .collect();
    let joints = balls.windows(2).map(|pair| Spring::between(pair[0], pair[1], 0.2));
    let anchor = Spring::to_point(balls[0], DVec3::ZERO, 0.2);
    for spring in joints.chain([anchor]) {
        world.add_spring(spring.with_stiffness(stiffness)).unwrap();
    }
    world
}

#[test]
fn under_exact_springs_stay_stable_in_frames_of_any_length() {
    // Far beyond w h = 2 in the longest frame, and in the default force tick.
    for (stiffness, frame) in [(2e3, 1.0 / 60.0), (2e3, 0.5), (2e6, 1.0 / 60.0)] {
        let mut world = rope(stiffness);
        for _ in 0..(2.0 / frame) as usize {
            world.step(frame).unwrap();
            // It swings through the lowest place, 4 m down; impacts are elastic. Of the weight's work,
            // the leapfrog scheme keeps all but (w h)² / 4 of what is in the springs.
            assert!(world.total_energy().abs() < 0.3, "{stiffness}, {frame}");
        }
    }
}

#[test]
fn under_exact_forces_between_spheres_know_no_frames() {
    let after = |frames: u32| {
        let mut world = rope(2e3);
        world.add_force(MutualGravity::new(0.5)).unwrap();
        let emitted = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(4.0, 0.0, 0.0));
        let place = vec(1.0, 3.0, 0.0);
        world.add_emitter(Emitter::new(emitted, 0.07).with_position(place)).unwrap();
        run(&mut world, 1.0, frames);
        world.spheres().positions().to_vec()
    };
    // Emitted spheres become more than take their steps together; then forces are held.
    let expected = after(30);
    // Not one rounding apart. A frame of more than 64 force ticks changes those.
    for frames in [64, 500] {
        assert_eq!(after(frames), expected, "{frames}");
    }
}

#[test]
fn springs_too_stiff_for_force_ticks_are_refused_by_their_rate() {
    let mut world = rope(1e14);
    let refused = world.step(0.01).unwrap_err().to_string();
    assert!(
        refused.starts_with("step: `stiffness` must be small enough for the `force_tick`"),
        "{refused}"
    );
    assert_eq!(world.time(), 0.0);
}

#[test]
fn contact_follows_stiff_springs_by_its_sub_steps_and_refuses_stiffer_ones() {
    // The rate is the root of the stiffness by the mass: there are up to 512 sub-steps in a frame.
    for (stiffness, follows) in [(1e6, true), (9e8, true), (1e9, false), (1e20, false)] {
        let mut world = world(Contact::default());
        let ball = Sphere::new(DVec3::X, 0.1).with_mass(1.0);
        let ball = world.add_sphere(ball).unwrap();
        let spring = Spring::to_point(ball, DVec3::ZERO, 0.99).with_stiffness(stiffness);
        world.add_spring(spring).unwrap();
        let energy = world.total_energy();
        for _ in 0..30 {
            match world.step(1.0 / 60.0) {
                // Symplectic Euler with w h = 1 keeps x² + v²/w² to within (1 ± w h / 2).
                Ok(_) => assert!(follows && world.total_energy() < 3.0 * energy, "{stiffness}"),
                Err(error) => {
                    let told = error.to_string();
                    assert!(!follows && told.starts_with("step: `stiffness` must be"), "{told}");
                }
            }
        }
        assert_eq!(world.time() > 0.0, follows);
        assert_eq!(world.check_step(1.0 / 60.0).is_ok(), follows);
    }
}

#[test]
fn force_ticks_follow_the_scale_of_frames() {
    // A double star by years, by seconds and by microseconds: the same orbit, with G = 4 pi² / scale².
    let after = |scale: f64| {
        let mut world = world(Exact::default());
        world.add_force(MutualGravity::new(TAU * TAU / (scale * scale))).unwrap();
        let speed = 0.5 * TAU / scale * 2.0_f64.sqrt();
        for side in [1.0, -1.0] {
            let star = Sphere::new(vec(0.5 * side, 0.0, 0.0), 1e-3);
            world.add_sphere(star.with_velocity(vec(0.0, speed * side, 0.0))).unwrap();
        }
        let mut stages = 0;
        for _ in 0..500 {
            stages += world.step(scale / 1000.0).unwrap().work.predictions;
        }
        (world.spheres().positions()[0], stages)
    };
    let (expected, _) = after(1.0);
    for scale in [3e7, 1e-6] {
        let (place, predictions) = after(scale);
        assert!(place.distance(expected) < 0.05, "{scale}: {place} instead of {expected}");
        // 64 ticks in each of 500 frames, for each of two spheres.
        assert!(predictions <= 2 * 65 * 500, "{scale}: {predictions}");
    }
}
