"""Particle files of other programs: extended XYZ, dumps of LAMMPS, GSD."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom._carom import read_particle_file, write_particle_file
from carom.errors import CaromError

Floats = NDArray[np.float64]

ENDINGS = {".xyz", ".extxyz", ".lammpstrj", ".dump", ".gsd"}
"""Of file names, by which a format is known."""


class Particles(NamedTuple):
    """What a particle file holds; NaN in positions where a sphere is not there."""

    time: Floats
    ids: NDArray[np.uint64]
    radii: Floats
    masses: Floats
    sides: list[float]
    slides: Floats | None
    positions: Floats
    velocities: Floats | None
    orientations: Floats | None
    angular_velocities: Floats | None


def is_particle_file(path: str | os.PathLike[str]) -> bool:
    """Whether the ending of a file is that of a format of particles."""
    return Path(path).suffix.lower() in ENDINGS


def write(path: str | os.PathLike[str], particles: Particles) -> None:
    """Writes a particle file."""
    write_particle_file(Path(path), particles)


def read(path: str | os.PathLike[str], radius: float | None) -> dict[str, Any]:
    """The fields of a trajectory, from a particle file.

    Raises:
        CaromError: If it is no such file, or it is not clear which radius its particles have.
        OSError: If it cannot be read.
    """
    with open(path, "rb"):
        pass  # An error of the system stays one.
    time, ids, radii, masses, sides, slides, motion = read_particle_file(Path(path))
    if radii is None and radius is None:
        raise CaromError(
            f"radius: the particles of {os.fspath(path)} have none: give one", "radius"
        )
    if radii is not None and radius is not None:
        raise CaromError(f"radius: the particles of {os.fspath(path)} have their own", "radius")
    if radius is not None and not (np.isfinite(radius) and radius > 0):
        raise CaromError(f"radius: must be finite and > 0, not {radius}", "radius")
    return {
        "time": time,
        "ids": ids,
        "radii": np.full(len(ids), radius, dtype=np.float64) if radii is None else radii,
        "masses": np.ones(len(ids)) if masses is None else masses,
        "box": np.array(sides) if np.isfinite(sides).any() else None,
        "slides": slides if slides.any() else None,
        **dict(motion),
    }
