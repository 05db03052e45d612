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
        force: Force [N].
    """

    tag: ClassVar[str] = "constant"
    force: Vector


@dataclass(frozen=True)
class Gravity(Part):
    """The same acceleration for every sphere.

    Attributes:
        acceleration: Acceleration [m/s²].
    """

    tag: ClassVar[str] = "gravity"
    acceleration: Vector = (0.0, -9.81, 0.0)


@dataclass(frozen=True)
class ViscousDrag(Part):
    """Drag against the velocity and proportional to it.

    Attributes:
        coefficient: Drag coefficient [kg/s], >= 0.
    """

    tag: ClassVar[str] = "viscous-drag"
    coefficient: NonNegative


@dataclass(frozen=True)
class PointAttractor(Part):
    """Gravity of a fixed point mass, such as a sun.

    Attributes:
        gravitational_parameter: Gravitational parameter G M [m³/s²]. A negative one repels.
        position: Position of the point [m].
        softening: Softening length [m], >= 0. At smaller distances the force falls to zero. By
            default 0.
    """

    tag: ClassVar[str] = "point-attractor"
    gravitational_parameter: Finite
    position: Vector = ORIGIN
    softening: NonNegative = 0.0


@dataclass(frozen=True)
class MutualGravity(Part):
    """Gravity between all pairs of spheres.

    Attributes:
        constant: Gravitational constant [m³/(kg s²)]. A negative one repels.
        softening: Softening length [m], >= 0. At smaller distances the force falls to zero. By
            default 0.
        opening_angle: Accuracy above a thousand spheres, in [0, 1]: a cube of spheres counts as one
            if its edge divided by its distance is smaller. With 0 every pair is summed.
    """

    tag: ClassVar[str] = "mutual-gravity"
    constant: Finite = 6.6743e-11
    softening: NonNegative = 0.0
    opening_angle: Restitution = 0.5


@dataclass(frozen=True)
class Wind(Part):
    """Viscous drag in a wind that is the same everywhere.

    Attributes:
        velocity: Velocity of the air [m/s].
        coefficient: Drag coefficient [kg/s], >= 0.
    """

    tag: ClassVar[str] = "wind"
    velocity: Vector
    coefficient: NonNegative


@dataclass(frozen=True)
class Vortex(Part):
    """Viscous drag in air that circles an axis.

    Attributes:
        circulation: Circulation [m²/s].
        core_radius: Distance from the axis at which the air is fastest [m], > 0.
        coefficient: Drag coefficient [kg/s], >= 0.
        position: A point of the axis [m].
        axis: Direction of the axis, of any length but zero. The air circles it by the right-hand
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
        density: Density of the medium [kg/m³], >= 0: 1.2 for air, 1000 for water.
        drag_coefficient: Drag coefficient, >= 0.
        viscosity: Dynamic viscosity of the medium [Pa s], >= 0. With it, the drag coefficient of
            slow spheres depends on the Reynolds number.
        wind: Velocity of the medium [m/s]. By default at rest.
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
        density: Density of the fluid [kg/m³], >= 0.
        surface_height: Height of the surface above the origin [m].
        gravity: Acceleration of gravity in the fluid [m/s²], not zero. It points down.
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
    """A spring with a damper, or a chain of them.

    Numbers of spheres begin at 0: the single spheres of the scene first, then those of generators,
    each in the order of the file. In a running world they go by their ids (`World.add_spring`).
    Give ``spheres``, ``sphere`` with ``anchor``, or ``chain``.

    Attributes:
        stiffness: Stiffness [N/m], >= 0.
        spheres: Numbers of the two joined spheres. Give this, ``sphere`` with ``anchor``, or
            ``chain``.
        sphere: Number of the sphere that is joined to a fixed point.
        anchor: The fixed point [m].
        chain: Numbers of the first and the last sphere of a chain. Each sphere is joined to the
            next one.
        rest_length: Length without force [m], >= 0. By default the length at the start.
        damping: Damping [kg/s], >= 0.
        only_pulls: Whether it only pulls, as a thread; it is slack up to its rest length.
    """

    stiffness: NonNegative
    spheres: TwoNumbers | None = None
    sphere: Number | None = None
    anchor: Vector | None = None
    chain: TwoNumbers | None = None
    rest_length: NonNegative | None = None
    damping: NonNegative = 0.0
    only_pulls: bool = False
