"""Colliders and their shapes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, Literal, TypeAlias

from carom._scene.parts.kinds import (
    ORIGIN,
    UNTURNED,
    Color,
    Finish,
    Lengths,
    NonNegative,
    Positive,
    Quaternion,
    Restitution,
    Vector,
)
from carom._scene.parts.part import Part


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
    position: Vector = ORIGIN
    rotation: Quaternion = UNTURNED
    velocity: Vector = ORIGIN
    angular_velocity: Vector = ORIGIN
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
