//! Scenes of two dimensions: the places and velocities that generators make in the plane, and what is refused because
//! it leaves the plane.

use carom::DVec3;
use carom::packing::{equilibrate, packing_fraction};
use carom_scene::Scene;

fn text(simulation: &str, rest: &str) -> String {
    format!("name = 'disc'\n[simulation]\ndimensions = 2\n{simulation}\n{rest}\n")
}

fn read(simulation: &str, rest: &str) -> Scene {
    Scene::from_toml(&text(simulation, rest), "test.toml").unwrap()
}

fn refusal(rest: &str) -> String {
    Scene::from_toml(&text("", rest), "test.toml").unwrap_err().to_string()
}

const PERIODIC: &str = "boundary = { periodic = { size = [20, 20, inf] } }";
const FLUID: &str = "[[generators]]\n[generators.dense-fluid]\ncount = 400\ntemperature = 2.0\nseed = 7\n\
                     packing_fraction = 0.5\nsphere = { mass = 3 }";
const RANDOM: &str = "[[generators]]\n[generators.random]\ncount = 60\nseed = 3\nspeed = 2.0\n\
                      min = [-5, -4, 0]\nmax = [5, 4, 0]\nsphere = { radius = 0.25, velocity = [1, 0, 0] }";

#[test]
fn random_discs_lie_in_the_plane_and_have_their_speed_in_all_directions() {
    let world = read("", RANDOM).world().unwrap();
    let spheres = world.spheres();
    assert_eq!(spheres.len(), 60);
    assert!(world.overlaps(0.0).is_empty());
    let mut quadrants = [0; 4];
    for (place, velocity) in spheres.positions().iter().zip(spheres.velocities()) {
        assert_eq!((place.z, velocity.z), (0.0, 0.0));
        assert!(place.x.abs() <= 4.75 && place.y.abs() <= 3.75);
        let own = *velocity - DVec3::X;
        // A unit vector times 2, and a sum.
        assert!((own.length() - 2.0).abs() < 1e-15 * 8.0);
        quadrants[usize::from(own.x > 0.0) + 2 * usize::from(own.y > 0.0)] += 1;
    }
    // Fifteen each are expected, with a standard deviation of 3.4.
    assert!(quadrants.iter().all(|&it| it >= 5), "{quadrants:?}");
}

#[test]
fn a_close_packing_of_discs_touches_six_others() {
    let packing = "[[generators]]\n[generators.close-packing]\ncounts = [7, 6, 1]\nstart = [1, 2, 0]\n\
                   sphere = { radius = 0.5 }";
    let world = read("", packing).world().unwrap();
    let places = world.spheres().positions();
    assert!(places.iter().all(|place| place.z == 0.0));
    let near = |place: &DVec3| {
        places.iter().filter(|other| (place.distance(**other) - 1.0).abs() < 1e-14).count()
    };
    let inside = |place: &&DVec3| place.x > 1.9 && place.x < 6.9 && place.y > 2.5 && place.y < 6.0;
    assert_eq!(places.iter().filter(inside).count(), 20);
    assert!(places.iter().filter(inside).all(|place| near(place) == 6));
    let error = refusal(&packing.replace("6, 1]", "6, 2]"));
    assert!(error.contains("7: generators[0].close-packing.counts: must have one row"), "{error}");
}

#[test]
fn a_fluid_of_discs_has_its_area_temperature_and_the_pressure_of_henderson() {
    let mut world = read(PERIODIC, FLUID).world().unwrap();
    let spheres = world.spheres();
    assert!(world.overlaps(0.0).is_empty());
    assert!(spheres.positions().iter().chain(spheres.velocities()).all(|it| it.z == 0.0));
    // Radii follow from the fraction by one square root.
    assert!((packing_fraction(&world, None).unwrap() - 0.5).abs() < 1e-14);
    // A disc has k T of kinetic energy: a sum of 400, rounded.
    assert!((world.kinetic_energy() / 400.0 - 2.0).abs() < 1e-12);
    let measured = equilibrate(&mut world, 200.0, None).unwrap().pressure;
    let expected = (1.0 + 0.5 * 0.5 / 8.0) / (0.5 * 0.5);
    // 40,000 collisions scatter by half a per cent, and 400 discs differ from many by as much.
    assert!((measured / expected - 1.0).abs() < 0.015, "{measured} instead of {expected}");
}

