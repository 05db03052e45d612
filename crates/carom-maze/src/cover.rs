//! Covers marked cells of a grid with few large rectangles.
//!
//! Walls are made from these rectangles, which may overlap. A wall with branches is one rectangle
//! with one face, without seams that a ball could hit.

/// Cells of a grid, each marked or not.
pub(crate) struct Cells {
    pub columns: usize,
    pub rows: usize,
    /// Row by row.
    pub marked: Vec<bool>,
}

impl Cells {
    fn has(&self, column: usize, row: usize) -> bool {
        self.marked[row * self.columns + column]
    }

    fn all(&self, block: &Block) -> bool {
        block.cells().all(|(column, row)| self.has(column, row))
    }
}

/// A block of cells, first to last inclusive.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Block {
    columns: [usize; 2],
    rows: [usize; 2],
}

impl Block {
    fn cells(&self) -> impl Iterator<Item = (usize, usize)> + use<> {
        let Self { columns, rows } = *self;
        (rows[0]..=rows[1]).flat_map(move |row| (columns[0]..=columns[1]).map(move |c| (c, row)))
    }

    /// Returns the end of the block at one side of an axis.
    fn end(&self, axis: usize, side: usize) -> Self {
        let mut end = *self;
        let range = if axis == 0 { &mut end.columns } else { &mut end.rows };
        *range = [range[side]; 2];
        end
    }

    fn length(&self, axis: usize) -> usize {
        let range = if axis == 0 { self.columns } else { self.rows };
        range[1] - range[0] + 1
    }
}

/// A rectangle of the cover in units of cells, from the first to the second edge along columns and
/// rows. An end inside another rectangle lies in the middle of a cell (at n + ½).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rectangle {
    pub columns: [f64; 2],
    pub rows: [f64; 2],
}

/// Returns rectangles that cover exactly the marked cells.
pub(crate) fn cover(cells: &Cells) -> Vec<Rectangle> {
    let mut covering = vec![0_u32; cells.marked.len()];
    let mut blocks = Vec::new();
    for row in 0..cells.rows {
        for column in 0..cells.columns {
            if !cells.has(column, row) || covering[row * cells.columns + column] > 0 {
                continue;
            }
            let block = largest(cells, column, row);
            block.cells().for_each(|(c, r)| covering[r * cells.columns + c] += 1);
            blocks.push(block);
        }
    }
    // Shortest first: where two walls meet, the shorter one is trimmed inside the longer one.
    blocks.sort_by_key(|block| block.length(0).max(block.length(1)));
    blocks.iter().map(|block| trimmed(block, cells.columns, &mut covering)).collect()
}

/// Returns the larger of two blocks around a cell: one grows along columns first, the other along
/// rows first.
fn largest(cells: &Cells, column: usize, row: usize) -> Block {
    let grown = |order: [usize; 2]| {
        let mut block = Block { columns: [column; 2], rows: [row; 2] };
        order.into_iter().for_each(|axis| grow(cells, &mut block, axis));
        block
    };
    let (wide, high) = (grown([0, 1]), grown([1, 0]));
    if high.cells().count() > wide.cells().count() { high } else { wide }
}

/// Extends a block along an axis in both directions as far as possible.
fn grow(cells: &Cells, block: &mut Block, axis: usize) {
    let most = if axis == 0 { cells.columns } else { cells.rows };
    let moved = |block: &Block, side: usize| {
        let mut end = block.end(axis, side);
        let range = if axis == 0 { &mut end.columns } else { &mut end.rows };
        let next = if side == 0 { range[0].checked_sub(1)? } else { range[0] + 1 };
        *range = [next; 2];
        (next < most && cells.all(&end)).then_some(next)
    };
    for side in [0, 1] {
        while let Some(next) = moved(block, side) {
            let range = if axis == 0 { &mut block.columns } else { &mut block.rows };
            range[side] = next;
        }
    }
}

/// Returns the rectangle of a block. End cells that other blocks cover are cut in half, because two
/// faces in one plane would remain otherwise.
fn trimmed(block: &Block, columns: usize, covering: &mut [u32]) -> Rectangle {
    let edges = |range: [usize; 2]| [range[0] as f64, (range[1] + 1) as f64];
    let mut sides = [edges(block.columns), edges(block.rows)];
    for axis in [0, 1] {
        // A wall is trimmed at its ends, not along its length.
        if block.length(axis) < 2 || block.length(axis) < block.length(1 - axis) {
            continue;
        }
        for side in [0, 1] {
            let end = block.end(axis, side);
            let index = |(column, row): (usize, usize)| row * columns + column;
            if end.cells().all(|cell| covering[index(cell)] > 1) {
                end.cells().for_each(|cell| covering[index(cell)] -= 1);
                sides[axis][side] += if side == 0 { 0.5 } else { -0.5 };
            }
        }
    }
    Rectangle { columns: sides[0], rows: sides[1] }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(drawing: &[&str]) -> Cells {
        let marked = drawing.iter().flat_map(|line| line.bytes().map(|byte| byte == b'#'));
        Cells { columns: drawing[0].len(), rows: drawing.len(), marked: marked.collect() }
    }

    /// Returns whether the centres of quarter cells are covered exactly where cells are marked.
    fn covers(rectangles: &[Rectangle], cells: &Cells) -> bool {
        let within = |range: [f64; 2], x: f64| range[0] < x && x < range[1];
        (0..4 * cells.columns * cells.rows).all(|i| {
            let (c, r) = (i % (2 * cells.columns), i / (2 * cells.columns));
            let (x, z) = (0.5 * c as f64 + 0.25, 0.5 * r as f64 + 0.25);
            let is_covered =
                rectangles.iter().any(|it| within(it.columns, x) && within(it.rows, z));
            is_covered == cells.has(c / 2, r / 2)
        })
    }

    #[test]
    fn a_straight_wall_is_one_rectangle_and_a_corner_two() {
        assert_eq!(cover(&cells(&["     ", " ### ", "     "])).len(), 1);
        assert_eq!(cover(&cells(&["#  ", "#  ", "###"])).len(), 2);
    }

    #[test]
    fn a_wall_that_branches_off_ends_within_the_one_it_leaves() {
        let cells = cells(&["#####", "  #  ", "  #  "]);
        let rectangles = cover(&cells);
        assert_eq!(rectangles.len(), 2);
        assert!(rectangles.contains(&Rectangle { columns: [0.0, 5.0], rows: [0.0, 1.0] }));
        assert!(rectangles.contains(&Rectangle { columns: [2.0, 3.0], rows: [0.5, 3.0] }));
    }

    #[test]
    fn all_marked_cells_are_covered_and_no_others() {
        for drawing in [
            ["#######", "#  #  #", "#  #  #", "## #  #", "#     #", "#######"],
            ["## ##  ", "##   # ", "#### # ", "  ####.", "# #  # ", "  #####"],
        ] {
            let cells = cells(&drawing);
            assert!(covers(&cover(&cells), &cells), "{drawing:?}");
        }
    }
}
