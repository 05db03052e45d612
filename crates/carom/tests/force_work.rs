//! The work of forces without a potential in the energy account, against closed forms; the account of each rule closes
//! beside each force. These tests prove nothing of forces that have a potential.

mod common;

use std::f64::consts::PI;

use carom::{
    Bisect, Buoyancy, Collider, Contact, DVec3, Discrete, Exact, Force, Gravity, Integrator,
    Interaction, Pose, QuadraticDrag, Rule, Shape, Sides, Sphere, SphereState, SphereStates,
    Spring, ViscousDrag, Vortex, Wind, World,
};
use common::{Numbers, account_of_run, assert_close, vec, world};

const FRAME: f64 = 1.0 / 60.0;

fn exact() -> Rule {
    Exact::default().into()
}

fn contact() -> Rule {
    Contact::default().into()
}

/// A ball of 2 kg and 0.1 m that flies at 3 m/s.
fn ball() -> Sphere {
    Sphere::new(DVec3::ZERO, 0.1).with_mass(2.0).with_velocity(vec(3.0, 0.0, 0.0))
}

#[test]
fn linear_drag_takes_what_the_exponential_loses() {
    let mut world = world(exact());
    world.add_force(ViscousDrag::new(0.8)).unwrap();
    world.add_sphere(ball()).unwrap();
    let (account, rest) = account_of_run(&mut world, 90, FRAME);
    // v = v0 e^-γt with γ = 0.4/s, over 1.5 s.
    assert_close(account.forces, 9.0 * libm::expm1(-2.0 * 0.4 * 1.5), 1e-14 * 9.0);
    assert_close(rest, 0.0, 1e-14 * 9.0);
}

#[test]
fn quadratic_drag_takes_what_the_hyperbola_loses() {
    for frame in [FRAME, 0.5] {
        let mut world = world(exact());
        world.add_force(QuadraticDrag::new(5.0)).unwrap();
        world.add_sphere(ball()).unwrap();
        let (account, rest) = account_of_run(&mut world, (1.5 / frame) as usize, frame);
        // v = v0 / (1 + v0 t k / m) with k = rho c A / 2.
        let k = 0.5 * 5.0 * 0.44 * PI * 0.01;
        let v = 3.0 / (1.0 + 3.0 * 1.5 * k / 2.0);
        assert_close(account.forces, v * v - 9.0, 1e-12 * 9.0);
        assert_close(rest, 0.0, 1e-12 * 9.0);
    }
}

#[test]
fn wind_gives_a_ball_at_rest_its_energy() {
    let mut world = world(exact());
    world.add_force(Wind::new(vec(2.0, 0.0, 1.0), 0.5)).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.1).with_mass(0.7)).unwrap();
    let (account, _) = account_of_run(&mut world, 60, FRAME);
    // v = u (1 - e^-γt)
    let part = -libm::expm1(-0.5 / 0.7);
    assert_close(account.forces, 0.5 * 0.7 * 5.0 * part * part, 1e-14);
}

#[test]
fn vortex_does_the_work_that_becomes_kinetic_energy() {
    let mut world = world(exact());
    let vortex = Vortex::new(vec(0.5, 0.0, 0.2), 9.0, 0.6).with_axis(vec(0.2, 1.0, 0.0));
    world.add_force(vortex.with_core_radius(0.4)).unwrap();
    world.add_sphere(ball()).unwrap();
    let before = world.kinetic_energy();
    let (account, _) = account_of_run(&mut world, 180, FRAME);
    assert!((world.kinetic_energy() - before).abs() > 0.1 * before);
    assert_close(account.forces, world.kinetic_energy() - before, 1e-12 * before);
}

