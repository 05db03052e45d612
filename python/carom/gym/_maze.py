"""One ball in a maze, as an environment of Gymnasium."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from carom.gym._arguments import (
    METADATA,
    Episodes,
    MazeArguments,
    checked_mode,
    chosen_start,
    engine_seed,
)
from carom.gym._drawing import Drawing

if TYPE_CHECKING:
    from typing_extensions import Unpack


class MazeEnv(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """A ball on a floor between walls, which the agent tilts to make it roll.

    The ball starts at rest, the maze level. Touching a collectible takes it; touching the end wall
    wins, falling out of the maze loses, and both terminate the episode.

    - Action, float32 (2,): the slope that is wanted, downward towards +x (right) and towards +z (to
      the viewer), in parts of the steepest, each in [-1, 1]; more is cut off. The maze follows as
      fast as it may.
    - Observation, float32 (6 + c,), in the maze's own frame: x and z of the ball's centre [m]; its
      velocity along x and z [m/s]; the slope downward towards +x and +z [rad]; and for each of the
      c collectibles 1 if it is still there, else 0. What is beyond the bounds of the space is cut
      off: places off the maze, and speeds above what a ball gains from rest along the diagonal.
    - Info: ``collected``, how many collectibles are taken; ``is_success``, whether the end wall was
      touched.

    The weight of the ball is turned, and not the maze: forces that a turning maze would have on the
    ball are left out. What happens depends on the seed and the actions alone, to the bit.

    Args:
        render_mode: ``"rgb_array"``, or nothing.
        given: See `MazeArguments`.

    Raises:
        CaromError: For an argument that is invalid.
        SceneError: For a drawing that is no maze.
        TypeError: For an argument of the wrong kind, or that there is not.
    """

    metadata = METADATA

    def __init__(self, *, render_mode: str | None = None, **given: Unpack[MazeArguments]) -> None:
        episodes = Episodes(1, given)
        self._engine = episodes.engine
        self.observation_space = episodes.observation_space
        self.action_space = episodes.action_space
        self.metadata = episodes.metadata
        self.render_mode = checked_mode(render_mode)
        self._drawing = Drawing(self._engine)
        self._is_seeded = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts a new episode.

        Args:
            seed: Of the random places to start from; as it goes on, unless given.
            options: ``{"start": "maze"}`` or ``{"start": "random"}``: for this episode.

        Returns:
            The observation and the info.

        Raises:
            CaromError: For a start or a seed that is invalid.
        """
        super().reset(seed=seed)
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**63))
        self._is_seeded = True
        seeds = [None if seed is None else engine_seed(seed)]
        observations, _, _, _, states, *_ = self._engine.reset([True], seeds, chosen_start(options))
        return observations[0], _info(states)

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        """Takes a step.

        Args:
            action: The slopes that are wanted, (2,), in [-1, 1]; what is beyond is cut off.

        Returns:
            Observation, reward, whether the episode terminated, false (Gymnasium's own wrapper
            limits the time), and the info.

        Raises:
            CaromError: For an action that is not finite, or not of shape (2,).
        """
        actions = np.asarray(action)[np.newaxis]
        observations, rewards, terminated, _, states, *_ = self._engine.step(actions)
        return observations[0], float(rewards[0]), bool(terminated[0]), False, _info(states)

    def render(self) -> NDArray[np.uint8] | None:
        """The tilted maze with the ball and the collectibles that are left, (480, 640, 3), sRGB.

        Raises:
            GraphicsError: If nothing can be drawn here.
        """
        return None if self.render_mode is None else self._drawing.of(0)


def _info(states: tuple[NDArray[np.int64], NDArray[np.bool_]]) -> dict[str, Any]:
    collected, won = states
    return {"collected": int(collected[0]), "is_success": bool(won[0])}
