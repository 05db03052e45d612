//! The stress of spheres (`docs/physics/stress.md`): closed forms of a ball between walls, of an oblique impact and of a
//! column at rest; the virial; the force on walls; the same under every rule that knows it, at every size.

use carom::packing::{self, Compression, Start, Until};
use carom::{
    BodyPair, Boundary, Collider, Contact, DMat3, DVec3, Error, Gravity, Pose, Rule, Settings,
    Shape, Sides, Sphere, StressMeter, World,
};

mod common;

use common::assert_close;

/// Parts of a tensor, column by column.
fn parts(tensor: DMat3) -> [f64; 9] {
    tensor.to_cols_array()
}

fn in_container(edge: f64, settings: Settings) -> World {
    let mut world = World::new(settings).unwrap();
    let walls = Shape::Container { size: DVec3::splat(edge), open: Sides::NONE };
    world.add_collider(Collider::new(walls, Pose::at(DVec3::ZERO))).unwrap();
    world
}

fn measured(world: &mut World, frames: u32, length: f64) -> StressMeter {
    let mut meter = StressMeter::new(world);
    for _ in 0..frames {
        world.step(length).unwrap();
        meter.add_frame(world);
    }
    meter
}

#[test]
fn oblique_impact_has_the_stress_of_its_impulse_along_the_centres() {
    // They meet along (3, 4, 0)/5 at 1 s, at right angles to that nothing closes.
    let normal = DVec3::new(0.6, 0.8, 0.0);
    let mut world = World::default();
    world.add_sphere(Sphere::new(-2.0 * normal, 0.5).with_velocity(normal)).unwrap();
    let other = Sphere::new(2.0 * normal, 1.5).with_velocity(-normal).with_mass(3.0);
    world.add_sphere(other).unwrap();
    let stress = measured(&mut world, 1, 4.0).stress(Some(10.0)).unwrap();
    // Reduced mass 3/4 kg, closing at 2 m/s: j = 3 N s over 2 m, in 4 s and 10 m³.
    let expected = 3.0 * 2.0 / 40.0;
    let [xx, xy, _, yx, yy, ..] = parts(stress.collisional);
    for (part, factor) in [(xx, 0.36), (xy, 0.48), (yx, 0.48), (yy, 0.64)] {
        assert_close(part, factor * expected, 1e-14);
    }
    assert_close(stress.pressure(), (expected + parts(stress.kinetic)[0] / 0.36) / 3.0, 1e-14);
}

#[test]
fn stress_of_a_ball_between_walls_is_the_force_on_them() {
    // Radius 1/2 in an edge of 2, from wall to wall in 1 s.
    let mut world = in_container(2.0, Settings::default());
    let ball = Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X).with_mass(3.0);
    world.add_sphere(ball).unwrap();
    let mut meter = StressMeter::new(&world);
    let mut pushed = 0.0;
    for _ in 0..40 {
        pushed += world.step(0.1).unwrap().impacts.iter().map(|it| it.impulse).sum::<f64>();
        meter.add_frame(&world);
    }
    let stress = parts(meter.stress(None).unwrap().total());
    // Two walls of 4 m² in 4 s.
    assert_close(pushed / (2.0 * 4.0 * 4.0), 0.75, 1e-12);
    assert_close(stress[0], 0.75, 1e-12);
    assert_eq!(stress[1..], [0.0; 8]);
}

#[test]
fn pressure_of_an_elastic_fluid_is_that_of_the_virial() {
    let start = Start::of(vec![0.5; 150], 2).with_packing_fraction(0.4);
    let mut world = packing::start(&start).unwrap();
    let compression = Compression::until(Until::PackingFraction(0.4)).with_growth(0.1);
    packing::compress(&mut world, &compression).unwrap();
    let Boundary::Periodic { size } = world.settings().boundary else { unreachable!() };
    let (energy, mut virial) = (world.kinetic_energy(), 0.0);
    let mut meter = StressMeter::new(&world);
    for _ in 0..50 {
        let report = world.step(0.02).unwrap();
        virial += report.impacts.iter().map(|impact| impact.impulse).sum::<f64>();
        meter.add_frame(&world);
    }
    let volume = size.element_product();
    let expected = (2.0 * energy + virial / meter.time()) / (3.0 * volume);
    let stress = meter.stress(None).unwrap();
    // Energy and radii are rounded in each of some thousand impacts.
    assert_close(stress.pressure(), expected, 1e-10 * expected);
    let [_, xy, _, yx, ..] = parts(stress.total());
    // Without friction impulses are along the centres, so the tensor is symmetric to rounding.
    assert!((xy - yx).abs() < 1e-12 * expected && xy.abs() < 0.1 * expected);
}

