//! Analysis of recorded states over neighbours, which would be slow in Python.
//!
//! ```
//! let points = [[0.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
//! // Across a face of the box, their distance is 1 m.
//! assert_eq!(carom_analysis::pair_histogram(&points, [10.0; 3], 2.0, 2), [0, 1]);
//! ```

#![warn(clippy::unwrap_used)]

mod bond_order;
mod cells;
mod clusters;
mod common_neighbours;
mod neighbours;
mod pairs;

pub use bond_order::{BondOrder, bond_order};
pub use clusters::cluster_labels;
pub use common_neighbours::{Structure, adaptive_structures, structures_within};
pub use neighbours::{Bond, Neighbours};
pub use pairs::{Pair, pair_histogram, pairs_within};

/// The program of the README, compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
