"""How often spheres collide."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.errors import CaromError


def impacts_between_spheres(impacts: NDArray[np.void]) -> NDArray[np.void]:
    """The records of impacts, or contacts, without those of colliders.

    Raises:
        CaromError: For something else than records of Carom.
    """
    table = np.asarray(impacts)
    if "sphere_1" not in (table.dtype.names or ()):
        raise CaromError("impacts: must be records like those of carom.IMPACT", "impacts")
    return table[table["sphere_1"] >= 0]


def collision_frequency(
    impacts: Trajectory | NDArray[np.void],
    count: int | None = None,
    duration: float | None = None,
) -> float:
    """How often a sphere collides with others, on average.

    ``2 C / (N t)`` for C impacts between spheres, for each is one of two spheres. Impacts with
    colliders are left out.

    Args:
        impacts: A run, or records of `carom.IMPACT`.
        count: How many spheres there are; for records only.
        duration: In what time the impacts came [s]; for records only.

    Returns:
        Collisions of a sphere in a second [1/s], NaN without spheres.

    Raises:
        CaromError: For a value that is invalid, and for a run without impacts or without two
            recorded states.

    >>> import carom, numpy
    >>> from carom import analysis
    >>> impacts = numpy.zeros(30, carom.IMPACT)
    >>> analysis.collision_frequency(impacts, count=10, duration=2.0)
    3.0
    """
    if isinstance(impacts, Trajectory):
        for name, value in (("count", count), ("duration", duration)):
            if value is not None:
                raise CaromError(f"{name}: is that of the run, and must not be given, too", name)
        spheres = _mean_count(impacts)
        impacts, elapsed = arguments.recorded_impacts(impacts, "impacts")
    else:
        for name, value in (("count", count), ("duration", duration)):
            if value is None:
                raise CaromError(f"{name}: is needed with records of impacts", name)
            arguments.positive(value, name)
        spheres, elapsed = float(count or 0), float(duration or 0)
    between = len(impacts_between_spheres(impacts))
    return 2 * between / (spheres * elapsed) if spheres > 0 else float("nan")


def _mean_count(run: Trajectory) -> float:
    """How many spheres there are on average, by what was recorded."""
    for name in ("positions", "velocities"):
        recorded = getattr(run, name, None)
        if recorded is not None and len(run):
            return float(arguments.is_there(recorded).sum() / len(run))
    return float(len(run.ids))


def mean_free_path(velocities: Trajectory | ArrayLike, frequency: float) -> float:
    """How far a sphere flies from one collision to the next, on average.

    Mean speed over collision frequency: S. Chapman and T. G. Cowling, The Mathematical Theory of
    Non-Uniform Gases, 3rd ed. (1970), section 5.21.

    Args:
        velocities: Velocities [m/s], shape (t, n, 3) or (n, 3), or a run.
        frequency: Collisions of a sphere in a second [1/s], from `collision_frequency`.

    Returns:
        Mean free path [m], NaN without spheres.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.mean_free_path([[3, 0, 0], [0, 5, 0]], frequency=2.0)
    2.0
    """
    vectors = arguments.frames(velocities, "velocities")
    frequency = arguments.positive(frequency, "frequency")
    speeds = arguments.lengths(vectors[arguments.is_there(vectors)])
    return float(speeds.mean() / frequency) if len(speeds) else float("nan")
