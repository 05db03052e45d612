"""Clusters of spheres."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import label_clusters, pairs_within
from carom.analysis import _arguments as arguments
from carom.analysis._contacts import Indices, ascending, index_pairs
from carom.analysis._distances import check_distance


@dataclass(frozen=True, eq=False)
class Clusters:
    """Spheres that pairs connect, directly or through others.

    Attributes:
        labels: The cluster of each sphere, from 0 in the order of their first spheres, shape (n,).
        sizes: How many spheres each cluster has, shape (clusters,). A single sphere is one, too.
    """

    labels: NDArray[np.int64]
    sizes: NDArray[np.int64]


def neighbour_pairs(
    positions: ArrayLike, box: arguments.Box | None = None, *, distance: float
) -> Indices:
    """The pairs of spheres whose centres are nearer than a distance.

    Args:
        positions: Centres of one frame [m], shape (n, 3). A sphere at NaN is in no pair.
        box: Sides of the periodic box [m], shape (3,); infinite along an axis that is open.
        distance: Between centres [m], at most half the smallest side.

    Returns:
        Indices of both spheres of each pair, the smaller first, ascending, shape (m, 2).

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.neighbour_pairs([[0, 0, 0], [9, 0, 0]], (10, 10, 10), distance=2).tolist()
    [[0, 1]]
    """
    points, sides = arguments.one_frame(positions), arguments.box_sides(box)
    check_distance(arguments.positive(distance, "distance"), sides, "distance")
    there = np.flatnonzero(arguments.is_there(points))
    if not len(there):
        return np.zeros((0, 2), np.int64)
    first, second, _ = pairs_within(points[there], sides.tolist(), distance)
    return ascending(np.stack([there[first], there[second]], axis=1))


def clusters(pairs: ArrayLike, count: int) -> Clusters:
    """The clusters that pairs of spheres make.

    Args:
        pairs: Indices of both spheres of each pair, shape (m, 2), by contact from
            `contact_network` or `pairs_in_contact`, by distance from `neighbour_pairs`.
        count: How many spheres there are.

    Returns:
        The cluster of each sphere, and the sizes of clusters.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> found = analysis.clusters([[0, 3], [3, 4]], count=5)
    >>> found.labels.tolist(), found.sizes.tolist()
    ([0, 1, 2, 0, 0], [3, 1, 1])
    """
    labels = label_clusters(count, index_pairs(pairs, count).tolist())
    return Clusters(labels, np.bincount(labels).astype(np.int64))
