//! Colliders as the world sees them: placed surfaces, and a tree to find the near ones.

use glam::DVec3;

use crate::collider::{Collider, ColliderId, Shape};

/// One surface of a collider in world coordinates, with what a contact needs to know of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Surface {
    pub form: Form,
    pub collider: ColliderId,
    pub restitution: f64,
    pub role: Role,
}

/// What a surface is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// Spheres bounce off it.
    Deflects,
    /// It reports contact and deflects nothing.
    Reports,
    /// It only tells whether a sphere is inside: the volume of a box, whose faces deflect.
    Encloses,
}

/// Geometry of a surface, in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Form {
    Sphere { center: DVec3, radius: f64 },
    Rectangle(Rectangle),
    HalfSpace { point: DVec3, normal: DVec3 },
    Box(SolidBox),
}

/// A solid box in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SolidBox {
    pub center: DVec3,
    /// Directions of its edges, orthonormal.
    pub axes: [DVec3; 3],
    /// Half the lengths along the axes \[m\].
    pub half: DVec3,
}

/// A one-sided rectangle in the world. The three axes are orthonormal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rectangle {
    pub center: DVec3,
    /// Direction of the first pair of edges.
    pub axis_x: DVec3,
    /// Direction of the second pair of edges.
    pub axis_z: DVec3,
    /// Direction the front faces.
    pub normal: DVec3,
    /// Half the length along `axis_x` \[m\].
    pub half_x: f64,
    /// Half the length along `axis_z` \[m\].
    pub half_z: f64,
}

/// Appends the surfaces of a collider. Those of a solid box are its volume and then its faces, in
/// the order -x, +x, -y, +y, -z, +z.
pub(crate) fn place(id: ColliderId, collider: &Collider, surfaces: &mut Vec<Surface>) {
    let Collider { shape, pose, restitution, trigger } = *collider;
    let center = pose.position;
    let rotation = pose.rotation.normalize();
    let axes @ [x, y, z] = [rotation * DVec3::X, rotation * DVec3::Y, rotation * DVec3::Z];
    let mut add = |form, role| {
        let role = if trigger { Role::Reports } else { role };
        surfaces.push(Surface { form, collider: id, restitution, role });
    };
    match shape {
        Shape::Sphere { radius } => add(Form::Sphere { center, radius }, Role::Deflects),
        Shape::HalfSpace => add(Form::HalfSpace { point: center, normal: y }, Role::Deflects),
        Shape::Rectangle { size_x, size_z } => {
            let (half_x, half_z) = (0.5 * size_x, 0.5 * size_z);
            let rectangle = Rectangle { center, axis_x: x, axis_z: z, normal: y, half_x, half_z };
            add(Form::Rectangle(rectangle), Role::Deflects);
        }
        Shape::Box { size } => {
            let solid = SolidBox { center, axes, half: 0.5 * size };
            add(Form::Box(solid), Role::Encloses);
            if !trigger {
                for face in solid.faces() {
                    add(Form::Rectangle(face), Role::Deflects);
                }
            }
        }
    }
}

impl SolidBox {
    /// The six faces, outward.
    fn faces(&self) -> [Rectangle; 6] {
        std::array::from_fn(|number| {
            let axis = number / 2;
            let (first, second) = [(1, 2), (0, 2), (0, 1)][axis];
            let normal = if number % 2 == 0 { -self.axes[axis] } else { self.axes[axis] };
            Rectangle {
                center: self.center + self.half[axis] * normal,
                axis_x: self.axes[first],
                axis_z: self.axes[second],
                normal,
                half_x: self.half[first],
                half_z: self.half[second],
            }
        })
    }
}

/// Axis-aligned bounds \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bounds {
    pub min: DVec3,
    pub max: DVec3,
}

impl Bounds {
    pub fn around(center: DVec3, half: DVec3) -> Self {
        Self { min: center - half, max: center + half }
    }

