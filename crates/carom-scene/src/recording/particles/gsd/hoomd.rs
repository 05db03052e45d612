//! The schema of HOOMD-blue: names and meanings of the chunks of a frame.
//!
//! The schema has single precision. So that nothing is lost, runs write what Carom knows in double
//! precision, too, as logged quantities, which every program may ignore.

use carom::{DQuat, DVec3};

use super::chunk::Chunk;
use super::chunks::{Chunks, Fault};
use crate::recording::particles::frame::{FrameBox, ParticleFrame, SKEWED};

/// Names of all chunks that frames may have, in the order in which they are written.
pub(super) const NAMES: [&str; 21] = [
    "configuration/step",
    "configuration/box",
    "particles/N",
    "particles/position",
    "particles/velocity",
    "particles/diameter",
    "particles/mass",
    "particles/orientation",
    "particles/moment_inertia",
    "particles/angmom",
    "log/time",
    "log/periodic",
    "log/box",
    "log/particles/id",
    "log/particles/position",
    "log/particles/velocity",
    "log/particles/radius",
    "log/particles/mass",
    "log/particles/orientation",
    "log/particles/angular_velocity",
    "log/slide",
];

/// Returns the chunks of a frame with the places of their names in [`NAMES`], ascending.
pub(super) fn chunks(
    frame: &ParticleFrame,
    number: u64,
    has_rotation: bool,
) -> Vec<(usize, Chunk)> {
    let mut chunks = Vec::new();
    let mut put = |name: &str, chunk: Chunk| {
        chunks.extend(NAMES.iter().position(|it| *it == name).map(|place| (place, chunk)));
    };
    put("configuration/step", Chunk::uint64(&[number]));
    put("configuration/box", Chunk::single(&shown_box(frame), 1));
    put("particles/N", Chunk::uint32(frame.ids.len() as u32));
    if let Some(time) = frame.time {
        put("log/time", Chunk::double(&[time], 1));
    }
    put("log/periodic", Chunk::bytes(&frame.sides.map(|side| u8::from(side.is_finite()))));
    let own = frame.sides.map(|side| if side.is_finite() { side } else { 0.0 });
    put("log/box", Chunk::double(&own, 1));
    if let Some(slide) = frame.slide {
        put("log/slide", Chunk::double(&[slide], 1));
    }
    put("log/particles/id", Chunk::uint64(&frame.ids));
    let vectors = frame.positions.as_flattened();
    put("particles/position", Chunk::single(vectors, 3));
    put("log/particles/position", Chunk::double(vectors, 3));
    if let Some(velocities) = &frame.velocities {
        put("particles/velocity", Chunk::single(velocities.as_flattened(), 3));
        put("log/particles/velocity", Chunk::double(velocities.as_flattened(), 3));
    }
    if let Some(radii) = &frame.radii {
        let diameters: Vec<f64> = radii.iter().map(|radius| 2.0 * radius).collect();
        put("particles/diameter", Chunk::single(&diameters, 1));
        put("log/particles/radius", Chunk::double(radii, 1));
    }
    if let Some(masses) = &frame.masses {
        put("particles/mass", Chunk::single(masses, 1));
        put("log/particles/mass", Chunk::double(masses, 1));
    }
    if has_rotation {
        put_rotation(frame, &mut put);
    }
    chunks.sort_by_key(|(place, _)| *place);
    chunks
}

fn put_rotation(frame: &ParticleFrame, put: &mut impl FnMut(&str, Chunk)) {
    let count = frame.ids.len();
    let identity = || vec![[0.0, 0.0, 0.0, 1.0]; count];
    let orientations = frame.orientations.clone().unwrap_or_else(identity);
    let at_rest = || vec![[0.0; 3]; count];
    let angular_velocities = frame.angular_velocities.clone().unwrap_or_else(at_rest);
    let scalar_first: Vec<[f64; 4]> =
        orientations.iter().map(|[x, y, z, w]| [*w, *x, *y, *z]).collect();
    put("particles/orientation", Chunk::single(scalar_first.as_flattened(), 4));
    put("log/particles/orientation", Chunk::double(scalar_first.as_flattened(), 4));
    put("log/particles/angular_velocity", Chunk::double(angular_velocities.as_flattened(), 3));
    if let Some(inertias) = &frame.inertias {
        let principal: Vec<[f64; 3]> = inertias.iter().map(|&inertia| [inertia; 3]).collect();
        put("particles/moment_inertia", Chunk::single(principal.as_flattened(), 3));
        let momenta: Vec<[f64; 4]> = (0..count)
            .map(|index| {
                angular_momentum(inertias[index], angular_velocities[index], orientations[index])
            })
            .collect();
        put("particles/angmom", Chunk::single(momenta.as_flattened(), 4));
    }
}

