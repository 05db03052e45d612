"""Proximal policy optimisation in one file: an agent learns to reach a collectible of the maze.

    pip install '.[gym]' torch
    python python/examples/ppo_maze.py [--envs 64] [--steps 256000] [--seed 1]

In the manner of CleanRL (S. Huang et al., JMLR 23(274), 2022): every step of the method (J.
Schulman et al., arXiv:1707.06347) stands here, to be read and changed, and nothing but PyTorch is
between it and the environment. The mazes step together in one call of the engine.
"""

from __future__ import annotations

import argparse
import math
import time
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import torch
from gymnasium.vector import AutoresetMode
from torch import nn
from torch.distributions import Normal

from carom.gym import MazeVectorEnv


@dataclass(frozen=True)
class Choices:
    """The settings of the method."""

    envs: int
    """Mazes at once."""
    steps: int
    """Of all mazes together."""
    seed: int
    rollout: int = 200
    """Steps of each maze between two updates: an episode, 20 s."""
    epochs: int = 10
    minibatches: int = 4
    learning_rate: float = 1e-3
    discount: float = 0.99
    smoothing: float = 0.95
    """Of the advantages: lambda of generalised advantage estimation (arXiv:1506.02438)."""
    clip: float = 0.2
    value_weight: float = 0.5
    max_gradient: float = 0.5


class Agent(nn.Module):
    """A policy, which is normal about a mean with a spread of its own, and the value of states."""

    def __init__(self, seen: int, actions: int) -> None:
        super().__init__()
        self.mean = layers(seen, actions, last=0.01)
        self.value = layers(seen, 1, last=1.0)
        self.log_spread = nn.Parameter(torch.zeros(actions))

    def policy(self, seen: torch.Tensor) -> Normal:
        """How actions are drawn in these states."""
        return Normal(self.mean(seen), self.log_spread.exp())


def layers(inputs: int, outputs: int, last: float) -> nn.Sequential:
    """Two hidden layers, orthogonal at first."""
    sizes = [(inputs, 64, math.sqrt(2)), (64, 64, math.sqrt(2)), (64, outputs, last)]
    parts: list[nn.Module] = []
    for width, height, gain in sizes:
        layer = nn.Linear(width, height)
        nn.init.orthogonal_(layer.weight, gain)
        nn.init.zeros_(layer.bias)
        parts += [layer, nn.Tanh()]
    return nn.Sequential(*parts[:-1])


