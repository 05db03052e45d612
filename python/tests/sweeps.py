"""What the tests of sweeps run and measure."""

from typing import Any

import numpy as np
import pytest

import carom

pytest.importorskip("distributed")
xarray = pytest.importorskip("xarray")
pandas = pytest.importorskip("pandas")


def falling(height: float = 1.0, e: float = 0.5) -> carom.Scene:
    """A ball that falls on a floor."""
    ball = carom.Sphere(position=(0, height + 0.5, 0), radius=0.5, restitution=e)
    floor = carom.Collider(carom.HalfSpace())
    return carom.Scene(name="falling", forces=[carom.Gravity()], spheres=[ball], colliders=[floor])


def rebound(world: carom.World) -> dict[str, Any]:
    """How often and how fast the ball bounces in a second, and where it is at the end."""
    impacts = world.run(seconds=1).impacts
    speeds = impacts["separation_speed"][:1]
    return {"bounces": len(impacts), "speed": speeds.sum(), "end": world.positions[0]}


def cloud(count: int = 5) -> carom.Scene:
    """Balls at random places."""
    fill = carom.RandomFill(count, (0, 0, 0), (9, 9, 9), 1, carom.Sphere(radius=0.2))
    return carom.Scene(name="cloud", generators=[fill])


def place(world: carom.World) -> float:
    return float(world.positions[0, 0])


GRID: dict[str, Any] = {"height": [0.5, 1.0, 2.0], "e": np.array([0.0, 0.5, 1.0])}
