//! Restitution that depends on the speed of approach, and pairs of materials with coefficients of their own: against
//! closed forms, under every rule.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{
    BodyPair, Collider, CombineRule, Contact, DVec3, Exact, Friction, Gravity, ImpactLaw,
    MaterialPair, Pose, RestitutionLaw, Rule, Settings, Shape, Sides, Sphere, SphereTangent, Tape,
    World,
};
use common::{G, Numbers, account_of_run, bisect, discrete, exact, run, vec, world};

const YIELDING: RestitutionLaw =
    RestitutionLaw::PowerLaw { restitution: 0.9, speed: 0.5, exponent: 0.25 };
const VISCOELASTIC: RestitutionLaw = RestitutionLaw::Viscoelastic { speed: 1e4 };
const CUTOFF: RestitutionLaw = RestitutionLaw::Cutoff { restitution: 0.7, speed: 0.5 };
const LAWS: [RestitutionLaw; 3] = [YIELDING, VISCOELASTIC, CUTOFF];

fn rules() -> [Rule; 4] {
    [Exact::default().into(), Contact::default().into(), discrete(), bisect()]
}

/// The laws as the papers write them.
fn closed_form(law: RestitutionLaw, speed: f64) -> f64 {
    match law {
        RestitutionLaw::PowerLaw { restitution, speed: v0, .. } => {
            restitution / (speed / v0).max(1.0).sqrt().sqrt()
        }
        RestitutionLaw::Viscoelastic { speed: v0 } => {
            let x = (speed / v0).powf(0.1);
            let below = 0.501086 * x + 1.15345 * x * x;
            (1.0 + 0.501086 * x) / (1.0 + below + 0.577977 * x.powi(3) + 0.532178 * x.powi(4))
        }
        RestitutionLaw::Cutoff { restitution, speed: v0 } => {
            if speed < v0 {
                1.0
            } else {
                restitution
            }
        }
        _ => unreachable!(),
    }
}

fn floor() -> Collider {
    Collider::new(Shape::HalfSpace, Pose::at(DVec3::ZERO))
}

fn with_gravity(mut world: World) -> World {
    world.add_force(Gravity::new(vec(0.0, -G, 0.0))).unwrap();
    world
}

#[test]
fn the_rebound_height_matches_each_law() {
    for law in LAWS {
        for height in [0.003, 0.4, 7.0] {
            let mut world = with_gravity(exact());
            world.add_collider(floor().with_restitution_law(law)).unwrap();
            let ball = world.add_sphere(Sphere::new(vec(0.0, height + 0.5, 0.0), 0.5)).unwrap();
            let speed = (2.0 * G * height).sqrt();
            let e = closed_form(law, speed);
            // To the impact, then to the top of the rebound.
            world.step(speed / G * 1.000001).unwrap();
            world.step(e * speed / G - 0.000001 * speed / G).unwrap();
            let top = world.sphere(ball).unwrap().position.y - 0.5;
            // Near the top a rounding of the time does not count; that of the radius added to the height does.
            assert!(
                (top - e * e * height).abs() < 1e-14 * (1.0 + height),
                "{law:?} {height}: {top}"
            );
        }
    }
}

#[test]
fn the_viscoelastic_law_begins_as_its_series() {
    // e = 1 - C1 x² + C2 x⁴ + O(x⁵), C1 = 1.15344, C2 = 0.79826 (Ramírez et al., Phys. Rev. E 60, 4465 (1999)).
    for x in [0.01_f64, 0.03, 0.1] {
        let e = RestitutionLaw::Viscoelastic { speed: 1.0 }.at(x.powi(10));
        let series = 1.0 - 1.15344 * x * x + 0.79826 * x.powi(4);
        assert!((e - series).abs() < 0.4 * x.powi(5) + 2e-5 * x * x, "{x}: {e} {series}");
    }
    // At high speeds all is lost, and no number overflows.
    let law = RestitutionLaw::Viscoelastic { speed: 1e-300 };
    assert!((0.0..1e-80).contains(&law.at(1e300)) && law.at(0.0) == 1.0);
}

