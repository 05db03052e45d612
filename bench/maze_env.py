"""How many maze steps a second the vector environment takes, and MuJoCo in the same maze.

A step is 0.02 s of one ball under a random tilt, everything included: the action read from a NumPy
array, the tilt, physics, rewards, new episodes, observations written into NumPy arrays.

    pip install . && pip install -r bench/requirements.txt
    python bench/maze_env.py [--mujoco] [--json figures.json] [--seconds 2]

Two kinds of random tilt: "at once", any tilt up to 20° in each frame; "followed", the maze turns to
it by 60°/s, so that balls get farther and meet walls more often.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import time
from dataclasses import asdict, dataclass

import gymnasium
import numpy as np

import carom.gym

TILT_SPEEDS = {"at once": math.inf, "followed": 60.0}
NUM_ENVS = (1, 16, 256, 1024, 4096)
# So many different actions that nothing predicts them, in a block of memory that caches hold.
ACTIONS = 64
# Long enough for balls to have left their start, short enough that some start anew all the time.
MAX_EPISODE_STEPS = 1000


@dataclass
class Figure:
    """One measurement."""

    engine: str
    tilt: str
    num_envs: int
    threads: int
    steps_per_second: float
    per_core: float
    """Steps per second that a processor worked for it, whatever else the machine does."""
    overhead: float | None = None
    """Part of a step that is not the engine's: Python, conversion, arrays; of medians."""


def carom_figure(rule: str, tilt: str, num_envs: int, threads: int, seconds: float) -> Figure:
    """Measures the vector environment."""
    envs = gymnasium.make_vec(
        carom.gym.MAZE,
        num_envs=num_envs,
        vectorization_mode="vector_entry_point",
        rule=rule,
        start="random",
        threads=threads,
        max_episode_steps=MAX_EPISODE_STEPS,
        tilt_speed_degrees_per_second=TILT_SPEEDS[tilt],
    )
    envs.reset(seed=1)
    actions = random_actions(num_envs)
    run(envs, actions, 0.5 * seconds)
    steps, wall, worked = run(envs, actions, seconds)
    steps *= num_envs
    overhead = call_overhead(envs, actions)
    return Figure(rule, tilt, num_envs, threads, steps / wall, steps / worked, overhead)


def call_overhead(envs: gymnasium.vector.VectorEnv, actions: np.ndarray) -> float:
    """Part of a step that is not the engine's own; medians, for other programs break in."""
    engine = envs.unwrapped._engine
    whole, besides = [], []
    for action in actions:
        before, began = engine._seconds_in_engine, time.perf_counter()
        envs.step(action)
        took = time.perf_counter() - began
        whole.append(took)
        besides.append(took - (engine._seconds_in_engine - before))
    return float(np.median(besides) / np.median(whole))


def run(
    envs: gymnasium.vector.VectorEnv, actions: np.ndarray, seconds: float
) -> tuple[int, float, float]:
    """Steps for a while; how many steps, how long they took, and what processors worked [s]."""
    steps, began, worked = 0, time.perf_counter(), time.process_time()
    while time.perf_counter() - began < seconds:
        for action in actions:
            envs.step(action)
        steps += len(actions)
    return steps, time.perf_counter() - began, time.process_time() - worked


def random_actions(num_envs: int) -> np.ndarray:
    """Actions, (ACTIONS, num_envs, 2), each in [-1, 1]."""
    random = np.random.default_rng(1)
    return random.uniform(-1.0, 1.0, (ACTIONS, num_envs, 2)).astype(np.float32)


def table(figures: list[Figure]) -> str:
    """The figures for a page of Markdown."""
    lines = ["| engine | tilt | environments | threads | steps/s | per core | overhead |"]
    lines += ["|---|---|---|---|---|---|---|"]
    for it in figures:
        overhead = "" if it.overhead is None else f"{100 * it.overhead:.1f} %"
        rates = f"{it.steps_per_second:,.0f} | {it.per_core:,.0f}"
        lines.append(
            f"| {it.engine} | {it.tilt} | {it.num_envs} | {it.threads} | {rates} | {overhead} |"
        )
    return "\n".join(lines)


def ratios(figures: list[Figure]) -> str:
    """How many times as many steps per core the environment takes as MuJoCo at its best."""
    lines = []
    for tilt in TILT_SPEEDS:
        theirs = [it.per_core for it in figures if "MuJoCo" in it.engine and it.tilt == tilt]
        for rule in ("discrete", "exact"):
            ours = [it.per_core for it in figures if it.engine == rule and it.tilt == tilt]
            if ours and theirs:
                lines.append(f"{rule}, tilt {tilt}: {max(ours) / max(theirs):.1f} times MuJoCo")
    return "\n".join(lines)


def main() -> None:
    """Measures, prints a table, writes JSON."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=2.0, help="for each figure")
    parser.add_argument("--mujoco", action="store_true", help="MuJoCo, too")
    parser.add_argument("--json", metavar="FILE", help="write the figures there")
    parser.add_argument("--rules", nargs="+", default=["discrete", "exact"])
    parser.add_argument("--num-envs", nargs="+", type=int, default=list(NUM_ENVS))
    arguments = parser.parse_args()

    figures = []
    processors = (
        len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    )
    for rule in arguments.rules:
        for tilt in TILT_SPEEDS:
            for num_envs in arguments.num_envs:
                figures.append(carom_figure(rule, tilt, num_envs, 1, arguments.seconds))
                print(table(figures[-1:]).splitlines()[-1], flush=True)
            if processors and processors > 1:
                many = max(arguments.num_envs)
                figures.append(carom_figure(rule, tilt, many, processors, arguments.seconds))
    if arguments.mujoco:
        import maze_mujoco

        for tilt, speed in TILT_SPEEDS.items():
            for name, rates in maze_mujoco.rates(speed, arguments.seconds).items():
                figures.append(Figure(f"MuJoCo {name}", tilt, 1, 1, *rates))
    load = (
        ", ".join(f"{load:.1f}" for load in os.getloadavg()) if hasattr(os, "getloadavg") else "?"
    )
    print(f"\nload of the machine: {load}\n\n{table(figures)}\n\n{ratios(figures)}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump([asdict(figure) for figure in figures], file, indent=1)


if __name__ == "__main__":
    main()
