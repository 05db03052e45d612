//! Surfaces that may be near a place: a tree of bounds.

use glam::DVec3;

use crate::bounds::Bounds;
use crate::mesh::Facet;
use crate::rectangle::Rectangle;
use crate::surface::{Form, SolidBox, Surface};

/// Bounds of a surface; `None` where it has none.
pub(crate) fn bounds(form: &Form) -> Option<Bounds> {
    let (center, half) = match *form {
        Form::Sphere { center, radius } => (center, DVec3::splat(radius)),
        Form::Rectangle(r) => (r.center, r.half_x * r.axis_x.abs() + r.half_z * r.axis_z.abs()),
        Form::HalfSpace { .. } => return None,
        Form::Box(solid) => of_box(solid),
        Form::Band(ref band) => within(band.center, |axis| band.extent(axis)),
        Form::Round(ref solid) => within(solid.center, |axis| solid.extent(axis)),
        Form::Closed(ref solid) => of_box(SolidBox::about(solid)),
        Form::Facet(ref facet) => around(facet),
        Form::Edge(ref edge) => (edge.center, edge.half * edge.axis.abs()),
        Form::Corner(ref corner) => (corner.point, DVec3::ZERO),
    };
    // Wider by far more than rounding, so that a surface at the very edge is never passed over.
    let slack = 1e-12 * (center.abs() + half).max_element();
    Some(Bounds::around(center, half + slack))
}

/// Centre and half lengths \[m\] of the bounds of a box.
fn of_box(SolidBox { center, axes: [x, y, z], half }: SolidBox) -> (DVec3, DVec3) {
    (center, half.x * x.abs() + half.y * y.abs() + half.z * z.abs())
}

/// Centre and half lengths of bounds, from the extents along the axes about a point.
fn within(point: DVec3, extent: impl Fn(DVec3) -> [f64; 2]) -> (DVec3, DVec3) {
    let extents = [DVec3::X, DVec3::Y, DVec3::Z].map(extent);
    let least = DVec3::from_array(extents.map(|it| it[0]));
    let most = DVec3::from_array(extents.map(|it| it[1]));
    (point + 0.5 * (least + most), 0.5 * (most - least))
}

/// Number of sides above which an outline is bounded by the rectangle about it.
const MANY_SIDES: usize = 8;

/// Centre and half the size \[m\] of the bounds of a flat face.
fn around(facet: &Facet) -> (DVec3, DVec3) {
    if facet.outline.sides().len() > MANY_SIDES {
        let Rectangle { center, axis_x, axis_z, half_x, half_z, .. } = facet.frame;
        return (center, half_x * axis_x.abs() + half_z * axis_z.abs());
    }
    let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (min, max) =
        facet.vertices().fold(first, |(min, max), vertex| (min.min(vertex), max.max(vertex)));
    (0.5 * (min + max), 0.5 * (max - min))
}

/// Finds the surfaces near a place: a bounding volume hierarchy, split at the median centre.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct SurfaceTree {
    /// Depth first: the children of an inner node follow it, and all that is below them.
    nodes: Vec<Node>,
    /// Bounded surfaces, grouped by leaf.
    leaves: Vec<(Bounds, u32)>,
    /// Surfaces without bounds, near every place.
    unbounded: Vec<u32>,
}

#[derive(Debug, Clone, PartialEq)]
struct Node {
    bounds: Bounds,
    /// The node after this one and all below it.
    next: u32,
    /// In a leaf, the places of its first surface and of the one after its last; unused in an inner
    /// node.
    surfaces: [u32; 2],
}

/// Up to this many surfaces are tested one by one; a tree would save nothing.
const LEAF_SIZE: usize = 4;

impl SurfaceTree {
    /// A tree of the surfaces with these numbers.
    pub fn of(surfaces: &[Surface], numbers: impl IntoIterator<Item = u32>) -> Self {
        let mut tree = Self::default();
        for number in numbers {
            match bounds(&surfaces[number as usize].form) {
                Some(bounds) => tree.leaves.push((bounds, number)),
                None => tree.unbounded.push(number),
            }
        }
        if !tree.leaves.is_empty() {
            tree.build(0, tree.leaves.len(), None);
        }
        tree
    }

    /// Returns a tree that finds all surfaces everywhere.
    #[cfg(test)]
    pub fn everywhere(numbers: impl IntoIterator<Item = u32>) -> Self {
        Self { unbounded: numbers.into_iter().collect(), ..Self::default() }
    }

    /// Whether there are no surfaces at all.
    pub fn is_empty(&self) -> bool {
        self.leaves.is_empty() && self.unbounded.is_empty()
    }

    /// Whether some surfaces have no bounds.
    pub fn has_unbounded(&self) -> bool {
        !self.unbounded.is_empty()
    }

    /// Appends the node over `leaves[first .. last]`, which are one side of a split along an axis, and those below it.
    fn build(&mut self, first: usize, last: usize, split: Option<usize>) {
        let part = &mut self.leaves[first..last];
        let bounds = part.iter().map(|leaf| leaf.0).reduce(Bounds::union);
        let Some(bounds) = bounds else { return };
        let count = part.len();
        let node = self.nodes.len();
        let along = |axis: usize| {
            let center = move |leaf: &(Bounds, u32)| leaf.0.min[axis] + leaf.0.max[axis];
            move |a: &(Bounds, u32), b: &(Bounds, u32)| {
                center(a).total_cmp(&center(b)).then(a.1.cmp(&b.1))
            }
        };
        if count <= LEAF_SIZE {
            if let Some(axis) = split {
                part.sort_unstable_by(along(axis));
            }
            let surfaces = [first, last].map(|place| place as u32);
            self.nodes.push(Node { bounds, next: node as u32 + 1, surfaces });
            return;
        }
        let axis = (bounds.max - bounds.min).max_position();
        part.select_nth_unstable_by(count / 2, along(axis));
        self.nodes.push(Node { bounds, next: 0, surfaces: [0; 2] });
        self.build(first, first + count / 2, Some(axis));
        self.build(first + count / 2, last, Some(axis));
        self.nodes[node].next = self.nodes.len() as u32;
    }

    /// Bounds of all surfaces that have some \[m\].
    pub fn bounds(&self) -> Option<Bounds> {
        self.nodes.first().map(|root| root.bounds)
    }

    /// Indices of the surfaces whose bounds overlap `query`, ascending, into `near`.
    pub fn near(&self, query: &Bounds, near: &mut Vec<u32>) {
        near.clear();
        self.add_near(query, near);
        near.sort_unstable();
    }

    /// Appends the indices of the surfaces whose bounds overlap `query`, in no useful order.
    pub fn add_near(&self, query: &Bounds, near: &mut Vec<u32>) {
        near.extend_from_slice(&self.unbounded);
        self.visit_near(query, |surface| near.push(surface));
    }

    /// Returns the number of surfaces whose bounds overlap `query`.
    pub fn count_near(&self, query: &Bounds) -> usize {
        let mut count = self.unbounded.len();
        self.visit_near(query, |_| count += 1);
        count
    }

    /// Visits the bounded surfaces whose bounds overlap `query`.
    fn visit_near(&self, query: &Bounds, mut visit: impl FnMut(u32)) {
        let mut place = 0;
        while let Some(node) = self.nodes.get(place) {
            if !node.bounds.overlap(query) {
                place = node.next as usize;
                continue;
            }
            let [first, last] = node.surfaces.map(|place| place as usize);
            let leaves = &self.leaves[first..last];
            leaves.iter().filter(|leaf| leaf.0.overlap(query)).for_each(|leaf| visit(leaf.1));
            place += 1;
        }
    }
}
