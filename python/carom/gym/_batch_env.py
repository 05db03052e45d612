"""Worlds of a batch as environments of Gymnasium."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from carom._pictures.picture import Renderer
from carom._run.batch import Batch
from carom.errors import CaromError
from carom.gym._arguments import METADATA, checked_mask, checked_mode, seeds_of
from carom.gym._random import Numbers

Floats = NDArray[np.float32]
"""Actions and observations."""

SIZE = (640, 480)
"""Width and height of pictures [pixels]."""

FRAMES_PER_SECOND = 60
"""A frame is 1/60 s."""

if TYPE_CHECKING:
    _Env = gymnasium.Env[Floats, Floats]
    _VectorEnv = VectorEnv[Floats, Floats, NDArray[Any]]
else:
    _Env, _VectorEnv = gymnasium.Env, VectorEnv


class BatchVectorEnv(_VectorEnv):
    """An episode in each world of a batch: seeds, ends of episodes, new ones.

    A kind of environment says by `_begin`, `_act`, `_see` and `_judged` what happens in one.
    """

    def __init__(
        self,
        batch: Batch,
        spaces_of_one: tuple[spaces.Box, spaces.Box],
        *,
        max_episode_steps: int | None,
        autoreset_mode: AutoresetMode | str,
        render_mode: str | None,
        frames_per_second: int,
    ) -> None:
        if max_episode_steps is not None and max_episode_steps < 1:
            problem = f"max_episode_steps: must be at least 1, not {max_episode_steps}"
            raise CaromError(problem, "max_episode_steps")
        self.batch = batch
        self.num_envs = len(batch)
        self.single_observation_space, self.single_action_space = spaces_of_one
        self._bounds = spaces_of_one[0].low, spaces_of_one[0].high
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self.render_mode = checked_mode(render_mode)
        self._mode = AutoresetMode(autoreset_mode)
        self._restarts = self._mode == AutoresetMode.NEXT_STEP
        self.metadata = {
            **METADATA,
            "render_fps": frames_per_second,
            "autoreset_mode": self._mode,
        }
        self._most = max_episode_steps
        self._steps = np.zeros(self.num_envs, np.int64)
        self._over = np.zeros(self.num_envs, np.bool_)
        self._numbers = Numbers(self.num_envs)
        self._is_seeded = False
        self._renderer: Renderer | None = None

    def _begin(self, mask: NDArray[np.bool_]) -> None:
        """Starts episodes in the marked worlds."""
        raise NotImplementedError

    def _act(self, actions: NDArray[np.float64], mask: NDArray[np.bool_] | None) -> None:
        """Takes a step in the marked worlds, or in all."""
        raise NotImplementedError

    def _see(self, seen: Floats) -> None:
        """Writes observations of all worlds."""
        raise NotImplementedError

    def _judged(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """Rewards of the step, and whether it terminated an episode."""
        raise NotImplementedError

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts new episodes.

        Args:
            seed: Of the random starts: one for each environment, or s for s, s + 1, s + 2, ...; as
                they go on, unless given.
            options: ``"reset_mask"``, bool (num_envs,): which environments start again.

        Returns:
            Observations (num_envs, ...), and infos.

        Raises:
            CaromError: For a seed or a mask that is invalid.
        """
        super().reset(seed=seed if isinstance(seed, int) else None)
        for name in options or {}:
            if name != "reset_mask":
                raise CaromError(f"options: there is no {name}, but reset_mask", "options")
        mask = checked_mask((options or {}).get("reset_mask"), self.num_envs)
        self._numbers.seed(self._seeds(seed))
        self._is_seeded = True
        self._begin_episodes(mask)
        return self._observations(), {}

    def step(
        self, actions: Floats
    ) -> tuple[Floats, NDArray[np.float64], NDArray[np.bool_], NDArray[np.bool_], dict[str, Any]]:
        """Takes a step of every environment.

        Args:
            actions: (num_envs, ...), in [-1, 1]; more is cut off.

        Returns:
            Observations (num_envs, ...); rewards, whether episodes terminated, whether they were
            truncated, (num_envs,) each; infos: where the step that ends an episode starts a new
            one, ``final_obs`` and ``final_info`` of the one that ended.

        Raises:
            CaromError: For actions that are not finite, or of another shape.
        """
        wanted = self._checked(actions)
        began = self._over if self._restarts and self._over.any() else None
        self._act(wanted, None if began is None else ~began)
        rewards, terminated = self._judged()
        self._steps += 1
        truncated = self._are_late()
        if began is not None:
            rewards[began] = 0.0
            terminated[began] = truncated[began] = False
            self._begin_episodes(began.copy())
        self._over = terminated | truncated
        infos: dict[str, Any] = {}
        observations = self._observations()
        if self._mode == AutoresetMode.SAME_STEP and self._over.any():
            infos = self._final(observations)
            self._begin_episodes(self._over.copy())
            observations = self._observations()
        return observations, rewards, terminated, truncated, infos

    def _are_late(self) -> NDArray[np.bool_]:
        """Which episodes have taken all their steps."""
        if self._most is None:
            return np.zeros(self.num_envs, np.bool_)
        late: NDArray[np.bool_] = self._steps >= self._most
        return late

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """A picture of each environment, (480, 640, 3), sRGB.

        Raises:
            GraphicsError: If nothing can be drawn here.
        """
        if self.render_mode is None:
            return None
        return tuple(self._picture(world) for world in range(self.num_envs))

    def _picture(self, number: int) -> NDArray[np.uint8]:
        world = self.batch.world(number)
        if self._renderer is None:
            self._renderer = Renderer(world, size=SIZE)
        return self._renderer.render(world)

    def _begin_episodes(self, mask: NDArray[np.bool_]) -> None:
        self.batch.reset(mask)
        self._begin(mask)
        self._steps[mask] = 0
        self._over[mask] = False

    def _observations(self) -> Floats:
        low, high = self._bounds
        seen = np.empty((self.num_envs, len(low)), np.float32)
        self._see(seen)
        return np.clip(seen, low, high, out=seen)

    def _checked(self, actions: Floats) -> NDArray[np.float64]:
        given = np.asarray(actions)
        shape = self.action_space.shape
        if given.dtype.kind not in "fiu" or given.shape != shape:
            problem = f"must be numbers of shape {shape}, not {given.dtype} of {given.shape}"
            raise CaromError(f"actions: {problem}", "actions")
        wanted: NDArray[np.float64] = given.astype(np.float64)
        # No sum of float32 overflows.
        if not math.isfinite(wanted.sum()) and not np.isfinite(wanted).all():
            raise CaromError("actions: must be finite", "actions")
        return np.clip(wanted, -1.0, 1.0, out=wanted)

    def _final(self, observations: Floats) -> dict[str, Any]:
        """What was last of episodes that ended, where Gymnasium looks for it."""
        mask = self._over.copy()
        final = np.full(self.num_envs, None, dtype=object)
        for number in np.flatnonzero(mask):
            final[number] = observations[number]
        return {
            "final_obs": final,
            "_final_obs": mask,
            "final_info": {},
            "_final_info": mask.copy(),
        }

    def _seeds(self, seed: int | Sequence[int | None] | None) -> list[int | None]:
        drawn = None if self._is_seeded else lambda: int(self.np_random.integers(2**63))
        return seeds_of(seed, self.num_envs, drawn)


