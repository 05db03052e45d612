"""Random numbers of many environments, each of its own seed."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_STEP = np.uint64(0x9E3779B97F4A7C15)
_MIX = (np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB))


class Numbers:
    """A generator for each environment; which numbers it gives depends on its seed alone.

    SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
    """

    def __init__(self, count: int) -> None:
        self._states = np.arange(count, dtype=np.uint64)

    def seed(self, seeds: list[int | None]) -> None:
        """Sets the seeds of those that have one here."""
        for place, seed in enumerate(seeds):
            if seed is not None:
                self._states[place] = seed

    def uniform(self, mask: NDArray[np.bool_], count: int) -> NDArray[np.float64]:
        """Numbers in [0, 1) of the marked environments, shape (k, count)."""
        states = self._states[mask]
        drawn = np.empty((len(states), count))
        for column in drawn.T:
            states += _STEP
            word = states.copy()
            for shift, factor in zip((30, 27), _MIX, strict=True):
                word = (word ^ (word >> np.uint64(shift))) * factor
            word ^= word >> np.uint64(31)
            column[:] = (word >> np.uint64(11)) * 2.0**-53
        self._states[mask] = states
        return drawn
