"""Colliders and their shapes.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from carom._scene.parts.choices import End, Finish, Side
from carom._scene.parts.kinds import (
    ORIGIN,
    UNTURNED,
    Color,
    Direction,
    Finite,
    FrequencyRatio,
    Heights,
    LargeNumber,
    Lengths,
    NonNegative,
    Number,
    Positive,
    Quaternion,
    Restitution,
    Rotations,
    Times,
    Triangles,
    Vector,
    Vertices,
)
from carom._scene.parts.materials import RestitutionLaw
from carom._scene.parts.part import Part
from carom._scene.parts.together import simplify_closed, simplify_motion, simplify_open
from carom._scene.parts.tracks import Track


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
class Cylinder(Part):
    """A solid cylinder about local y.

    Attributes:
        radius: In m, > 0.
        height: Full length along local y [m], > 0.
    """

    tag: ClassVar[str] = "cylinder"
    radius: Positive
    height: Positive


@dataclass(frozen=True)
class Cone(Part):
    """A solid cone about local y, or the frustum of one.

    Attributes:
        bottom_radius: Radius at the lower end [m], >= 0.
        height: Full length along local y [m], > 0.
        top_radius: Radius at the upper end [m], >= 0; by default 0. One of the two is > 0.
    """

    tag: ClassVar[str] = "cone"
    bottom_radius: NonNegative
    height: Positive
    top_radius: NonNegative = 0.0


@dataclass(frozen=True)
class Capsule(Part):
    """All within a radius of a line along local y.

    Attributes:
        radius: In m, > 0.
        length: Length of the line [m], > 0. The capsule is longer by twice the radius.
    """

    tag: ClassVar[str] = "capsule"
    radius: Positive
    length: Positive


@dataclass(frozen=True)
class Disc(Part):
    """A disc in its local xz plane that faces local +y.

    Spheres pass it from behind.

    Attributes:
        radius: In m, > 0.
    """

    tag: ClassVar[str] = "disc"
    radius: Positive


@dataclass(frozen=True)
class Torus(Part):
    """A solid ring about local y: all within a radius of a circle.

    Attributes:
        ring_radius: Radius of the circle [m], larger than that of the tube.
        tube_radius: Radius of the tube [m], > 0.
    """

    tag: ClassVar[str] = "torus"
    ring_radius: Positive
    tube_radius: Positive


@dataclass(frozen=True)
class Pipe(Part):
    """A hollow cylinder about local y.

    Its wall has no thickness; spheres bounce off both sides.

    Attributes:
        radius: In m, > 0.
        length: Full length along local y [m], > 0.
        closed: Ends with a wall: one, or a list. By default none.
    """

    tag: ClassVar[str] = "pipe"
    radius: Positive
    length: Positive
    closed: End | Sequence[End] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        simplify_closed(self)


@dataclass(frozen=True)
class Bowl(Part):
    """A hollow sphere that is open towards local +y.

    Its wall has no thickness; spheres bounce off both sides.

    Attributes:
        radius: In m, > 0.
        opening_degrees: Angle between local +y and the rim as seen from the centre [degrees], in
            [0, 180): 0 of a whole sphere. By default 90.
    """

    tag: ClassVar[str] = "bowl"
    radius: Positive
    opening_degrees: NonNegative = 0.0


@dataclass(frozen=True)
class Funnel(Part):
    """A hollow cone about local y, open at both ends.

    Its wall has no thickness; spheres bounce off both sides.

    Attributes:
        bottom_radius: Radius of the lower opening [m], >= 0.
        top_radius: Radius of the upper opening [m], >= 0. One of the two is > 0.
        height: Full length along local y [m], > 0.
    """

    tag: ClassVar[str] = "funnel"
    bottom_radius: NonNegative
    top_radius: NonNegative
    height: Positive


@dataclass(frozen=True)
class Mesh(Part):
    """A surface of triangles: from a file, or of arrays.

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
    vertices: Vertices = ()
    triangles: Triangles = ()
    scale: Positive = 1.0
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


Shape: TypeAlias = (
    Ball
    | Rectangle
    | HalfSpace
    | Box
    | Container
    | Cylinder
    | Cone
    | Capsule
    | Disc
    | Torus
    | Pipe
    | Bowl
    | Funnel
    | Mesh
    | HeightField
    | Track
)
"""Form of a collider in its own frame."""


@dataclass(frozen=True)
class Steady(Part):
    """Moves steadily.

    Attributes:
        velocity: Velocity [m/s].
    """

    tag: ClassVar[str] = "steady"
    velocity: Vector