#[test]
fn impacts_have_the_restitution_at_their_own_speed_under_every_rule() {
    for rule in rules() {
        for law in LAWS {
            for combine_rule in [CombineRule::Product, CombineRule::Minimum, CombineRule::Average] {
                for speed in [0.2, 3.0] {
                    let settings =
                        Settings::default().with_rule(rule).with_combine_rule(combine_rule);
                    let mut world = World::new(settings).unwrap();
                    let ball = |x: f64, vx: f64| {
                        Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0))
                    };
                    // A ball against a ball, and one against a wall, each with a law on one side.
                    let struck = ball(1.01, -0.25 * speed).with_restitution(0.8);
                    world.add_sphere(ball(0.0, 0.75 * speed).with_restitution_law(law)).unwrap();
                    world.add_sphere(struck).unwrap();
                    let wall = Pose::at(vec(0.0, -9.0, 0.0));
                    let wall = Collider::new(Shape::HalfSpace, wall).with_restitution_law(law);
                    world.add_collider(wall).unwrap();
                    let third = Sphere::new(vec(40.0, -8.49, 0.0), 0.5).with_restitution(0.8);
                    world.add_sphere(third.with_velocity(vec(0.0, -speed, 0.0))).unwrap();
                    let mut impacts = Vec::new();
                    for _ in 0..12 {
                        impacts.extend(world.step(1.0 / 120.0).unwrap().impacts.iter().copied());
                    }
                    assert_eq!(impacts.len(), 2, "{rule:?} {law:?}");
                    for impact in impacts {
                        let v = impact.approach_speed;
                        assert!((v - speed).abs() < 1e-12 * speed, "{rule:?}: {v}");
                        let e = combine_rule.combine(closed_form(law, v), 0.8);
                        let found = impact.separation_speed / v;
                        // Rounding of the sub-steps of `contact`.
                        assert!((found - e).abs() < 1e-12, "{rule:?} {law:?}: {found} {e}");
                    }
                }
            }
        }
    }
}

#[test]
fn in_a_group_a_contact_that_does_not_close_takes_the_speed_of_the_fastest() {
    // One ball hits two that touch, at rest: as balls whose coefficient is that at its speed, under each impact law.
    let run = |law: ImpactLaw, inelastic: &dyn Fn(Sphere) -> Sphere| {
        let settings = Settings::default().with_rule(Exact::default().with_impact_law(law));
        let settings = settings.with_combine_rule(CombineRule::Minimum);
        let mut world = World::new(settings).unwrap();
        for (x, speed) in [(-1.5, 2.0), (0.0, 0.0), (1.0, 0.0)] {
            let ball = Sphere::new(vec(x, 0.0, 0.0), 0.5).with_velocity(vec(speed, 0.0, 0.0));
            world.add_sphere(inelastic(ball)).unwrap();
        }
        world.step(0.3).unwrap();
        world.spheres().velocities().to_vec()
    };
    for law in [ImpactLaw::Sequential, ImpactLaw::Simultaneous, ImpactLaw::Reflection] {
        for by_speed in LAWS {
            let found = run(law, &|ball| ball.with_restitution_law(by_speed));
            let expected = run(law, &|ball| ball.with_restitution(by_speed.at(2.0)));
            assert_eq!(found, expected, "{law:?} {by_speed:?}");
        }
    }
}