#[test]
fn a_fluid_of_discs_lies_between_its_walls_at_every_size() {
    let made = |size: f64| {
        let fluid = format!(
            "[[generators]]\n[generators.dense-fluid]\ncount = 200\ntemperature = {:?}\nseed = 1\n\
             radius_range = [{:?}, {:?}]\nmin = [{:?}, 0, {:?}]\nmax = [{:?}, {:?}, 0]\nsphere = {{ mass = 2 }}",
            size * size,
            0.25 * size,
            0.5 * size,
            -size,
            -3.0 * size,
            11.0 * size,
            10.0 * size,
        );
        read("", &fluid).world().unwrap()
    };
    let world = made(1.0);
    let spheres = world.spheres();
    for (&center, &radius) in spheres.positions().iter().zip(spheres.radii()) {
        assert!(center.z == 0.0 && (0.25..=0.5).contains(&radius));
        assert!(center.x - radius >= -1.0 && center.x + radius <= 11.0);
        assert!(center.y - radius >= 0.0 && center.y + radius <= 10.0);
    }
    for size in [2f64.powi(-20), 2f64.powi(20)] {
        let scaled = made(size);
        let places = scaled.spheres().positions().iter().map(|it| *it / size);
        assert!(places.eq(spheres.positions().iter().copied()));
    }
}

#[test]
fn a_box_beside_the_plane_is_refused() {
    let error = refusal(&RANDOM.replace("max = [5, 4, 0]", "max = [5, 4, -1]"));
    assert!(error.contains("generators[0].random.max: must contain the plane z = 0"), "{error}");
    let above = "min = [0, 0, 1]\nmax = [20, 20, 2]\nsphere";
    let error = refusal(&FLUID.replace("sphere", above));
    assert!(error.contains("generators[0].dense-fluid.max: must contain the plane"), "{error}");
}

#[test]
fn what_drives_discs_out_of_the_plane_is_refused_by_name() {
    let disc = "[[spheres]]\nradius = 0.1\nposition = [0.5, 0.2, 0]\n";
    let collider = |rest: &str| format!("{disc}[[colliders]]\n{rest}\n");
    for (rest, expected) in [
        (format!("{disc}[[forces]]\nwind = {{ velocity = [0, 1, 1], coefficient = 1 }}"), "forces[0].wind: must act"),
        (format!("{disc}[[forces]]\npoint-attractor = {{ gravitational_parameter = 1, position = [0, 0, 1] }}"), "forces[0].point-attractor: must act"),
        (format!("{disc}[[springs]]\nsphere = 0\nanchor = [0, 0, 1]\nstiffness = 1"), "springs: `anchor` must be"),
        ("[[emitters]]\nperiod = 1\nposition = [0, 0, 1]\nsphere = { radius = 0.1 }".into(), "emitters[0].position: must be"),
        ("[[emitters]]\nperiod = 1\nsphere = { radius = 0.1 }\n[[forces]]\ngravity = { acceleration = [0, 0, -9.8] }".into(), "forces[0].gravity: must act"),
        (collider("shape = { sphere = { radius = 0.5 } }\nposition = [2, 0, 0.1]"), "colliders[0].position: must be"),
        (collider("shape = 'half-space'\nposition = [0, -3, 0]\nrotation = { axis = [1, 0, 0], degrees = 10 }"), "colliders[0].normal: must be"),
        (collider("shape = { sphere = { radius = 0.5 } }\nposition = [2, 0, 0]\nvelocity = [0, 0, 1]"), "colliders[0].velocity: must be"),
        ("[[spheres]]\nradius = 0.1\nvelocity = [0, 0, 1]".into(), "spheres[0].velocity: must be"),
    ] {
        let error = refusal(&rest);
        assert!(error.contains(expected) && error.contains("plane z = 0"), "{rest}: {error}");
    }
    let rotated = "shape = { rectangle = { size_x = 4, size_z = 4 } }\nposition = [0, -3, 0]\n\
                   rotation = { axis = [0, 0, 1], degrees = 30 }";
    read("", &collider(rotated));
}
