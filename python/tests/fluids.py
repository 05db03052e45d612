"""Points in boxes and a fluid of hard spheres, for the tests of what is measured of them."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import carom

Floats = NDArray[np.float64]

ROOT = Path(__file__).parents[2]

SIDE = 10.0
BOX = (SIDE, SIDE, SIDE)


def random_points(frames: int, count: int, seed: int = 1) -> Floats:
    return np.random.default_rng(seed).uniform(-SIDE / 2, SIDE / 2, (frames, count, 3))


def lattice(cells: int, basis: list[list[float]]) -> Floats:
    """Points of cubic cells of side 1."""
    row = np.arange(cells)
    corners = np.stack(np.meshgrid(row, row, row, indexing="ij"), axis=-1).reshape(-1, 1, 3)
    return np.asarray(corners + np.array(basis), dtype=np.float64).reshape(-1, 3)


CUBIC = [[0.0, 0.0, 0.0]]
FACE_CENTERED = [[0.0, 0.0, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [0.5, 0.5, 0.0]]


@dataclass(frozen=True)
class Fluid:
    """A run of hard spheres of diameter 1, mass 1 and kT = 1 in equilibrium."""

    run: carom.Trajectory
    side: float


def hard_spheres(frames: int, dt: float) -> Fluid:
    """1,000 spheres at a packing fraction of 0.3: each has 10 collisions in a second."""
    cells, spacing = 10, (np.pi / 6 / 0.3) ** (1 / 3)
    first = 0.5 * (1 - cells) * spacing
    spheres = carom.Lattice([cells] * 3, [first] * 3, [spacing] * 3, carom.Sphere(diameter=1.0))
    box = carom.Simulation(boundary=carom.Periodic([cells * spacing] * 3))
    world = carom.Scene(name="fluid", simulation=box, generators=[spheres]).world()
    world.masses = 1.0
    velocities = np.random.default_rng(7).standard_normal((len(world), 3))
    velocities -= velocities.mean(axis=0)
    world.velocities = velocities * np.sqrt(3 * len(world) / (velocities**2).sum())
    world.step(dt=0.1, frames=50)
    return Fluid(world.run(frames=frames, dt=dt), cells * spacing)
