"""Energy errors and times of orbits, beside IAS15 of REBOUND.

``python bench/orbits.py`` runs the same bodies under Carom's rule ``exact`` and under REBOUND, in
turns in the same minutes: an ellipse of eccentricity 0.9, the Pythagorean problem, planets about a
sun, and two balls that fall together and bounce elastically. The error is that of the energy,
computed here alike for both; of the balls, that of the distance to which they come back.
"""

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import rebound

import carom

REPEATS = 5
COLUMNS = "{:>24} {:>12} {:>12} {:>9} {:>9} {:>6}"


@dataclass
class Case:
    """Bodies under their gravity, with G = 1."""

    name: str
    masses: np.ndarray
    positions: np.ndarray
    velocities: np.ndarray
    seconds: float
    radius: float = 1e-6
    meets: bool = False


def ellipse() -> Case:
    """Returns two bodies in the apocentre of an ellipse of e = 0.9, for 100 periods."""
    speed = (0.1 / 1.9) ** 0.5
    places = np.array([[0.95, 0.0, 0.0], [-0.95, 0.0, 0.0]])
    velocities = np.array([[0.0, 0.5 * speed, 0.0], [0.0, -0.5 * speed, 0.0]])
    return Case("ellipse, 100 periods", np.array([0.5, 0.5]), places, velocities, 200 * np.pi)


def pythagorean() -> Case:
    """Returns Burrau's three bodies, at rest in the corners of a triangle."""
    places = np.array([[1.0, 3.0, 0.0], [-2.0, -1.0, 0.0], [1.0, -1.0, 0.0]])
    return Case("Pythagorean, 70 s", np.array([3.0, 4.0, 5.0]), places, np.zeros((3, 3)), 70.0)


def planets() -> Case:
    """Returns a sun with eight planets on circles, for a hundred periods of the innermost one."""
    masses = np.array([1.0, 1e-5, 3e-6, 2e-4, 1e-6, 5e-5, 4e-5, 1e-6, 2e-5])
    distances = np.array([0.0, *(1.5**number for number in range(8))])
    angles = 2.4 * np.arange(9)
    around = np.stack([np.cos(angles), np.sin(angles), 0.01 * np.sin(3.0 * angles)], axis=1)
    across = np.stack([-np.sin(angles), np.cos(angles), 0.0 * angles], axis=1)
    speeds = np.zeros(9)
    speeds[1:] = distances[1:] ** -0.5
    velocities = speeds[:, None] * across
    velocities[0] = -(masses[1:, None] * velocities[1:]).sum(axis=0)
    return Case("planets", masses, distances[:, None] * around, velocities, 200 * np.pi)


def balls() -> Case:
    """Returns two balls of 0.1 m at rest, which fall together and bounce fifty times."""
    places = np.array([[0.5, 0.0, 0.0], [-0.5, 0.0, 0.0]])
    # Of the fall from 1 m to the contact at 0.2 m: x is the distance as a part of the first.
    x = 0.2
    fall = np.sqrt(0.5) * (np.arccos(np.sqrt(x)) + np.sqrt(x * (1.0 - x)))
    masses, rest = np.array([0.5, 0.5]), np.zeros((2, 3))
    return Case("balls, 50 bounces", masses, places, rest, 100.0 * fall, 0.1, True)


def energy(masses: np.ndarray, positions: np.ndarray, velocities: np.ndarray) -> float:
    """Returns kinetic and potential energy, in extended precision."""
    m, x, v = (np.asarray(it, dtype=np.longdouble) for it in (masses, positions, velocities))
    total = 0.5 * (m * (v * v).sum(axis=1)).sum()
    for first in range(len(m)):
        for second in range(first):
            total -= m[first] * m[second] / np.sqrt(((x[first] - x[second]) ** 2).sum())
    return total


def error(case: Case, positions: np.ndarray, velocities: np.ndarray) -> float:
    """Returns the change of the energy, or of the distance of balls that are back, by part."""
    if case.meets:
        before, after = (np.linalg.norm(it[0] - it[1]) for it in (case.positions, positions))
    else:
        before = energy(case.masses, case.positions, case.velocities)
        after = energy(case.masses, positions, velocities)
    return float(abs(after / before - 1.0))


def under_carom(case: Case) -> tuple[float, float]:
    """Returns the error and the time [s]."""
    balls = [
        carom.Sphere(position=x, velocity=v, radius=case.radius, mass=m, restitution=1.0)
        for m, x, v in zip(case.masses, case.positions, case.velocities, strict=True)
    ]
    scene = carom.Scene(
        name="orbits",
        simulation=carom.Simulation(rule="exact", frame_time=case.seconds / 100.0),
        forces=[carom.MutualGravity(constant=1.0)],
        spheres=balls,
    )
    world = scene.world()
    start = time.process_time()
    for _ in range(100):
        world.step()
    taken = time.process_time() - start
    return error(case, world.positions, world.velocities), taken


def under_rebound(case: Case) -> tuple[float, float]:
    """Returns the same under IAS15."""
    simulation = rebound.Simulation()
    simulation.integrator = "ias15"
    for m, x, v in zip(case.masses, case.positions, case.velocities, strict=True):
        simulation.add(m=m, x=x[0], y=x[1], z=x[2], vx=v[0], vy=v[1], vz=v[2], r=case.radius)
    if case.meets:
        simulation.collision = "direct"
        simulation.collision_resolve = "hardsphere"
    start = time.process_time()
    for number in range(1, 101):
        simulation.integrate(case.seconds * number / 100.0)
    taken = time.process_time() - start
    states = [simulation.particles[number] for number in range(simulation.N)]
    places = np.array([p.xyz for p in states])
    velocities = np.array([p.vxyz for p in states])
    return error(case, places, velocities), taken


def fastest(run: Callable[[Case], tuple[float, float]], case: Case) -> tuple[float, float]:
    """Returns the error and the shortest time of some runs."""
    runs = [run(case) for _ in range(REPEATS)]
    return runs[0][0], min(taken for _, taken in runs)


def main() -> None:
    """Prints a table."""
    print(f"REBOUND {rebound.__version__}, Carom {carom.__version__}: error, time [ms]")
    print(COLUMNS.format("", "Carom", "REBOUND", "Carom", "REBOUND", "ratio"))
    for case in (ellipse(), pythagorean(), planets(), balls()):
        own, taken = fastest(under_carom, case)
        other, other_taken = fastest(under_rebound, case)
        times = [f"{1e3 * it:.1f}" for it in (taken, other_taken)]
        ratio = f"{taken / other_taken:.1f}"
        print(COLUMNS.format(case.name, f"{own:.1e}", f"{other:.1e}", *times, ratio))


if __name__ == "__main__":
    main()
