"""Batches: many worlds that step together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from operator import index as as_index
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import BatchEngine, Snapshot
from carom._run import tables
from carom._run.batch_actions import (
    DEFAULT_QUANTITIES,
    Actions,
    Observation,
    raise_refused,
)
from carom._run.batch_run import BatchRun, stacked
from carom._run.recording import check_choice, check_rhythm
from carom._run.strict import Strict
from carom._run.world import World
from carom._scene.library import load
from carom._scene.scene import Scene
from carom.errors import CaromError


def _restored(
    kind: type[Batch],
    threads: int | None,
    starts: list[Snapshot],
    of_worlds: list[int],
    now: list[Snapshot],
) -> Batch:
    """A batch that goes on from these states: what a pickle of one makes."""
    each = starts if len(starts) == 1 else [starts[number] for number in of_worlds]
    batch = BatchEngine.__new__(kind, each, len(of_worlds), threads)
    for number, snapshot in enumerate(now):
        batch._go_on_from(number, snapshot)
    return batch


class Batch(Strict, Actions):
    """Worlds that step together, on all cores.

    Each world is, to the bit, what it would be alone, however many there are and on however many
    threads. Arrays have a row for each world: ``positions``, ``velocities``, ``angular_velocities``
    and ``applied_forces`` (n, spheres, 3); ``orientations`` (n, spheres, 4); ``radii``, ``masses``,
    ``restitutions``, ``inertia_factors``, ``frictions``, ``rolling_frictions``,
    ``spinning_frictions`` and ``tangential_restitutions`` (n, spheres). They are kept as those of a
    `World` are: made at the first read, written by every step, read without copying. To set
    one, assign to it or write into it: ``batch.velocities = 0``, ``batch.velocities[3] = 0``.

    A row has places for as many spheres as there are in the world with the most (``counts``, and
    ``ids``); in the others, what is left is NaN. When spheres come or go so that this is another
    number, the attribute is a new array.

    A batch can be copied and pickled; the copy goes on by itself, bit for bit.

    Args:
        scene: The scene of all worlds, or its name; or a sequence of scenes, one for each world.
        n: How many worlds, for one scene.
        changes: Values that differ from world to world, n for each path (`Scene.with_changes`).
        seeds: A seed for each world: `Scene.with_seed`.
        threads: How many threads step them; one for each processor unless given.

    Raises:
        CaromError: For invalid values.

    >>> import carom
    >>> drops = carom.Batch("tutorial1", 3, changes={"spheres.0.position.1": [5.0, 6.0, 7.0]})
    >>> drops.step(frames=30)
    >>> drops.positions.shape
    (3, 5, 3)
    >>> drops.reset([0, 2])
    >>> [round(time, 3) for time in drops.times.tolist()]
    [0.0, 0.5, 0.0]
    """

    def __new__(
        cls,
        scene: Scene | str | Sequence[Scene],
        n: int | None = None,
        *,
        changes: Mapping[str, Iterable[Any]] | None = None,
        seeds: Iterable[int] | None = None,
        threads: int | None = None,
    ) -> Batch:
        """Makes the worlds."""
        scenes = _scenes(scene, n, changes or {}, seeds)
        starts = [scene.world().snapshot() for scene in scenes]
        batch = super().__new__(cls, starts, len(starts) if n is None else n, threads)
        batch._threads = threads
        return batch

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Everything is made by then."""

    _threads: int | None
    """As they were wanted."""

    def __reduce__(self) -> tuple[Any, ...]:
        starts, of_worlds = self._starts()
        now = [self._snapshot(number) for number in range(len(self))]
        return _restored, (type(self), self._threads, starts, of_worlds, now), dict(self.__dict__)

    def __repr__(self) -> str:
        counts = self.counts
        least, most = counts.min(), counts.max()
        told = f"{most} spheres each" if least == most else f"{least} to {most} spheres each"
        return f"<carom.Batch of {len(self)} worlds, {told}>"

    def step(
        self,
        *,
        dt: float | None = None,
        frames: int = 1,
        worlds: ArrayLike | None = None,
        out: Observation | None = None,
        quantities: Sequence[str] = DEFAULT_QUANTITIES,
    ) -> None:
        """Advances worlds by ``frames`` frames of ``dt`` [s], or of the scene's own length.

        All of them, or those with these numbers or truth values. Other threads run meanwhile.
        Ctrl-C stops within a tenth of a second; each world is then at the end of one of its frames,
        some further on than others. Into ``out`` goes what `observe` writes of ``quantities``.

        Raises:
            CaromError: If ``dt`` is not positive and finite, or for a number that names no world.
                No world was moved.
            StepError: If worlds refuse a frame; ``worlds`` of the exception has their numbers. Each
                of them stays as it was before that frame, the others have gone on.
        """
        observed = None if out is None else (list(quantities), out)
        raise_refused(self._step(dt, frames, self._numbers(worlds), None, observed))

    def reset(self, worlds: ArrayLike | None = None) -> None:
        """Returns worlds to their initial states, in microseconds each.

        Args:
            worlds: Their numbers, or n truth values; all of them unless given.

        Raises:
            CaromError: For numbers that name no world.
        """
        self._reset(self._numbers(worlds))

    def run(
        self,
        frames: int,
        *,
        dt: float | None = None,
        every: int = 1,
        quantities: Sequence[str] = DEFAULT_QUANTITIES,
        impacts: bool = True,
    ) -> BatchRun:
        """Takes frames in every world, and records them.

        Args:
            frames: How many.
            dt: Length of a frame [s]; that of the scene unless given.
            every: The present state and that after every so many frames are recorded.
            quantities: Names of the arrays that are recorded.
            impacts: Whether impacts are recorded. Without them there is one call of the engine for
                each recorded state, not for each frame.

        Raises:
            CaromError: For a value that is invalid.
            StepError: If worlds refuse a frame: see `step`.
        """
        number, rhythm = check_rhythm(frames, every)
        has_impacts = check_choice("impacts", impacts)
        times, states, met = [self.times], [self._state(quantities)], [self.impacts[:0]]
        for _ in range(number // rhythm):
            for _ in range(rhythm if has_impacts else 1):
                self.step(dt=dt, frames=1 if has_impacts else rhythm)
                if has_impacts:
                    met.append(self.impacts)
            times.append(self.times)
            states.append(self._state(quantities))
        for _ in range(number % rhythm):
            self.step(dt=dt)
            if has_impacts:
                met.append(self.impacts)
        recorded = {name: stacked([state[name] for state in states]) for name in quantities}
        return BatchRun(np.array(times), recorded, np.concatenate(met) if has_impacts else None)

    def _state(self, quantities: Sequence[str]) -> dict[str, NDArray[np.float64]]:
        """Copies of arrays of all worlds, by name, (n, spheres, width)."""
        state = {}
        for name in quantities:
            rows = np.empty((len(self), self._observation_length([name])))
            self._observe([name], rows)
            state[name] = rows.reshape(len(self), int(self.counts.max()), _width(name))
        return state

    def world(self, index: int) -> World:
        """A copy of one world, which goes on as that one does, bit for bit."""
        twin = World.__new__(World)
        twin.restore(self._snapshot(self._number(index)))
        return twin

    def set_world(self, index: int, world: World) -> None:
        """Puts a copy of a world in the place of one; reset returns to it from now on.

        Whatever a `World` can be changed in, one of a batch can be changed in so: take it by
        `world`, change it, and put it back.

        Raises:
            CaromError: If it has functions among its forces.
        """
        if not isinstance(world, World):
            raise TypeError(f"world: must be a carom.World, not {type(world).__name__}")
        world._refuse_functions("a batch")
        self._restore(self._number(index), world.snapshot())

    @property
    def impacts(self) -> NDArray[np.void]:
        """The impacts of the last frame: records of `carom.IMPACT`, after a field ``world``.

        A copy, in the order of worlds.
        """
        return _of_worlds(*self._impact_words(), tables.IMPACT)

    @property
    def triggers(self) -> NDArray[np.void]:
        """The spheres inside triggers: records of `carom.TRIGGER`, after a field ``world``."""
        return _of_worlds(*self._trigger_words(), tables.TRIGGER)

    @property
    def sensor_events(self) -> NDArray[np.void]:
        """Who entered and left triggers: records of `carom.SENSOR_EVENT`, after a field ``world``.

        Those of the last frame, a copy, in the order of worlds.
        """
        return _of_worlds(*self._sensor_event_words(), tables.SENSOR_EVENT)

    @property
    def well_events(self) -> NDArray[np.void]:
        """What happened at edges of wells: records of `carom.WELL_EVENT`, after a field ``world``.

        Those of the last frame, a copy, in the order of worlds.
        """
        return _of_worlds(*self._well_event_words(), tables.WELL_EVENT)

    def _number(self, index: int) -> int:
        count = len(self)
        number = as_index(index)
        if not -count <= number < count:
            raise CaromError(f"index: must be in [{-count}, {count}), not {number}", "index")
        return number % count


def _width(quantity: str) -> int:
    """How many numbers each sphere has of a quantity."""
    if quantity == "orientations":
        return 4
    vectors = ("positions", "velocities", "angular_velocities", "applied_forces")
    return 3 if quantity in vectors else 1


def _scenes(
    scene: Scene | str | Sequence[Scene],
    n: int | None,
    changes: Mapping[str, Iterable[Any]],
    seeds: Iterable[int] | None,
) -> list[Scene]:
    """One scene for all worlds, or one for each."""
    if not isinstance(scene, str | Scene):
        scenes = list(scene)
        if n is not None or changes or seeds is not None:
            raise TypeError("scene: a sequence of scenes goes without n, changes and seeds")
        for one in scenes:
            if not isinstance(one, Scene):
                raise TypeError(f"scene: must be a carom.Scene, not {type(one).__name__}")
        if not scenes:
            raise CaromError("scene: must be at least one", "scene")
        return scenes
    if n is None:
        raise TypeError("n: must be given with one scene")
    if as_index(n) < 1:
        raise CaromError(f"n: must be at least 1, not {n}", "n")
    first = load(scene) if isinstance(scene, str) else scene
    columns = {path: _column(values, n, f"changes[{path!r}]") for path, values in changes.items()}
    scenes = [
        first.with_changes({path: column[row] for path, column in columns.items()})
        for row in range(n if columns else 1)
    ]
    if seeds is not None:
        column = _column(seeds, n, "seeds")
        scenes = [scenes[row % len(scenes)].with_seed(seed) for row, seed in enumerate(column)]
    return scenes


def _column(values: Iterable[Any], n: int, name: str) -> list[Any]:
    """A value for each world, as Python's own: those of NumPy are not written in scenes."""
    column = [value.tolist() if isinstance(value, np.generic) else value for value in values]
    if len(column) != n:
        raise CaromError(f"{name}: must have {n} values, not {len(column)}", name)
    return column


def _of_worlds(
    words: NDArray[np.uint64], counts: list[int], kind: np.dtype[np.void]
) -> NDArray[np.void]:
    """Records of all worlds, each with the number of its world first."""
    plain = tables.records(words, kind)
    told = np.empty(len(plain), [("world", "i8"), *kind.descr])
    told["world"] = np.repeat(np.arange(len(counts)), counts)
    for name in kind.names or ():
        told[name] = plain[name]
    return told
