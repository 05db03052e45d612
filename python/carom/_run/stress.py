"""The stress of spheres over a time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from carom._carom import StressEngine
from carom._run.strict import Strict
from carom._run.world import World


@dataclass(frozen=True, kw_only=True, eq=False)
class Stress:
    """Mean stress in a volume over a time, positive where it presses.

    Entry [i, k] is the momentum along axis i that goes through an area across axis k, for area and
    time. Source: Irving and Kirkwood, J. Chem. Phys. 18, 817 (1950).

    Attributes:
        kinetic: That of motion [Pa], shape (3, 3): the sum of m v v by the volume, mean over the
            ends of frames. Along periodic axes v is relative to the centre of mass.
        collisional: That of impacts [Pa], shape (3, 3).
        contact: That of persistent contacts [Pa], shape (3, 3), with the forces at the ends of
            frames.
        dimensions: Number of dimensions; with 2, all stresses are in N/m.
    """

    kinetic: NDArray[np.float64]
    collisional: NDArray[np.float64]
    contact: NDArray[np.float64]
    dimensions: int = 3

    @property
    def total(self) -> NDArray[np.float64]:
        """The sum of all parts [Pa], shape (3, 3)."""
        return self.kinetic + self.collisional + self.contact

    @property
    def pressure(self) -> float:
        """The pressure [Pa]: the trace divided by the number of dimensions."""
        return float(np.trace(self.total)) / self.dimensions


class StressMeter(Strict):
    """Measures the stress of a world over frames, under every rule.

    >>> import carom
    >>> box = carom.Simulation(boundary=carom.Periodic(size=(4, 4, 4)))
    >>> ball = carom.Sphere(radius=0.5, velocity=(1, 0, 0))
    >>> other = carom.Sphere(radius=0.5, velocity=(-1, 0, 0), position=(2, 0, 0))
    >>> world = carom.Scene(name="two", spheres=[ball, other], simulation=box).world()
    >>> meter = carom.StressMeter(world)
    >>> meter.step(dt=0.5, frames=4)
    >>> stress = meter.stress()  # two masses of 1 kg in 64 m³; two impacts of 2 N s over 1 m
    >>> float(64 * stress.kinetic[0, 0]), float(64 * stress.collisional[0, 0])
    (2.0, 2.0)
    """

    __slots__ = ("_meter", "_world")

    def __init__(self, world: World) -> None:
        """Begins with a world as it is now."""
        world._refuse_functions("StressMeter")
        self._world = world
        self._meter = StressEngine(world)

    def step(self, *, dt: float | None = None, frames: int = 1) -> None:
        """Advances the world by ``frames`` frames of ``dt`` [s], and measures each.

        Raises:
            CaromError: As of `World.step`.
            StepError: As of `World.step`. The frames before are taken and measured.
        """
        self._world._refuse_functions("StressMeter")
        self._meter.step(self._world, dt, frames)

    @property
    def time(self) -> float:
        """The time measured so far [s]."""
        return self._meter.time

    def stress(self, volume: float | None = None) -> Stress:
        """Returns the mean stress so far.

        Args:
            volume: The volume that the spheres are in [m³], > 0; that of the periodic box or of the
                first closed container unless given.

        Raises:
            CaromError: Before the first frame, and where the volume is not known.
        """
        kinetic, collisional, contact = map(np.array, self._meter.stress(volume))
        dimensions = self._world.simulation.dimensions
        return Stress(
            kinetic=kinetic, collisional=collisional, contact=contact, dimensions=dimensions
        )
