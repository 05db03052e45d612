//! An octree over points with masses, built in the order of Morton's curve: the same for any number of
//! threads.

use std::ops::Range;

use glam::DVec3;

use crate::norm::Norm;

/// Cubes with this many points or fewer are not divided.
const LEAF: usize = 8;
/// Levels below the root: as many bits of each coordinate as fit three times into a key.
const LEVELS: u32 = 21;

/// Points in a tree of cubes, each an eighth of the one above.
pub(super) struct Octree {
    /// Depth first.
    nodes: Vec<Node>,
    /// Points in the order of Morton's curve: index, place \[m\] and mass \[kg\].
    points: Vec<(u32, DVec3, f64)>,
}

struct Node {
    /// Edge of the cube \[m\], and how far the centre of mass is from its middle \[m\].
    edge: f64,
    eccentricity: f64,
    center_of_mass: DVec3,
    mass: f64,
    /// Points in the cube.
    points: Range<u32>,
    /// Number of the first node that is not below it. Its first cube, if it is divided, comes next.
    end: u32,
    is_leaf: bool,
}

/// A cube with its points, by their keys.
struct Cube {
    level: u32,
    /// Lower corner and edge \[m\].
    corner: DVec3,
    edge: f64,
    points: Range<usize>,
}

impl Octree {
    /// A tree over these places \[m\] and masses \[kg\], all finite; at least one.
    pub fn new(positions: &[DVec3], masses: &[f64]) -> Self {
        let low = positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
        let high = positions.iter().copied().reduce(DVec3::max).unwrap_or_default();
        let edge = (high - low).max_element();
        let mut order: Vec<(u64, u32)> =
            (0u32..).zip(positions).map(|(i, &it)| (key((it - low) / edge), i)).collect();
        order.sort_unstable();
        let keys: Vec<u64> = order.iter().map(|point| point.0).collect();
        let point = |&(_, i): &(u64, u32)| (i, positions[i as usize], masses[i as usize]);
        let mut tree = Self { nodes: Vec::new(), points: order.iter().map(point).collect() };
        tree.build(&keys, Cube { level: 0, corner: low, edge, points: 0..keys.len() });
        tree
    }

    /// Appends a cube with all below it.
    fn build(&mut self, keys: &[u64], cube: Cube) {
        let Cube { level, corner, edge, points } = cube;
        let mass: f64 = self.points[points.clone()].iter().map(|point| point.2).sum();
        let moment: DVec3 = self.points[points.clone()].iter().map(|point| point.2 * point.1).sum();
        let center_of_mass = moment / mass;
        let number = self.nodes.len();
        self.nodes.push(Node {
            edge,
            eccentricity: (center_of_mass - corner - DVec3::splat(0.5 * edge)).norm(),
            center_of_mass,
            mass,
            points: points.start as u32..points.end as u32,
            end: 0,
            is_leaf: points.len() <= LEAF || level == LEVELS,
        });
        if !self.nodes[number].is_leaf {
            let shift = 3 * (LEVELS - 1 - level);
            let mut start = points.start;
            while start < points.end {
                let octant = (keys[start] >> shift) & 7;
                let is_here = |key: &u64| (key >> shift) & 7 == octant;
                let count = keys[start..points.end].partition_point(is_here);
                let part = [octant & 1, (octant >> 1) & 1, octant >> 2].map(|bit| bit as f64);
                let half = 0.5 * edge;
                let corner = corner + half * DVec3::from_array(part);
                let points = start..start + count;
                self.build(keys, Cube { level: level + 1, corner, edge: half, points });
                start += count;
            }
        }
        self.nodes[number].end = self.nodes.len() as u32;
    }

    /// Visits all points other than that with this index, each with its offset from it \[m\] and its mass \[kg\]. A
    /// cube whose edge is less than `opening_angle` times its distance counts as one point at its centre of mass.
    pub fn visit(
        &self,
        index: usize,
        from: DVec3,
        opening_angle: f64,
        mut visit: impl FnMut(DVec3, f64),
    ) {
        let mut next = 0;
        while let Some(node) = self.nodes.get(next) {
            let offset = node.center_of_mass - from;
            if node.edge < opening_angle * (offset.norm() - node.eccentricity) {
                visit(offset, node.mass);
                next = node.end as usize;
                continue;
            }
            if node.is_leaf {
                let points = node.points.start as usize..node.points.end as usize;
                for &(other, place, mass) in &self.points[points] {
                    if other as usize != index {
                        visit(place - from, mass);
                    }
                }
            }
            next += 1;
        }
    }
}

/// Bits of the three parts of a place in the unit cube, in turn: its number on Morton's curve.
fn key(place: DVec3) -> u64 {
    let cells = f64::from(1u32 << LEVELS);
    // A place that is no number, as of points that are all one, is in the first cell.
    let cell = |part: f64| ((part * cells) as u64).min((1 << LEVELS) - 1);
    spread(cell(place.x)) | spread(cell(place.y)) << 1 | spread(cell(place.z)) << 2
}

/// The lowest 21 bits, each followed by two zeros.
fn spread(bits: u64) -> u64 {
    let mut spread = bits;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        spread = (spread | spread << shift) & mask;
    }
    spread
}
