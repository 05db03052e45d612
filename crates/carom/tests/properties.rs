//! Random worlds: whatever is in them, a step neither panics nor makes a NaN, and without forces
//! and walls momentum stays. Has nothing to say about accuracy.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{
    Bisect, Collider, CombineRule, ConstantForce, Contact, DQuat, DVec3, Discrete, Emitter, Error,
    Exact, Friction, Gravity, Integrator, Pose, Rule, Settings, Shape, Sphere, ViscousDrag,
    WindBack, World,
};
use proptest::prelude::*;

fn vector(size: f64) -> impl Strategy<Value = DVec3> {
    let part = -size..size;
    (part.clone(), part.clone(), part).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn rotation() -> impl Strategy<Value = DQuat> {
    (vector(1.0), 0.01..1.0).prop_map(|(v, w)| DQuat::from_xyzw(v.x, v.y, v.z, w))
}

/// Radii and masses over six orders of magnitude, speeds from rest to absurd.
fn sphere() -> impl Strategy<Value = Sphere> {
    let velocity = prop_oneof![Just(DVec3::ZERO), vector(1.0), vector(1e4)];
    let rest = (0.0..=1.0, friction(), vector(10.0));
    (vector(5.0), velocity, -3.0..0.5, -3.0..3.0, rest).prop_map(
        |(position, velocity, radius, mass, (restitution, friction, angular_velocity))| {
            Sphere::new(position, 10f64.powf(radius))
                .with_velocity(velocity)
                .with_angular_velocity(angular_velocity)
                .with_mass(10f64.powf(mass))
                .with_restitution(restitution)
                .with_friction(friction)
        },
    )
}

fn friction() -> impl Strategy<Value = Friction> {
    let coefficient = 0.0..2.0;
    let all = (coefficient.clone(), coefficient.clone(), coefficient, 0.0..=1.0);
    prop_oneof![
        Just(Friction::default()),
        all.prop_map(|(sliding, rolling, spinning, tangential)| {
            Friction::sliding(sliding)
                .with_rolling(rolling)
                .with_spinning(spinning)
                .with_tangential_restitution(tangential)
        }),
    ]
}

fn collider() -> impl Strategy<Value = Collider> {
    let shape = prop_oneof![
        (0.01..3.0).prop_map(|radius| Shape::Sphere { radius }),
        (0.01..9.0, 0.01..9.0).prop_map(|(size_x, size_z)| Shape::Rectangle { size_x, size_z }),
        Just(Shape::HalfSpace),
        (0.01..3.0, 0.01..3.0, 0.01..3.0)
            .prop_map(|(x, y, z)| Shape::Box { size: DVec3::new(x, y, z) }),
    ];
    (shape, vector(5.0), rotation(), (0.0..=1.0, friction()), any::<bool>()).prop_map(
        |(shape, position, rotation, (restitution, friction), trigger)| {
            let pose = Pose::at(position).rotated(rotation);
            let solid = Collider::new(shape, pose).with_restitution(restitution);
            let solid = solid.with_friction(friction);
            if trigger { solid.as_trigger() } else { solid }
        },
    )
}

fn settings() -> impl Strategy<Value = Settings> {
    let bisect = (0.0..1e-3, 1..12u32, 1..20u32, any::<bool>()).prop_map(
        |(tolerance, max_halvings, max_impacts, all)| {
            let wind_back = if all { WindBack::All } else { WindBack::Touched };
            let bisect = Bisect::default().with_tolerance(tolerance).with_wind_back(wind_back);
            Rule::Bisect(bisect.with_max_halvings(max_halvings).with_max_impacts(max_impacts))
        },
    );
    // Spheres that overlap from the start may be wedged in, and meet without end.
    let exact = Rule::Exact(Exact::default().with_max_impacts(10_000));
    let contact = (1..12u32, 1..5u32).prop_map(|(sub_steps, sweeps)| {
        Rule::Contact(Contact::default().with_sub_steps(sub_steps).with_sweeps(sweeps))
    });
    let discrete = Just(Rule::Discrete(Discrete::default()));
    let rule = prop_oneof![discrete, bisect, Just(exact), contact];
    let integrator = prop::sample::select(vec![
        Integrator::SemiImplicitEuler,
        Integrator::ExplicitEuler,
        Integrator::VelocityVerlet,
        Integrator::RungeKutta4,
    ]);
    let combine_rule = prop::sample::select(vec![
        CombineRule::Product,
        CombineRule::Minimum,
        CombineRule::Maximum,
        CombineRule::Average,
        CombineRule::GeometricMean,
    ]);
    (rule, integrator, combine_rule, any::<bool>()).prop_map(
        |(rule, integrator, combine_rule, spheres_collide)| {
            let rule = match rule {
                Rule::Discrete(discrete) => discrete.with_integrator(integrator).into(),
                Rule::Bisect(bisect) => bisect.with_integrator(integrator).into(),
                other => other,
            };
            let settings = Settings::default().with_rule(rule).with_combine_rule(combine_rule);
            settings.with_spheres_collide(spheres_collide)
        },
    )
}

fn emitter() -> impl Strategy<Value = Emitter> {
    (sphere(), vector(5.0), rotation(), 0.01..1.0, prop::option::of(1..5u32)).prop_map(
        |(sphere, position, rotation, period, max_spheres)| {
            Emitter::new(sphere, period)
                .with_position(position)
                .with_rotation(rotation)
                .with_max_spheres(max_spheres)
        },
    )
}

/// Numbers that no field takes.
fn bad_number() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(f64::NAN),
        Just(f64::INFINITY),
        Just(f64::NEG_INFINITY),
        (1e-300..1e300).prop_map(|x: f64| -x),
    ]
}

