"""Which spheres touch."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import pairs_within
from carom.analysis import _arguments as arguments
from carom.analysis._collisions import impacts_between_spheres
from carom.analysis._distances import check_distance
from carom.errors import CaromError

Indices = NDArray[np.int64]


def contact_network(
    positions: ArrayLike,
    radii: ArrayLike,
    box: arguments.Box | None = None,
    *,
    tolerance: float,
) -> Indices:
    """The pairs of spheres whose surfaces are not farther apart than a tolerance.

    A cell list finds them: the work grows with the number of spheres, as long as the largest is
    not many times as large as the others.

    Args:
        positions: Centres of one frame [m], shape (n, 3). A sphere at NaN touches none.
        radii: Radii [m], shape (n,), or one for all.
        box: Sides of the periodic box [m], shape (3,), each at least twice as long as the largest
            diameter and the tolerance together; infinite along an axis that is open.
        tolerance: Widest gap of two surfaces that touch [m], >= 0; rounding alone takes some 1e-15
            of the coordinates.

    Returns:
        Indices of both spheres of each pair, the smaller first, ascending, shape (m, 2).

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.contact_network([[0, 0, 0], [1, 0, 0], [3, 0, 0]], 0.5, tolerance=1e-9).tolist()
    [[0, 1]]
    """
    points = arguments.one_frame(positions)
    sizes, sides = arguments.per_sphere(radii, "radii", len(points)), arguments.box_sides(box)
    if not (np.isfinite(tolerance) and tolerance >= 0):
        raise CaromError(f"tolerance: must be finite and >= 0, not {tolerance}", "tolerance")
    there = np.flatnonzero(arguments.is_there(points))
    if not len(there):
        return np.zeros((0, 2), np.int64)
    # The pairs of a search are nearer than its distance; those at it are wanted, too.
    distance = float(np.nextafter(2 * sizes[there].max() + tolerance, np.inf))
    check_distance(distance, sides, "box")
    first, second, squares = pairs_within(points[there], sides.tolist(), distance)
    one, other = there[first], there[second]
    touch = np.sqrt(squares) <= sizes[one] + sizes[other] + tolerance
    return ascending(np.stack([one[touch], other[touch]], axis=1))


def pairs_in_contact(contacts: NDArray[np.void], ids: ArrayLike) -> Indices:
    """The pairs of spheres in records of contacts, as `contact_network` has them.

    Args:
        contacts: Records of `carom.CONTACT`, from ``world.contacts``; those of colliders are left
            out. Records of impacts do, too.
        ids: Ids of the spheres, ascending, shape (n,), from ``world.ids``.

    Returns:
        Indices into ``ids`` of both spheres of each pair, the smaller first, ascending, each pair
        once, shape (m, 2).

    Raises:
        CaromError: For a value that is invalid, or a contact of a sphere that has no id there.
    """
    numbers = np.asarray(ids).astype(np.int64)
    if numbers.ndim != 1 or (np.diff(numbers) <= 0).any():
        raise CaromError("ids: must ascend, shape (n,)", "ids")
    between = impacts_between_spheres(contacts)
    pairs = np.stack([between["sphere_1"], between["sphere_2"]], axis=1)
    if not np.isin(pairs, numbers).all():
        raise CaromError("ids: must have every sphere of the contacts", "ids")
    return np.unique(ascending(np.searchsorted(numbers, pairs)), axis=0)


def coordination_numbers(pairs: ArrayLike, count: int) -> Indices:
    """How many others each sphere touches.

    Args:
        pairs: Indices of both spheres of each pair, shape (m, 2), each pair once, from
            `contact_network` or `pairs_in_contact`.
        count: How many spheres there are.

    Returns:
        Coordination number of each sphere, shape (count,).

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.coordination_numbers([[0, 1], [1, 2]], count=4).tolist()
    [1, 2, 1, 0]
    """
    indices = index_pairs(pairs, count).reshape(-1)
    return np.bincount(indices, minlength=count).astype(np.int64)


def index_pairs(pairs: ArrayLike, count: int) -> Indices:
    """Pairs of indices below a count, shape (m, 2).

    Raises:
        CaromError: For something else.
    """
    if arguments.whole(count, "count") < 0:
        raise CaromError(f"count: must be >= 0, not {count}", "count")
    indices = np.asarray(pairs).reshape(-1)
    if indices.size % 2 or (indices.size and np.shape(pairs)[-1] != 2):
        raise CaromError(f"pairs: must have the shape (m, 2), not {np.shape(pairs)}", "pairs")
    if not np.isin(indices, np.arange(count)).all():
        raise CaromError(f"pairs: must be indices from 0 to {count - 1}", "pairs")
    return indices.astype(np.int64).reshape(-1, 2)


def ascending(pairs: Indices) -> Indices:
    """Pairs with the smaller index first, in ascending order."""
    pairs = np.sort(pairs, axis=1)
    return pairs[np.lexsort((pairs[:, 1], pairs[:, 0]))]
