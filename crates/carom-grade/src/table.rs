//! Finds the rows and the columns of a table, whatever program wrote it.

use std::collections::BTreeMap;
use std::path::Path;
use std::str::FromStr;

use crate::encoding::{Content, content};
use crate::error::GradeError;
use crate::heading::{self, Heading};
use crate::number::number;
use crate::spreadsheet::{Sheet, sheets};
use crate::wide;

/// Most lines before the heading of a table.
const MOST_BEFORE: usize = 60;

/// Default names of columns, in lower case. If several exist, the first of this list counts.
const USUAL: [(&str, &[&str], &str); 8] = [
    ("t", &["t", "time", "seconds", "zeit"], "the time"),
    ("ball", &["ball", "id", "index", "sphere", "number"], "the ball"),
    ("x", &["x", "px", "pos_x", "position_x", "position.x", "x position"], "the position"),
    ("y", &["y", "py", "pos_y", "position_y", "position.y", "y position"], "the position"),
    ("z", &["z", "pz", "pos_z", "position_z", "position.z", "z position"], "the position"),
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

/// Indices of the columns of a table, and their units.
#[derive(Debug)]
pub(crate) struct Places {
    pub time: usize,
    pub ball: Option<usize>,
    /// Number or name of the ball, if the heading says it.
    pub name: Option<String>,
    /// Coordinates; a video shows two.
    pub position: [Option<usize>; 3],
    pub velocity: Option<[usize; 3]>,
    /// Units that the heading states \[m\], \[s\].
    pub length_unit: Option<f64>,
    pub time_unit: Option<f64>,
}

impl Places {
    /// Finds the columns in a heading.
    pub fn of(
        path: &Path,
        heading: &csv::StringRecord,
        columns: &Columns,
    ) -> Result<Self, GradeError> {
        let own: Vec<Heading> = heading.iter().map(Heading::of).collect();
        let find = |number: usize| -> Result<usize, GradeError> {
            let (key, usual, what) = USUAL[number];
            let named = columns.0.get(key);
            let place = match named {
                Some(named) => heading.iter().position(|name| name == named),
                // The first name of the list counts: beside `ball`, a column `index` may number
                // rows.
                None => usual.iter().find_map(|usual| own.iter().position(|it| it.name == *usual)),
            };
            place.ok_or_else(|| GradeError::MissingColumn {
                path: path.to_owned(),
                column: named.map_or(key, String::as_str).to_owned(),
                what,
                key,
                there: heading.iter().collect::<Vec<_>>().join(", "),
            })
        };
        let is_named = |key: &str| columns.0.contains_key(key);
        let optional = |number: usize| match find(number) {
            Err(_) if !is_named(USUAL[number].0) => Ok(None),
            found => found.map(Some),
        };
        let velocity = [find(5), find(6), find(7)];
        let is_wanted = ["vx", "vy", "vz"].into_iter().any(is_named);
        let velocity = match velocity {
            [Ok(x), Ok(y), Ok(z)] => Some([x, y, z]),
            [x, y, z] if is_wanted => Some([x?, y?, z?]),
            _ => None,
        };
        let time = find(0)?;
        let position = [Some(find(2)?), Some(find(3)?), optional(4)?];
        let unit = |place: usize| own[place].unit.as_deref();
        Ok(Self {
            time,
            ball: optional(1)?,
            name: None,
            position,
            velocity,
            length_unit: position[0].and_then(unit).and_then(heading::length),
            time_unit: unit(time).and_then(heading::time),
        })
    }

    /// Finds the columns of each ball in a heading that has several side by side; none if it names
    /// none.
    fn of_balls(
        path: &Path,
        heading: &csv::StringRecord,
        columns: &Columns,
    ) -> Result<Vec<Self>, GradeError> {
        let is_usual = |number: usize, text: &str| {
            let (key, usual, _) = USUAL[number];
            match columns.0.get(key) {
                Some(named) => text == named,
                None => usual.contains(&Heading::of(text).name.as_str()),
            }
        };
        let has = |number: usize| heading.iter().any(|text| is_usual(number, text));
        // A column of balls, or names of one's own, say that each row has one ball.
        let is_of_one = has(1) || columns.0.keys().any(|key| *key != "t");
        if is_of_one || !has(0) {
            return Ok(Vec::new());
        }
        let coordinates: Vec<_> = USUAL[2..].iter().map(|(key, usual, _)| (*key, *usual)).collect();
        let refused = |problem| GradeError::Refused { path: path.to_owned(), problem };
        let balls = wide::balls(heading, &coordinates).map_err(refused)?;
        let places = |ball: wide::Ball| {
            // The heading that a table of this ball alone would have.
            let own = heading.iter().enumerate().map(|(place, text)| {
                let key = ball.keys.iter().find(|it| it.0 == place).map(|it| it.1);
                match (key, Heading::of(text).unit) {
                    (Some(key), Some(unit)) => format!("{key} ({unit})"),
                    (Some(key), None) => key.to_owned(),
                    (None, _) if is_usual(0, text) => text.to_owned(),
                    (None, _) => String::new(),
                }
            });
            let places = Self::of(path, &own.collect(), columns)?;
            Ok(Self { name: Some(ball.name), ..places })
        };
        balls.into_iter().map(places).collect()
    }

    /// Takes the units of a row that has nothing else; returns whether it is one.
    pub fn take_units(&mut self, record: &csv::StringRecord) -> bool {
        let unit = |place: usize| record.get(place).unwrap_or_default();
        let length = self.position[0].map(unit).and_then(heading::length);
        let time = heading::time(unit(self.time));
        if length.is_none() && time.is_none() || record.iter().any(|it| number(it).is_some()) {
            return false;
        }
        (self.length_unit, self.time_unit) = (self.length_unit.or(length), self.time_unit.or(time));
        true
    }
}

/// Records of a table, from the first after the heading on.
pub(crate) struct Table {
    /// Columns of each ball that has its own; those of all balls if a row has one ball.
    pub places: Vec<Places>,
    /// Number of fields of the heading.
    pub width: usize,
    pub records: Records,
}

/// Records in the order of the file.
pub(crate) type Records = Box<dyn Iterator<Item = Result<csv::StringRecord, csv::Error>>>;

impl Table {
    /// Finds the table in the content of a file.
    ///
    /// # Errors
    /// [`GradeError`] if the file is none, or if the table lacks a column.
    pub fn find(path: &Path, bytes: &[u8], columns: &Columns) -> Result<Self, GradeError> {
        let refused = |problem: String| GradeError::Refused { path: path.to_owned(), problem };
        let is_named_so = path.extension().is_some_and(|it| it.eq_ignore_ascii_case("xlsx"));
        match content(bytes) {
            Content::Other(what) => Err(refused(what.to_owned())),
            Content::Text(_) if bytes.is_empty() => Err(refused("is empty".to_owned())),
            Content::Text(_) if is_named_so => {
                Err(refused("is no spreadsheet, or a damaged one".to_owned()))
            }
            Content::Text(text) => Self::of(path, records(&text), columns),
            Content::Spreadsheet => {
                let sheets = sheets(bytes).map_err(refused)?.into_iter();
                let mut tables = sheets.map(|it| Self::of(path, in_lines(it), columns));
                let first = tables.next().ok_or_else(|| refused("has no sheets".to_owned()))?;
                // The first sheet with a table counts; without one, the first sheet says why.
                first.or_else(|error| tables.find_map(Result::ok).ok_or(error))
            }
        }
    }

    fn of(path: &Path, mut records: Records, columns: &Columns) -> Result<Self, GradeError> {
        let mut start = Vec::new();
        for record in records.by_ref().take(MOST_BEFORE) {
            start.push(record.map_err(|error| broken(path, &error))?);
        }
        let (line, mut places) = found(path, &start, columns)?;
        let width = start.get(line).map_or(0, csv::StringRecord::len);
        let mut left = start.split_off((line + 1).min(start.len()));
        if let Some(units) = left.first() {
            let are_units: Vec<bool> = places.iter_mut().map(|it| it.take_units(units)).collect();
            if are_units.contains(&true) {
                left.remove(0);
            }
        }
        let records = Box::new(left.into_iter().map(Ok).chain(records));
        Ok(Self { places, width, records })
    }
}

/// Finds the heading in the first records of a file: its index, and the columns.
fn found(
    path: &Path,
    start: &[csv::StringRecord],
    columns: &Columns,
) -> Result<(usize, Vec<Places>), GradeError> {
    let of_one = |(line, record)| Some((line, vec![Places::of(path, record, columns).ok()?]));
    if let Some(found) = start.iter().enumerate().find_map(of_one) {
        return Ok(found);
    }
    for (line, record) in start.iter().enumerate() {
        let balls = Places::of_balls(path, record, columns)?;
        if !balls.is_empty() {
            return Ok((line, balls));
        }
    }
    let line = presumed(start);
    let none = csv::StringRecord::new();
    Ok((line, vec![Places::of(path, start.get(line).unwrap_or(&none), columns)?]))
}

/// The line that would be the heading: the one before the first with three numbers.
fn presumed(start: &[csv::StringRecord]) -> usize {
    let is_row = |it: &csv::StringRecord| it.iter().filter(|it| number(it).is_some()).count() > 2;
    start.iter().position(is_row).map_or(0, |line| line.saturating_sub(1))
}

/// Splits a text into records.
fn records(text: &str) -> Records {
    let mut table = csv::ReaderBuilder::new();
    table.delimiter(delimiter(text)).trim(csv::Trim::All).flexible(true).has_headers(false);
    let bytes = std::io::Cursor::new(text.as_bytes().to_vec());
    Box::new(table.from_reader(bytes).into_records())
}

/// The separator that most of the first lines have twice, or once if none has. A comma counts least, because it may
/// separate decimals.
fn delimiter(text: &str) -> u8 {
    let lines: Vec<&str> = text.lines().take(MOST_BEFORE).collect();
    let count = |letter: u8, least: usize| {
        let has = |it: &&&str| it.bytes().filter(|byte| *byte == letter).count() >= least;
        lines.iter().filter(has).count()
    };
    let all = [b',', b';', b'\t'];
    all.into_iter().max_by_key(|&letter| (count(letter, 2), count(letter, 1))).unwrap_or(b',')
}

/// Converts the rows of a sheet to records with their lines.
fn in_lines(sheet: Sheet) -> Records {
    Box::new(sheet.into_iter().map(|(line, mut record)| {
        let mut position = csv::Position::new();
        position.set_line(line);
        record.set_position(Some(position));
        record.trim();
        Ok(record)
    }))
}

/// Converts an error of the reader of CSV.
pub(crate) fn broken(path: &Path, error: &csv::Error) -> GradeError {
    let line = error.position().map_or(1, csv::Position::line);
    GradeError::Malformed { path: path.to_owned(), line, problem: error.to_string() }
}
