//! Reads the table of a recorded run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use carom::DVec3;
use carom_scene::legible;
use carom_scene::recording::ParticleFormat;

use crate::error::GradeError;
use crate::number::{decimals, number};
use crate::particles;
use crate::table::{Columns, Places, Table, broken};

/// Most rows of a table.
const MOST_ROWS: usize = 2_000_000;

/// Latest time that is accepted \[s\]: a day.
const LONGEST: f64 = 86_400.0;

/// Largest distance from the origin that is accepted \[m\].
const FARTHEST: f64 = 1e9;

/// Most bytes of a table.
const MOST_BYTES: u64 = 512 << 20;

/// Format of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Names of the columns.
    pub columns: Columns,
    /// Unit of length \[m\].
    pub length_unit: f64,
    /// Unit of time \[s\].
    pub time_unit: f64,
    /// Offset that is added to times \[s\].
    pub time_offset: f64,
    /// Whether the table uses Unity's left-handed coordinates, in which z is mirrored.
    pub unity: bool,
}

impl Default for Reading {
    fn default() -> Self {
        let columns = Columns::default();
        Self { columns, length_unit: 1.0, time_unit: 1.0, time_offset: 0.0, unity: false }
    }
}

impl Reading {
    /// Unit of length \[m\]: of the option, or else of the heading.
    fn length_unit(&self, places: &Places) -> f64 {
        if self.length_unit == 1.0 { places.length_unit.unwrap_or(1.0) } else { self.length_unit }
    }

    /// Unit of time \[s\]: of the option, or else of the heading.
    fn time_unit(&self, places: &Places) -> f64 {
        if self.time_unit == 1.0 { places.time_unit.unwrap_or(1.0) } else { self.time_unit }
    }
}

/// A row of a table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Row {
    /// Line in the file, from 1.
    pub line: u64,
    /// Time \[s\].
    pub time: f64,
    /// Index of the ball in the list of labels.
    pub label: usize,
    /// Position \[m\].
    pub position: DVec3,
    /// Velocity \[m/s\].
    pub velocity: Option<DVec3>,
}

/// A recorded run.
#[derive(Debug, Clone)]
pub struct Recorded {
    /// Path of the file.
    pub path: PathBuf,
    /// Rows, by time, then by label.
    pub(crate) rows: Vec<Row>,
    /// Labels of balls, in order of appearance; by number if several appear at one time.
    pub(crate) labels: Vec<String>,
    /// Half of the last decimal of positions \[m\].
    pub(crate) resolution: f64,
    /// 1 for each coordinate that the table has, 0 for the others.
    pub(crate) seen: DVec3,
}

impl Recorded {
    /// Reads the table or the particle file of a run.
    ///
    /// # Errors
    /// [`GradeError`] for a file that cannot be read, or for an invalid line, with its number.
    pub fn read(path: &Path, reading: &Reading) -> Result<Self, GradeError> {
        if let Some(format) = ParticleFormat::of(path) {
            let bytes = particles::table(path, format)?.into_bytes();
            return Self::parse(
                path,
                &bytes,
                &Reading { columns: Columns::default(), ..reading.clone() },
            );
        }
        let unreadable = |source| GradeError::Unreadable { path: path.to_owned(), source };
        Self::read_from(File::open(path).map_err(unreadable)?, path, reading)
    }

