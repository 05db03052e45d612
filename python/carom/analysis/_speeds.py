"""Speeds, and those of Maxwell."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats


@dataclass(frozen=True, eq=False)
class SpeedHistogram:
    """How speeds are distributed.

    Attributes:
        speed: Middles of the bins [m/s], shape (bins,).
        density: Part of the spheres in a bin over its width [s/m], shape (bins,).
        maxwell: What Maxwell's distribution has there at the same temperature: its mean over each
            bin, and over the masses of the spheres [s/m], shape (bins,).
        counts: How many speeds are in each bin, all frames together, shape (bins,).
        temperature: kT, mean of the frames [J].
        edges: Edges of the bins [m/s], shape (bins + 1,).
    """

    speed: Floats
    density: Floats
    maxwell: Floats
    counts: NDArray[np.int64]
    temperature: float
    edges: Floats


def temperature(velocities: Trajectory | ArrayLike, masses: ArrayLike) -> Floats:
    """The temperature kT of each frame.

    ``kT = Σ m v² / (3 N)``. Motion of all spheres together counts, too: subtract it first.

    Args:
        velocities: Velocities [m/s], shape (t, n, 3) or (n, 3), or a run.
        masses: Masses [kg], shape (n,), or one for all.

    Returns:
        kT [J], shape (t,); a single frame has one. NaN without spheres.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.temperature([[3, 0, 0], [0, 3, 0]], masses=2.0).tolist()
    [6.0]
    """
    vectors = arguments.frames(velocities, "velocities")
    weights = arguments.per_sphere(masses, "masses", vectors.shape[1])
    count = arguments.is_there(vectors).sum(axis=1)
    energies = (np.nan_to_num((vectors**2).sum(axis=2)) * weights).sum(axis=1)
    with np.errstate(invalid="ignore"):
        return np.where(count > 0, energies / (3 * count), np.nan)


def maxwell_speed_density(speed: ArrayLike, mass: float, temperature: float) -> Floats:
    """Maxwell's distribution of speeds.

    ``4π v² (m / 2π kT)^(3/2) exp(-m v² / 2kT)``: J. C. Maxwell, Phil. Mag. 19, 19
    (1860).

    Args:
        speed: Speeds [m/s], any shape; the density of a negative one is 0.
        mass: Mass of a sphere [kg].
        temperature: kT [J].

    Returns:
        Density [s/m], of the shape of ``speed``.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> float(analysis.maxwell_speed_density(1.0, mass=1.0, temperature=1.0).round(6))
    0.483941
    """
    v = np.maximum(arguments.floats(speed, "speed"), 0.0)
    b = arguments.positive(mass, "mass") / arguments.positive(temperature, "temperature")
    density: Floats = np.sqrt(2 / np.pi) * b**1.5 * v**2 * np.exp(-0.5 * b * v**2)
    return density


def speed_histogram(
    velocities: Trajectory | ArrayLike, masses: ArrayLike, *, bins: int = 50
) -> SpeedHistogram:
    """How speeds are distributed, beside Maxwell's distribution at the same temperature.

    Args:
        velocities: Velocities [m/s], shape (t, n, 3) or (n, 3), or a run.
        masses: Masses [kg], shape (n,), or one for all.
        bins: How many, of the same width, from 0 to the largest speed.

    Returns:
        Histogram, all frames together; densities are NaN without spheres.

    Raises:
        CaromError: For a value that is invalid.
    """
    vectors = arguments.frames(velocities, "velocities")
    bins = arguments.bin_count(bins)
    weights = arguments.per_sphere(masses, "masses", vectors.shape[1])
    there = arguments.is_there(vectors)
    speeds = arguments.lengths(vectors[there])
    edges = np.linspace(0, speeds.max(initial=0.0) or 1.0, bins + 1)
    counts = np.histogram(speeds, edges)[0]
    kinds, number = np.unique(np.broadcast_to(weights, there.shape)[there], return_counts=True)
    kt = temperature(vectors, weights)
    mean = float(kt[~np.isnan(kt)].mean()) if len(speeds) else float("nan")
    width = np.diff(edges)
    density, maxwell = np.full(bins, np.nan), np.full(bins, np.nan)
    if len(speeds):
        density = counts / (len(speeds) * width)
    if mean > 0:
        parts = zip(kinds, number / len(speeds), strict=True)
        below = sum(part * _maxwell_below(edges, kind / mean) for kind, part in parts)
        maxwell = np.diff(below) / width
    return SpeedHistogram(0.5 * (edges[1:] + edges[:-1]), density, maxwell, counts, mean, edges)


def _maxwell_below(speed: Floats, b: float) -> Floats:
    """The part of all spheres that is slower, with b the mass over kT: the density, integrated."""
    x = np.sqrt(0.5 * b) * speed
    error_function = np.array([math.erf(it) for it in x])
    below: Floats = error_function - 2 / np.sqrt(np.pi) * x * np.exp(-(x**2))
    return below