class BatchEnv(_Env):
    """One environment: a vector of one, whose episodes do not start by themselves."""

    metadata = METADATA  # Of the class, for `gymnasium.make`.

    _of_many: ClassVar[Callable[..., BatchVectorEnv]]

    def __init__(self, *, render_mode: str | None = None, **given: Any) -> None:
        many = type(self)._of_many(
            1, threads=1, autoreset_mode=AutoresetMode.DISABLED, render_mode=render_mode, **given
        )
        self._many = many
        self.observation_space = many.single_observation_space
        self.action_space = many.single_action_space
        self.metadata = {name: many.metadata[name] for name in ("render_modes", "render_fps")}
        self.render_mode = many.render_mode
        self._is_seeded = False

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Starts a new episode.

        Args:
            seed: Of the random starts; as they go on, unless given.
            options: There are none.

        Returns:
            The observation, and an empty info.

        Raises:
            CaromError: For an option, or a seed that is invalid.
        """
        super().reset(seed=seed)
        if seed is None and not self._is_seeded:
            seed = int(self.np_random.integers(2**63))
        self._is_seeded = True
        observations, _ = self._many.reset(seed=seed, options=options)
        return observations[0], {}

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Takes a step.

        Args:
            action: In [-1, 1]; what is beyond is cut off.

        Returns:
            Observation, reward, whether the episode terminated, false (Gymnasium's own wrapper
            limits the time), and an empty info.

        Raises:
            CaromError: For an action that is not finite, or of another shape.
        """
        actions = np.asarray(action)[np.newaxis]
        observations, rewards, terminated, _, _ = self._many.step(actions)
        return observations[0], float(rewards[0]), bool(terminated[0]), False, {}

    def render(self) -> NDArray[np.uint8] | None:
        """A picture, (480, 640, 3), sRGB.

        Raises:
            GraphicsError: If nothing can be drawn here.
        """
        pictures = self._many.render()
        return None if pictures is None else pictures[0]
