"""Bond orientational order and crystal structures."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import NeighbourLists
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.analysis._distances import check_distance
from carom.errors import CaromError


@dataclass(frozen=True, eq=False)
class BondOrder:
    """How bonds are oriented.

    Attributes:
        local: q of each sphere, shape (n,); NaN for one without neighbours.
        total: Q of all bonds together; NaN without bonds. In a fluid of n spheres it falls as
            ``1 / sqrt(bonds)``, in a crystal it is that of the lattice.
    """

    local: Floats
    total: float


class CrystalStructure(IntEnum):
    """The structure around a sphere."""

    OTHER = 0
    FCC = 1
    HCP = 2
    BCC = 3
    ICOSAHEDRAL = 4


def bond_order(
    positions: ArrayLike,
    box: arguments.Box | None = None,
    *,
    degree: int = 6,
    distance: float | None = None,
    nearest: int | None = None,
    averaged: bool = False,
) -> BondOrder:
    """The bond orientational order of Steinhardt, Nelson and Ronchetti.

    ``q_l = sqrt(4π / (2l + 1) Σ_m |q_lm|²)``, with ``q_lm`` the mean of the spherical harmonic
    ``Y_lm`` over the bonds of a sphere: P. J. Steinhardt, D. R. Nelson and M. Ronchetti, Phys. Rev.
    B 28, 784 (1983). With 12 neighbours, q_6 is 0.57452 in fcc and 0.48476 in hcp, q_4 is 0.19094
    and 0.09722. Averaged over a sphere and its neighbours, ``q_lm`` tells crystals from fluids
    better: W. Lechner and C. Dellago, J. Chem. Phys. 129, 114707 (2008).

    Args:
        positions: Centres of one frame [m], shape (n, 3). A sphere at NaN has no neighbours.
        box: Sides of the periodic box [m], shape (3,); infinite along an axis that is open.
        degree: l, from 0 to 40.
        distance: Neighbours are nearer than this [m], at most half the smallest side.
        nearest: Or this number of nearest spheres are neighbours, 12 unless given; of those at one
            distance the ones that come first.
        averaged: Whether ``q_lm`` are averaged over neighbours first.

    Returns:
        The order of each sphere and of all bonds.

    Raises:
        CaromError: For a value that is invalid, or a sphere with too few neighbours.

    >>> from carom import analysis
    >>> cubic = [[x, y, z] for x in range(4) for y in range(4) for z in range(4)]
    >>> round(analysis.bond_order(cubic, (4, 4, 4), degree=4, nearest=6).total, 5)
    0.76376
    """
    if not 0 <= arguments.whole(degree, "degree") <= 40:
        raise CaromError(f"degree: must be from 0 to 40, not {degree}", "degree")
    if distance is not None and nearest is not None:
        raise CaromError("nearest: goes without distance", "nearest")
    count = 12 if nearest is None else arguments.whole(nearest, "nearest")
    if count < 1:
        raise CaromError(f"nearest: must be >= 1, not {nearest}", "nearest")
    there, lists = _neighbours(positions, box, distance, count)
    local, total = lists.bond_order(degree, bool(averaged))
    all_ = np.full(len(there), np.nan)
    all_[there] = local
    return BondOrder(all_, total)


def crystal_structure(
    positions: ArrayLike, box: arguments.Box | None = None, *, distance: float | None = None
) -> NDArray[np.int64]:
    """The crystal structure around each sphere, by common neighbour analysis.

    A pair is classified by the neighbours that both have, the bonds among these and the longest
    chain of such bonds: J. D. Honeycutt and H. C. Andersen, J. Phys. Chem. 91, 4950 (1987). Without
    a distance, one that adapts to the nearest 12 or 14 neighbours of each sphere decides on bonds:
    A. Stukowski, Modelling Simul. Mater. Sci. Eng. 20, 045021 (2012).

    Args:
        positions: Centres of one frame [m], shape (n, 3). A sphere at NaN has no structure.
        box: Sides of the periodic box [m], shape (3,); infinite along an axis that is open.
        distance: Spheres nearer than this are bonded [m], at most half the smallest side: between
            the first and second shell for fcc and hcp, the second and third for bcc.

    Returns:
        Members of `CrystalStructure`, as numbers, shape (n,).

    Raises:
        CaromError: For a value that is invalid, or, without a distance, fewer than 15 spheres
            within half the smallest side of one.

    >>> from carom import analysis
    >>> sides = (4, 4, 4)
    >>> grid = [(x, y, z) for x in range(8) for y in range(8) for z in range(8)]
    >>> fcc = [(x / 2, y / 2, z / 2) for x, y, z in grid if (x + y + z) % 2 == 0]
    >>> found = analysis.crystal_structure(fcc, sides)
    >>> bool((found == analysis.CrystalStructure.FCC).all())
    True
    """
    there, lists = _neighbours(positions, box, distance, 14)
    all_ = np.full(len(there), int(CrystalStructure.OTHER), np.int64)
    all_[there] = lists.structures(distance)
    return all_


def _neighbours(
    positions: ArrayLike, box: arguments.Box | None, distance: float | None, nearest: int
) -> tuple[NDArray[np.bool_], NeighbourLists]:
    """Which spheres are there, and their neighbours."""
    points, sides = arguments.one_frame(positions), arguments.box_sides(box)
    if distance is not None:
        check_distance(arguments.positive(distance, "distance"), sides, "distance")
    there = arguments.is_there(points)
    return there, NeighbourLists(points[there], sides.tolist(), distance, nearest)
