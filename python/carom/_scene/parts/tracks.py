"""Tracks, and the pieces of their paths.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from carom._scene.parts.kinds import Count, Finite, NonNegative, Positive
from carom._scene.parts.part import Part


@dataclass(frozen=True)
class Straight(Part):
    """Goes straight on.

    Attributes:
        length: In m, > 0.
    """

    tag: ClassVar[str] = "straight"
    length: Positive


@dataclass(frozen=True)
class Curve(Part):
    """Goes to the left or the right, with the slope that it begins with: an arc, or a helix.

    Attributes:
        radius: As seen from above [m], larger than that of the cross-section.
        degrees: How far it goes round [degrees], positive to the left.
        bank_degrees: How far the cross-section turns inward in its middle, so that the outer wall
            is higher [degrees]. By default 0.
    """

    tag: ClassVar[str] = "curve"
    radius: Positive
    degrees: Finite
    bank_degrees: Finite = 0.0


@dataclass(frozen=True)
class Bend(Part):
    """Goes upward or downward.

    One of 360 degrees with a shift is a loop.

    Attributes:
        radius: In m, larger than that of the cross-section.
        degrees: How much the slope changes [degrees], positive upward.
        shift: How far it comes to the left meanwhile [m]; negative to the right. By default 0.
    """

    tag: ClassVar[str] = "bend"
    radius: Positive
    degrees: Finite
    shift: Finite = 0.0


@dataclass(frozen=True)
class Gap(Part):
    """Has no gutter, to be jumped over.

    Attributes:
        length: Along the level [m], >= 0.
        drop: How much lower its end is [m]; negative for higher. By default 0.
        pitch_degrees: Slope at its end [degrees], positive upward. By default that of its
            beginning.
    """

    tag: ClassVar[str] = "gap"
    length: NonNegative
    drop: Finite = 0.0
    pitch_degrees: Finite | None = None


Piece: TypeAlias = Straight | Curve | Bend | Gap
"""A part of the path of a track."""


@dataclass(frozen=True)
class Track(Part):
    """A gutter along a path, as of a marble run.

    Attributes:
        radius: Radius of its round cross-section [m], > 0.
        pieces: Parts of the path, one after the other.
        arc_degrees: How much of a circle the cross-section is [degrees], > 0 and at most 360, a
            tube. By default 180.
        sides: Facets across, an odd number from 3 to 999, so that one of them is the lowest. By
            default 21.
        facet_degrees: Largest angle between neighbouring facets along the path [degrees], from 0.1
            to 45. By default 3.
        pitch_degrees: Slope at the beginning [degrees], positive upward. By default level.
    """

    tag: ClassVar[str] = "track"
    radius: Positive
    pieces: Sequence[Piece]
    arc_degrees: Positive = 180.0
    sides: Count = 21
    facet_degrees: Positive = 3.0
    pitch_degrees: Finite = 0.0
