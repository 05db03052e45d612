"""What a scene is made of: plain values in the words of scene files.

Right-handed frame, y up, SI units. Vectors are any three numbers, tuples or arrays; quaternions are
x, y, z, w and of any length but zero. A part checks its fields when it is made: a value of a wrong
kind is a `TypeError`, another one that makes no sense a `CaromError`. What scene files take instead
of numbers, parts take, too: numbers with units (``"5 cm"``), formulas (``"=2 * 3"``), colours as
text (``"red"``), and turns (``{"normal": (1, 0, 0)}``); the engine reads these, in a scene or a
world.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import MISSING, dataclass, field, fields
from typing import Annotated, Any, ClassVar, Literal, TypeAlias, get_args

from numpy.typing import NDArray

from carom._checks import (
    ColorText,
    Numbers,
    Requirement,
    Turn,
    Whole,
    checks_of,
    listed,
    wrong_value,
)
from carom.errors import CaromError


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
Color: TypeAlias = Annotated[
    Sequence[float] | str,
    _THREE,
    Requirement("three parts in [0, 1]", lambda values: all(0 <= value <= 1 for value in values)),
    ColorText,
]
"""Red, green, blue, each in [0, 1] (sRGB), or a text like ``"red"`` or ``"#c0392b"``."""
Positive: TypeAlias = Annotated[float, _POSITIVE]
"""A number > 0."""
NonNegative: TypeAlias = Annotated[
    float, Requirement("zero or positive, and finite", lambda value: 0 <= value < math.inf)
]
"""A number >= 0."""
Finite: TypeAlias = Annotated[float, Requirement("finite", math.isfinite)]
"""Any finite number."""
Restitution: TypeAlias = Annotated[float, Requirement("in [0, 1]", lambda value: 0 <= value <= 1)]
"""A number in [0, 1]."""
Count: TypeAlias = Annotated[int, _AT_LEAST_ONE, _IN_32_BITS]
"""A whole number >= 1."""
Number: TypeAlias = Annotated[int, _IN_32_BITS]
"""The number of a sphere, from 0."""
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
Finish: TypeAlias = Literal["matte", "satin", "glossy", "metal", "glass"]
"""How a surface takes light."""

_ORIGIN = (0.0, 0.0, 0.0)
_UNTURNED = (0.0, 0.0, 0.0, 1.0)


class Part:
    """Something that a scene is made of. Arrays and lists become tuples: parts are values."""

    def __post_init__(self) -> None:
        values = self.__dict__
        kind: Any = type(self)
        for name, default, keep in checks_of(kind):
            value = values[name]
            if value is not default:
                values[name] = keep(value)

    @classmethod
    def _of_engine(cls, given: Mapping[str, Any]) -> Any:
        """A part of the fields that the engine writes: the engine has checked them."""
        part = object.__new__(cls)
        values = part.__dict__
        for each in fields(cls):  # type: ignore[arg-type]  # Only dataclasses are made of it.
            if each.default_factory is not MISSING:
                values[each.name] = each.default_factory()
            else:
                values[each.name] = each.default
        if unknown := given.keys() - values.keys():
            raise TypeError(f"carom.{cls.__name__} has no field {', '.join(sorted(unknown))}")
        values.update(given)
        return part


def expect(name: str, value: object, *kinds: type[Part] | str) -> None:
    """Refuses a value that is of none of these classes.

    Args:
        name: What errors call it.
        value: What was given.
        kinds: Classes of parts, and words for what else may be given.

    Raises:
        TypeError: For any other value.
    """
    classes = tuple(kind for kind in kinds if not isinstance(kind, str))
    if isinstance(value, classes):
        return
    words = listed(it if isinstance(it, str) else f"carom.{it.__name__}" for it in kinds)
    shown, remedy = type(value).__name__, ""
    if isinstance(value, type):
        shown = f"the class {value.__name__}"
        remedy = f"; write carom.{value.__name__}(...)" if value in classes else ""
    elif isinstance(value, Part):
        shown = f"carom.{shown}"
    raise TypeError(
        f"{name}: must be {'' if isinstance(kinds[0], str) else 'a '}{words}, not {shown}{remedy}"
    )


@dataclass(frozen=True, kw_only=True)
class Sphere(Part):
    """A sphere, or what the spheres of a generator or an emitter have in common.

    Attributes:
        position: Centre [m]; in a generator or an emitter an offset from the place it gives.
        velocity: Velocity [m/s]; in an emitter in the emitter's frame.
        radius: Radius [m], > 0. Every sphere needs this or ``diameter``, but for those of a
            `RandomFill` with a ``radius_range``.
        diameter: Diameter [m], > 0.
        mass: Mass [kg], > 0; 1 unless this or ``density`` is given.
        density: Density [kg/m³], > 0.
        restitution: Coefficient of restitution in [0, 1].
        friction: Coulomb's coefficient of friction, >= 0, under the rules ``exact`` and
            ``contact``; where it is missing, here and in the next three, the value of what is
            touched counts.
        rolling_friction: Coefficient of rolling friction, >= 0.
        spinning_friction: Coefficient of spinning friction, >= 0.
        tangential_restitution: Coefficient of tangential restitution in [0, 1].
        orientation: How it is turned.
        angular_velocity: How fast it turns, along the axis [rad/s]; in an emitter in the emitter's
            frame.
        inertia_factor: Moment of inertia divided by mass and square of the radius, > 0: 2/5 for a
            solid ball, 2/3 for a thin shell.
        color: Colour; by density or the scene's own where it is missing.
        finish: How its surface takes light; it changes no motion.
    """

    position: Vector = _ORIGIN
    velocity: Vector = _ORIGIN
    radius: Positive | None = None
    diameter: Positive | None = None
    mass: Positive | None = None
    density: Positive | None = None
    restitution: Restitution = 1.0
    friction: NonNegative | None = None
    rolling_friction: NonNegative | None = None
    spinning_friction: NonNegative | None = None
    tangential_restitution: Restitution | None = None
    orientation: Quaternion = _UNTURNED
    angular_velocity: Vector = _ORIGIN
    inertia_factor: Positive = 0.4
    color: Color | None = None
    finish: Finish = "satin"

    def __post_init__(self) -> None:
        super().__post_init__()
        _expect_one(self, "radius", "diameter")
        _expect_one(self, "mass", "density")


def _expect_one(part: Part, first: str, second: str) -> None:
    """Refuses a part in which two fields say the same thing."""
    if getattr(part, first) is not None and getattr(part, second) is not None:
        where = f"{type(part).__name__}.{second}"
        raise CaromError(f"{where}: `{first}` says it already", where)


def _has_size(sphere: Sphere) -> bool:
    return sphere.radius is not None or sphere.diameter is not None


_NO_SIZE = "needs `radius` or `diameter`"
SizedSphere: TypeAlias = Annotated[Sphere, Whole(_NO_SIZE, _has_size)]
"""A sphere with a radius or a diameter."""


@dataclass(frozen=True)
class ConstantForce(Part):
    """The same force on every sphere, whatever its mass.

    Attributes:
        force: In N.
    """

    tag: ClassVar[str] = "constant"
    force: Vector


@dataclass(frozen=True)
class Gravity(Part):
    """The same acceleration for every sphere.

    Attributes:
        acceleration: In m/s².
    """

    tag: ClassVar[str] = "gravity"
    acceleration: Vector = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class ViscousDrag(Part):
    """Drag against the velocity and proportional to it.

    Attributes:
        coefficient: In kg/s, >= 0.
    """

    tag: ClassVar[str] = "viscous-drag"
    coefficient: NonNegative


@dataclass(frozen=True)
class PointAttractor(Part):
    """Gravity of a point mass that stays where it is, as of a sun.

    Attributes:
        gravitational_parameter: G M, in m³/s²; a negative one repels.
        position: Where it is, in m.
        softening: Length, in m, >= 0: nearer, the force goes to zero instead of growing.
    """

    tag: ClassVar[str] = "point-attractor"
    gravitational_parameter: Finite
    position: Vector = _ORIGIN
    softening: NonNegative = 0.0


@dataclass(frozen=True)
class MutualGravity(Part):
    """Gravity between spheres: every one attracts every other one.

    Attributes:
        constant: Gravitational constant, in m³/(kg s²); nature's unless given. A negative one
            repels.
        softening: Length, in m, >= 0: nearer, the force goes to zero instead of growing.
        opening_angle: Of more than a thousand spheres, those in a cube count as one where its edge
            divided by its distance is less than this; with 0 every pair is summed.
    """

    tag: ClassVar[str] = "mutual-gravity"
    constant: Finite = 6.67430e-11
    softening: NonNegative = 0.0
    opening_angle: Restitution = 0.5


@dataclass(frozen=True)
class Wind(Part):
    """Viscous drag in a wind that is the same everywhere.

    Attributes:
        velocity: Of the air, in m/s.
        coefficient: Of drag, in kg/s, >= 0.
    """

    tag: ClassVar[str] = "wind"
    velocity: Vector
    coefficient: NonNegative


@dataclass(frozen=True)
class Vortex(Part):
    """Viscous drag in air that goes round an axis.

    Attributes:
        circulation: In m²/s.
        core_radius: Where the air is fastest, in m from the axis, > 0.
        coefficient: Of drag, in kg/s, >= 0.
        position: A point of the axis, in m.
        axis: Its direction; the air goes round it by the right-hand rule.
    """

    tag: ClassVar[str] = "vortex"
    circulation: Finite
    core_radius: Positive
    coefficient: NonNegative
    position: Vector = _ORIGIN
    axis: Direction = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class QuadraticDrag(Part):
    """Drag of a medium, proportional to the square of the velocity.

    Attributes:
        density: Of the medium, in kg/m³, >= 0: 1.2 for air, 1000 for water.
        drag_coefficient: >= 0.
        viscosity: Dynamic viscosity of the medium, in Pa s, >= 0. With one, the drag coefficient of
            slow spheres depends on the Reynolds number.
        wind: Velocity of the medium, in m/s.
    """

    tag: ClassVar[str] = "quadratic-drag"
    density: NonNegative
    drag_coefficient: NonNegative = 0.44
    viscosity: NonNegative = 0.0
    wind: Vector = _ORIGIN


@dataclass(frozen=True)
class Buoyancy(Part):
    """Buoyancy in a fluid with a level surface.

    Attributes:
        density: Of the fluid, in kg/m³, >= 0.
        surface_height: Of the surface above the origin, in m.
        gravity: In m/s², not zero: it makes the fluid heavy, and says where up is.
    """

    tag: ClassVar[str] = "buoyancy"
    density: NonNegative
    surface_height: Finite = 0.0
    gravity: Direction = (0.0, -9.81, 0.0)


Force: TypeAlias = (
    ConstantForce
    | Gravity
    | ViscousDrag
    | PointAttractor
    | MutualGravity
    | Wind
    | Vortex
    | QuadraticDrag
    | Buoyancy
)
"""A force on every sphere, or between spheres; several add up."""
FORCES: tuple[type[Part], ...] = get_args(Force)
"""The kinds of forces."""


@dataclass(frozen=True, kw_only=True)
class Spring(Part):
    """A spring with a damper beside it, or a chain of such.

    Spheres go by their numbers, from 0: the single ones of the scene first, then those of
    generators. In a running world they go by their ids (`World.add_spring`). Give ``spheres``,
    ``sphere`` with ``anchor``, or ``chain``.

    Attributes:
        stiffness: In N/m, >= 0.
        spheres: The two spheres that it joins.
        sphere: The sphere that it joins to a fixed point.
        anchor: The fixed point, in m.
        chain: First and last sphere of a chain: each is joined to the next one.
        rest_length: Length without force, in m, >= 0; the length at the start unless given.
        damping: In kg/s, >= 0.
        only_pulls: Whether it is a thread, which is slack up to its rest length.
    """

    stiffness: NonNegative
    spheres: TwoNumbers | None = None
    sphere: Number | None = None
    anchor: Vector | None = None
    chain: TwoNumbers | None = None
    rest_length: NonNegative | None = None
    damping: NonNegative = 0.0
    only_pulls: bool = False


@dataclass(frozen=True)
class Ball(Part):
    """A sphere that spheres bounce off.

    Attributes:
        radius: In m, > 0.
    """

    tag: ClassVar[str] = "sphere"
    radius: Positive


@dataclass(frozen=True)
class Rectangle(Part):
    """A rectangle in its local xz plane that faces local +y; from behind spheres pass it.

    Attributes:
        size_x: Full length along local x [m], > 0.
        size_z: Full length along local z [m], > 0.
    """

    tag: ClassVar[str] = "rectangle"
    size_x: Positive
    size_z: Positive


@dataclass(frozen=True)
class HalfSpace(Part):
    """Everything below the local xz plane."""

    tag: ClassVar[str] = "half-space"


@dataclass(frozen=True)
class Box(Part):
    """A box of six rectangles that face outward.

    Attributes:
        size: Full lengths along local x, y, z [m], each > 0.
    """

    tag: ClassVar[str] = "box"
    size: Lengths


Side: TypeAlias = Literal["left", "right", "bottom", "top", "back", "front"]
"""A side of a box in its own frame: towards -x, +x, -y, +y, -z, +z."""


@dataclass(frozen=True)
class Container(Part):
    """A hollow box: walls without thickness, off which spheres bounce on either side.

    Attributes:
        size: Full lengths along local x, y, z [m], each > 0.
        open: Sides without a wall: one, or several.
    """

    tag: ClassVar[str] = "container"
    size: Lengths
    open: Side | Sequence[Side] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.open) == 1:
            # As it comes back from text.
            object.__setattr__(self, "open", self.open[0])


Shape: TypeAlias = Ball | Rectangle | HalfSpace | Box | Container
"""Form of a collider in its own frame."""


@dataclass(frozen=True)
class Collider(Part):
    """A shape that spheres bounce off, at rest or moved from outside.

    Attributes:
        shape: Its form.
        position: Where its centre is [m].
        rotation: How it is turned.
        velocity: How fast its centre moves [m/s].
        angular_velocity: How fast it turns about its centre, along the axis [rad/s].
        restitution: Coefficient of restitution in [0, 1].
        trigger: A trigger reports contact and deflects nothing.
        name: What it is called.
        visible: Whether it is drawn.
        color: Its colour; the scene's own for surfaces where it is missing.
        friction: Coulomb's coefficient of friction, >= 0, under the rules ``exact`` and
            ``contact``; where it is missing, here and in the next three, the value of what is
            touched counts.
        rolling_friction: Coefficient of rolling friction, >= 0.
        spinning_friction: Coefficient of spinning friction, >= 0.
        tangential_restitution: Coefficient of tangential restitution in [0, 1].
        finish: How its surface takes light; it changes no motion.
    """

    shape: Shape
    position: Vector = _ORIGIN
    rotation: Quaternion = _UNTURNED
    velocity: Vector = _ORIGIN
    angular_velocity: Vector = _ORIGIN
    restitution: Restitution = 1.0
    trigger: bool = False
    name: str = ""
    visible: bool = True
    color: Color | None = None
    friction: NonNegative | None = None
    rolling_friction: NonNegative | None = None
    spinning_friction: NonNegative | None = None
    tangential_restitution: Restitution | None = None
    finish: Finish = "satin"


@dataclass(frozen=True)
class Emitter(Part):
    """Emits a sphere at the times 0, period, 2 period, ...

    Attributes:
        sphere: What is emitted.
        period: Time between two spheres [s], > 0.
        position: Where spheres appear [m].
        rotation: How the emitter, and with it the velocity of its spheres, is turned.
        max_spheres: How many of its spheres live at most, the oldest making place; ``None``: any.
        needs_room: Whether a sphere is left out that would overlap another one; ``None``: under the
            rule ``contact``.
        name: What it is called.
        count: How many spheres it emits in all, those left out among them; ``None``: no end.
    """

    sphere: SizedSphere
    period: Annotated[float, _POSITIVE]
    position: Vector = _ORIGIN
    rotation: Quaternion = _UNTURNED
    max_spheres: Count | None = None
    needs_room: bool | None = None
    name: str = ""
    count: Count | None = None


def _expect_makings(generator: Row | Lattice | StaggeredRows | Ring) -> None:
    """Refuses a generator that makes neither spheres nor colliders, or both."""
    if generator.sphere is None and generator.collider is None:
        where = type(generator).__name__
        raise CaromError(f"{where}: needs `sphere` or `collider`", where)
    _expect_one(generator, "sphere", "collider")


@dataclass(frozen=True)
class Row(Part):
    """Spheres or colliders one after the other along a line: give one of them.

    Attributes:
        count: How many, >= 1.
        start: Centre of the first [m].
        step: From each centre to the next [m].
        sphere: What spheres have in common.
        collider: What colliders have in common; its position is an offset, its name gets its
            number.
    """

    tag: ClassVar[str] = "row"
    count: Count
    start: Vector
    step: Vector
    sphere: SizedSphere | None = None
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        _expect_makings(self)


@dataclass(frozen=True)
class Lattice(Part):
    """Spheres or colliders on a box-shaped lattice: give one of them.

    x runs fastest, then y, then z.

    Attributes:
        counts: How many along x, y and z, each >= 1.
        start: Centre of the first [m].
        spacing: Distance of neighbours along x, y and z [m].
        sphere: What spheres have in common.
        collider: What colliders have in common; its position is an offset, its name gets its three
            numbers.
    """

    tag: ClassVar[str] = "lattice"
    counts: ThreeCounts
    start: Vector
    spacing: Vector
    sphere: SizedSphere | None = None
    collider: Collider | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        _expect_makings(self)


@dataclass(frozen=True)
class StaggeredRows(Part):
    """Rows, each centred on the one before: staggered, in a triangle, or straight.

    Of spheres, or of colliders like the pegs of a Galton board: give one of ``sphere`` and
    ``collider``.

    Attributes:
        rows: How many rows, >= 1.
        counts: How many in each row, >= 1: (13, 12) staggers rows, (1, 2, 3) is a triangle. Where
            there are more rows than numbers, these begin anew.
        start: Centre of the first of the first row [m].
        step: From each to the next in a row [m].
        row_step: From the middle of each row to that of the next [m].
        sphere: What spheres have in common.
        collider: What colliders have in common; its position is an offset, its name gets the
            numbers of row and place.
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
        _expect_makings(self)


