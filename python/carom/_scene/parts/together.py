"""What fields of a part must be together, which no kind of a single one can say."""

from __future__ import annotations

import math
from typing import Any

from carom._scene.checks import wrong_value
from carom._scene.parts.kinds import UNTURNED
from carom.errors import CaromError

NO_SIZE = "needs `radius` or `diameter`"
"""What is wrong with a sphere that does not say how large it is."""


def has_size(sphere: Any) -> bool:
    """Whether a sphere says how large it is."""
    return sphere.radius is not None or sphere.diameter is not None


def expect_one(part: Any, first: str, second: str) -> None:
    """Refuses a part in which two fields say the same thing."""
    if getattr(part, first) is not None and getattr(part, second) is not None:
        where = f"{type(part).__name__}.{second}"
        raise CaromError(f"{where}: `{first}` says it already", where)


def expect_makings(generator: Any) -> None:
    """Refuses a generator that makes neither spheres nor colliders, or both."""
    if generator.sphere is None and generator.collider is None:
        where = type(generator).__name__
        raise CaromError(f"{where}: needs `sphere` or `collider`", where)
    expect_one(generator, "sphere", "collider")


def expect_sizes(filling: Any) -> None:
    """Refuses a random filling of spheres without a size."""
    if filling.radius_range is None and not has_size(filling.sphere):
        where = f"{type(filling).__name__}.sphere"
        raise CaromError(f"{where}: {NO_SIZE}, or give `radius_range`", where)


def expect_one_size(fluid: Any) -> None:
    """Refuses a dense fluid of spheres without a size, or with two that disagree."""
    if fluid.packing_fraction is None:
        if fluid.radius_range is None and not has_size(fluid.sphere):
            where = "DenseFluid.sphere"
            problem = f"{where}: {NO_SIZE}, or give `radius_range` or `packing_fraction`"
            raise CaromError(problem, where)
    elif fluid.radius_range is not None or has_size(fluid.sphere):
        where = "DenseFluid.packing_fraction"
        problem = "must not be given beside a radius, which determines it"
        raise CaromError(f"{where}: {problem}", where)


def expect_far_behind_near(camera: Any) -> None:
    """Refuses a camera that draws nothing."""
    are_numbers = not isinstance(camera.near, str) and not isinstance(camera.far, str)
    if are_numbers and camera.far <= camera.near:
        raise wrong_value("Camera.far", "farther than `near`", camera.far)


def simplify_look_at(camera: Any) -> None:
    """Replaces the point to look at by the rotation towards it, as in a scene read from text."""
    if camera.look_at is None:
        return
    if tuple(camera.rotation) != UNTURNED:
        raise CaromError("Camera: takes `rotation` or `look_at`, not both", "Camera")
    parts = (*camera.look_at, *camera.position)
    if any(isinstance(part, str) for part in parts):
        # The engine reads formulas.
        return
    way = [to - of for to, of in zip(camera.look_at, camera.position, strict=True)]
    length = math.hypot(*way)
    if length == 0.0:
        raise wrong_value("Camera.look_at", "another point than `position`", camera.look_at)
    x, y, z = (part / length for part in way)
    # Halves of the angles about +y and, after it, about +x.
    yaw, pitch = 0.5 * math.atan2(-x, -z), 0.5 * math.asin(y)
    rotation = (
        math.cos(yaw) * math.sin(pitch),
        math.sin(yaw) * math.cos(pitch),
        -math.sin(yaw) * math.sin(pitch),
        math.cos(yaw) * math.cos(pitch),
    )
    object.__setattr__(camera, "rotation", rotation)
    object.__setattr__(camera, "look_at", None)


def simplify_open(container: Any) -> None:
    """Replaces a list of one open side by that side, as in a scene read from text."""
    if len(container.open) == 1:
        object.__setattr__(container, "open", container.open[0])


def simplify_motion(collider: Any) -> None:
    """Replaces a list of one part of a motion by that part, as in a scene read from text."""
    if isinstance(collider.motion, (list, tuple)) and len(collider.motion) == 1:
        object.__setattr__(collider, "motion", collider.motion[0])


def simplify_closed(pipe: Any) -> None:
    """Replaces a list of one closed end by that end, as in a scene read from text."""
    if len(pipe.closed) == 1:
        object.__setattr__(pipe, "closed", pipe.closed[0])