#[test]
fn column_at_rest_bears_its_weight() {
    for rule in [Rule::default(), Rule::Contact(Contact::default())] {
        let mut world = in_container(8.0, Settings::default().with_rule(rule));
        world.add_force(Gravity::new(DVec3::new(0.0, -10.0, 0.0))).unwrap();
        for number in 0..3 {
            let height = -4.0 + 0.5 + f64::from(number);
            world
                .add_sphere(Sphere::new(DVec3::new(0.0, height, 0.0), 0.5).with_mass(2.0))
                .unwrap();
        }
        // It comes to rest first, for `contact` knows forces after sub-steps.
        measured(&mut world, 60, 1.0 / 60.0);
        let stress = measured(&mut world, 10, 1.0 / 60.0).stress(None).unwrap();
        // Forces of 60 N over 1/2 m, 40 N and 20 N over 1 m, in 512 m³.
        let expected = (60.0 * 0.5 + 40.0 + 20.0) / 512.0;
        let [.., yy, _, _, _, _] = parts(stress.contact);
        // `contact` presses a sphere into the next by a thousandth of it.
        assert_close(yy, expected, 2e-3 * expected);
        assert_eq!(parts(stress.collisional), [0.0; 9], "{rule:?}");
    }
}

#[test]
fn stress_scales_with_lengths_masses_and_times() {
    let stress = |length: f64, mass: f64, time: f64| {
        let mut world = in_container(2.0 * length, Settings::default());
        for (x, v) in [(-0.5, 1.25), (0.5, -0.5)] {
            let place = length * DVec3::new(x, 0.0, 0.125);
            let velocity = length / time * DVec3::new(v, 0.25, 0.0);
            let sphere = Sphere::new(place, 0.25 * length).with_velocity(velocity);
            world.add_sphere(sphere.with_mass(mass)).unwrap();
        }
        measured(&mut world, 20, 0.25 * time).stress(None).unwrap().total()
    };
    let usual = parts(stress(1.0, 1.0, 1.0));
    assert!(usual[0] > 0.0);
    for [length, mass, time] in [[20, 20, -14], [-20, 20, 17], [20, -20, 17]] {
        let power = |exponent: i32| libm::scalbn(1.0, exponent);
        let scaled = stress(power(length), power(mass), power(time));
        let unit = power(mass - length - 2 * time);
        // Powers of two round nothing.
        assert_eq!(parts(scaled).map(|part| part / unit), usual);
    }
}

#[test]
fn what_makes_no_stress_is_refused() {
    let mut world = World::default();
    let says = |meter: &StressMeter, volume: Option<f64>, field: &str| {
        let Err(Error::Invalid { source, .. }) = meter.stress(volume) else {
            panic!("{field} is not refused")
        };
        assert_eq!(source.field, field);
    };
    let mut meter = StressMeter::new(&world);
    says(&meter, Some(1.0), "time");
    world.step(1.0).unwrap();
    meter.add_frame(&world);
    says(&meter, None, "volume");
    says(&meter, Some(0.0), "volume");
    says(&meter, Some(f64::NAN), "volume");
    // An empty world has none.
    assert_eq!(parts(meter.stress(Some(1.0)).unwrap().total()), [0.0; 9]);
    assert!(!world.report().impacts.iter().any(|it| matches!(it.between, BodyPair::Spheres(..))));
}

#[test]
fn drift_through_a_periodic_box_presses_nothing() {
    let size = DVec3::splat(3.0);
    let settings = Settings::default().with_boundary(Boundary::Periodic { size });
    let mut world = World::new(settings).unwrap();
    world.add_sphere(Sphere::new(DVec3::ZERO, 0.5).with_velocity(DVec3::X)).unwrap();
    let stress = measured(&mut world, 10, 1.0).stress(None).unwrap();
    assert_eq!(parts(stress.total()), [0.0; 9]);
}
