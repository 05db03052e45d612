"""Actions in the worlds of a batch, and what agents observe."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import BatchEngine
from carom._scene import parts
from carom._scene.text import toml_value
from carom.errors import CaromError, StepError

Observation = NDArray[np.float32] | NDArray[np.float64]
"""A row for each world."""

DEFAULT_QUANTITIES = ("positions", "velocities")
"""What is observed, unless something else is given."""


def raise_refused(refused: Sequence[tuple[int, Exception]]) -> None:
    """Raises the error of the first of these worlds, which tells of the others.

    Raises:
        StepError: If worlds refused a frame; ``worlds`` of it has their numbers.
        CaromError: If something else was refused.
    """
    if not refused:
        return
    number, error = refused[0]
    if not isinstance(error, StepError):
        raise error
    others = f" (and {len(refused) - 1} others)" if len(refused) > 1 else ""
    failure = StepError(f"world {number}{others}: {error}")
    failure.worlds = [number for number, _ in refused]
    raise failure from None


class Actions(BatchEngine):
    """Changes of one collider or sphere in many worlds, each by one call of the engine.

    ``worlds`` are the numbers of the worlds, or n truth values; all of them unless given. Other
    arrays have a row for each of these worlds, in their order, or one row for all. If a world
    refuses its row, the exception names it, and no world is changed.
    """

    def set_collider(
        self,
        id: int,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        angular_velocity: ArrayLike | None = None,
        motion: parts.Motion | Sequence[parts.Motion] | None = None,
        restitution: ArrayLike | None = None,
        friction: ArrayLike | None = None,
        rolling_friction: ArrayLike | None = None,
        spinning_friction: ArrayLike | None = None,
        tangential_restitution: ArrayLike | None = None,
        worlds: ArrayLike | None = None,
    ) -> None:
        """Changes a collider; what is not given stays. Spheres feel its velocities alone.

        Args:
            id: Of the collider, the same in all worlds: its number in the scene.
            position: Of its centre [m], (k, 3).
            rotation: Quaternions x, y, z, w, (k, 4), of any length but zero.
            velocity: Of its centre [m/s], (k, 3).
            angular_velocity: About its centre [rad/s], (k, 3).
            motion: A motion, or its parts, for all these worlds, about its present place. Its time
                is the clock of each world. ``()`` takes the motion away.
            restitution: In [0, 1], (k,).
            friction: >= 0, (k,); nan: that of the other body. So are the three that follow.
            rolling_friction: >= 0, (k,).
            spinning_friction: >= 0, (k,).
            tangential_restitution: In [0, 1], (k,).
            worlds: Which ones.

        Raises:
            UnknownError: If a world has no such collider.
            CaromError: For a value that is invalid, or velocities beside a motion.
        """
        given = {
            "position": position,
            "rotation": rotation,
            "velocity": velocity,
            "angular_velocity": angular_velocity,
            "restitution": restitution,
            "friction": friction,
            "rolling_friction": rolling_friction,
            "spinning_friction": spinning_friction,
            "tangential_restitution": tangential_restitution,
        }
        columns = [(name, values) for name, values in given.items() if values is not None]
        text = None if motion is None else _of_motion(motion)
        self._set_collider(id, self._numbers(worlds), columns, text)

    def set_next_pose(
        self,
        id: int,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        dt: float | None = None,
        worlds: ArrayLike | None = None,
    ) -> None:
        """Sets the velocities of a collider so that the next step takes it to a pose.

        It turns the shorter way, and spheres feel how it moves. It moves on until it gets other
        velocities.

        Args:
            id: Of the collider.
            position: Of its centre [m], (k, 3); where it is, unless given.
            rotation: Quaternions x, y, z, w, (k, 4); as it is, unless given.
            dt: Length of that step [s]; the frame time of the first world's scene unless given.
            worlds: Which ones.

        Raises:
            UnknownError: If a world has no such collider.
            CaromError: For a value that is invalid, or if a motion moves the collider.
        """
        self._set_next_pose(self._numbers(worlds), (id, position, rotation), dt)

    def collider_poses(self, id: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Positions [m], (n, 3), and rotations (x, y, z, w), (n, 4), of a collider. Copies.

        Raises:
            UnknownError: If a world has no such collider.
        """
        return self._collider_poses(id)

    def set_position(
        self, id: int, position: ArrayLike, *, worlds: ArrayLike | None = None
    ) -> None:
        """Sets the position of a sphere, by its id [m], (k, 3).

        Raises:
            UnknownError: If a world has no such sphere.
            CaromError: For a position that is not finite.
        """
        self._move_sphere("position", id, position, self._numbers(worlds))

    def set_velocity(
        self, id: int, velocity: ArrayLike, *, worlds: ArrayLike | None = None
    ) -> None:
        """Sets the velocity of a sphere, by its id [m/s], (k, 3).

        Raises:
            UnknownError: If a world has no such sphere.
            CaromError: For a velocity that is not finite.
        """
        self._move_sphere("velocity", id, velocity, self._numbers(worlds))

    def set_angular_velocity(
        self, id: int, angular_velocity: ArrayLike, *, worlds: ArrayLike | None = None
    ) -> None:
        """Sets the angular velocity of a sphere, by its id [rad/s], (k, 3).

        Raises:
            UnknownError: If a world has no such sphere.
            CaromError: For an angular velocity that is not finite.
        """
        self._move_sphere("angular_velocity", id, angular_velocity, self._numbers(worlds))

    def apply_impulse(
        self, id: int, impulse: ArrayLike, *, worlds: ArrayLike | None = None
    ) -> None:
        """Applies an impulse at the centre of a sphere, by its id [N s], (k, 3).

        Raises:
            UnknownError: If a world has no such sphere.
            CaromError: If a new velocity is not finite.
        """
        self._move_sphere("impulse", id, impulse, self._numbers(worlds))

    def step_to_pose(
        self,
        id: int,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        dt: float | None = None,
        worlds: ArrayLike | None = None,
        out: Observation | None = None,
        quantities: Sequence[str] = DEFAULT_QUANTITIES,
    ) -> None:
        """Takes a frame that takes a collider to a pose, and observes: all in one call.

        What `set_next_pose`, a step and `observe` do, to the bit, but world by world, which is
        faster.

        Args:
            id: Of the collider.
            position: Of its centre [m], (k, 3); where it is, unless given.
            rotation: Quaternions x, y, z, w, (k, 4); as it is, unless given.
            dt: Length of the frame [s]; that of the scene unless given.
            worlds: Which ones step. All are observed.
            out: Where observations go, as in `observe`; none are made unless given.
            quantities: What is observed.

        Raises:
            UnknownError: If a world has no such collider.
            CaromError: For a value that is invalid, or if a motion moves the collider. Worlds
                that refuse it stay as they were, the others have gone on.
            StepError: If worlds refuse the frame: see `carom.Batch.step`.
        """
        observed = None if out is None else (list(quantities), out)
        poses = (id, position, rotation)
        raise_refused(self._step(dt, 1, self._numbers(worlds), poses, observed))

    def observe(self, *quantities: str, out: Observation | None = None) -> Observation:
        """Writes quantities of all spheres into an array with a row for each world.

        A row has the first quantity of all spheres, one after the other, then the second, and so
        on; NaN where a world has no sphere.

        Args:
            quantities: Names of arrays, such as ``"positions"``; positions and velocities unless
                given.
            out: Where to, float32 or float64 of shape (n, columns), contiguous; a new array of
                float32 unless given.

        Returns:
            The array.

        Raises:
            CaromError: For another name, or an array that does not fit.
        """
        names = list(quantities or DEFAULT_QUANTITIES)
        if out is None:
            out = np.empty((len(self), self._observation_length(names)), np.float32)
        self._observe(names, out)
        return out

    def _numbers(self, worlds: ArrayLike | None) -> NDArray[np.int64] | None:
        if worlds is None:
            return None
        given = np.asarray(worlds)
        if given.dtype == bool:
            if given.shape != (len(self),):
                raise CaromError(
                    f"worlds: must be {len(self)} truth values, not of shape {given.shape}",
                    "worlds",
                )
            return np.flatnonzero(given).astype(np.int64, copy=False)
        if given.size and given.dtype.kind not in "iu":
            raise TypeError(f"worlds: must be whole numbers or truth values, not {given.dtype}")
        return given.reshape(-1).astype(np.int64, copy=False)


def _of_motion(motion: parts.Motion | Sequence[parts.Motion]) -> str:
    """A collider with this motion, as text."""
    moving = parts.Collider(parts.HalfSpace(), motion=motion)
    return f"colliders = [{toml_value(moving, 'motion')}]"
