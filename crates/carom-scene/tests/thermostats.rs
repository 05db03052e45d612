//! Thermostats of scene files: what is read, written, and refused.

use carom_scene::scene::{Scene, Thermostat};

fn scene(thermostat: &str) -> String {
    format!(
        "name = \"gas\"\n[simulation]\nthermostat = {{ {thermostat} }}\n\
         boundary = {{ periodic = {{ size = [4.0, 4.0, 4.0] }} }}\n\
         [[spheres]]\nradius = 0.5\nvelocity = [1.0, 0.0, 0.0]\n"
    )
}

#[test]
fn thermostats_are_the_same_after_they_were_written_and_read() {
    let andersen = Thermostat::Andersen { frequency: 2.0, temperature: 0.5, seed: 0 };
    let rescale = Thermostat::Rescale { interval: 0.05, temperature: 1.0 };
    let noise = Thermostat::WhiteNoise { interval: 0.5, strength: 0.25, seed: 7 };
    for (text, expected) in [
        ("andersen = { frequency = \"2 Hz\", temperature = 0.5 }", andersen),
        ("rescale = { interval = \"50 ms\", temperature = \"1 J\" }", rescale),
        ("white-noise = { interval = 0.5, strength = 0.25, seed = 7 }", noise),
    ] {
        let scene = Scene::from_toml(&scene(text), "gas.toml").unwrap();
        assert_eq!(scene.simulation.thermostat, Some(expected));
        assert_eq!(Scene::from_toml(&scene.to_toml(), "gas.toml").unwrap(), scene);
        let mut world = scene.world().unwrap();
        let added = world.step(1.0).unwrap().energy_account.thermostat;
        assert!((world.kinetic_energy() - 0.5 - added).abs() < 1e-14, "{text}");
    }
}

#[test]
fn thermostats_that_make_no_sense_are_refused_with_their_line() {
    for (text, field) in [
        ("andersen = { frequency = 0.0, temperature = 0.5 }", "frequency"),
        ("rescale = { interval = 1.0, temperature = -1.0 }", "temperature"),
        ("white-noise = { interval = 1.0, strength = 0.0 }", "strength"),
    ] {
        let error = Scene::from_toml(&scene(text), "gas.toml").unwrap_err().to_string();
        assert!(error.contains("gas.toml:3") && error.contains(field), "{error}");
    }
    let other = scene("rescale = { interval = 1.0, temperature = 1.0 }")
        .replace("[simulation]", "[simulation]\nrule = \"contact\"");
    let error = Scene::from_toml(&other, "gas.toml").unwrap_err().to_string();
    assert!(
        error.contains("simulation.thermostat: must be left out under rules other than `exact`"),
        "{error}"
    );
}
