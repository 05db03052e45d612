"""What became of kinetic energy in the contacts that were stepped in a frame."""

from __future__ import annotations

from typing import NamedTuple


class ContactAccount(NamedTuple):
    """What contacts did to energy in a frame, and how good the solution is.

    Under the rule ``contact``, and in the stepped zones of ``exact``; else 0.
    """

    impulse_work: float
    """What impulses did to kinetic energy [J], <= 0 but for rounding: impacts and friction take."""
    surface_work: float
    """Work of moving colliders [J]."""
    correction_work: float
    """Energy that the correction of overlaps added [J]."""
    limited_sub_steps: int
    """Sub-steps in which impulses were scaled down for them not to add energy."""
    residual: float
    """Largest change of a normal impulse in the last sweep, as a part of the largest impulse."""
    largest_overlap: float
    """Largest overlap before it was corrected, as a part of the sum of radii."""
    asleep: int
    """Spheres that sleep at the end of the frame, until something comes near or changes."""
