"""How a gas of inelastic spheres cools, compared with Haff's law.

    pip install '.[examples]'
    python python/examples/haff.py

Equal spheres of diameter 1 and mass 1 in a periodic box begin in equilibrium at kT = 1, and lose
energy in every collision from then on. While they stay spread evenly, the temperature is

    T(t) = T0 / (1 + t/τ)²,    1/τ = (1 - e²) ω0 / 6,

with e the restitution and ω0 the collisions of a sphere in a unit of time at T0, by Enskog's
theory: P. K. Haff, J. Fluid Mech. 134, 401 (1983). Speeds are taken to be Maxwell's. That they are
not quite changes the rate by the factor 1 + 3 a2/16: T. P. C. van Noije and M. H. Ernst, Granul.
Matter 1, 57 (1998). `carom verify` checks the same at one restitution with more spheres.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
import xarray
from numpy.typing import NDArray

import carom

RESTITUTIONS = [0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 0.98]
PACKING_FRACTION = 0.01
"""So dilute that velocities of spheres that meet are independent."""
EQUILIBRATION = 20
"""Collisions of each sphere before it becomes inelastic."""
LOOKS = np.array([0, 0.05, 0.1, 0.2, 0.35, 0.6, 1, 1.5, 2])
"""When the temperature is measured, in τ; it has fallen to 1/9 by the end, before clusters form."""


def gas(cells: int = 16) -> carom.Scene:
    """Spheres at rest on a cubic lattice that fills a periodic box."""
    spacing = (np.pi / 6 / PACKING_FRACTION) ** (1 / 3)
    edge, first = cells * spacing, 0.5 * (1 - cells) * spacing
    lattice = carom.Lattice([cells] * 3, [first] * 3, [spacing] * 3, carom.Sphere(diameter=1.0))
    box = carom.Simulation(boundary=carom.Periodic([edge] * 3), combine_rule="minimum")
    return carom.Scene(name="gas", simulation=box, generators=[lattice])


def cooling(world: carom.World, restitution: float, seed: int) -> dict[str, object]:
    """T/T0 at the times of `LOOKS`, and the rate 1/τ that the last one tells, in that of Haff."""
    world.velocities = maxwell_velocities(len(world), seed)
    # One collision of each sphere, so that the list of impacts of a frame is short.
    frame = 1 / collision_rate(PACKING_FRACTION)
    world.step(dt=frame, frames=EQUILIBRATION)
    world.restitutions = restitution
    tau = haff_time(restitution)
    energies = [world.kinetic_energy]
    for time_between in tau * np.diff(LOOKS):
        frames = int(np.ceil(time_between / frame))
        world.step(dt=time_between / frames, frames=frames)
        energies.append(world.kinetic_energy)
    temperature = np.array(energies) / energies[0]
    return {"temperature": temperature, "rate": (temperature[-1] ** -0.5 - 1) / LOOKS[-1]}


def maxwell_velocities(count: int, seed: int) -> NDArray[np.float64]:
    """Velocities [m/s] of equilibrium at kT = 1, shape (count, 3), without total momentum."""
    velocities = np.random.default_rng(seed).standard_normal((count, 3))
    velocities -= velocities.mean(axis=0)
    velocities *= np.sqrt(3 * count / (velocities**2).sum())
    return velocities


def collision_rate(p: float) -> float:
    """Collisions of a sphere in a unit of time: Enskog, contact value of Carnahan and Starling."""
    return float(4 * np.sqrt(np.pi) * (6 * p / np.pi) * (1 - p / 2) / (1 - p) ** 3)


def haff_time(e: float) -> float:
    """τ."""
    return 6 / ((1 - e**2) * collision_rate(PACKING_FRACTION))


def fourth_cumulant(e: NDArray[np.float64]) -> NDArray[np.float64]:
    """a2, by which speeds differ from Maxwell's: van Noije and Ernst, in three dimensions."""
    return 16 * (1 - e) * (1 - 2 * e**2) / (81 - 17 * e + 30 * e**2 * (1 - e))


def main() -> None:
    """Measures, tells and draws."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--repeats", type=int, default=32, help="runs at each restitution (32)")
    parser.add_argument("--store", help="file that keeps finished runs")
    parser.add_argument("--picture", default="haff.png", help="file to write")
    arguments = parser.parse_args()
    begin = time.perf_counter()
    runs = carom.sweep(
        gas,
        {"restitution": RESTITUTIONS},
        measure=cooling,
        repeats=arguments.repeats,
        store=arguments.store,
    )
    print(f"{len(runs)} runs in {time.perf_counter() - begin:.0f} s")
    data = runs.to_xarray()
    mean = data.mean("repeat")
    error = data.std("repeat", ddof=1) / np.sqrt(data.sizes["repeat"])
    e, rate, bar = (it.values for it in (data.restitution, mean.rate, error.rate))
    factor = 1 + 3 / 16 * fourth_cumulant(e)
    print("restitution  rate/Haff   error   to Haff   van Noije, Ernst")
    for row in zip(e, rate, bar, factor, strict=True):
        told = [f"{(row[1] - it) / row[2]:+.1f} err" for it in (1.0, row[3])]
        print(f"{row[0]:11.2f} {row[1]:10.4f} {row[2]:7.4f} {told[0]:>9} {told[1]:>18}")
    draw(mean, error, arguments.picture)


def draw(mean: xarray.Dataset, error: xarray.Dataset, file: str) -> None:
    """T over time, and the rate of cooling over restitution."""
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(
        2, 1, figsize=(6.4, 6.4), height_ratios=[3, 2], layout="constrained"
    )
    colors = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(RESTITUTIONS)))
    unit = collision_rate(PACKING_FRACTION)
    for color, e in zip(colors, RESTITUTIONS, strict=True):
        tau = unit * haff_time(e)
        fine = np.linspace(LOOKS[1], LOOKS[-1], 100)
        above.loglog(fine * tau, (1 + fine) ** -2, color=color, linewidth=1)
        measured, bar = (it.temperature.sel(restitution=e).values[1:] for it in (mean, error))
        above.errorbar(
            LOOKS[1:] * tau, measured, bar, fmt="o", color=color, markersize=4, label=f"$e$ = {e:g}"
        )
    above.plot([], [], color="black", linewidth=1, label="Haff 1983")
    above.set_ylabel(r"temperature $T/T_0$")
    above.set_yticks([0.1, 0.2, 0.5, 1], ["0.1", "0.2", "0.5", "1"])
    above.set_xlabel(r"time $\omega_0 t$, in collisions of a sphere at $T_0$")
    above.legend(frameon=False, ncols=2)
    fine = np.linspace(0.55, 1, 100)
    below.axhline(0, color="black", linewidth=1, label="Haff 1983")
    percent = 100 * 3 / 16 * fourth_cumulant(fine)
    below.plot(fine, percent, "--", color="C1", label="van Noije, Ernst 1998")
    below.errorbar(
        RESTITUTIONS,
        100 * (mean.rate - 1),
        100 * error.rate,
        fmt="o",
        color="black",
        markersize=4,
        capsize=3,
        label="measured",
    )
    below.set_xlim(0.55, 1)
    below.set_xlabel("restitution $e$")
    below.set_ylabel("rate of cooling $1/τ$,\ndeviation from Haff [%]")
    below.legend(frameon=False)
    for axes in (above, below):
        axes.grid(alpha=0.3)
    figure.align_ylabels()
    figure.savefig(file, dpi=140)


if __name__ == "__main__":
    main()
