//! Forces that depend on where a sphere is or how it moves, against closed forms and against the slope of
//! their potential energies. Says nothing about forces between spheres.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use std::f64::consts::{PI, TAU};

use carom::{
    Buoyancy, Collider, Contact, DQuat, DVec3, Discrete, Exact, Force, ForceId, Gravity,
    Integrator, PointAttractor, Pose, QuadraticDrag, Rule, Shape, Sphere, SphereState, Vortex,
    Wind, World,
};
use common::{G, Numbers, assert_close, vec, world, world_with};

fn at(position: DVec3, velocity: DVec3) -> SphereState {
    SphereState { position, velocity, radius: 0.3, mass: 2.0 }
}

fn run(world: &mut World, duration: f64, h: f64) {
    for _ in 0..(duration / h).round() as usize {
        world.step(h).unwrap();
    }
}

#[test]
fn forces_are_the_slopes_of_their_potentials() {
    let forces: [&dyn Force; 4] = [
        &PointAttractor::new(vec(0.3, -0.2, 0.1), 5.0),
        &PointAttractor::new(vec(0.3, -0.2, 0.1), 5.0).with_softening(0.4),
        &Buoyancy::new(800.0, 0.1),
        &Buoyancy::new(800.0, 0.1).with_gravity(vec(1.0, -7.0, 2.0)),
    ];
    let mut numbers = Numbers(7);
    let d = 1e-5;
    for force in forces {
        let mut forced = 0;
        for _ in 0..200 {
            let state = at(numbers.vector(), DVec3::ZERO);
            let energy = |shift| {
                let position = state.position + shift;
                force.potential_energy(&SphereState { position, ..state }, 0.0)
            };
            let slope = DVec3::AXES.map(|axis| (energy(d * axis) - energy(-d * axis)) / (2.0 * d));
            let (expected, found) = (-DVec3::from_array(slope), force.on(&state, 0.0));
            // A central difference: the third derivative times d²/6, and rounding divided by d.
            let near = (state.position - vec(0.3, -0.2, 0.1)).length().max(0.05);
            let scale = found.length().max(100.0) / (near * near);
            assert!((expected - found).length() < 1e-8 * scale, "{force:?} at {state:?}");
            forced += u32::from(found != DVec3::ZERO);
        }
        assert!(forced > 50);
    }
}

#[test]
fn a_cap_displaces_its_own_volume() {
    let force = Buoyancy::new(1000.0, 2.0);
    let (r, whole) = (0.3, 4.0 / 3.0 * PI * 0.3f64.powi(3));
    let lift = |y: f64| force.on(&at(vec(5.0, y, 1.0), DVec3::ZERO), 0.0).y / (1000.0 * 9.81);
    // It just touches: what rounding leaves of the depth, squared.
    assert_close(lift(2.0 + r), 0.0, 1e-30);
    assert_close(lift(2.0), whole / 2.0, 1e-15);
    assert_close(lift(2.0 - r), whole, 1e-15);
    assert_close(lift(-50.0), whole, 1e-15);
    // A cap of height r/2: pi (r/2)² (3 r - r/2) / 3.
    assert_close(lift(2.0 + r / 2.0), PI * r * r / 4.0 * (2.5 * r) / 3.0, 1e-15);
}

#[test]
fn a_floating_ball_bobs_with_the_frequency_of_its_waterline() {
    // Half as dense as the fluid, it floats with its centre in the surface; the lift changes by
    // rho g pi r² per metre there.
    let (r, rho) = (0.1, 1000.0);
    let mass = 0.5 * rho * 4.0 / 3.0 * PI * r * r * r;
    let mut world = world_with(Integrator::RungeKutta4);
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(Buoyancy::new(rho, 0.0)).unwrap();
    let amplitude = 1e-4;
    let ball = world.add_sphere(Sphere::new(vec(0.0, amplitude, 0.0), r).with_mass(mass)).unwrap();
    let period = TAU / (rho * G * PI * r * r / mass).sqrt();
    run(&mut world, period, period / 400.0);
    // The next term of the lift is (amplitude / r)² = 1e-6 of the first one.
    assert_close(world.sphere(ball).unwrap().position.y, amplitude, 1e-5 * amplitude);
}

