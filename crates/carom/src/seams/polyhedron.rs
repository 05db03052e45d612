//! Boxes, rectangles and containers as meshes.

use glam::DVec3;

use crate::collider::{Shape, Sides};
use crate::mesh::{Mesh, Placement};
use crate::pose::Pose;
use crate::surface::{Form, place_mesh};

/// Corners of the sides -x, +x, -y, +y, -z, +z of a box, against the clock as seen from outside. The lowest three bits
/// of a corner are its sides along x, y and z.
const SIDES: [[u32; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Makes meshes of shapes; equal shapes in a row share theirs.
#[derive(Debug, Default)]
pub(super) struct Polyhedra {
    last: Option<(Shape, Vec<Mesh>)>,
}

impl Polyhedra {
    /// Faces, edges and corners of a shape in a pose; `None` for a half-space. Those of a mesh are the forms given.
    pub fn forms<'a>(
        &mut self,
        shape: &Shape,
        pose: Pose,
        deflecting: impl Iterator<Item = &'a Form>,
    ) -> Option<Vec<Form>> {
        match shape {
            Shape::HalfSpace => None,
            Shape::Mesh(_) => Some(deflecting.cloned().collect()),
            shape => {
                if self.last.as_ref().is_none_or(|(last, _)| last != shape) {
                    self.last = Some((shape.clone(), meshes(shape)?));
                }
                let (_, meshes) = self.last.as_ref()?;
                let placement = Placement {
                    rotation: pose.rotation.normalize(),
                    from: DVec3::ZERO,
                    to: pose.position,
                };
                let mut forms = Vec::new();
                for mesh in meshes {
                    place_mesh(mesh.features(), &placement, |form| forms.push(form));
                }
                Some(forms)
            }
        }
    }
}

/// Meshes equal to a shape with flat faces; `None` for other shapes, and for one too thin to have an area as a mesh.
fn meshes(shape: &Shape) -> Option<Vec<Mesh>> {
    match *shape {
        Shape::Rectangle { size_x, size_z } => {
            let corner = |x: f64, z: f64| DVec3::new(0.5 * x * size_x, 0.0, 0.5 * z * size_z);
            let corners =
                vec![corner(-1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0), corner(1.0, -1.0)];
            let mesh = Mesh::new(corners, vec![[0, 1, 2], [0, 2, 3]]).ok()?;
            Some(vec![mesh.one_sided()])
        }
        Shape::Box { size } => Some(vec![walls(size, Sides::NONE, false)?]),
        Shape::Container { size, open } => {
            let outward = walls(size, open, false)?;
            Some(vec![outward, walls(size, open, true)?])
        }
        _ => None,
    }
}

/// Sides of a box except the open ones, met from outside, or from inside if they are `turned`.
fn walls(size: DVec3, open: Sides, turned: bool) -> Option<Mesh> {
    let side = |bit: u32| if bit & 1 == 1 { 0.5 } else { -0.5 };
    let corner = |it: u32| size * DVec3::new(side(it), side(it >> 1), side(it >> 2));
    let corners = (0..8).map(corner).collect();
    let closed = SIDES.into_iter().zip(open.to_array()).filter(|(_, is_open)| !is_open);
    let triangles =
        closed.flat_map(
            |([a, b, c, d], _)| {
                if turned { [[a, c, b], [a, d, c]] } else { [[a, b, c], [a, c, d]] }
            },
        );
    Some(Mesh::new(corners, triangles.collect()).ok()?.one_sided())
}
