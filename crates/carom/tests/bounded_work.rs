//! The work of frames, counted: nothing that a world may hold makes a frame go on without end.

mod common;

use carom::{
    Buoyancy, Collider, ConstantForce, Contact, DQuat, DVec3, Emitter, Exact, Gravity,
    MutualGravity, PointAttractor, Pose, QuadraticDrag, Rule, Shape, Sides, Sphere, ViscousDrag,
    Vortex, Wind, World,
};
use common::{G, bisect, discrete, vec, world};

const FRAME: f64 = 1.0 / 60.0;

fn rules() -> [Rule; 4] {
    [Exact::default().into(), Contact::default().into(), bisect(), discrete()]
}

/// The work of a number of frames: events and solver iterations under `exact`, sweeps over contacts, and tests of
/// pairs.
fn work_of(world: &mut World, frames: usize) -> u64 {
    let mut done = 0;
    for _ in 0..frames {
        let report = world.step(FRAME).unwrap();
        let work = report.work;
        done += work.events + work.solver_iterations + work.pair_tests + work.sweeps;
        done += report.impacts.len() as u64;
    }
    done
}

#[test]
fn every_force_lets_emitters_fill_an_empty_world() {
    let add: [fn(&mut World); 10] = [
        |_| {},
        |world| assert!(world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap().number() == 0),
        |world| {
            assert!(world.add_force(ConstantForce::new(vec(1.0, 2.0, 0.0))).unwrap().number() == 0)
        },
        |world| assert!(world.add_force(ViscousDrag::new(0.5)).unwrap().number() == 0),
        |world| assert!(world.add_force(QuadraticDrag::new(1.2)).unwrap().number() == 0),
        |world| assert!(world.add_force(Wind::new(vec(3.0, 0.0, 1.0), 0.5)).unwrap().number() == 0),
        |world| assert!(world.add_force(Vortex::new(DVec3::ZERO, 2.0, 0.5)).unwrap().number() == 0),
        |world| assert!(world.add_force(Buoyancy::new(1000.0, 0.5)).unwrap().number() == 0),
        |world| {
            assert!(
                world.add_force(PointAttractor::new(vec(0.0, -1.0, 0.0), 5.0)).unwrap().number()
                    == 0
            )
        },
        |world| assert!(world.add_force(MutualGravity::new(0.1)).unwrap().number() == 0),
    ];
    for rule in rules() {
        for (number, add_force) in add.iter().enumerate() {
            for max_spheres in [None, Some(3)] {
                let mut world = world(rule);
                add_force(&mut world);
                let thrown = Sphere::new(DVec3::ZERO, 0.1).with_velocity(vec(1.0, 3.0, 0.5));
                let emitter = Emitter::new(thrown, 0.1).with_max_spheres(max_spheres);
                world.add_emitter(emitter).unwrap();
                let work = work_of(&mut world, 120);
                // Twenty balls, in each frame their neighbours and some events at each of four force ticks.
                let most = 120 * 20 * 60;
                assert!(work < most, "force {number}, {rule:?}, {max_spheres:?}: {work}");
                // Where there is no room, a ball is left out.
                let most = max_spheres.unwrap_or(20) as usize;
                assert!((1..=most).contains(&world.spheres().len()), "{:?}", world.spheres());
            }
        }
    }
}

/// The shapes with their tops at height 0, beside each other at x = 0.
fn flush(left: bool) -> [Collider; 5] {
    let side = if left { -1.0 } else { 1.0 };
    let at = |y: f64| Pose::at(vec(side, y, 0.0));
    let size = vec(2.0, 1.0, 2.0);
    let (rotated, open) = (DQuat::from_rotation_x(std::f64::consts::PI), Sides::NONE);
    [
        Collider::new(Shape::Rectangle { size_x: 2.0, size_z: 2.0 }, at(0.0)),
        Collider::new(Shape::Box { size }, at(-0.5)),
        Collider::new(Shape::Box { size }, at(-0.5).rotated(rotated)),
        Collider::new(Shape::Container { size, open }, at(-0.5)),
        Collider::new(Shape::HalfSpace, at(0.0)),
    ]
}

