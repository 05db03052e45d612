"""Pairs of points that are near each other, by a cell list."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from carom.analysis._arguments import Floats
from carom.errors import CaromError

Indices = NDArray[np.int64]

_CANDIDATES = 1 << 18
"""Pairs tested at once, about: their arrays stay in the cache of a processor."""


def check_distance(distance: float, box: Floats, name: str) -> None:
    """Refuses a distance at which the nearest image of a point is not the only one.

    Raises:
        CaromError: For a distance beyond half the smallest side.
    """
    half = 0.5 * float(box.min())
    if distance > half:
        raise CaromError(
            f"{name}: must be at most half the smallest side of the box, {half}, not {distance}",
            name,
        )


def pairs_within(
    points: Floats, box: Floats, distance: float
) -> Iterator[tuple[Indices, Indices, Floats]]:
    """Every pair of points nearer than a distance, once, in pieces.

    Each point is compared with those in its cell and the cells around it, which are as wide as the
    distance, or wider; the work grows with n times the points in 14 cells.

    Args:
        points: Points [m], shape (n, 3), none NaN.
        box: Sides of the periodic box [m], infinite along axes that are open.
        distance: At most half the smallest side [m], > 0.

    Yields:
        Indices of the first and of the second points, and the squares of their distances [m²].
    """
    cells, shape = _cells(points, box, distance)
    order = np.argsort(cells, kind="stable")
    cells, points = cells[order], points[order]
    starts = np.searchsorted(cells, np.arange(int(np.prod(shape)) + 1))
    which, begin, end = _runs(cells, shape, np.isfinite(box), starts)
    lengths = end - begin
    whole = np.cumsum(lengths)
    cuts = np.searchsorted(whole, np.arange(_CANDIDATES, _total(whole), _CANDIDATES), "right")
    period = np.where(np.isfinite(box), box, 0.0)
    for piece in np.split(np.arange(len(lengths)), np.unique(cuts)):
        length = lengths[piece]
        first = np.repeat(which[piece], length)
        ends = np.cumsum(length)
        second = np.arange(_total(ends)) + np.repeat(begin[piece] - ends + length, length)
        squares = np.zeros(len(first))
        for axis in range(3):
            apart = points[second, axis] - points[first, axis]
            if period[axis] > 0:
                apart -= period[axis] * np.rint(apart / period[axis])
            squares += apart * apart
        near = squares < distance * distance
        yield order[first[near]], order[second[near]], squares[near]


def _total(sums: Indices) -> int:
    return int(sums[-1]) if len(sums) else 0


def _cells(points: Floats, box: Floats, distance: float) -> tuple[Indices, Indices]:
    """The cell of each point, and how many cells there are along each axis."""
    is_periodic = np.isfinite(box)
    low = np.where(is_periodic, 0.0, points.min(axis=0, initial=np.inf))
    extent = np.where(is_periodic, box, points.max(axis=0, initial=-np.inf) - low)
    if not len(points):
        low, extent = np.zeros(3), np.ones(3)
    # No more cells than about eight for each point: most would be empty.
    most = 2 * int(np.ceil(max(len(points), 1) ** (1 / 3)))
    shape = np.clip(np.floor(extent / distance), 1, most).astype(np.int64)
    width = np.where(extent > 0, extent, 1.0) / shape
    along = np.floor((points - low) / width).astype(np.int64)
    # Rounding may put a point at a side into the cell beyond.
    along = np.where(is_periodic, along % shape, np.clip(along, 0, shape - 1))
    return (along[:, 0] * shape[1] + along[:, 1]) * shape[2] + along[:, 2], shape


def _runs(
    cells: Indices, shape: Indices, is_periodic: NDArray[np.bool_], starts: Indices
) -> tuple[Indices, Indices, Indices]:
    """What each point is compared with: runs of points, in the order of cells.

    Returns:
        The point, the first of its run, and the end of its run, for each run.
    """
    number = np.arange(len(cells))
    # Those of its own cell that come after it.
    found = [(number, number + 1, starts[cells + 1])]
    along = np.stack(np.unravel_index(cells, tuple(shape)), axis=1)
    steps = [
        np.arange(-1, 2) if count > 2 or not periodic else np.arange(count)
        for count, periodic in zip(shape, is_periodic, strict=True)
    ]
    for offset in np.stack(np.meshgrid(*steps, indexing="ij"), axis=-1).reshape(-1, 3):
        other = along + offset
        is_inside = ((other >= 0) & (other < shape) | is_periodic).all(axis=1)
        other = np.where(is_periodic, other % shape, other)
        cell = (other[:, 0] * shape[1] + other[:, 1]) * shape[2] + other[:, 2]
        # Each pair of cells comes twice, once from each side.
        keep = np.flatnonzero(is_inside & (cell > cells))
        found.append((keep, starts[cell[keep]], starts[cell[keep] + 1]))
    which, begin, end = (np.concatenate(part) for part in zip(*found, strict=True))
    is_empty = begin == end
    return which[~is_empty], begin[~is_empty], end[~is_empty]
