"""Pressure from impacts, by the virial."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.analysis._collisions import impacts_between_spheres
from carom.errors import CaromError


@dataclass(frozen=True)
class VirialPressure:
    """Pressure of spheres in a periodic box.

    Attributes:
        compressibility: ``Z = pV / (N kT)``.
        pressure: p [Pa].
        impacts: How many impacts between spheres it comes from. Their impulses are nearly
            independent: ``(Z - 1) / sqrt(impacts)`` is about the standard error of Z.
    """

    compressibility: float
    pressure: float
    impacts: int


def virial_pressure(run: Trajectory, volume: float) -> VirialPressure:
    """The pressure of a run, from its impacts between spheres.

    ``pV = N kT + Σ r J / (3 t)``, with ``3 N kT = 2 K``, K the mean kinetic energy, J the normal
    impulse of an impact and r the distance of its centres, the sum of both radii: B. J. Alder and
    T. E. Wainwright, J. Chem. Phys. 33, 1439 (1960). Tangential impulses are square to that
    distance, and do not count. Motion of all spheres together counts as heat: take it out of
    velocities before the run. Persistent contacts, as in a heap, press without impacts, and are
    not counted. Materials with a `non_additivity` meet at another distance than the sum of radii:
    for them use `carom.StressMeter`, which knows it, or give it to `pressure_from_impacts`.

    Args:
        run: A run in a periodic box.
        volume: Volume of the box [m³].

    Returns:
        Pressure; NaN for a run in which there are no spheres or none moves.

    Raises:
        CaromError: For a value that is invalid, and for a run without impacts or without two
            recorded states.
    """
    if not isinstance(run, Trajectory):
        raise CaromError("run: must be a carom.Trajectory; or see pressure_from_impacts", "run")
    impacts, duration = arguments.recorded_impacts(run, "run")
    between = impacts_between_spheres(impacts)
    volume = arguments.positive(volume, "volume")
    if not len(run.ids):
        return VirialPressure(float("nan"), float("nan"), len(between))
    squares = np.nan_to_num((arguments.frames(run, "velocities") ** 2).sum(axis=2))
    energy = float(0.5 * (squares * run.masses).sum(axis=1).mean())
    radii = [run.radii[np.searchsorted(run.ids, between[it])] for it in ("sphere_1", "sphere_2")]
    if energy <= 0:
        return VirialPressure(float("nan"), float("nan"), len(between))
    return pressure_from_impacts(
        between,
        center_distance=radii[0] + radii[1],
        kinetic_energy=energy,
        duration=duration,
        volume=volume,
    )


def pressure_from_impacts(
    impacts: NDArray[np.void],
    *,
    center_distance: ArrayLike,
    kinetic_energy: float,
    duration: float,
    volume: float,
) -> VirialPressure:
    """The pressure from records of impacts, by the formula of `virial_pressure`.

    For runs that are too long to record: gather ``world.impacts`` after each frame.

    Args:
        impacts: Records of `carom.IMPACT`; those of colliders are left out.
        center_distance: Distance of the centres at an impact [m]: one for all, or one for each
            impact between spheres.
        kinetic_energy: Mean kinetic energy of all spheres [J].
        duration: In what time the impacts came [s].
        volume: Volume of the box [m³].

    Returns:
        Pressure.

    Raises:
        CaromError: For a value that is invalid.

    >>> import carom, numpy
    >>> from carom import analysis
    >>> impacts = numpy.zeros(30, carom.IMPACT)
    >>> impacts["impulse"] = 2.0
    >>> analysis.pressure_from_impacts(
    ...     impacts, center_distance=1.0, kinetic_energy=15.0, duration=1.0, volume=10.0
    ... )
    VirialPressure(compressibility=3.0, pressure=3.0, impacts=30)
    """
    between = impacts_between_spheres(impacts)
    distance = arguments.per_sphere(center_distance, "center_distance", len(between))
    energy = arguments.positive(kinetic_energy, "kinetic_energy")
    duration = arguments.positive(duration, "duration")
    volume = arguments.positive(volume, "volume")
    virial = float((distance * between["impulse"]).sum()) / duration
    compressibility = 1 + virial / (2 * energy)
    pressure = compressibility * 2 * energy / (3 * volume)
    return VirialPressure(compressibility, pressure, len(between))
