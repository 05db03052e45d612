//! Dumps of LAMMPS in text, as `dump custom` writes them.

use std::io::{self, Read, Write};

use carom::DVec3;

use super::columns::{Columns, Quantity};
use super::error::{Fault, Problem, shown};
use super::frame::{FrameBox, Header, ParticleFrame, SKEWED};
use super::lines::Lines;

/// Largest error of a rounded bound of a box, as a part of it.
const ROUNDING: f64 = 1e-14;

pub(super) fn write_header(
    out: &mut impl Write,
    frame: &ParticleFrame,
    cell: &FrameBox,
    number: u64,
) -> io::Result<()> {
    if number == 0 {
        // Once, as LAMMPS does: OVITO takes a second one for the end of the file.
        writeln!(out, "ITEM: UNITS\nsi")?;
    }
    if let Some(time) = frame.time {
        writeln!(out, "ITEM: TIME\n{time:?}")?;
    }
    writeln!(out, "ITEM: TIMESTEP\n{number}")?;
    writeln!(out, "ITEM: NUMBER OF ATOMS\n{}", frame.ids.len())?;
    let kinds = cell.is_periodic.map(|it| if it { "pp" } else { "ff" }).join(" ");
    if cell.slide == 0.0 {
        writeln!(out, "ITEM: BOX BOUNDS {kinds}")?;
        for axis in 0..3 {
            writeln!(out, "{:?} {:?}", cell.low[axis], cell.high[axis])?;
        }
    } else {
        // Bounds hold the whole skewed box.
        writeln!(out, "ITEM: BOX BOUNDS xy xz yz {kinds}")?;
        let (low, high) = (cell.low.x + cell.slide.min(0.0), cell.high.x + cell.slide.max(0.0));
        writeln!(out, "{low:?} {high:?} {:?}", cell.slide)?;
        for axis in 1..3 {
            writeln!(out, "{:?} {:?} 0.0", cell.low[axis], cell.high[axis])?;
        }
    }
    write!(out, "ITEM: ATOMS id type x y z")?;
    let others = [
        (frame.radii.is_some(), " radius"),
        (frame.masses.is_some(), " mass"),
        (frame.velocities.is_some(), " vx vy vz"),
        (frame.angular_velocities.is_some(), " omegax omegay omegaz"),
        (frame.orientations.is_some(), " quatw quati quatj quatk"),
    ];
    let present = others.iter().filter(|(is_there, _)| *is_there);
    present.map(|(_, names)| *names).try_for_each(|names| out.write_all(names.as_bytes()))?;
    writeln!(out)
}

/// Reads the items before the particles; `None` at the end of the file.
pub(super) fn read_header<R: Read>(lines: &mut Lines<R>) -> Result<Option<Header>, Fault> {
    let mut has_begun = false;
    let (mut count, mut time, mut cell) = (None, None, None);
    loop {
        let Some(line) = lines.next()? else {
            return if has_begun { Err(Fault::CutShort) } else { Ok(None) };
        };
        if line.trim().is_empty() && !has_begun {
            continue;
        }
        let Some(item) = line.strip_prefix("ITEM: ") else {
            return Err(Problem::from(format!(
                "expected a line that begins with ITEM:, not {}",
                shown(&line)
            ))
            .into());
        };
        has_begun = true;
        if let Some(names) = item.strip_prefix("ATOMS") {
            let count =
                count.ok_or(Problem::from("ITEM: NUMBER OF ATOMS is missing before this line"))?;
            let columns = columns(names)?;
            if columns.is_scaled && cell.is_none() {
                return Err(Problem::from("scaled positions need ITEM: BOX BOUNDS").into());
            }
            return Ok(Some(Header { count, time, cell, columns }));
        }
        if let Some(kinds) = item.strip_prefix("BOX BOUNDS") {
            cell = Some(bounds(kinds, lines)?);
            continue;
        }
        let Some(value) = lines.next()? else { return Err(Fault::CutShort) };
        match item.trim() {
            "NUMBER OF ATOMS" => count = Some(parsed(item, &value)?),
            "TIME" => time = Some(parsed::<f64>(item, &value)?),
            // Steps and names of units, which need no conversion.
            _ => {}
        }
    }
}

