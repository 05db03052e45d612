"""Many independent runs of a scene, on many processes or machines."""

from __future__ import annotations

import itertools
import os
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from carom._scene.library import find
from carom._scene.scene import Scene
from carom._sweep.cluster import check_place, performing
from carom._sweep.experiment import (
    Experiment,
    Fault,
    Maker,
    Measured,
    Outcome,
    Run,
    Written,
    fault,
)
from carom._sweep.experiment import experiment as make_experiment
from carom._sweep.guard import check_not_in_worker
from carom._sweep.plan import Plan, make_part, make_plan
from carom._sweep.runs import Failure, Runs
from carom._sweep.store import Key, Store
from carom.errors import CaromError, RunError, SceneError

if TYPE_CHECKING:
    import pandas
    from distributed import Client

__all__ = ["Failure", "Runs", "sweep"]


def sweep(
    scene: Scene | str | Maker,
    grid: Mapping[str, Iterable[Any]] | None = None,
    *,
    measure: Callable[..., Any],
    samples: pandas.DataFrame | Sequence[Mapping[str, Any]] | None = None,
    repeats: int | None = None,
    seed: int = 0,
    client: Client | Literal["ray", "serial"] | None = None,
    store: str | os.PathLike[str] | None = None,
    version: str = "",
    part: tuple[int, int] | None = None,
    on_error: Literal["keep", "raise"] = "keep",
    progress: bool | None = None,
) -> Runs:
    """Runs a scene with many parameters, each run by itself, and gathers what they measured.

    A parameter goes where its name says: to the parameter of the function that makes the scene, to
    the parameter of ``measure``, or to both; any other name is the path of a value in the scene,
    as in `Scene.with_changes`, or a parameter of the scene file, if its path is given.

    Repeats are the same run with other seeds. The seed goes to the parameter ``seed`` of the
    function that makes the scene; if it has none, into the random generators of the scene (the
    second gets the next number, and so on). It also goes to ``measure``, if that has a parameter
    ``seed``. Seeds are children of ``seed`` by `numpy.random.SeedSequence`, placed by the
    parameters and the number of the repeat: independent of each other, and the same in a larger
    sweep.

    Workers are processes of a cluster of `Dask <https://distributed.dask.org>`_ or `Ray
    <https://docs.ray.io>`_, and need carom. When one dies, another performs again what was in work,
    about a quarter of a second or a run. A script that starts its own cluster of Dask must do so
    under ``if __name__ == "__main__":``, for the processes import it.

    Args:
        scene: A scene, the name of one, or a function of parameters that makes one.
        grid: Values for each parameter; every combination is run.
        measure: Given a `World` at the start of the scene, which it runs; returns a number, an
            array, or a mapping of names to them (a number alone is called ``value``).
        samples: Parameters run by run instead of a grid: a table, or mappings.
        repeats: How many runs with seeds of their own there are for each point; unless given, one,
            with the seeds that the scene has.
        seed: Where the seeds of the repeats come from, >= 0.
        client: The cluster; a process for each core of this machine unless given. ``"ray"`` is the
            one of Ray to which this process or ``RAY_ADDRESS`` connects, or one on this machine.
            ``"serial"`` works in this process.
        store: A file that takes each batch of runs as it is finished. What it holds already is not
            run again: it is found by the scene, the parameters and seed, the qualified name of
            ``measure``, and ``version``. Failed runs are not kept there.
        version: To be changed with what ``measure`` does; a warning tells where the code of
            ``measure`` has changed and this has not.
        part: ``(i, n)`` performs only every n-th run, from number i on: a share for one of n
            processes, such as the jobs of an array of Slurm. Each writes into a file of its own
            beside ``store``. The results of other runs are ``None``. A sweep without ``part`` takes
            in these files, and performs what is missing.
        on_error: ``"keep"`` has a run that raises kept among the errors, with a warning at the end;
            ``"raise"`` stops there.
        progress: Whether to show a line on stderr (by tqdm); if stderr is a terminal unless given.

    Raises:
        TypeError, CaromError: For invalid arguments, a scene among them that cannot even
            begin the first run; named.
        RunError: If a run fails and ``on_error`` says so, if the cluster is lost, or if a script
            calls this without ``if __name__ == "__main__":``.
        ModuleNotFoundError: Where Dask, or Ray, is needed and not installed.

    >>> import carom
    >>> def height(world):
    ...     return float(world.run(seconds=1).positions[-1, 0, 1])
    >>> drags = "forces.1.viscous-drag.coefficient"
    >>> grid = {"simulation.rule": ["exact", "bisect"], drags: [30.0, 60.0, 120.0]}
    >>> runs = carom.sweep("tutorial1", grid, measure=height, client="serial")
    >>> runs
    <carom.Runs: 6 runs (simulation.rule: 2, forces.1.viscous-drag.coefficient: 3), 0 failed>
    >>> runs.to_xarray().value.shape
    (2, 3)
    """
    if client is None:
        check_not_in_worker()
    _check_choices(measure, version, on_error)
    check_place(client)
    share = make_part(part)
    plan = make_plan(grid, samples, repeats, seed)
    rows = range(len(plan)) if share is None else share.rows(len(plan))
    source = _source(scene)
    if not isinstance(source, Scene | Written) and not callable(source):
        kind = type(source).__name__
        raise TypeError(f"scene: must be a carom.Scene, a name or a function, not a {kind}")
    experiment = make_experiment(source, measure, plan.names)
    first = plan[0]
    experiment.scene_of(first)
    if repeats is not None and not experiment.takes_seeds(first):
        raise CaromError(
            "repeats: nothing is random: no function with a parameter `seed`, no random generator",
            "repeats",
        )
    with ExitStack() as stack:
        kept = None
        if store is not None:
            kept = stack.enter_context(Store(store, measure, version, share))
        line = stack.enter_context(_progress_line(len(rows), progress))
        book = _Book(plan, experiment, kept, on_error, line)
        missing = book.missing(rows)
        if (run := next(missing, None)) is not None:
            todo = itertools.chain([run], missing)
            batches = performing(client, experiment, todo, len(rows))
            for outcomes in stack.enter_context(batches):
                book.enter(outcomes)
    return book.runs()


