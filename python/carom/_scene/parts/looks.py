"""How a scene is seen: camera, light, colours.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from carom._scene.parts.kinds import (
    UNTURNED,
    Color,
    Ends,
    FieldOfView,
    NonNegative,
    Positive,
    Quaternion,
    Vector,
)
from carom._scene.parts.part import Part
from carom._scene.parts.together import expect_far_behind_near, simplify_look_at


@dataclass(frozen=True)
class Camera(Part):
    """A camera.

    It looks along its local -z.

    Attributes:
        position: Position [m].
        rotation: How it is turned. Give this or ``look_at``.
        vertical_fov_degrees: Vertical field of view [degrees], in (0, 180).
        near: Nearest distance drawn [m], > 0.
        far: Farthest distance drawn [m], > near.
        look_at: Point to look at [m]; +y is up in the picture. The camera keeps it as its rotation.
    """

    position: Vector
    rotation: Quaternion = UNTURNED
    vertical_fov_degrees: FieldOfView = 35.0
    near: Positive = 0.3
    far: Positive = 1000.0
    look_at: Vector | None = None

    def __post_init__(self) -> None:
        super().__post_init__()
        expect_far_behind_near(self)
        simplify_look_at(self)


@dataclass(frozen=True)
class Sun(Part):
    """The light.

    It travels along its local -z.

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
        density: Density [kg/m³], > 0.
        color: Colour of these spheres.
    """

    density: Positive
    color: Color


@dataclass(frozen=True)
class Try(Part):
    """Something to try: a number of the scene that its viewers change with a slider.

    A path at which the scene has no number shows no slider.

    Attributes:
        text: What to try, as an invitation: "Make the floor bouncier".
        path: Path of the number, as in ``colliders.0.restitution`` or
            ``forces.0.gravity.acceleration.1``.
        range: Ends of the slider, in the unit of the number.
    """

    text: str
    path: str
    range: Ends


@dataclass(frozen=True)
class Colors(Part):
    """Colours of things without their own colour.

    Attributes:
        background: Colour of the background.
        colliders: Colour of colliders.
        spheres: Colour of spheres of other densities.
        densities: Colours of spheres by density.
    """

    background: Color | None = None
    colliders: Color | None = None
    spheres: Color | None = None
    densities: Sequence[DensityColor] = ()
