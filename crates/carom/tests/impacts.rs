//! Single impacts, and the laws they must obey: through the rule `bisect` unless a test says otherwise.
//! Bisection is set to place the contacts on frames' halves, so nothing there depends on the error of
//! a contact time.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::respond::{line_of_centres, reflection};
use carom::{
    BodyPair, Collider, CombineRule, Contact, DQuat, DVec3, Exact, Friction, Mass, Pose, Rule,
    Settings, Shape, Sphere, SphereId, World,
};
use common::{Numbers, assert_close, assert_close_vec, bisect, vec, world};

/// Two unit-diameter spheres that touch halfway through a frame of 1/2 s, given 2 m/s of closing speed.
fn head_on(first: Sphere, second: Sphere) -> (World, [Sphere; 2]) {
    let mut world = world(bisect());
    let ids = [world.add_sphere(first).unwrap(), world.add_sphere(second).unwrap()];
    world.step(0.5).unwrap();
    let spheres = ids.map(|id| world.sphere(id).unwrap());
    (world, spheres)
}

#[test]
fn elastic_head_on_of_equal_masses_swaps_velocities() {
    let first = Sphere::new(vec(0.0, 0.0, 0.0), 0.5).with_velocity(vec(1.0, 0.0, 0.0));
    let second = Sphere::new(vec(1.5, 0.0, 0.0), 0.5).with_velocity(vec(-1.0, 0.0, 0.0));
    let (world, [first, second]) = head_on(first, second);
    assert_eq!(first.velocity, vec(-1.0, 0.0, 0.0));
    assert_eq!(second.velocity, vec(1.0, 0.0, 0.0));
    let [impact] = world.report().impacts[..] else {
        panic!("one impact, not {:?}", world.report())
    };
    assert_eq!((impact.time, impact.approach_speed, impact.impulse), (0.25, 2.0, 2.0));
    assert_eq!((impact.point, impact.normal), (vec(0.75, 0.0, 0.0), DVec3::X));
    assert!(matches!(impact.between, BodyPair::Spheres(a, b) if a < b));
}

#[test]
fn unequal_masses_leave_as_the_one_dimensional_formula_says() {
    let (m1, m2, e) = (2.0, 3.0, 0.5);
    let first = Sphere::new(vec(0.0, 0.0, 0.0), 0.5).with_velocity(vec(1.0, 0.0, 0.0));
    let second = Sphere::new(vec(1.5, 0.0, 0.0), 0.5).with_velocity(vec(-1.0, 0.0, 0.0));
    let (_, [first, second]) =
        head_on(first.with_mass(m1).with_restitution(e), second.with_mass(m2));
    let momentum = m1 - m2;
    assert_close(first.velocity.x, (momentum - m2 * e * 2.0) / (m1 + m2), 1e-15);
    assert_close(second.velocity.x, (momentum + m1 * e * 2.0) / (m1 + m2), 1e-15);
}

#[test]
fn oblique_elastic_equal_masses_leave_at_right_angles() {
    let mut numbers = Numbers(3);
    for _ in 0..1000 {
        let normal = numbers.unit_vector();
        let velocity = numbers.vector();
        let Some(([v1, v2], _)) = line_of_centres([velocity, DVec3::ZERO], [1.0, 1.0], normal, 1.0)
        else {
            continue;
        };
        assert_close(v1.dot(v2), 0.0, 4.0 * f64::EPSILON);
        assert_close_vec(v1 + v2, velocity, 4.0 * f64::EPSILON);
    }
}

