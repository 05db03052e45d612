"""What was stepped in a frame under the rule ``exact``."""

from __future__ import annotations

from typing import NamedTuple


class ZoneAccount(NamedTuple):
    """Spheres that were not moved from impact to impact but stepped; 0 under other rules.

    Their contacts took too much work. How good their motion is, `ContactAccount` tells.
    """

    spheres: int
    """Spheres in a zone at the end of the frame."""
    sphere_seconds: float
    """Time that they spent in it in this frame, of all together [s]."""
    ticks: int
    """Ticks at which a zone was stepped."""
    joined: int
    """Spheres that came into a zone."""
    left: int
    """Spheres that left one."""
