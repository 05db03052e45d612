"""Dense packings and dense fluids, made by spheres that grow."""

from __future__ import annotations

from dataclasses import dataclass
from operator import index as as_index

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import pack_spheres, radii_of_sizes
from carom._scene import parts
from carom._scene.points import Points
from carom._scene.scene import Scene
from carom.errors import CaromError

_MOST_SPHERES = 10_000_000
"""As many as the command takes."""


@dataclass(frozen=True, eq=False)
class Packing:
    """Spheres in a periodic cube about the origin, from `pack`.

    Attributes:
        positions: Centres [m], shape (n, 3).
        velocities: Velocities [m/s], shape (n, 3).
        radii: Radii [m], shape (n,).
        masses: Masses [kg], shape (n,): the cube of the radius times 1 kg/m³.
        box: Edges of the periodic box [m], shape (3,).
        packing_fraction: Part of the box that the spheres fill.
        pressure: Reduced pressure P V / N k T, as measured last.
        collision_rate: Collisions of a sphere in the time in which the thermal speed takes it
            through the mean diameter, as measured last.
        collisions: Collisions of all spheres while they grew.
        rattlers: How many spheres nothing holds; ``None`` below a pressure of a million, where
            spheres have gaps all around.
        state_hash: Hash of the state; ``carom pack`` prints the same one.
    """

    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    radii: NDArray[np.float64]
    masses: NDArray[np.float64]
    box: NDArray[np.float64]
    packing_fraction: float
    pressure: float
    collision_rate: float
    collisions: int
    rattlers: int | None
    state_hash: str

    def __len__(self) -> int:
        """How many spheres there are."""
        return len(self.radii)

    def scene(self, name: str = "packing") -> Scene:
        """A scene of these spheres in their box, under the rule ``exact``."""
        points = Points(self.positions, self.radii, velocities=self.velocities, masses=self.masses)
        box = parts.Periodic(size=tuple(self.box))
        return Scene(name=name, spheres=points, simulation=parts.Simulation(boundary=box))


def pack(
    spheres: int = 1000,
    packing_fraction: float = 0.64,
    *,
    sizes: str | float | ArrayLike = 0.5,
    seed: int = 0,
    growth: float = 0.01,
    pressure: float | None = None,
    equilibrate: float | None = None,
) -> Packing:
    """Makes a dense packing or a dense fluid: small spheres fly, collide and grow.

    The same as ``carom pack``, to the bit. Source: Lubachevsky and Stillinger, J. Stat. Phys. 60,
    561 (1990).

    Args:
        spheres: How many, >= 1. Where ``sizes`` are all radii, as many as these.
        packing_fraction: Part of the box that they are to fill, in (0, 1).
        sizes: One radius [m], those of all spheres, or a text with shares as in the command:
            ``"0.5:2,0.7:1"`` (two of one for one of the other) or ``"0.4-0.6"`` (evenly between).
        seed: Of the random places, sizes and velocities, in [0, 2^64).
        growth: Speed at which the mean diameter grows, in parts of the thermal speed, > 0. Slower
            growth packs denser.
        pressure: Ends at this reduced pressure P V / N k T instead, > 1: 1e6 and more of a jammed
            packing.
        equilibrate: Collisions of each sphere after that, without growth, in which the pressure of
            the fluid is measured, > 0.

    Raises:
        CaromError: For invalid values, and for spheres that jam before.

    >>> import carom
    >>> fluid = carom.pack(200, 0.4, growth=0.1, equilibrate=10)
    >>> round(fluid.packing_fraction, 9), fluid.rattlers
    (0.4, None)
    >>> len(fluid.scene().world())
    200
    """
    if pressure is not None and equilibrate is not None:
        raise CaromError("equilibrate: a packing at a `pressure` is no fluid", "equilibrate")
    number = as_index(seed)
    if not 0 <= number < 2**64:
        raise CaromError(f"seed: must be in [0, 2^64), not {number}", "seed")
    radii = _radii(as_index(spheres), sizes, number)
    values = pack_spheres(
        radii.tolist(),
        float(packing_fraction),
        number,
        float(growth),
        None if pressure is None else float(pressure),
        None if equilibrate is None else float(equilibrate),
    )
    return Packing(**values)


def _radii(count: int, sizes: str | float | ArrayLike, seed: int) -> NDArray[np.float64]:
    """The radii of all spheres [m]."""
    if not 1 <= count <= _MOST_SPHERES:
        raise CaromError(f"spheres: must be in [1, {_MOST_SPHERES}], not {count}", "spheres")
    if isinstance(sizes, str):
        return radii_of_sizes(sizes, count, seed)
    radii = np.asarray(sizes)
    if radii.dtype.kind not in "fiu" or radii.ndim > 1:
        raise TypeError("sizes: must be a text, a radius, or an array of radii of shape (n,)")
    return np.full(count, radii, float) if radii.ndim == 0 else radii.astype(float)
