"""Structure and memory of the hard-sphere fluid, measured and compared with theory.

    pip install '.[examples]'
    python python/examples/hard_sphere_structure.py

Equal elastic spheres of diameter 1 and mass 1 in a periodic box, at kT = 1. The radial distribution
function is compared with that of Percus and Yevick, and at contact with the value of Carnahan and
Starling. The velocity autocorrelation does not decay exponentially, as it would if collisions were
independent, but as t^(-3/2): B. J. Alder and T. E. Wainwright, Phys. Rev. A 1, 18 (1970). A sphere
sets its neighbours in motion, and they push it on later:

    C(t) / C(0) = 2 / (3 n) (4π (D + ν) t)^(-3/2),

with n the number density, D the self-diffusion coefficient and ν the kinematic viscosity: M. H.
Ernst, E. H. Hauge and J. M. J. van Leeuwen, Phys. Rev. Lett. 25, 1254 (1970). Both coefficients are
those of Enskog's theory here. Sound that has gone around the periodic box disturbs the tail: time
ends before that. That all momenta together are 0 takes 1/N from C(t) / C(0), 0.0001 here.
"""

from __future__ import annotations

import argparse
import time

import numpy as np
from numpy.typing import NDArray

import carom
from carom import analysis

STRUCTURES = [0.3, 0.45]
"""Packing fractions at which g(r) is measured."""
TAIL = 0.3
"""Packing fraction at which velocities are correlated."""
EQUILIBRATION = 50
"""Collisions of each sphere before anything is measured: the lattice has melted by then."""
PER_COLLISION = 4
"""States recorded in the mean time between two collisions of a sphere."""
LAGS = 30
"""Longest lag, in mean times between collisions: sound has not gone around the box by then."""
BLOCKS = 10
"""Parts of a run, from whose scatter errors are estimated."""


def fluid(packing_fraction: float, cells: int) -> carom.World:
    """Spheres in equilibrium in a periodic box."""
    spacing = (np.pi / 6 / packing_fraction) ** (1 / 3)
    edge, first = cells * spacing, 0.5 * (1 - cells) * spacing
    lattice = carom.Lattice([cells] * 3, [first] * 3, [spacing] * 3, carom.Sphere(diameter=1.0))
    box = carom.Simulation(boundary=carom.Periodic([edge] * 3))
    world = carom.Scene(name="fluid", simulation=box, generators=[lattice]).world()
    velocities = np.random.default_rng(1).standard_normal((len(world), 3))
    velocities -= velocities.mean(axis=0)
    world.velocities = velocities * np.sqrt(3 * len(world) / (velocities**2).sum())
    world.step(dt=1 / collision_rate(packing_fraction), frames=EQUILIBRATION)
    return world


def collision_rate(packing_fraction: float) -> float:
    """Collisions of a sphere in a unit of time."""
    return float(analysis.enskog_collision_frequency(packing_fraction))


def box_side(packing_fraction: float, count: int) -> float:
    """Side of the box of so many spheres."""
    return float((count * np.pi / 6 / packing_fraction) ** (1 / 3))


def structure(
    packing_fraction: float, cells: int = 16, states: int = 100
) -> analysis.RadialDistribution:
    """g(r) up to 4 diameters, or half the box, over states that are four collisions apart."""
    world = fluid(packing_fraction, cells)
    dt = 1 / collision_rate(packing_fraction)
    run = world.run(frames=4 * states, dt=dt, every=4, impacts=False)
    side = box_side(packing_fraction, len(world))
    # Bins begin at contact: 40 for a diameter.
    r_max = min(4.0, np.floor(20 * side) / 40)
    return analysis.radial_distribution(run, [side] * 3, r_max=r_max, bins=round(40 * r_max))


