"""Voronoi cells."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.errors import CaromError


def voronoi_volumes(positions: ArrayLike, box: arguments.Box) -> Floats:
    """The volume of the Voronoi cell of each sphere in a periodic box.

    The cell of a centre is all that is nearer to it than to other centres: the volume of a sphere
    by that of its cell is its local packing fraction. Cells are those of centres, whatever the
    sizes of spheres. By Qhull, through SciPy (``pip install carom[voronoi]``): C. B. Barber, D. P.
    Dobkin and H. Huhdanpaa, ACM Trans. Math. Softw. 22, 469 (1996).

    Args:
        positions: Centres of one frame [m], shape (n, 3). A sphere at NaN has no cell.
        box: Sides of the box [m], shape (3,), periodic along every axis.

    Returns:
        Volumes [m³], shape (n,); their sum is that of the box within 1e-9 of it.

    Raises:
        CaromError: For a value that is invalid, an open axis among them, and for spheres that
            have one centre.
        ModuleNotFoundError: Where SciPy is not installed.

    >>> from carom import analysis
    >>> analysis.voronoi_volumes([[0, 0, 0], [1, 0, 0]], (2, 1, 1)).round(9).tolist()
    [1.0, 1.0]
    """
    points, sides = arguments.one_frame(positions), arguments.box_sides(box)
    if not np.isfinite(sides).all():
        raise CaromError("box: must be periodic along every axis", "box")
    there = arguments.is_there(points)
    volumes = np.full(len(points), np.nan)
    if not there.any():
        return volumes
    scaled = points[there] / sides
    scaled -= np.floor(scaled)
    if len(np.unique(scaled, axis=0)) < len(scaled):
        raise CaromError("positions: two spheres have one centre", "positions")
    for images in _images(scaled, sides):
        found = _volumes(images * sides, len(scaled))
        if abs(found.sum() / sides.prod() - 1) < 1e-9:
            volumes[there] = found
            return volumes
    raise CaromError("positions: the cells do not fill the box", "positions")


def _volumes(points: Floats, count: int) -> Floats:
    """The volumes of the first cells; 0 of one without an end."""
    from scipy.spatial import ConvexHull, Voronoi

    cells = Voronoi(points)
    volumes = np.zeros(count)
    for place, number in enumerate(cells.point_region[:count]):
        region = cells.regions[number]
        if region and min(region) >= 0:
            volumes[place] = ConvexHull(cells.vertices[region]).volume
    return volumes


def _images(points: Floats, sides: Floats) -> Iterator[Floats]:
    """The points of a box of side 1 with their images: near ones, then more."""
    for layers in (1, 2):
        steps = range(-layers, layers + 1)
        shifts = np.array([shift for shift in product(steps, repeat=3) if any(shift)])
        images = (points[None] + shifts[:, None]).reshape(-1, 3)
        # A cell of points that fill the box evenly is some V^(1/3) wide.
        reach = 4 * (sides.prod() / len(points)) ** (1 / 3) / sides
        near = ((images > -reach) & (images < 1 + reach)).all(axis=1)
        if layers == 1 and not near.all():
            yield np.concatenate([points, images[near]])
        yield np.concatenate([points, images])
