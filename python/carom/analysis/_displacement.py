"""Paths through a periodic box, and how far they lead."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.analysis._lags import blocks, correlate
from carom.errors import CaromError


def unwrap(positions: Trajectory | ArrayLike, box: arguments.Box | None = None) -> Floats:
    """Continuous paths from positions that were wrapped into a periodic box.

    Each coordinate must move by less than half a side from frame to frame; if one moves farther,
    its path is wrong by whole sides from there on, which cannot be seen in the positions. A sphere
    that comes, goes or returns has NaN meanwhile, and begins a path where it comes.

    Args:
        positions: Centres [m], shape (t, n, 3), or a run.
        box: Sides of the periodic box [m], shape (3,); infinite along an axis that is open. That of
            a run unless given.

    Returns:
        Positions [m], shape (t, n, 3); those of the first frame are unchanged.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.unwrap([[[4, 0, 0]], [[-4, 0, 0]]], (10, 10, 10))[:, 0, 0].tolist()
    [4.0, 6.0]
    """
    points, sides = arguments.path(positions, "positions"), arguments.box_sides(box, positions)
    # Along an open axis there is nothing to unwrap: no step is half of it.
    images = np.rint(np.diff(points, axis=0) / sides)
    images = np.cumsum(np.nan_to_num(images), axis=0)
    paths = points.copy()
    paths[1:] -= images * np.where(np.isfinite(sides), sides, 0.0)
    return paths


def mean_square_displacement(
    positions: Trajectory | ArrayLike, box: arguments.Box | None = None, *, lags: int | None = None
) -> Floats:
    """The mean square displacement over the lag, averaged over spheres and all time origins.

    ``<|r(t0 + t) - r(t0)|²>``, all origins at once by Fourier transforms, so that work grows with
    ``t log t``: V. Calandrini, E. Pellegrini, P. Calligari, K. Hinsen and G. R. Kneller, Collection
    SFN 12, 201 (2011). Rounding leaves an error of about 1e-15 of the square of the
    longest path. Frames must be equally far apart in time. Long lags have few origins, which are
    not independent: those beyond a tenth of the run are mostly noise.

    Args:
        positions: Centres [m], shape (t, n, 3), or a run.
        box: Sides of the periodic box [m], by which positions are unwrapped first; that of a run
            unless given. Without one they are taken as they are.
        lags: How many lags, from 0; as many as there are frames unless given.

    Returns:
        Mean square displacement [m²] at lags of 0, 1, 2, ... frames, shape (lags,); NaN where no
        sphere is there at both ends of a lag.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> flight = [[[0, 0, 0]], [[2, 0, 0]], [[4, 0, 0]]]
    >>> analysis.mean_square_displacement(flight).round(9).tolist()
    [0.0, 4.0, 16.0]
    """
    paths = arguments.path(positions, "positions")
    count = arguments.lag_count(lags, len(paths))
    sides = arguments.box_sides(box, positions)
    if np.isfinite(sides).any():
        paths = unwrap(paths, sides)
    sums, samples = np.zeros(count), np.zeros(count)
    for block in blocks(paths):
        there = arguments.is_there(block).astype(np.float64)
        known = np.where(there[:, :, None] > 0, block, 0.0)
        # Near 0, squares lose the least in rounding.
        middle = known.sum(axis=0) / np.maximum(there.sum(axis=0), 1)[:, None]
        known = (known - middle) * there[:, :, None]
        square = (known**2).sum(axis=2)
        sums += correlate(square, there, count) + correlate(there, square, count)
        sums -= 2 * correlate(known, known, count)
        samples += np.rint(correlate(there, there, count))
    with np.errstate(invalid="ignore"):
        mean = np.where(samples > 0, sums / samples, np.nan)
    # A square is not negative, and at no lag it is 0.
    mean[:1] *= 0
    return np.maximum(mean, 0.0)


def diffusion_coefficient(
    time: ArrayLike,
    msd: ArrayLike,
    *,
    begin: float | None = None,
    end: float | None = None,
    dimensions: int = 3,
) -> float:
    """The self-diffusion coefficient by Einstein's relation.

    A line is fitted to the mean square displacement by least squares; its slope is ``2 d D``: D.
    Frenkel and B. Smit, Understanding Molecular Simulation, 2nd ed. (2002), section 4.4. The fit is
    to begin when motion is diffusive, after some ten collisions of a sphere. In a cubic periodic
    box of side L, D is smaller than that of an infinite fluid by ``2.837297 kT / (6π η L)``, with η
    the viscosity: I.-C. Yeh and G. Hummer, J. Phys. Chem. B 108, 15873 (2004); `infinite_diffusion`
    adds that.

    Args:
        time: Lags [s], shape (t,).
        msd: Mean square displacement at them [m²], shape (t,).
        begin: Shortest lag of the fit [s]; the first unless given.
        end: Longest lag of the fit [s]; the last unless given.
        dimensions: Along how many axes spheres move.

    Returns:
        Diffusion coefficient [m²/s].

    Raises:
        CaromError: For a value that is invalid, or a fit to fewer than two lags.

    >>> from carom import analysis
    >>> analysis.diffusion_coefficient([0, 1, 2], [0, 5, 11], begin=1)
    1.0
    """
    times, squares = arguments.same_shape(time, msd, "msd")
    if dimensions not in (1, 2, 3):
        raise CaromError(f"dimensions: must be 1, 2 or 3, not {dimensions}", "dimensions")
    low = -np.inf if begin is None else begin
    high = np.inf if end is None else end
    keep = (times >= low) & (times <= high) & ~np.isnan(squares)
    if keep.sum() < 2:
        raise CaromError("begin: from there to the end must be at least two lags", "begin")
    x, y = times[keep] - times[keep].mean(), squares[keep] - squares[keep].mean()
    return float((x * y).sum() / (x**2).sum() / (2 * dimensions))
