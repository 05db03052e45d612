//! Checks of the parts of a scene that do not go into the world.

use crate::error::Problem;
use crate::requirement::{check, check_non_negative, check_positive, check_rotation, check_vector};
use crate::scene::{Color, DensityColor, Generator, Rule, Scene, Simulation};
use crate::tries::check_tries;

/// Checks the numbers that do not go into the world: times, camera, colours and tolerance.
pub(crate) fn check_numbers(scene: &Scene) -> Result<(), Problem> {
    let Simulation { frame_time, duration, .. } = scene.simulation;
    check_positive(frame_time, "simulation.frame_time")?;
    check_positive(duration, "simulation.duration")?;
    if let Some(camera) = &scene.camera {
        let fov = camera.vertical_fov_degrees;
        check(fov > 0.0 && fov < 180.0, "camera.vertical_fov_degrees", || {
            format!("must be between 0 and 180, not {fov}")
        })?;
        check_positive(camera.near, "camera.near")?;
        check(camera.far > camera.near && camera.far.is_finite(), "camera.far", || {
            format!("must be farther than `near`, not {}", camera.far)
        })?;
        check_vector(camera.position, "camera.position")?;
        check_rotation(camera.rotation, "camera.rotation")?;
    }
    if let Some(sun) = &scene.sun {
        check_rotation(sun.rotation, "sun.rotation")?;
        check_non_negative(sun.intensity, "sun.intensity")?;
    }
    for (path, color) in colors(scene) {
        check(color.iter().all(|part| (0.0..=1.0).contains(part)), &path, || {
            format!("must have three parts in [0, 1], not {color:?}")
        })?;
    }
    let densities = scene.colors.iter().flat_map(|colors| &colors.densities).enumerate();
    for (i, DensityColor { density, .. }) in densities {
        check_positive(*density, &format!("colors.densities[{i}].density"))?;
    }
    check_tolerance(scene)
}

/// Longest name, title, and description or origin of a scene \[characters\].
const LONGEST: [usize; 3] = [255, 500, 20_000];

/// Refuses names and texts that are too long, or that contain control characters.
pub(crate) fn check_texts(scene: &Scene) -> Result<(), Problem> {
    let [of_name, of_title, of_description] = LONGEST;
    check_text("name", &scene.name, of_name)?;
    check_text("title", &scene.title, of_title)?;
    check_text("description", &scene.description, of_description)?;
    check_text("origin", &scene.origin, of_description)?;
    check_tries(&scene.tries)?;
    for (i, collider) in scene.colliders.iter().enumerate() {
        check_text(&format!("colliders[{i}].name"), &collider.name, of_name)?;
    }
    for (i, emitter) in scene.emitters.iter().enumerate() {
        check_text(&format!("emitters[{i}].name"), &emitter.name, of_name)?;
    }
    Ok(())
}

fn check_text(field: &str, text: &str, longest: usize) -> Result<(), Problem> {
    // Only a description may have several lines; they end as in the file.
    let is_space = |it: char| field == "description" && matches!(it, '\n' | '\r' | '\t');
    let is_shown = |it: char| !it.is_control() || is_space(it);
    check(text.chars().all(is_shown), field, || "must have no control characters".into())?;
    check(text.chars().nth(longest).is_none(), field, || {
        format!("must have at most {longest} characters")
    })
}

/// Returns every colour in a scene with its path.
fn colors(scene: &Scene) -> Vec<(String, Color)> {
    let mut colors = Vec::new();
    let mut add = |path: String, color: Option<Color>| colors.extend(color.map(|c| (path, c)));
    for (i, sphere) in scene.spheres.iter().enumerate() {
        add(format!("spheres[{i}].color"), sphere.color);
    }
    for (i, generator) in scene.generators.iter().enumerate() {
        let path = format!("generators[{i}].{}", generator.kind());
        add(format!("{path}.sphere.color"), generator.sphere().and_then(|it| it.color));
        add(format!("{path}.collider.color"), generator.collider().and_then(|it| it.color));
    }
    for (i, collider) in scene.colliders.iter().enumerate() {
        add(format!("colliders[{i}].color"), collider.color);
    }
    for (i, emitter) in scene.emitters.iter().enumerate() {
        add(format!("emitters[{i}].sphere.color"), emitter.sphere.color);
    }
    for (name, material) in &scene.materials {
        add(format!("materials.{name}.color"), material.color);
    }
    add("sun.color".to_owned(), scene.sun.as_ref().map(|sun| sun.color));
    if let Some(own) = &scene.colors {
        add("colors.background".to_owned(), own.background);
        add("colors.colliders".to_owned(), own.colliders);
        add("colors.spheres".to_owned(), own.spheres);
        for (i, density) in own.densities.iter().enumerate() {
            add(format!("colors.densities[{i}].color"), Some(density.color));
        }
    }
    colors
}

/// Refuses a touching distance that is not positive. Where the rule uses it, it must also be small
/// compared with the smallest sphere.
fn check_tolerance(scene: &Scene) -> Result<(), Problem> {
    let spheres = scene.spheres.iter().chain(scene.generators.iter().filter_map(Generator::sphere));
    let spheres = spheres.chain(scene.emitters.iter().map(|emitter| &emitter.sphere));
    let radii = spheres.filter_map(|s| s.radius.or(s.diameter.map(|diameter| 0.5 * diameter)));
    let smallest = radii.filter(|radius| *radius > 0.0).fold(f64::INFINITY, f64::min);
    let tolerance = scene.simulation.bisect.tolerance;
    // It is checked under every rule, because a scene can change its rule in one word.
    check_positive(tolerance, "simulation.bisect.tolerance")?;
    let is_used = scene.simulation.rule == Rule::Bisect;
    let most = 0.01 * smallest;
    check(!is_used || tolerance <= most, "simulation.bisect.tolerance", || {
        format!("must be at most {most:?}, 1/100 of the smallest radius, not {tolerance:?}")
    })
}