@dataclass(frozen=True)
class ClosePacking(Part):
    """Close packing of equal spheres in hexagonal layers, one above the other along +y.

    In a layer rows run along x, and every second row is shifted by half a sphere.

    Attributes:
        counts: How many spheres in a row, layers, and rows in a layer: along x, y and z, each >= 1.
        start: Centre of the first [m].
        sphere: What they have in common.
        spacing: Distance of the centres of neighbours [m], > 0; ``None``: the diameter.
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
    """Spheres or colliders evenly on a circle: give one of them.

    Attributes:
        count: How many, >= 1.
        center: Of the circle [m].
        radius: From the centre of the circle to the places [m], > 0.
        sphere: What spheres have in common.
        axis: Direction about which they go round, by the right-hand rule; of any length but zero.
            The first is at the side of +x, or of +y where the axis is nearly along x.
        collider: The first collider, its position an offset; it is turned about the axis to make
            the others, with its velocities. Its name gets the number of each.
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
        _expect_makings(self)


@dataclass(frozen=True)
class RandomFill(Part):
    """Spheres scattered in a box, none overlapping another sphere or a collider.

    Attributes:
        count: How many, >= 1.
        min: Lower corner of the box that holds the whole spheres [m].
        max: Upper corner of the box [m].
        seed: The same seed gives the same scene.
        sphere: What they have in common.
        speed: Speed in a random direction, on top of the common velocity [m/s], >= 0.
        radius_range: Smallest and largest radius [m], evenly spread, instead of the common one.
    """

    tag: ClassVar[str] = "random"
    count: Count
    min: Vector
    max: Vector
    seed: Annotated[int, _IN_32_BITS]
    sphere: Sphere
    speed: NonNegative = 0.0
    radius_range: RadiusRange | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.radius_range is None and not _has_size(self.sphere):
            problem = f"{_NO_SIZE}, or give `radius_range`"
            raise CaromError(f"RandomFill.sphere: {problem}", "RandomFill.sphere")