/// The angular momentum `p = 2 q (0, I ω')` of HOOMD-blue as a quaternion w, x, y, z, with ω' along
/// the axes of the body. For a sphere it is `2 (0, I ω) q`, with ω along the axes of space.
fn angular_momentum(inertia: f64, omega: [f64; 3], orientation: [f64; 4]) -> [f64; 4] {
    let [x, y, z] = omega.map(|it| 2.0 * inertia * it);
    let momentum = DQuat::from_xyzw(x, y, z, 0.0) * DQuat::from_array(orientation);
    [momentum.w, momentum.x, momentum.y, momentum.z]
}

/// The box of HOOMD-blue around the origin, which is periodic along all axes: along open ones it is
/// as long as to hold all spheres.
fn shown_box(frame: &ParticleFrame) -> [f64; 6] {
    let cell = FrameBox::of(frame);
    let side = |axis: usize| {
        let reach = 2.0 * cell.low[axis].abs().max(cell.high[axis].abs());
        if reach > 0.0 { reach } else { 1.0 }
    };
    [side(0), side(1), side(2), tilt(cell.slide, side(1)), 0.0, 0.0]
}

/// The tilt factor of HOOMD-blue: the slide of the box above in parts of the edge along y.
fn tilt(slide: f64, edge: f64) -> f64 {
    if slide == 0.0 { 0.0 } else { slide / edge }
}

/// Reads a frame.
pub(super) fn frame(chunks: &mut Chunks, frame: u64) -> Result<ParticleFrame, Fault> {
    let mut source = Source { chunks, frame };
    let count = source.whole("particles/N", 1)?.map_or(0, |all| all[0]);
    // A count beyond the chunks of the file is refused before memory is taken for it.
    let positions =
        match source.exact("particles/position", "log/particles/position", 1.0, count)? {
            // The library of GSD leaves out positions that are all 0.
            None if count <= 1 => vec![[0.0; 3]; count as usize],
            positions => positions.ok_or("particles/position is missing")?,
        };
    let ids = source.whole("log/particles/id", count)?;
    let ids = ids.filter(|ids| ids.is_sorted_by(|one, other| one < other));
    let diameters = source.exact("particles/diameter", "log/particles/radius", 2.0, count)?;
    let orientations =
        source.exact("particles/orientation", "log/particles/orientation", 1.0, count)?;
    let last_first = |[w, x, y, z]: [f64; 4]| [x, y, z, w];
    let orientations =
        orientations.map(|all: Vec<[f64; 4]>| all.into_iter().map(last_first).collect::<Vec<_>>());
    let principal: Option<Vec<[f64; 3]>> = source.reals("particles/moment_inertia", count)?;
    let inertias = principal.map(|all| all.into_iter().map(|[x, ..]| x).collect::<Vec<_>>());
    let angular_velocities = match source.reals("log/particles/angular_velocity", count)? {
        None => source.angular_velocities(inertias.as_deref(), orientations.as_deref(), count)?,
        found => found,
    };
    let masses = source.exact("particles/mass", "log/particles/mass", 1.0, count)?;
    let sides = source.sides()?;
    Ok(ParticleFrame {
        time: source.reals("log/time", 1)?.map(|all: Vec<[f64; 1]>| all[0][0]),
        sides,
        slide: source.slide(sides)?,
        ids: ids.unwrap_or_else(|| (0..count).collect()),
        positions,
        velocities: source.exact("particles/velocity", "log/particles/velocity", 1.0, count)?,
        radii: diameters.map(flat),
        masses: masses.map(flat),
        inertias,
        orientations,
        angular_velocities,
    })
}

fn flat(rows: Vec<[f64; 1]>) -> Vec<f64> {
    rows.into_flattened()
}

/// The chunks of one frame.
struct Source<'a> {
    chunks: &'a mut Chunks,
    frame: u64,
}

