//! Clusters of points that pairs connect.

/// Labels the cluster of each of `count` points, from 0 in the order of their first points. Points
/// that are connected by pairs of indices are in one cluster.
///
/// # Panics
/// If an index is not below `count`.
pub fn cluster_labels(count: usize, pairs: &[[usize; 2]]) -> Vec<usize> {
    // Each point refers to one that is not greater; the root of a cluster to itself.
    let mut parents: Vec<usize> = (0..count).collect();
    for &[one, other] in pairs {
        let roots = [root(&mut parents, one), root(&mut parents, other)];
        parents[roots[0].max(roots[1])] = roots[0].min(roots[1]);
    }
    let mut labels = vec![0; count];
    let mut next = 0;
    for point in 0..count {
        let root = root(&mut parents, point);
        if root == point {
            labels[point] = next;
            next += 1;
        } else {
            labels[point] = labels[root];
        }
    }
    labels
}

fn root(parents: &mut [usize], mut point: usize) -> usize {
    while parents[point] != point {
        // Halves the path for the next search.
        parents[point] = parents[parents[point]];
        point = parents[point];
    }
    point
}
