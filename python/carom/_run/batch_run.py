"""Runs of a batch."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, eq=False)
class BatchRun:
    """What `carom.Batch.run` recorded of t states of n worlds.

    Attributes:
        times: Of each world [s], (t, n).
        states: The recorded quantities by name, (t, n, spheres, width); NaN where a world has no
            sphere.
        impacts: All impacts, frame after frame: records of `carom.IMPACT`, after a field ``world``;
            ``None`` unless recorded.
    """

    times: NDArray[np.float64]
    states: dict[str, NDArray[np.float64]]
    impacts: NDArray[np.void] | None


def stacked(states: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """States of all worlds, one after the other, with places for the most spheres of any."""
    most = max(state.shape[1] for state in states)
    worlds, _, width = states[0].shape
    joined = np.full((len(states), worlds, most, width), np.nan)
    for place, state in zip(joined, states, strict=True):
        place[:, : state.shape[1]] = state
    return joined
