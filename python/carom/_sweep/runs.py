"""What a sweep leaves: a table of runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom._scene.scene import Scene
from carom._sweep.experiment import SEED, Experiment, Measured
from carom._sweep.plan import REPEAT, SAMPLE, Plan
from carom.errors import CaromError

if TYPE_CHECKING:
    import pandas
    import xarray


class Failure(NamedTuple):
    """A run that measured nothing."""

    run: int
    """Its row."""
    parameters: Mapping[str, Any]
    seed: int | None
    error: str
    """The exception, in a line."""
    traceback: str
    """Where it was raised."""


@dataclass(frozen=True, eq=False, repr=False)
class Runs:
    """The runs of a `sweep`, in the order of the grid or the samples; the last axis runs fastest.

    Attributes:
        parameters: The parameters of each run.
        seeds: The seed of each run, in [0, 2^32); ``None`` where the scene kept its own.
        results: What each run measured, arrays by name; ``None`` where it failed or is no run
            of this part.
        errors: The runs that failed; ``pandas.DataFrame(runs.errors)`` is a table of them.
    """

    parameters: Sequence[Mapping[str, Any]]
    seeds: Sequence[int | None]
    results: Sequence[Mapping[str, NDArray[Any]] | None]
    errors: Sequence[Failure]
    _plan: Plan = field(kw_only=True)
    _experiment: Experiment = field(kw_only=True)

    def __len__(self) -> int:
        """The number of runs."""
        return len(self.results)

    def __repr__(self) -> str:
        axes = ", ".join(f"{name}: {len(values)}" for name, values in self._plan.axes.items())
        return f"<carom.Runs: {len(self)} runs ({axes}), {len(self.errors)} failed>"

    def scene(self, run: int) -> Scene:
        """The scene at the start of a run, to see it again."""
        return self._experiment.scene_of(self._plan[range(len(self))[run]])

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each run: parameters, ``repeat`` and ``seed``, what was measured.

        Numbers that are missing are NaN; a measured array stands whole in its cell.

        Raises:
            ModuleNotFoundError: Where pandas is not installed.
            CaromError: If runs measured arrays of different shapes.
        """
        import pandas

        columns: dict[str, Any] = {
            name: [parameters[name] for parameters in self.parameters] for name in self._plan.names
        }
        if REPEAT in self._plan.axes:
            columns[REPEAT] = np.arange(len(self)) % self._plan.repeats
            columns[SEED] = self.seeds
        for name, values in self._measured().items():
            columns[name] = values if values.ndim == 1 else list(values)
        return pandas.DataFrame(columns, index=pandas.RangeIndex(len(self), name="run"))

    def to_xarray(self) -> xarray.Dataset:
        """What was measured, over a dimension for each axis of the grid.

        Samples are over ``sample`` and their parameters coordinates along it. Repeats are over
        ``repeat``, with the seeds as a coordinate. An array ``a`` has dimensions ``a_0``, ``a_1``
        of its own. Numbers that are missing are NaN.

        Raises:
            ModuleNotFoundError: Where xarray is not installed.
            CaromError: If runs measured arrays of different shapes.
        """
        import xarray

        axes = self._plan.axes
        dims, shape = tuple(axes), tuple(len(values) for values in axes.values())
        variables = {
            name: (
                (*dims, *(f"{name}_{axis}" for axis in range(values.ndim - 1))),
                values.reshape(*shape, *values.shape[1:]),
            )
            for name, values in self._measured().items()
        }
        coordinates: dict[str, Any] = {name: (name, _axis(axes[name])) for name in dims}
        if SAMPLE in axes:
            for name in self._plan.names:
                column = [point[name] for point in self._plan.points]
                coordinates[name] = (SAMPLE, _axis(column))
        if REPEAT in axes:
            coordinates[SEED] = (dims, np.array(self.seeds, dtype=np.int64).reshape(shape))
        return xarray.Dataset(variables, coordinates)

    def _measured(self) -> Measured:
        """Everything measured, by name, a row for each run."""
        columns: Measured = {}
        found = [result for result in self.results if result is not None]
        for name in dict.fromkeys(name for result in found for name in result):
            arrays = [None if result is None else result.get(name) for result in self.results]
            columns[name] = _stacked(name, arrays)
        return columns


def _stacked(name: str, arrays: Sequence[NDArray[Any] | None]) -> NDArray[Any]:
    """Arrays one after the other, NaN where there is none."""
    found = [array for array in arrays if array is not None]
    shape, kind = found[0].shape, np.result_type(*{array.dtype for array in found})
    for row, array in enumerate(arrays):
        if array is not None and array.shape != shape:
            raise CaromError(
                f"measure: {name!r} has shape {array.shape} in run {row}, and {shape} before; "
                "see `results`",
                "measure",
            )
    if len(found) < len(arrays):
        kind = np.result_type(kind, np.float64)
    rows = np.full((len(arrays), *shape), np.nan if kind.kind in "fc" else 0, dtype=kind)
    for row, array in enumerate(arrays):
        if array is not None:
            rows[row] = array
    return rows


def _axis(values: Sequence[Any]) -> NDArray[Any]:
    """Values along an axis, vectors as tuples."""
    if not any(isinstance(value, list) or value is None for value in values):
        return np.array(values)
    axis = np.empty(len(values), dtype=object)
    for index, value in enumerate(values):
        axis[index] = tuple(value) if isinstance(value, list) else value
    return axis
