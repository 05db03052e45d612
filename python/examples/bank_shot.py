"""Finds a shot over a cushion by descent along the exact gradient of where the ball comes to rest.

    pip install .
    python python/examples/bank_shot.py

A billiard ball is struck, slides, rolls, bounces off a cushion, strikes the object ball, and both
roll to rest. The strike has two numbers, its speed and its angle; wanted is where the object ball
stops. Each step runs the shot once and goes by the method of Levenberg and Marquardt, with the
gradient of each coordinate from one tape.
"""

from __future__ import annotations

import time

import numpy as np
from numpy.typing import NDArray

import carom

RADIUS = 0.028575
"""Of a pool ball [m]."""
SECONDS = 8.0
"""Until all balls are at rest."""
TARGET = np.array([1.1, -0.2])
"""Where the object ball is to stop [m]."""
START = np.array([1.9, 1.2])
"""The first guess: speed [m/s] and angle to the cushion [rad]."""


def table() -> carom.Scene:
    """A cloth that is half a table wide, with one cushion along x, and two balls."""
    cloth = carom.Collider(
        shape=carom.HalfSpace(),
        restitution=0.5,
        friction=0.2,
        rolling_friction=0.01,
        spinning_friction=0.02,
    )
    half = np.sqrt(0.5)
    cushion = carom.Collider(
        shape=carom.HalfSpace(),
        position=(0, 0, 0.5),
        rotation=(-half, 0, 0, half),
        restitution=0.8,
    )
    balls = [
        carom.Sphere(position=(x, RADIUS, z), radius=RADIUS, mass=0.17, restitution=0.95)
        for x, z in [(0.0, 0.0), (0.75, -0.02)]
    ]
    return carom.Scene(
        name="bank-shot",
        spheres=balls,
        colliders=[cloth, cushion],
        forces=[carom.Gravity()],
    )


def rest(scene: carom.Scene, strike: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Where the object ball stops along x and z, and the derivatives by speed and angle."""
    speed, angle = strike
    along = np.array([np.cos(angle), 0.0, np.sin(angle)])
    across = np.array([-np.sin(angle), 0.0, np.cos(angle)])
    world = scene.world()
    world.velocities[0] = speed * along
    tape = carom.Tape(world)
    tape.step(dt=SECONDS / 8, frames=8)
    rows = []
    for axis in (0, 2):
        wanted = np.zeros((2, 3))
        wanted[1, axis] = 1.0
        by_velocity = tape.gradient(positions=wanted).velocities[0]
        rows.append([by_velocity @ along, speed * (by_velocity @ across)])
    return world.positions[1, [0, 2]].copy(), np.array(rows)


def find(scene: carom.Scene, steps: int = 20) -> tuple[NDArray[np.float64], list[float]]:
    """The strike, and how far the ball was from the target at each step [m]."""
    strike, misses = START.copy(), []
    place, slopes = rest(scene, strike)
    damping = 1e-3
    for _ in range(steps):
        miss = place - TARGET
        misses.append(float(np.linalg.norm(miss)))
        if misses[-1] < 1e-9:
            break
        normal = slopes.T @ slopes
        change = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), slopes.T @ miss)
        other = strike - change
        found = rest(scene, other)
        if np.linalg.norm(found[0] - TARGET) < misses[-1]:
            strike, (place, slopes), damping = other, found, 0.1 * damping
        else:
            damping = max(10 * damping, 1e-3)
    return strike, misses


def main() -> None:
    """Finds the shot."""
    began = time.perf_counter()
    (speed, angle), misses = find(table())
    for number, miss in enumerate(misses):
        print(f"step {number:2}: {1000 * miss:.9f} mm off")
    took = time.perf_counter() - began
    print(f"{speed:.9f} m/s at {np.degrees(angle):.9f} degrees, found in {took:.2f} s")


if __name__ == "__main__":
    main()
