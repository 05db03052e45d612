//! Reads trajectories in CSV files frame by frame.

mod error;
mod frame;
mod start;

pub use error::{LineProblem, ReplayError};
pub use frame::{ReplayBall, ReplayFrame};

use start::Start;

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use carom::{Boundary, DQuat, DVec3, World};

use super::csv_table::{HEADER, ORIENTATION};
use super::rotation;
use super::short_lines::{ShortLines, TooLong};
use crate::error::SceneError;
use crate::origin::{Origin, Origins};
use crate::palette;
use crate::scene::{Color, Scene};

/// Reads a trajectory that [`Trajectory`](super::Trajectory) wrote as CSV, frame by frame. The file
/// may be larger than the memory.
///
/// The file contains the positions of balls; the scene provides their radii and masses, by number.
/// It must be the scene of the run, with the same overrides. Emitters are followed as in the run,
/// frame by frame. A time without balls has no row in a table, so it is no frame.
#[derive(Debug)]
pub struct Replay {
    path: PathBuf,
    reader: csv::Reader<ShortLines<File>>,
    columns: Columns,
    balls: Balls,
    /// First row of the next frame.
    next: Option<Row>,
    has_begun: bool,
    /// State of the scene at its start, which the file does not contain.
    start: Start,
}

/// Indices of the columns of a table.
#[derive(Debug, Clone, Copy)]
struct Columns {
    /// Columns of [`HEADER`].
    motion: [usize; 8],
    /// Columns of [`ORIENTATION`], if the table has them.
    orientation: Option<[usize; 4]>,
}

/// A row of the table, with its line number.
#[derive(Debug, Clone, Copy)]
struct Row {
    line: u64,
    time: f64,
    number: u64,
    position: DVec3,
    velocity: DVec3,
    orientation: Option<DQuat>,
}

impl Columns {
    /// Finds the columns in a header; the error is the name of a missing one.
    fn of(header: &csv::StringRecord) -> Result<Self, &'static str> {
        let has_rotation = ORIENTATION.iter().any(|column| place(header, column).is_ok());
        let orientation = has_rotation.then(|| places(header, ORIENTATION)).transpose()?;
        Ok(Self { motion: places(header, HEADER)?, orientation })
    }
}

/// Indices of the columns with these names.
fn places<const N: usize>(
    header: &csv::StringRecord,
    names: [&'static str; N],
) -> Result<[usize; N], &'static str> {
    let mut places = [0; N];
    for (found, name) in places.iter_mut().zip(names) {
        *found = place(header, name)?;
    }
    Ok(places)
}

