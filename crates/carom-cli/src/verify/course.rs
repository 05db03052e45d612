//! Claims about the built-in scenes.

use carom::{DQuat, DVec3, Discrete, Rule, SphereId, World};
use carom_scene::{BUILT_IN_FILES, Library, Override, Scene};

use super::claim::{Claim, Expected, Measured, Outcome, Tolerance};

/// Lengths of frames; the longest is a multiple of each \[s\].
const FRAMES: [f64; 3] = [1.0 / 30.0, 1.0 / 60.0, 1.0 / 240.0];
/// Number of the longest frames that are compared.
const LONGEST_FRAMES: usize = 150;

pub fn claims() -> Vec<Claim> {
    let mut claims: Vec<Claim> = BUILT_IN_FILES
        .iter()
        .map(|(file, _)| file.trim_end_matches(".toml"))
        .filter(|name| !is_for_contact(name))
        .map(|name| {
            Claim::new(
                format!("{name}: the same in frames of 1/30, 1/60 and 1/240 s [m]"),
                Expected::no_error("nature knows no frames"),
                tolerance_of(name),
                move |rule| frame_length(name, rule),
            )
        })
        .collect();
    let leaving = Claim::new(
        "SimTest4, discrete: the first ball leaves the 16:9 picture after [s]",
        Expected::value(19.8, "the course"),
        Tolerance::absolute(0.1, "the course says about 20 s"),
        |_| leaving_the_picture(),
    );
    claims.push(leaving.about(Rule::Discrete(Discrete::default())));
    claims
}

/// Returns how far places may differ between frames.
fn tolerance_of(name: &str) -> Tolerance {
    let moves = |scene: Scene| scene.colliders.iter().any(|collider| !collider.motion.is_empty());
    if scene(name, &[]).is_ok_and(moves) {
        return Tolerance::absolute(
            1e-6,
            "meetings with colliders that move round in each frame; each bounce off a bumper multiplies that",
        );
    }
    Tolerance::absolute(1e-9, "as demanded; far below anything one could see")
}

/// Whether the scene is made for the rule `contact`, because its balls come to rest in heaps.
fn is_for_contact(name: &str) -> bool {
    scene(name, &[]).is_ok_and(|scene| scene.simulation.rule == carom_scene::scene::Rule::Contact)
}

fn scene(name: &str, overrides: &[String]) -> Result<Scene, carom_scene::SceneError> {
    let overrides: Result<Vec<Override>, _> = overrides.iter().map(|text| text.parse()).collect();
    Ok(Library::new().find(name, &overrides?)?.0)
}

/// Largest distance between positions of one sphere for different lengths of frames.
fn frame_length(name: &str, rule: Rule) -> Outcome {
    let rule = match rule {
        Rule::Discrete(_) => "discrete",
        Rule::Bisect(_) => "bisect",
        Rule::Contact(_) => "contact",
        _ => "exact",
    };
    let mut worlds = Vec::new();
    for h in FRAMES {
        let overrides = [format!("simulation.rule={rule}"), format!("simulation.frame_time={h:?}")];
        worlds.push(scene(name, &overrides)?.world()?);
    }
    let mut worst = 0.0_f64;
    for _ in 0..LONGEST_FRAMES {
        for (world, h) in worlds.iter_mut().zip(FRAMES) {
            for _ in 0..(FRAMES[0] / h).round() as usize {
                world.step(h)?;
            }
        }
        for world in &worlds[1..] {
            worst = worst.max(largest_distance(&worlds[0], world));
        }
    }
    let states = worlds.iter().map(|world| Measured::in_world(world, 0.0));
    let all = Measured::largest(states);
    Ok(Measured { value: worst, ..all })
}

/// Largest distance between positions of one sphere in two worlds; infinite if their spheres
/// differ.
fn largest_distance(first: &World, second: &World) -> f64 {
    let (a, b) = (first.spheres(), second.spheres());
    if a.ids() != b.ids() {
        return f64::INFINITY;
    }
    let places = a.positions().iter().zip(b.positions());
    places.map(|(x, y)| x.distance(*y)).fold(0.0, f64::max)
}

fn leaving_the_picture() -> Outcome {
    let unlimited = "emitters.0.max_spheres=none".to_owned();
    let scene = scene("simtest4", &[unlimited])?;
    let h = scene.simulation.frame_time;
    let mut world = scene.world()?;
    world.step(h)?;
    let first: SphereId = world.spheres().ids()[0];
    // The ball starts above the picture, enters it and leaves it.
    let mut was_seen = false;
    while world.time() < 30.0 {
        let ball = world.sphere(first)?;
        let is_seen = !is_out_of_picture(&scene, ball.position, ball.radius);
        if was_seen && !is_seen {
            return Ok(Measured::in_world(&world, world.time()));
        }
        was_seen |= is_seen;
        world.step(h)?;
    }
    Err("still in the picture after 30 s".into())
}

/// Whether a sphere lies entirely outside the picture of the scene's camera, of ratio 16 : 9.
fn is_out_of_picture(scene: &Scene, center: DVec3, radius: f64) -> bool {
    let Some(camera) = scene.camera.as_ref() else { return false };
    let rotation = DQuat::from_array(camera.rotation).normalize();
    let local = rotation.inverse() * (center - DVec3::from_array(camera.position));
    let tangent = libm::tan((0.5 * camera.vertical_fov_degrees).to_radians());
    // The planes at the sides contain the camera; this is the distance outward.
    let outward = |along: f64, tangent: f64| {
        (along.abs() + local.z * tangent) / (1.0 + tangent * tangent).sqrt()
    };
    outward(local.x, tangent * 16.0 / 9.0) > radius || outward(local.y, tangent) > radius
}