def memory(cells: int = 20, collisions: int = 2000) -> tuple[NDArray[np.float64], ...]:
    """The velocity autocorrelation: lags, its mean over parts of the run, and of each part."""
    world = fluid(TAIL, cells)
    dt = 1 / (PER_COLLISION * collision_rate(TAIL))
    lags = PER_COLLISION * LAGS + 1
    parts = []
    for _ in range(BLOCKS):
        # Velocities of short runs, for those of a long one fill the memory.
        runs = [
            world.run(frames=PER_COLLISION * 100, dt=dt, impacts=False)
            for _ in range(max(1, collisions // (100 * BLOCKS)))
        ]
        found = [analysis.velocity_autocorrelation(run, lags=lags) for run in runs]
        parts.append(np.mean(found, axis=0))
    part = np.array(parts) / np.mean(parts, axis=0)[0]
    return dt * np.arange(lags), part.mean(axis=0), part


def tail(t: NDArray[np.float64], packing_fraction: float) -> NDArray[np.float64]:
    """C(t) / C(0) at long times, with the coefficients of Enskog's theory.

    S. Chapman and T. G. Cowling, The Mathematical Theory of Non-Uniform Gases, 3rd ed. (1970),
    chapters 10 and 16.
    """
    n, g = 6 * packing_fraction / np.pi, float(analysis.contact_value(packing_fraction))
    diffusion = 1.019 * 3 / 8 / (n * g * np.sqrt(np.pi))
    b = 4 * packing_fraction
    viscosity = 1.016 * 5 / 16 / np.sqrt(np.pi) * (1 / g + 0.8 * b + 0.7614 * g * b**2)
    return np.asarray(2 / (3 * n) * (4 * np.pi * (diffusion + viscosity / n) * t) ** -1.5)


def main() -> None:
    """Measures, tells and draws."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--states", type=int, default=100, help="for each g(r) (100)")
    parser.add_argument("--collisions", type=int, default=4000, help="of each sphere (4000)")
    parser.add_argument("--picture", default="hard_sphere_structure.png", help="file to write")
    arguments = parser.parse_args()
    begin = time.perf_counter()
    found = {it: structure(it, states=arguments.states) for it in STRUCTURES}
    print(f"g(r) in {time.perf_counter() - begin:.0f} s")
    print("packing   first bin   Percus-Yevick there   difference beyond 1.1, at most")
    for packing, it in found.items():
        theory = bin_means(it.edges, packing)
        first = np.flatnonzero(it.g)[0]
        beyond = it.r > 1.1
        difference = np.abs(it.g - theory)[beyond].max()
        print(f"{packing:7.2f} {it.g[first]:11.3f} {theory[first]:21.3f} {difference:32.3f}")
    t, mean, parts = memory(collisions=arguments.collisions)
    error = parts.std(axis=0, ddof=1) / np.sqrt(len(parts))
    print(f"everything in {time.perf_counter() - begin:.0f} s")
    print("collisions   C(t)/C(0)    error   t^(-3/2) tail")
    for at in PER_COLLISION * np.array([1, 2, 5, 10, 15, 20, 25, 30]):
        theory = tail(t[at], TAIL)
        print(f"{at // PER_COLLISION:10} {mean[at]:11.5f} {error[at]:8.5f} {theory:15.5f}")
    diffusion = analysis.green_kubo_diffusion(t, 3 * mean)[-1]
    print(f"Green-Kubo up to {LAGS} collisions: D = {diffusion:.4f}")
    draw(found, t, mean, error, arguments.picture)


def bin_means(edges: NDArray[np.float64], packing_fraction: float) -> NDArray[np.float64]:
    """g(r) of Percus and Yevick, averaged over the volume of each bin."""
    fine = np.linspace(edges[:-1], edges[1:], 22)[1:-1]
    g = analysis.percus_yevick_radial_distribution(fine, packing_fraction)
    return np.asarray((g * fine**2).sum(axis=0) / (fine**2).sum(axis=0))


def draw(
    found: dict[float, analysis.RadialDistribution],
    t: NDArray[np.float64],
    mean: NDArray[np.float64],
    error: NDArray[np.float64],
    file: str,
) -> None:
    """g(r) over the distance, and the velocity autocorrelation over time, on logarithmic axes."""
    import matplotlib.pyplot as plt

    figure, (above, below) = plt.subplots(2, 1, figsize=(6.4, 7.2), layout="constrained")
    fine = np.linspace(1, 4, 1201)
    for color, (packing, it) in zip(("C0", "C1"), found.items(), strict=True):
        label = rf"measured, $\phi$ = {packing:g}"
        keep = it.r > 1
        above.plot(it.r[keep], it.g[keep], "o", color=color, markersize=3, label=label)
        theory = analysis.percus_yevick_radial_distribution(fine, packing)
        above.plot(fine, theory, color=color, linewidth=1, label="Percus, Yevick")
        contact = float(analysis.contact_value(packing))
        above.plot(1, contact, "_", color=color, markersize=14, markeredgewidth=2)
    above.plot([], [], "_", color="gray", markersize=14, markeredgewidth=2)
    above.lines[-1].set_label("at contact: Carnahan, Starling")
    above.set_xlim(0.9, 4)
    above.set_ylim(0, None)
    above.set_xlabel(r"distance $r/\sigma$")
    above.set_ylabel("radial distribution $g(r)$")
    above.legend(frameon=False)
    collisions = t * collision_rate(TAIL)
    # Every state at first, then fewer: on this axis they would cover one another.
    keep = np.unique(np.geomspace(PER_COLLISION, len(t) - 1, 50).round().astype(int))
    keep = keep[mean[keep] > 2 * error[keep]]
    below.errorbar(
        collisions[keep],
        mean[keep],
        error[keep],
        fmt="o",
        color="black",
        markersize=3,
        linewidth=1,
        label=rf"measured, $\phi$ = {TAIL:g}",
    )
    long = np.geomspace(3, LAGS, 50)
    below.plot(long, tail(long / collision_rate(TAIL), TAIL), color="C0", label=r"tail, $t^{-3/2}$")
    early = np.linspace(0.5, 12, 100)
    below.plot(early, np.exp(-2 / 3 * early), "--", color="C1", label="Enskog, exponential")
    below.set_xscale("log")
    below.set_yscale("log")
    below.set_xlim(0.9, 1.1 * LAGS)
    below.set_ylim(1e-3, 1)
    ticks = [1, 2, 5, 10, 20, 30]
    below.set_xticks(ticks, [str(it) for it in ticks])
    below.set_xticks([], minor=True)
    below.set_xlabel(r"time $\omega t$, in collisions of a sphere")
    below.set_ylabel("velocity autocorrelation\n$C(t)/C(0)$")
    below.legend(frameon=False)
    for axes in (above, below):
        axes.grid(alpha=0.3)
    figure.align_ylabels()
    figure.savefig(file, dpi=140)


if __name__ == "__main__":
    main()
