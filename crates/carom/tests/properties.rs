//! Random worlds: whatever is in them, a step neither panics nor makes a NaN, and without forces
//! and walls momentum stays. Has nothing to say about accuracy.

// What is expected need not have the same bits everywhere.
#![allow(clippy::disallowed_methods)]

mod common;

use carom::{
    Bisect, Collider, ConstantForce, DQuat, DVec3, Emitter, Gravity, Integrator, Pose,
    RestitutionRule, Rule, Settings, Shape, Sphere, ViscousDrag, WindBack, World,
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
    (vector(5.0), velocity, -3.0..0.5, -3.0..3.0, 0.0..=1.0).prop_map(
        |(position, velocity, radius, mass, restitution)| {
            Sphere::new(position, 10f64.powf(radius))
                .with_velocity(velocity)
                .with_mass(10f64.powf(mass))
                .with_restitution(restitution)
        },
    )
}

fn collider() -> impl Strategy<Value = Collider> {
    let shape = prop_oneof![
        (0.01..3.0).prop_map(|radius| Shape::Sphere { radius }),
        (0.01..9.0, 0.01..9.0).prop_map(|(size_x, size_z)| Shape::Rectangle { size_x, size_z }),
        Just(Shape::HalfSpace),
        (0.01..3.0, 0.01..3.0, 0.01..3.0)
            .prop_map(|(x, y, z)| Shape::Box { size: DVec3::new(x, y, z) }),
    ];
    (shape, vector(5.0), rotation(), 0.0..=1.0, any::<bool>()).prop_map(
        |(shape, position, rotation, restitution, trigger)| Collider {
            shape,
            pose: Pose { position, rotation },
            restitution,
            trigger,
        },
    )
}

fn settings() -> impl Strategy<Value = Settings> {
    let bisect = (0.0..1e-3, 1..12u32, 1..20u32, any::<bool>()).prop_map(
        |(tolerance, max_halvings, max_substeps, all)| {
            let wind_back = if all { WindBack::All } else { WindBack::Touched };
            Rule::Bisect(Bisect { tolerance, max_halvings, max_substeps, wind_back })
        },
    );
    let rule = prop_oneof![Just(Rule::Discrete), bisect];
    let integrator = prop::sample::select(vec![
        Integrator::SemiImplicitEuler,
        Integrator::ExplicitEuler,
        Integrator::VelocityVerlet,
        Integrator::RungeKutta4,
    ]);
    let restitution_rule = prop::sample::select(vec![
        RestitutionRule::Product,
        RestitutionRule::Minimum,
        RestitutionRule::Maximum,
        RestitutionRule::Average,
    ]);
    (rule, integrator, restitution_rule, any::<bool>()).prop_map(
        |(rule, integrator, restitution_rule, spheres_collide)| Settings {
            rule,
            integrator,
            restitution_rule,
            spheres_collide,
        },
    )
}

fn emitter() -> impl Strategy<Value = Emitter> {
    (sphere(), vector(5.0), rotation(), 0.01..1.0, prop::option::of(1..5u32)).prop_map(
        |(sphere, position, rotation, period, max_spheres)| Emitter {
            sphere,
            position,
            rotation,
            period,
            max_spheres,
        },
    )
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
                prop_assert!(impact.approach_speed > 0.0 && impact.impulse >= 0.0);
                prop_assert!((impact.normal.length() - 1.0).abs() < 1e-12);
                prop_assert!(impact.point.is_finite());
            }
            prop_assert!(report.impacts.is_sorted_by(|a, b| a.time <= b.time));
            let spheres = world.spheres();
            prop_assert!(spheres.positions().iter().all(|x| x.is_finite()));
            prop_assert!(spheres.velocities().iter().all(|v| v.is_finite()));
            prop_assert!(spheres.ids().is_sorted());
        }
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
            world.step(h).unwrap();
        }
        // Some hundred impacts, each rounding momenta no larger than all together.
        prop_assert!((world.momentum() - momentum).length() <= 1e-13 * size);
        prop_assert!(world.kinetic_energy() <= energy * (1.0 + 1e-12));
    }
}
