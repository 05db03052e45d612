//! Errors of meshes.

use glam::DVec3;
use thiserror::Error;

/// Why a mesh cannot be made.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A coordinate of a vertex is not finite.
    #[error("vertex {vertex} of the mesh must be finite, not {position}")]
    VertexNotFinite {
        /// Index of the vertex.
        vertex: usize,
        /// Coordinates of the vertex.
        position: DVec3,
    },
    /// A triangle names a vertex that does not exist.
    #[error(
        "triangle {triangle} of the mesh names vertex {vertex}, but there are only {count}, counted from 0"
    )]
    UnknownVertex {
        /// Index of the triangle.
        triangle: usize,
        /// The missing vertex.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// Every triangle has zero area.
    #[error("the mesh must have at least one triangle with an area")]
    NoArea,
    /// Heights do not form a grid.
    #[error(
        "heights must be at least two rows of at least two numbers each, not {rows} of {columns}"
    )]
    FewHeights {
        /// Number of rows.
        rows: usize,
        /// Number of heights in the first row.
        columns: usize,
    },
    /// Rows of heights differ in length.
    #[error("row {row} of the heights must have {columns} numbers, as the first row, not {found}")]
    UnequalRows {
        /// Index of the row.
        row: usize,
        /// Number of heights in the first row.
        columns: usize,
        /// Number of heights in this row.
        found: usize,
    },
    /// A height is not finite.
    #[error("number {column} in row {row} of the heights must be finite, not {height}")]
    HeightNotFinite {
        /// Index of the row.
        row: usize,
        /// Index in the row.
        column: usize,
        /// The height.
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
