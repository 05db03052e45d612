"""Colliders and their shapes.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import ClassVar, TypeAlias

from carom._scene.parts.choices import Finish, Side
from carom._scene.parts.kinds import (
    ORIGIN,
    UNTURNED,
    Color,
    Heights,
    Lengths,
    NonNegative,
    Positive,
    Quaternion,
    Restitution,
    Triangles,
    Vector,
    Vertices,
)
from carom._scene.parts.part import Part
from carom._scene.parts.together import simplify_open


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
    """A rectangle in its local xz plane that faces local +y.

    Spheres pass it from behind.

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


@dataclass(frozen=True)
class Container(Part):
    """A hollow box.

    Its walls have no thickness; spheres bounce off both sides.

    Attributes:
        size: Full lengths along local x, y, z [m], each > 0.
        open: Sides without a wall: one, or a list. By default none.
    """

    tag: ClassVar[str] = "container"
    size: Lengths
    open: Side | Sequence[Side] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        simplify_open(self)


@dataclass(frozen=True)
class Mesh(Part):
    """A surface of triangles: the path of a file, or a table.

    Attributes:
        file: Path of a file that ends in .glb, .gltf, .obj or .stl, relative to the scene file.
        vertices: Vertices [m].
        triangles: Triangles: the numbers of three vertices each, from 0, against the clock as seen
            from the front.
        scale: Factor of all coordinates, > 0; 1 by default.
        one_sided: Whether an open mesh is met from its front only; false by default. A closed one
            always is.
    """

    tag: ClassVar[str] = "mesh"
    file: str | None = None
    vertices: Vertices = field(default_factory=Vertices)
    triangles: Triangles = field(default_factory=Triangles)
    scale: Positive = field(default_factory=Positive)
    one_sided: bool = False


@dataclass(frozen=True)
class HeightField(Part):
    """Ground over a rectangle in the local xz plane about the origin, given by heights.

    Attributes:
        size_x: Full length along local x [m], > 0.
        size_z: Full length along local z [m], > 0.
        heights: Rows of heights along x [m], from the lowest z on: two or more of the same length.
    """

    tag: ClassVar[str] = "height-field"
    size_x: Positive
    size_z: Positive
    heights: Heights


Shape: TypeAlias = Ball | Rectangle | HalfSpace | Box | Container | Mesh | HeightField
"""Form of a collider in its own frame."""


@dataclass(frozen=True)
class Collider(Part):
    """A shape that spheres bounce off, at rest or moved from outside.

    Attributes:
        shape: Shape.
        position: Position of its centre [m].
        rotation: Rotation about its centre.
        velocity: Velocity of its centre [m/s].
        angular_velocity: Angular velocity about its centre [rad/s].
        restitution: Coefficient of restitution in [0, 1].
        trigger: Whether it only reports spheres and deflects none.
        name: Name, for reports.
        visible: Whether it is drawn; true by default.
        color: Colour. If missing, that of the scene's colliders.
        friction: Coulomb's coefficient of friction, >= 0, under the rules ``exact`` and
            ``contact``. If missing, the other body's value counts.
        rolling_friction: Coefficient of rolling friction, >= 0. If missing, the other body's value
            counts.
        spinning_friction: Coefficient of spinning friction, >= 0. If missing, the other body's
            value counts.
        tangential_restitution: Coefficient of tangential restitution in [0, 1]. If missing, the
            other body's value counts.
        finish: How its surface reflects light.
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
