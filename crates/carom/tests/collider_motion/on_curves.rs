//! Balls in persistent contact with colliders that move follow curves: closed forms, and accounts that close, to rounding.

use std::f64::consts::{PI, TAU};

use carom::{
    Collider, DQuat, DVec3, Ends, Exact, Gravity, Motion, MotionPart, Pose, Shape, Sphere, World,
    Zones,
};

use crate::common::{account_of_run, assert_close, vec, world};
use crate::{SIZES, heavy_world, oscillate, plate};

const RADIUS: f64 = 0.1;

/// A world with gravity in units of this length, without zones.
fn without_zones(size: f64) -> World {
    heavy_world(Exact::default().with_zones(Zones::Never).into(), size)
}

/// A ball that touches the plane y = 0, with this motion, in units of this length.
fn ball(size: f64, place: DVec3, velocity: DVec3, turning: DVec3) -> Sphere {
    let ball = Sphere::new((place + RADIUS * DVec3::Y) * size, RADIUS * size);
    ball.with_velocity(velocity * size).with_angular_velocity(turning).with_restitution(0.0)
}

#[test]
fn ball_rolls_at_two_sevenths_of_a_plate_that_oscillates_along_itself() {
    // m x'' = F and 2/5 m r² ω' = F r with x'' + r ω' = X'': x'' = 2/7 X''. A belt across it changes nothing.
    let (amplitude, frequency) = (0.1, 1.0);
    let omega = TAU * frequency;
    for size in SIZES {
        for (belt, frame) in [(0.0, 1.0 / 60.0), (0.7, 1.0 / 60.0), (0.7, 0.31)] {
            let mut world = without_zones(size);
            // Begins at rest.
            let motion = oscillate(DVec3::X, amplitude * size, frequency, -0.5 * PI);
            let plate = plate([motion]).with_friction(1.0).with_restitution(0.0);
            let plate = plate.with_surface_velocity(belt * size * DVec3::Z);
            world.add_collider(plate).unwrap();
            // v + w × (-r Y) is the velocity of the belt.
            let turning = vec(-belt / RADIUS, 0.0, 0.0);
            world.add_sphere(ball(size, DVec3::ZERO, DVec3::ZERO, turning)).unwrap();
            let frames = (2.0 / frame) as usize;
            for _ in 0..frames {
                world.step(frame).unwrap();
                let expected = 2.0 / 7.0 * amplitude * (1.0 - (omega * world.time()).cos());
                let place = world.spheres().positions()[0] / size;
                let off = (place - vec(expected, RADIUS, 0.0)).length();
                // Rounding of some tens of steps.
                assert!(off < 1e-14, "{size} {belt} {frame}: {off:e}");
            }
        }
    }
}

#[test]
fn ball_slides_and_rolls_on_a_plate_that_moves_steadily_as_on_one_at_rest() {
    for (belt, drift) in
        [(0.0, vec(0.8, 0.3, -0.2)), (0.6, vec(-1.5, -0.2, 0.4)), (0.6, vec(0.2, 0.0, 0.0))]
    {
        let [mut still, mut moving] = [DVec3::ZERO, drift].map(|drift| {
            let mut world = without_zones(1.0);
            let plate = plate(Motion::default()).with_friction(0.2).with_restitution(0.0);
            let plate = plate.with_surface_velocity(belt * DVec3::Z);
            world.add_collider(plate.moving(drift, DVec3::ZERO)).unwrap();
            let velocity = vec(1.0, 0.0, 0.3) + drift;
            world.add_sphere(ball(1.0, DVec3::ZERO, velocity, vec(1.0, 2.0, -3.0))).unwrap();
            world
        });
        for _ in 0..120 {
            still.step(1.0 / 60.0).unwrap();
            moving.step(1.0 / 60.0).unwrap();
            let shifted = moving.spheres().positions()[0] - drift * moving.time();
            let off = shifted - still.spheres().positions()[0];
            // The pieces of path of a slip that turns on the plate at rest.
            assert!(off.length() < 1e-9, "{belt} {drift}: {off}");
        }
    }
}

/// Place and velocity after a time \[s\] of a ball that slides on a plane: `s' = p − 7/2 μ g s/|s|` and
/// `v' = p − μ g s/|s|`, by the method of Runge and Kutta in steps of a part of the slip, then `v' = 5/7 p`.
fn slid([mut velocity, mut slip]: [DVec3; 2], pull: DVec3, braking: f64, time: f64) -> [DVec3; 2] {
    let (mut place, mut left) = (DVec3::ZERO, time);
    while left > 0.0 && slip.length() > 1e-13 {
        let h = (1e-2 * slip.length() / braking).min(left);
        let rate = |slip: DVec3| pull - braking * slip.normalize();
        let turn = |slip: DVec3| pull - 3.5 * braking * slip.normalize();
        let second = slip + 0.5 * h * turn(slip);
        let third = slip + 0.5 * h * turn(second);
        let fourth = slip + h * turn(third);
        let [first_rate, second_rate, third_rate, fourth_rate] =
            [slip, second, third, fourth].map(rate);
        place += h * velocity + h * h / 6.0 * (first_rate + second_rate + third_rate);
        velocity += h / 6.0 * (first_rate + 2.0 * (second_rate + third_rate) + fourth_rate);
        let sides = turn(slip) + turn(fourth);
        slip += h / 6.0 * (sides + 2.0 * (turn(second) + turn(third)));
        left -= h;
    }
    let rolling = pull / 1.4;
    [place + left * velocity + 0.5 * left * left * rolling, velocity + left * rolling]
}

