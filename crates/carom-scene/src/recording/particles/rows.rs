//! Reads the particles of a frame from their lines.

use carom::DVec3;

use super::ParticleFormat;
use super::columns::{Columns, Quantity};
use super::error::Problem;
use super::frame::{FrameBox, Header, ParticleFrame, RawFrame};

/// Quantities of one particle, in the order of its row.
struct Row {
    id: Option<u64>,
    position: [f64; 3],
    velocity: Option<[f64; 3]>,
    radius: Option<f64>,
    mass: Option<f64>,
    orientation: Option<[f64; 4]>,
    angular_velocity: Option<[f64; 3]>,
}

/// Reads the particles of a frame, in the order of their numbers or else in that of the file.
///
/// # Errors
/// Number of the line that is wrong, and what is wrong with it.
pub(super) fn parse(
    frame: &RawFrame,
    format: ParticleFormat,
) -> Result<ParticleFrame, (u64, Problem)> {
    let mut rows = Vec::new();
    for (line, text) in (frame.first_row..).zip(&frame.rows) {
        rows.push((line, row(text, &frame.header).map_err(|problem| (line, problem))?));
    }
    number(&mut rows, format)?;
    rows.sort_by_key(|(_, row)| row.id);
    if let Some(twins) = rows.windows(2).find(|pair| pair[0].1.id == pair[1].1.id) {
        let (line, again) = &twins[1];
        let number = again.id.unwrap_or_default() + first_number(format);
        return Err((*line, format!("another particle has the id {number}, too").into()));
    }
    let of = |row: &Row| row.id.unwrap_or_default();
    let rows: Vec<Row> = rows.into_iter().map(|(_, row)| row).collect();
    let cell = frame.header.cell.filter(FrameBox::repeats);
    Ok(ParticleFrame {
        time: frame.header.time,
        sides: cell.map_or([f64::INFINITY; 3], |cell| cell.period()),
        slide: cell.map(|cell| cell.slide).filter(|&slide| slide != 0.0),
        ids: rows.iter().map(of).collect(),
        positions: rows.iter().map(|row| row.position).collect(),
        velocities: rows.iter().map(|row| row.velocity).collect(),
        radii: rows.iter().map(|row| row.radius).collect(),
        masses: rows.iter().map(|row| row.mass).collect(),
        inertias: None,
        orientations: rows.iter().map(|row| row.orientation).collect(),
        angular_velocities: rows.iter().map(|row| row.angular_velocity).collect(),
    })
}

/// Number of the first particle that a format writes.
pub(super) fn first_number(format: ParticleFormat) -> u64 {
    u64::from(format == ParticleFormat::Dump)
}

/// Numbers particles from 0, and those without numbers in the order of the file. LAMMPS writes 0
/// for all atoms where they have no numbers.
fn number(rows: &mut [(u64, Row)], format: ParticleFormat) -> Result<(), (u64, Problem)> {
    let has_numbers = rows.iter().any(|(_, row)| row.id.is_some_and(|id| id > 0));
    for (place, (line, row)) in rows.iter_mut().enumerate() {
        row.id = match row.id {
            Some(id) if has_numbers => {
                let id = id.checked_sub(first_number(format));
                Some(id.ok_or((*line, "the id of a particle must be 1 or more".into()))?)
            }
            _ => Some(place as u64),
        };
    }
    Ok(())
}

/// Reads a particle.
fn row(text: &str, header: &Header) -> Result<Row, Problem> {
    let columns = &header.columns;
    let row: Vec<&str> = text.split_whitespace().collect();
    if row.len() < columns.width {
        let (width, found) = (columns.width, row.len());
        return Err(format!("expected {width} columns, found {found}").into());
    }
    let own = columns.read::<1>(Quantity::Radius, &row)?.map(|[radius]| radius);
    let half = columns.read::<1>(Quantity::Diameter, &row)?.map(|[diameter]| 0.5 * diameter);
    Ok(Row {
        id: columns.read::<1>(Quantity::Id, &row)?.map(id).transpose()?,
        position: position(columns, header, &row)?,
        velocity: columns.read(Quantity::Velocity, &row)?,
        radius: own.or(half),
        mass: columns.read::<1>(Quantity::Mass, &row)?.map(|[mass]| mass),
        orientation: columns.read(Quantity::Orientation, &row)?,
        angular_velocity: columns.read(Quantity::AngularVelocity, &row)?,
    })
}

/// Converts a number that was read as a real one.
fn id([number]: [f64; 1]) -> Result<u64, Problem> {
    // Above, some whole numbers are no numbers of this kind.
    let is_whole = number >= 0.0 && number.fract() == 0.0 && number < 2f64.powi(53);
    if is_whole {
        Ok(number as u64)
    } else {
        Err(format!("the id of a particle must be a whole number, not {number}").into())
    }
}

/// Reads a position, with a periodic box moved to the origin \[m\].
fn position(columns: &Columns, header: &Header, row: &[&str]) -> Result<[f64; 3], Problem> {
    let read = columns.read::<3>(Quantity::Position, row)?.unwrap_or_default();
    let Some(cell) = header.cell else { return Ok(read) };
    let mut position = DVec3::from_array(read);
    if columns.is_scaled {
        let along = position.y * cell.slide;
        position = cell.low + position * (cell.high - cell.low);
        position.x += along;
    }
    let shift = cell.shift_to_origin();
    // Where nothing is moved, -0 stays -0.
    let moved = if shift == DVec3::ZERO { position } else { position + shift };
    Ok(moved.to_array())
}
