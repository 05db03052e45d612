//! Neighbours of points.

use crate::pairs::for_each_pair;

/// Neighbours of one point after those of the other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Neighbours {
    /// Start of the neighbours of each point, followed by the end of those of the last one.
    starts: Vec<usize>,
    all: Vec<Bond>,
}

/// A neighbour of a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bond {
    /// Index of the neighbour.
    pub to: usize,
    /// Vector to its nearest image \[m\].
    pub vector: [f64; 3],
    /// Square of its distance \[m²\].
    pub squared_distance: f64,
}

impl Neighbours {
    /// Finds the neighbours of every point \[m\] within a distance \[m\], the nearest first and
    /// those at one distance by index. `sides` and `distance` are as in
    /// [`pairs_within`](crate::pairs_within).
    pub fn within(points: &[[f64; 3]], sides: [f64; 3], distance: f64) -> Self {
        let mut lists = vec![Vec::new(); points.len()];
        for_each_pair(points, sides, distance, |[one, other], squared_distance| {
            let vector = shortest(points[one], points[other], sides);
            lists[one].push(Bond { to: other, vector, squared_distance });
            let back = vector.map(|it| -it);
            lists[other].push(Bond { to: one, vector: back, squared_distance });
        });
        let mut neighbours = Self { starts: vec![0], all: Vec::new() };
        for mut list in lists {
            list.sort_by(|one: &Bond, other| {
                one.squared_distance.total_cmp(&other.squared_distance).then(one.to.cmp(&other.to))
            });
            neighbours.all.extend(list);
            neighbours.starts.push(neighbours.all.len());
        }
        neighbours
    }

    /// Finds the `count` nearest neighbours of every point \[m\]; `None` if a point has fewer within
    /// half the smallest side.
    pub fn nearest(points: &[[f64; 3]], sides: [f64; 3], count: usize) -> Option<Self> {
        let widest = 0.5 * sides.iter().copied().fold(f64::INFINITY, f64::min);
        let mut distance = first_distance(points, sides, count).min(widest);
        loop {
            let mut found = Self::within(points, sides, distance);
            let is_enough = (0..points.len()).all(|point| found.of(point).len() >= count);
            if is_enough {
                found.keep_nearest(count);
                return Some(found);
            }
            if distance >= widest || points.len() <= count {
                return None;
            }
            distance = (1.3 * distance).min(widest);
        }
    }

    /// Neighbours of a point.
    pub fn of(&self, point: usize) -> &[Bond] {
        &self.all[self.starts[point]..self.starts[point + 1]]
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there are no points.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn keep_nearest(&mut self, count: usize) {
        let nearest = (0..self.len()).flat_map(|point| self.of(point)[..count].to_vec()).collect();
        self.starts = (0..=self.len()).map(|point| point * count).collect();
        self.all = nearest;
    }
}

/// A distance within which points that fill the box evenly have `count` neighbours and a half more.
fn first_distance(points: &[[f64; 3]], sides: [f64; 3], count: usize) -> f64 {
    let extent = |axis: usize| {
        let along = || points.iter().map(move |point| point[axis]);
        let low = along().fold(f64::INFINITY, f64::min);
        let high = along().fold(f64::NEG_INFINITY, f64::max);
        if sides[axis].is_finite() { sides[axis] } else { high - low }
    };
    let extents = [0, 1, 2].map(extent);
    let longest = extents.iter().copied().fold(0.0, f64::max);
    if longest <= 0.0 {
        return 1.0;
    }
    // Points in a plane or on a line have no volume.
    let volume: f64 = extents.iter().map(|it| it.max(1e-3 * longest)).product();
    (1.5 * (count + 1) as f64 * volume / points.len() as f64).cbrt() * 0.62
}

/// Vector from a point to the nearest image of another.
fn shortest(one: [f64; 3], other: [f64; 3], sides: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| {
        let (apart, side) = (other[axis] - one[axis], sides[axis]);
        if side.is_finite() { apart - side * (apart / side).round() } else { apart }
    })
}