#[test]
fn small_slip_on_a_plate_that_moves_turns_until_it_ends() {
    let (pull, drift, friction, gravity) = (vec(0.7, 0.0, 0.9), vec(2.5, -1.75, 3.25), 0.2, 9.81);
    let velocity = vec(8.0, 0.0, 3.0);
    // Below a twentieth of the speeds in the contact, and above.
    for speed in [0.03, 0.3, 3.0] {
        let slip = speed * vec(-0.4, 0.0, 0.9).normalize();
        let turning = DVec3::Y.cross(velocity - slip) / RADIUS;
        let [place, arrived] = slid([velocity, slip], pull, friction * gravity, 0.75);
        for (size, frame) in SIZES.map(|size| (size, 0.0125)).into_iter().chain([(1.0, 0.25)]) {
            let mut world = world(Exact::default().with_zones(Zones::Never));
            world.add_force(Gravity::new((pull - gravity * DVec3::Y) * size)).unwrap();
            let plate = plate(Motion::default()).with_friction(friction).with_restitution(0.0);
            world.add_collider(plate.moving(drift * size, DVec3::ZERO)).unwrap();
            world.add_sphere(ball(size, DVec3::ZERO, velocity + drift, turning)).unwrap();
            for _ in 0..(0.75 / frame) as usize {
                world.step(frame).unwrap();
            }
            let spheres = world.spheres();
            let way = spheres.positions()[0] / size - RADIUS * DVec3::Y - drift * world.time();
            let off = (way - place).length();
            // Below a thousandth of the speeds a slip keeps its direction over a step.
            assert!(off < 2e-8, "{speed} {size} {frame}: {off:e}");
            let off = (spheres.velocities()[0] / size - drift - arrived).length();
            // It then ends as it would, but for rounding of the speeds.
            assert!(off < 1e-12, "{speed} {size} {frame}: {off:e}");
        }
    }
}

#[test]
fn ball_on_a_plane_that_turns_about_a_line_in_it_is_flung_out_as_a_hyperbolic_cosine() {
    // Without gravity x'' = Ω² x along the plane, and Coriolis' acceleration presses while 2 Ω x' > Ω² r.
    let (rate, start, speed) = (2.0, 0.05, 0.5);
    for size in SIZES {
        for is_driven in [false, true] {
            let mut world = world(Exact::default().with_zones(Zones::Never));
            let turn = MotionPart::Turn { axis: DVec3::Z, pivot: DVec3::ZERO, rate };
            let plane = plate(Motion::default());
            let plane = match is_driven {
                true => plane.with_motion([turn]),
                false => plane.moving(DVec3::ZERO, rate * DVec3::Z),
            };
            world.add_collider(plane.with_restitution(0.0)).unwrap();
            let velocity = vec(speed - rate * RADIUS, rate * start, 0.0);
            world.add_sphere(ball(size, start * DVec3::X, velocity, DVec3::ZERO)).unwrap();
            let mut largest: f64 = 0.0;
            for _ in 0..90 {
                world.step(1.0 / 60.0).unwrap();
                let angle = rate * world.time();
                let along = start * angle.cosh() + speed / rate * angle.sinh();
                let expected = DQuat::from_rotation_z(angle) * vec(along, RADIUS, 0.0);
                let off = (world.spheres().positions()[0] / size - expected).length();
                largest = largest.max(off / along);
            }
            // Errors grow as the path does.
            assert!(largest < 1e-13, "{size} {is_driven}: {largest:e}");
        }
    }
}

/// A rough pipe that lies along z and turns about its own axis, with a ball at an angle from its lowest line.
fn in_turning_pipe(rate: f64, angle: f64) -> World {
    let mut world = without_zones(1.0);
    let pipe = Shape::Pipe { radius: 1.0, length: 2.0, closed: Ends::NONE };
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_x(0.5 * PI));
    let pipe = Collider::new(pipe, pose).with_friction(100.0).with_restitution(0.0);
    world.add_collider(pipe.moving(DVec3::ZERO, rate * DVec3::Z)).unwrap();
    let down = vec(angle.sin(), -angle.cos(), 0.0);
    let ball = Sphere::new((1.0 - RADIUS) * down, RADIUS).with_restitution(0.0);
    // Its lowest point moves with the pipe.
    world.add_sphere(ball.with_angular_velocity(rate / RADIUS * DVec3::Z)).unwrap();
    world
}

