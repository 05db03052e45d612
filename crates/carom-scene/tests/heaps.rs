//! Heaps of three to fifty balls under the rule `exact` come to rest: every frame ends, and energy
//! does not increase. In these files the clock once stopped.

use std::path::Path;
use std::time::{Duration, Instant};

use carom::StopRequest;
use carom_scene::Scene;

/// Longest time for a heap, on a busy machine and in a debug build.
const PATIENCE: Duration = Duration::from_secs(600);

/// Runs a heap for ten seconds; returns the root mean square of its speeds at the end \[m/s\].
fn speed_at_the_end(name: &str) -> f64 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/heaps/{name}.toml"));
    let mut world = Scene::from_file(&path, &[]).unwrap().world().unwrap();
    let began = Instant::now();
    world.set_stop_request(Some(StopRequest::new(move || began.elapsed() > PATIENCE)));
    let mut energy = world.total_energy();
    let mut largest = energy;
    while world.time() < 10.0 {
        world.step(1.0 / 60.0).unwrap();
        let now = world.total_energy();
        largest = largest.max(now);
        assert!(now - energy < 1e-9 * largest, "{name} gains {:e} J", now - energy);
        energy = now;
    }
    // On curves, paths are computed to about 1e-9 of a radius.
    assert!(world.overlaps(1e-6 * 0.5).is_empty(), "{name}");
    let velocities = world.spheres().velocities();
    let squares: f64 = velocities.iter().map(|velocity| velocity.length_squared()).sum();
    (squares / velocities.len() as f64).sqrt()
}

#[test]
fn three_to_five_balls_come_to_rest() {
    for name in ["small-3balls-e0.8", "small-4balls-e0.0", "small-5balls-e0.5"] {
        assert_eq!(speed_at_the_end(name), 0.0, "{name}");
    }
}

#[test]
fn twenty_balls_on_a_lattice_come_to_rest() {
    for name in ["lattice-20-e0.0", "lattice-20-e0.5"] {
        assert_eq!(speed_at_the_end(name), 0.0, "{name}");
    }
}

#[test]
#[ignore = "takes minutes"]
fn heaps_of_twenty_to_fifty_balls_come_to_rest() {
    for kind in ["lattice-20", "random-20", "lattice-40", "random-40", "dome-50", "funnel-50"] {
        for restitution in ["0.0", "0.5", "0.8"] {
            let name = format!("{kind}-e{restitution}");
            let speed = speed_at_the_end(&name);
            // Without friction only impacts slow balls, so some still slide on slopes.
            let has_slopes = ["dome-50", "funnel-50"].contains(&kind);
            let slowest = if has_slopes { 1e-2 } else { 1e-6 };
            assert!(speed < slowest, "{name}: {speed:e} m/s");
        }
    }
}
