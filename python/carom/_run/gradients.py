"""Gradients of a number that is made of the end of a run."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, fields
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.derivatives import Gradient, Tape
from carom._run.traced import Traced
from carom._run.world import World
from carom._scene.scene import Scene
from carom.errors import CaromError

Array = NDArray[np.float64]
MOTION = ("positions", "velocities", "angular_velocities")
"""The motion of spheres, as a world has it."""
NOT_OF_SPHERES = {
    field.name for field in fields(Gradient) if field.name.startswith(("collider_", "spring_"))
} | {"acceleration"}
"""Fields of a gradient without a row for each sphere."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RunEnd:
    """The end of a run, of which a number is to be made.

    The arrays support the operations of NumPy arrays that `carom.value_and_grad` differentiates.

    Attributes:
        positions: Centres of spheres [m], shape (n, 3), in the order of ids.
        velocities: Their velocities [m/s], shape (n, 3).
        angular_velocities: Their angular velocities [rad/s], shape (n, 3).
        world: The world at the end; what is read from it counts as constant.
    """

    positions: Traced
    velocities: Traced
    angular_velocities: Traced
    world: World


Loss: TypeAlias = Callable[[RunEnd], Any]
"""Makes a number of the end of a run."""


def value_and_grad(
    loss: Loss, *, seconds: float, dt: float | None = None
) -> Callable[..., tuple[Any, Gradient]]:
    """Returns a function that runs a scene, and gives a number made of the end and its gradient.

    The function takes a scene, or a world, which stays as it is. Arrays of shape (n, 3) named
    ``positions``, ``velocities`` or ``angular_velocities`` replace the motion at the start. Arrays
    of shape (b, n, 3) make b runs, on all cores: values have the shape (b,), and the arrays of the
    gradient have one more axis. Derivatives are known of the same worlds as for `carom.Tape`. Rows
    of the gradient are the spheres of the start, without those that emitters add.

    >>> import carom
    >>> balls = [
    ...     carom.Sphere(position=(0, 0, 0), radius=0.1, velocity=(1, 0.05, 0)),
    ...     carom.Sphere(position=(2, 0, 0), radius=0.1),
    ... ]
    >>> def miss(end):
    ...     return ((end.positions[1] - (3, 1, 0)) ** 2).sum()
    >>> shot = carom.value_and_grad(miss, seconds=4.0)
    >>> value, gradient = shot(carom.Scene(name="shot", spheres=balls))
    >>> gradient.velocities.shape
    (2, 3)

    Args:
        loss: Takes the `carom.RunEnd` of a run and returns a number.
        seconds: How long a run is [s].
        dt: The length of frames [s]; that of the scene unless given.

    Returns:
        The function. It returns the number and a `carom.Gradient`, and raises what `carom.Tape`
        does.

    Raises:
        CaromError: If ``seconds`` or ``dt`` is not positive and finite.
    """
    _frames(seconds, seconds if dt is None else dt)

    def run(start: Scene | World, **motion: ArrayLike | None) -> tuple[Any, Gradient]:
        runs = TapedRuns(start, motion, (seconds, dt))
        values, derivatives = [], []
        for world in runs.worlds:
            value, by = _value_and_derivatives(loss, world)
            values.append(value)
            derivatives.append(by)
        gradient = runs.gradient(*map(np.array, zip(*derivatives, strict=True)))
        return (np.reshape(values, runs.shape) if runs.shape else values[0]), gradient

    return run