#[test]
fn a_pair_of_materials_overrides_the_combine_rules_for_its_contacts_alone() {
    let (steel, felt, wood) = (1, 2, 3);
    for rule in rules() {
        for pair in [[steel, felt], [felt, steel]] {
            let mut world = common::world(rule);
            let [first, second] = pair;
            let given = MaterialPair::new(first, second).with_restitution(0.3);
            world.set_material_pairs([given, MaterialPair::new(wood, wood)]).unwrap();
            let ball = |x: f64, y: f64, vx: f64, material: u8| {
                let sphere = Sphere::new(vec(x, y, 0.0), 0.5).with_velocity(vec(vx, 0.0, 0.0));
                sphere.with_restitution(0.8).with_material(material)
            };
            let pairs = [(steel, felt), (felt, steel), (steel, steel), (steel, wood), (wood, wood)];
            for (row, (left, right)) in pairs.into_iter().enumerate() {
                let y = 3.0 * row as f64;
                world.add_sphere(ball(0.0, y, 1.0, left)).unwrap();
                world.add_sphere(ball(1.02, y, -1.0, right)).unwrap();
            }
            let (places, materials) = ([20.0, 30.0, 40.0], [steel, felt, 0]);
            for (x, material) in places.into_iter().zip(materials) {
                let wall = Collider::new(Shape::Sphere { radius: 0.5 }, Pose::at(vec(x, 0.0, 0.0)));
                world.add_collider(wall.with_material(felt).with_restitution(0.5)).unwrap();
                world.add_sphere(ball(x - 1.01, 0.0, 1.0, material)).unwrap();
            }
            let mut impacts = Vec::new();
            for _ in 0..6 {
                impacts.extend(world.step(1.0 / 120.0).unwrap().impacts.iter().copied());
            }
            assert_eq!(impacts.len(), 8, "{rule:?}");
            for impact in impacts {
                let expected = match impact.between {
                    BodyPair::Spheres(..) if impact.point.y < 4.0 => 0.3,
                    BodyPair::Spheres(..) => 0.64,
                    BodyPair::Collider { .. } if impact.point.x < 25.0 => 0.3,
                    BodyPair::Collider { .. } => 0.4,
                };
                let found = impact.separation_speed / impact.approach_speed;
                assert!((found - expected).abs() < 1e-12, "{rule:?} {impact:?}");
            }
        }
    }
}

#[test]
fn a_ball_slides_with_the_friction_of_its_pair_of_materials() {
    // Neither body has friction; the pair does. A sliding ball loses μ g t.
    for rule in [Rule::Exact(Exact::default()), Rule::Contact(Contact::default())] {
        let mut world = with_gravity(common::world(rule));
        world.add_collider(floor().with_material(2)).unwrap();
        let ball = Sphere::new(vec(0.0, 0.5, 0.0), 0.5).with_velocity(vec(3.0, 0.0, 0.0));
        let ball = world.add_sphere(ball.with_material(1).with_restitution(0.0)).unwrap();
        let felt = MaterialPair::new(2, 1).with_friction(Friction::sliding(0.2));
        world.set_material_pairs([felt]).unwrap();
        run(&mut world, 0.2, 0.01);
        let speed = world.sphere(ball).unwrap().velocity.x;
        assert!((speed - (3.0 - 0.2 * G * 0.2)).abs() < 1e-9, "{rule:?}: {speed}");
    }
}

#[test]
fn invalid_laws_and_pairs_are_refused() {
    let mut world = World::default();
    let power =
        |restitution, speed, exponent| RestitutionLaw::PowerLaw { restitution, speed, exponent };
    for law in [
        power(1.1, 1.0, 0.25),
        power(0.9, 0.0, 0.25),
        power(0.9, 1.0, -0.1),
        power(f64::NAN, 1.0, 0.25),
        RestitutionLaw::Viscoelastic { speed: f64::INFINITY },
        RestitutionLaw::Cutoff { restitution: -0.1, speed: 1.0 },
    ] {
        assert!(world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_restitution_law(law)).is_err());
        assert!(world.add_collider(floor().with_restitution_law(law)).is_err());
        let pair = MaterialPair::new(1, 2).with_restitution_law(law);
        assert!(world.set_material_pairs([pair]).is_err(), "{law:?}");
    }
    let pair = MaterialPair::new(1, 2).with_restitution(0.5);
    assert!(world.set_material_pairs([pair, MaterialPair::new(2, 1)]).is_err());
    assert!(world.set_material_pairs([MaterialPair::new(0, 1)]).is_err());
    assert!(world.set_material_pairs([pair.with_restitution(-0.5)]).is_err());
    assert!(world.material_pairs().is_empty());
    world.set_material_pairs([pair]).unwrap();
    assert_eq!(world.material_pairs(), [pair]);
}

