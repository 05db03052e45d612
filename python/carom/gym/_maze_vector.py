"""Many balls in one maze, as a vector environment of Gymnasium."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from carom.gym._arguments import (
    METADATA,
    Episodes,
    MazeArguments,
    checked_mask,
    checked_mode,
    chosen_start,
    seeds_of,
)
from carom.gym._drawing import Drawing

if TYPE_CHECKING:
    from typing_extensions import Unpack

    _Base = VectorEnv[NDArray[np.float32], NDArray[np.float32], NDArray[Any]]
else:
    _Base = VectorEnv


class MazeVectorEnv(_Base):
    """Many mazes like that of `MazeEnv`, stepped together.

    Each is, to the bit, what a `MazeEnv` with its seed and actions is, however many there are and
    on however many threads. A step is one call of the engine, which lets other threads of Python
    run; the arrays it returns are new ones, and stay as they are.

    Args:
        num_envs: How many there are.
        max_episode_steps: Steps after which an episode is truncated; never, unless given.
        threads: How many threads step; as many as there are processors, unless given.
        autoreset_mode: What becomes of episodes that are over: `gymnasium.vector.AutoresetMode`.
        render_mode: ``"rgb_array"``, or nothing.
        given: See `MazeArguments`.

    Raises:
        CaromError: For an argument that is invalid.
        SceneError: For a drawing that is no maze.
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
        **given: Unpack[MazeArguments],
    ) -> None:
        mode = AutoresetMode(autoreset_mode)
        episodes = Episodes(
            num_envs,
            given,
            max_episode_steps=max_episode_steps,
            threads=threads,
            autoreset_mode=mode.value,
        )
        self.num_envs = num_envs
        self._engine = episodes.engine
        self.single_observation_space = episodes.observation_space
        self.single_action_space = episodes.action_space
        self.observation_space = batch_space(episodes.observation_space, num_envs)
        self.action_space = batch_space(episodes.action_space, num_envs)
        self.metadata = {**METADATA, **episodes.metadata, "autoreset_mode": mode}
        self.render_mode = checked_mode(render_mode)
        self._drawing = Drawing(self._engine)
        self._is_seeded = False

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        """Starts new episodes.

        Args:
            seed: Of the random places to start from: one for each environment, or s for s, s + 1,
                s + 2, ...; as they go on, unless given.
            options: ``"start"``: ``"maze"`` or ``"random"``, for these episodes; ``"reset_mask"``,
                bool (num_envs,): which environments start again; the others go on.

        Returns:
            Observations (num_envs, 6 + c), and infos.

        Raises:
            CaromError: For a start, a seed or a mask that is invalid.
        """
        super().reset(seed=seed if isinstance(seed, int) else None)
        mask = checked_mask((options or {}).get("reset_mask"), self.num_envs)
        seeds = self._seeds(seed)
        self._is_seeded = True
        start = chosen_start(options)
        observations, _, _, _, states, *_ = self._engine.reset(mask.tolist(), seeds, start)
        return observations, _infos(states, mask)

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[
        NDArray[np.float32],
        NDArray[np.float64],
        NDArray[np.bool_],
        NDArray[np.bool_],
        dict[str, Any],
    ]:
        """Takes a step of every environment.

        Args:
            actions: The slopes that are wanted, (num_envs, 2), in [-1, 1]; more is cut off.

        Returns:
            Observations (num_envs, 6 + c); rewards, whether episodes terminated, whether they were
            truncated, (num_envs,) each; infos: those of `MazeEnv` as arrays, and where the step
            that ends an episode starts a new one, ``final_obs`` and ``final_info`` of the one that
            ended.

        Raises:
            CaromError: For actions that are not finite, or of another shape.
        """
        observations, rewards, terminated, truncated, states, ended, seen_last, states_last = (
            self._engine.step(actions)
        )
        infos = _infos(states, np.ones(self.num_envs, np.bool_))
        if len(ended):
            self._add_final(infos, ended, seen_last, states_last)
        return observations, rewards, terminated, truncated, infos

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture of each environment: the tilted maze, (480, 640, 3), sRGB.

        Raises:
            GraphicsError: If nothing can be drawn here.
        """
        if self.render_mode is None:
            return None
        return tuple(self._drawing.of(ball) for ball in range(self.num_envs))

    def _add_final(
        self,
        infos: dict[str, Any],
        ended: NDArray[np.int64],
        observations: NDArray[np.float32],
        states: tuple[NDArray[np.int64], NDArray[np.bool_]],
    ) -> None:
        """Adds what was last of episodes that ended, where Gymnasium looks for it."""
        mask = np.zeros(self.num_envs, np.bool_)
        mask[ended] = True
        final_obs = np.full(self.num_envs, None, dtype=object)
        for ball, observation in zip(ended, observations, strict=True):
            final_obs[ball] = observation
        spread = tuple(np.zeros(self.num_envs, state.dtype) for state in states)
        for place, state in zip(spread, states, strict=True):
            place[ended] = state
        infos |= {"final_obs": final_obs, "_final_obs": mask}
        infos |= {"final_info": _infos((spread[0], spread[1]), mask), "_final_info": mask.copy()}

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        drawn = None if self._is_seeded else lambda: int(self.np_random.integers(2**63))
        return seeds_of(seed, self.num_envs, drawn)


def _infos(states: tuple[NDArray[Any], NDArray[Any]], mask: NDArray[np.bool_]) -> dict[str, Any]:
    """Infos as Gymnasium wants them: each with a mask of the environments that it is of."""
    collected, won = states
    return {
        "collected": collected,
        "_collected": mask,
        "is_success": won,
        "_is_success": mask.copy(),
    }
