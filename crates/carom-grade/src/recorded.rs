//! Reads the table of a recorded run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use carom::DVec3;
use carom_scene::legible;

use crate::error::GradeError;
use crate::number::{decimals, number};

/// Most rows of a table.
const MOST_ROWS: usize = 2_000_000;

/// Latest time that is accepted \[s\]: a day.
const LONGEST: f64 = 86_400.0;

/// Largest distance from the origin that is accepted \[m\].
const FARTHEST: f64 = 1e9;

/// Most bytes of a table.
const MOST_BYTES: u64 = 512 << 20;

/// Default names of columns, in lower case. If several exist, the first of this list counts.
const USUAL: [(&str, &[&str], &str); 8] = [
    ("t", &["t", "time", "seconds"], "the time"),
    ("ball", &["ball", "id", "index", "sphere", "number"], "the ball"),
    ("x", &["x", "px", "pos_x", "position_x", "position.x"], "the position"),
    ("y", &["y", "py", "pos_y", "position_y", "position.y"], "the position"),
    ("z", &["z", "pz", "pos_z", "position_z", "position.z"], "the position"),
    ("vx", &["vx", "vel_x", "velocity_x", "velocity.x"], "the velocity"),
    ("vy", &["vy", "vel_y", "velocity_y", "velocity.y"], "the velocity"),
    ("vz", &["vz", "vel_z", "velocity_z", "velocity.z"], "the velocity"),
];

/// Names of columns that differ from the defaults: `t=time,ball=id`.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Columns(BTreeMap<&'static str, String>);

impl FromStr for Columns {
    type Err = GradeError;

    fn from_str(text: &str) -> Result<Self, GradeError> {
        let mut names = BTreeMap::new();
        for part in text.split(',').filter(|part| !part.trim().is_empty()) {
            let wrong = |what: &str| {
                let keys: Vec<&str> = USUAL.iter().map(|usual| usual.0).collect();
                let keys = keys.join(", ");
                GradeError::Columns(format!("columns: {what}; write t=NAME, for {keys}"))
            };
            let (key, name) = part.split_once('=').ok_or_else(|| wrong("there is no ="))?;
            let key = USUAL.iter().map(|usual| usual.0).find(|it| *it == key.trim());
            let key = key.ok_or_else(|| wrong(&format!("\"{part}\" names no quantity")))?;
            if names.insert(key, name.trim().to_owned()).is_some() {
                return Err(wrong(&format!("{key} is there twice")));
            }
        }
        Ok(Self(names))
    }
}

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
    /// Reads the table of a run.
    ///
    /// # Errors
    /// [`GradeError`] for a file that cannot be read, or for an invalid line, with its number.
    pub fn read(path: &Path, reading: &Reading) -> Result<Self, GradeError> {
        let unreadable = |source| GradeError::Unreadable { path: path.to_owned(), source };
        let mut bytes = Vec::new();
        // The limit also stops the reading of endless devices.
        let mut file = File::open(path).map_err(unreadable)?.take(MOST_BYTES + 1);
        file.read_to_end(&mut bytes).map_err(unreadable)?;
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
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let first = bytes.split(|it| *it == b'\n').next().unwrap_or_default();
        let delimiter = [b';', b'\t'].into_iter().find(|it| first.contains(it)).unwrap_or(b',');
        let mut table = csv::ReaderBuilder::new();
        table.delimiter(delimiter).trim(csv::Trim::All);
        let mut table = table.from_reader(bytes);
        let broken = |error: csv::Error| broken(path, &error);
        let header = table.headers().map_err(broken)?.clone();
        let places = Places::of(path, &header, &reading.columns)?;
        let mut parts = Parts { path, reading, places, labels: BTreeMap::new(), decimals: 0 };
        let mut rows = Vec::new();
        let mut record = csv::StringRecord::new();
        while table.read_record(&mut record).map_err(broken)? {
            if rows.len() == MOST_ROWS {
                return Err(refused(path, "has more than 2,000,000 rows"));
            }
            rows.push(parts.row(&record)?);
        }
        if rows.is_empty() {
            return Err(refused(path, "has no rows"));
        }
        let resolution = 0.5 * 10_f64.powi(-parts.decimals) * reading.length_unit;
        let labels = order(&mut rows, parts.labels);
        let twice =
            rows.windows(2).find(|it| (it[0].time, it[0].label) == (it[1].time, it[1].label));
        if let Some([first, second]) = twice {
            let ball = &labels[first.label];
            let problem = format!("ball {ball} at this time is in line {} already", first.line);
            return Err(malformed(path, second.line, problem));
        }
        Ok(Self { path: path.to_owned(), rows, labels, resolution, seen: DVec3::ONE })
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

/// Indices of the columns of a table.
struct Places {
    time: usize,
    ball: Option<usize>,
    position: [usize; 3],
    velocity: Option<[usize; 3]>,
}

impl Places {
    fn of(path: &Path, header: &csv::StringRecord, columns: &Columns) -> Result<Self, GradeError> {
        let find = |number: usize| -> Result<usize, GradeError> {
            let (key, usual, what) = USUAL[number];
            let named = columns.0.get(key);
            let place = match named {
                Some(named) => header.iter().position(|name| name == named),
                // The first name of the list counts: beside `ball`, a column `index` may number
                // rows.
                None => usual
                    .iter()
                    .find_map(|usual| header.iter().position(|name| name.to_lowercase() == *usual)),
            };
            place.ok_or_else(|| GradeError::MissingColumn {
                path: path.to_owned(),
                column: named.map_or(key, String::as_str).to_owned(),
                what,
                key,
                there: header.iter().collect::<Vec<_>>().join(", "),
            })
        };
        let is_named = |key: &str| columns.0.contains_key(key);
        let ball = match find(1) {
            Err(_) if !is_named("ball") => None,
            found => Some(found?),
        };
        let velocity = [find(5), find(6), find(7)];
        let is_wanted = ["vx", "vy", "vz"].into_iter().any(is_named);
        let velocity = match velocity {
            [Ok(x), Ok(y), Ok(z)] => Some([x, y, z]),
            [x, y, z] if is_wanted => Some([x?, y?, z?]),
            _ => None,
        };
        Ok(Self { time: find(0)?, ball, position: [find(2)?, find(3)?, find(4)?], velocity })
    }
}

/// State of the parser.
struct Parts<'a> {
    path: &'a Path,
    reading: &'a Reading,
    places: Places,
    /// Labels, each with its index in the order of lines.
    labels: BTreeMap<String, usize>,
    /// Most decimals of a position.
    decimals: i32,
}

