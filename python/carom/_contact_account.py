"""How good the solution of the contacts that were stepped in a frame is."""

from __future__ import annotations

from typing import NamedTuple


class ContactAccount(NamedTuple):
    """How good the solution of a frame is.

    Under the rule ``contact``, and in the stepped zones of ``exact``; else 0.
    """

    limited_sub_steps: int
    """Sub-steps in which impulses were scaled down for them not to add energy."""
    residual: float
    """Largest change of a normal impulse in the last sweep, as a part of the largest impulse."""
    largest_overlap: float
    """Largest overlap before it was corrected, as a part of the sum of radii."""
    asleep: int
    """Spheres that sleep at the end of the frame, until something comes near or changes."""
    squeezed: int
    """How often a sphere was pressed into a surface by half its radius, in each sub-step."""
