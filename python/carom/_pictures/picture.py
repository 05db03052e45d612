"""Pictures and films: worlds and scenes as the command line draws them."""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from carom import _carom as engine
from carom._run.world import World
from carom._scene.view import NOTEBOOK_SIZE, SIZE, Quality, Size, View, Viewpoint
from carom.errors import CaromError, GraphicsError


class Drawable(Protocol):
    """What can be drawn: a `Scene` at its start, a `World` as it is now."""

    def _drawn(self) -> engine.Engine: ...


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
        CaromError: For a size, camera or quality that is invalid.
        GraphicsError: If nothing can be drawn here.

    >>> import carom
    >>> world = carom.load("simtest1").world()
    >>> renderer = carom.Renderer(world, size=(320, 180), quality="draft")
    >>> renderer.render(world).shape
    (180, 320, 3)
    """

    def __init__(
        self,
        scene: Drawable,
        *,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "good",
    ) -> None:
        view = View.of(size, camera, quality, stamp=False)
        self._painter = painter_of(scene._drawn(), view)

    def render(self, world: World) -> NDArray[np.uint8]:
        """The world as it is now: red, green and blue (sRGB), shape (height, width, 3)."""
        return self._painter.paint(world)


def picture(
    world: engine.Engine, path: str | os.PathLike[str] | None, view: View
) -> NDArray[np.uint8] | None:
    """Draws a world as it is now, into a PNG file or an array."""
    painter = painter_of(world, view)
    if path is None:
        return painter.paint(world)
    painter.save(world, path)
    return None


def notebook_picture(subject: Drawable) -> bytes | None:
    """A scene or world as a PNG file; None where nothing can be drawn."""
    view = View.of(NOTEBOOK_SIZE, "scene", "good", stamp=True)
    try:
        world = subject._drawn()
        return painter_of(world, view).png(world)
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


def painter_of(world: engine.Engine, view: View) -> engine.Painter:
    """What draws worlds as this one is seen.

    Raises:
        GraphicsError: If nothing can be drawn here.
    """
    check_graphics()
    with runtime_folder():
        return engine.Painter(world, view)


@contextmanager
def runtime_folder() -> Iterator[None]:
    """Names a folder in ``$XDG_RUNTIME_DIR`` while a graphics device is opened.

    On servers the variable is not set, and a library of the system prints a line about that.
    """
    name = "XDG_RUNTIME_DIR"
    if not sys.platform.startswith("linux") or name in os.environ:
        yield
        return
    os.environ[name] = tempfile.gettempdir()
    try:
        yield
    finally:
        os.environ.pop(name, None)


def check_graphics() -> None:
    """Refuses a build without pictures.

    Raises:
        GraphicsError: If this is one.
    """
    if not hasattr(engine, "Painter"):
        raise GraphicsError(
            "this build of carom has no pictures; pip install . in the root of the repository "
            "makes one that has"
        )
