"""How many steps a second a processor takes with the plate and the billiard table of `carom.gym`.

A step is a frame of 1/60 s of one world under random actions, everything included: actions from a
NumPy array, physics, rewards, new episodes, observations. With --shots, also whole shots. The time
is that of the processor, whatever else the machine does, on one thread.

    pip install . gymnasium
    python bench/batch_env.py [--num-envs 64 1024] [--seconds 2] [--shots] [--profile]
"""

from __future__ import annotations

import argparse
import cProfile
import time
from typing import Any

import gymnasium
import numpy as np

import carom
import carom.gym

ROUNDS = 7
FRAMES = {"frames_per_step": 1}


def rate(name: str, num_envs: int, seconds: float, given: dict[str, Any]) -> tuple[float, float]:
    """Steps a second of processor time: the median of some rounds, and the part in the engine."""
    envs: Any = gymnasium.make_vec(
        name, num_envs=num_envs, vectorization_mode="vector_entry_point", threads=1, **given
    ).unwrapped
    envs.reset(seed=1)
    random = np.random.default_rng(1)
    actions = random.uniform(-1, 1, (64, num_envs, 2)).astype(np.float32)
    envs.step(actions[0])
    rates, inside, whole = [], 0.0, 0.0
    step = envs.batch.step

    def timed(**given: Any) -> None:
        nonlocal inside
        began = time.process_time()
        step(**given)
        inside += time.process_time() - began

    envs.batch.__dict__["step"] = timed
    for _ in range(ROUNDS):
        steps, began = 0, time.process_time()
        while (took := time.process_time() - began) < seconds / ROUNDS:
            envs.step(actions[steps % len(actions)])
            steps += 1
        whole += took
        rates.append(steps * num_envs / took)
    return float(np.median(rates)), inside / whole


def by_single_worlds(num_envs: int, seconds: float) -> float:
    """The plate with colliders set world by world: what a batch without actions needs."""
    envs = carom.gym.PlateVectorEnv(num_envs, threads=1)
    envs.reset(seed=1)
    batch, steps, began = envs.batch, 0, time.process_time()
    while (took := time.process_time() - began) < seconds:
        for number in range(num_envs):
            world = batch.world(number)
            world.set_collider(0, world.colliders[0])
            batch.set_world(number, world)
        batch.step()
        steps += num_envs
    return steps / took


def main() -> None:
    """Measures, and prints a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--num-envs", nargs="+", type=int, default=[64, 1024])
    parser.add_argument("--seconds", type=float, default=2.0, help="for each figure")
    parser.add_argument("--shots", action="store_true", help="whole shots, too")
    parser.add_argument("--profile", action="store_true", help="functions of Python by time")
    parser.add_argument("--single", action="store_true", help="the plate, world by world")
    arguments = parser.parse_args()
    kinds: list[tuple[str, dict[str, Any]]] = [
        (carom.gym.PLATE, {}),
        (carom.gym.PLATE, {"rule": "exact"}),
        (carom.gym.BILLIARDS, {**FRAMES, "max_episode_steps": 600}),
        (carom.gym.BILLIARDS, {**FRAMES, "max_episode_steps": 600, "rule": "contact"}),
        (carom.gym.BILLIARDS, {**FRAMES, "max_episode_steps": 150, "start": "rack"}),
    ]
    if arguments.shots:
        kinds.append((carom.gym.BILLIARDS, {}))
    print(f"{'environment':60} {'number':>6} {'steps/s':>9} {'engine':>7}")
    for name, given in kinds:
        for num_envs in arguments.num_envs:
            if arguments.profile:
                with cProfile.Profile() as profile:
                    rate(name, num_envs, arguments.seconds, given)
                profile.print_stats("tottime")
            steps, part = rate(name, num_envs, arguments.seconds, given)
            print(f"{f'{name} {given}':60} {num_envs:6} {steps:9,.0f} {part:7.0%}", flush=True)
    if arguments.single:
        for num_envs in arguments.num_envs:
            steps = by_single_worlds(num_envs, arguments.seconds)
            print(f"{'the plate, world by world':60} {num_envs:6} {steps:9,.0f}")


if __name__ == "__main__":
    main()
