"""Impacts of long runs, chunk by chunk."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from carom._run.functions import count
from carom._run.world import World
from carom.errors import CaromError


def impact_chunks(
    world: World, frames: int, *, dt: float | None = None, size: int = 65_536
) -> Iterator[NDArray[np.void]]:
    """Runs on, and yields the impacts in chunks, so that memory does not grow with their number.

    Together the chunks are the impacts of `World.run`. Each ends with a frame, and the world is
    then at the end of that frame; a loop that is left early leaves the world there.

    Args:
        world: The world, which moves.
        frames: Number of frames.
        dt: Length of a frame [s]; the scene's own unless given.
        size: Least number of impacts in a chunk, except in the last one.

    Returns:
        Records of `carom.IMPACT`, one array for each chunk.

    Raises:
        CaromError: For a number that is invalid.
        StepError: Within the loop, as by `World.step`.

    >>> import carom
    >>> world = carom.load("tutorial4").world()
    >>> sizes = [len(chunk) for chunk in carom.impact_chunks(world, 120, size=50)]
    >>> min(sizes[:-1]) >= 50
    True
    """
    number, least = count("frames", frames), count("size", size)
    if least == 0:
        raise CaromError("size: must be at least 1, not 0", "size")
    return _chunks(world, number, dt, least)


def _chunks(world: World, frames: int, dt: float | None, size: int) -> Iterator[NDArray[np.void]]:
    pieces: list[NDArray[np.void]] = []
    pending = 0
    for _ in range(frames):
        world.step(dt=dt)
        pieces.append(world.impacts)
        pending += len(pieces[-1])
        if pending >= size:
            yield np.concatenate(pieces)
            pieces, pending = [], 0
    if pending:
        yield np.concatenate(pieces)