Generator: TypeAlias = Row | Lattice | StaggeredRows | ClosePacking | Ring | RandomFill
"""Places for many spheres or colliders."""


Integrator: TypeAlias = Literal[
    "semi-implicit-euler", "explicit-euler", "velocity-verlet", "runge-kutta-4"
]
"""How spheres move under forces, by the rules ``bisect`` and ``discrete``."""
ImpactLaw: TypeAlias = Literal["reflection", "simultaneous", "sequential"]
"""How impacts at one instant among spheres that touch are answered, by the rule ``exact``."""


@dataclass(frozen=True, kw_only=True)
class Exact(Part):
    """Parameters of the rule ``exact``.

    Attributes:
        impact_law: How impacts at one instant among spheres that touch are answered.
        contact_duration: How long a contact lasts at least [s], > 0: bodies that would meet sooner
            stay together.
        max_impacts: Impacts and other work per sphere in a frame, >= 1; more makes a stepped zone,
            or without zones is refused.
        zones: Whether spheres in contact that take too much work are stepped as by the rule
            ``contact``, until they have come apart.
        zone_budget: Work of a group of spheres in a tick, in contacts times iterations, >= 1; more
            makes a stepped zone.
        zone_tick: Time between two ticks, at which zones are stepped [s], > 0.
        force_tick: Time between two force ticks [s], > 0: springs, forces between spheres and
            others that are not linear are held constant from one to the next. It is halved where
            springs need it.
    """

    impact_law: ImpactLaw = "reflection"
    contact_duration: Positive | None = None
    max_impacts: Count | None = None
    zones: Literal["automatic", "never"] = "automatic"
    zone_budget: Count | None = None
    zone_tick: Positive | None = None
    force_tick: Positive | None = None