#[test]
fn ball_rolls_in_a_pipe_that_turns_steadily_as_in_one_at_rest() {
    for angle in [0.0, 0.4, 1.2] {
        let [mut still, mut turning] = [0.0, 5.0].map(|rate| in_turning_pipe(rate, angle));
        for _ in 0..300 {
            still.step(1.0 / 60.0).unwrap();
            turning.step(1.0 / 60.0).unwrap();
            let off = turning.spheres().positions()[0] - still.spheres().positions()[0];
            // Rounding of some hundred steps.
            assert!(off.length() < 1e-12, "{angle}: {off}");
        }
    }
}

#[test]
fn smooth_ball_in_a_pipe_that_tumbles_is_flung_out_as_a_hyperbolic_cosine() {
    // About an axis across the pipe x'' = Ω² x along it, whichever side of the pipe holds the ball.
    let (rate, start, gap) = (3.0, 0.05, 0.02);
    let mut world = world(Exact::default().with_zones(Zones::Never));
    let pipe = Shape::Pipe { radius: RADIUS + gap, length: 200.0, closed: Ends::NONE };
    let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_z(-0.5 * PI));
    let pipe = Collider::new(pipe, pose).with_restitution(0.0);
    world.add_collider(pipe.moving(DVec3::ZERO, rate * DVec3::Z)).unwrap();
    // At rest in the pipe but for its way along it, on the side that pushes.
    let place = vec(start, -gap, 0.0);
    let velocity = vec(0.4, 0.0, 0.0) + rate * DVec3::Z.cross(place);
    world.add_sphere(Sphere::new(place, RADIUS).with_velocity(velocity)).unwrap();
    let mut events = 0;
    for _ in 0..100 {
        events += world.step(1.0 / 60.0).unwrap().work.events;
        let angle = rate * world.time();
        let along = start * angle.cosh() + 0.4 / rate * angle.sinh();
        let expected = DQuat::from_rotation_z(angle) * vec(along, -gap, 0.0);
        let off = (world.spheres().positions()[0] - expected).length();
        assert!(off < 1e-12 * along, "{}: {off:e}", world.time());
    }
    assert!(events < 300, "{events}");
}

#[test]
fn work_of_a_plate_and_of_friction_on_a_ball_that_slides_and_rolls_closes_the_account() {
    for size in SIZES {
        for friction in [0.05, 0.3] {
            let mut world = without_zones(size);
            let swing = MotionPart::Swing {
                axis: DVec3::Z,
                pivot: size * DVec3::Y,
                amplitude: 0.1,
                frequency: 0.8,
                phase: 0.0,
            };
            let along = oscillate(vec(1.0, 0.0, 0.5), 0.1 * size, 1.1, 0.3);
            let plate = plate([along, swing]).with_friction(friction).with_restitution(0.0);
            world.add_collider(plate.with_surface_velocity(0.3 * size * DVec3::X)).unwrap();
            world.add_sphere(ball(size, DVec3::ZERO, DVec3::ZERO, DVec3::ZERO)).unwrap();
            let start = world.total_energy();
            let (account, left) = account_of_run(&mut world, 180, 1.0 / 60.0);
            let most = account.colliders.abs().max(account.contacts.abs());
            // Rounding of some hundred steps.
            assert!(left.abs() < 1e-12 * most, "{size} {friction}: {left:e} of {most:e}");
            assert!(account.contacts < 0.0 && account.integration == 0.0, "{account:?}");
            let gained = account.colliders + account.contacts;
            assert_close(gained / most, (world.total_energy() - start) / most, 1e-12);
        }
    }
}

#[test]
fn path_on_what_moves_does_not_depend_on_the_length_of_frames() {
    let run = |friction: f64, frame: f64, frames: usize| {
        let mut world = without_zones(1.0);
        world.add_force(Gravity::new(vec(0.5, 0.0, 0.2))).unwrap();
        let turn = MotionPart::Turn { axis: vec(0.1, 1.0, 0.0), pivot: DVec3::X, rate: 1.5 };
        let plate = plate([oscillate(DVec3::X, 0.05, 2.0, -0.5 * PI), turn]);
        world.add_collider(plate.with_friction(friction).with_restitution(0.0)).unwrap();
        // It rolls from the start: the plate turns about X.
        let velocity = vec(0.0, 0.15, 1.5);
        world.add_sphere(ball(1.0, DVec3::ZERO, velocity, 1.5 * vec(0.1, 1.0, 0.0))).unwrap();
        for _ in 0..frames {
            world.step(frame).unwrap();
        }
        world.spheres().positions()[0]
    };
    // Rounding where it rolls. Where it slides, friction has one direction while the slip is small, that in the middle of a
    // step, and the lengths of steps follow rounding.
    for (friction, tolerance) in [(2.0, 1e-12), (0.1, 2e-7)] {
        let expected = run(friction, 1.0 / 16.0, 24);
        for (frame, frames) in [(1.0 / 64.0, 96), (0.5, 3), (1.5, 1)] {
            let off = (run(friction, frame, frames) - expected).length();
            assert!(off < tolerance, "{friction} {frame}: {off:e}");
        }
    }
}
