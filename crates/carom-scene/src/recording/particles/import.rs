//! Scenes that begin with a frame of a particle file.

use std::path::Path;

use super::ParticleFormat;
use super::error::ParticleError;
use super::frame::ParticleFrame;
use super::reader::{OneFrame, one_frame};
use crate::import::{Omission, made_runnable, omit, plain_name};
use crate::scene::{Boundary, Rule, Scene, Sphere};

/// What a particle file does not state.
#[derive(Debug, Clone, Copy, Default)]
pub struct ParticleOptions {
    /// The frame, from 0; the default is the last one.
    pub frame: Option<u64>,
    /// Radius of every particle \[m\], for a file without radii.
    pub radius: Option<f64>,
    /// Rule; the default is `exact`.
    pub rule: Option<Rule>,
    /// Length of a frame \[s\]; the default is that of a new scene.
    pub frame_time: Option<f64>,
    /// Duration \[s\]; the default is 10.
    pub duration: Option<f64>,
}

/// A scene that begins with a frame of a particle file.
#[derive(Debug)]
pub struct ParticleImport {
    /// The scene, which is valid.
    pub scene: Scene,
    /// What was ignored or replaced.
    pub omissions: Vec<Omission>,
    /// Time of the frame \[s\], if the file has it.
    pub time: Option<f64>,
    /// Number of whole frames of the file.
    pub frames: u64,
}

/// Creates a scene from a whole frame of a particle file.
///
/// Numbers are taken as SI units, to the bit. Spheres are in the order of their numbers, else in
/// that of the file. A periodic box is moved to the origin. A mass that the file lacks is 1 kg.
///
/// # Errors
/// [`ParticleError`] if the file cannot be read, a line is wrong, the frame does not exist, the
/// particles have no radius, or the scene is invalid.
pub fn import_particles(
    path: &Path,
    format: ParticleFormat,
    options: &ParticleOptions,
) -> Result<ParticleImport, ParticleError> {
    let OneFrame { frame, frames, is_cut } = one_frame(path, format, options.frame)?;
    let radius = |problem| Err(ParticleError::Radius { path: path.to_owned(), problem });
    match (frame.radii.is_some(), options.radius) {
        (false, None) => {
            return radius("its particles have no radius: name one (--radius, radius=)");
        }
        (true, Some(_)) => {
            return radius("its particles have radii of their own: leave the radius out");
        }
        _ => {}
    }
    if frame.slide.is_some_and(|slide| slide != 0.0) {
        let problem = "a scene begins with aligned boxes: the one above has slid".to_owned();
        return Err(ParticleError::Binary { path: path.to_owned(), problem });
    }
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut scene = Scene::new(plain_name(&name));
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let which = options.frame.map_or("last frame".to_owned(), |frame| format!("frame {frame}"));
    scene.origin = plain_name(&format!("{which} of {file}"));
    scene.spheres = spheres(&frame, options.radius);
    let simulation = &mut scene.simulation;
    simulation.rule = options.rule.unwrap_or_default();
    simulation.frame_time = options.frame_time.unwrap_or(simulation.frame_time);
    simulation.duration = options.duration.unwrap_or(10.0);
    if frame.sides.iter().any(|side| side.is_finite()) {
        simulation.boundary =
            Boundary::Periodic { size: frame.sides, shear_rate: 0.0, relative_velocities: false };
    }
    let mut omissions = Vec::new();
    if is_cut && options.frame.is_none() {
        let reason = "is cut short; the scene begins with the one before";
        omit(&mut omissions, &scene.name, "last frame", reason);
    }
    if let Err(refused) = made_runnable(&mut scene, &mut omissions) {
        return Err(ParticleError::Scene { path: path.to_owned(), source: Box::new(refused) });
    }
    Ok(ParticleImport { scene, omissions, time: frame.time, frames })
}

/// Converts the particles of a frame.
fn spheres(frame: &ParticleFrame, radius: Option<f64>) -> Vec<Sphere> {
    let sphere = |(index, &position): (usize, &[f64; 3])| {
        let own = frame.radii.as_ref().map(|radii| radii[index]);
        let mut sphere = Sphere::at(position, own.or(radius).unwrap_or_default());
        sphere.velocity = frame.velocities.as_ref().map_or([0.0; 3], |all| all[index]);
        sphere.mass = frame.masses.as_ref().map(|masses| masses[index]);
        if let Some(orientations) = &frame.orientations {
            sphere.orientation = orientations[index];
        }
        if let Some(angular_velocities) = &frame.angular_velocities {
            sphere.angular_velocity = angular_velocities[index];
        }
        sphere
    };
    frame.positions.iter().enumerate().map(sphere).collect()
}