#[test]
fn impacts_keep_momentum_and_elastic_ones_energy() {
    let mut numbers = Numbers(4);
    for _ in 0..10_000 {
        let masses = [numbers.next(), numbers.next()].map(|x| 10f64.powf(6.0 * x - 3.0));
        let velocities = [numbers.vector(), numbers.vector()];
        let restitution = [numbers.next(), 1.0][usize::from(numbers.next() < 0.5)];
        let normal = numbers.unit_vector();
        let Some((after, impulse)) = line_of_centres(velocities, masses, normal, restitution)
        else {
            continue;
        };
        assert!(impulse > 0.0);
        let momentum = |v: [DVec3; 2]| masses[0] * v[0] + masses[1] * v[1];
        let size = masses[0] * velocities[0].length() + masses[1] * velocities[1].length();
        assert_close_vec(momentum(after), momentum(velocities), 1e-13 * size);
        let energy = |v: [DVec3; 2]| {
            0.5 * (masses[0] * v[0].length_squared() + masses[1] * v[1].length_squared())
        };
        // Lost energy: (1 - e²)/2 times reduced mass times approach speed squared.
        let approach = (velocities[1] - velocities[0]).dot(normal);
        let reduced = masses[0] * masses[1] / (masses[0] + masses[1]);
        let lost = 0.5 * (1.0 - restitution * restitution) * reduced * approach * approach;
        assert_close(energy(after), energy(velocities) - lost, 1e-13 * energy(velocities));
        let separation = (after[1] - after[0]).dot(normal);
        assert_close(separation, -restitution * approach, 1e-12);
    }
}

#[test]
fn bodies_that_part_are_left_alone() {
    let apart = [vec(-1.0, 0.0, 0.0), vec(1.0, 2.0, 0.0)];
    assert_eq!(line_of_centres(apart, [1.0, 1.0], DVec3::X, 1.0), None);
    assert_eq!(line_of_centres([DVec3::X, DVec3::X], [1.0, 1.0], DVec3::X, 1.0), None);
    assert_eq!(reflection(DVec3::Y, DVec3::Y, 1.0), None);
    assert_eq!(reflection(DVec3::X, DVec3::Y, 1.0), None);
}

#[test]
fn density_gives_the_mass_of_the_volume() {
    let mut world = world(bisect());
    let ball = Sphere::new(DVec3::ZERO, 0.3).with_density(7850.0);
    let id = world.add_sphere(ball).unwrap();
    let expected = 7850.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.027;
    let Mass::Kilograms(mass) = world.sphere(id).unwrap().mass else { panic!("a mass") };
    assert_close(mass, expected, 1e-12);
}

#[test]
fn restitution_of_a_pair_follows_the_selected_rule() {
    let rules = [
        (CombineRule::Product, 0.4),
        (CombineRule::Minimum, 0.5),
        (CombineRule::Maximum, 0.8),
        (CombineRule::Average, 0.65),
    ];
    for (combine_rule, expected) in rules {
        let settings = Settings::default().with_combine_rule(combine_rule);
        let mut world = World::new(settings).unwrap();
        let left = Sphere::new(vec(0.0, 0.0, 0.0), 0.5).with_velocity(vec(1.0, 0.0, 0.0));
        let right = Sphere::new(vec(1.5, 0.0, 0.0), 0.5).with_velocity(vec(-1.0, 0.0, 0.0));
        let left = world.add_sphere(left.with_restitution(0.5)).unwrap();
        let right = world.add_sphere(right.with_restitution(0.8)).unwrap();
        world.step(0.5).unwrap();
        let parting = world.sphere(right).unwrap().velocity - world.sphere(left).unwrap().velocity;
        assert_close(parting.x, 2.0 * expected, 1e-15);
    }
}

/// Momentum and angular momentum about its own centre \[kg m²/s\] that the impacts of the last step gave a
/// sphere, by the impulses that they report.
fn given(world: &World, sphere: &Sphere, id: SphereId) -> [DVec3; 2] {
    let mut momentum = DVec3::ZERO;
    let mut spin = DVec3::ZERO;
    for impact in &world.report().impacts {
        let (own, other) = match impact.between {
            BodyPair::Spheres(first, second) => (second, Some(first)),
            BodyPair::Collider { sphere, .. } => (sphere, None),
        };
        let (side, is_of) = if own == id { (1.0, true) } else { (-1.0, other == Some(id)) };
        if is_of {
            assert!(impact.tangential_impulse.dot(impact.normal).abs() < 1e-14);
            let impulse = side * (impact.impulse * impact.normal + impact.tangential_impulse);
            momentum += impulse;
            spin += (-side * sphere.radius * impact.normal).cross(impulse);
        }
    }
    [momentum, spin]
}

