//! Mazes from text: drawn and random.

use carom_scene::SceneError;

use crate::drawing::{Drawing, Place};
use crate::error::MazeError;
use crate::floor::Floor;
use crate::layout;
use crate::maze::Maze;
use crate::random;
use crate::text_problem::TextProblem;

impl Maze {
    /// Makes a maze drawn with characters: `#` wall, space or `.` floor, `o` collectible, `S`
    /// start, `E` end wall; the last line is nearest to the viewer. Lines above the drawing may be
    /// `title: ...` and `walls: thin`. With thin walls, odd columns and rows (the first, third,
    /// ...), in which the walls are, are as narrow as the course's walls. `name` is the maze's name
    /// in errors.
    ///
    /// # Errors
    /// [`MazeError::Text`] with line and column: an unknown character, no start or two, no end, no
    /// way from the start to an end or a collectible that is wide enough for the ball, a drawing
    /// that is too large or empty.
    pub fn from_text(text: &str, name: &str) -> Result<Self, MazeError> {
        let drawing = Drawing::read(text, name)?;
        let at_start =
            |problem: TextProblem| problem.at(name, drawing.place_in_text(drawing.start));
        let maze =
            Self::from_scene(&layout::scene(&drawing, name)).map_err(|error| match error {
                MazeError::Scene(SceneError::Invalid(_)) if !name.trim().is_empty() => {
                    at_start(TextProblem::NarrowStart)
                }
                other => other,
            })?;
        let floor = Floor::new(&maze)?;
        let way = floor.cell_near(maze.start()).map(|cell| floor.costs_from(&[cell]));
        let way = way.ok_or_else(|| at_start(TextProblem::NarrowStart))?;
        let is_reached = |cell: &usize| way[*cell].is_finite();
        if !floor.cells_at_end_walls().iter().any(is_reached) {
            return Err(at_start(TextProblem::NoWay));
        }
        let collectibles = drawing.places(Place::Collectible).zip(maze.collectible_reaches());
        for (place, (center, radius)) in collectibles {
            if !floor.cells_touching(center, radius).iter().any(is_reached) {
                return Err(TextProblem::NoWayTo.at(name, drawing.place_in_text(place)));
            }
        }
        Ok(maze)
    }

    /// Makes a maze with exactly one way between any two positions, collectibles in dead ends, and
    /// the end wall far from the start. The same seed and size give the same maze; [`random_text`]
    /// draws it.
    ///
    /// [`random_text`]: crate::random_text
    ///
    /// # Errors
    /// [`MazeError::Size`] for fewer columns or rows than 2, or more than
    /// [`MOST_CELLS_PER_SIDE`](crate::MOST_CELLS_PER_SIDE).
    pub fn random(seed: u64, columns: usize, rows: usize) -> Result<Self, MazeError> {
        let text = random::random_text(seed, columns, rows)?;
        Self::from_text(&text, &format!("random-{seed}-{columns}x{rows}"))
    }
}