/// Two balls of 1 kg on a damped spring, which is stretched by 0.2 m: of their distance y from rest
/// `y = 0.2 e^-bt (cos wt + b/w sin wt)` with b = c/m, w² = 2 k/m - b².
#[test]
fn damper_takes_what_the_damped_oscillation_loses() {
    for damping in [0.3, 2.0] {
        let mut world = world(exact());
        let at = |x: f64| Sphere::new(vec(x, 0.0, 0.0), 0.1).with_mass(1.0);
        let first = world.add_sphere(at(0.0)).unwrap();
        let second = world.add_sphere(at(1.2)).unwrap();
        let spring = Spring::between(first, second, 1.0).with_stiffness(50.0);
        world.add_spring(spring.with_damping(damping)).unwrap();
        let (account, rest) = account_of_run(&mut world, 120, FRAME);
        let (b, t) = (damping, 2.0);
        let w = (100.0 - b * b).sqrt();
        let (sin, cos) = (libm::sin(w * t), libm::cos(w * t));
        let y = 0.2 * libm::exp(-b * t) * (cos + b / w * sin);
        let rate = -0.2 * libm::exp(-b * t) * (w + b * b / w) * sin;
        let left = 0.25 * rate * rate + 25.0 * y * y;
        assert_close(account.forces, left - 1.0, 1e-12);
        assert_close(rest, 0.0, 1e-12);
    }
}

#[test]
fn damper_of_a_thread_works_only_while_it_pulls() {
    let mut world = world(exact());
    let ball = world.add_sphere(ball()).unwrap();
    let thread = Spring::to_point(ball, vec(0.0, 0.5, 0.0), 1.0).with_stiffness(200.0);
    world.add_spring(thread.with_damping(4.0).with_only_pulls(true)).unwrap();
    let slack = account_of_run(&mut world, 15, FRAME).0;
    assert_eq!(slack.forces, 0.0);
    let (account, rest) = account_of_run(&mut world, 120, FRAME);
    assert!(account.forces < -0.1 * 9.0);
    assert_close(rest, 0.0, 1e-11 * 9.0);
}

#[test]
fn applied_force_does_the_work_of_its_way_under_every_rule() {
    for rule in [exact(), contact(), Discrete::default().into(), Bisect::default().into()] {
        let mut world = world(rule);
        world.add_sphere(ball()).unwrap();
        world.set_applied_forces(&[vec(4.0, 2.0, 0.0)]).unwrap();
        let (account, rest) = account_of_run(&mut world, 60, FRAME);
        // v = (3, 0) + (2, 1) t
        assert_close(account.applied, 25.0 + 1.0 - 9.0, 1e-12);
        assert_eq!(account.forces, 0.0);
        assert_close(rest, 0.0, 1e-12);
    }
}

/// A trap that moves: it does work beyond its potential energy.
#[derive(Debug)]
struct MovingTrap {
    is_conservative: bool,
}

impl Force for MovingTrap {
    fn on(&self, sphere: &SphereState, time: f64) -> DVec3 {
        -8.0 * (sphere.position - time * DVec3::X)
    }

    fn potential_energy(&self, sphere: &SphereState, time: f64) -> f64 {
        4.0 * (sphere.position - time * DVec3::X).length_squared()
    }

    fn is_conservative(&self) -> bool {
        self.is_conservative
    }
}

#[test]
fn work_of_a_force_of_a_program_is_what_its_potential_leaves() {
    // Seen from the trap the ball starts with -1 m/s and swings at w = 2/s: its velocity is 1 - cos 2t.
    let (t, m) = (1.0, 2.0);
    let (v, x) = (1.0 - libm::cos(2.0 * t), -0.5 * libm::sin(2.0 * t));
    let energy = 0.5 * m * v * v + 4.0 * x * x;
    for (is_conservative, own) in [(false, energy), (true, 0.0)] {
        let mut world = world(exact());
        world.add_force(MovingTrap { is_conservative }).unwrap();
        world.add_sphere(Sphere::new(DVec3::ZERO, 0.1).with_mass(m)).unwrap();
        let (account, rest) = account_of_run(&mut world, 60, FRAME);
        assert_close(account.forces, own, 1e-12);
        assert_close(rest, energy - own, 1e-12);
    }
}

