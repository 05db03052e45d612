"""Spheres.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, TypeAlias

from carom._scene.checks import Whole
from carom._scene.parts.choices import Finish
from carom._scene.parts.kinds import (
    ORIGIN,
    UNTURNED,
    Color,
    CueOffset,
    Elevation,
    Finite,
    LargeNumber,
    NonNegative,
    Number,
    Positive,
    Quaternion,
    Restitution,
    Vector,
)
from carom._scene.parts.materials import RestitutionLaw
from carom._scene.parts.part import Part
from carom._scene.parts.together import NO_SIZE, expect_one, has_size


@dataclass(frozen=True)
class Strike(Part):
    """The blow of a cue on a sphere, at one instant and one point, without loss of energy.

    Attributes:
        speed: Speed of the cue [m/s], >= 0.
        azimuth_degrees: Direction of the cue from above, in degrees from +x towards -z,
            counterclockwise. By default 0.
        elevation_degrees: Angle by which the cue points down [degrees], in [0, 90]. By default 0.
        offset: Offset of the cue from the centre to the right and up, as seen along it, in parts of
            the radius; its size is below 1. By default none.
        cue_mass: Mass of the cue [kg], > 0. By default 0.567 kg, 20 ounces.
    """

    speed: NonNegative
    azimuth_degrees: Finite = 0.0
    elevation_degrees: Elevation = 0.0
    offset: CueOffset = (0.0, 0.0)
    cue_mass: Positive = 0.567


@dataclass(frozen=True, kw_only=True)
class Sphere(Part):
    """A sphere, or what the spheres of a generator or an emitter have in common.

    Attributes:
        position: Centre [m]. In a generator or an emitter: an offset from the place that it gives.
        velocity: Velocity [m/s]. In an emitter: in the emitter's coordinates.
        radius: Radius [m], > 0. Every sphere needs this or ``diameter``, but for those of a
            `RandomFill` with a ``radius_range``, and of a `DenseFluid` with that or a
            ``packing_fraction``.
        diameter: Diameter [m], > 0.
        mass: Mass [kg], > 0; 1 if neither this nor ``density`` is given.
        density: Density [kg/m³], > 0. Give this or ``mass``.
        restitution: Coefficient of restitution in [0, 1].
        friction: Coulomb's coefficient of friction, >= 0, under the rules ``exact`` and
            ``contact``. If missing, the other body's value counts.
        rolling_friction: Coefficient of rolling friction, >= 0. If missing, the other body's value
            counts.
        spinning_friction: Coefficient of spinning friction, >= 0. If missing, the other body's
            value counts.
        tangential_restitution: Coefficient of tangential restitution in [0, 1]. If missing, the
            other body's value counts.
        orientation: How it is turned.
        angular_velocity: Angular velocity [rad/s]. In an emitter: in the emitter's coordinates.
        inertia_factor: Moment of inertia divided by mass and square of the radius, > 0: 0.4 for a
            solid ball (default), 2/3 for a thin shell.
        color: Colour. If missing, that of its density, else that of the scene's spheres.
        finish: How its surface reflects light.
        groups: Groups that it is in, one bit for each of 32: ``0b101`` is the first and the third.
            By default the first.
        collides_with: Groups that it collides with, one bit for each; by default all. Two bodies
            collide if each is in a group that the other collides with.
        user_data: A number for programs to find it by; no part of the physics.
        material: Name of its material, whose fields count where its own are ``None``, or a
            restitution of 1 or the finish ``"satin"``.
        restitution_law: Restitution by the speed of approach; beside it ``restitution`` does not
            count.
        strike: The blow of a cue that sets it in motion, besides its velocities. In an emitter: in
            the emitter's coordinates.
        growth_speed: Speed at which the radius grows [m/s], >= 0, under the rule ``exact``. By
            default 0.
    """

    position: Vector = ORIGIN
    velocity: Vector = ORIGIN
    radius: Positive | None = None
    diameter: Positive | None = None
    mass: Positive | None = None
    density: Positive | None = None
    restitution: Restitution = 1.0
    friction: NonNegative | None = None
    rolling_friction: NonNegative | None = None
    spinning_friction: NonNegative | None = None
    tangential_restitution: Restitution | None = None
    orientation: Quaternion = UNTURNED
    angular_velocity: Vector = ORIGIN
    inertia_factor: Positive = 0.4
    color: Color | None = None
    finish: Finish = "satin"
    groups: Number = 1
    collides_with: Number = 0xFFFFFFFF
    user_data: LargeNumber = 0
    material: str | None = None
    restitution_law: RestitutionLaw | None = None
    strike: Strike | None = None
    growth_speed: NonNegative = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_one(self, "radius", "diameter")
        expect_one(self, "mass", "density")


SizedSphere: TypeAlias = Annotated[Sphere, Whole(NO_SIZE, has_size)]
"""A sphere with a radius or a diameter."""
