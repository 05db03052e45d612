"""Many spheres of a scene, as arrays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from operator import index as as_index
from typing import Any, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._scene.labels import LABELS, labels_of
from carom._scene.parts import Finish, Sphere
from carom.errors import CaromError

_Labels: TypeAlias = Sequence[NDArray[np.uint64] | None]

GivenPoints: TypeAlias = tuple[
    int, Sequence[ArrayLike | None], ArrayLike | None, Sequence[Finish] | None, _Labels
]
"""Spheres for the engine: their number, quantities, colours, finishes and labels."""

TakenPoints: TypeAlias = tuple[
    Sequence[NDArray[np.float64]], NDArray[np.float64] | None, Sequence[Finish] | None, _Labels
]
"""Spheres from the engine: quantities, colours, finishes and labels."""

_WIDTHS = {
    "positions": 3,
    "velocities": 3,
    "radii": 1,
    "masses": 1,
    "restitutions": 1,
    "orientations": 4,
    "angular_velocities": 3,
    "inertia_factors": 1,
    "frictions": 1,
    "rolling_frictions": 1,
    "spinning_frictions": 1,
    "tangential_restitutions": 1,
}
"""Numbers of each quantity of a sphere, in the order in which the engine takes them."""

_SAYS_NOTHING = ("frictions", "rolling_frictions", "spinning_frictions", "tangential_restitutions")
"""Quantities of which nan says nothing."""


class Points(Sequence[Sphere]):
    """Spheres of a scene as arrays: a hundred thousand of them take a hundredth of a second.

    It stands where a scene has ``spheres``. It can be read like a list of `Sphere`, each of which
    is made when it is read. Arrays are copied, and cannot be written to afterwards.

    Args:
        positions: Centres [m], shape (n, 3).
        radii: Radii [m], > 0, spread to shape (n,).
        velocities: Velocities [m/s], spread to shape (n, 3); at rest unless given.
        masses: Masses [kg], > 0, spread to shape (n,); 1 unless these or ``densities`` are given.
        densities: Densities [kg/m³], > 0, spread to shape (n,), instead of masses.
        restitutions: Coefficients of restitution in [0, 1], spread to shape (n,); 1 unless given.
        orientations: How they are turned, quaternions x, y, z, w, spread to shape (n, 4).
        angular_velocities: Angular velocities, along the axes [rad/s], spread to shape (n, 3).
        inertia_factors: Moments of inertia divided by m r², > 0, spread to shape (n,); 0.4 unless
            given.
        frictions: Coefficients of friction, >= 0, spread to shape (n,); nan, as all are unless
            given, says nothing of it.
        rolling_frictions: Coefficients of rolling friction, as ``frictions``.
        spinning_frictions: Coefficients of spinning friction, as ``frictions``.
        tangential_restitutions: Coefficients of tangential restitution in [0, 1], as ``frictions``.
        colors: Red, green, blue, each in [0, 1], spread to shape (n, 3); nan for none of its own.
        finishes: How their surfaces take light, one for each or one for all; satin unless given.
        groups: Groups that they are in, one bit for each of 32, spread to shape (n,); the first
            unless given.
        collides_with: Groups that they collide with, one bit for each, spread to shape (n,); all
            unless given.
        user_data: Whole numbers for programs to find them by, spread to shape (n,); 0 unless given.

    Raises:
        CaromError: For shapes that do not fit, and numbers that are not finite. What else makes no
            sense, the scene refuses, by the number of the sphere.
        TypeError: For arrays that are not of numbers.

    >>> import carom, numpy
    >>> places = numpy.indices((4, 5, 5)).reshape(3, -1).T
    >>> crystal = carom.Points(places, radii=0.4)
    >>> len(crystal), crystal[99].position
    (100, (3.0, 4.0, 4.0))
    >>> world = carom.Scene(name="crystal", spheres=crystal).world()
    >>> world.positions.shape
    (100, 3)
    """

    __slots__ = ("_arrays", "_colors", "_count", "_finishes", "_labels")

    def __init__(
        self,
        positions: ArrayLike,
        radii: ArrayLike,
        *,
        velocities: ArrayLike | None = None,
        masses: ArrayLike | None = None,
        densities: ArrayLike | None = None,
        restitutions: ArrayLike | None = None,
        orientations: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
        inertia_factors: ArrayLike | None = None,
        frictions: ArrayLike | None = None,
        rolling_frictions: ArrayLike | None = None,
        spinning_frictions: ArrayLike | None = None,
        tangential_restitutions: ArrayLike | None = None,
        colors: ArrayLike | None = None,
        finishes: Finish | Sequence[Finish] | None = None,
        groups: ArrayLike | None = None,
        collides_with: ArrayLike | None = None,
        user_data: ArrayLike | None = None,
    ) -> None:
        self._count = count_of(positions)
        given = {
            "positions": positions,
            "velocities": velocities,
            "radii": radii,
            "masses": masses,
            "restitutions": restitutions,
            "orientations": orientations,
            "angular_velocities": angular_velocities,
            "inertia_factors": inertia_factors,
            "frictions": frictions,
            "rolling_frictions": rolling_frictions,
            "spinning_frictions": spinning_frictions,
            "tangential_restitutions": tangential_restitutions,
        }
        self._arrays: dict[str, NDArray[np.float64]] = {
            name: spread(name, values, self._count, _WIDTHS[name])
            for name, values in given.items()
            if values is not None
        }
        labels = {"groups": groups, "collides_with": collides_with, "user_data": user_data}
        self._labels = {
            name: labels_of(name, values, self._count)
            for name, values in labels.items()
            if values is not None
        }
        if densities is not None:
            if masses is not None:
                raise CaromError("densities: give masses or densities", "densities")
            own = spread("densities", densities, self._count, 1)
            self._arrays["masses"] = _frozen(masses_of(own, self._arrays["radii"]))
        self._colors = None if colors is None else spread("colors", colors, self._count, 3)
        one_for_all = (finishes,) * self._count if isinstance(finishes, str) else finishes
        self._finishes = None if one_for_all is None else tuple(one_for_all)
        if self._finishes is not None and len(self._finishes) != self._count:
            problem = f"must be {self._count}, not {len(self._finishes)}"
            raise CaromError(f"finishes: {problem}", "finishes")

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Sphere: ...
    @overload
    def __getitem__(self, index: slice | NDArray[Any]) -> Points: ...
    def __getitem__(self, index: int | slice | NDArray[Any]) -> Sphere | Points:
        if isinstance(index, (slice, np.ndarray)):
            part = {name: values[index] for name, values in self._arrays.items()}
            labels = {name: values[index] for name, values in self._labels.items()}
            return Points(
                **part,
                **labels,
                colors=None if self._colors is None else self._colors[index],
                finishes=None
                if self._finishes is None
                else np.array(self._finishes)[index].tolist(),
            )
        number = as_index(index)
        if not -self._count <= number < self._count:
            raise IndexError(f"there are {self._count} spheres")
        return self._sphere(number % self._count)

    def __iter__(self) -> Iterator[Sphere]:
        return (self._sphere(number) for number in range(self._count))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Sequence) or isinstance(other, str):
            return NotImplemented
        return len(self) == len(other) and all(
            one == another for one, another in zip(self, other, strict=True)
        )

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return f"<carom.Points: {self._count} spheres>"

    def __reduce__(self) -> tuple[Any, ...]:
        return _made, (self._arrays, self._colors, self._finishes, self._labels)

    @property
    def colors(self) -> NDArray[np.float64] | None:
        """Red, green, blue of each, shape (n, 3), if any were given; nan for none of its own."""
        return self._colors

    @property
    def finishes(self) -> tuple[Finish, ...] | None:
        """How their surfaces take light, if that was given."""
        return self._finishes

    def __getattr__(self, name: str) -> NDArray[Any]:
        """The array of a quantity, as it was given; an `AttributeError` for one that was not."""
        if name in _WIDTHS and name in self._arrays:
            return self._arrays[name]
        if name in LABELS and name in self._labels:
            return self._labels[name]
        raise AttributeError(f"these carom.Points have no {name!r}")

    def _sphere(self, number: int) -> Sphere:
        values: dict[str, Any] = {}
        for name, column in self._arrays.items():
            value = column[number].tolist()
            if name not in _SAYS_NOTHING or not math.isnan(value):
                values[_SINGULAR[name]] = tuple(value) if isinstance(value, list) else value
        if self._colors is not None and not np.isnan(self._colors[number]).any():
            values["color"] = tuple(self._colors[number].tolist())
        if self._finishes is not None:
            values["finish"] = self._finishes[number]
        values.update({name: int(labels[number]) for name, labels in self._labels.items()})
        return Sphere(**values)

    def _given(self) -> GivenPoints:
        """What the engine takes."""
        columns = [self._arrays.get(name) for name in _WIDTHS]
        finishes = None if self._finishes is None else list(self._finishes)
        labels = [self._labels.get(name) for name in LABELS]
        return (self._count, columns, self._colors, finishes, labels)

    @classmethod
    def _told(
        cls,
        columns: Sequence[NDArray[np.float64]],
        colors: NDArray[np.float64] | None,
        finishes: Sequence[Finish] | None,
        labels: Sequence[NDArray[np.uint64] | None],
    ) -> Points:
        """The spheres that the engine tells of; what none of them says anything of is left out."""
        named = dict(zip(_WIDTHS, columns, strict=True))
        usual = {"orientations": (0, 0, 0, 1), "angular_velocities": 0, "inertia_factors": 0.4}
        for name, value in usual.items():
            if (named[name] == value).all():
                del named[name]
        for name in _SAYS_NOTHING:
            if np.isnan(named[name]).all():
                del named[name]
        own = zip(LABELS, labels, strict=True)
        told = {name: values for name, values in own if values is not None}
        return _made(named, colors, finishes, told)


_SINGULAR = {
    "positions": "position",
    "velocities": "velocity",
    "radii": "radius",
    "masses": "mass",
    "restitutions": "restitution",
    "orientations": "orientation",
    "angular_velocities": "angular_velocity",
    "inertia_factors": "inertia_factor",
    "frictions": "friction",
    "rolling_frictions": "rolling_friction",
    "spinning_frictions": "spinning_friction",
    "tangential_restitutions": "tangential_restitution",
}
"""What a sphere calls its own."""


def _made(
    arrays: dict[str, NDArray[np.float64]],
    colors: NDArray[np.float64] | None,
    finishes: Sequence[Finish] | None,
    labels: dict[str, NDArray[np.uint64]],
) -> Points:
    return Points(**arrays, colors=colors, finishes=finishes, **labels)


def count_of(positions: ArrayLike) -> int:
    """How many spheres there are; 1 for shapes that are refused later."""
    try:
        shape = np.shape(positions)
    except ValueError:
        # Rows of different lengths.
        return 1
    return 0 if shape == (0,) else shape[0] if len(shape) == 2 else 1


def spread(name: str, values: ArrayLike, count: int, width: int) -> NDArray[np.float64]:
    """A quantity of all spheres, a copy that cannot be written to.

    Raises:
        CaromError: For a shape that does not fit, and for numbers that are not finite.
        TypeError: For what are no numbers.
    """
    shape = (count,) if width == 1 else (count, width)
    try:
        array = np.asarray(values)
    except ValueError:
        raise TypeError(
            f"{name}: must be an array of numbers, not rows of different lengths"
        ) from None
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: must be an array of numbers, not of {array.dtype}")
    if array.shape == (0,) and count == 0:
        array = array.reshape(shape)
    if array.ndim == 2 and array.shape[1] != width:
        # No number for all axes.
        raise CaromError(f"{name}: must be of shape {shape}, not {array.shape}", name)
    try:
        whole = np.array(np.broadcast_to(array, shape), dtype=np.float64, order="C")
    except ValueError:
        raise CaromError(f"{name}: must be of shape {shape}, not {array.shape}", name) from None
    good = np.isfinite(whole)
    if name in _SAYS_NOTHING or name == "colors":
        good |= np.isnan(whole)
    if not good.all():
        row = int(np.argwhere(~good)[0, 0])
        field = f"{name}[{row}]"
        raise CaromError(f"{field}: must be finite, not {whole[row].tolist()}", field)
    return _frozen(whole)


def masses_of(densities: NDArray[np.float64], radii: NDArray[np.float64]) -> NDArray[np.float64]:
    """Masses [kg] of balls, in the engine's own order of operations."""
    masses: NDArray[np.float64] = densities * (4.0 / 3.0 * np.pi * (radii * radii * radii))
    return masses


def _frozen(array: NDArray[np.float64]) -> NDArray[np.float64]:
    array.flags.writeable = False
    return array
