//! Drawn mazes that are part of the game: the embedded files of `mazes/`.

/// Name and text of each drawing.
pub const DRAWINGS: &[(&str, &str)] = &[("spiral", include_str!("../mazes/spiral.txt"))];
