//! Meshes of size 1 for bodies, which nodes scale.

use carom::{Shape, Sides};
use carom_scene::outline::outlines;

use super::arrays::Arrays;
use crate::document::{Attributes, Primitive};

/// Shape of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Form {
    /// A sphere of radius 1.
    Sphere,
    /// A sphere of radius 1 in two tones: a band and two caps make its rotation visible.
    BandedSphere,
    /// A square of 1 by 1 in the xz plane that faces +y.
    Square,
    /// A cube with edges of 1.
    Cube,
    /// Walls of a hollow box with edges of 1, visible from within.
    Walls {
        /// Sides without a wall.
        open: Sides,
    },
    /// A shape of revolution in its own size, visible from both sides.
    Round {
        /// The shape.
        shape: Shape,
    },
}

/// Number of slices of a sphere around its axis, and of stacks along it.
const SLICES: usize = 32;
const STACKS: usize = 16;
/// Stacks of the band, and number of stacks of a cap; each covers about 0.2 of the radius.
const BAND: std::ops::Range<usize> = STACKS / 2 - 1..STACKS / 2 + 1;
const CAP: usize = 3;

/// Vertices and indices that the file already contains.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    /// Vertices of a sphere, which are also its normals.
    sphere: Option<usize>,
    /// Indices of a sphere in one tone, and in two.
    plain: Option<usize>,
    banded: Option<[usize; 2]>,
    square: Option<[usize; 3]>,
    cube: Option<[usize; 3]>,
}

impl Geometry {
    /// Returns the triangles of a form: those in the colour of the body, then those in the second
    /// tone of a banded sphere.
    pub fn triangles(&mut self, form: &Form, arrays: &mut Arrays) -> Vec<Primitive> {
        match *form {
            Form::Sphere => {
                let vertices = self.sphere(arrays);
                let all = || arrays.push_indices(&sphere_indices(|_| true));
                vec![primitive(vertices, vertices, *self.plain.get_or_insert_with(all))]
            }
            Form::BandedSphere => {
                let vertices = self.sphere(arrays);
                let both = || {
                    let plain = sphere_indices(|stack| !is_mark(stack));
                    [plain, sphere_indices(is_mark)].map(|it| arrays.push_indices(&it))
                };
                let indices = *self.banded.get_or_insert_with(both);
                indices.map(|indices| primitive(vertices, vertices, indices)).to_vec()
            }
            Form::Square => {
                let [vertices, normals, indices] =
                    *self.square.get_or_insert_with(|| square(arrays));
                vec![primitive(vertices, normals, indices)]
            }
            Form::Cube => {
                let [vertices, normals, indices] =
                    *self.cube.get_or_insert_with(|| cube(arrays, Sides::NONE, 1.0));
                vec![primitive(vertices, normals, indices)]
            }
            Form::Walls { open } if open == Sides::ALL => Vec::new(),
            Form::Walls { open } => {
                let [vertices, normals, indices] = cube(arrays, open, -1.0);
                vec![primitive(vertices, normals, indices)]
            }
            Form::Round { ref shape } => {
                let [vertices, normals, indices] = round(shape, arrays);
                vec![primitive(vertices, normals, indices)]
            }
        }
    }

    fn sphere(&mut self, arrays: &mut Arrays) -> usize {
        *self.sphere.get_or_insert_with(|| arrays.push_vertices(&sphere_vertices()))
    }
}

fn primitive(position: usize, normal: usize, indices: usize) -> Primitive {
    let attributes = Attributes { position: Some(position), normal: Some(normal) };
    Primitive { attributes, indices: Some(indices), material: None, mode: 4, targets: Vec::new() }
}

/// Vertices of a sphere of radius 1 with axis x.
fn sphere_vertices() -> Vec<[f32; 3]> {
    let mut vertices = Vec::new();
    for stack in 0..=STACKS {
        let (height, radius) = circle_point(stack, 2 * STACKS);
        for slice in 0..=SLICES {
            let (z, y) = circle_point(slice % SLICES, SLICES);
            vertices.push([height, radius * y, radius * z].map(|it| it as f32));
        }
    }
    vertices
}

