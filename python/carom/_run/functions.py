"""Forces that are functions of Python."""

from __future__ import annotations

import threading
from collections.abc import Callable
from operator import index as as_index
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import Engine
from carom._run.tables import IMPACT, SENSOR_EVENT, records
from carom._run.trajectory import RunRecord, Selection, Trajectory, box_of, slides_of
from carom._scene.points import spread
from carom._scene.text import read_part
from carom.errors import CaromError

Function: TypeAlias = Callable[[Any], ArrayLike]
"""Takes the world, and returns the force on each of its spheres [N], spread to shape (n, 3)."""

_FROZEN = ("positions", "velocities", "masses", "radii")
"""Arrays of a world that functions are likely to read: while they are at work, these are not to be
written to by mistake, as by ``p -= p.mean(axis=0)``."""


_CORRECTED = ("exact", "contact")
"""Rules that know no other forces than constant ones, to which the scheme is added."""


class Functions:
    """The functions among the forces of a world, by their ids, which are negative.

    In a frame of length h each sphere of mass m is under the constant force F0 that the functions
    give at its start, between impacts on an exact parabola; at its end, where they give F1, its
    velocity changes by h (F1 - F0) / (2 m). That is the scheme of Verlet in its velocity form
    (Swope et al., J. Chem. Phys. 76, 637 (1982)): its error is of the second order in h. Without
    impacts the energy in a force that has one swings by that order and does not drift; each impact
    adds an error of that order. The rules ``discrete`` and ``bisect`` have integrators of their
    own, to which nothing is added.
    """

    def __init__(self) -> None:
        self.by_id: dict[int, Function] = {}
        self._next = -1
        self._lock = threading.RLock()
        self._is_asked = False

    def add(self, force: Function) -> int:
        """Adds a function, and returns its id."""
        number = self._next
        self.by_id[number] = force
        self._next -= 1
        return number

    def copy(self) -> Functions:
        """The same functions, for another world."""
        twin = Functions()
        twin.by_id, twin._next = dict(self.by_id), self._next
        return twin

    def __getstate__(self) -> tuple[dict[int, Function], int]:
        return self.by_id, self._next

    def __setstate__(self, state: tuple[dict[int, Function], int]) -> None:
        self.__init__()  # type: ignore[misc]
        self.by_id, self._next = state

    def step(self, world: Engine, dt: float | None, frames: int) -> None:
        """Takes frames; if one is refused, the world is as it was before the call."""
        number = count("frames", frames)
        with self._lock:
            before = world.snapshot()
            try:
                self._go(world, dt, number, lambda frame: None)
            except BaseException:
                world.restore(before)
                raise

    def record(
        self,
        world: Engine,
        frames: int,
        dt: float | None,
        every: int,
        selection: Selection,
    ) -> Trajectory:
        """Takes frames, and records states and events as `World.run` does."""
        with self._lock:
            before = world.snapshot()
            single = selection._replace(has_impacts=False, has_sensor_events=False)
            states = [world._record(0, dt, 1, single)]
            events: dict[str, list[NDArray[np.void]]] = {}
            if selection.has_impacts:
                events["impacts"] = [np.empty(0, IMPACT)]
            if selection.has_sensor_events:
                events["sensor_events"] = [np.empty(0, SENSOR_EVENT)]

            def look(frame: int) -> None:
                if selection.has_impacts:
                    events["impacts"].append(records(world._impact_words(), IMPACT))
                if selection.has_sensor_events:
                    seen = records(world._sensor_event_words(), SENSOR_EVENT)
                    events["sensor_events"].append(seen)
                if (frame + 1) % every == 0:
                    states.append(world._record(0, dt, 1, single))

            stopped = None
            try:
                self._go(world, dt, frames, look)
            except KeyboardInterrupt as error:
                stopped = error
            except BaseException:
                world.restore(before)
                raise
        trajectory = _joined(states, events, world)
        if stopped is not None:
            stopped.trajectory = trajectory  # type: ignore[attr-defined]
            raise stopped
        return trajectory

    def _go(
        self, world: Engine, dt: float | None, frames: int, look: Callable[[int], None]
    ) -> None:
        """Takes frames, and has ``look`` look at the world after each.

        What ends them leaves the world at the end of the last whole one.
        """
        length = world.frame_time if dt is None else dt
        is_corrected = read_part("simulation", world._simulation_json()).rule in _CORRECTED
        ids, own = world.ids, world.applied_forces.copy()
        has_own = bool(own.any())
        force = self._force(world)
        for frame in range(frames):
            before = world.snapshot()
            try:
                world.applied_forces = own + force
                Engine.step(world, dt=dt)
                if world.ids is not ids:
                    # Of the spheres that are still there; others come without a force.
                    stay = np.isin(world.ids, ids)
                    places = np.searchsorted(ids, world.ids[stay])
                    own, force = (_among(all_, places, stay) for all_ in (own, force))
                    ids = world.ids
                if not has_own:
                    # Without any, flights and heaps are those of a world that has none.
                    world._release()
                last, force = force, self._force(world)
                if is_corrected:
                    change = force - last
                    if world.emitted.size:
                        change[np.isin(ids, world.emitted)] = 0
                    if change.any():
                        change *= 0.5 * length / world.masses[:, None]
                        world.velocities = world.velocities + change
                if has_own:
                    world.applied_forces = own
            except BaseException:
                world.restore(before)
                raise
            look(frame)

    def _force(self, world: Engine) -> NDArray[np.float64]:
        """The sum of all functions for the world of now [N], shape (n, 3)."""
        if self._is_asked:
            problem = "a force that is a function must not step the world that it acts on"
            raise CaromError(f"forces: {problem}", "forces")
        total, ids = np.zeros((len(world), 3)), world.ids
        frozen = [getattr(world, name) for name in _FROZEN]
        self._is_asked = True
        try:
            for array in frozen:
                array.flags.writeable = False
            for number, function in list(self.by_id.items()):
                force = function(world)
                if world.ids is not ids:
                    problem = "a function must neither add nor remove spheres"
                    raise CaromError(f"force {number}: {problem}", "forces")
                total += spread(f"force {number}", force, len(world), 3)
        finally:
            self._is_asked = False
            if world.ids is ids:
                for array in frozen:
                    array.flags.writeable = True
        return total