#[test]
fn every_shape_beside_every_other_lets_balls_bounce_and_roll_across_the_seam() {
    for rule in [Rule::from(Exact::default()), Contact::default().into()] {
        for left in flush(true) {
            for right in flush(false) {
                for (restitution, friction) in [(0.0, 0.3), (0.5, 0.3), (0.9, 0.0), (0.5, 0.0)] {
                    let mut world = world(rule);
                    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
                    for collider in [left.clone(), right.clone()] {
                        let collider = collider.with_restitution(restitution);
                        world.add_collider(collider.with_friction(friction)).unwrap();
                    }
                    let ball = Sphere::new(vec(-0.5, 0.1, 0.0), 0.1);
                    world.add_sphere(ball.with_velocity(vec(0.7, 0.0, 0.1))).unwrap();
                    let fall = vec(0.01, 0.5, 0.5);
                    world.add_sphere(ball.with_position(fall)).unwrap();
                    world.add_sphere(ball.with_position(vec(0.0, 0.3, -0.5))).unwrap();
                    let work = work_of(&mut world, 90);
                    // In each frame eight sub-steps with up to 17 sweeps, or some events of each ball.
                    let most = 90 * 3 * 60;
                    let shapes = (&left.shape, &right.shape);
                    assert!(work < most, "{shapes:?}, {restitution}, {friction}: {work}");
                    let heights = world.spheres().positions().iter().map(|it| it.y);
                    let lowest = heights.fold(f64::INFINITY, f64::min);
                    assert!(lowest > 0.1 - 1e-4, "{shapes:?}, {restitution}: {lowest}");
                }
            }
        }
    }
}

/// A force that takes energy from what moves.
type Damping = fn(&mut World);

const DAMPINGS: [Damping; 2] = [
    |world| {
        world.add_force(ViscousDrag::new(5.0)).unwrap();
    },
    |world| {
        world.add_force(Wind::new(DVec3::ZERO, 5.0)).unwrap();
    },
];

/// A ball of 1 kg and 0.1 m that never loses energy in impacts, above a slope that falls towards +x by an angle
/// \[rad\], in a fluid.
fn elastic_ball_in_a_fluid(damping: Damping, angle: f64, friction: f64) -> World {
    let mut world = world(Exact::default());
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    damping(&mut world);
    let slope = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_z(-angle));
    let slope = Collider::new(Shape::HalfSpace, slope).with_restitution(1.0);
    world.add_collider(slope.with_friction(friction)).unwrap();
    world.add_sphere(Sphere::new(vec(0.0, 1.0, 0.0), 0.1).with_restitution(1.0)).unwrap();
    world
}

/// Between bounces drag takes the part 2/3 γ t of the speed, so the rate of bounces grows as e^(2/3 γ t): up to a
/// rate r there are r/(2/3 γ).
#[test]
fn an_elastic_ball_in_a_fluid_comes_to_rest_after_some_thousand_bounces() {
    for damping in DAMPINGS {
        for friction in [0.0, 0.2] {
            let mut world = elastic_ball_in_a_fluid(damping, 0.0, friction);
            let work = work_of(&mut world, 600);
            assert!(work < 100_000, "{friction}: {work}");
            let (place, velocity) =
                (world.spheres().positions()[0], world.spheres().velocities()[0]);
            // Hops that count as none are 10⁻⁶ of the radius high.
            assert!((place.y - 0.1).abs() < 1e-7 && velocity.length() < 1e-9, "{place} {velocity}");
        }
    }
}

#[test]
fn an_elastic_ball_that_hops_down_a_slope_in_a_fluid_slides_at_its_terminal_velocity() {
    let angle: f64 = 0.2;
    for damping in DAMPINGS {
        let mut world = elastic_ball_in_a_fluid(damping, angle, 0.0);
        let work = work_of(&mut world, 600);
        assert!(work < 100_000, "{work}");
        // m g sin θ = k v
        let terminal = G * libm::sin(angle) / 5.0;
        let velocity = world.spheres().velocities()[0];
        let along = vec(libm::cos(angle), -libm::sin(angle), 0.0);
        // What is left of the start after 10 s is e⁻⁵⁰; zones round to 10⁻¹² in a sub-step.
        assert!((velocity - terminal * along).length() < 1e-9, "{velocity} {terminal}");
    }
}

#[test]
fn elastic_balls_on_each_other_in_a_fluid_come_to_rest_after_some_thousand_bounces() {
    for damping in DAMPINGS {
        let mut world = elastic_ball_in_a_fluid(damping, 0.0, 0.0);
        for height in [2.0, 3.0] {
            let ball = Sphere::new(vec(0.0, height, 0.0), 0.1).with_restitution(1.0);
            world.add_sphere(ball).unwrap();
        }
        let work = work_of(&mut world, 600);
        // Each bounce of the column is a group, which takes some iterations of the solver.
        assert!(work < 1_000_000, "{work}");
        let heights = world.spheres().positions().iter().map(|place| place.y);
        for (height, at_rest) in heights.zip([0.1, 0.3, 0.5]) {
            // Zones leave overlaps of up to a thousandth of the radius.
            assert!((height - at_rest).abs() < 2e-4, "{height} {at_rest}");
        }
    }
}
