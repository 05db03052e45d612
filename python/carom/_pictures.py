"""Pictures and films: worlds and scenes as the command line draws them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from carom import _carom as engine
from carom import _parts as parts
from carom._text import toml_value
from carom.errors import CaromError, GraphicsError

if TYPE_CHECKING:
    from carom._scene import Scene
    from carom._world import World

Size: TypeAlias = Sequence[int]
"""Width and height in pixels."""
Viewpoint: TypeAlias = (
    Literal["scene", "fit", "front", "top"] | parts.Camera | Sequence[parts.Vector]
)
"""Where to look from.

``"scene"``, the scene's own camera, or ``"fit"`` where it has none; ``"fit"``, everything is shown,
from a little to the right and above; ``"front"``, along -z; ``"top"``, from straight above; a
`carom.Camera`; or two points, of the camera and of what it looks at [m].
"""
Quality: TypeAlias = Literal["fine", "good", "draft"]
"""How much work goes into a picture; ``"draft"`` is for slow machines."""

_PLACES = ("scene", "fit", "front", "top")

SIZE = (1280, 720)
"""Of pictures and films, by default."""
NOTEBOOK_SIZE = (640, 360)
"""Of pictures and films in notebooks: of the proportions for which scenes are made."""


class Renderer:
    """Draws worlds into arrays: a graphics device that is kept open, and a camera.

    For many pictures of one scene: to open a device takes longer than to draw. Calls let other
    threads run; threads that use one renderer wait for each other.

    Args:
        scene: What the camera is placed for; a world as it is now, or a scene at its start.
        size: Width and height [pixels].
        camera: Where to look from: see `carom.Viewpoint`.
        quality: How much work goes into a picture.

    Raises:
        CaromError: For a size, camera or quality that makes no sense.
        GraphicsError: If nothing can be drawn here.

    >>> import carom
    >>> world = carom.load("simtest1").world()
    >>> renderer = carom.Renderer(world, size=(320, 180), quality="draft")
    >>> renderer.render(world).shape
    (180, 320, 3)
    """

    def __init__(
        self,
        scene: Scene | World,
        *,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "good",
    ) -> None:
        world = scene if isinstance(scene, engine.Engine) else scene.world()
        self._painter = _painter(world, View.of(size, camera, quality, stamp=False))

    def render(self, world: World) -> NDArray[np.uint8]:
        """The world as it is now: red, green and blue (sRGB), shape (height, width, 3)."""
        return self._painter.paint(world)


class View(NamedTuple):
    """How something is to be seen, as the engine reads it."""

    size: Size
    camera: str
    quality: str
    stamp: bool

    @classmethod
    def of(cls, size: Size, camera: Viewpoint, quality: Quality, *, stamp: bool) -> View:
        """As users say it."""
        return cls(size, _camera_text(camera), str(quality), bool(stamp))


def picture(
    world: World, path: str | os.PathLike[str] | None, view: View
) -> NDArray[np.uint8] | None:
    """Draws a world as it is now, into a PNG file or an array."""
    painter = _painter(world, view)
    if path is None:
        return painter.paint(world)
    painter.save(world, path)
    return None


def notebook_picture(scene: Scene | World) -> bytes | None:
    """A scene or world as a PNG for a notebook; nothing where nothing can be drawn."""
    view = View.of(NOTEBOOK_SIZE, "scene", "good", stamp=True)
    try:
        world = scene if isinstance(scene, engine.Engine) else scene.world()
        return _painter(world, view).png(world)
    except CaromError:
        return None


def checked_path(path: str | os.PathLike[str], ending: str) -> Path:
    """The path of a file that is to be made.

    Raises:
        TypeError: For what is no path.
        CaromError: For a name that promises another kind of file.
    """
    if not isinstance(path, (str, os.PathLike)):
        raise TypeError(f"path: must be a path, not {type(path).__name__}")
    checked = Path(path)
    if checked.suffix.lower() != ending:
        raise CaromError(f"path: {checked} must end in {ending}", "path")
    return checked


def film(
    text: str,
    path: str | os.PathLike[str],
    seconds: float | None,
    frame_rate: int,
    view: View,
) -> int:
    """Films the scene that is described in TOML; the number of frames."""
    _check_graphics()
    return engine.film_scene(text, checked_path(path, ".mp4"), seconds, frame_rate, view)


def _painter(world: World, view: View) -> engine.Painter:
    _check_graphics()
    return engine.Painter(world, view)


def _check_graphics() -> None:
    if not hasattr(engine, "Painter"):
        raise GraphicsError(
            "this build of carom has no pictures; pip install . in the root of the repository "
            "makes one that has"
        )


def _camera_text(camera: Viewpoint) -> str:
    if isinstance(camera, str):
        if camera not in _PLACES:
            names = ", ".join(_PLACES)
            raise CaromError(f"camera: must be one of {names}, not {camera}", "camera")
        return camera
    if isinstance(camera, parts.Camera):
        return f"camera = {toml_value(camera, 'camera')}"
    try:
        points = np.asarray(camera, dtype=np.float64)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.shape != (2, 3):
        raise TypeError("camera: must be a name, a carom.Camera, or two points")
    return ",".join(map(repr, points.ravel().tolist()))