/// Friction between all spheres, `-k (v1 - v2)`.
#[derive(Debug)]
struct Alignment(f64);

impl Force for Alignment {
    fn on(&self, _sphere: &SphereState, _time: f64) -> DVec3 {
        DVec3::ZERO
    }

    fn interaction(&self) -> Option<&dyn Interaction> {
        Some(self)
    }
}

impl Interaction for Alignment {
    fn add_forces(&self, spheres: &SphereStates, _time: f64, forces: &mut [DVec3]) {
        for i in 0..spheres.len() {
            for j in 0..i {
                let force = self.0 * (spheres.velocities[j] - spheres.velocities[i]);
                forces[i] += force;
                forces[j] -= force;
            }
        }
    }
}

#[test]
fn interaction_of_a_program_is_accounted_for_under_every_rule() {
    for rule in [exact(), contact(), Discrete::default().into(), Bisect::default().into()] {
        let mut world = gas(rule, 12, 1.0);
        world.add_force(Alignment(0.05)).unwrap();
        let largest = world.total_energy();
        let (account, rest) = account_of_run(&mut world, 30, FRAME);
        assert!(account.forces < -0.1 * largest, "{rule:?}: {account:?}");
        // Impacts under `contact` move spheres at their own times.
        assert_close(rest, 0.0, 1e-12 * largest);
    }
}

/// Balls in a box.
fn gas(rule: Rule, count: usize, restitution: f64) -> World {
    let mut world = world(rule);
    let shape = Shape::Container { size: DVec3::splat(4.0), open: Sides::NONE };
    let walls = Collider::new(shape, Pose::at(DVec3::ZERO));
    world.add_collider(walls.with_restitution(restitution)).unwrap();
    let mut numbers = Numbers(7);
    for number in 0..count {
        let place = 1.7 * numbers.vector();
        let sphere = Sphere::new(place, 0.08).with_velocity(2.0 * numbers.vector());
        world.add_sphere(sphere.with_mass(0.3 + 0.1 * (number % 4) as f64)).unwrap();
    }
    world
}

/// Adds a force by its name to a world.
fn add_force(world: &mut World, name: &str) {
    let ids = world.spheres().ids().to_vec();
    let spring = |index: usize| Spring::between(ids[index], ids[index + 1], 0.8);
    match name {
        "drag" => world.add_force(ViscousDrag::new(0.1)).map(drop),
        "wind" => world.add_force(Wind::new(vec(1.0, 0.5, 0.0), 0.1)).map(drop),
        "quadratic drag" => world.add_force(QuadraticDrag::new(30.0)).map(drop),
        "drag by Reynolds number" => {
            world.add_force(QuadraticDrag::new(30.0).with_viscosity(0.1)).map(drop)
        }
        "vortex" => world.add_force(Vortex::new(vec(0.3, 0.0, 0.0), 6.0, 0.1)).map(drop),
        "damper" => world.add_spring(spring(0).with_stiffness(3.0).with_damping(0.2)).map(drop),
        "applied" => world.set_applied_forces(&vec![vec(0.1, -0.2, 0.05); ids.len()]),
        _ => unreachable!("{name}"),
    }
    .unwrap();
}

const FORCES: [&str; 7] =
    ["drag", "wind", "quadratic drag", "drag by Reynolds number", "vortex", "damper", "applied"];