#[test]
fn wind_carries_along_in_closed_form_under_the_rule_exact() {
    let (k, m, u) = (0.7, 2.0, vec(3.0, 0.0, -1.0));
    let mut world = world(Exact::default());
    world.add_force(Wind::new(u, k)).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.1).with_mass(m)).unwrap();
    run(&mut world, 4.0, 0.5);
    let expected = u * (1.0 - (-k * 4.0 / m).exp());
    // Eight flights with a rounding or two each.
    assert!((world.sphere(ball).unwrap().velocity - expected).length() < 1e-14);
}

#[test]
fn a_vortex_turns_rigidly_inside_and_like_an_ideal_one_outside() {
    let vortex = Vortex::new(vec(1.0, 0.0, 0.0), 6.0, 0.5).with_core_radius(0.5);
    // At the core radius the air is fastest: C / (4 pi c).
    let fastest = vortex.velocity_at(vec(1.5, 9.0, 0.0));
    assert!((fastest - vec(0.0, 0.0, -6.0 / (4.0 * PI * 0.5))).length() < 1e-15);
    let inside = vortex.velocity_at(vec(1.0, 0.0, 1e-4)).x;
    // The next term is (r / c)² = 4e-8 of the first one.
    assert_close(inside / (6.0 / (TAU * 0.25) * 1e-4), 1.0, 1e-7);
    let outside = vortex.velocity_at(vec(1.0, 0.0, 1e4)).x;
    assert_close(outside * TAU * 1e4, 6.0, 1e-7);
    let sideways = vortex.with_axis(vec(0.0, 0.0, 3.0)).velocity_at(vec(2.0, 0.0, 4.0));
    assert!(sideways.y > 0.0 && sideways.x == 0.0 && sideways.z == 0.0);
    let dragged = vortex.on(&at(vec(1.5, 0.0, 0.0), vec(0.0, 1.0, 0.0)), 0.0);
    assert!((dragged - 0.5 * (fastest - vec(0.0, 1.0, 0.0))).length() < 1e-15);
}

/// A world with frames of a length \[s\].
type WorldOfFrames = fn(f64) -> World;

/// Worlds with frames of a length \[s\], with the order in it.
fn schemes() -> [(WorldOfFrames, f64); 2] {
    [
        (|_| world_with(Integrator::VelocityVerlet), 2.0),
        (|_| world_with(Integrator::RungeKutta4), 4.0),
    ]
}

/// Speed \[m/s\] after a fall from rest with quadratic drag.
fn fall(h: f64, mut world: World) -> f64 {
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world.add_force(QuadraticDrag::new(1.2).with_drag_coefficient(0.5)).unwrap();
    let ball = world.add_sphere(Sphere::new(DVec3::ZERO, 0.3).with_mass(2.0)).unwrap();
    run(&mut world, 2.0, h);
    -world.sphere(ball).unwrap().velocity.y
}

#[test]
fn a_fall_with_quadratic_drag_is_a_hyperbolic_tangent_to_the_order_of_each_scheme() {
    let terminal = (2.0 * 2.0 * G / (1.2 * 0.5 * PI * 0.09)).sqrt();
    let expected = terminal * (G * 2.0 / terminal).tanh();
    for (world, order) in schemes() {
        let error = |h| (fall(h, world(h)) - expected).abs();
        // 0.15 covers the next term of the series at these steps.
        assert_close((error(1.0 / 16.0) / error(1.0 / 32.0)).log2(), order, 0.15);
    }
}

#[test]
fn drag_by_reynolds_number_is_stokes_when_slow_and_newton_when_fast() {
    let (rho, eta, r) = (1.2, 1.8e-5, 0.3);
    let drag = QuadraticDrag::new(rho).with_viscosity(eta);
    let on = |v: f64| -drag.on(&at(DVec3::ZERO, vec(v, 0.0, 0.0)), 0.0).x;
    // Re = 4e-11: the correction is 0.15 Re^0.687 = 1e-8.
    assert_close(on(1e-15) / (6.0 * PI * eta * r * 1e-15), 1.0, 1e-7);
    assert_close(on(10.0), 0.5 * rho * 0.44 * PI * r * r * 100.0, 1e-12);
    // Re = 100: the table of Clift, Grace and Weber has c = 1.087; Schiller and Naumann's is 1.09.
    let speed = 100.0 * eta / (rho * 2.0 * r);
    let coefficient = on(speed) / (0.5 * rho * PI * r * r * speed * speed);
    assert_close(coefficient, 1.087, 0.03);
    assert_eq!(on(0.0), 0.0);
    let with_wind = drag.with_wind(vec(2.0, 0.0, 0.0));
    assert_eq!(with_wind.on(&at(DVec3::ZERO, vec(2.0, 0.0, 0.0)), 0.0), DVec3::ZERO);
}

