"""Pictures of a maze that is played."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from carom._carom import MazeEpisodes
from carom._pictures.picture import Renderer
from carom._run.world import World
from carom._scene.scene import Scene

SIZE = (640, 480)
"""Width and height [pixels]."""


class Drawing:
    """Draws what belongs to single balls. The first picture opens a graphics device."""

    def __init__(self, engine: MazeEpisodes) -> None:
        self._engine = engine
        self._renderer: Renderer | None = None

    def of(self, ball: int) -> NDArray[np.uint8]:
        """The maze as it is tilted for a ball."""
        world = World(Scene.from_toml(self._engine.scene_toml(ball)))
        if self._renderer is None:
            self._renderer = Renderer(world, size=SIZE)
        return self._renderer.render(world)