#[test]
fn account_of_exact_closes_beside_each_force() {
    for name in FORCES {
        for friction in [0.0, 0.3] {
            let mut world = gas(exact(), 12, 0.8);
            world.add_force(Gravity::new(vec(0.0, -3.0, 0.0))).unwrap();
            world.add_force(Buoyancy::new(20.0, -1.0)).unwrap();
            add_force(&mut world, name);
            let ids = world.spheres().ids().to_vec();
            for id in ids {
                let sphere = world.sphere(id).unwrap();
                world.set_sphere(id, sphere.with_friction(friction)).unwrap();
            }
            let largest = world.total_energy().abs() + world.kinetic_energy();
            let (account, rest) = account_of_run(&mut world, 24, FRAME);
            assert!(account.forces != 0.0 || account.applied != 0.0, "{name}");
            assert!(!world.was_stepped());
            assert!(rest.abs() < 1e-9 * largest, "{name}: {rest} of {largest}: {account:?}");
        }
    }
}

#[test]
fn account_of_stepped_rules_closes_beside_each_force_that_is_alone() {
    let euler = [Integrator::SemiImplicitEuler, Integrator::ExplicitEuler];
    let schemes = euler.into_iter().chain([Integrator::VelocityVerlet]);
    let stepped = schemes.flat_map(|scheme| -> [Rule; 2] {
        [
            Discrete::default().with_integrator(scheme).into(),
            Bisect::default().with_integrator(scheme).into(),
        ]
    });
    for rule in stepped.chain([contact()]) {
        // A spring has a potential, too, which these schemes follow with an error.
        for name in FORCES.into_iter().filter(|name| *name != "damper") {
            let mut world = gas(rule, 12, 0.8);
            add_force(&mut world, name);
            let largest = world.total_energy();
            let (account, rest) = account_of_run(&mut world, 30, FRAME);
            assert!(account.forces != 0.0 || account.applied != 0.0, "{name}");
            let error = rest.abs() / largest;
            assert!(error < 1e-12, "{rule:?}, {name}: {error:e}: {account:?}");
        }
    }
}

#[test]
fn what_runge_and_kutta_leave_of_the_account_falls_with_the_fourth_order() {
    for name in FORCES.into_iter().filter(|name| *name != "applied") {
        let rest = |parts: f64| {
            let rule = Discrete::default().with_integrator(Integrator::RungeKutta4);
            let mut world = gas(rule.into(), 2, 1.0);
            add_force(&mut world, name);
            account_of_run(&mut world, (24.0 * parts) as usize, 0.02 / parts).1
        };
        let [coarse, fine] = [1.0, 2.0].map(rest);
        // The ratio is 16 for small steps; the rest is rounding of energies of 3 J.
        assert!(fine.abs() < coarse.abs() / 12.0 + 1e-14, "{name}: {coarse:e} {fine:e}");
    }
}

#[test]
fn a_ball_that_wind_presses_to_a_wall_gets_nothing_from_it() {
    for rule in [exact(), contact()] {
        let mut world = world(rule);
        world.add_collider(Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))).unwrap();
        world.add_force(Wind::new(vec(0.0, -5.0, 0.0), 2.0)).unwrap();
        let resting = Sphere::new(vec(0.0, 0.1, 0.0), 0.1).with_restitution(0.3);
        world.add_sphere(resting).unwrap();
        let (account, rest) = account_of_run(&mut world, 60, FRAME);
        assert_close(account.forces, 0.0, 1e-13);
        assert_close(rest, 0.0, 1e-13);
    }
}

#[test]
fn a_ball_that_rolls_in_air_loses_what_friction_and_drag_take() {
    let mut world = world(exact());
    world.add_force(Gravity::new(vec(0.0, -9.81, 0.0))).unwrap();
    world.add_force(ViscousDrag::new(0.3)).unwrap();
    let floor = Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO)).with_friction(0.4);
    world.add_collider(floor).unwrap();
    let ball = ball().with_position(vec(0.0, 0.1, 0.0));
    world.add_sphere(ball).unwrap();
    let largest = world.kinetic_energy();
    let (account, rest) = account_of_run(&mut world, 120, FRAME);
    assert!(account.forces < -0.1 * largest && account.contacts < -0.1 * largest, "{account:?}");
    assert!(rest.abs() < 1e-9 * largest, "{rest} of {largest}: {account:?}");
}
