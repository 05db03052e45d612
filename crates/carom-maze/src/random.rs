//! Random mazes, as drawings.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::error::MazeError;
use crate::text_problem::LONGEST_SIDE;

/// Largest number of columns or rows of cells.
pub const MOST_CELLS_PER_SIDE: usize = (LONGEST_SIDE - 1) / 2;
/// Smallest number of columns or rows; a smaller maze has no way to find.
const FEWEST_CELLS_PER_SIDE: usize = 2;
/// Largest number of collectibles: more would be tedious.
const MOST_COLLECTIBLES: usize = 8;
/// Offsets to the left, right, far and near: column, row.
const SIDES: [(isize, isize); 4] = [(-1, 0), (1, 0), (0, -1), (0, 1)];

/// Draws a random maze: one way between any two cells, the start in a corner, the end wall at the
/// border where it is farthest from the start, collectibles in dead ends. The same seed and size
/// give the same drawing on every platform; [`Maze::from_text`](crate::Maze::from_text) reads it.
///
/// # Errors
/// [`MazeError::Size`] for fewer columns or rows than 2, or more than [`MOST_CELLS_PER_SIDE`].
pub fn random_text(seed: u64, columns: usize, rows: usize) -> Result<String, MazeError> {
    let playable = FEWEST_CELLS_PER_SIDE..=MOST_CELLS_PER_SIDE;
    if !playable.contains(&columns) || !playable.contains(&rows) {
        return Err(MazeError::Size { columns, rows, most: MOST_CELLS_PER_SIDE });
    }
    let mut numbers = Numbers::new(seed);
    let mut carving = Carving::new(columns, rows);
    carving.carve(&mut numbers);
    let start = (0, 0);
    let distances = carving.distances(start);
    let (end, wall) = carving.farthest_border(&distances);
    let mut dead_ends = carving.dead_ends();
    dead_ends.retain(|&cell| cell != start && cell != end);
    numbers.shuffle(&mut dead_ends);
    dead_ends.truncate(MOST_COLLECTIBLES);

    carving.put(middle(start), 'S');
    carving.put(wall, 'E');
    dead_ends.into_iter().for_each(|cell| carving.put(middle(cell), 'o'));
    let lines: Vec<String> = carving.drawing.iter().map(|line| line.iter().collect()).collect();
    let title = format!("title: Random maze {seed} ({columns} x {rows})");
    Ok(format!("{title}\nwalls: thin\n{}\n", lines.join("\n")))
}

/// A column and a row of cells.
type Cell = (usize, usize);

/// Returns the column and row of a cell's middle in the drawing.
fn middle((column, row): Cell) -> (usize, usize) {
    (2 * column + 1, 2 * row + 1)
}

/// Returns the column and row of the wall at a side of a cell.
fn wall(cell: Cell, side: (isize, isize)) -> (usize, usize) {
    let (x, z) = middle(cell);
    (x.wrapping_add_signed(side.0), z.wrapping_add_signed(side.1))
}

/// A drawing in which corridors are carved.
struct Carving {
    columns: usize,
    rows: usize,
    drawing: Vec<Vec<char>>,
}

impl Carving {
    fn new(columns: usize, rows: usize) -> Self {
        Self { columns, rows, drawing: vec![vec!['#'; 2 * columns + 1]; 2 * rows + 1] }
    }

    fn put(&mut self, (x, z): (usize, usize), character: char) {
        self.drawing[z][x] = character;
    }

    fn is_open(&self, (x, z): (usize, usize)) -> bool {
        self.drawing[z][x] != '#'
    }

    fn neighbour(&self, (column, row): Cell, side: (isize, isize)) -> Option<Cell> {
        let column = column.checked_add_signed(side.0).filter(|&it| it < self.columns)?;
        let row = row.checked_add_signed(side.1).filter(|&it| it < self.rows)?;
        Some((column, row))
    }

    /// Carves by recursive backtracking: walks at random to new cells, and back where there are
    /// none.
    fn carve(&mut self, numbers: &mut Numbers) {
        let mut path = vec![(0, 0)];
        self.put(middle((0, 0)), ' ');
        while let Some(&cell) = path.last() {
            let is_new = |side: &(isize, isize)| {
                self.neighbour(cell, *side).is_some_and(|next| !self.is_open(middle(next)))
            };
            let sides: Vec<_> = SIDES.into_iter().filter(is_new).collect();
            if sides.is_empty() {
                path.pop();
                continue;
            }
            let side = sides[numbers.below(sides.len())];
            let Some(next) = self.neighbour(cell, side) else { continue };
            self.put(wall(cell, side), ' ');
            self.put(middle(next), ' ');
            path.push(next);
        }
    }

    /// Returns the neighbouring cells that are connected to a cell.
    fn exits(&self, cell: Cell) -> impl Iterator<Item = Cell> + '_ {
        let is_exit = move |side: &(isize, isize)| self.is_open(wall(cell, *side));
        SIDES.into_iter().filter(is_exit).filter_map(move |side| self.neighbour(cell, side))
    }

    fn cells(&self) -> impl Iterator<Item = Cell> + use<> {
        let columns = self.columns;
        (0..self.rows).flat_map(move |row| (0..columns).map(move |column| (column, row)))
    }

    /// Returns the cells with one exit.
    fn dead_ends(&self) -> Vec<Cell> {
        self.cells().filter(|&cell| self.exits(cell).count() == 1).collect()
    }

    /// Returns the number of steps from a cell to each cell, in rows.
    fn distances(&self, from: Cell) -> Vec<usize> {
        let index = |(column, row): Cell| row * self.columns + column;
        let mut distances = vec![usize::MAX; self.columns * self.rows];
        distances[index(from)] = 0;
        let mut found = vec![from];
        let mut next = 0;
        while let Some(&cell) = found.get(next) {
            next += 1;
            for exit in self.exits(cell) {
                if distances[index(exit)] == usize::MAX {
                    distances[index(exit)] = distances[index(cell)] + 1;
                    found.push(exit);
                }
            }
        }
        distances
    }

    /// Returns the border cell that is farthest, and the column and row of its border wall.
    fn farthest_border(&self, distances: &[usize]) -> (Cell, (usize, usize)) {
        let mut farthest = (0, (0, 0), wall((0, 0), SIDES[0]));
        for cell in self.cells() {
            let distance = distances[cell.1 * self.columns + cell.0];
            let border = SIDES.into_iter().find(|&side| self.neighbour(cell, side).is_none());
            if let Some(side) = border.filter(|_| distance > farthest.0) {
                farthest = (distance, cell, wall(cell, side));
            }
        }
        (farthest.1, farthest.2)
    }
}

/// Random numbers that are the same on every platform.
#[derive(Debug, Clone)]
pub(crate) struct Numbers(Pcg64);

impl Numbers {
    pub fn new(seed: u64) -> Self {
        Self(Pcg64::seed_from_u64(seed))
    }

    /// Returns an integer in 0..count.
    pub fn below(&mut self, count: usize) -> usize {
        // The high word of the product; probabilities differ by less than count / 2^64.
        ((u128::from(self.0.next_u64()) * count as u128) >> 64) as usize
    }

    /// Shuffles items; all orders are equally likely (Fisher and Yates).
    fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            items.swap(last, self.below(last + 1));
        }
    }
}