/// Indices of the triangles in the chosen stacks of a sphere.
fn sphere_indices(is_chosen: impl Fn(usize) -> bool) -> Vec<u16> {
    let corner = |stack: usize, slice: usize| (stack * (SLICES + 1) + slice) as u16;
    let mut indices = Vec::new();
    for stack in (0..STACKS).filter(|&stack| is_chosen(stack)) {
        for slice in 0..SLICES {
            let [a, b] = [corner(stack, slice), corner(stack, slice + 1)];
            let [c, d] = [corner(stack + 1, slice), corner(stack + 1, slice + 1)];
            // At a pole, a quad is a triangle.
            if stack > 0 {
                indices.extend([a, b, d]);
            }
            if stack + 1 < STACKS {
                indices.extend([a, d, c]);
            }
        }
    }
    indices
}

/// Whether a stack belongs to the band or a cap.
fn is_mark(stack: usize) -> bool {
    BAND.contains(&stack) || !(CAP..STACKS - CAP).contains(&stack)
}

/// Cosine and sine of the fraction `part / of` of the full angle.
fn circle_point(part: usize, of: usize) -> (f64, f64) {
    let angle = 2.0 * std::f64::consts::PI * part as f64 / of as f64;
    // At quarters, where rounding errors would be visible, the values are exact.
    match 4 * part {
        quarters if quarters == of => (0.0, 1.0),
        quarters if quarters == 2 * of => (-1.0, 0.0),
        quarters if quarters == 3 * of => (0.0, -1.0),
        _ => (libm::cos(angle), libm::sin(angle)),
    }
}

fn square(arrays: &mut Arrays) -> [usize; 3] {
    let corners = [[-0.5, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 0.0, -0.5], [-0.5, 0.0, -0.5]];
    let vertices = arrays.push_vertices(&corners);
    let normals = arrays.push_vertices(&[[0.0, 1.0, 0.0]; 4]);
    [vertices, normals, arrays.push_indices(&[0, 1, 2, 0, 2, 3])]
}

/// Faces of a cube that are not open, visible from outside, or from within if `outward` is -1.
fn cube(arrays: &mut Arrays, open: Sides, outward: f32) -> [usize; 3] {
    let (mut vertices, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    let is_open = open.to_array();
    for side in (0..6).filter(|&side| !is_open[side]) {
        let (axis, sign) = (side / 2, if side % 2 == 0 { -1.0 } else { 1.0 });
        let [across, along] = [(axis + 1) % 3, (axis + 2) % 3];
        let first = vertices.len() as u16;
        for [u, v] in [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]] {
            let mut corner = [0.0; 3];
            (corner[axis], corner[across], corner[along]) = (0.5 * sign, u, v);
            vertices.push(corner);
            let mut normal = [0.0; 3];
            normal[axis] = sign * outward;
            normals.push(normal);
        }
        // The directions across, along and axis are right-handed.
        let front = if sign * outward > 0.0 { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
        indices.extend(front.map(|it| first + it));
    }
    [arrays.push_vertices(&vertices), arrays.push_vertices(&normals), arrays.push_indices(&indices)]
}

/// The surface of a shape of revolution, with normals that are smooth along an outline and around.
fn round(shape: &Shape, arrays: &mut Arrays) -> [usize; 3] {
    let (mut vertices, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for outline in outlines(shape) {
        let first = vertices.len() as u16;
        for (number, &[radius, height]) in outline.iter().enumerate() {
            let [before, after] = [number.saturating_sub(1), (number + 1).min(outline.len() - 1)];
            let way = [0, 1].map(|axis| outline[after][axis] - outline[before][axis]);
            let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
            let [out, up] = [-way[1] / length, way[0] / length];
            for slice in 0..=SLICES {
                let (cos, sin) = circle_point(slice % SLICES, SLICES);
                vertices.push([radius * cos, height, radius * sin].map(|it| it as f32));
                normals.push([out * cos, up, out * sin].map(|it| it as f32));
            }
        }
        let corner = |point: usize, slice: usize| first + (point * (SLICES + 1) + slice) as u16;
        for point in 1..outline.len() {
            for slice in 0..SLICES {
                let [a, b] = [corner(point - 1, slice), corner(point - 1, slice + 1)];
                let [c, d] = [corner(point, slice), corner(point, slice + 1)];
                // On the axis, a quad is a triangle.
                if outline[point - 1][0] > 0.0 {
                    indices.extend([a, b, d]);
                }
                if outline[point][0] > 0.0 {
                    indices.extend([a, d, c]);
                }
            }
        }
    }
    [arrays.push_vertices(&vertices), arrays.push_vertices(&normals), arrays.push_indices(&indices)]
}
