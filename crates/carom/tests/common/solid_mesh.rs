//! Closed meshes of known form.

use std::f64::consts::TAU;

use carom::{DVec3, Mesh};

use super::vec;

/// A box as a mesh.
pub fn block(size: DVec3) -> Mesh {
    let (vertices, triangles) = parts_of_block(DVec3::ZERO, size);
    Mesh::new(vertices, triangles).unwrap()
}

/// The vertices and the triangles, facing outward, of a box about a place \[m\].
pub fn parts_of_block(center: DVec3, size: DVec3) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let corner = |number: u32| {
        let part = |bit: u32| if number & bit == 0 { -0.5 } else { 0.5 };
        center + size * vec(part(1), part(2), part(4))
    };
    let sides: [[u32; 4]; 6] =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    ((0..8).map(corner).collect(), triangles.collect())
}

/// One mesh of several parts, each of which may face inward instead.
pub fn of_parts(parts: &[(DVec3, DVec3, bool)]) -> Mesh {
    let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
    for &(center, size, faces_inward) in parts {
        let first = vertices.len() as u32;
        let (own, corners) = parts_of_block(center, size);
        vertices.extend(own);
        triangles.extend(corners.into_iter().map(|corners| {
            let [a, b, c] = corners.map(|it| it + first);
            if faces_inward { [a, c, b] } else { [a, b, c] }
        }));
    }
    Mesh::new(vertices, triangles).unwrap()
}

/// A ring about y with these radii \[m\], of `around` times `across` rectangles cut in two.
pub fn ring([ring_radius, tube_radius]: [f64; 2], [around, across]: [u32; 2]) -> Mesh {
    let place = |number: u32| {
        let turn = TAU * f64::from(number / across) / f64::from(around);
        let tilt = TAU * f64::from(number % across) / f64::from(across);
        let ((rise, across), (z, x)) = (libm::sincos(tilt), libm::sincos(turn));
        let reach = ring_radius + tube_radius * across;
        vec(reach * x, tube_radius * rise, reach * z)
    };
    let number = |i: u32, j: u32| (i % around) * across + j % across;
    let mut triangles = Vec::new();
    for i in 0..around {
        for j in 0..across {
            let [a, b] = [number(i, j), number(i + 1, j)];
            let [c, d] = [number(i + 1, j + 1), number(i, j + 1)];
            triangles.extend([[a, c, b], [a, d, c]]);
        }
    }
    Mesh::new((0..around * across).map(place).collect(), triangles).unwrap()
}
