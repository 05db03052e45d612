//! Which surfaces may be near a place: a tree of bounds.

use glam::DVec3;

use crate::surface::{Form, SolidBox, Surface};

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