impl Parts<'_> {
    fn row(&mut self, record: &csv::StringRecord) -> Result<Row, GradeError> {
        let line = record.position().map_or(0, csv::Position::line);
        let Reading { length_unit, time_unit, time_offset, unity, .. } = *self.reading;
        let mirrored = if unity { DVec3::new(1.0, 1.0, -1.0) } else { DVec3::ONE };
        let time = self.number(record, line, self.places.time)? * time_unit + time_offset;
        let position = self.vector(record, line, self.places.position)? * length_unit * mirrored;
        for place in self.places.position {
            self.decimals = self.decimals.max(decimals(record.get(place).unwrap_or_default()));
        }
        let velocity = self.places.velocity.map(|it| self.vector(record, line, it)).transpose()?;
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
        let label = self.places.ball.and_then(|place| record.get(place)).unwrap_or("0");
        if label.is_empty() {
            return Err(malformed(self.path, line, "the ball is missing".to_owned()));
        }
        let next = self.labels.len();
        let label = *self.labels.entry(label.to_owned()).or_insert(next);
        Ok(Row { line, time, label, position, velocity })
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

fn broken(path: &Path, error: &csv::Error) -> GradeError {
    let line = error.position().map_or(1, csv::Position::line);
    let problem = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} fields where the first line has {expected_len}")
        }
        csv::ErrorKind::Utf8 { .. } => "not text in UTF-8".to_owned(),
        _ => error.to_string(),
    };
    malformed(path, line, problem)
}

fn malformed(path: &Path, line: u64, problem: String) -> GradeError {
    GradeError::Malformed { path: path.to_owned(), line, problem }
}

fn refused(path: &Path, problem: &str) -> GradeError {
    GradeError::Refused { path: path.to_owned(), problem: problem.to_owned() }
}
