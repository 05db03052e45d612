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
    Fraction,
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
from carom._scene.parts.together import expect_makings, expect_one_size, expect_sizes


@dataclass(frozen=True)
class Emitter(Part):
    """A source of spheres: one at the times 0, period, 2 period, ...

    Attributes:
        sphere: The sphere that it emits.
        period: Time between two spheres [s], > 0.
        position: Position at which spheres appear [m].
        rotation: Rotation of the emitter; it turns the velocity of its spheres, too.
        max_spheres: Most of its spheres at one time; the oldest goes before another comes. By
            default no limit.
        needs_room: Whether a sphere that would overlap another one is left out. By default only
            under the rule ``contact``.
        name: Name, for reports.
        count: Spheres in all, those left out included. By default no end.
    """

    sphere: SizedSphere
    period: Positive
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
        step: Vector from each place to the next [m].
        sphere: Properties of the spheres. Give this or ``collider``.
        collider: Properties of the colliders. The position is an offset; the name gets a number.
            Give this or ``sphere``.
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
        sphere: Properties of the spheres. Give this or ``collider``.
        collider: Properties of the colliders. The position is an offset; the name gets numbers
            along x, y and z. Give this or ``sphere``.
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
        step: Vector from each place to the next in a row [m].
        row_step: Vector from the middle of each row to that of the next [m].
        sphere: Properties of the spheres. Give this or ``collider``.
        collider: Properties of the colliders. The position is an offset; the name gets the numbers
            of row and place. Give this or ``sphere``.
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
        counts: Spheres in a row, layers, and rows in a layer (along x, y and z), each >= 1; one row
            in two dimensions.
        start: Centre of the first [m].
        sphere: Properties of the spheres.
        spacing: Distance of the centres of neighbours [m], > 0. By default the diameter.
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
        center: Centre of the circle [m].
        radius: Radius of the circle [m], > 0.
        sphere: Properties of the spheres. Give this or ``collider``.
        axis: Axis of the circle, of any length but zero. Places follow the right-hand rule. The
            first is at the side of +x, or of +y if the axis is nearly along x.
        collider: The first collider; the position is an offset. The others are turned about the
            axis, with their velocities; the name gets a number. Give this or ``sphere``.
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
        min: Lower corner of the box [m]. Whole spheres lie in it, or in two dimensions discs at z =
            0.
        max: Upper corner of the box [m].
        seed: Seed; the same seed gives the same scene.
        sphere: Properties of the spheres.
        speed: Speed in a random direction [m/s], >= 0, added to the velocity of ``sphere``.
        radius_range: Smallest and largest radius [m], evenly distributed, instead of that of
            ``sphere``.
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


@dataclass(frozen=True)
class DenseFluid(Part):
    """A dense fluid in equilibrium; beyond freezing, a disordered packing.

    Small spheres fly, collide and grow to their radii. They fill the periodic box of the
    simulation, or a box of their own, which nothing else may be in.

    Attributes:
        count: How many, from 1 to 100,000.
        temperature: Temperature k T of the velocities [J], >= 0. The velocity of ``sphere`` is
            added.
        seed: Seed; the same seed gives the same scene.
        sphere: Properties of the spheres.
        packing_fraction: Part of the box that the spheres fill, in (0, 1), in two dimensions part
            of the area: their radii follow from it. Above 0.6 they may jam before. Give this, the
            radius of ``sphere``, or ``radius_range``.
        radius_range: Smallest and largest radius [m], evenly distributed, instead of that of
            ``sphere``.
        min: Lower corner of a box with walls [m], that whole spheres lie in; by default they fill
            the periodic box.
        max: Upper corner of that box [m].
    """

    tag: ClassVar[str] = "dense-fluid"
    count: Count
    temperature: NonNegative
    seed: Seed
    sphere: Sphere
    packing_fraction: Fraction | None = None
    radius_range: RadiusRange | None = None
    min: Vector | None = None
    max: Vector | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_one_size(self)


Generator: TypeAlias = Row | Lattice | StaggeredRows | ClosePacking | Ring | RandomFill | DenseFluid
"""Places for many spheres or colliders."""