fn parsed<T: std::str::FromStr>(item: &str, value: &str) -> Result<T, Problem> {
    value
        .trim()
        .parse()
        .map_err(|_| format!("{}: expected a number, not {}", shown(item), shown(value)).into())
}

fn bounds<R: Read>(kinds: &str, lines: &mut Lines<R>) -> Result<FrameBox, Fault> {
    let kinds: Vec<&str> = kinds.split_whitespace().collect();
    let (is_skewed, kinds) = match kinds[..] {
        ["xy", "xz", "yz", ref kinds @ ..] => (true, kinds),
        ref kinds => (false, kinds),
    };
    let is_periodic = match *kinds {
        // Old versions name no kinds.
        [] => [true; 3],
        [x, y, z] => [x, y, z].map(|kind| kind == "pp"),
        _ => return Err(Problem::from(SKEWED).into()),
    };
    let (mut low, mut high, mut tilts) = (DVec3::ZERO, DVec3::ZERO, [0.0; 3]);
    for axis in 0..3 {
        let Some(line) = lines.next()? else { return Err(Fault::CutShort) };
        let numbers: Vec<f64> = line.split_whitespace().filter_map(|it| it.parse().ok()).collect();
        (low[axis], high[axis], tilts[axis]) = match (is_skewed, &numbers[..]) {
            (false, &[from, to]) => (from, to, 0.0),
            (true, &[from, to, tilt]) => (from, to, tilt),
            _ => {
                let problem = format!("expected two bounds of the box, not {}", shown(&line));
                return Err(Problem::from(problem).into());
            }
        };
    }
    let [slide, 0.0, 0.0] = tilts else { return Err(Problem::from(SKEWED).into()) };
    // Bounds hold the whole skewed box.
    low.x -= slide.min(0.0);
    high.x -= slide.max(0.0);
    // A box about the origin stays one, whatever the bounds were rounded to.
    if (low.x + high.x).abs() <= ROUNDING * high.x {
        if slide < 0.0 {
            low.x = -high.x;
        } else {
            high.x = -low.x;
        }
    }
    let cell = FrameBox { low, high, is_periodic, slide };
    cell.check()?;
    Ok(cell)
}

fn columns(names: &str) -> Result<Columns, Problem> {
    let mut columns = Columns::default();
    for (column, name) in names.split_whitespace().enumerate() {
        if let Some((quantity, component)) = component(name) {
            columns.is_scaled |= name.starts_with(['x', 'y', 'z']) && name[1..].starts_with('s');
            columns.put(quantity, component, column);
        }
        columns.width = column + 1;
    }
    if !columns.has(Quantity::Position) {
        return Err("ITEM: ATOMS names no positions: x y z, xu yu zu or xs ys zs".into());
    }
    Ok(columns)
}

/// The quantity in a column, and which component of it.
fn component(name: &str) -> Option<(Quantity, usize)> {
    let component = match name {
        "x" | "xu" | "xs" | "xsu" => (Quantity::Position, 0),
        "y" | "yu" | "ys" | "ysu" => (Quantity::Position, 1),
        "z" | "zu" | "zs" | "zsu" => (Quantity::Position, 2),
        "vx" => (Quantity::Velocity, 0),
        "vy" => (Quantity::Velocity, 1),
        "vz" => (Quantity::Velocity, 2),
        "omegax" => (Quantity::AngularVelocity, 0),
        "omegay" => (Quantity::AngularVelocity, 1),
        "omegaz" => (Quantity::AngularVelocity, 2),
        "quati" => (Quantity::Orientation, 0),
        "quatj" => (Quantity::Orientation, 1),
        "quatk" => (Quantity::Orientation, 2),
        "quatw" => (Quantity::Orientation, 3),
        "radius" => (Quantity::Radius, 0),
        "diameter" => (Quantity::Diameter, 0),
        "mass" => (Quantity::Mass, 0),
        "id" => (Quantity::Id, 0),
        _ => return None,
    };
    Some(component)
}