impl Source<'_> {
    /// Reads a chunk with this number of rows and columns. Where the frame has none, that of the first
    /// frame counts, if its number of rows is the same.
    fn chunk(&mut self, name: &str, rows: u64, columns: u32) -> Result<Option<Chunk>, Fault> {
        let chunk = match self.chunks.read(self.frame, name)? {
            None => self.chunks.read(0, name)?.filter(|chunk| chunk.rows == rows),
            found => found,
        };
        match &chunk {
            Some(it) if (it.rows, it.columns) != (rows, columns) => {
                let found = format!("({}, {})", it.rows, it.columns);
                Err(format!("{name} has the shape {found}, expected ({rows}, {columns})").into())
            }
            _ => Ok(chunk),
        }
    }

    fn reals<const N: usize>(
        &mut self,
        name: &str,
        rows: u64,
    ) -> Result<Option<Vec<[f64; N]>>, Fault> {
        let Some(chunk) = self.chunk(name, rows, N as u32)? else { return Ok(None) };
        let numbers = chunk.reals().filter(|all| all.iter().all(|it| it.is_finite()));
        let numbers = numbers.ok_or_else(|| format!("{name} must be finite real numbers"))?;
        Ok(Some(numbers.as_chunks().0.to_vec()))
    }

    fn whole(&mut self, name: &str, rows: u64) -> Result<Option<Vec<u64>>, Fault> {
        let Some(chunk) = self.chunk(name, rows, 1)? else { return Ok(None) };
        let numbers = chunk.whole();
        Ok(Some(numbers.ok_or_else(|| format!("{name} must be whole numbers, not negative"))?))
    }

    /// Reads a quantity of the schema, and what Carom logged of it in double precision, `factor` of
    /// which is that quantity. A program that changed the quantity may have left the log.
    fn exact<const N: usize>(
        &mut self,
        name: &str,
        logged: &str,
        factor: f64,
        rows: u64,
    ) -> Result<Option<Vec<[f64; N]>>, Fault> {
        let Some(shown) = self.reals::<N>(name, rows)? else { return Ok(None) };
        let logged = self.reals::<N>(logged, rows)?.filter(|logged| {
            let both = logged.as_flattened().iter().zip(shown.as_flattened());
            both.into_iter().all(|(own, shown)| f64::from((factor * own) as f32) == *shown)
        });
        Ok(Some(logged.unwrap_or_else(|| {
            shown.into_iter().map(|row| row.map(|number| number / factor)).collect()
        })))
    }

    /// Computes angular velocities \[rad/s\] from angular momenta, where bodies have moments of
    /// inertia; inverts [`angular_momentum`].
    fn angular_velocities(
        &mut self,
        inertias: Option<&[f64]>,
        orientations: Option<&[[f64; 4]]>,
        count: u64,
    ) -> Result<Option<Vec<[f64; 3]>>, Fault> {
        let momenta: Option<Vec<[f64; 4]>> = self.reals("particles/angmom", count)?;
        let (Some(momenta), Some(inertias)) = (momenta, inertias) else { return Ok(None) };
        let velocity = |(index, [w, x, y, z]): (usize, [f64; 4])| {
            let orientation =
                orientations.map_or(DQuat::IDENTITY, |all| DQuat::from_array(all[index]));
            let momentum = DQuat::from_xyzw(x, y, z, w) * orientation.conjugate();
            let momentum = 0.5 * DVec3::new(momentum.x, momentum.y, momentum.z);
            match inertias[index] > 0.0 {
                true => (momentum / inertias[index]).to_array(),
                false => [0.0; 3],
            }
        };
        Ok(Some(momenta.into_iter().enumerate().map(velocity).collect()))
    }

    /// Reads the sides of the box \[m\]: those of Carom where the file has them, else those of
    /// HOOMD-blue, which are periodic.
    fn sides(&mut self) -> Result<[f64; 3], Fault> {
        let Some(shown) = self.reals::<1>("configuration/box", 6)?.map(flat) else {
            return Ok([f64::INFINITY; 3]);
        };
        if shown[4..].iter().any(|&tilt| tilt != 0.0) {
            return Err(SKEWED.into());
        }
        let periodic = self.whole("log/periodic", 3)?;
        let exact = self.reals::<1>("log/box", 3)?.map(flat);
        let mut sides = [f64::INFINITY; 3];
        for axis in 0..3 {
            let is_periodic = periodic.as_ref().is_none_or(|all| all[axis] != 0);
            // A box of two dimensions has no height.
            if is_periodic && shown[axis] != 0.0 {
                let own = exact.as_ref().map(|exact| exact[axis]);
                let own = own.filter(|&own| f64::from(own as f32) == shown[axis]);
                sides[axis] = own.unwrap_or(shown[axis]);
            }
            if sides[axis] <= 0.0 {
                return Err("a periodic edge of the box must be longer than 0".into());
            }
        }
        Ok(sides)
    }

    /// Reads the slide of the box above \[m\]: that of Carom where it is that of HOOMD-blue.
    fn slide(&mut self, sides: [f64; 3]) -> Result<Option<f64>, Fault> {
        let shown = self.reals::<1>("configuration/box", 6)?.map_or(0.0, |all| all[3][0]);
        if shown == 0.0 {
            return Ok(None);
        }
        if !(sides[0].is_finite() && sides[1].is_finite()) {
            return Err(SKEWED.into());
        }
        let own = self.reals::<1>("log/slide", 1)?.map(|all| all[0][0]);
        let own = own.filter(|&own| f64::from(tilt(own, sides[1]) as f32) == shown);
        Ok(Some(own.unwrap_or(shown * sides[1])))
    }
}
