"""Forces and springs.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias, get_args

from carom._scene.parts.kinds import (
    ORIGIN,
    Direction,
    Finite,
    NonNegative,
    Number,
    Positive,
    Restitution,
    TwoNumbers,
    Vector,
)
from carom._scene.parts.part import Part


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
        gravitational_parameter: Gravitational parameter G M [m³/s²]; a negative one repels.
        position: Where it is [m].
        softening: Softening length [m], >= 0: nearer, the force goes to zero instead of growing.
    """

    tag: ClassVar[str] = "point-attractor"
    gravitational_parameter: Finite
    position: Vector = ORIGIN
    softening: NonNegative = 0.0


@dataclass(frozen=True)
class MutualGravity(Part):
    """Gravity between spheres: every one attracts every other one.

    Attributes:
        constant: Gravitational constant [m³/(kg s²)]; nature's unless given. A negative one repels.
        softening: Softening length [m], >= 0: nearer, the force goes to zero instead of growing.
        opening_angle: Of more than a thousand spheres, those in a cube count as one where its edge
            divided by its distance is less than this, in [0, 1]; with 0 every pair is summed.
    """

    tag: ClassVar[str] = "mutual-gravity"
    constant: Finite = 6.6743e-11
    softening: NonNegative = 0.0
    opening_angle: Restitution = 0.5


@dataclass(frozen=True)
class Wind(Part):
    """Viscous drag in a wind that is the same everywhere.

    Attributes:
        velocity: Of the air [m/s].
        coefficient: Drag coefficient [kg/s], >= 0.
    """

    tag: ClassVar[str] = "wind"
    velocity: Vector
    coefficient: NonNegative


@dataclass(frozen=True)
class Vortex(Part):
    """Viscous drag in air that goes round an axis.

    Attributes:
        circulation: Circulation [m²/s].
        core_radius: Where the air is fastest, in m from the axis, > 0.
        coefficient: Drag coefficient [kg/s], >= 0.
        position: A point of the axis [m].
        axis: Direction of the axis, of any length but zero; the air goes round it by the right-hand
            rule.
    """

    tag: ClassVar[str] = "vortex"
    circulation: Finite
    core_radius: Positive
    coefficient: NonNegative
    position: Vector = ORIGIN
    axis: Direction = (0.0, 1.0, 0.0)


@dataclass(frozen=True)
class QuadraticDrag(Part):
    """Drag of a medium, proportional to the square of the velocity.

    Attributes:
        density: Of the medium [kg/m³], >= 0: 1.2 for air, 1000 for water.
        drag_coefficient: Drag coefficient, >= 0.
        viscosity: Dynamic viscosity of the medium, in Pa s, >= 0. With one, the drag coefficient of
            slow spheres depends on the Reynolds number.
        wind: Velocity of the medium [m/s].
    """

    tag: ClassVar[str] = "quadratic-drag"
    density: NonNegative
    drag_coefficient: NonNegative = 0.44
    viscosity: NonNegative = 0.0
    wind: Vector = ORIGIN


@dataclass(frozen=True)
class Buoyancy(Part):
    """Buoyancy in a fluid with a level surface.

    Attributes:
        density: Of the fluid [kg/m³], >= 0.
        surface_height: Height of the surface above the origin [m].
        gravity: Acceleration of gravity [m/s²], not zero: it makes the fluid heavy, and says where
            up is.
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

    Spheres are named by their numbers, from 0: the single ones of the scene first, then those of
    generators, each in the order of the file. In a running world they go by their ids
    (`World.add_spring`). Give ``spheres``, ``sphere`` with ``anchor``, or ``chain``.

    Attributes:
        stiffness: Stiffness [N/m], >= 0.
        spheres: Numbers of the two spheres that it joins. Give this, ``sphere`` with ``anchor``, or
            ``chain``.
        sphere: Number of the sphere that it joins to a fixed point.
        anchor: The fixed point [m].
        chain: Numbers of the first and the last sphere of a chain: each is joined to the next one.
        rest_length: Length without force [m], >= 0; the length at the start of the scene unless
            given.
        damping: Damping [kg/s], >= 0.
        only_pulls: Whether it only pulls, as a thread does, which is slack up to its rest length.
    """

    stiffness: NonNegative
    spheres: TwoNumbers | None = None
    sphere: Number | None = None
    anchor: Vector | None = None
    chain: TwoNumbers | None = None
    rest_length: NonNegative | None = None
    damping: NonNegative = 0.0
    only_pulls: bool = False
