"""What became of the energy of a world in a frame."""

from __future__ import annotations

from typing import NamedTuple


class EnergyAccount(NamedTuple):
    """What became of the energy of a world in a frame, under any rule.

    The total energy after the frame is that before it, the sum of these, and what is left: the work
    of forces that have no potential, and the error of the integration.
    """

    contacts: float
    """Work of contacts [J]: what restitution and friction took, <= 0 but for errors."""
    colliders: float
    """Work of moving colliders [J]."""
    correction: float
    """Work of moving spheres out of what they overlap [J]."""
    emission: float
    """Energy of emitted spheres, less that of those taken out [J]."""
