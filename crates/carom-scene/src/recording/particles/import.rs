//! Scenes that begin with a frame of a particle file.

use std::path::Path;

use super::ParticleFormat;
use super::columns::{Columns, Quantity};
use super::error::{ParticleError, Problem};
use super::frame::{Header, RawFrame};
use super::reader::{LastFrame, last_frame};
use crate::import::{Omission, made_runnable, omit, plain_name};
use crate::scene::{Boundary, Rule, Scene, Sphere};

/// What a particle file does not state.
#[derive(Debug, Clone, Copy, Default)]
pub struct ParticleOptions {
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

/// Creates a scene from the last whole frame of a particle file.
///
/// Numbers are taken as SI units, to the bit. Spheres are in the order of the column `id`, else in
/// that of the file. A periodic box is moved to the origin. A mass that the file lacks is 1 kg.
///
/// # Errors
/// [`ParticleError`] if the file cannot be read, a line is wrong, the particles have no radius, or
/// the scene is invalid.
pub fn import_particles(
    path: &Path,
    format: ParticleFormat,
    options: &ParticleOptions,
) -> Result<ParticleImport, ParticleError> {
    let LastFrame { frame, frames, is_cut } = last_frame(path, format)?;
    let columns = &frame.header.columns;
    let has_radius = columns.has(Quantity::Radius) || columns.has(Quantity::Diameter);
    let radius = |problem| Err(ParticleError::Radius { path: path.to_owned(), problem });
    match (has_radius, options.radius) {
        (false, None) => return radius("its particles have no radius: name one with --radius"),
        (true, Some(_)) => return radius("its particles have radii: leave --radius out"),
        _ => {}
    }
    let spheres = spheres(&frame, options.radius).map_err(|(line, Problem(problem))| {
        ParticleError::Line { path: path.to_owned(), line, problem }
    })?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let mut scene = Scene::new(plain_name(&name));
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    scene.origin = plain_name(&format!("last frame of {file}"));
    scene.spheres = spheres;
    let simulation = &mut scene.simulation;
    simulation.rule = options.rule.unwrap_or_default();
    simulation.frame_time = options.frame_time.unwrap_or(simulation.frame_time);
    simulation.duration = options.duration.unwrap_or(10.0);
    let cell = frame.header.cell.filter(|cell| cell.repeats());
    if let Some(cell) = cell {
        simulation.boundary = Boundary::Periodic { size: cell.period().to_array() };
    }
    let mut omissions = Vec::new();
    if is_cut {
        let reason = "is cut short; the scene begins with the one before";
        omit(&mut omissions, &scene.name, "last frame", reason);
    }
    if let Err(refused) = made_runnable(&mut scene, &mut omissions) {
        return Err(ParticleError::Scene { path: path.to_owned(), source: Box::new(refused) });
    }
    Ok(ParticleImport { scene, omissions, time: frame.header.time, frames })
}

/// Reads the particles of a frame in the order of their numbers, or says which line is wrong.
fn spheres(frame: &RawFrame, radius: Option<f64>) -> Result<Vec<Sphere>, (u64, Problem)> {
    let mut spheres = Vec::new();
    for (line, row) in (frame.first_row..).zip(&frame.rows) {
        let read = sphere(row, &frame.header, radius).map_err(|problem| (line, problem))?;
        spheres.push(read);
    }
    spheres.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    Ok(spheres.into_iter().map(|(_, sphere)| sphere).collect())
}

/// Reads a particle and its number, 0 where the file has none.
fn sphere(row: &str, header: &Header, radius: Option<f64>) -> Result<(f64, Sphere), Problem> {
    let columns = &header.columns;
    let row: Vec<&str> = row.split_whitespace().collect();
    if row.len() < columns.width {
        let (width, found) = (columns.width, row.len());
        return Err(format!("expected {width} columns, found {found}").into());
    }
    let position = position(columns, header, &row)?;
    let own = columns.read::<1>(Quantity::Radius, &row)?.map(|[radius]| radius);
    let half = columns.read::<1>(Quantity::Diameter, &row)?.map(|[diameter]| 0.5 * diameter);
    let radius = own.or(half).or(radius).unwrap_or_default();
    let mut sphere = Sphere::at(position, radius);
    sphere.velocity = columns.read(Quantity::Velocity, &row)?.unwrap_or_default();
    sphere.mass = columns.read::<1>(Quantity::Mass, &row)?.map(|[mass]| mass);
    if let Some(orientation) = columns.read(Quantity::Orientation, &row)? {
        sphere.orientation = orientation;
    }
    let angular_velocity = columns.read(Quantity::AngularVelocity, &row)?;
    sphere.angular_velocity = angular_velocity.unwrap_or_default();
    let number = columns.read::<1>(Quantity::Id, &row)?.map_or(0.0, |[id]| id);
    Ok((number, sphere))
}

/// Reads a position, with a periodic box moved to the origin \[m\].
fn position(columns: &Columns, header: &Header, row: &[&str]) -> Result<[f64; 3], Problem> {
    let read = columns.read::<3>(Quantity::Position, row)?.unwrap_or_default();
    let Some(cell) = header.cell else { return Ok(read) };
    let mut position = carom::DVec3::from_array(read);
    if columns.is_scaled {
        position = cell.low + position * (cell.high - cell.low);
    }
    let shift = cell.shift_to_origin();
    // Where nothing is moved, -0 stays -0.
    let moved = if shift == carom::DVec3::ZERO { position } else { position + shift };
    Ok(moved.to_array())
}