class TapedRuns:
    """Runs from one start, or from several that differ in motion, with their records.

    Attributes:
        shape: The axes of runs: () for one run.
        worlds: Each at its end.
    """

    __slots__ = ("_spheres", "_tapes", "shape", "worlds")

    def __init__(
        self,
        start: Scene | World,
        motion: Mapping[str, ArrayLike | None],
        time: tuple[float, float | None],
    ) -> None:
        """Takes the runs, of a length in frames of a length [s], on all cores."""
        world = start.world() if isinstance(start, Scene) else copy.copy(start)
        self._spheres = len(world)
        given = _motion(motion, len(world))
        self.shape = _axes_of_runs(given)
        whole = {
            name: np.broadcast_to(rows, (*self.shape, *rows.shape[-2:])).reshape(-1, len(world), 3)
            for name, rows in given.items()
        }
        count = math.prod(self.shape)
        self.worlds = [world] if count == 1 else [copy.copy(world) for _ in range(count)]
        for number, it in enumerate(self.worlds):
            for name, rows in whole.items():
                getattr(it, name)[:] = rows[number]
        seconds, dt = time
        frames = _frames(seconds, world.frame_time if dt is None else dt)

        def record(world: World) -> Tape:
            tape = Tape(world)
            tape.step(dt=seconds / frames, frames=frames)
            return tape

        if count == 1:
            self._tapes = [record(world)]
        else:
            with ThreadPoolExecutor() as pool:
                self._tapes = list(pool.map(record, self.worlds))

    def ends(self) -> list[Array]:
        """Returns centres, velocities and angular velocities at the ends."""
        rows = [np.stack([getattr(world, name) for world in self.worlds]) for name in MOTION]
        return [it.reshape(*self.shape, -1, 3) for it in rows]

    def gradient(self, *derivatives: Array) -> Gradient:
        """Returns the gradients of a number of each run, by its derivatives by these ends."""
        count = len(self.worlds)
        ends = [np.reshape(it, (count, -1, 3)) for it in derivatives]
        gradients = [
            tape.gradient(positions=positions, velocities=velocities, angular_velocities=spins)
            for tape, positions, velocities, spins in zip(self._tapes, *ends, strict=True)
        ]
        whole = {}
        for field in fields(Gradient):
            rows = None if field.name in NOT_OF_SPHERES else self._spheres
            parts = [getattr(gradient, field.name)[:rows] for gradient in gradients]
            whole[field.name] = np.reshape(parts, (*self.shape, *parts[0].shape))
        return Gradient(**whole)


def _frames(seconds: float, dt: float) -> int:
    """Returns how many frames of at most this length [s] make a run."""
    for name, value in {"seconds": seconds, "dt": dt}.items():
        if not (np.isfinite(value) and value > 0):
            raise CaromError(f"{name}: must be positive and finite, not {value}", name)
    # A quotient that rounds up is no frame more.
    return max(1, math.ceil(seconds / dt * (1 - 1e-9)))


def _motion(motion: Mapping[str, ArrayLike | None], count: int) -> dict[str, Array]:
    given = {}
    for name, values in motion.items():
        if name not in MOTION:
            raise CaromError(f"{name}: must be one of {', '.join(MOTION)}", name)
        if values is None:
            continue
        rows = np.asarray(values, dtype=np.float64)
        if rows.ndim < 2 or rows.shape[-2:] != (count, 3):
            raise CaromError(
                f"{name}: must have the shape (..., {count}, 3), not {rows.shape}", name
            )
        if not np.isfinite(rows).all():
            raise CaromError(f"{name}: must be finite", name)
        given[name] = rows
    return given


def _axes_of_runs(given: dict[str, Array]) -> tuple[int, ...]:
    shapes = {name: rows.shape[:-2] for name, rows in given.items()}
    try:
        shape = np.broadcast_shapes(*shapes.values())
    except ValueError:
        *others, name = shapes
        what = f"must have as many runs as {' and '.join(others)}, not {shapes[name]}"
        raise CaromError(f"{name}: {what}", name) from None
    if 0 in shape:
        raise CaromError(f"{next(iter(given))}: must have at least one run", next(iter(given)))
    return shape


def _value_and_derivatives(loss: Loss, world: World) -> tuple[float, list[Array]]:
    """Returns the number that is made of an end, and its derivatives by the motion there."""
    traced = {name: Traced(np.array(getattr(world, name))) for name in MOTION}
    value = loss(RunEnd(**traced, world=world))
    if not isinstance(value, Traced):
        return float(value), [np.zeros(it.shape) for it in traced.values()]
    if value.size != 1:
        raise CaromError(f"loss: must be one number, not an array of shape {value.shape}", "loss")
    return value.value.item(), value.derivatives(tuple(traced.values()))