/// Distance \[m\] from the start after a Kepler orbit of eccentricity 1/4, in a world with frames of a length
/// \[s\].
fn orbit_error(world: WorldOfFrames, frames: u32) -> f64 {
    let (a, e, mu): (f64, f64, f64) = (1.0, 0.25, 3.0);
    let h = TAU * (a * a * a / mu).sqrt() / f64::from(frames);
    let mut world = world(h);
    world.add_force(PointAttractor::new(DVec3::ZERO, mu)).unwrap();
    let start = vec(a * (1.0 - e), 0.0, 0.0);
    let speed: f64 = (mu / a * (1.0 + e) / (1.0 - e)).sqrt();
    let planet = Sphere::new(start, 0.01).with_velocity(vec(0.0, 0.0, speed)).with_mass(7.0);
    let planet = world.add_sphere(planet).unwrap();
    assert_close(world.total_energy(), -7.0 * mu / (2.0 * a), 1e-13);
    for _ in 0..frames {
        world.step(h).unwrap();
    }
    (world.sphere(planet).unwrap().position - start).length()
}

#[test]
fn a_kepler_ellipse_closes_to_the_order_of_each_scheme() {
    for (world, order) in schemes() {
        let [coarse, fine] = [1000, 2000].map(|frames| orbit_error(world, frames));
        assert_close((coarse / fine).log2(), order, 0.15);
    }
}

#[test]
fn a_sphere_at_the_point_of_an_attractor_is_refused_unless_the_force_is_softened() {
    let point = vec(0.1, -0.2, 0.3);
    for rule in
        [Rule::from(Exact::default()), Contact::default().into(), Discrete::default().into()]
    {
        for softening in [0.0, 0.2] {
            let mut world = world(rule);
            world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
            world.add_force(PointAttractor::new(point, 3.0).with_softening(softening)).unwrap();
            world.add_sphere(Sphere::new(DVec3::ZERO, 0.1)).unwrap();
            let id = world.add_sphere(Sphere::new(point, 0.1)).unwrap();
            let (checked, stepped) = (world.check_step(0.01), world.step(0.01).map(drop));
            if softening > 0.0 {
                checked.unwrap();
                stepped.unwrap();
                assert!(world.total_energy().is_finite());
                continue;
            }
            let error = stepped.unwrap_err();
            assert_eq!(checked.unwrap_err(), error);
            assert!(error.to_string().starts_with("sphere 1: `position` must be where"), "{error}");
            assert_eq!(world.time(), 0.0);
            world.remove_sphere(id).unwrap();
            world.step(0.01).unwrap();
        }
    }
}

#[test]
fn forces_refuse_numbers_that_make_no_sense() {
    let mut world = world(Exact::default());
    let attractor = PointAttractor::new(DVec3::ZERO, f64::NAN);
    let refused = [
        world.add_force(attractor).unwrap_err(),
        world.add_force(PointAttractor::new(DVec3::ZERO, 1.0).with_softening(-1.0)).unwrap_err(),
        world.add_force(Wind::new(DVec3::ZERO, -1.0)).unwrap_err(),
        world.add_force(Vortex::new(DVec3::ZERO, 1.0, 1.0).with_axis(DVec3::ZERO)).unwrap_err(),
        world.add_force(Vortex::new(DVec3::ZERO, 1.0, 1.0).with_core_radius(0.0)).unwrap_err(),
        world.add_force(QuadraticDrag::new(1.0).with_viscosity(-1.0)).unwrap_err(),
        world.add_force(Buoyancy::new(1.0, 0.0).with_gravity(DVec3::ZERO)).unwrap_err(),
    ];
    let fields = ["gravitational_parameter", "softening", "coefficient", "axis", "core_radius"];
    for (error, field) in refused.iter().zip(fields.into_iter().chain(["viscosity", "gravity"])) {
        assert!(error.to_string().contains(&format!("`{field}` must be")), "{error}");
    }
    assert_eq!(world.forces().len(), 0);
}

/// Adds a force to a world of a size.
type Add = fn(&mut World, f64) -> ForceId;

