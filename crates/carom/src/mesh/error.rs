//! What cannot be a mesh.

use glam::DVec3;
use thiserror::Error;

/// Why a mesh cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A vertex has a coordinate that is not finite.
    #[error("vertex {vertex} of the mesh must be finite, not {position}")]
    VertexNotFinite {
        /// Its number, from 0.
        vertex: usize,
        /// Where it was said to be.
        position: DVec3,
    },
    /// A triangle names a vertex that is not there.
    #[error("triangle {triangle} of the mesh names vertex {vertex}, and there are {count}, from 0")]
    UnknownVertex {
        /// Its number, from 0.
        triangle: usize,
        /// The vertex that it names.
        vertex: u32,
        /// How many vertices there are.
        count: usize,
    },
    /// No triangle has an area.
    #[error("the mesh must have a triangle with an area, and has none")]
    NoArea,
    /// Heights are no grid.
    #[error(
        "heights must be at least two rows of at least two numbers each, not {rows} of {columns}"
    )]
    FewHeights {
        /// How many rows there are.
        rows: usize,
        /// How many numbers the first one has.
        columns: usize,
    },
    /// Rows of heights differ in length.
    #[error("row {row} of the heights must have {columns} numbers as the first has, not {found}")]
    UnequalRows {
        /// Its number, from 0.
        row: usize,
        /// How many numbers the first one has.
        columns: usize,
        /// How many it has.
        found: usize,
    },
    /// A height is not finite.
    #[error("number {column} in row {row} of the heights must be finite, not {height}")]
    HeightNotFinite {
        /// Of the row, from 0.
        row: usize,
        /// Of the number in it, from 0.
        column: usize,
        /// What it was.
        height: f64,
    },
    /// The size of a height field is not positive.
    #[error(
        "the size of a height field must be two numbers that are positive and finite, not {0:?}"
    )]
    Size([f64; 2]),
}

/// Checks vertices and triangles.
pub(super) fn check(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    // Beyond this, squares of lengths overflow.
    let is_usable = |it: &DVec3| it.abs().max_element() < 1e150;
    if let Some(vertex) = vertices.iter().position(|it| !is_usable(it)) {
        return Err(MeshError::VertexNotFinite { vertex, position: vertices[vertex] });
    }
    let count = vertices.len();
    let is_unknown = |vertex: &&u32| **vertex as usize >= count;
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(is_unknown) {
            return Err(MeshError::UnknownVertex { triangle, vertex, count });
        }
    }
    Ok(())
}
