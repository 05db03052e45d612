"""Which runs there are: their parameters, their seeds, and their order."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from carom._scene.text import toml_value
from carom._sweep.experiment import SEED, Run
from carom.errors import CaromError

REPEAT, SAMPLE = "repeat", "sample"


@dataclass(frozen=True)
class Plan:
    """The runs of a sweep, in the order of its table: the last axis runs fastest.

    Attributes:
        points: The parameters, a mapping for each point of the grid or each sample.
        axes: The coordinates along each dimension of the table.
        repeats: How many runs there are at each point.
        seed: Where the seeds of runs come from; ``None`` if scenes keep their own.
    """

    points: Sequence[Mapping[str, Any]]
    axes: Mapping[str, Sequence[Any]]
    repeats: int
    seed: int | None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the parameters."""
        return tuple(self.points[0])

    def __len__(self) -> int:
        return len(self.points) * self.repeats

    def __getitem__(self, row: int) -> Run:
        point, repeat = divmod(row, self.repeats)
        parameters = self.points[point]
        if self.seed is None:
            return Run(row, parameters, None)
        return Run(row, parameters, seed_of_run(self.seed, parameters, repeat))

    def __iter__(self) -> Iterator[Run]:
        return (self[row] for row in range(len(self)))


@dataclass(frozen=True)
class Part:
    """A share of the runs: every ``count``-th, from number ``index`` on."""

    index: int
    count: int

    def rows(self, total: int) -> range:
        """The rows of the table that it has."""
        return range(self.index, total, self.count)


def make_part(part: Any) -> Part | None:
    """Reads which share of a sweep a process has.

    Raises:
        TypeError, CaromError: If it is invalid.
    """
    if part is None:
        return None
    whole = (int, np.integer)
    if not isinstance(part, tuple) or [isinstance(it, whole) for it in part] != [True, True]:
        raise TypeError(f"part: must be a tuple of two whole numbers, not {part!r}")
    index, count = (int(it) for it in part)
    if not 0 <= index < count:
        raise CaromError(f"part: must be (i, n) with 0 <= i < n, not {part!r}", "part")
    return Part(index, count)


def make_plan(
    grid: Mapping[str, Iterable[Any]] | None,
    samples: Any,
    repeats: int | None,
    seed: int,
) -> Plan:
    """Reads what a sweep goes through.

    Raises:
        TypeError, CaromError: With the name of the argument that is invalid.
    """
    if grid is not None and samples is not None:
        raise TypeError("grid and samples: give one of them")
    if samples is not None:
        points = _read_samples(samples)
        axes: dict[str, Sequence[Any]] = {SAMPLE: range(len(points))}
    else:
        axes = _read_grid({} if grid is None else grid)
        points = [dict(zip(axes, values, strict=True)) for values in _product(axes)]
    if repeats is None:
        return Plan(points, axes, 1, None)
    for name, value, least in (("repeats", repeats, 1), ("seed", seed, 0)):
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)):
            raise TypeError(f"{name}: must be a whole number, not {type(value).__name__}")
        if value < least:
            raise CaromError(f"{name}: must be at least {least}, not {value}", name)
    if SEED in points[0]:
        raise TypeError("repeats: the parameter `seed` is given; leave out one of them")
    return Plan(points, {**axes, REPEAT: range(repeats)}, int(repeats), int(seed))


def canonical_text(parameters: Mapping[str, Any]) -> str:
    """Parameters as text, the same for the same values in any order.

    >>> canonical_text({"e": 1.0, "count": 3}) == canonical_text({"count": 3, "e": 1})
    True
    """
    lines = []
    for name in sorted(parameters):
        value = parameters[name]
        if isinstance(value, float) and value.is_integer() and abs(value) < 2**53:
            value = int(value)
        lines.append(f"{name} = {'none' if value is None else toml_value(value, name)}")
    return "\n".join(lines)


def seed_of_run(seed: int, parameters: Mapping[str, Any], repeat: int) -> int:
    """The seed of a run, in [0, 2^32): of the parameters and the number of the repeat alone.

    What `numpy.random.SeedSequence.spawn` would give a child whose place follows from the
    parameters: independent of that of every other run, and the same in a sweep over other values.
    """
    digest = hashlib.sha256(canonical_text(parameters).encode()).digest()
    place = int.from_bytes(digest[:16], "little")
    return int(np.random.SeedSequence(seed, spawn_key=(place, repeat)).generate_state(1)[0])


def _read_grid(grid: Any) -> dict[str, Sequence[Any]]:
    if not isinstance(grid, Mapping):
        raise TypeError(f"grid: must be a mapping of names to values, not {type(grid).__name__}")
    axes: dict[str, Sequence[Any]] = {}
    for name, values in grid.items():
        _check_name("grid", name)
        if isinstance(values, (str, bytes, Mapping)) or not isinstance(values, Iterable):
            kind = type(values).__name__
            raise TypeError(f"grid: {name}: must be a sequence of values, not a {kind}")
        axis = _plain(values)
        if not isinstance(axis, list):
            raise TypeError(f"grid: {name}: must be a sequence of values, not one")
        if not axis:
            raise CaromError(f"grid: {name}: has no values", "grid")
        _check_different("grid", [{name: value} for value in axis])
        axes[name] = axis
    return axes


def _read_samples(samples: Any) -> list[dict[str, Any]]:
    # A table of pandas gives its rows.
    rows = samples.to_dict("records") if hasattr(samples, "to_dict") else samples
    if isinstance(rows, (str, bytes, Mapping)) or not isinstance(rows, Iterable):
        kind = type(samples).__name__
        raise TypeError(f"samples: must be a table or a list of mappings, not a {kind}")
    points = []
    for row in rows:
        if not isinstance(row, Mapping):
            raise TypeError(f"samples: must be mappings, not {type(row).__name__}")
        points.append({name: _plain(value) for name, value in row.items()})
    if not points:
        raise CaromError("samples: there are none", "samples")
    for name in points[0]:
        _check_name("samples", name)
    for index, point in enumerate(points):
        if point.keys() != points[0].keys():
            raise CaromError(f"samples: {index} has other names than the first", "samples")
    _check_different("samples", points)
    return points


def _plain(value: Any) -> Any:
    """Numbers and lists of Python in the place of those of NumPy and pandas."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (str, bytes, Mapping)) or not isinstance(value, Iterable):
        return value
    return [_plain(item) for item in value]


def _check_name(argument: str, name: object) -> None:
    if not isinstance(name, str):
        raise TypeError(f"{argument}: names must be text, not {type(name).__name__}")
    if name in (REPEAT, SAMPLE, ""):
        raise CaromError(f"{argument}: a parameter cannot be called {name!r}", argument)


def _check_different(argument: str, points: Sequence[Mapping[str, Any]]) -> None:
    """Equal parameters mean the same run, not another one."""
    seen: set[str] = set()
    for point in points:
        text = canonical_text(point)
        if text in seen:
            told = text.replace("\n", ", ")
            raise CaromError(
                f"{argument}: {told} is there twice; `repeats` gives independent runs", argument
            )
        seen.add(text)


def _product(axes: Mapping[str, Sequence[Any]]) -> Iterable[tuple[Any, ...]]:
    return itertools.product(*axes.values())
