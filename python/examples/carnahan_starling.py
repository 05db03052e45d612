"""The equation of state of hard spheres, measured and compared with that of Carnahan and Starling.

    pip install '.[examples]'
    python python/examples/carnahan_starling.py

Equal elastic spheres of diameter 1 and mass 1 in a periodic box, at kT = 1. The compressibility
factor Z = pV/(NkT) comes from the virial: an impact of two spheres changes the sum of r·p by their
distance, which is the diameter, times the impulse J between them, so that over a time t

    Z = 1 + Σ r J / (3 N kT t),    3 N kT = 2 K,

with K the kinetic energy: B. J. Alder and T. E. Wainwright, J. Chem. Phys. 33, 1439 (1960). That N
spheres are not infinitely many changes Z - 1 by parts of order 1/N. `carom verify` measures the
same with more spheres.
"""

from __future__ import annotations

import argparse
import time
from functools import partial

import numpy as np
from numpy.typing import NDArray

import carom

PACKING_FRACTIONS = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45]
DIAMETER = 1.0
EQUILIBRATION = 50
"""Collisions of each sphere before anything is measured: the lattice has melted by then."""


def gas(packing_fraction: float, cells: int = 16) -> carom.Scene:
    """Spheres at rest on a cubic lattice that fills a periodic box."""
    spacing = DIAMETER * (np.pi / 6 / packing_fraction) ** (1 / 3)
    edge, first = cells * spacing, 0.5 * (1 - cells) * spacing
    lattice = carom.Lattice(
        [cells] * 3, [first] * 3, [spacing] * 3, carom.Sphere(diameter=DIAMETER)
    )
    box = carom.Simulation(boundary=carom.Periodic([edge] * 3))
    return carom.Scene(name="gas", simulation=box, generators=[lattice])


def compressibility(
    world: carom.World, packing_fraction: float, seed: int, collisions: int = 200
) -> float:
    """Z over a time in which each sphere takes part in so many impacts."""
    world.velocities = maxwell_velocities(len(world), seed)
    # One collision of each sphere, so that the list of impacts of a frame is short.
    frame = 1 / collision_rate(packing_fraction)
    for _ in range(EQUILIBRATION):
        world.step(dt=frame)
    begin, virial = world.time, 0.0
    for _ in range(collisions):
        world.step(dt=frame)
        virial += DIAMETER * world.impacts["impulse"].sum()
    return float(1 + virial / (2 * world.kinetic_energy * (world.time - begin)))


def maxwell_velocities(count: int, seed: int) -> NDArray[np.float64]:
    """Velocities [m/s] of equilibrium at kT = 1, shape (count, 3), without total momentum."""
    velocities = np.random.default_rng(seed).standard_normal((count, 3))
    velocities -= velocities.mean(axis=0)
    velocities *= np.sqrt(3 * count / (velocities**2).sum())
    return velocities


def collision_rate(p: float) -> float:
    """Collisions of a sphere in a unit of time: Enskog, contact value of Carnahan and Starling."""
    return float(4 * np.sqrt(np.pi) * (6 * p / np.pi) * (1 - p / 2) / (1 - p) ** 3)


def carnahan_starling(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Z. N. F. Carnahan and K. E. Starling, J. Chem. Phys. 51, 635 (1969)."""
    return (1 + p + p**2 - p**3) / (1 - p) ** 3


def kolafa(p: NDArray[np.float64]) -> NDArray[np.float64]:
    """Z. J. Kolafa, in T. Boublík and I. Nezbeda, Coll. Czech. Chem. Commun. 51, 2301 (1986)."""
    return (1 + p + p**2 - 2 / 3 * (1 + p) * p**3) / (1 - p) ** 3


def main() -> None:
    """Measures, tells and draws."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--collisions", type=int, default=200, help="of each sphere (200)")
    parser.add_argument("--repeats", type=int, default=16, help="runs at each density (16)")
    parser.add_argument("--store", help="file that keeps finished runs")
    parser.add_argument("--picture", default="carnahan_starling.png", help="file to write")
    arguments = parser.parse_args()
    begin = time.perf_counter()
    runs = carom.sweep(
        gas,
        {"packing_fraction": PACKING_FRACTIONS},
        measure=partial(compressibility, collisions=arguments.collisions),
        repeats=arguments.repeats,
        store=arguments.store,
    )
    print(f"{len(runs)} runs in {time.perf_counter() - begin:.0f} s")
    z = runs.to_xarray().value
    mean, error = z.mean("repeat"), z.std("repeat", ddof=1) / np.sqrt(z.sizes["repeat"])
    p = z.packing_fraction.values
    print("packing        Z    error   Carnahan-Starling           Kolafa")
    for row in zip(p, mean.values, error.values, carnahan_starling(p), kolafa(p), strict=True):
        packing, measured, bar, *equations = row
        told = [f"{it:8.4f} ({(measured - it) / bar:+5.1f} err)" for it in equations]
        print(f"{packing:7.2f} {measured:8.4f} {bar:8.4f} {told[0]:>19} {told[1]:>19}")
    draw(p, mean.values, error.values, arguments.picture)


def draw(
    p: NDArray[np.float64], mean: NDArray[np.float64], error: NDArray[np.float64], file: str
) -> None:
    """Z over the packing fraction, and how far it is from Carnahan and Starling."""
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(
        2, 1, sharex=True, figsize=(6.4, 5.6), height_ratios=[3, 2], layout="constrained"
    )
    fine = np.linspace(0, 0.48, 200)
    above.plot(fine, carnahan_starling(fine), color="C0", label="Carnahan, Starling 1969")
    above.errorbar(p, mean, error, fmt="o", color="black", markersize=4, label="measured")
    above.set_ylabel(r"compressibility factor $Z = pV/NkT$")
    above.legend(frameon=False)
    below.axhline(0, color="C0")
    percent = 100 * (kolafa(fine) / carnahan_starling(fine) - 1)
    below.plot(fine, percent, "--", color="C1", label="Kolafa 1986")
    theory = carnahan_starling(p)
    below.errorbar(
        p,
        100 * (mean / theory - 1),
        100 * error / theory,
        fmt="o",
        color="black",
        markersize=4,
        capsize=3,
    )
    below.set_ylabel("deviation from\nCarnahan, Starling [%]")
    below.set_xlabel(r"packing fraction $\phi = \pi n \sigma^3/6$")
    below.legend(frameon=False)
    for axes in (above, below):
        axes.grid(alpha=0.3)
        axes.set_xlim(0, 0.48)
    figure.align_ylabels()
    figure.savefig(file, dpi=140)


if __name__ == "__main__":
    main()
