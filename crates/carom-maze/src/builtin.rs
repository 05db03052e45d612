//! The drawn mazes that are part of the game: the files of `mazes/`, embedded.

/// Name and text of each.
pub const DRAWINGS: &[(&str, &str)] = &[("spiral", include_str!("../mazes/spiral.txt"))];
