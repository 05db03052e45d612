"""Arguments, checked: each error names the argument first."""

from __future__ import annotations

import math
from operator import index
from typing import Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.trajectory import Trajectory
from carom._scene.parts import Periodic
from carom.errors import CaromError

Floats = NDArray[np.float64]
Box: TypeAlias = Periodic | ArrayLike
"""A periodic box: the boundary of a scene, or three sides [m]."""


def floats(values: ArrayLike, name: str) -> Floats:
    """An array of numbers, C-ordered."""
    try:
        return np.ascontiguousarray(values, dtype=np.float64).reshape(np.shape(values))
    except (TypeError, ValueError):
        raise CaromError(f"{name}: must be an array of numbers", name) from None


def frames(values: Trajectory | ArrayLike, name: Literal["positions", "velocities"]) -> Floats:
    """Vectors of spheres, shape (t, n, 3); a single frame (n, 3) is the only one."""
    if isinstance(values, Trajectory):
        recorded = getattr(values, name, None)
        if recorded is None:
            raise CaromError(f"{name}: were not recorded by the run", name)
        values = recorded
    vectors = floats(values, name)
    if vectors.ndim == 2:
        vectors = vectors[None]
    if vectors.ndim != 3 or vectors.shape[2] != 3:
        raise CaromError(
            f"{name}: must have the shape (t, n, 3) or (n, 3), not {np.shape(values)}", name
        )
    if np.isinf(vectors).any():
        raise CaromError(f"{name}: must be finite, or NaN where a sphere is not there", name)
    return vectors


def one_frame(positions: ArrayLike) -> Floats:
    """Centres of one frame, shape (n, 3)."""
    if np.ndim(positions) != 2:
        shape = np.shape(positions)
        raise CaromError(f"positions: must have the shape (n, 3), not {shape}", "positions")
    points: Floats = frames(positions, "positions")[0]
    return points


def path(values: Trajectory | ArrayLike, name: Literal["positions", "velocities"]) -> Floats:
    """Vectors of spheres over time, shape (t, n, 3)."""
    vectors = frames(values, name)
    if not isinstance(values, Trajectory) and np.ndim(values) != 3:
        raise CaromError(f"{name}: must have the shape (t, n, 3), not {np.shape(values)}", name)
    return vectors


class RecordedImpacts(NamedTuple):
    """Impacts, and the time in which they came."""

    impacts: NDArray[np.void]
    """Those between the first recorded state and the last."""
    duration: float
    """From the first recorded state to the last [s], > 0."""


def recorded_impacts(run: Trajectory, name: str) -> RecordedImpacts:
    """The impacts of a run between its first recorded state and its last.

    A run goes on after its last recorded state where the number of frames is no multiple of
    ``every``; impacts after it are left out, for the duration ends there.

    Args:
        run: The run.
        name: What errors call it.

    Raises:
        CaromError: If impacts were not recorded, or the states span no time.
    """
    impacts: NDArray[np.void] | None = getattr(run, "impacts", None)
    if impacts is None:
        raise CaromError("impacts: were not recorded by the run: see impacts=True", "impacts")
    duration = float(np.ptp(run.time)) if len(run) else 0.0
    if not duration > 0:
        states = "one recorded state spans" if len(run) == 1 else f"{len(run)} recorded states span"
        problem = f"its {states} no time: a rate needs two, at different times (see every=)"
        raise CaromError(f"{name}: {problem}", name)
    return RecordedImpacts(impacts[impacts["time"] <= run.time[-1]], duration)


def box_sides(box: Box | None, run: Trajectory | ArrayLike = ()) -> Floats:
    """Sides of a periodic box, shape (3,): that of the run unless one is given.

    They are infinite along each axis without a box.
    """
    if box is None and isinstance(run, Trajectory):
        if run.slides is not None:
            problem = "must be given for a run in steady shear, whose boxes slide: they count as"
            raise CaromError(f"box: {problem} aligned, or as open where a side is infinite", "box")
        box = run.box
    if box is None:
        return np.full(3, np.inf)
    sides = floats(box.size if isinstance(box, Periodic) else box, "box")
    if sides.shape != (3,) or not (sides > 0).all():
        raise CaromError(f"box: must be three sides > 0, not {box}", "box")
    return sides


def per_sphere(values: ArrayLike, name: str, count: int) -> Floats:
    """A number > 0 for each sphere, shape (n,), from one for all or one for each."""
    numbers = floats(values, name)
    if numbers.shape not in ((), (count,)):
        raise CaromError(
            f"{name}: must be a number or have the shape ({count},), not {numbers.shape}", name
        )
    if not (np.isfinite(numbers) & (numbers > 0)).all():
        raise CaromError(f"{name}: must be finite and > 0", name)
    return np.broadcast_to(numbers, (count,))


def positive(value: float, name: str) -> float:
    """A finite number > 0."""
    if not (math.isfinite(value) and value > 0):
        raise CaromError(f"{name}: must be finite and > 0, not {value}", name)
    return float(value)


def packing(packing_fraction: ArrayLike) -> Floats:
    """Packing fractions, each in [0, 1)."""
    fractions = floats(packing_fraction, "packing_fraction")
    if not ((fractions >= 0) & (fractions < 1)).all():
        raise CaromError("packing_fraction: must be in [0, 1)", "packing_fraction")
    return fractions


def whole(value: int, name: str) -> int:
    """A whole number."""
    try:
        return index(value)
    except TypeError:
        raise TypeError(f"{name}: must be a whole number, not {value!r}") from None


def bin_count(bins: int) -> int:
    """A number of bins."""
    if whole(bins, "bins") < 1:
        raise CaromError(f"bins: must be >= 1, not {bins}", "bins")
    return int(bins)


def lag_count(lags: int | None, states: int) -> int:
    """How many lags to compute: as many as there are states unless given."""
    if lags is None:
        return states
    if not 1 <= whole(lags, "lags") <= max(states, 1):
        raise CaromError(f"lags: must be from 1 to {states}, not {lags}", "lags")
    return min(int(lags), states)


def same_shape(time: ArrayLike, values: ArrayLike, name: str) -> tuple[Floats, Floats]:
    """Times that ascend, and a value at each, both of shape (t,)."""
    times, numbers = floats(time, "time"), floats(values, name)
    if times.ndim != 1 or (np.diff(times) <= 0).any():
        raise CaromError("time: must ascend, shape (t,)", "time")
    if numbers.shape != times.shape:
        raise CaromError(
            f"{name}: must have the shape of time, {times.shape}, not {numbers.shape}", name
        )
    return times, numbers


def lengths(vectors: Floats) -> Floats:
    """The lengths of vectors, shape (...,)."""
    norms: Floats = np.sqrt((vectors**2).sum(axis=-1))
    return norms


def is_there(vectors: Floats) -> NDArray[np.bool_]:
    """Which spheres are there, shape (t, n)."""
    there: NDArray[np.bool_] = np.logical_not(np.isnan(vectors).any(axis=-1))
    return there
