"""Teaches agents to reach the first collectible of the course's maze, and draws how they learn.

    pip install '.[train]'
    python python/examples/train_maze.py [--seeds 5] [--steps 256000] [--picture curve.png]

Proximal policy optimisation (J. Schulman et al., arXiv:1707.06347) as Stable-Baselines3 has it, on
64 mazes at once. An action holds for a tenth of a second; shaping shows the way along the floor.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib
import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.vec_env import VecEnv

from carom.gym import MazeVectorEnv

NUM_ENVS = 64
DISCOUNT = 0.99
GIVEN: dict[str, Any] = {
    "rule": "discrete",
    "frames_per_step": 5,
    "max_episode_steps": 200,
    "shaping": 0.2,
    "discount": DISCOUNT,
}
"""Episodes of 20 s. A metre of the way is worth a fifth of a collectible."""


class Mazes(VecEnv):
    """The mazes as Stable-Baselines3 wants them; observations are scaled to about [-1, 1]."""

    def __init__(self, num_envs: int) -> None:
        self.envs = MazeVectorEnv(num_envs, autoreset_mode=AutoresetMode.SAME_STEP, **GIVEN)
        space = self.envs.single_observation_space
        self.scale = np.float32(1.0) / space.high
        super().__init__(num_envs, space, self.envs.single_action_space)

    def reset(self) -> NDArray[np.float32]:
        """Starts all anew, from the seed if there is one."""
        seed = self._seeds[0]
        self._reset_seeds()
        return self.envs.reset(seed=seed)[0] * self.scale

    def step_async(self, actions: NDArray[np.float32]) -> None:
        """Takes the actions of the next step."""
        self.actions = actions

    def step_wait(self) -> tuple[Any, ...]:
        """Takes the step."""
        seen, rewards, terminated, truncated, infos = self.envs.step(self.actions)
        told: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        over = terminated | truncated
        for env in np.flatnonzero(over):
            told[env] = {
                "terminal_observation": infos["final_obs"][env] * self.scale,
                "TimeLimit.truncated": bool(truncated[env]),
                "collected": int(infos["final_info"]["collected"][env]),
            }
        return seen * self.scale, rewards.astype(np.float32), over, told

    def close(self) -> None:
        """Closes the mazes."""
        self.envs.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute, which all share."""
        return [getattr(self.envs, attr_name, None)] * self.num_envs

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Sets an attribute of all."""
        setattr(self.envs, attr_name, value)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> Any:
        """Single mazes have no methods."""
        raise AttributeError(method_name)

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """They are not."""
        return [False] * self.num_envs


class Point(NamedTuple):
    """Of a learning curve."""

    steps: int
    """Of all mazes together, so far."""
    seconds: float
    """Since the beginning."""
    reached: float
    """Part of the episodes that ended lately in which a collectible was reached."""
    collected: float
    """Collectibles in an episode, on average."""


class Curve(BaseCallback):
    """Notes after every rollout how the episodes in it went."""

    def __init__(self) -> None:
        super().__init__()
        self.points: list[Point] = []
        self._ended: list[int] = []
        self._began = time.perf_counter()

    def _on_step(self) -> bool:
        infos = self.locals["infos"]
        self._ended += [info["collected"] for info in infos if "collected" in info]
        return True

    def _on_rollout_end(self) -> None:
        if self._ended:
            ended = np.array(self._ended)
            seconds = time.perf_counter() - self._began
            reached, collected = float(np.mean(ended > 0)), float(np.mean(ended))
            self.points.append(Point(self.num_timesteps, seconds, reached, collected))
            self._ended.clear()


def train(seed: int, steps: int) -> list[Point]:
    """Teaches one agent; its learning curve."""
    mazes, curve = Mazes(NUM_ENVS), Curve()
    agent = PPO(
        "MlpPolicy",
        mazes,
        # A rollout is one episode of every maze.
        n_steps=GIVEN["max_episode_steps"],
        batch_size=3200,
        n_epochs=10,
        gamma=DISCOUNT,
        learning_rate=1e-3,
        seed=seed,
        device="cpu",
    )
    agent.learn(steps, callback=curve)
    return curve.points


def draw(curves: Sequence[list[Point]], path: Path) -> None:
    """Draws mean and spread of learning curves."""
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt

    figure, panes = plt.subplots(1, 2, figsize=(9, 3.4), sharey=True, layout="constrained")
    for pane, field, unit, label in [
        (panes[0], "steps", 1e3, "steps of the environment [thousands]"),
        (panes[1], "seconds", 1.0, "time [s]"),
    ]:
        ends = [getattr(curve[-1], field) for curve in curves]
        # An agent that was done before stays what it was.
        axis = np.linspace(0, max(ends), 200)
        rows = [
            np.interp(
                axis,
                [0, *(getattr(point, field) for point in curve)],
                [0, *(point.reached for point in curve)],
            )
            for curve in curves
        ]
        pane.fill_between(axis / unit, np.min(rows, 0), np.max(rows, 0), alpha=0.25, lw=0)
        pane.plot(axis / unit, np.mean(rows, 0), lw=2)
        pane.set(xlabel=label, xlim=(0, axis[-1] / unit), ylim=(0, 1.02))
        pane.grid(alpha=0.3)
        pane.spines[["top", "right"]].set_visible(False)
    panes[0].set_ylabel("episodes that reach a collectible")
    figure.suptitle(f"{len(curves)} agents: mean, least and most", fontsize=10)
    figure.savefig(path, dpi=150)


def main() -> None:
    """Teaches, prints, draws."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=5, help="how many agents")
    parser.add_argument("--steps", type=int, default=256_000, help="of the environment, for each")
    parser.add_argument("--picture", type=Path, default=Path("learning_curve.png"))
    parser.add_argument("--json", type=Path, help="write the curves there, too")
    arguments = parser.parse_args()
    # The networks are small: more threads wait for each other.
    torch.set_num_threads(1)
    curves = []
    for seed in range(arguments.seeds):
        curves.append(train(seed, arguments.steps))
        last = curves[-1][-1]
        half = next((point for point in curves[-1] if point.reached >= 0.5), None)
        when = f"half of them after {half.seconds:.0f} s" if half else "never half of them"
        print(
            f"agent {seed}: {last.reached:.0%} of the episodes reach a collectible, {when};"
            f" {last.collected:.2f} collectibles after {last.seconds:.0f} s",
            flush=True,
        )
    draw(curves, arguments.picture)
    if arguments.json:
        arguments.json.write_text(json.dumps([[point._asdict() for point in it] for it in curves]))


if __name__ == "__main__":
    main()
