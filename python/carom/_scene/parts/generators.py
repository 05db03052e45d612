"""Where many spheres or colliders come from: emitters and generators.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

from carom._scene.parts.colliders import Collider
from carom._scene.parts.kinds import (
    ORIGIN,
    UNTURNED,
    Count,
    Counts,
    Direction,
    EmissionPeriod,
    NonNegative,
    Positive,
    Quaternion,
    RadiusRange,
    Seed,
    ThreeCounts,
    Vector,
)
from carom._scene.parts.part import Part
from carom._scene.parts.spheres import SizedSphere, Sphere
from carom._scene.parts.together import expect_makings, expect_sizes


@dataclass(frozen=True)
class Emitter(Part):
    """Emits a sphere at the times 0, period, 2 period, ..., ``count`` in all.

    Attributes:
        sphere: What is emitted.
        period: Time between two spheres [s], > 0.
        position: Where spheres appear [m].
        rotation: How the emitter, and with it the velocity of its spheres, is turned.
        max_spheres: With this many of its spheres alive, the oldest makes place; no limit where it
            is missing.
        needs_room: Whether a sphere is left out that would overlap another one; so under the rule
            ``contact`` where it is missing.
        name: What it is called.
        count: How many spheres it emits in all, those left out among them; no end where it is
            missing.
    """

    sphere: SizedSphere
    period: EmissionPeriod
    position: Vector = ORIGIN
    rotation: Quaternion = UNTURNED
    max_spheres: Count | None = None
    needs_room: bool | None = None
    name: str = ""
    count: Count | None = None


@dataclass(frozen=True)
class Row(Part):
    """Spheres or colliders one after the other along a line.

    Attributes:
        count: How many, >= 1.
        start: Centre of the first [m].
        step: From each centre to the next [m].
        sphere: What spheres have in common. Give this or ``collider``.
        collider: What colliders have in common; its position is an offset, its name gets its
            number. Give this or ``sphere``.
    """

    tag: ClassVar[str] = "row"
    count: Count
    start: Vector
    step: Vector
    sphere: SizedSphere | None = None
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_makings(self)


@dataclass(frozen=True)
class Lattice(Part):
    """Spheres or colliders on a box-shaped lattice; x runs fastest, then y, then z.

    Attributes:
        counts: How many along x, y and z, each >= 1.
        start: Centre of the first [m].
        spacing: Distance of neighbours along x, y and z [m].
        sphere: What spheres have in common. Give this or ``collider``.
        collider: What colliders have in common; its position is an offset, its name gets its
            numbers along x, y and z. Give this or ``sphere``.
    """

    tag: ClassVar[str] = "lattice"
    counts: ThreeCounts
    start: Vector
    spacing: Vector
    sphere: SizedSphere | None = None
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_makings(self)


@dataclass(frozen=True)
class StaggeredRows(Part):
    """Rows, each centred on the one before: staggered, in a triangle, or straight.

    Of spheres, or of colliders like the pegs of a Galton board.

    Attributes:
        rows: How many rows, >= 1.
        counts: How many in each row, >= 1: (13, 12) staggers rows, (1, 2, 3) is a triangle. Where
            there are more rows than numbers, these begin anew.
        start: Centre of the first of the first row [m].
        step: From each to the next in a row [m].
        row_step: From the middle of each row to that of the next [m].
        sphere: What spheres have in common. Give this or ``collider``.
        collider: What colliders have in common; its position is an offset, its name gets the
            numbers of row and place. Give this or ``sphere``.
    """

    tag: ClassVar[str] = "staggered-rows"
    rows: Count
    counts: Counts
    start: Vector
    step: Vector
    row_step: Vector
    sphere: SizedSphere | None = None
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_makings(self)


@dataclass(frozen=True)
class ClosePacking(Part):
    """Close packing of equal spheres in hexagonal layers, one above the other along +y.

    In a layer rows run along x, and every second row is shifted by half a sphere.

    Attributes:
        counts: How many spheres in a row, layers, and rows in a layer: along x, y and z, each >= 1.
        start: Centre of the first [m].
        sphere: What they have in common.
        spacing: Distance of the centres of neighbours [m], > 0; the diameter where it is missing.
        stacking: The order of layers: hexagonal close packing (ABAB...), or face-centred cubic
            (ABCABC...).
    """

    tag: ClassVar[str] = "close-packing"
    counts: ThreeCounts
    start: Vector
    sphere: SizedSphere
    spacing: Positive | None = None
    stacking: Literal["hcp", "fcc"] = "hcp"


@dataclass(frozen=True)
class Ring(Part):
    """Spheres or colliders evenly on a circle.

    Attributes:
        count: How many, >= 1.
        center: Of the circle [m].
        radius: From the centre of the circle to the places [m], > 0.
        sphere: What spheres have in common. Give this or ``collider``.
        axis: Direction about which they go round, by the right-hand rule; of any length but zero.
            The first is at the side of +x, or of +y where the axis is nearly along x.
        collider: The first collider, its position an offset; it is turned about the axis to make
            the others, with its velocities. Its name gets the number of each. Give this or
            ``sphere``.
    """

    tag: ClassVar[str] = "ring"
    count: Count
    center: Vector
    radius: Positive
    sphere: SizedSphere | None = None
    axis: Direction = (0.0, 1.0, 0.0)
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_makings(self)


@dataclass(frozen=True)
class RandomFill(Part):
    """Spheres scattered in a box, none overlapping another sphere or a collider.

    Attributes:
        count: How many, >= 1.
        min: Lower corner of the box that holds the whole spheres [m].
        max: Upper corner of the box [m].
        seed: The same seed gives the same scene.
        sphere: What they have in common.
        speed: Speed [m/s], >= 0, in a random direction, on top of the common velocity.
        radius_range: Smallest and largest radius [m], evenly distributed, instead of the common
            one.
    """

    tag: ClassVar[str] = "random"
    count: Count
    min: Vector
    max: Vector
    seed: Seed
    sphere: Sphere
    speed: NonNegative = 0.0
    radius_range: RadiusRange | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_sizes(self)


Generator: TypeAlias = Row | Lattice | StaggeredRows | ClosePacking | Ring | RandomFill
"""Places for many spheres or colliders."""