def _source(scene: Scene | str | Maker) -> Scene | Written | Maker:
    """What is run: of a scene file the text, so that its own parameters can be changed."""
    if not isinstance(scene, str):
        return scene
    found, path = find(scene), Path(scene)
    if not isinstance(found, Scene) or path.suffix != ".toml":
        return found
    text = path.read_text(encoding="utf-8")
    try:
        Scene.from_toml(text, source=scene)
    except SceneError:
        # It includes files, which a text alone cannot.
        return found
    return Written(text, scene)


class _Book:
    """What is known of the runs of a sweep so far."""

    def __init__(
        self,
        plan: Plan,
        experiment: Experiment,
        store: Store | None,
        on_error: Literal["keep", "raise"],
        line: Any,
    ) -> None:
        self._plan, self._experiment, self._store = plan, experiment, store
        self._on_error, self._line = on_error, line
        self._results: list[Measured | None] = [None] * len(plan)
        self._faults: dict[int, Fault] = {}
        self._keys: dict[int, Key] = {}
        self._has_warned = False

    def missing(self, rows: Iterable[int]) -> Iterator[Run]:
        """The runs that are not finished, one by one: cluster and keys are at work together."""
        for run in map(self._plan.__getitem__, rows):
            if self._store is not None:
                try:
                    key = self._store.key(run, self._experiment.scene_of(run))
                except Exception as error:
                    self._fail(run.row, fault(error))
                    self._line.update()
                    continue
                found = self._store.find(key)
                if found is not None:
                    self._warn_of_other_code(key)
                    self._results[run.row] = found
                    self._line.update()
                    continue
                self._keys[run.row] = key
            yield run

    def _warn_of_other_code(self, key: Key) -> None:
        """Warns once if a run that is taken from the store was measured by other code."""
        if self._has_warned or self._store is None or not self._store.is_of_other_code(key):
            return
        self._has_warned = True
        warnings.warn(
            "store: the code of measure has changed since runs were stored, and version= has not: "
            "the stored runs are taken as they are; with another version= they are run again",
            RuntimeWarning,
            stacklevel=_level_of_caller(),
        )

    def enter(self, outcomes: Sequence[Outcome]) -> None:
        """Takes in a batch; first of all the store does."""
        finished = [(it.row, it.result) for it in outcomes if not isinstance(it.result, Fault)]
        if self._store is not None:
            self._store.add((self._keys.pop(row), measured) for row, measured in finished)
        for row, measured in finished:
            self._results[row] = measured
        for outcome in outcomes:
            if isinstance(outcome.result, Fault):
                self._fail(outcome.row, outcome.result)
        self._line.update(len(outcomes))

    def _fail(self, row: int, fault: Fault) -> None:
        self._faults[row] = fault
        if self._on_error == "raise":
            run = self._plan[row]
            raise RunError(f"{_told(run)}: {fault.error}\n\n{fault.traceback}")

    def runs(self) -> Runs:
        """The table, at the end."""
        runs = list(self._plan)
        errors = [
            Failure(row, runs[row].parameters, runs[row].seed, *self._faults[row])
            for row in sorted(self._faults)
        ]
        if errors:
            first = errors[0]
            warnings.warn(
                f"{len(errors)} of {len(runs)} runs failed (see `errors`), the first: "
                f"{_told(runs[first.run])}: {first.error}",
                RuntimeWarning,
                stacklevel=3,
            )
        return Runs(
            [run.parameters for run in runs],
            [run.seed for run in runs],
            self._results,
            errors,
            _plan=self._plan,
            _experiment=self._experiment,
        )


def _level_of_caller() -> int:
    """How far above the caller of this is what is no part of sweeps: ``stacklevel`` of warnings."""
    frame, level = sys._getframe(1), 1
    while frame.f_globals.get("__name__", "").startswith(__name__) and frame.f_back is not None:
        frame, level = frame.f_back, level + 1
    return level


def _told(run: Run) -> str:
    """A run in words."""
    told = [f"{name} = {value!r}" for name, value in run.parameters.items()]
    if run.seed is not None:
        told.append(f"seed = {run.seed}")
    return f"run {run.row} ({', '.join(told)})"


class _Silence:
    """Shows nothing."""

    def __enter__(self) -> _Silence:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def update(self, count: int = 1) -> None:
        pass


def _progress_line(total: int, progress: bool | None) -> AbstractContextManager[Any]:
    """A line on stderr that tells how many runs there are."""
    if progress is False:
        return _Silence()
    try:
        from tqdm.auto import tqdm
    except ModuleNotFoundError:
        if progress is None:
            return _Silence()
        raise
    # To disable it by `None` is to do so where stderr is no terminal.
    line: AbstractContextManager[Any] = tqdm(
        total=total, unit="run", disable=False if progress else None
    )
    return line


def _check_choices(measure: object, version: object, on_error: object) -> None:
    if not callable(measure):
        raise TypeError(f"measure: must be a function, not a {type(measure).__name__}")
    if not isinstance(version, str):
        raise TypeError(f"version: must be text, not {type(version).__name__}")
    if on_error not in ("keep", "raise"):
        raise CaromError(f'on_error: must be "keep" or "raise", not {on_error!r}', "on_error")