    /// Reads the table of a run from a stream that errors call `path`.
    ///
    /// # Errors
    /// The same as those of [`Self::read`].
    pub fn read_from(
        stream: impl Read,
        path: &Path,
        reading: &Reading,
    ) -> Result<Self, GradeError> {
        let unreadable = |source| GradeError::Unreadable { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        // The limit also stops the reading of endless devices.
        stream.take(MOST_BYTES + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(refused(path, "is larger than 512 MiB"));
        }
        Self::parse(path, &bytes, reading)
    }

    /// Reads the table of a run from the content of a file.
    ///
    /// # Errors
    /// [`GradeError`] for an invalid line, with its number.
    pub fn parse(path: &Path, bytes: &[u8], reading: &Reading) -> Result<Self, GradeError> {
        let Table { places: balls, width, records } = Table::find(path, bytes, &reading.columns)?;
        let first = &balls[0];
        let is_seen = |place: Option<usize>| f64::from(u8::from(place.is_some()));
        let seen = DVec3::from_array(first.position.map(is_seen));
        let length_unit = reading.length_unit(first);
        let mut parts = Parts { path, reading, width, labels: BTreeMap::new(), decimals: 0 };
        let mut rows = Vec::new();
        for record in records {
            let record = record.map_err(|error| broken(path, &error))?;
            for places in &balls {
                if parts.is_empty(&record, places) {
                    continue;
                }
                if rows.len() == MOST_ROWS {
                    return Err(refused(path, "has more than 2,000,000 rows"));
                }
                rows.push(parts.row(&record, places)?);
            }
        }
        if rows.is_empty() {
            return Err(refused(path, "has no rows"));
        }
        let resolution = 0.5 * 10_f64.powi(-parts.decimals) * length_unit;
        let labels = order(&mut rows, parts.labels);
        let twice =
            rows.windows(2).find(|it| (it[0].time, it[0].label) == (it[1].time, it[1].label));
        if let Some([first, second]) = twice {
            let ball = &labels[first.label];
            let problem = format!("ball {ball} at this time is in line {} already", first.line);
            return Err(malformed(path, second.line, problem));
        }
        Ok(Self { path: path.to_owned(), rows, labels, resolution, seen })
    }

    /// Distance of a row from a position in the coordinates that the table has \[m\].
    pub(crate) fn distance(&self, row: &Row, position: DVec3) -> f64 {
        ((row.position - position) * self.seen).length()
    }

    /// Last time \[s\].
    pub(crate) fn end(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.time)
    }

    /// All times \[s\], ascending.
    pub(crate) fn times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.rows.iter().map(|row| row.time).collect();
        times.dedup();
        times
    }
}

/// State of the parser.
struct Parts<'a> {
    path: &'a Path,
    reading: &'a Reading,
    /// Number of fields of the heading.
    width: usize,
    /// Labels, each with its index in the order of lines.
    labels: BTreeMap<String, usize>,
    /// Most decimals of a position.
    decimals: i32,
}

