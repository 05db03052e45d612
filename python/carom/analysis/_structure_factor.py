"""The static structure factor."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.errors import CaromError


@dataclass(frozen=True, eq=False)
class StructureFactor:
    """How density fluctuates, over the wave number; shells without wave vectors are left out.

    Attributes:
        q: Mean wave number of each shell [rad/m], shape (shells,).
        s: Structure factor, mean of each shell, shape (shells,).
        vectors: Wave vectors in each shell, q and -q counted once, shape (shells,). Without
            correlations between frames, ``s / sqrt(vectors * frames)`` is the standard error.
    """

    q: Floats
    s: Floats
    vectors: NDArray[np.int64]


class _Plane(NamedTuple):
    """Wave vectors with the same component along x."""

    q: Floats
    """Wave numbers [rad/m], shape (w,)."""
    keep: NDArray[np.bool_]
    """Which of the rows and columns they are; w are True."""
    rows: NDArray[np.bool_]
    """Which components along y there are, from the most negative."""
    columns: NDArray[np.bool_]
    """Which components along z there are, from the most negative."""


def structure_factor(
    positions: Trajectory | ArrayLike,
    box: arguments.Box | None = None,
    *,
    q_max: float,
    bins: int = 100,
) -> StructureFactor:
    """The static structure factor S(q), averaged over shells of wave vectors and over frames.

    ``S(q) = <|Σ_j exp(-i q·r_j)|²> / N`` for the wave vectors ``2π (h/Lx, k/Ly, l/Lz)`` that the
    box allows, but for 0: M. P. Allen and D. J. Tildesley, Computer Simulation of Liquids, 2nd ed.
    (2017), section 2.6. Points without correlations have 1.

    The work of a frame is N times the number of wave vectors, about ``q_max³ V / 12π²``: 0.5 s
    for 4,096 spheres and 60,000 wave vectors, on a slow core.

    Args:
        positions: Centres [m], shape (t, n, 3) or (n, 3), or a run; wrapped into the box or not.
        box: Sides of the periodic box [m], finite, shape (3,); that of a run unless given.
        q_max: Largest wave number [rad/m], at least that of the longest side, 2π/L.
        bins: Into how many shells of the same width, from 0 to ``q_max``.

    Returns:
        S(q), NaN without spheres.

    Raises:
        CaromError: For a value that is invalid.

    >>> import numpy
    >>> from carom import analysis
    >>> row = numpy.arange(4)
    >>> lattice = numpy.stack(numpy.meshgrid(row, row, row), axis=-1).reshape(-1, 3)
    >>> analysis.structure_factor(lattice, (4, 4, 4), q_max=6.2).s.max().round(9)
    np.float64(0.0)
    """
    points = arguments.frames(positions, "positions")
    sides = arguments.box_sides(box, positions)
    if not np.isfinite(sides).all():
        raise CaromError(f"box: must have finite sides, not {sides.tolist()}", "box")
    q_max, bins = arguments.positive(q_max, "q_max"), arguments.bin_count(bins)
    if q_max < 2 * np.pi / sides.max():
        raise CaromError(
            f"q_max: must be at least 2π/L of the longest side, {2 * np.pi / sides.max()}, "
            f"not {q_max}",
            "q_max",
        )
    frames = [frame[there] for frame, there in zip(points, arguments.is_there(points), strict=True)]
    frames = [frame for frame in frames if len(frame)]
    most = np.floor(q_max * sides / (2 * np.pi)).astype(np.int64)
    vectors, wave_numbers, sums = np.zeros(bins, np.int64), np.zeros(bins), np.zeros(bins)
    planes = [_plane(h, sides, q_max, most) for h in range(most[0] + 1)]
    shells = [np.minimum((plane.q * (bins / q_max)).astype(np.int64), bins - 1) for plane in planes]
    for plane, shell in zip(planes, shells, strict=True):
        vectors += np.bincount(shell, minlength=bins)
        wave_numbers += np.bincount(shell, plane.q, bins)
    for frame in frames:
        along_x, along_y, along_z = (_phases(frame, sides, axis, most) for axis in range(3))
        for h, (plane, shell) in enumerate(zip(planes, shells, strict=True)):
            across = along_x[h] * along_y[plane.rows]
            amplitudes = np.einsum("kj,lj->kl", across, along_z[plane.columns])
            power = (amplitudes.real**2 + amplitudes.imag**2)[plane.keep] / len(frame)
            sums += np.bincount(shell, power, bins)
    some = vectors > 0
    s = sums[some] / (vectors[some] * len(frames)) if frames else np.full(some.sum(), np.nan)
    return StructureFactor(wave_numbers[some] / vectors[some], s, vectors[some])


def _plane(h: int, sides: Floats, q_max: float, most: NDArray[np.int64]) -> _Plane:
    """The wave vectors ``(h, k, l)`` of one h."""
    k, l = (np.arange(-count, count + 1) for count in most[1:])  # noqa: E741
    # Those that may be short enough; which of them are follows.
    rest = np.sqrt(max(q_max**2 - (2 * np.pi * h / sides[0]) ** 2, 0.0)) / (2 * np.pi)
    rows, columns = abs(k) <= rest * sides[1] + 1, abs(l) <= rest * sides[2] + 1
    across, along = k[rows, None] / sides[1], l[columns] / sides[2]
    q = 2 * np.pi * np.sqrt((h / sides[0]) ** 2 + across**2 + along**2)
    # Of q and -q, which have the same S, one.
    is_first = (h > 0) | (across > 0) | ((across == 0) & (along > 0))
    keep = is_first & (q <= q_max)
    return _Plane(q[keep], keep, rows, columns)


def _phases(
    points: Floats, sides: Floats, axis: int, most: NDArray[np.int64]
) -> NDArray[np.complex128]:
    """``exp(-2πi h x/L)`` of each whole number h and each point; along x, none is negative."""
    count = int(most[axis])
    numbers = np.arange(0 if axis == 0 else -count, count + 1)
    angle = 2 * np.pi * (points[:, axis] / sides[axis] % 1)
    phases: NDArray[np.complex128] = np.exp(-1j * numbers[:, None] * angle)
    return phases
