"""What the layers above a scene do for its methods.

The layers of the package are ``_scene`` (values), ``_run`` (worlds), ``_pictures``, ``notebook``;
each imports only those below it. Still `Scene.run`, `World.picture` and `Trajectory.show` are
methods, for that is where people look for them. Each is one line that calls a layer above by the
`Protocol` that it has here, and the ``__init__`` of that layer says what answers:

>>> from carom._scene.above import above
>>> above.run.__name__, above.pictures.__name__, above.notebook.__name__
('carom._run.methods', 'carom._pictures.methods', 'carom._show')

``import carom`` imports every layer, so none is missing when there is a scene. This is also the one
module of a lower layer that names types of higher ones; nothing but annotations uses them.
"""

from __future__ import annotations

import os
import subprocess
from typing import TYPE_CHECKING, Protocol

import numpy as np
from numpy.typing import NDArray

from carom._scene.view import Size, View, Viewpoint

if TYPE_CHECKING:
    from carom._pictures.film import Film
    from carom._pictures.still import Still
    from carom._run.recording import Out
    from carom._run.trajectory import Recorded, Trajectory
    from carom._run.world import World
    from carom._scene.scene import Scene
    from carom.notebook import AnimatedTrajectory, Viewer

    __all__ = [
        "AnimatedTrajectory",
        "Film",
        "Out",
        "Recorded",
        "Still",
        "Trajectory",
        "Viewer",
        "World",
    ]


class Run(Protocol):
    """The layer that moves spheres."""

    def world_of(self, scene: Scene) -> World:
        """The world at the start of a scene."""


class Pictures(Protocol):
    """The layer that draws."""

    def picture_of_scene(
        self, scene: Scene, path: str | os.PathLike[str] | None, seconds: float, view: View
    ) -> NDArray[np.uint8] | None:
        """Draws a scene, at the frame nearest to a time, into a PNG file or an array."""

    def picture_of_world(
        self, world: World, path: str | os.PathLike[str] | None, view: View
    ) -> NDArray[np.uint8] | None:
        """Draws a world as it is now, into a PNG file or an array."""

    def notebook_picture(self, subject: Scene | World) -> bytes | None:
        """A scene or world as a PNG file; None where nothing can be drawn."""

    def record(
        self,
        scene: Scene,
        path: str | os.PathLike[str],
        seconds: float | None,
        frame_rate: int,
        view: View,
    ) -> int:
        """Films a scene into an mp4 file, and returns the number of frames."""

    def film(self, scene: Scene, seconds: float | None, frame_rate: int, view: View) -> Film:
        """Films a scene into memory."""

    def open_window(self, scene: Scene) -> subprocess.Popen[bytes]:
        """Opens a scene in a window, in a process of its own."""


class Notebook(Protocol):
    """The layer that shows things in notebooks."""

    def show(self, subject: Scene | World, height: int) -> Viewer | Still:
        """A viewer of a scene, or of a world as it is now; a picture where there can be none."""

    def show_trajectory(
        self, run: Trajectory, scene: Scene | World | None, size: Size, camera: Viewpoint
    ) -> AnimatedTrajectory | Still:
        """A player of a recorded run; a picture of its beginning where there can be none."""


class Above:
    """The layers above, each as its ``__init__`` provides it."""

    run: Run
    pictures: Pictures
    notebook: Notebook


above = Above()
"""The layers above."""
