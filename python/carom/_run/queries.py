"""Queries of a world between steps: rays, what is near, and the path that a sphere will take."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import Engine, Path
from carom._run import tables
from carom._run.strict import Strict
from carom._scene.labels import GROUPS, whole
from carom.errors import CaromError


@dataclass(frozen=True, kw_only=True)
class QueryFilter:
    """Which bodies a query finds: by default spheres and colliders, but no triggers.

    Attributes:
        spheres: Whether it finds spheres.
        colliders: Whether it finds colliders that deflect.
        triggers: Whether it finds triggers.
        without_sphere: Id of a sphere that it passes over.
        groups: Groups that it is in, one bit for each, as if it were a body; by default all.
        collides_with: Groups that it collides with, one bit for each; by default all.

    Raises:
        CaromError: For groups that are not in [0, 2^32), and an id that is negative.
        TypeError: For values of other types.

    >>> import carom
    >>> only_walls = carom.QueryFilter(spheres=False)
    """

    spheres: bool = True
    colliders: bool = True
    triggers: bool = False
    without_sphere: int | None = None
    groups: int = GROUPS - 1
    collides_with: int = GROUPS - 1

    def __post_init__(self) -> None:
        for name in ("spheres", "colliders", "triggers"):
            value = getattr(self, name)
            if not isinstance(value, (bool, np.bool_)):
                raise TypeError(f"{name}: must be True or False, not {type(value).__name__}")
            object.__setattr__(self, name, bool(value))
        for name in ("groups", "collides_with"):
            object.__setattr__(self, name, whole(name, getattr(self, name), GROUPS))
        if self.without_sphere is not None:
            number = whole("without_sphere", self.without_sphere, 2**64)
            object.__setattr__(self, "without_sphere", number)


EVERYTHING = QueryFilter()
"""The filter of a query unless one is given."""

PathEnd: TypeAlias = Literal["horizon", "impacts", "no closed form"]
"""Where a predicted path ends."""


class PredictedPath(Strict):
    """The path of a sphere as `World.predict` predicts it."""

    __slots__ = ("_path",)

    def __init__(self, path: Path) -> None:
        self._path = path

    def __repr__(self) -> str:
        return f"<carom.PredictedPath to {self.end_time} s, {len(self.impacts)} impacts>"

    @property
    def impacts(self) -> NDArray[np.void]:
        """Impacts of the sphere on the way, records of `carom.IMPACT`. A copy."""
        return tables.records(self._path.impact_words(), tables.IMPACT)

    @property
    def legs(self) -> NDArray[np.void]:
        """Flights from event to event without gaps, records of `carom.LEG`. A copy."""
        return tables.records(self._path.leg_words(), tables.LEG)

    @property
    def end(self) -> PathEnd:
        """Where it ends.

        ``"horizon"``: at the end of the time asked for. ``"impacts"``: at the last impact asked
        for. ``"no closed form"``: where a step would take the sphere in a stepped zone.
        """
        return self._path.end

    @property
    def end_time(self) -> float:
        """When it ends, on the world's clock [s]."""
        return self._path.end_time

    def positions_at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Centres [m] at times on the world's clock [s], of any shape (...), shape (..., 3).

        In a periodic box they are within it; nan outside of the path; at an event after it.
        """
        given = _numbers("times", times)
        return self._path.positions_at(given.ravel()).reshape(*given.shape, 3)

    def velocities_at(self, times: ArrayLike) -> NDArray[np.float64]:
        """Velocities [m/s] at times on the world's clock [s], of any shape (...), shape (..., 3).

        nan outside of the path; at an event after it.
        """
        given = _numbers("times", times)
        return self._path.velocities_at(given.ravel()).reshape(*given.shape, 3)


class Queries(Engine):
    """A world as far as it can be asked; `carom.World` moves.

    Nothing here changes the world. Many queries in one call are much faster than as many calls:
    they sort the bodies once.
    """

    def cast_ray(
        self, origins: ArrayLike, ways: ArrayLike, *, filter: QueryFilter = EVERYTHING
    ) -> NDArray[np.void]:
        """What rays meet first that start at ``origins`` and lead along ``ways`` to their ends.

        A rectangle is met from its front only. Of several bodies at one place it is a sphere before
        a collider, and the one with the smallest id. A ray that starts in a body meets it at
        fraction 0.

        Args:
            origins: Where they start [m], shape (..., 3).
            ways: From there to their ends [m], shape (..., 3); both are spread to one shape.
            filter: What they can meet.

        Returns:
            Records of `carom.HIT`, one for each ray, shape (...).

        Raises:
            CaromError: If a number is not finite, shapes do not fit, or a ray crosses more than
                65,536 periodic boxes; of one of many rays with its number.

        >>> import carom
        >>> world = carom.World()
        >>> ball = world.add_sphere(carom.Sphere(position=(5, 0, 0), radius=1))
        >>> hits = world.cast_ray((0, 0, 0), [(8, 0, 0), (0, 8, 0)])
        >>> hits["sphere"].tolist(), hits["fraction"].tolist()
        ([0, -1], [0.5, inf])
        """
        _expect_filter(filter)
        starts, leads = _vectors("origins", origins), _vectors("ways", ways)
        shape = _common("ways", starts.shape[:-1], leads.shape[:-1])
        words = self._cast_rays(_rows(starts, shape), _rows(leads, shape), filter)
        return tables.records(words, tables.HIT).reshape(shape)

    def cast_sphere(
        self,
        centers: ArrayLike,
        radii: ArrayLike,
        ways: ArrayLike,
        *,
        filter: QueryFilter = EVERYTHING,
    ) -> NDArray[np.void]:
        """What spheres meet first that move straight from ``centers`` along ``ways`` to their ends.

        Args:
            centers: Where they start [m], shape (..., 3).
            radii: Their radii [m], > 0, shape (...).
            ways: From there to their ends [m], shape (..., 3); all are spread to one shape.
            filter: What they can meet.

        Returns:
            Records of `carom.HIT`, one for each sphere, shape (...).

        Raises:
            CaromError: As `cast_ray`, and if a radius is not positive or, in a periodic box, larger
                than its shortest edge.
        """
        _expect_filter(filter)
        starts, leads = _vectors("centers", centers), _vectors("ways", ways)
        own = _numbers("radii", radii)
        shape = _common("ways", starts.shape[:-1], leads.shape[:-1])
        shape = _common("radii", shape, own.shape)
        sizes = np.broadcast_to(own, shape).ravel()
        words = self._cast_spheres(_rows(starts, shape), sizes, _rows(leads, shape), filter)
        return tables.records(words, tables.HIT).reshape(shape)

    def nearest(
        self,
        points: ArrayLike,
        *,
        within: float = np.inf,
        filter: QueryFilter = EVERYTHING,
    ) -> NDArray[np.void]:
        """The bodies nearest to points.

        A rectangle is not there for points behind it.

        Args:
            points: Places [m], shape (..., 3).
            within: How far their surfaces may be away [m].
            filter: What is looked for.

        Returns:
            Records of `carom.NEAR`, one for each point, shape (...).

        Raises:
            CaromError: If a point is not finite, or ``within`` is negative or no number.
        """
        _expect_filter(filter)
        places = _vectors("points", points)
        shape = places.shape[:-1]
        words = self._nearest(_rows(places, shape), _number("within", within), filter)
        return tables.records(words, tables.NEAR).reshape(shape)

    def overlapping(
        self, centers: ArrayLike, radii: ArrayLike, *, filter: QueryFilter = EVERYTHING
    ) -> NDArray[np.void]:
        """The bodies that touch or overlap spheres; `overlaps` has those of the world itself.

        Args:
            centers: Centres [m], shape (..., 3).
            radii: Radii [m], > 0, shape (...); both are spread to one shape.
            filter: What is looked for.

        Returns:
            Records of `carom.OVERLAPPING`: for each sphere first the spheres, then the colliders
            that it overlaps, both in order of ids, each once.

        Raises:
            CaromError: If a centre is not finite, a radius not positive or, in a periodic box,
                larger than its shortest edge.
        """
        _expect_filter(filter)
        places, own = _vectors("centers", centers), _numbers("radii", radii)
        shape = _common("radii", places.shape[:-1], own.shape)
        sizes = np.broadcast_to(own, shape).ravel()
        words = self._overlapping(_rows(places, shape), sizes, filter)
        return tables.records(words, tables.OVERLAPPING)

    def predict(self, sphere: int, horizon: float, *, most_impacts: int = 10_000) -> PredictedPath:
        """Predicts the path of a sphere without a step: flights in closed form, and what it meets.

        The other spheres keep to the flights that they are on, but for those that the sphere
        strikes. While nothing else interferes, steps under the rule ``exact`` give the same places,
        velocities and impacts to the bit. Under other rules the path is that of ``exact``. Emitters
        emit nothing. Other threads run meanwhile.

        Args:
            sphere: Its id.
            horizon: For how long [s].
            most_impacts: Up to its impact of this number: ``end`` of the path tells.

        Raises:
            UnknownError: If the sphere is not in the world (any more).
            CaromError: If the horizon is not positive and finite; with springs, and forces that are
                functions or not linear, whose motion has no closed form.

        >>> import carom
        >>> world = carom.World()
        >>> _ = world.add_force(carom.Gravity((0, -10, 0)))
        >>> _ = world.add_collider(carom.Collider(carom.HalfSpace()))
        >>> ball = world.add_sphere(carom.Sphere(position=(0, 1.05, 0), radius=1))
        >>> path = world.predict(ball, 0.25)
        >>> world.step(dt=0.25)
        >>> bool((path.positions_at(0.25) == world.positions[0]).all())
        True
        """
        return PredictedPath(self._predict(sphere, horizon, most_impacts))


def _expect_filter(filter: QueryFilter) -> None:
    if not isinstance(filter, QueryFilter):
        raise TypeError(f"filter: must be a carom.QueryFilter, not {type(filter).__name__}")


def _number(name: str, value: float) -> float:
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.number)):
        raise TypeError(f"{name}: must be a number, not {type(value).__name__}")
    return float(value)


def _numbers(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """An array of numbers.

    Raises:
        TypeError: For what are no numbers.
    """
    try:
        array = np.asarray(values)
    except ValueError:
        problem = "must be an array of numbers, not rows of different lengths"
        raise TypeError(f"{name}: {problem}") from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: must be an array of numbers, not of {array.dtype}")
    return array.astype(np.float64)


def _vectors(name: str, values: ArrayLike) -> NDArray[np.float64]:
    """An array of vectors, shape (..., 3).

    Raises:
        CaromError: For another shape.
        TypeError: For what are no numbers.
    """
    array = _numbers(name, values)
    if array.shape == (0,):
        return np.empty((0, 3))
    if array.ndim == 0 or array.shape[-1] != 3:
        raise CaromError(f"{name}: must be of shape (..., 3), not {array.shape}", name)
    return array


def _common(name: str, one: tuple[int, ...], other: tuple[int, ...]) -> tuple[int, ...]:
    """The shape that both are spread to.

    Raises:
        CaromError: If there is none.
    """
    try:
        return np.broadcast_shapes(one, other)
    except ValueError:
        raise CaromError(f"{name}: must fit the shape {one}, not {other}", name) from None


def _rows(vectors: NDArray[np.float64], shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Vectors spread to a shape, as rows."""
    return np.ascontiguousarray(np.broadcast_to(vectors, (*shape, 3)).reshape(-1, 3))
