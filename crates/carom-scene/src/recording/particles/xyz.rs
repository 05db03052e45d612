//! Extended XYZ (ASE's `extxyz`; libAtoms): names and box in the second line of each frame.

use std::io::{self, Read, Write};

use carom::DVec3;

use super::columns::{Columns, Quantity};
use super::error::{Fault, Problem, shown};
use super::frame::{FrameBox, Header, ParticleFrame, SKEWED};
use super::lines::Lines;

/// The symbol of a particle that is no atom.
pub(super) const SPECIES: &str = "X";

pub(super) fn write_header(
    out: &mut impl Write,
    frame: &ParticleFrame,
    cell: &FrameBox,
) -> io::Result<()> {
    writeln!(out, "{}", frame.ids.len())?;
    if cell.repeats() {
        let [x, y, z] = (cell.high - cell.low).to_array();
        let origin = cell.low.to_array().map(|it| format!("{it:?}")).join(" ");
        let slide = if cell.slide == 0.0 { "0".to_owned() } else { format!("{:?}", cell.slide) };
        let letters = cell.is_periodic.map(|it| if it { "T" } else { "F" }).join(" ");
        write!(
            out,
            "Lattice=\"{x:?} 0 0 {slide} {y:?} 0 0 0 {z:?}\" Origin=\"{origin}\" pbc=\"{letters}\" "
        )?;
    }
    // Programs that know plain XYZ only take the columns after the species for the position.
    out.write_all(b"Properties=species:S:1:pos:R:3:id:I:1")?;
    let others = [
        (frame.radii.is_some(), ":radius:R:1"),
        (frame.masses.is_some(), ":mass:R:1"),
        (frame.velocities.is_some(), ":velo:R:3"),
        (frame.angular_velocities.is_some(), ":angular_velocity:R:3"),
        (frame.orientations.is_some(), ":orientation:R:4"),
    ];
    let present = others.iter().filter(|(is_there, _)| *is_there);
    present.map(|(_, names)| *names).try_for_each(|names| out.write_all(names.as_bytes()))?;
    match frame.time {
        Some(time) => writeln!(out, " Time={time:?}"),
        None => writeln!(out),
    }
}

/// Reads the two lines before the particles; `None` at the end of the file.
pub(super) fn read_header<R: Read>(lines: &mut Lines<R>) -> Result<Option<Header>, Fault> {
    let count = loop {
        let Some(line) = lines.next()? else { return Ok(None) };
        // Some programs leave empty lines after the last frame.
        if !line.trim().is_empty() {
            break line.trim().parse().map_err(|_| {
                Fault::Problem(
                    format!("expected the number of particles, not {}", shown(&line)).into(),
                )
            })?;
        }
    };
    let Some(comment) = lines.next()? else { return Err(Fault::CutShort) };
    Ok(Some(header(count, &comment)?))
}

fn header(count: u64, comment: &str) -> Result<Header, Problem> {
    let pairs = pairs(comment);
    let value = |name: &str| {
        let found = pairs.iter().find(|(key, _)| key.eq_ignore_ascii_case(name));
        found.map(|(_, value)| value.as_str())
    };
    let columns = match value("Properties") {
        Some(properties) => of_properties(properties)?,
        None => plain(),
    };
    let time = value("Time").map(|text| number("Time", text)).transpose()?;
    let cell = value("Lattice");
    let cell = cell.map(|it| cell_of(it, value("Origin"), value("pbc"))).transpose()?;
    Ok(Header { count, time, cell, columns })
}

/// The pairs of `key=value` in a line; values may be quoted.
fn pairs(line: &str) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    let mut rest = line;
    while let Some((key, value)) = rest.split_once('=') {
        let key = key.split_whitespace().next_back().unwrap_or_default();
        let end = match value.chars().next() {
            Some('"') => Some('"'),
            Some('{') => Some('}'),
            Some('[') => Some(']'),
            _ => None,
        };
        let (value, left) = match end {
            Some(end) => value[1..].split_once(end).unwrap_or((&value[1..], "")),
            None => value.split_once(char::is_whitespace).unwrap_or((value, "")),
        };
        pairs.push((key.to_owned(), value.to_owned()));
        rest = left;
    }
    pairs
}

/// The columns of a file without names: species, x, y, z.
fn plain() -> Columns {
    let mut columns = Columns::default();
    columns.width = 4;
    (0..3).for_each(|axis| columns.put(Quantity::Position, axis, axis + 1));
    columns
}

/// Reads `name:type:number` of all columns.
fn of_properties(properties: &str) -> Result<Columns, Problem> {
    let mut columns = Columns::default();
    let parts: Vec<&str> = properties.split(':').collect();
    for part in parts.chunks(3) {
        let [name, _, count] = part else {
            return Err("Properties must be triples of name, type and number".into());
        };
        let count: usize =
            count.parse().ok().filter(|it| (1..=1000).contains(it)).ok_or_else(|| {
                format!(
                    "Properties: {} has {} columns, expected a number up to 1000",
                    shown(name),
                    shown(count)
                )
            })?;
        if let Some(quantity) = quantity(name).filter(|it| it.width() == count) {
            (0..count).for_each(|i| columns.put(quantity, i, columns.width + i));
        }
        columns.width += count;
    }
    if !columns.has(Quantity::Position) {
        return Err("Properties has no pos:R:3, the positions".into());
    }
    Ok(columns)
}

fn quantity(name: &str) -> Option<Quantity> {
    match name.to_lowercase().as_str() {
        "pos" | "position" | "positions" => Some(Quantity::Position),
        "velo" | "vel" | "velocity" | "velocities" => Some(Quantity::Velocity),
        "orientation" => Some(Quantity::Orientation),
        "angular_velocity" | "omega" => Some(Quantity::AngularVelocity),
        "radius" | "radii" => Some(Quantity::Radius),
        "diameter" => Some(Quantity::Diameter),
        "mass" | "masses" => Some(Quantity::Mass),
        "id" => Some(Quantity::Id),
        _ => None,
    }
}

fn cell_of(lattice: &str, origin: Option<&str>, pbc: Option<&str>) -> Result<FrameBox, Problem> {
    let edges: [f64; 9] = numbers("Lattice", lattice)?;
    if (0..9).any(|i| i % 4 != 0 && i != 3 && edges[i] != 0.0) {
        return Err(format!("Lattice: {SKEWED}").into());
    }
    let low = origin.map_or(Ok([0.0; 3]), |origin| numbers("Origin", origin))?;
    let low = DVec3::from_array(low);
    let letters: Vec<&str> = pbc.unwrap_or("T T T").split_whitespace().collect();
    let [x, y, z] = letters[..] else {
        return Err("pbc: expected three letters, T or F".into());
    };
    let is_periodic = [x, y, z].map(|it| matches!(it, "T" | "True" | "true" | "1"));
    let high = low + DVec3::new(edges[0], edges[4], edges[8]);
    let cell = FrameBox { low, high, is_periodic, slide: edges[3] };
    cell.check()?;
    Ok(cell)
}

fn numbers<const N: usize>(name: &str, text: &str) -> Result<[f64; N], Problem> {
    let values = text.split_whitespace().map(|it| number(name, it));
    let values = values.collect::<Result<Vec<f64>, Problem>>()?;
    values.try_into().map_err(|_| format!("{name}: expected {N} numbers").into())
}

fn number(name: &str, text: &str) -> Result<f64, Problem> {
    let value = text.parse().ok().filter(|it: &f64| it.is_finite());
    value.ok_or_else(|| format!("{name}: expected a finite number, not {}", shown(text)).into())
}