/// Forces that have no closed form; each lets a ball lie on a floor at y = 0.
const VARYING: [Add; 4] = [
    |world, _| world.add_force(QuadraticDrag::new(1.2)).unwrap(),
    |world, size| {
        let gravity = vec(0.0, -G * size, 0.0);
        world.add_force(Buoyancy::new(300.0, 10.0 * size).with_gravity(gravity)).unwrap()
    },
    |world, size| {
        let centre = vec(0.3, 0.0, 0.2) * size;
        world.add_force(Vortex::new(centre, 0.5 * size * size, 0.4 * size.powi(3))).unwrap()
    },
    |world, size| {
        let below = vec(0.0, -30.0, 0.0) * size;
        world.add_force(PointAttractor::new(below, 40.0 * size.powi(3))).unwrap()
    },
];

/// A world of this size where gravity and another force act over colliders of a restitution.
fn borne(add: Add, colliders: &[Collider], restitution: f64, size: f64) -> World {
    let mut world = world(Rule::default());
    world.add_force(Gravity::new(vec(0.0, -G * size, 0.0))).unwrap();
    add(&mut world, size);
    for collider in colliders {
        world.add_collider(collider.clone().with_restitution(restitution)).unwrap();
    }
    world
}

fn light_ball(place: DVec3, size: f64) -> Sphere {
    Sphere::new(place * size, 0.1 * size).with_density(1000.0)
}

#[test]
fn balls_under_varying_forces_stay_on_the_plane_that_bears_them() {
    for (size, friction) in [(1e-6, 0.0), (1.0, 0.0), (1.0, 0.4), (1e6, 0.0)] {
        let face = Shape::Rectangle { size_x: 80.0 * size, size_z: 80.0 * size };
        let block = Shape::Box { size: vec(80.0, 2.0, 80.0) * size };
        for (shape, y) in [(Shape::HalfSpace, 0.0), (face, 0.0), (block, -1.0)] {
            let floor = Collider::new(shape.clone(), Pose::at(vec(0.0, y, 0.0) * size));
            for (add, restitution) in
                VARYING.iter().flat_map(|&add| [0.0, 0.5, 0.9].map(|e| (add, e)))
            {
                let mut world = borne(add, std::slice::from_ref(&floor), restitution, size);
                let ball = |x: f64| light_ball(vec(x, 0.1, 0.0), size).with_friction(friction);
                world.add_sphere(ball(-1.0).with_restitution(restitution)).unwrap();
                let moving = ball(1.0).with_velocity(vec(0.0, 0.0, 0.5) * size);
                world.add_sphere(moving.with_restitution(restitution)).unwrap();
                run(&mut world, 4.0, 1.0 / 60.0);
                for position in world.spheres().positions() {
                    let gap = position.y - 0.1 * size;
                    // The rounding of coordinates that differ by tens of metres.
                    assert!(gap.abs() <= 1e-13 * size, "{gap} m: {shape:?}, e = {restitution}");
                }
            }
        }
    }
}

#[test]
fn balls_under_varying_forces_stay_in_corners_grooves_and_piles() {
    let plane = |normal: DVec3| {
        let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
        Collider::new(Shape::HalfSpace, pose)
    };
    let lean = 0.5f64.sqrt();
    let floor = plane(DVec3::Y);
    let corner = [floor.clone(), plane(DVec3::X)];
    let groove = [plane(vec(lean, lean, 0.0)), plane(vec(-lean, lean, 0.0))];
    let round = [Collider::new(Shape::Sphere { radius: 1.0 }, Pose::at(vec(0.0, -1.0, 0.0)))];
    let at = |places: &[[f64; 3]]| places.iter().map(|&it| it.into()).collect::<Vec<DVec3>>();
    let situations: [(&[Collider], Vec<DVec3>); 4] = [
        (&corner, at(&[[0.1, 0.1, 0.0]])),
        (&groove, at(&[[0.0, 0.2 * lean, 0.0]])),
        (&[floor], at(&[[0.0, 0.1, 0.0], [0.0, 0.3, 0.0], [0.2, 0.1, 0.0]])),
        (&round, at(&[[0.0, 0.1, 0.0]])),
    ];
    for (colliders, places) in &situations {
        for (add, restitution) in VARYING.iter().flat_map(|&add| [0.0, 0.5, 0.9].map(|e| (add, e)))
        {
            let mut world = borne(add, colliders, restitution, 1.0);
            for &place in places {
                world.add_sphere(light_ball(place, 1.0).with_restitution(restitution)).unwrap();
            }
            run(&mut world, 3.0, 1.0 / 60.0);
            // A pile is followed to this part of a radius.
            let overlaps = world.overlaps(1e-9 * 0.1);
            assert!(overlaps.is_empty(), "{overlaps:?}: {colliders:?}, e = {restitution}");
        }
    }
}
