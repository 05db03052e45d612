"""Runs that are recorded into arrays that are there already."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom._carom import Engine, Snapshot
from carom._run.functions import count
from carom._run.tables import IMPACT, SENSOR_EVENT
from carom._run.trajectory import Recorded, Selection, Trajectory, box_of, slides_of
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
    selection: Selection,
) -> Trajectory:
    """Takes frames, and records them as `World.run` does, into arrays with a row for each state.

    Args:
        world: What moves.
        take: Takes a number of frames, and records them.
        out: The arrays.
        frames: How many in all.
        every: A state is recorded after this number of frames.
        selection: Which events are recorded, too; of states it is what there are arrays for.
    """
    rows = frames // every + 1
    _check(out, rows, len(world))
    size = sum(array[0].nbytes for array in out.values())
    block = every * max(1, _BLOCK_BYTES // max(size, 1))
    before = world.snapshot()
    selection = selection._replace(quantities=list(out), is_single=False)
    record = _Record(out, rows, world.ids.copy(), selection)
    stopped = None
    # One assignment each: Ctrl-C may come between any two instructions.
    first = take(0, selection)
    piece = _Piece(0, before, first)
    try:
        record.keep(0, first)
        for begin in range(0, frames, block):
            piece = _Piece(begin, world.snapshot(), None)
            taken = take(min(block, frames - begin), selection)
            piece = piece._replace(taken=taken)
            record.keep(begin // every, taken)
    except KeyboardInterrupt as error:
        stopped = error
        last = getattr(error, "trajectory", piece.taken)
        if last is None:
            # What was recorded since is lost, if anything was.
            world.restore(piece.start)
        else:
            record.keep(piece.begin // every, last)
    except BaseException:
        world.restore(before)
        raise
    trajectory = record.trajectory(world)
    if stopped is not None:
        stopped.trajectory = trajectory  # type: ignore[attr-defined]
        raise stopped
    return trajectory


class _Piece(NamedTuple):
    """A part of a run: the frame it begins with, the world then, and what was recorded of it."""

    begin: int
    start: Snapshot
    taken: Trajectory | None


class _Record:
    """What the pieces of a run have put into its arrays. To keep a piece again changes nothing."""

    def __init__(self, out: Out, rows: int, ids: NDArray[np.uint64], selection: Selection) -> None:
        self._out, self._ids = out, ids
        self._time = np.empty(rows)
        self._rows = 0
        self._events: dict[str, dict[int, NDArray[np.void]]] = {}
        if selection.has_impacts:
            self._events["impacts"] = {-1: np.empty(0, IMPACT)}
        if selection.has_sensor_events:
            self._events["sensor_events"] = {-1: np.empty(0, SENSOR_EVENT)}

    def keep(self, row: int, piece: Trajectory) -> None:
        """Writes a piece that begins with the state of a row.

        Raises:
            CaromError: If spheres came or went.
        """
        if not np.array_equal(piece.ids, self._ids):
            problem = "spheres came or went, and the arrays have no place for that"
            raise CaromError(f"out: {problem}", "out")
        end = row + len(piece)
        self._time[row:end] = piece.time
        for name, array in self._out.items():
            array[row:end] = getattr(piece, name)
        for kind, parts in self._events.items():
            parts[row] = getattr(piece, kind)
        self._rows = end

    def trajectory(self, world: Engine) -> Trajectory:
        """Returns what was kept."""
        recorded: dict[str, Any] = {name: array[: self._rows] for name, array in self._out.items()}
        for kind, parts in self._events.items():
            recorded[kind] = np.concatenate(list(parts.values()))
        return Trajectory(
            time=self._time[: self._rows],
            ids=self._ids,
            radii=world.radii.copy(),
            masses=world.masses.copy(),
            box=box_of(world),
            slides=slides_of(world, self._time[: self._rows]),
            **recorded,
        )


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