def _among(
    values: NDArray[np.float64], places: NDArray[np.intp], stay: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Vectors of the spheres that stay, in these places before; none for others."""
    kept = np.zeros((len(stay), 3))
    kept[stay] = values[places]
    return kept


def count(name: str, given: object) -> int:
    """A count, as the engine reads it."""
    if isinstance(given, bool) or not hasattr(given, "__index__"):
        kind = type(given).__name__
        raise TypeError(f"{name}: must be a whole number, not {kind}")
    number = as_index(given)
    if not 0 <= number < 2**64:
        raise CaromError(f"{name}: must be in [0, 2^64), not {number}", name)
    return number


def _joined(
    states: list[RunRecord],
    events: dict[str, list[NDArray[np.void]]],
    world: Engine,
) -> Trajectory:
    """A trajectory of single states, each as the engine records it."""
    known: dict[int, tuple[float, float]] = {}
    for state in states:
        ids, radii, masses = (values.tolist() for values in state[1:4])
        known.update(zip(ids, zip(radii, masses, strict=True), strict=True))
    all_ids = np.array(sorted(known), dtype=np.uint64)
    motion: dict[str, NDArray[Any]] = {}
    for number, (name, first) in enumerate(states[0][5]):
        shape = (len(states), len(all_ids), first.shape[2])
        motion[name] = np.full(shape, np.nan, first.dtype)
        for place, state in enumerate(states):
            motion[name][place, np.searchsorted(all_ids, state[1])] = state[5][number][1][0]
    motion.update({name: np.concatenate(parts) for name, parts in events.items()})
    time = np.concatenate([state[0] for state in states])
    return Trajectory(
        time=time,
        ids=all_ids,
        radii=np.array([known[number][0] for number in all_ids.tolist()]),
        masses=np.array([known[number][1] for number in all_ids.tolist()]),
        box=box_of(world),
        slides=slides_of(world, time),
        **motion,
    )
