"""What the methods of scenes and worlds call that need pictures."""

from __future__ import annotations

import math
import os
import subprocess

import numpy as np
from numpy.typing import NDArray

from carom._pictures import film as films
from carom._pictures.film import Film
from carom._pictures.picture import checked_path, notebook_picture, picture
from carom._pictures.window import open_text
from carom._run.world import World
from carom._scene.scene import Scene
from carom._scene.text import toml_of
from carom._scene.view import View
from carom.errors import CaromError

__all__ = [
    "film",
    "notebook_picture",
    "open_window",
    "picture_of_scene",
    "picture_of_world",
    "record",
]


def picture_of_scene(
    scene: Scene, path: str | os.PathLike[str] | None, seconds: float, view: View
) -> NDArray[np.uint8] | None:
    """Draws a scene, at the frame nearest to a time, into a PNG file or an array."""
    file = None if path is None else checked_path(path, ".png")
    world = scene.world()
    for _ in range(_nearest_frame(seconds, world.frame_time)):
        world.step()
    return picture(world, file, view)


def picture_of_world(
    world: World, path: str | os.PathLike[str] | None, view: View
) -> NDArray[np.uint8] | None:
    """Draws a world as it is now, into a PNG file or an array."""
    return picture(world, None if path is None else checked_path(path, ".png"), view)


def record(
    scene: Scene,
    path: str | os.PathLike[str],
    seconds: float | None,
    frame_rate: int,
    view: View,
) -> int:
    """Films a scene into an mp4 file, and returns the number of frames."""
    return films.record(toml_of(scene), path, seconds, frame_rate, view)


def film(scene: Scene, seconds: float | None, frame_rate: int, view: View) -> Film:
    """Films a scene into memory."""
    return films.filmed(toml_of(scene), seconds, frame_rate, view)


def open_window(scene: Scene) -> subprocess.Popen[bytes]:
    """Opens a scene in a window, in a process of its own."""
    return open_text(scene.to_toml())


def _nearest_frame(seconds: float, frame_time: float) -> int:
    """The number of the frame nearest to a time."""
    if not isinstance(seconds, (int, float, np.number)):
        raise TypeError(f"seconds: must be a number, not {type(seconds).__name__}")
    if not 0 <= seconds < math.inf:
        raise CaromError(f"seconds: must be zero or positive, and finite, not {seconds}", "seconds")
    return math.floor(float(seconds) / frame_time + 0.5)