/// A vector with one part that is not finite.
fn bad_vector() -> impl Strategy<Value = DVec3> {
    let part = prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(f64::NEG_INFINITY)];
    (vector(1e3), 0..3usize, part).prop_map(|(mut vector, axis, part)| {
        vector[axis] = part;
        vector
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn random_worlds_neither_panic_nor_make_nan(
        settings in settings(),
        spheres in prop::collection::vec(sphere(), 0..30),
        colliders in prop::collection::vec(collider(), 0..12),
        emitters in prop::collection::vec(emitter(), 0..3),
        (gravity, push, drag) in (vector(20.0), vector(5.0), 0.0..1.0),
        frames in prop::collection::vec(0.001..0.1, 1..8),
    ) {
        let mut world = World::new(settings).unwrap();
        world.add_force(Gravity::new(gravity)).unwrap();
        world.add_force(ConstantForce::new(push)).unwrap();
        world.add_force(ViscousDrag::new(drag)).unwrap();
        for collider in colliders {
            world.add_collider(collider).unwrap();
        }
        for emitter in emitters {
            world.add_emitter(emitter).unwrap();
        }
        for sphere in spheres {
            world.add_sphere(sphere).unwrap();
        }
        for h in frames {
            // Explicit schemes under stiff drag may blow up, but then the step says so.
            let Ok(report) = world.step(h) else { break };
            for impact in &report.impacts {
                prop_assert!((0.0..=h).contains(&impact.time));
                prop_assert!(impact.approach_speed.is_finite() && impact.impulse >= 0.0);
                prop_assert!((impact.normal.length() - 1.0).abs() < 1e-12);
                prop_assert!(impact.point.is_finite());
            }
            prop_assert!(report.impacts.is_sorted_by(|a, b| a.time <= b.time));
            for entry in report.ledger().filter(|entry| entry.group.count == 1) {
                prop_assert!(entry.impact.approach_speed > 0.0);
            }
            let spheres = world.spheres();
            prop_assert!(spheres.positions().iter().all(|x| x.is_finite()));
            prop_assert!(spheres.velocities().iter().all(|v| v.is_finite()));
            prop_assert!(spheres.ids().is_sorted());
        }
    }

    #[test]
    fn bad_numbers_are_refused_with_the_name_of_their_field(
        sphere in sphere(),
        collider in collider(),
        emitter in emitter(),
        (number, place) in (bad_number(), bad_vector()),
    ) {
        let turned = DQuat::from_xyzw(place.x, place.y, place.z, 0.5);
        let spheres = [
            ("position", sphere.with_position(place)),
            ("velocity", sphere.with_velocity(place)),
            ("radius", sphere.with_radius(number)),
            ("mass", sphere.with_mass(number)),
            ("density", sphere.with_density(number)),
            ("restitution", sphere.with_restitution(number)),
        ];
        let of_shape = |shape| collider.clone().with_shape(shape);
        let colliders = [
            ("position", collider.clone().with_pose(Pose { position: place, ..collider.pose })),
            ("rotation", collider.clone().with_pose(collider.pose.rotated(turned))),
            ("restitution", collider.clone().with_restitution(number)),
            ("radius", of_shape(Shape::Sphere { radius: number })),
            ("size_x", of_shape(Shape::Rectangle { size_x: number, size_z: 1.0 })),
            ("size_z", of_shape(Shape::Rectangle { size_x: 1.0, size_z: number })),
            ("size.x", of_shape(Shape::Box { size: DVec3::new(number, 1.0, 1.0) })),
            ("size.y", of_shape(Shape::Box { size: DVec3::new(1.0, number, 1.0) })),
            ("size.z", of_shape(Shape::Box { size: DVec3::new(1.0, 1.0, number) })),
        ];
        let mut emitters = vec![
            ("position", emitter.with_position(place)),
            ("rotation", emitter.with_rotation(turned)),
            ("period", emitter.with_period(number)),
        ];
        emitters.extend(spheres.map(|(field, sphere)| (field, emitter.with_sphere(sphere))));

        let mut world = World::default();
        let before = world.state_hash();
        let mut refusals = Vec::new();
        for (field, sphere) in spheres {
            refusals.push((field, world.add_sphere(sphere).err()));
        }
        for (field, collider) in colliders {
            refusals.push((field, world.add_collider(collider).err()));
        }
        for (field, emitter) in emitters {
            refusals.push((field, world.add_emitter(emitter).err()));
        }
        refusals.push(("force", world.add_force(ConstantForce::new(place)).err()));
        refusals.push(("acceleration", world.add_force(Gravity::new(place)).err()));
        refusals.push(("coefficient", world.add_force(ViscousDrag::new(number)).err()));
        refusals.push(("dt", world.step(number).err()));
        for (field, refusal) in refusals {
            let text = refusal.map(|error| error.to_string()).unwrap_or_default();
            prop_assert!(text.contains(&format!("`{field}` must be")), "{field}: {text}");
        }
        prop_assert_eq!(world.state_hash(), before);
    }

    #[test]
    fn random_impacts_keep_momentum_and_gain_no_energy(
        settings in settings(),
        spheres in prop::collection::vec(sphere(), 2..40),
        frames in prop::collection::vec(0.001..0.1, 1..8),
    ) {
        let mut world = World::new(settings).unwrap();
        for sphere in &spheres {
            world.add_sphere(*sphere).unwrap();
        }
        let size: f64 = spheres.iter().map(|s| s.kilograms() * s.velocity.length()).sum();
        let (momentum, energy) = (world.momentum(), world.kinetic_energy());
        for h in frames {
            match world.step(h) {
                Err(Error::TooManyImpacts { .. }) => break,
                result => drop(result.unwrap()),
            }
        }
        // Some hundred impacts, each rounding momenta no larger than all together.
        prop_assert!((world.momentum() - momentum).length() <= 1e-13 * size);
        prop_assert!(world.kinetic_energy() <= energy * (1.0 + 1e-12));
    }

    #[test]
    fn under_contact_only_the_correction_of_overlaps_adds_energy(
        spheres in prop::collection::vec(sphere(), 1..30),
        colliders in prop::collection::vec(collider(), 0..8),
        gravity in vector(20.0),
        frames in prop::collection::vec(0.001..0.05, 1..8),
    ) {
        let mut world = World::new(Settings::default().with_rule(Contact::default())).unwrap();
        world.add_force(Gravity::new(gravity)).unwrap();
        for collider in colliders {
            world.add_collider(collider).unwrap();
        }
        for sphere in spheres {
            world.add_sphere(sphere).unwrap();
        }
        for dt in frames {
            let (kinetic, energy) = (world.kinetic_energy(), world.total_energy());
            let speeds = world.spheres().velocities().iter().map(|v| v.length());
            let fastest = speeds.fold(1.0, f64::max);
            let account = world.step(dt).unwrap().energy_account;
            let scale = kinetic + world.kinetic_energy() + energy.abs() + 1.0;
            // A sphere that bears something moves by its last velocity over a sub-step of h: its height
            // is wrong by h times how much that differs from the velocities before.
            let fall = gravity.length() * dt / 8.0;
            let speeds = world.spheres().masses().iter().sum::<f64>() * fastest;
            let error = fall * (8.0 * fall * speeds / fastest + 2.0 * speeds);
            let gain = world.total_energy() - energy - account.correction;
            prop_assert!(gain <= error + 1e-9 * scale, "{gain} of {scale}, {account:?}");
            prop_assert!(account.contacts <= error + 1e-9 * scale, "{account:?}");
        }
    }
}