#[test]
fn a_coefficient_set_later_replaces_the_law() {
    let mut world = exact();
    world.add_collider(floor()).unwrap();
    let ball = Sphere::new(vec(0.0, 1.0, 0.0), 0.5).with_velocity(vec(0.0, -2.0, 0.0));
    let ball = world.add_sphere(ball.with_restitution_law(YIELDING)).unwrap();
    let changed = world.sphere(ball).unwrap().with_restitution(0.5);
    world.set_sphere(ball, changed).unwrap();
    world.step(0.5).unwrap();
    assert_eq!(world.sphere(ball).unwrap().velocity.y, 1.0);
}

/// Rough balls of three sizes and laws, one material of which has a pair, in a container; all lengths times `size`.
fn heap(rule: Rule, size: f64) -> World {
    let mut world = world(rule);
    world.add_force(Gravity::new(vec(0.0, -G * size, 0.0))).unwrap();
    let open = Sides { top: true, ..Sides::default() };
    let walls = Shape::Container { size: DVec3::splat(2.0 * size), open };
    let walls = Collider::new(walls, Pose::at(vec(0.0, size, 0.0))).with_restitution(0.8);
    world.add_collider(walls.with_friction(0.3).with_material(1)).unwrap();
    let law = |number: usize| match LAWS[number % 3] {
        RestitutionLaw::PowerLaw { restitution, speed, exponent } => {
            RestitutionLaw::PowerLaw { restitution, speed: speed * size, exponent }
        }
        RestitutionLaw::Viscoelastic { speed } => {
            RestitutionLaw::Viscoelastic { speed: speed * size }
        }
        RestitutionLaw::Cutoff { restitution, .. } => {
            RestitutionLaw::Cutoff { restitution, speed: 0.02 * size }
        }
        other => other,
    };
    let mut numbers = Numbers(7);
    for number in 0..27 {
        let [x, y, z] = [number % 3, number / 9, number / 3 % 3].map(|it| it as f64);
        let place = 0.6 * vec(x - 1.0, y + 0.6, z - 1.0) + 0.02 * numbers.vector();
        let sphere = Sphere::new(size * place, (0.2 + 0.05 * numbers.next()) * size);
        let sphere = sphere.with_restitution_law(law(number)).with_friction(0.3);
        world.add_sphere(sphere.with_material((number % 4) as u8)).unwrap();
    }
    let pair = MaterialPair::new(2, 1).with_restitution_law(law(1)).with_friction(0.5);
    world.set_material_pairs([pair]).unwrap();
    world
}

#[test]
fn heaps_of_each_law_keep_their_account_and_do_not_hang() {
    for rule in rules() {
        let mut world = heap(rule, 1.0);
        let before = world.total_energy();
        let (account, left) = account_of_run(&mut world, 180, 1.0 / 60.0);
        // The other rules do not account for what overlaps change.
        let has_account = matches!(rule, Rule::Exact(_) | Rule::Contact(_));
        assert!(!has_account || left.abs() < 1e-9 * before, "{rule:?}: {left} of {before}");
        assert!(world.total_energy() < before, "{rule:?}: {account:?}");
        let lowest = world.spheres().positions().iter().map(|it| it.y).fold(9.0, f64::min);
        assert!(lowest > 0.15, "{rule:?}: {lowest}");
    }
}