@dataclass(frozen=True, kw_only=True)
class Bisect(Part):
    """Parameters of the rule ``bisect``.

    Attributes:
        integrator: How spheres move under forces.
        tolerance: Distance of surfaces that counts as touching [m], >= 0.
        max_halvings: Halvings in search of a contact, >= 1.
        max_impacts: How often two bodies may meet in a frame, >= 1.
        wind_back: Which spheres go through the pieces into which a contact cuts the frame.
    """

    integrator: Integrator = "semi-implicit-euler"
    tolerance: NonNegative | None = None
    max_halvings: Count | None = None
    max_impacts: Count | None = None
    wind_back: Literal["touched", "all"] = "touched"


@dataclass(frozen=True, kw_only=True)
class Discrete(Part):
    """Parameters of the rule ``discrete``.

    Attributes:
        integrator: How spheres move under forces.
    """

    integrator: Integrator = "semi-implicit-euler"


@dataclass(frozen=True, kw_only=True)
class Contact(Part):
    """Parameters of the rule ``contact``.

    Attributes:
        sub_steps: Sub-steps of a frame, >= 1: overlaps fall with the square of their length.
        sweeps: Sweeps over all contacts in a sub-step, >= 1.
        converged: Whether sweeps go on until the solution has converged: slow, to compare with.
        sleep_speed: Speed below which a ball that bears or is borne may fall asleep, as a part of
            sqrt(a r), the speed after falling through half its radius, >= 0; with 0 none sleeps.
    """

    sub_steps: Count = 8
    sweeps: Count = 2
    converged: bool = False
    sleep_speed: NonNegative = 0.02


