//! Small worlds that are hard to step: radii and masses of very different sizes, spheres that touch from the
//! start, edges and corners, surfaces that move and turn, speeds that cross everything within a frame.

mod drawn;
mod meshes;
mod placed;
mod sensible;
mod vector;
mod written;

use carom_scene::Scene;
use proptest::prelude::*;

use self::drawn::drawn;
use self::sensible::sensible;
use self::written::written;
use crate::case::text;
use crate::fault::{Fault, check_error};
use crate::laws;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "worlds",
    about: "small worlds that are hard to step, under every rule, with the laws of each",
    campaign: 10_000,
    cases: || drawn().prop_map(|it| written(&sensible(it)).into_bytes()).boxed(),
    check,
};

fn check(case: &[u8]) -> Result<Answer, Fault> {
    match Scene::from_toml(&text(case), "world.toml") {
        Ok(scene) => laws::check(&scene).map(|()| Answer::Accepted),
        Err(error) => check_error(&error.to_string()).map(|()| Answer::Refused),
    }
}