#[test]
fn a_gas_of_another_size_has_the_same_course() {
    // Without gravity; powers of two are exact, also in the ratio of speeds that laws depend on.
    let run = |size: f64| {
        let mut world = heap(Exact::default().into(), size);
        let force = world.forces().next().unwrap().0;
        world.remove_force(force).unwrap();
        for (number, id) in world.spheres().ids().to_vec().into_iter().enumerate() {
            let sphere = world.sphere(id).unwrap();
            let velocity = Numbers(number as u64 + 5).vector();
            world.set_sphere(id, sphere.with_velocity(2.0 * size * velocity)).unwrap();
        }
        let impacts = common::run(&mut world, 1.0, 1.0 / 60.0);
        let places: Vec<DVec3> = world.spheres().positions().iter().map(|it| *it / size).collect();
        (impacts, places)
    };
    let usual = run(1.0);
    assert!(usual.0 > 50);
    for size in [2.0_f64.powi(-20), 2.0_f64.powi(20)] {
        assert_eq!(run(size), usual, "{size}");
    }
}

#[test]
fn a_world_with_laws_and_pairs_goes_on_from_a_snapshot_with_the_same_bits() {
    for rule in rules() {
        let mut world = heap(rule, 1.0);
        run(&mut world, 20.0 / 60.0, 1.0 / 60.0);
        let snapshot = world.snapshot();
        run(&mut world, 20.0 / 60.0, 1.0 / 60.0);
        let hash = world.state_hash();
        world.set_material_pairs([]).unwrap();
        world.restore(&snapshot);
        assert_eq!(world.material_pairs().len(), 1);
        run(&mut world, 20.0 / 60.0, 1.0 / 60.0);
        assert_eq!(world.state_hash(), hash, "{rule:?}");
    }
}

#[test]
fn a_ball_comes_to_rest_unless_its_law_is_elastic_at_low_speeds() {
    let run = |law: RestitutionLaw, seconds: f64| {
        let mut world = with_gravity(exact());
        world.add_collider(floor()).unwrap();
        let ball = Sphere::new(vec(0.0, 0.6, 0.0), 0.5).with_restitution_law(law);
        world.add_sphere(ball).unwrap();
        let impacts = common::run(&mut world, seconds, 1.0 / 60.0);
        (impacts, world.contacts().len(), world.kinetic_energy())
    };
    for law in [YIELDING, VISCOELASTIC] {
        let (impacts, contacts, energy) = run(law, 20.0);
        assert!(impacts < 10_000 && contacts == 1 && energy == 0.0, "{law:?}: {impacts}");
    }
    // Below its speed the ball bounces as an elastic one, for ever and without loss.
    let (impacts, contacts, _) = run(CUTOFF, 20.0);
    assert!((100..10_000).contains(&impacts) && contacts == 0, "{impacts}");
}

#[test]
fn derivatives_of_a_bounce_include_the_change_of_restitution_with_speed() {
    let (height, end) = (1.5, 0.9);
    for law in [YIELDING, VISCOELASTIC] {
        let place = |height: f64, down: f64| {
            let speed = (down * down + 2.0 * G * height).sqrt();
            let left = end - (speed - down) / G;
            closed_form(law, speed) * speed * left - 0.5 * G * left * left
        };
        let mut world = with_gravity(exact());
        world.add_collider(floor()).unwrap();
        let start = Sphere::new(vec(0.0, height + 0.25, 0.0), 0.25).with_restitution_law(law);
        let ball = world.add_sphere(start.with_velocity(vec(0.3, -0.7, 0.0))).unwrap();
        let mut tape = Tape::start(&world).unwrap();
        tape.step(&mut world, end).unwrap();
        let along = SphereTangent { position: DVec3::Y, ..SphereTangent::default() };
        let gradient = tape.gradient(&[(ball, along)]).unwrap();
        let d = 1e-5;
        let by_height = (place(height + d, 0.7) - place(height - d, 0.7)) / (2.0 * d);
        let by_speed = -(place(height, 0.7 + d) - place(height, 0.7 - d)) / (2.0 * d);
        let found = gradient.sphere(ball);
        // Central differences are off by the square of the step, and by rounding over it.
        assert!((found.position.y - by_height).abs() < 1e-8, "{law:?}: {found:?} {by_height}");
        assert!((found.velocity.y - by_speed).abs() < 1e-8, "{law:?}: {found:?} {by_speed}");
        assert_eq!(found.restitution, 0.0);
    }
}