/// That what spheres got in a step is what the impulses of its impacts say, friction among them.
fn assert_impulses_account_for(mut world: World, spheres: &[Sphere], impacts: usize) {
    let ids: Vec<_> = spheres.iter().map(|it| world.add_sphere(*it).unwrap()).collect();
    world.step(0.5).unwrap();
    let reported = &world.report().impacts;
    assert_eq!(reported.len(), impacts, "{reported:?}");
    assert!(reported.iter().all(|it| it.tangential_impulse.length() > 0.01 * it.impulse));
    for (before, id) in spheres.iter().zip(ids) {
        let after = world.sphere(id).unwrap();
        let mass = before.kilograms();
        let inertia = 0.4 * mass * before.radius * before.radius;
        let [momentum, spin] = given(&world, before, id);
        // Roundings of one impact.
        assert_close_vec(mass * (after.velocity - before.velocity), momentum, 1e-13);
        let turned = inertia * (after.angular_velocity - before.angular_velocity);
        assert_close_vec(turned, spin, 1e-13);
    }
}

fn rough(position: DVec3, velocity: DVec3, spin: DVec3, mass: f64) -> Sphere {
    let sphere = Sphere::new(position, 0.5).with_mass(mass).with_velocity(velocity);
    sphere.with_angular_velocity(spin).with_friction(0.3).with_restitution(0.7)
}

#[test]
fn impulses_of_friction_tell_how_two_spheres_part_and_turn() {
    for rule in [Rule::from(Exact::default()), Contact::default().into()] {
        let spheres = [
            rough(vec(0.0, 0.0, 0.0), vec(1.0, 0.2, 0.0), vec(0.3, -2.0, 1.0), 2.0),
            rough(vec(1.5, 0.1, 0.0), vec(-2.0, 0.0, 0.3), vec(1.0, 0.5, 4.0), 3.0),
        ];
        assert_impulses_account_for(world(rule), &spheres, 1);
    }
}

#[test]
fn impulses_of_friction_tell_how_a_sphere_leaves_a_wall_or_a_corner() {
    let wall = |normal: DVec3| {
        let pose = Pose::at(DVec3::ZERO).rotated(DQuat::from_rotation_arc(DVec3::Y, normal));
        Collider::new(Shape::HalfSpace, pose)
    };
    for rule in [Rule::from(Exact::default()), Contact::default().into()] {
        let mut one = world(rule);
        one.add_collider(wall(DVec3::Y)).unwrap();
        let falls = rough(vec(0.0, 1.0, 0.0), vec(1.0, -2.0, 0.4), vec(3.0, 2.0, 1.0), 2.0);
        assert_impulses_account_for(one, &[falls], 1);
    }
    let mut corner = world(Exact::default());
    corner.add_collider(wall(DVec3::Y)).unwrap();
    corner.add_collider(wall(DVec3::X)).unwrap();
    let both = rough(vec(1.0, 1.0, 0.0), vec(-2.0, -2.0, 0.4), vec(3.0, 2.0, 1.0), 2.0);
    assert_impulses_account_for(corner, &[both], 2);
}

#[test]
fn no_impulse_of_friction_without_friction() {
    for rule in [Rule::from(Exact::default()), Contact::default().into(), bisect()] {
        let mut world = world(rule);
        for x in [0.0, 1.5] {
            let spin = vec(1.0, 2.0, 3.0);
            let sphere = rough(vec(x, 0.2 * x, 0.0), vec(2.0 - 1.5 * x, 0.0, 0.0), spin, 1.0);
            world.add_sphere(sphere.with_friction(Friction::default())).unwrap();
        }
        world.step(0.5).unwrap();
        let impacts = &world.report().impacts;
        assert!(!impacts.is_empty());
        assert!(impacts.iter().all(|it| it.tangential_impulse == DVec3::ZERO), "{impacts:?}");
    }
}