impl Parts<'_> {
    fn row(&mut self, record: &csv::StringRecord, places: &Places) -> Result<Row, GradeError> {
        let line = record.position().map_or(0, csv::Position::line);
        self.check_width(record, line, places)?;
        let Reading { time_offset, unity, .. } = *self.reading;
        let length_unit = self.reading.length_unit(places);
        let time_unit = self.reading.time_unit(places);
        let mirrored = if unity { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
        let time = self.number(record, line, places.time)? * time_unit + time_offset;
        let position = self.position(record, line, places)? * length_unit * mirrored;
        for place in places.position.into_iter().flatten() {
            self.decimals = self.decimals.max(decimals(record.get(place).unwrap_or_default()));
        }
        let velocity = places.velocity.map(|it| self.vector(record, line, it)).transpose()?;
        let velocity = velocity.map(|it| it * (length_unit / time_unit) * mirrored);
        if time < 0.0 {
            let problem = format!("the time {time} s is before the start");
            return Err(malformed(self.path, line, problem));
        }
        if time > LONGEST {
            let problem = format!("the time {time:e} s is more than a day after the start");
            return Err(malformed(self.path, line, problem));
        }
        if position.abs().max_element() > FARTHEST {
            return Err(malformed(self.path, line, "the ball is farther than 1e9 m".to_owned()));
        }
        let name = places.name.as_deref().unwrap_or("0");
        let label = places.ball.and_then(|place| record.get(place)).unwrap_or(name);
        if label.is_empty() {
            return Err(malformed(self.path, line, "the ball is missing".to_owned()));
        }
        let next = self.labels.len();
        let label = *self.labels.entry(label.to_owned()).or_insert(next);
        Ok(Row { line, time, label, position, velocity })
    }

    /// Whether a record has no position: a blank row, or a frame in which a ball was not seen.
    fn is_empty(&self, record: &csv::StringRecord, places: &Places) -> bool {
        let mut own = places.position.iter().flatten().map(|place| record.get(*place));
        let has_time = record.get(places.time).is_some_and(|it| !it.is_empty());
        let is_whole = !has_time || record.len() >= self.width;
        is_whole && own.all(|it| it.is_none_or(str::is_empty))
    }

    /// Checks that a record has the columns that are read, and none that the heading does not have.
    fn check_width(
        &self,
        record: &csv::StringRecord,
        line: u64,
        places: &Places,
    ) -> Result<(), GradeError> {
        let Places { time, ball, position, velocity, .. } = places;
        let velocity = velocity.iter().flatten();
        let last = position.iter().flatten().chain(ball).chain(velocity).chain([time]).max();
        let is_long = record.iter().skip(self.width).any(|it| !it.is_empty());
        if !is_long && last.is_none_or(|last| *last < record.len()) {
            return Ok(());
        }
        let (fields, width) = (record.len(), self.width);
        let problem = format!("{fields} fields where the first line has {width}");
        Err(malformed(self.path, line, problem))
    }

    /// Position in the units of the table; 0 for a coordinate that it does not have.
    fn position(
        &self,
        record: &csv::StringRecord,
        line: u64,
        places: &Places,
    ) -> Result<DVec3, GradeError> {
        let mut values = [0.0; 3];
        for (value, place) in values.iter_mut().zip(places.position) {
            if let Some(place) = place {
                *value = self.number(record, line, place)?;
            }
        }
        Ok(DVec3::from_array(values))
    }

    fn vector(
        &self,
        record: &csv::StringRecord,
        line: u64,
        places: [usize; 3],
    ) -> Result<DVec3, GradeError> {
        let mut values = [0.0; 3];
        for (value, place) in values.iter_mut().zip(places) {
            *value = self.number(record, line, place)?;
        }
        Ok(DVec3::from_array(values))
    }

    fn number(
        &self,
        record: &csv::StringRecord,
        line: u64,
        place: usize,
    ) -> Result<f64, GradeError> {
        let text = record.get(place).unwrap_or_default();
        number(text).ok_or_else(|| {
            let text = legible(text, 60);
            let problem = format!("\"{text}\" is no number, in column {}", place + 1);
            malformed(self.path, line, problem)
        })
    }
}

/// Sorts rows by time and ball; returns the labels in order of appearance, by number if several
/// appear at one time.
fn order(rows: &mut [Row], labels: BTreeMap<String, usize>) -> Vec<String> {
    let mut first = vec![f64::INFINITY; labels.len()];
    for row in rows.iter() {
        first[row.label] = first[row.label].min(row.time);
    }
    let mut labels: Vec<(String, usize)> = labels.into_iter().collect();
    let place =
        |(label, line): &(String, usize)| (first[*line], whole(label).unwrap_or(i64::MAX), *line);
    labels.sort_by(|a, b| {
        let (a, b) = (place(a), place(b));
        a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2))
    });
    let mut places = vec![0; labels.len()];
    for (place, (_, line)) in labels.iter().enumerate() {
        places[*line] = place;
    }
    rows.iter_mut().for_each(|row| row.label = places[row.label]);
    rows.sort_by(|a, b| a.time.total_cmp(&b.time).then(a.label.cmp(&b.label)));
    labels.into_iter().map(|(label, _)| label).collect()
}

/// Converts a label to a whole number, if it is one.
pub(crate) fn whole(label: &str) -> Option<i64> {
    let value = number(label)?;
    (value == value.trunc() && value.abs() < 1e15).then_some(value as i64)
}

fn malformed(path: &Path, line: u64, problem: String) -> GradeError {
    GradeError::Malformed { path: path.to_owned(), line, problem }
}

fn refused(path: &Path, problem: &str) -> GradeError {
    GradeError::Refused { path: path.to_owned(), problem: problem.to_owned() }
}