@dataclass(frozen=True)
class Periodic(Part):
    """A box about the origin that repeats itself without end; only with the rule ``exact``.

    Attributes:
        size: Edges [m], each > 0; infinite along an axis that is open.
    """

    tag: ClassVar[str] = "periodic"
    size: Period = (math.inf, math.inf, math.inf)


Rule: TypeAlias = Literal["exact", "contact", "bisect", "discrete"]
"""A step rule."""
CombineRule: TypeAlias = Literal["product", "minimum", "maximum", "average", "geometric-mean"]
"""Coefficient of a contact from those of its two bodies."""


@dataclass(frozen=True, kw_only=True)
class Simulation(Part):
    """How a scene is stepped.

    Attributes:
        rule: The step rule.
        frame_time: Length of a frame [s], > 0.
        duration: Time worth watching [s], > 0: what a run takes by default.
        spheres_collide: Whether spheres collide with one another; with colliders they always do.
        combine_rule: Restitution of a contact from that of its two bodies.
        friction_combine_rule: Friction of a contact from that of its two bodies.
        allow_overlap: Whether spheres may overlap each other or colliders at the start.
        boundary: What is around the spheres, besides colliders.
        exact: Parameters of the rule ``exact``.
        bisect: Parameters of the rule ``bisect``.
        discrete: Parameters of the rule ``discrete``.
        contact: Parameters of the rule ``contact``.
    """

    rule: Rule = "exact"
    frame_time: Positive = 1.0 / 60.0
    duration: Positive = 10.0
    spheres_collide: bool = True
    combine_rule: CombineRule = "product"
    friction_combine_rule: CombineRule = "geometric-mean"
    allow_overlap: bool = False
    boundary: Literal["open"] | Periodic = "open"
    exact: Exact = field(default_factory=Exact)
    bisect: Bisect = field(default_factory=Bisect)
    discrete: Discrete = field(default_factory=Discrete)
    contact: Contact = field(default_factory=Contact)


