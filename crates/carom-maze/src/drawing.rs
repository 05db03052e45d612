//! Mazes drawn with characters: the content of a text, without sizes in metres.
//!
//! ```text
//! title: A small one
//! walls: thin
//! #######
//! #S   o#
//! ##### #
//! #     E
//! #######
//! ```

use crate::cover::Cells;
use crate::error::MazeError;
use crate::text_problem::{LONGEST_SIDE, TextProblem};

/// What one character of a drawing stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    Floor,
    Wall,
    Collectible,
    Start,
    End,
}

impl Place {
    fn of(character: char) -> Option<Self> {
        Some(match character {
            ' ' | '.' => Self::Floor,
            '#' => Self::Wall,
            'o' => Self::Collectible,
            'S' => Self::Start,
            'E' => Self::End,
            _ => return None,
        })
    }
}

/// A drawn maze.
#[derive(Debug, Clone)]
pub(crate) struct Drawing {
    pub title: String,
    /// Whether odd columns and rows (the first, third, ...) are as narrow as a wall.
    pub thin_walls: bool,
    pub columns: usize,
    pub rows: usize,
    /// Row by row.
    places: Vec<Place>,
    /// Column and row of the start.
    pub start: (usize, usize),
    /// Line number of the first row in the text, from 1.
    first_line: usize,
}

/// The lines above a drawing.
#[derive(Default)]
struct Heading {
    title: String,
    thin_walls: bool,
}

impl Heading {
    /// Reads a line of the heading; returns `Ok(false)` if the line is none.
    fn read(&mut self, line: &str) -> Result<bool, TextProblem> {
        if let Some(title) = line.strip_prefix("title:") {
            self.title = title.trim().to_owned();
        } else if let Some(walls) = line.strip_prefix("walls:") {
            self.thin_walls = match walls.trim() {
                "thin" => true,
                "thick" => false,
                _ => return Err(TextProblem::UnknownWalls),
            };
        } else {
            return Ok(line.trim().is_empty());
        }
        Ok(true)
    }
}

impl Drawing {
    /// Reads a drawing, called `name` in errors.
    pub fn read(text: &str, name: &str) -> Result<Self, MazeError> {
        let mut heading = Heading::default();
        let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim_end()));
        let first = loop {
            let Some((number, line)) = lines.next() else {
                return Err(TextProblem::Empty.at(name, None));
            };
            if !heading.read(line).map_err(|problem| problem.at(name, (number, 1)))? {
                break (number, line);
            }
        };
        let mut drawn: Vec<(usize, &str)> = std::iter::once(first).chain(lines).collect();
        while drawn.pop_if(|(_, line)| line.is_empty()).is_some() {}
        let columns = drawn.iter().map(|(_, line)| line.chars().count()).max().unwrap_or(0);
        let mut drawing = Self {
            title: heading.title,
            thin_walls: heading.thin_walls,
            columns,
            rows: drawn.len(),
            places: Vec::new(),
            start: (0, 0),
            first_line: first.0,
        };
        drawing.refuse_large(name)?;
        drawing.places = vec![Place::Floor; columns * drawn.len()];
        drawing.read_places(&drawn, name)?;
        Ok(drawing)
    }

    fn refuse_large(&self, name: &str) -> Result<(), MazeError> {
        let line = self.first_line + self.rows.min(LONGEST_SIDE + 1) - 1;
        if self.rows > LONGEST_SIDE {
            return Err(TextProblem::TooLarge.at(name, (line, 1)));
        }
        if self.columns > LONGEST_SIDE {
            return Err(TextProblem::TooLarge.at(name, (self.first_line, LONGEST_SIDE + 1)));
        }
        Ok(())
    }

    fn read_places(&mut self, drawn: &[(usize, &str)], name: &str) -> Result<(), MazeError> {
        let mut start = None;
        for (row, (number, line)) in drawn.iter().enumerate() {
            for (column, character) in line.chars().enumerate() {
                let at = (*number, column + 1);
                let place = Place::of(character)
                    .ok_or_else(|| TextProblem::UnknownCharacter(character).at(name, at))?;
                if place == Place::Start {
                    if let Some((column, row)) = start {
                        let (line, column) = self.place_in_text((column, row));
                        return Err(TextProblem::SecondStart { line, column }.at(name, at));
                    }
                    start = Some((column, row));
                }
                self.places[row * self.columns + column] = place;
            }
        }
        self.start = start.ok_or_else(|| TextProblem::NoStart.at(name, None))?;
        if !self.places.contains(&Place::End) {
            return Err(TextProblem::NoEnd.at(name, None));
        }
        Ok(())
    }

    /// Returns the line and column in the text, from 1, of a column and row.
    pub fn place_in_text(&self, (column, row): (usize, usize)) -> (usize, usize) {
        (self.first_line + row, column + 1)
    }

    /// Returns columns and rows of all cells with this content.
    pub fn places(&self, what: Place) -> impl Iterator<Item = (usize, usize)> + '_ {
        let is_it = move |(_, place): &(usize, &Place)| **place == what;
        let columns = self.columns;
        self.places.iter().enumerate().filter(is_it).map(move |(i, _)| (i % columns, i / columns))
    }

    /// Returns the grid with the cells of this content marked.
    pub fn cells(&self, what: Place) -> Cells {
        let marked = self.places.iter().map(|&place| place == what).collect();
        Cells { columns: self.columns, rows: self.rows, marked }
    }
}
