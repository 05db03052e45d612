"""A ball on a plate that the agent tilts."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, Literal, TypedDict

import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

from carom._run.batch import Batch
from carom._scene.parts import Collider, Contact, Gravity, Rectangle, Simulation, Sphere
from carom._scene.scene import Scene
from carom.gym._arguments import check_names, chosen, in_range
from carom.gym._batch_env import FRAMES_PER_SECOND, BatchEnv, BatchVectorEnv, Floats

if TYPE_CHECKING:
    from typing_extensions import Unpack

RADIUS = 0.02
"""Of the ball [m]."""

GRAVITY = 9.81
"""[m/s²]"""

PLATE = 0
"""Id of the plate in every world."""

SUB_STEPS = 2
"""Of the rule ``contact`` in a frame: no fewer follow a ball of this radius in its fall."""


class PlateArguments(TypedDict, total=False):
    """Arguments of `PlateEnv` and `PlateVectorEnv`, by name; all may be left out.

    Attributes:
        rule: ``"contact"`` (default), or ``"exact"``, which takes ten times as long.
        frames_per_step: Frames of 1/60 s in a step, 1: for so long an action holds.
        size: Edge of the plate, 0.6 [m].
        friction: Coefficient of friction, 0.4.
        max_tilt_degrees: Largest tilt about each axis, 10 [°], at most 30.
        tilt_speed_degrees_per_second: Largest rate of tilt about each axis, 60 [°/s].
        start_range: Episodes start anywhere within this part of the plate, 0.5; 0: in the middle.
    """

    rule: Literal["contact", "exact"]
    frames_per_step: int
    size: float
    friction: float
    max_tilt_degrees: float
    tilt_speed_degrees_per_second: float
    start_range: float


DEFAULTS = PlateArguments(
    rule="contact",
    frames_per_step=1,
    size=0.6,
    friction=0.4,
    max_tilt_degrees=10.0,
    tilt_speed_degrees_per_second=60.0,
    start_range=0.5,
)


class PlateVectorEnv(BatchVectorEnv):
    """Many plates like that of `PlateEnv`, stepped together, as the worlds of a `carom.Batch`.

    Each is, to the bit, what a `PlateEnv` with its seed and actions is, however many there are and
    on however many threads.

    Args:
        num_envs: How many there are.
        max_episode_steps: Steps after which an episode is truncated; never, unless given.
        threads: How many threads step; as many as there are processors, unless given.
        autoreset_mode: What becomes of episodes that are over: `gymnasium.vector.AutoresetMode`.
        render_mode: ``"rgb_array"``, or nothing.
        given: See `PlateArguments`.

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
        **given: Unpack[PlateArguments],
    ) -> None:
        check_names(given, DEFAULTS, "a plate")
        arguments: PlateArguments = {**DEFAULTS, **given}
        self._half = 0.5 * in_range("size", arguments["size"], 4.0 * RADIUS, 1e3)
        degrees = in_range("max_tilt_degrees", arguments["max_tilt_degrees"], 0.0, 30.0)
        self._steepest = math.sin(math.radians(degrees))
        name = "tilt_speed_degrees_per_second"
        speed = in_range(name, arguments["tilt_speed_degrees_per_second"], 0.0, 1e4)
        self._rate = math.radians(speed)
        self._range = in_range("start_range", arguments["start_range"], 0.0, 1.0) * self._half
        self._frames = int(in_range("frames_per_step", arguments["frames_per_step"], 1, 1e6))
        chosen("rule", arguments["rule"], ("contact", "exact"))
        self._slopes = np.zeros((num_envs, 2))
        self._ups = np.ones(num_envs)
        self._rotations = np.tile((0.0, 0.0, 0.0, 1.0), (num_envs, 1))
        self._motion = np.zeros((num_envs, 6))
        super().__init__(
            Batch(_scene(arguments), num_envs, threads=threads),
            (self._observation_space(), spaces.Box(-1.0, 1.0, (2,), dtype=np.float32)),
            max_episode_steps=max_episode_steps,
            autoreset_mode=autoreset_mode,
            render_mode=render_mode,
            frames_per_second=max(1, round(FRAMES_PER_SECOND / self._frames)),
        )

    def _observation_space(self) -> spaces.Box:
        # The speed after the longest way at the steepest tilt about both axes, without friction.
        way, steepest = math.sqrt(8.0) * self._half, math.sqrt(2.0) * self._steepest
        fastest = math.sqrt(2.0 * GRAVITY * steepest * way) + self._rate * way
        high = np.repeat([2.0 * self._half, fastest, self._steepest], 2).astype(np.float32)
        return spaces.Box(-high, high, dtype=np.float32)

    def _begin(self, mask: NDArray[np.bool_]) -> None:
        drawn = self._numbers.uniform(mask, 2)
        places = np.full((len(drawn), 3), RADIUS)
        places[:, ::2] = self._range * (2.0 * drawn - 1.0)
        self.batch.set_position(0, places, worlds=mask)
        self._slopes[mask] = 0.0
        self._motion[mask, :3], self._motion[mask, 3:] = places, 0.0

    def _act(self, actions: NDArray[np.float64], mask: NDArray[np.bool_] | None) -> None:
        worlds = None if mask is None else np.flatnonzero(mask)
        change = (self._rate / FRAMES_PER_SECOND) * actions
        for _ in range(self._frames):
            self._slopes += change
            np.clip(self._slopes, -self._steepest, self._steepest, out=self._slopes)
            self._rotate()
            rows = self._rotations if worlds is None else self._rotations[worlds]
            self.batch.step_to_pose(PLATE, rotation=rows, worlds=worlds, out=self._motion)

    def _rotate(self) -> None:
        """Rotates the plates by the shortest way from level to the present slopes."""
        u, v = self._slopes.T
        np.sqrt(1.0 - u * u - v * v, out=self._ups)
        # Half of the angle: (sin, 1 + cos), normalized.
        norm = np.sqrt(2.0 + 2.0 * self._ups)
        np.divide(v, norm, out=self._rotations[:, 0])
        np.divide(-u, norm, out=self._rotations[:, 2])
        np.divide(1.0 + self._ups, norm, out=self._rotations[:, 3])

    def _judged(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        places, slopes = self._motion[:, 0:3:2], self._slopes
        # Along the sides of the plate, turned back to level.
        lift = np.add.reduce(slopes * places, axis=1) / (1.0 + self._ups) + self._motion[:, 1]
        places = places - slopes * lift[:, np.newaxis]
        fell: NDArray[np.bool_] = np.abs(places).max(axis=1) > self._half
        distances = np.sqrt(np.add.reduce(places * places, axis=1)) / self._half
        return np.where(fell, 0.0, np.maximum(1.0 - distances, 0.0)), fell

    def _see(self, seen: Floats) -> None:
        seen[:, 0:2], seen[:, 2:4] = self._motion[:, 0:3:2], self._motion[:, 3:6:2]
        seen[:, 4:6] = self._slopes


class PlateEnv(BatchEnv):
    """A ball on a square plate, which the agent tilts to keep it in the middle.

    The plate tilts about its middle, and the ball feels how it moves. An episode starts with the
    ball at rest on the level plate, and ends when its centre is past the rim.

    - Action, float32 (2,): how fast the slope changes, downward towards +x (right) and towards +z
      (to the viewer), in parts of the largest rate, each in [-1, 1]; more is cut off. The slope is
      the sine of the tilt.
    - Observation, float32 (6,): x and z of the ball's centre [m], its velocity along x and z [m/s],
      and the slopes towards +x and +z. What is beyond the bounds of the space is cut off.
    - Reward: 1 in the middle of the plate, less in proportion to the distance, 0 from half an edge
      on and for a fall.

    A step is a frame of 1/60 s unless ``frames_per_step`` says otherwise. What happens depends on
    the seed and the actions alone, to the bit.

    Args:
        render_mode: ``"rgb_array"``, or nothing.
        given: See `PlateArguments`.

    Raises:
        CaromError: For an argument that is invalid.
        TypeError: For an argument of the wrong kind, or that there is not.
    """

    _of_many = PlateVectorEnv

    def __init__(self, *, render_mode: str | None = None, **given: Unpack[PlateArguments]) -> None:
        super().__init__(render_mode=render_mode, **given)


def _scene(arguments: PlateArguments) -> Scene:
    size = arguments["size"]
    friction = in_range("friction", arguments["friction"], 0.0, 1e3)
    shape: Any = Rectangle(size, size)
    return Scene(
        name="plate",
        simulation=Simulation(
            rule=arguments["rule"],
            frame_time=1.0 / FRAMES_PER_SECOND,
            contact=Contact(sub_steps=SUB_STEPS),
        ),
        forces=[Gravity((0.0, -GRAVITY, 0.0))],
        colliders=[Collider(shape, restitution=0.3, friction=friction)],
        spheres=[Sphere(position=(0.0, RADIUS, 0.0), radius=RADIUS, mass=0.05)],
    )