def train(choices: Choices) -> Agent:
    """Teaches an agent, and prints how it goes."""
    torch.manual_seed(choices.seed)
    # The networks are small: more threads wait for each other.
    torch.set_num_threads(1)
    mazes = MazeVectorEnv(
        choices.envs,
        autoreset_mode=AutoresetMode.SAME_STEP,
        rule="discrete",
        frames_per_step=5,
        max_episode_steps=choices.rollout,
        shaping=0.2,
        discount=choices.discount,
    )
    scale = np.float32(1.0) / mazes.single_observation_space.high
    low, high = (
        torch.from_numpy(it)
        for it in (mazes.single_action_space.low, mazes.single_action_space.high)
    )
    agent = Agent(len(scale), len(low))
    optimiser = torch.optim.Adam(agent.parameters(), choices.learning_rate, eps=1e-5)

    shape = (choices.rollout, choices.envs)
    states = torch.zeros((*shape, len(scale)))
    actions = torch.zeros((*shape, len(low)))
    likelihoods, rewards, values = (torch.zeros(shape) for _ in range(3))
    ends = torch.zeros(shape)

    state = torch.from_numpy(mazes.reset(seed=choices.seed)[0] * scale)
    began = time.perf_counter()
    per_update = choices.rollout * choices.envs
    for update in range(1, choices.steps // per_update + 1):
        collected: list[int] = []
        for step in range(choices.rollout):
            states[step] = state
            with torch.no_grad():
                policy = agent.policy(state)
                actions[step] = policy.sample()
                likelihoods[step] = policy.log_prob(actions[step]).sum(-1)
                values[step] = agent.value(state).squeeze(-1)
            tilt = torch.clamp(actions[step], low, high).numpy()
            seen, reward, terminated, truncated, infos = mazes.step(tilt)
            over = terminated | truncated
            if over.any():
                collected += infos["final_info"]["collected"][over].tolist()
            if truncated.any():
                # What was cut short would have gone on: the value of its last state counts.
                with torch.no_grad():
                    last = torch.from_numpy(np.stack(infos["final_obs"][truncated]) * scale)
                    value = agent.value(last).squeeze(-1).numpy()
                reward[truncated] += choices.discount * value
            rewards[step] = torch.from_numpy(reward.astype(np.float32))
            ends[step] = torch.from_numpy(over.astype(np.float32))
            state = torch.from_numpy(seen * scale)

        with torch.no_grad():
            advantages = advantages_of(
                choices, rewards, values, ends, agent.value(state).squeeze(-1)
            )
        tried = Tried(
            states.flatten(0, 1),
            actions.flatten(0, 1),
            likelihoods.flatten(),
            advantages.flatten(),
            (advantages + values).flatten(),
        )
        improve(choices, agent, optimiser, tried)

        reached = np.mean(np.array(collected) > 0)
        seconds = time.perf_counter() - began
        print(
            f"{update * per_update:9,} steps, {seconds:5.1f} s: {reached:4.0%} of episodes reach"
            f" a collectible, {np.mean(collected):.2f} collectibles each",
            flush=True,
        )
    mazes.close()
    return agent


class Tried(NamedTuple):
    """Actions that were tried, a row for each, and what came of them."""

    states: torch.Tensor
    actions: torch.Tensor
    likelihoods: torch.Tensor
    advantages: torch.Tensor
    returns: torch.Tensor


def improve(choices: Choices, agent: Agent, optimiser: torch.optim.Adam, tried: Tried) -> None:
    """Makes actions likelier that were better than expected, and others less likely."""
    for _ in range(choices.epochs):
        for part in torch.randperm(len(tried.returns)).chunk(choices.minibatches):
            policy = agent.policy(tried.states[part])
            likelihoods = policy.log_prob(tried.actions[part]).sum(-1)
            ratio = (likelihoods - tried.likelihoods[part]).exp()
            gain = tried.advantages[part]
            gain = (gain - gain.mean()) / (gain.std() + 1e-8)
            clipped = ratio.clamp(1 - choices.clip, 1 + choices.clip)
            policy_loss = -torch.min(gain * ratio, gain * clipped).mean()
            values = agent.value(tried.states[part]).squeeze(-1)
            value_loss = (values - tried.returns[part]).square().mean()
            optimiser.zero_grad()
            (policy_loss + choices.value_weight * value_loss).backward()
            nn.utils.clip_grad_norm_(agent.parameters(), choices.max_gradient)
            optimiser.step()


def advantages_of(
    choices: Choices,
    rewards: torch.Tensor,
    values: torch.Tensor,
    ends: torch.Tensor,
    value_after: torch.Tensor,
) -> torch.Tensor:
    """How much better each action was than expected (generalised advantage estimation)."""
    advantages = torch.zeros_like(rewards)
    advantage = torch.zeros_like(value_after)
    for step in reversed(range(len(rewards))):
        goes_on = 1 - ends[step]
        surprise = rewards[step] + choices.discount * value_after * goes_on - values[step]
        advantage = surprise + choices.discount * choices.smoothing * goes_on * advantage
        advantages[step], value_after = advantage, values[step]
    return advantages


def main() -> None:
    """Reads what is wanted, and teaches."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--envs", type=int, default=64, help="mazes at once")
    parser.add_argument("--steps", type=int, default=256_000, help="of all mazes together")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    train(Choices(arguments.envs, arguments.steps, arguments.seed))


if __name__ == "__main__":
    main()
