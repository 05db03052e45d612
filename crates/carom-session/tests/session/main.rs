//! Guarantees of sessions: any past frame can be restored bit for bit after any edits; the pace
//! follows a clock; views equal the state; and a driver executes commands in order, with and
//! without a thread.

mod comparison;
mod contacts;
mod driver;
mod edits;
mod link;
mod link_random;
mod link_refusals;
mod pace;
mod past;
mod readings;
mod revisions;
mod saving;

use carom::StateHash;
use carom_scene::{Library, Scene};
use carom_session::Session;

/// Spheres that fall onto a floor and collide, and emitters: everything that the past has to
/// restore. Single spheres are red, others blue by density, emitted ones green and yellow.
const BUSY: &str = r#"
name = "busy"
forces = [{ gravity = { acceleration = [0.0, -9.81, 0.0] } },
          { viscous-drag = { coefficient = 0.01 } }]

[[spheres]]
position = [0.0, 2.0, 0.0]
velocity = [1.0, 0.0, 0.5]
radius = 0.3
color = [1.0, 0.0, 0.0]

[[generators]]
random = { count = 12, min = [-2, 0.5, -2], max = [2, 3, 2], seed = 7, speed = 2.0, sphere = { radius = 0.2, density = 800.0, restitution = 0.9 } }

[[colliders]]
name = "floor"
shape = "half-space"
restitution = 0.8

[[colliders]]
name = "paddle"
shape = { box = { size = [1.0, 0.2, 1.0] } }
position = [5.0, 1.0, 0.0]
velocity = [-0.5, 0.0, 0.0]
angular_velocity = [0.0, 0.0, 1.0]

[[emitters]]
position = [0.0, 6.0, 0.0]
period = 0.11
max_spheres = 4
sphere = { radius = 0.25, velocity = [0.3, -1.0, 0.0], color = [0.0, 1.0, 0.0] }

[[emitters]]
position = [3.0, 6.0, 0.0]
period = 0.07
max_spheres = 5
sphere = { radius = 0.25, velocity = [-0.3, -1.0, 0.0], color = [1.0, 1.0, 0.0] }

[colors]
densities = [{ density = 800.0, color = [0.0, 0.0, 1.0] }]
"#;

fn busy_scene() -> Scene {
    Scene::from_toml(BUSY, "busy").unwrap()
}

fn busy() -> Session {
    Session::new(busy_scene()).unwrap()
}

fn built_in(name: &str) -> Session {
    Session::new(Library::new().find(name, &[]).unwrap().0).unwrap()
}

/// State hashes from the present frame on, after each of `frames` frames.
fn hashes(session: &mut Session, frames: u64) -> Vec<StateHash> {
    let mut hashes = vec![session.state_hash()];
    for _ in 0..frames {
        session.step().unwrap();
        hashes.push(session.state_hash());
    }
    hashes
}
