//! A tree over the bounds of items, which is searched nearest first.

use crate::bounds::Bounds;

/// An item with bounds.
pub(crate) trait Bounded {
    /// Key that decides between items at one place.
    type Order: Ord;

    /// Axis-aligned bounds \[m\].
    fn bounds(&self) -> &Bounds;

    /// The key, different for any two items of a tree.
    fn order(&self) -> Self::Order;
}

/// Up to this many items are tested one by one; a tree would save nothing.
const LEAF_SIZE: usize = 4;

/// A split is good if the areas of both halves are at most this many times that of the whole: 4/3 for a cube of points.
const GOOD_SPLIT: f64 = 1.5;

/// Items in a bounding volume hierarchy, split at median centres.
#[derive(Debug, Clone)]
pub(crate) struct BoundsTree<L> {
    /// Depth first: the first child of an inner node follows it.
    nodes: Vec<Node>,
    /// Items with bounds, grouped by leaf.
    leaves: Vec<L>,
    /// Items without bounds, near every place.
    unbounded: Vec<L>,
}

#[derive(Debug, Clone, Copy)]
struct Node {
    bounds: Bounds,
    below: Below,
}

#[derive(Debug, Clone, Copy)]
enum Below {
    /// `leaves[first .. last]`.
    Leaves { first: u32, last: u32 },
    /// The node after this one, and the one at `second`.
    Nodes { second: u32 },
}

impl<L: Bounded> BoundsTree<L> {
    /// A tree of items. One that is not `sorted` costs little to make, and each search tests all of its items.
    pub fn of(leaves: Vec<L>, unbounded: Vec<L>, sorted: bool) -> Self {
        let mut tree = Self { nodes: Vec::new(), leaves, unbounded };
        let (count, size) = (tree.leaves.len(), if sorted { LEAF_SIZE } else { usize::MAX });
        if count > 0 {
            tree.build(0, count, size);
        }
        tree
    }

    /// Bounds of all items that have some; `None` without any.
    pub fn bounds(&self) -> Option<&Bounds> {
        self.nodes.first().map(|root| &root.bounds)
    }

    /// Appends the node over `leaves[first .. last]`, and those below it.
    fn build(&mut self, first: usize, last: usize, leaf_size: usize) {
        let part = &mut self.leaves[first..last];
        let Some(bounds) = part.iter().map(|leaf| *leaf.bounds()).reduce(Bounds::union) else {
            return;
        };
        let node = self.nodes.len();
        if part.len() <= leaf_size {
            let below = Below::Leaves { first: first as u32, last: last as u32 };
            self.nodes.push(Node { bounds, below });
            return;
        }
        split(part, &bounds);
        let middle = part.len() / 2;
        self.nodes.push(Node { bounds, below: Below::Nodes { second: 0 } });
        self.build(first, first + middle, leaf_size);
        let second = self.nodes.len() as u32;
        self.build(first + middle, last, leaf_size);
        self.nodes[node].below = Below::Nodes { second };
    }

    /// Visits items whose `lower_bound` is not above the `limit`, roughly in its order. A visit may lower the
    /// limit.
    pub fn search(
        &self,
        lower_bound: &impl Fn(&Bounds) -> f64,
        limit: &mut f64,
        visit: &mut impl FnMut(&L, &mut f64),
    ) {
        self.unbounded.iter().for_each(|leaf| visit(leaf, limit));
        if let Some(root) = self.nodes.first()
            && lower_bound(&root.bounds) <= *limit
        {
            self.descend(0, lower_bound, limit, visit);
        }
    }

    fn descend(
        &self,
        node: usize,
        lower_bound: &impl Fn(&Bounds) -> f64,
        limit: &mut f64,
        visit: &mut impl FnMut(&L, &mut f64),
    ) {
        let second = match self.nodes[node].below {
            Below::Nodes { second } => second as usize,
            Below::Leaves { first, last } => {
                for leaf in &self.leaves[first as usize..last as usize] {
                    if lower_bound(leaf.bounds()) <= *limit {
                        visit(leaf, limit);
                    }
                }
                return;
            }
        };
        let children =
            [node + 1, second].map(|child| (lower_bound(&self.nodes[child].bounds), child));
        let is_second_nearer = children[1].0 < children[0].0;
        let ordered = if is_second_nearer { [children[1], children[0]] } else { children };
        for (bound, child) in ordered {
            if bound <= *limit {
                self.descend(child, lower_bound, limit, visit);
            }
        }
    }
}

/// Splits items with these bounds at the median centre: along the longest axis, or along the one that leaves the smallest
/// bounds where the longest leaves large ones, as beside long items.
fn split<L: Bounded>(part: &mut [L], bounds: &Bounds) {
    let size = bounds.max - bounds.min;
    let longest = size.max_position();
    let enough = GOOD_SPLIT * bounds.half_area();
    if split_along(part, longest) <= enough {
        return;
    }
    let areas = [0, 1, 2].map(|axis| split_along(part, axis));
    let best = (0..3).min_by(|&a, &b| areas[a].total_cmp(&areas[b])).unwrap_or(longest);
    if best != 2 {
        split_along(part, best);
    }
}

/// Splits items at the median centre along an axis. Returns the sum of the half areas of both halves \[m²\].
fn split_along<L: Bounded>(part: &mut [L], axis: usize) -> f64 {
    let center = |leaf: &L| leaf.bounds().min[axis] + leaf.bounds().max[axis];
    let middle = part.len() / 2;
    part.select_nth_unstable_by(middle, |a, b| {
        center(a).total_cmp(&center(b)).then(a.order().cmp(&b.order()))
    });
    let halves = [&part[..middle], &part[middle..]];
    let area = |half: &[L]| half.iter().map(|leaf| *leaf.bounds()).reduce(Bounds::union);
    halves.into_iter().filter_map(area).map(|it| it.half_area()).sum()
}
