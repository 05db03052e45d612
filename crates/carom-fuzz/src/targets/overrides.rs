//! Values that `--set` and links put into a scene.

use carom_scene::{Override, Scene};
use proptest::prelude::*;

use super::scenes::check_accepted;
use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "overrides",
    about: "values put into a scene by path",
    campaign: 20_000,
    cases: || mutated(OVERRIDES.map(|it| it.as_bytes().to_vec()).to_vec()).boxed(),
    check,
};

/// Overrides that make sense for the scene.
const OVERRIDES: [&str; 12] = [
    "simulation.rule=exact",
    "simulation.frame_time=0.01",
    "simulation.boundary={ periodic = { size = [90, 90, 90] } }",
    "spheres[0].velocity=[1, 2, 3]",
    "spheres[0].color=tomato",
    "spheres[1].position.y=3",
    "colliders[0].restitution=0.5",
    "forces[0].gravity.acceleration=[0, -1, 0]",
    "count=7",
    "generators[0].row.count=4",
    "camera={ position = [0, 1, 5], target = [0, 0, 0] }",
    "emitters=[{ position = [0, 9, 0], period = 0.5, sphere = { radius = 0.1 } }]",
];

const SCENE: &str = r#"
name = "changed"
[parameters]
count = 3
[[forces]]
gravity = { acceleration = [0, -9.81, 0] }
[[spheres]]
position = [0, 2, 0]
radius = 0.3
[[spheres]]
position = [2, 2, 0]
radius = 0.3
[[generators]]
row = { count = "=count", start = [0, 5, 0], step = [1, 0, 0], sphere = { radius = 0.2 } }
[[colliders]]
shape = "half-space"
"#;

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let changed = text(case).parse::<Override>();
    let scene = changed.and_then(|it| Scene::from_toml_with(SCENE, "changed.toml", &[it]));
    match scene {
        Ok(scene) => {
            check_accepted(&scene)?;
            Ok(Answer::Accepted)
        }
        Err(error) => {
            check_error(&error.to_string())?;
            Ok(Answer::Refused)
        }
    }
}
