"""Kinds of values that the fields of parts take, each with what makes sense of it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Annotated, Any, TypeAlias

from numpy.typing import NDArray

from carom._scene.checks import ColorText, Numbers, Requirement, Rows, Turn


def _are_finite(values: Sequence[float]) -> bool:
    return all(map(math.isfinite, values))


def _is_turn(values: Sequence[float]) -> bool:
    """Whether numbers are a direction: below this length their squares underflow."""
    return _TINIEST <= sum(value * value for value in values) < math.inf


_TINIEST = 2.0**-1022
_FINITE = Requirement("finite", _are_finite)
_POSITIVE = Requirement("positive and finite", lambda value: 0 < value < math.inf)
_AT_LEAST_ONE = Requirement("at least 1", lambda value: value >= 1)
_IN_32_BITS = Requirement("in [0, 2^32)", lambda value: 0 <= value < 2**32)
_ALL_POSITIVE = Requirement(
    "positive and finite along every axis", lambda it: _are_finite(it) and min(it) > 0
)
_FIELD_OF_VIEW = Requirement("between 0 and 180", lambda value: 0 < value < 180)
_QUATERNION = Requirement("a quaternion x, y, z, w that is finite and not zero", _is_turn)
_THREE = Numbers("three numbers", 3)

Numeric: TypeAlias = Sequence[float] | NDArray[Any]
"""Numbers in a row."""
Vector: TypeAlias = Annotated[Numeric, _THREE, _FINITE]
"""Three numbers x, y, z."""
TwoNames: TypeAlias = Sequence[str]
"""Names of two materials."""
Vertices: TypeAlias = Annotated[Sequence[Vector] | NDArray[Any], Rows(Vector)]
"""Places x, y, z [m], one a row."""
Triangles: TypeAlias = Annotated[
    Sequence[Sequence[int]] | NDArray[Any],
    Rows(Annotated[Numeric, Numbers("three numbers of vertices", 3, are_whole=True)]),
]
"""Three numbers of vertices each, one triangle a row."""
Heights: TypeAlias = Annotated[
    Sequence[Numeric] | NDArray[Any], Rows(Annotated[Numeric, Numbers("numbers")])
]
"""Rows of heights [m]."""
Lengths: TypeAlias = Annotated[Numeric, _THREE, _ALL_POSITIVE]
"""Lengths along x, y, z [m], each > 0."""
Period: TypeAlias = Annotated[
    Numeric,
    _THREE,
    Requirement(
        "positive along every axis; infinite where it is open",
        lambda values: all(value > 0 for value in values),
    ),
]
"""Edges of a periodic box [m], each > 0, infinite along an axis that is open."""
Direction: TypeAlias = Annotated[
    Numeric, _THREE, Requirement("a direction that is finite and not zero", _is_turn)
]
"""A vector of any length but zero."""
Quaternion: TypeAlias = Annotated[Numeric, Numbers("four numbers", 4), _QUATERNION, Turn]
"""A rotation x, y, z, w."""
Elevation: TypeAlias = Annotated[float, Requirement("in [0, 90]", lambda value: 0 <= value <= 90)]
"""An angle above the horizon in degrees, in [0, 90]."""
CueOffset: TypeAlias = Annotated[
    Sequence[float],
    Numbers("two numbers", 2),
    Requirement("below 1 in size, on the sphere", lambda it: math.hypot(*it) < 1),
]
"""Offset of a cue to the right and up, in parts of the radius."""
Rotations: TypeAlias = Annotated[Sequence[Quaternion] | NDArray[Any], Rows(Quaternion)]
"""Rotations x, y, z, w, one a row."""
Times: TypeAlias = Annotated[Numeric, Numbers("numbers")]
"""Times in a row [s]."""
Color: TypeAlias = Annotated[
    Sequence[float] | str,
    _THREE,
    Requirement("three parts in [0, 1]", lambda values: all(0 <= value <= 1 for value in values)),
    ColorText,
]
"""Red, green, blue, each in [0, 1] (sRGB), or a text like ``"red"`` or ``"#c0392b"``."""
Positive: TypeAlias = Annotated[float, _POSITIVE]
"""A number > 0."""
Fraction: TypeAlias = Annotated[float, Requirement("between 0 and 1", lambda value: 0 < value < 1)]
"""A number > 0 and < 1."""
NonNegative: TypeAlias = Annotated[
    float, Requirement("zero or positive, and finite", lambda value: 0 <= value < math.inf)
]
"""A number >= 0."""
Finite: TypeAlias = Annotated[float, Requirement("finite", math.isfinite)]
"""Any finite number."""
Restitution: TypeAlias = Annotated[float, Requirement("in [0, 1]", lambda value: 0 <= value <= 1)]
"""A number in [0, 1]."""
FrequencyRatio: TypeAlias = Annotated[
    float, Requirement("in [1, 2]", lambda value: 1 <= value <= 2)
]
"""A number in [1, 2]."""
NonAdditivity: TypeAlias = Annotated[
    float, Requirement("in [-0.9, 9]", lambda value: -0.9 <= value <= 9)
]
"""A number in [-0.9, 9]."""
Count: TypeAlias = Annotated[int, _AT_LEAST_ONE, _IN_32_BITS]
"""A whole number >= 1."""
Number: TypeAlias = Annotated[int, _IN_32_BITS]
"""The number of a sphere, from 0."""
LargeNumber: TypeAlias = Annotated[
    int, Requirement("in [0, 2^63)", lambda value: 0 <= value < 2**63)
]
"""A whole number for programs, >= 0."""
Seed: TypeAlias = Annotated[int, _IN_32_BITS]
"""The seed of something random."""
FieldOfView: TypeAlias = Annotated[float, _FIELD_OF_VIEW]
"""An angle in degrees, in (0, 180)."""
Ends: TypeAlias = Annotated[
    Sequence[float],
    Numbers("two numbers", 2),
    Requirement("the smaller first", lambda ends: ends[0] < ends[1]),
]
"""The ends of a slider."""
TwoNumbers: TypeAlias = Annotated[
    Sequence[int] | NDArray[Any],
    Numbers("two whole numbers", 2, are_whole=True),
    Requirement("in [0, 2^32) each", lambda values: all(0 <= value < 2**32 for value in values)),
]
"""The numbers of two spheres, from 0."""
Counts: TypeAlias = Annotated[
    Sequence[int],
    Numbers("whole numbers", are_whole=True),
    Requirement("at least 1 each", lambda values: all(value >= 1 for value in values)),
    Requirement("in [0, 2^32) each", lambda values: all(value < 2**32 for value in values)),
]
"""Whole numbers, each >= 1."""
ThreeCounts: TypeAlias = Annotated[Counts, Numbers("three whole numbers", 3, are_whole=True)]
"""How many along x, y and z, each >= 1."""
RadiusRange: TypeAlias = Annotated[
    Sequence[float],
    Numbers("two numbers", 2),
    Requirement("two positive radii in order", lambda it: 0 < it[0] <= it[1] < math.inf),
]
"""Smallest and largest radius [m]."""
ORIGIN: tuple[float, float, float] = (0.0, 0.0, 0.0)
"""The default of positions and velocities."""
UNTURNED: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)
"""The default of turns."""
