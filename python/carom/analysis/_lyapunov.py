"""Lyapunov exponents: how fast runs that began side by side come apart."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom._run.derivatives import Tangents
from carom._run.world import World
from carom.analysis._arguments import positive, whole
from carom.errors import CaromError


@dataclass(frozen=True, kw_only=True, eq=False)
class LyapunovSpectrum:
    """Lyapunov exponents of a run.

    Attributes:
        exponents: The exponents [1/s], the largest first, shape (k,).
        history: What each was after each frame [1/s], shape (frames, k).
    """

    exponents: NDArray[np.float64]
    history: NDArray[np.float64]


def lyapunov_spectrum(
    world: World,
    seconds: float,
    *,
    count: int | None = None,
    dt: float | None = None,
    seed: int = 0,
) -> LyapunovSpectrum:
    """Measures the largest Lyapunov exponents of a world while it runs on.

    Directions begin at random, and are made orthonormal after every frame (Benettin, Galgani,
    Giorgilli and Strelcyn, Meccanica 15, 9 (1980)). Impacts are taken exactly (Dellago, Posch and
    Hoover, Phys. Rev. E 53, 1485 (1996)), as `carom.Tangents` takes them. A change of the motion of
    spheres is measured in mean radii and root mean square speeds; exponents do not depend on that.

    Args:
        world: The world. It is that much older afterwards.
        seconds: How long [s], up to whole frames.
        count: How many exponents; all of them, 6 for each sphere, unless given.
        dt: Length of a frame [s], the scene's own unless given: a few impacts of a sphere at most.
        seed: Of the first directions.

    Raises:
        CaromError: If the world has something whose derivatives are not known, or an argument makes
            no sense.
        StepError: Where there is no derivative.

    >>> import carom
    >>> from carom import analysis
    >>> balls = [
    ...     carom.Sphere(position=(-1, 0.3, 0), radius=0.5, velocity=(1, 0, 0)),
    ...     carom.Sphere(position=(1, 0, 0.2), radius=0.5, velocity=(-1, 0.5, 0)),
    ... ]
    >>> box = carom.Periodic(size=(4, 4, 4))
    >>> scene = carom.Scene(
    ...     name="two", spheres=balls, simulation=carom.Simulation(boundary=box)
    ... )
    >>> found = analysis.lyapunov_spectrum(scene.world(), 20, dt=0.5)
    >>> bool(abs(found.exponents.sum()) < 1e-12)
    True
    """
    seconds = positive(seconds, "seconds")
    frame = world.frame_time if dt is None else positive(dt, "dt")
    most = 6 * len(world)
    count = most if count is None else whole(count, "count")
    if not 1 <= count <= most:
        raise CaromError(f"count: must be from 1 to {most}, not {count}", "count")
    frames = max(1, round(seconds / frame))
    length = float(world.radii.mean())
    speed = float(np.sqrt((world.velocities**2).sum(axis=1).mean())) or 1.0
    random = np.random.default_rng(seed)
    tangents = Tangents(
        world,
        positions=length * random.normal(size=(count, len(world), 3)),
        velocities=speed * random.normal(size=(count, len(world), 3)),
    )
    tangents.orthonormalize(length=length, speed=speed)
    growth = np.zeros((frames, count))
    for number in range(frames):
        tangents.step(dt=frame)
        growth[number] = np.log(tangents.orthonormalize(length=length, speed=speed))
    times = frame * np.arange(1, frames + 1)
    history = growth.cumsum(axis=0) / times[:, np.newaxis]
    return LyapunovSpectrum(exponents=history[-1], history=history)
