"""A billiard table on which the agent strikes the cue ball."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypedDict

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from carom._run.batch import Batch
from carom._scene.library import load
from carom.gym._arguments import check_names, chosen, in_range
from carom.gym._batch_env import FRAMES_PER_SECOND, BatchEnv, BatchVectorEnv, Floats

if TYPE_CHECKING:
    from typing_extensions import Unpack

BALLS = 16
"""On the table; the first is the cue ball."""

RADIUS = 0.028575
"""Of a ball [m]."""

EDGES = (1.27, 0.635)
"""Half the lengths of the table between its cushions, along x and z [m]."""

MOVED = 1e-3
"""A ball was hit if it is farther than this from its place at the start of the episode [m]."""

CELLS = (8, 4)
"""Columns and rows of the grid over the table; each ball starts in a cell of its own."""

CHUNK = 15
"""Frames between two looks whether all balls rest."""

QUANTITIES = ("positions", "velocities", "angular_velocities")
"""What is read of each world."""

LONGEST = 3600
"""Frames of a shot at most: a minute."""


class BilliardsArguments(TypedDict, total=False):
    """Arguments of `BilliardsEnv` and `BilliardsVectorEnv`, by name; all may be left out.

    Attributes:
        rule: ``"exact"`` (default), or ``"contact"``.
        frames_per_step: Frames of 1/60 s in a step; 0, the default: as many as a whole shot takes,
            until all balls rest.
        start: ``"random"`` (default): balls anywhere on the table, from the seed; or ``"rack"``.
        max_speed: Of the cue ball after a stroke, 4 [m/s]. Faster balls hop off cushions, and over
            them.
        ball_reward: For each ball that is hit for the first time in the episode, 1.
        stroke_reward: For each stroke, -0.1.
        lost_reward: For a ball that falls off the table, -1.
    """

    rule: Literal["exact", "contact"]
    frames_per_step: int
    start: Literal["random", "rack"]
    max_speed: float
    ball_reward: float
    stroke_reward: float
    lost_reward: float


DEFAULTS = BilliardsArguments(
    rule="exact",
    frames_per_step=0,
    start="random",
    max_speed=4.0,
    ball_reward=1.0,
    stroke_reward=-0.1,
    lost_reward=-1.0,
)


class BilliardsVectorEnv(BatchVectorEnv):
    """Many tables like that of `BilliardsEnv`, stepped together, as the worlds of a `carom.Batch`.

    Each is, to the bit, what a `BilliardsEnv` with its seed and actions is, however many there are
    and on however many threads.

    Args:
        num_envs: How many there are.
        max_episode_steps: Steps after which an episode is truncated; never, unless given.
        threads: How many threads step; as many as there are processors, unless given.
        autoreset_mode: What becomes of episodes that are over: `gymnasium.vector.AutoresetMode`.
        render_mode: ``"rgb_array"``, or nothing.
        given: See `BilliardsArguments`.

    Raises:
        CaromError: For an argument that is invalid.
        TypeError: For an argument of the wrong kind, or that there is not.
    """

    def __init__(
        self,
        num_envs: int = 1,
        *,
        max_episode_steps: int | None = None,
        threads: int | None = None,
        autoreset_mode: AutoresetMode | str = AutoresetMode.NEXT_STEP,
        render_mode: str | None = None,
        **given: Unpack[BilliardsArguments],
    ) -> None:
        check_names(given, DEFAULTS, "billiards")
        arguments: BilliardsArguments = {**DEFAULTS, **given}
        self._frames = int(in_range("frames_per_step", arguments["frames_per_step"], 0, 1e6))
        self._fastest = in_range("max_speed", arguments["max_speed"], 0.0, 100.0)
        self._ball_reward = in_range("ball_reward", arguments["ball_reward"], -1e9, 1e9)
        self._stroke_reward = in_range("stroke_reward", arguments["stroke_reward"], -1e9, 1e9)
        self._lost_reward = in_range("lost_reward", arguments["lost_reward"], -1e9, 1e9)
        self._start = chosen("start", arguments["start"], ("random", "rack"))
        rule = chosen("rule", arguments["rule"], ("exact", "contact"))
        still = {"spheres.0.velocity": (0, 0, 0), "spheres.0.angular_velocity": (0, 0, 0)}
        changes = {**still, "simulation.rule": rule}
        batch = Batch(load("billiards").with_changes(changes), num_envs, threads=threads)
        self._states = np.zeros((num_envs, 9 * BALLS))
        self._places = np.zeros((num_envs, BALLS, 2))
        self._hit = np.zeros((num_envs, BALLS - 1), np.bool_)
        self._rests = np.ones(num_envs, np.bool_)
        self._rewards = np.zeros(num_envs)
        super().__init__(
            batch,
            (self._observation_space(), spaces.Box(-1.0, 1.0, (2,), dtype=np.float32)),
            max_episode_steps=max_episode_steps,
            autoreset_mode=autoreset_mode,
            render_mode=render_mode,
            frames_per_second=max(1, round(FRAMES_PER_SECOND / max(self._frames, 1))),
        )

    def _observation_space(self) -> spaces.Box:
        places, speeds = np.tile(EDGES, BALLS), np.full(2 * BALLS, 2.0 * self._fastest)
        high = np.concatenate([places, speeds, np.ones(BALLS)]).astype(np.float32)
        low = np.concatenate([-high[: 4 * BALLS], np.zeros(BALLS, np.float32)])
        return spaces.Box(low, high, dtype=np.float32)

    def _begin(self, mask: NDArray[np.bool_]) -> None:
        if self._start == "random":
            places = _random_places(self._numbers.uniform(mask, CELLS[0] * CELLS[1] + 2 * BALLS))
            rows = np.full((len(places), 3), RADIUS)
            for ball in range(BALLS):
                rows[:, ::2] = places[:, ball]
                self.batch.set_position(ball, rows, worlds=mask)
        self.batch.observe(*QUANTITIES, out=self._states)
        self._look()
        self._places[mask] = self._now()[mask]
        self._hit[mask] = False
        self._rests[mask] = True

    def _act(self, actions: NDArray[np.float64], mask: NDArray[np.bool_] | None) -> None:
        if mask is None:
            mask = np.ones(self.num_envs, np.bool_)
        struck = mask & self._rests
        speed = np.sqrt(np.sum(actions * actions, axis=1, keepdims=True))
        velocities = np.zeros((self.num_envs, 3))
        velocities[:, ::2] = self._fastest * actions / np.maximum(speed, 1.0)
        if struck.any():
            self.batch.set_velocity(0, velocities[struck], worlds=struck)
        if self._frames > 0:
            self._take_frames(self._frames, mask)
        else:
            self._take_shots(struck | (mask & ~self._rests))
        hit = self._hit | self._are_moved()
        first = np.sum(hit & ~self._hit, axis=1)
        rewards = self._ball_reward * first + self._stroke_reward * struck
        self._rewards = rewards + self._lost_reward * (self._are_lost() & mask)
        self._hit = hit

    def _take_shots(self, moving: NDArray[np.bool_]) -> None:
        """Takes frames in these worlds until the balls of each rest, or one is lost."""
        for _ in range(LONGEST // CHUNK):
            self._take_frames(CHUNK, moving)
            moving = moving & ~self._rests & ~self._are_lost()
            if not moving.any():
                return

    def _take_frames(self, frames: int, mask: NDArray[np.bool_]) -> None:
        worlds = None if mask.all() else mask
        self.batch.step(frames=frames, worlds=worlds, out=self._states, quantities=QUANTITIES)
        self._look()

    def _look(self) -> None:
        """Looks which worlds rest."""
        np.logical_not(self._states[:, 3 * BALLS :].any(axis=1), out=self._rests)

    def _are_lost(self) -> NDArray[np.bool_]:
        """Whether a ball has fallen off each table."""
        heights = self._states[:, 1 : 3 * BALLS : 3]
        lost: NDArray[np.bool_] = np.any(heights < 0.0, axis=1)
        return lost

    def _now(self) -> NDArray[np.float64]:
        """Places of the balls, along x and z."""
        return self._states[:, : 3 * BALLS].reshape(-1, BALLS, 3)[:, :, ::2]

    def _are_moved(self) -> NDArray[np.bool_]:
        """Which of the object balls are elsewhere than at the start."""
        moved: NDArray[np.bool_] = np.abs(self._now() - self._places).max(axis=2) > MOVED
        return moved[:, 1:]

    def _judged(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        return self._rewards.copy(), np.all(self._hit, axis=1) | self._are_lost()

    def _see(self, seen: Floats) -> None:
        count, ends = self.num_envs, (3 * BALLS, 6 * BALLS)
        velocities = self._states[:, ends[0] : ends[1]].reshape(count, BALLS, 3)[:, :, ::2]
        seen[:, : 2 * BALLS] = self._now().reshape(count, -1)
        seen[:, 2 * BALLS : 4 * BALLS] = velocities.reshape(count, -1)
        seen[:, 4 * BALLS : -1], seen[:, -1] = self._hit, self._rests


class BilliardsEnv(BatchEnv):
    """A table without pockets: the agent strikes the cue ball to hit the fifteen others.

    Balls slide, roll and spin on the cloth, and come to rest. An episode terminates when all object
    balls have been hit, by the cue ball or by others, and when a ball falls off the table.

    - Action, float32 (2,): direction and speed of the cue ball after the stroke, as its velocity
      along x and z in parts of the largest; a longer one than 1 is shortened.
    - Observation, float32 (80,): x and z of all balls [m], the cue ball first; their velocities
      along x and z [m/s]; for each object ball 1 if it was hit, else 0; 1 if all balls rest. What
      is beyond the bounds of the space is cut off.
    - Reward: for each object ball that is hit for the first time, for the stroke, and for a ball
      that is lost.

    A step is a whole shot, until all balls rest. With ``frames_per_step`` it is that many frames of
    1/60 s, and a stroke counts in a step that begins with all balls at rest. What happens depends
    on the seed and the actions alone, to the bit.

    Args:
        render_mode: ``"rgb_array"``, or nothing.
        given: See `BilliardsArguments`.

    Raises:
        CaromError: For an argument that is invalid.
        TypeError: For an argument of the wrong kind, or that there is not.
    """

    _of_many = BilliardsVectorEnv

    def __init__(
        self, *, render_mode: str | None = None, **given: Unpack[BilliardsArguments]
    ) -> None:
        super().__init__(render_mode=render_mode, **given)


def _random_places(drawn: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places along x and z (k, 16, 2), each in a cell of its own, of numbers in [0, 1)."""
    columns, rows = CELLS
    taken = np.argsort(drawn[:, : columns * rows], axis=1, kind="stable")[:, :BALLS]
    offsets = drawn[:, columns * rows :].reshape(-1, BALLS, 2)
    sizes = 2.0 * np.array(EDGES) / CELLS
    corners = np.stack([taken % columns, taken // columns], axis=2) * sizes - EDGES
    # Two balls in neighbouring cells never touch.
    margin = 1.01 * RADIUS
    return corners + margin + offsets * (sizes - 2.0 * margin)
