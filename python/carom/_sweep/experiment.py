"""What is done in every run: a scene is made, and its world measured."""

from __future__ import annotations

import inspect
import time
import traceback
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from carom._scene.parts import DenseFluid, RandomFill
from carom._scene.scene import Scene
from carom.errors import CaromError

Maker: TypeAlias = Callable[..., Scene]
"""A function of parameters that gives a scene."""
Measured: TypeAlias = dict[str, NDArray[Any]]
"""What a run has measured, by name."""

SEED = "seed"
"""What a function calls the parameter that takes the seed of a run."""


class Run(NamedTuple):
    """What sets a run apart from the others."""

    row: int
    """Its place in the table."""
    parameters: Mapping[str, Any]
    seed: int | None
    """``None`` where the scene keeps its own."""


class Fault(NamedTuple):
    """Why a run has measured nothing."""

    error: str
    traceback: str


class Outcome(NamedTuple):
    """What became of a run."""

    row: int
    result: Measured | Fault


@dataclass(frozen=True)
class Written:
    """The text of a scene file, whose parameters are changed by their names."""

    text: str
    source: str
    """What errors call it."""


@dataclass(frozen=True)
class Experiment:
    """A scene, a measurement, and which parameters go where.

    Attributes:
        scene: Where every run begins, or what makes it.
        measure: Takes a world, and answers with what it measured.
        to_scene: Parameters of the function that makes the scene.
        to_measure: Parameters of ``measure``.
        paths: Parameters that are values in the scene.
    """

    scene: Scene | Written | Maker
    measure: Callable[..., Any]
    to_scene: frozenset[str]
    to_measure: frozenset[str]
    paths: frozenset[str]

    def scene_of(self, run: Run) -> Scene:
        """The scene at the start of a run."""
        changes = {name: run.parameters[name] for name in sorted(self.paths)}
        if isinstance(self.scene, Written):
            made = Scene.from_toml(self.scene.text, source=self.scene.source, changes=changes)
        else:
            made = self.scene if isinstance(self.scene, Scene) else self._made(self.scene, run)
            made = made.with_changes(changes) if changes else made
        if run.seed is None or SEED in self.to_scene or not _is_random(made):
            return made
        return made.with_seed(run.seed)

    def _made(self, make: Maker, run: Run) -> Scene:
        made = make(**_chosen(run, self.to_scene))
        if not isinstance(made, Scene):
            kind = type(made).__name__
            raise TypeError(f"scene: the function returned a {kind}, not a carom.Scene")
        return made

    def takes_seeds(self, run: Run) -> bool:
        """Whether runs with other seeds are other runs."""
        if SEED in self.to_scene or SEED in self.to_measure:
            return True
        return _is_random(self.scene_of(run))

    def perform(self, run: Run) -> Measured:
        """Makes the world of a run, and measures it."""
        world = self.scene_of(run).world()
        value = self.measure(world, **_chosen(run, self.to_measure))
        named = value if isinstance(value, Mapping) else {"value": value}
        taken = {*run.parameters, "repeat", "sample", SEED}
        return {str(name): _numbers(item, str(name), taken) for name, item in named.items()}


def experiment(
    scene: Scene | Written | Maker, measure: Callable[..., Any], names: Iterable[str]
) -> Experiment:
    """Finds out what takes which parameters, and the seed.

    Raises:
        TypeError: If nothing takes one of them.
    """
    names = frozenset(names)
    to_scene: frozenset[str] = frozenset()
    if not isinstance(scene, Scene | Written):
        to_scene = _taken(scene, {*names, SEED}, skip=0)
    to_measure = _taken(measure, {*names, SEED}, skip=1)
    left = names - to_scene - to_measure
    for name in sorted(left):
        if not isinstance(scene, Scene | Written) and "." not in name:
            raise TypeError(
                f"{name}: neither the function that makes the scene nor measure takes it"
            )
    return Experiment(scene, measure, to_scene, to_measure, left)


def perform(experiment: Experiment, runs: Iterable[Run]) -> tuple[list[Outcome], float]:
    """Performs runs one after the other, and says how long it took [s].

    A run that fails leaves its fault, and does not stop the others.
    """
    begin = time.perf_counter()
    outcomes = []
    for run in runs:
        try:
            outcomes.append(Outcome(run.row, experiment.perform(run)))
        except Exception as error:
            outcomes.append(Outcome(run.row, fault(error)))
    return outcomes, time.perf_counter() - begin


def fault(error: BaseException) -> Fault:
    """An exception in words, which can go anywhere."""
    lines = traceback.format_exception(type(error), error, error.__traceback__)
    return Fault(f"{type(error).__name__}: {error}", "".join(lines))


def _taken(function: Callable[..., Any], names: set[str], skip: int) -> frozenset[str]:
    """Which of some names a function takes as keywords, its first parameters left out."""
    try:
        parameters = list(inspect.signature(function).parameters.values())[skip:]
    except ValueError:
        # Functions of C may tell nothing.
        return frozenset()
    kinds = (inspect.Parameter.POSITIONAL_OR_KEYWORD, inspect.Parameter.KEYWORD_ONLY)
    if any(it.kind is inspect.Parameter.VAR_KEYWORD for it in parameters):
        return frozenset(name for name in names if "." not in name)
    return frozenset(it.name for it in parameters if it.kind in kinds and it.name in names)


def _chosen(run: Run, names: frozenset[str]) -> dict[str, Any]:
    """The parameters of a run with these names, and the seed."""
    values = dict(run.parameters)
    if run.seed is not None:
        values[SEED] = run.seed
    return {name: value for name, value in values.items() if name in names}


def _is_random(scene: Scene) -> bool:
    """Whether a seed makes another scene of it."""
    return any(isinstance(generator, (RandomFill, DenseFluid)) for generator in scene.generators)


def _numbers(value: object, name: str, taken: set[str]) -> NDArray[Any]:
    """A copy of what was measured; arrays of a world change with it."""
    if name in taken:
        raise CaromError(f"measure: {name!r} is the name of a parameter", "measure")
    try:
        array = np.array(value)
    except ValueError:
        raise CaromError(f"measure: {name!r} has rows of different lengths", "measure") from None
    if array.dtype.kind not in "biufc":
        kind = type(value).__name__
        raise CaromError(f"measure: {name!r} must be numbers, not a {kind}", "measure")
    return array