@dataclass(frozen=True)
class Oscillate(Part):
    """Moves to and fro along an axis: amplitude times the sine of the phase.

    Attributes:
        amplitude: How far it comes to each side [m].
        frequency: Periods per second, in Hz, >= 0.
        axis: Direction of the axis, of any length but zero. By default up.
        phase_degrees: Phase at the start [degrees]. By default 0: it begins in the middle, on its
            way along the axis.
    """

    tag: ClassVar[str] = "oscillate"
    amplitude: Finite
    frequency: NonNegative
    axis: Direction = (0.0, 1.0, 0.0)
    phase_degrees: Finite = 0.0


@dataclass(frozen=True)
class Turn(Part):
    """Turns steadily about an axis through a pivot.

    Attributes:
        rate: Angular velocity [rad/s].
        axis: Direction of the axis, of any length but zero. By default up.
        pivot: A point of the axis, from the position of the collider [m]. By default there.
    """

    tag: ClassVar[str] = "turn"
    rate: Finite
    axis: Direction = (0.0, 1.0, 0.0)
    pivot: Vector = ORIGIN


@dataclass(frozen=True)
class Swing(Part):
    """Turns to and fro about an axis through a pivot: amplitude times the sine of the phase.

    Attributes:
        amplitude_degrees: How far it turns to each side [degrees].
        frequency: Periods per second, in Hz, >= 0.
        axis: Direction of the axis, of any length but zero. By default up.
        pivot: A point of the axis, from the position of the collider [m]. By default there.
        phase_degrees: Phase at the start [degrees]. By default 0: it begins in the middle, on its
            way by the right-hand rule.
    """

    tag: ClassVar[str] = "swing"
    amplitude_degrees: Finite
    frequency: NonNegative
    axis: Direction = (0.0, 1.0, 0.0)
    pivot: Vector = ORIGIN
    phase_degrees: Finite = 0.0


@dataclass(frozen=True)
class Keyframes(Part):
    """Moves and turns through poses at given times, and rests before and after.

    Velocities are continuous.

    Attributes:
        times: Times of the poses [s]: two or more, ascending.
        positions: Displacements from the position of the collider [m], one for each time. By
            default none.
        rotations: Rotations from that of the collider, one for each time, about the axes of the
            world. By default none.
        pivot: The point about which it turns, from the position of the collider [m]. By default
            there.
        repeat: Whether it repeats, before and after. The last pose has to be the first. By default
            not.
    """

    tag: ClassVar[str] = "keyframes"
    times: Times
    positions: Vertices = ()
    rotations: Rotations = ()
    pivot: Vector = ORIGIN
    repeat: bool = False


Motion: TypeAlias = Steady | Oscillate | Turn | Swing | Keyframes
"""A part of the motion of a collider, as a function of time."""


@dataclass(frozen=True)
class Collider(Part):
    """A shape that spheres bounce off, at rest or moving.

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
        kick: Speed that an impact adds along the normal [m/s], >= 0: a sphere that comes with v
            leaves with e v + kick.
        groups: Groups that it is in, one bit for each of 32: ``0b101`` is the first and the third.
            By default the first.
        collides_with: Groups that it collides with, one bit for each; by default all. Two bodies
            collide if each is in a group that the other collides with.
        user_data: A number for programs to find it by; no part of the physics.
        motion: Motion about where it is at rest, instead of velocities: one, or a list of parts
            that act one after the other. By default none.
        material: Name of its material, whose fields count where its own are ``None``, or a
            restitution of 1 or the finish ``"satin"``.
        restitution_law: Restitution by the speed of approach; beside it ``restitution`` does not
            count.
        surface_velocity: Velocity of the material along the surface, in its own coordinates [m/s],
            as of a conveyor belt: friction feels it, and the shape stays.
        capture: Whether a sphere that enters this trigger leaves the scene, as in the pocket of a
            billiard table.
        cushion: Compliance of the surface: the frequency of its vibration across the normal divided
            by that along it, in [1, 2], instead of a tangential restitution. 1.7 for cushions of a
            pool table; by default rigid.
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
    kick: NonNegative = 0.0
    groups: Number = 1
    collides_with: Number = 0xFFFFFFFF
    user_data: LargeNumber = 0
    motion: Motion | Sequence[Motion] = ()
    material: str | None = None
    restitution_law: RestitutionLaw | None = None
    surface_velocity: Vector = ORIGIN
    capture: bool = False
    cushion: FrequencyRatio | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        simplify_motion(self)
