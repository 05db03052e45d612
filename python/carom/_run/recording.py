"""Runs that are recorded into arrays that are there already."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom._carom import Engine
from carom._run.functions import count
from carom._run.tables import IMPACT
from carom._run.trajectory import Recorded, Selection, Trajectory
from carom.errors import CaromError

Out = Mapping[Recorded, NDArray[np.floating]]
"""Arrays by what is recorded into them."""

_WIDTHS: dict[Recorded, int] = {
    "positions": 3,
    "velocities": 3,
    "orientations": 4,
    "angular_velocities": 3,
}

_BLOCK_BYTES = 32 * 2**20
"""States are copied in blocks of so much: enough to cost nothing, and no matter beside them."""


def check_rhythm(frames: object, every: object) -> tuple[int, int]:
    """How many frames a run takes, and after how many of them each state is recorded.

    Raises:
        CaromError: If only the state at the beginning would be recorded of frames that are taken.
        TypeError: For something else than whole numbers.
    """
    number, rhythm = count("frames", frames), count("every", every)
    if rhythm == 0:
        raise CaromError("every: must be at least 1, not 0", "every")
    if 0 < number < rhythm:
        problem = f"must be at most {number}, the number of frames, not {rhythm}"
        lost = "no state after the first would be recorded"
        raise CaromError(f"every: {problem}: {lost}", "every")
    return number, rhythm


def check_choice(name: str, value: object) -> bool:
    """A truth value that was given under a name.

    Raises:
        TypeError: For something else.
    """
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name}: must be True or False, not {type(value).__name__}")
    return bool(value)


def run_into(
    world: Engine,
    take: Callable[[int, Selection], Trajectory],
    out: Out,
    frames: int,
    every: int,
    has_impacts: bool,
) -> Trajectory:
    """Takes frames, and records them as `World.run` does, into arrays with a row for each state.

    Args:
        world: What moves.
        take: Takes so many frames of it, and records them.
        out: The arrays.
        frames: How many in all.
        every: A state is recorded after so many of them.
        has_impacts: Whether impacts are recorded, too.
    """
    rows = frames // every + 1
    _check(out, rows, len(world))
    size = sum(array[0].nbytes for array in out.values())
    block = every * max(1, _BLOCK_BYTES // max(size, 1))
    before, ids = world.snapshot(), world.ids.copy()
    selection = Selection(list(out), False, has_impacts)
    time = np.empty(rows)
    impacts = [np.empty(0, IMPACT)]
    row, stopped = 0, None
    for begin in range(0, max(frames, 1), block):
        length = min(block, frames - begin)
        try:
            piece = take(length, selection)
        except KeyboardInterrupt as error:
            stopped = error
            piece = error.trajectory  # type: ignore[attr-defined]
        except BaseException:
            world.restore(before)
            raise
        if not np.array_equal(piece.ids, ids):
            world.restore(before)
            problem = "spheres came or went, and the arrays have no place for that"
            raise CaromError(f"out: {problem}", "out")
        # It begins with the state that the one before ended with.
        first = 1 if begin else 0
        end = row + len(piece) - first
        time[row:end] = piece.time[first:]
        for name, array in out.items():
            array[row:end] = getattr(piece, name)[first:]
        if has_impacts:
            impacts.append(piece.impacts)
        row = end
        if stopped is not None:
            break
    recorded: dict[str, Any] = {name: array[:row] for name, array in out.items()}
    if has_impacts:
        recorded["impacts"] = np.concatenate(impacts)
    trajectory = Trajectory(
        time=time[:row],
        ids=ids,
        radii=world.radii.copy(),
        masses=world.masses.copy(),
        **recorded,
    )
    if stopped is not None:
        stopped.trajectory = trajectory  # type: ignore[attr-defined]
        raise stopped
    return trajectory


def _check(out: Out, rows: int, spheres: int) -> None:
    """Refuses arrays into which the states do not fit."""
    if not isinstance(out, Mapping):
        raise TypeError(f"out: must be a dict of arrays by name, not {type(out).__name__}")
    if not out:
        raise CaromError(f"out: must have arrays for some of {', '.join(_WIDTHS)}", "out")
    for name, array in out.items():
        field = f"out[{name!r}]"
        if name not in _WIDTHS:
            raise CaromError(f"out: must be of {', '.join(_WIDTHS)}, not {name!r}", "out")
        if not isinstance(array, np.ndarray):
            raise TypeError(f"{field}: must be a NumPy array, not {type(array).__name__}")
        shape = (rows, spheres, _WIDTHS[name])
        if array.shape != shape:
            raise CaromError(f"{field}: must have the shape {shape}, not {array.shape}", field)
        if array.dtype not in (np.float64, np.float32):
            raise CaromError(f"{field}: must be of float64 or float32, not {array.dtype}", field)
        if not array.flags.writeable:
            raise CaromError(f"{field}: cannot be written to", field)