    pub fn overlap(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// Bounds of a surface; `None` where it has none.
fn bounds(form: &Form) -> Option<Bounds> {
    let (center, half) = match *form {
        Form::Sphere { center, radius } => (center, DVec3::splat(radius)),
        Form::Rectangle(r) => (r.center, r.half_x * r.axis_x.abs() + r.half_z * r.axis_z.abs()),
        Form::HalfSpace { .. } => return None,
        Form::Box(SolidBox { center, axes: [x, y, z], half }) => {
            (center, half.x * x.abs() + half.y * y.abs() + half.z * z.abs())
        }
    };
    // Wider by far more than rounding, so that a surface at the very edge is never passed over.
    let slack = 1e-12 * (center.abs() + half).max_element();
    Some(Bounds::around(center, half + slack))
}

/// Finds the surfaces near a place: a bounding volume hierarchy, split at the median centre.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SurfaceTree {
    /// Depth first: the left child of an inner node follows it.
    nodes: Vec<Node>,
    /// Bounded surfaces, grouped by leaf.
    leaves: Vec<(Bounds, u32)>,
    /// Surfaces without bounds, near every place.
    unbounded: Vec<u32>,
}

#[derive(Debug, Clone, PartialEq)]
struct Node {
    bounds: Bounds,
    kind: NodeKind,
}

#[derive(Debug, Clone, PartialEq)]
enum NodeKind {
    Leaf { first: u32, count: u32 },
    Inner { right: u32 },
}

/// Up to this many surfaces are looked at one by one; below it a tree saves nothing.
const LEAF_SIZE: usize = 4;

impl SurfaceTree {
    pub fn new(surfaces: &[Surface]) -> Self {
        let mut tree = Self::default();
        for (index, surface) in surfaces.iter().enumerate() {
            match bounds(&surface.form) {
                Some(bounds) => tree.leaves.push((bounds, index as u32)),
                None => tree.unbounded.push(index as u32),
            }
        }
        if !tree.leaves.is_empty() {
            tree.build(0, tree.leaves.len());
        }
        tree
    }

    /// Appends the node over `leaves[first .. last]`, and those below it.
    fn build(&mut self, first: usize, last: usize) {
        let part = &mut self.leaves[first..last];
        let bounds = part.iter().map(|leaf| leaf.0).reduce(Bounds::union);
        let Some(bounds) = bounds else { return };
        let count = part.len();
        if count <= LEAF_SIZE {
            let kind = NodeKind::Leaf { first: first as u32, count: count as u32 };
            self.nodes.push(Node { bounds, kind });
            return;
        }
        let axis = (bounds.max - bounds.min).max_position();
        let center = |leaf: &(Bounds, u32)| leaf.0.min[axis] + leaf.0.max[axis];
        part.sort_by(|a, b| center(a).total_cmp(&center(b)).then(a.1.cmp(&b.1)));
        let node = self.nodes.len();
        self.nodes.push(Node { bounds, kind: NodeKind::Inner { right: 0 } });
        self.build(first, first + count / 2);
        self.nodes[node].kind = NodeKind::Inner { right: self.nodes.len() as u32 };
        self.build(first + count / 2, last);
    }

    /// Indices of the surfaces whose bounds overlap `query`, ascending, into `near`.
    pub fn near(&self, query: &Bounds, near: &mut Vec<u32>) {
        near.clear();
        near.extend_from_slice(&self.unbounded);
        if !self.nodes.is_empty() {
            self.collect(0, query, near);
        }
        near.sort_unstable();
    }

    fn collect(&self, node: usize, query: &Bounds, near: &mut Vec<u32>) {
        if !self.nodes[node].bounds.overlap(query) {
            return;
        }
        match self.nodes[node].kind {
            NodeKind::Leaf { first, count } => {
                let leaves = &self.leaves[first as usize..(first + count) as usize];
                near.extend(leaves.iter().filter(|leaf| leaf.0.overlap(query)).map(|leaf| leaf.1));
            }
            NodeKind::Inner { right } => {
                self.collect(node + 1, query, near);
                self.collect(right as usize, query, near);
            }
        }
    }
}