/// Index of the column with this name.
fn place(header: &csv::StringRecord, column: &'static str) -> Result<usize, &'static str> {
    header.iter().position(|name| name.trim() == column).ok_or(column)
}

impl Replay {
    /// Opens a recording of `scene`.
    ///
    /// # Errors
    /// [`ReplayError::Unreadable`] and [`ReplayError::MissingColumn`] if the file is no recording,
    /// [`ReplayError::CutShort`] if its last line is incomplete, [`ReplayError::Scene`] if the
    /// scene is invalid.
    pub fn open(path: &Path, scene: &Scene) -> Result<Self, ReplayError> {
        let unreadable = |source| ReplayError::Unreadable { path: path.to_owned(), source };
        let mut file = File::open(path).map_err(unreadable)?;
        if !ends_with_a_line(&mut file).map_err(unreadable)? {
            return Err(ReplayError::CutShort { path: path.to_owned() });
        }
        let mut reader = csv::Reader::from_reader(ShortLines::new(file));
        let header = reader.headers().map_err(|error| broken(path, error))?.clone();
        let missing = |column| ReplayError::MissingColumn { path: path.to_owned(), column };
        let columns = Columns::of(&header).map_err(missing)?;
        let world = scene.world()?;
        let balls = Balls::new(scene, &world)?;
        let at_start = balls.at_start(&world, columns.orientation.is_some());
        let frame = ReplayFrame { time: world.time(), balls: at_start };
        let start = Start::new(scene, frame, world.settings().boundary);
        let path = path.to_owned();
        Ok(Self { path, reader, columns, balls, next: None, has_begun: false, start })
    }

    /// State of the scene at its start, which is before the first recorded frame.
    pub fn start(&self) -> &ReplayFrame {
        &self.start.frame
    }

    /// Boundary of the scene.
    pub(super) fn boundary(&self) -> Boundary {
        self.start.boundary
    }

    /// Reads the next frame; `None` after the last one.
    ///
    /// # Errors
    /// [`ReplayError::Line`] if a line is invalid, if the scene does not have a ball, or if most
    /// balls of the first frame are too far from their start; [`ReplayError::Empty`] if the
    /// recording has no frame; [`ReplayError::Unreadable`] if the disk is gone.
    pub fn next_frame(&mut self) -> Result<Option<ReplayFrame>, ReplayError> {
        let is_first = !self.has_begun;
        if is_first {
            self.has_begun = true;
            self.next = self.read_row()?;
            if self.next.is_none() {
                return Err(ReplayError::Empty { path: self.path.clone() });
            }
        }
        let Some(mut last) = self.next.take() else {
            return Ok(None);
        };
        let mut frame = ReplayFrame { time: last.time, balls: vec![self.ball(&last)?] };
        let first_line = last.line;
        while let Some(row) = self.read_row()? {
            if row.time < last.time {
                let problem = LineProblem::TimeGoesBack { time: row.time, last: last.time };
                return Err(self.line(row.line, problem));
            }
            if row.time > last.time {
                self.next = Some(row);
                break;
            }
            if row.number <= last.number {
                let problem = LineProblem::Order { ball: row.number, last: last.number };
                return Err(self.line(row.line, problem));
            }
            frame.balls.push(self.ball(&row)?);
            last = row;
        }
        if is_first {
            let stray = self.start.first_stray(&frame);
            stray.map_or(Ok(()), |(row, stray)| Err(self.line(first_line + row, stray)))?;
        }
        Ok(Some(frame))
    }

    fn read_row(&mut self) -> Result<Option<Row>, ReplayError> {
        let mut record = csv::StringRecord::new();
        let read = self.reader.read_record(&mut record);
        if !read.map_err(|error| broken(&self.path, error))? {
            return Ok(None);
        }
        let line = record.position().map_or(0, csv::Position::line);
        let row = parse(&record, &self.columns);
        row.map(|row| Some(Row { line, ..row })).map_err(|problem| self.line(line, problem))
    }

    fn ball(&mut self, row: &Row) -> Result<ReplayBall, ReplayError> {
        let Row { line, time, number, position, velocity, orientation } = *row;
        let kind = self.balls.kind(number, time);
        let unknown = || self.line(line, LineProblem::UnknownBall { ball: number, time });
        let Kind { radius, mass, color } = kind.ok_or_else(unknown)?;
        Ok(ReplayBall { number, position, velocity, orientation, radius, mass, color })
    }

    fn line(&self, line: u64, problem: LineProblem) -> ReplayError {
        ReplayError::Line { path: self.path.clone(), line, problem }
    }
}

/// Returns whether the file ends with a complete line, and seeks its start. An incomplete number
/// could pass as a complete one. Empty files and pipes count as complete.
fn ends_with_a_line(file: &mut File) -> io::Result<bool> {
    let metadata = file.metadata()?;
    if !metadata.is_file() || metadata.len() == 0 {
        return Ok(true);
    }
    let mut last = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut last)?;
    file.rewind()?;
    Ok(last == *b"\n")
}

/// Parses a row; the line number remains 0.
fn parse(record: &csv::StringRecord, columns: &Columns) -> Result<Row, LineProblem> {
    let values = numbers(record, HEADER, columns.motion)?;
    let [time, _, x, y, z, vx, vy, vz] = values;
    let text = field(record, columns.motion[1]);
    let number = text.parse().map_err(|_| not_a_number(HEADER[1], text))?;
    let (position, velocity) = (DVec3::new(x, y, z), DVec3::new(vx, vy, vz));
    let numbers = columns.orientation.map(|places| numbers(record, ORIENTATION, places));
    let orientation = numbers.transpose()?.map(orientation).transpose()?;
    Ok(Row { line: 0, time, number, position, velocity, orientation })
}