@dataclass(frozen=True)
class Camera(Part):
    """Where to look from. The camera looks along its local -z.

    Attributes:
        position: In m.
        rotation: How it is turned.
        vertical_fov_degrees: Vertical field of view in degrees, in (0, 180).
        near: Nearest distance drawn [m], > 0.
        far: Farthest distance drawn [m], > near.
    """

    position: Vector
    rotation: Quaternion = _UNTURNED
    vertical_fov_degrees: Annotated[float, _FIELD_OF_VIEW] = 35.0
    near: Positive = 0.3
    far: Positive = 1000.0

    def __post_init__(self) -> None:
        super().__post_init__()
        are_numbers = not isinstance(self.near, str) and not isinstance(self.far, str)
        if are_numbers and self.far <= self.near:
            raise wrong_value("Camera.far", "farther than `near`", self.far)


@dataclass(frozen=True)
class Sun(Part):
    """The light. It travels along its local -z.

    Attributes:
        rotation: How it is turned.
        color: Colour of the light.
        intensity: Brightness, >= 0; 1 is plain daylight.
    """

    rotation: Quaternion
    color: Color
    intensity: NonNegative = 1.0


@dataclass(frozen=True)
class DensityColor(Part):
    """The colour of spheres of one density.

    Attributes:
        density: In kg/m³, > 0.
        color: Their colour.
    """

    density: Positive
    color: Color


@dataclass(frozen=True)
class Colors(Part):
    """Colours of what has none of its own.

    Attributes:
        background: Behind everything.
        colliders: Colliders.
        spheres: Spheres whose density is not listed.
        densities: Spheres by their density.
    """

    background: Color | None = None
    colliders: Color | None = None
    spheres: Color | None = None
    densities: Sequence[DensityColor] = ()
