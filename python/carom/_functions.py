"""Forces that are functions of Python."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import Engine
from carom._points import spread
from carom._tables import IMPACT
from carom._trajectory import Recorded, Trajectory

if TYPE_CHECKING:
    from carom._world import World

ForceFunction: TypeAlias = Callable[["World"], ArrayLike]
"""Takes a world, and returns the force on each of its spheres [N], spread to shape (n, 3)."""
State: TypeAlias = tuple[
    NDArray[np.float64],
    NDArray[np.uint64],
    NDArray[np.float64],
    NDArray[np.float64],
    NDArray[np.uint64],
    list[tuple[Recorded, NDArray[np.float64]]],
    BaseException | None,
]
"""What the engine records of a run: times, ids, radii, masses, impacts, what changes, its end."""


class Functions:
    """The functions among the forces of a world, by their ids, which are negative.

    In a frame of length h each sphere of mass m is under the constant force F0 that the functions
    give at its start, between impacts on an exact parabola; at its end, where they give F1, its
    velocity changes by h (F1 - F0) / (2 m). That is the scheme of Verlet in its velocity form
    (Swope et al., J. Chem. Phys. 76, 637 (1982)): its error is of the second order in h, and the
    energy in a force that has one is kept but for swings of that order.
    """

    def __init__(self) -> None:
        self.by_id: dict[int, ForceFunction] = {}
        self._next = -1

    def add(self, force: ForceFunction) -> int:
        """Adds a function, and returns its id."""
        number = self._next
        self.by_id[number] = force
        self._next -= 1
        return number

    def step(self, world: World, dt: float | None, frames: int) -> None:
        """Takes frames; if one is refused, the world is as it was before the call."""
        before = world.snapshot()
        try:
            self._go(world, dt, frames, lambda frame: None)
        except BaseException:
            world.restore(before)
            raise

    def record(
        self,
        world: World,
        frames: int,
        dt: float | None,
        every: int,
        quantities: list[Recorded] | None,
        is_single: bool,
    ) -> Trajectory:
        """Takes frames, and records states and impacts as `World.run` does."""
        before = world.snapshot()
        states = [world._record(0, dt, 1, quantities, is_single)]
        impacts: list[NDArray[np.void]] = []

        def look(frame: int) -> None:
            impacts.append(world.impacts)
            if (frame + 1) % every == 0:
                states.append(world._record(0, dt, 1, quantities, is_single))

        stopped = None
        try:
            self._go(world, dt, frames, look)
        except KeyboardInterrupt as error:
            stopped = error
        except BaseException:
            world.restore(before)
            raise
        trajectory = _joined(states, impacts)
        if stopped is not None:
            stopped.trajectory = trajectory  # type: ignore[attr-defined]
            raise stopped
        return trajectory

    def _go(self, world: World, dt: float | None, frames: int, look: Callable[[int], None]) -> None:
        """Takes frames, and has ``look`` look at the world after each."""
        length = world.frame_time if dt is None else dt
        force = self._force(world)
        for frame in range(frames):
            ids, own = world.ids, world.applied_forces.copy()
            world.applied_forces = own + force
            try:
                Engine.step(world, dt=dt)
            finally:
                # Of the spheres that are still there; others come without one.
                stay = np.isin(world.ids, ids)
                places = np.searchsorted(ids, world.ids[stay])
                kept, acted = np.zeros((len(world), 3)), np.zeros((len(world), 3))
                kept[stay], acted[stay] = own[places], force[places]
                if kept.any() or force.any():
                    world.applied_forces = kept
            force = self._force(world)
            change = np.where(stay[:, None], force - acted, 0.0)
            if change.any():
                world.velocities += change * (0.5 * length / world.masses[:, None])
            look(frame)

    def _force(self, world: World) -> NDArray[np.float64]:
        """The sum of all functions for the world of now [N], shape (n, 3)."""
        total = np.zeros((len(world), 3))
        for number, function in self.by_id.items():
            total += spread(f"force {number}", function(world), len(world), 3)
        return total


def _joined(states: list[State], impacts: list[NDArray[np.void]]) -> Trajectory:
    """A trajectory of single states, each as the engine records it."""
    known: dict[int, tuple[float, float]] = {}
    for state in states:
        ids, radii, masses = (values.tolist() for values in state[1:4])
        known.update(zip(ids, zip(radii, masses, strict=True), strict=True))
    all_ids = np.array(sorted(known), dtype=np.uint64)
    motion: dict[str, NDArray[np.float64]] = {}
    for number, (name, first) in enumerate(states[0][5]):
        shape = (len(states), len(all_ids), first.shape[2])
        motion[name] = np.full(shape, np.nan, first.dtype)
        for place, state in enumerate(states):
            motion[name][place, np.searchsorted(all_ids, state[1])] = state[5][number][1][0]
    return Trajectory(
        time=np.concatenate([state[0] for state in states]),
        ids=all_ids,
        radii=np.array([known[number][0] for number in all_ids.tolist()]),
        masses=np.array([known[number][1] for number in all_ids.tolist()]),
        impacts=np.concatenate(impacts) if impacts else np.empty(0, IMPACT),
        **motion,
    )
