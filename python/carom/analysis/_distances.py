"""Distances within which pairs are found."""

from __future__ import annotations

from carom.analysis._arguments import Floats
from carom.errors import CaromError


def check_distance(distance: float, box: Floats, name: str) -> None:
    """Refuses a distance at which the nearest image of a point is not the only one.

    Raises:
        CaromError: For a distance beyond half the smallest side.
    """
    half = 0.5 * float(box.min())
    if distance > half:
        raise CaromError(
            f"{name}: must be at most half the smallest side of the box, {half}, not {distance}",
            name,
        )