/// Parses the numbers in columns of these names.
fn numbers<const N: usize>(
    record: &csv::StringRecord,
    names: [&'static str; N],
    places: [usize; N],
) -> Result<[f64; N], LineProblem> {
    let mut values = [0.0; N];
    for ((value, name), place) in values.iter_mut().zip(names).zip(places) {
        let text = field(record, place);
        let parsed = text.parse().ok().filter(|value: &f64| value.is_finite());
        *value = parsed.ok_or_else(|| not_a_number(name, text))?;
    }
    Ok(values)
}

fn field(record: &csv::StringRecord, place: usize) -> &str {
    record.get(place).unwrap_or_default().trim()
}

fn not_a_number(column: &'static str, text: &str) -> LineProblem {
    LineProblem::NotANumber { column, text: text.to_owned() }
}

/// Converts four numbers to a rotation; normalizes them unless they are normalized to rounding.
fn orientation(numbers: [f64; 4]) -> Result<DQuat, LineProblem> {
    let written = DQuat::from_array(numbers);
    let shortening = written.length_recip();
    if !(shortening.is_finite() && shortening > 0.0) {
        return Err(LineProblem::NotARotation(numbers));
    }
    Ok(if written.is_normalized() { written } else { written.normalize() })
}

/// Converts an error of the CSV reader.
fn broken(path: &Path, error: csv::Error) -> ReplayError {
    let path = path.to_owned();
    let line = error.position().map_or(0, csv::Position::line);
    if let csv::ErrorKind::Io(source) = error.kind()
        && let Some(TooLong { line }) = source.get_ref().and_then(|it| it.downcast_ref())
    {
        return ReplayError::Line { path, line: *line, problem: LineProblem::TooLong };
    }
    let problem = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            LineProblem::Fields { fields: *len, expected: *expected_len }
        }
        csv::ErrorKind::Utf8 { .. } => LineProblem::NotText,
        _ => return ReplayError::Unreadable { path, source: error.into() },
    };
    ReplayError::Line { path, line, problem }
}

/// The constant properties of a ball.
#[derive(Debug, Clone, Copy)]
struct Kind {
    radius: f64,
    mass: f64,
    color: Option<Color>,
}

/// Constant properties of the balls of a scene, by number.
#[derive(Debug)]
struct Balls {
    origins: Origins,
    initial: Vec<Kind>,
    /// Properties of the balls of each emitter.
    emitted: Vec<Kind>,
}

impl Balls {
    /// Reads the properties from a scene and its world at the start.
    fn new(scene: &Scene, world: &World) -> Result<Self, SceneError> {
        let origins = palette::origins(scene)?;
        let color = |number| match origins.of(number)? {
            Origin::Sphere(index) => scene.spheres[index].color,
            Origin::Generator(index) => scene.generators[index].sphere().and_then(|it| it.color),
            Origin::Emitter(_) => None,
        };
        let spheres = world.spheres();
        let sizes = spheres.radii().iter().zip(spheres.masses());
        let initial = (0..).zip(sizes).map(|(number, (&radius, &mass))| Kind {
            radius,
            mass,
            color: color(number),
        });
        let initial = initial.collect();
        let emitted = world.emitters().zip(&scene.emitters).map(|((_, emitter), written)| {
            let carom::Emitter { sphere, .. } = emitter;
            Kind { radius: sphere.radius, mass: sphere.kilograms(), color: written.sphere.color }
        });
        let emitted = emitted.collect();
        Ok(Self { origins, initial, emitted })
    }

    /// Balls of the world at its start, with orientations if the recording has them.
    fn at_start(&self, world: &World, has_rotation: bool) -> Vec<ReplayBall> {
        let spheres = world.spheres();
        let states = spheres.positions().iter().zip(spheres.velocities());
        let balls = self.initial.iter().zip(states).enumerate();
        let ball = |(i, (kind, (&position, &velocity))): (usize, (&Kind, (&DVec3, &DVec3)))| {
            let Kind { radius, mass, color } = *kind;
            let turned = || DQuat::from_array(rotation::orientation(world, i));
            let orientation = has_rotation.then(turned);
            ReplayBall { number: i as u64, position, velocity, orientation, radius, mass, color }
        };
        balls.map(ball).collect()
    }

    /// Properties of the ball of this number; `None` if the scene does not have it at this time
    /// \[s\].
    fn kind(&mut self, number: u64, time: f64) -> Option<Kind> {
        let index = usize::try_from(number).ok()?;
        if let Some(kind) = self.initial.get(index) {
            return Some(*kind);
        }
        self.origins.follow_to(number, time);
        match self.origins.of(number)? {
            Origin::Emitter(emitter) => self.emitted.get(emitter).copied(),
            Origin::Sphere(_) | Origin::Generator(_) => None,
        }
    }
}
