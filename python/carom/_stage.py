"""Recorded states, drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from carom import _pictures as pictures
from carom._parts import Sphere
from carom._points import Points
from carom._trajectory import Trajectory
from carom.errors import CaromError

if TYPE_CHECKING:
    from carom._scene import Scene
    from carom._world import World


_OUTLIERS = 2
"""How many of the positions a camera leaves out on either side of each axis [%]."""


class Stage:
    """The states of a trajectory, each drawn as it was recorded, in the surroundings of a scene.

    Colours are those of the spheres with the same ids at the beginning of the scene; what came
    later has the scene's own. Colliders are where they are by their velocities at that time.
    """

    def __init__(self, run: Trajectory, scene: Scene | World | None, view: pictures.View) -> None:
        """Of a run in surroundings; in nothing without a scene.

        Raises:
            CaromError: If positions were not recorded, or nothing at all.
            GraphicsError: If nothing can be drawn here.
        """
        from carom._scene import Scene

        if run._recorded("positions") is None:
            raise CaromError("quantities: a run without positions cannot be shown", "quantities")
        if not len(run):
            raise CaromError("run: it has no states", "run")
        if scene is None:
            scene = Scene(name="run")
        elif not isinstance(scene, Scene):
            scene = scene.to_scene()
        self.run = run
        start = scene.world()
        told = start.to_scene()
        self._empty = replace(told, spheres=(), emitters=())
        self._colors = _colors(run, start.ids, told.spheres)
        # What the camera and the light are fitted to: the scene, as in all pictures of it.
        has_spheres = len(start) > 0 or len(told.emitters) > 0
        self._painter = pictures._painter(start if has_spheres else self._outlined(), view)
        self.size = (int(view.size[0]), int(view.size[1]))
        self.name = scene.name

    def png(self, index: int) -> bytes:
        """A recorded state as a PNG file."""
        return self._painter.png(self._world(index))

    def _outlined(self) -> World:
        """A world with spheres at two corners of the space where those of the run are."""
        world = self._empty.world()
        positions = self.run.positions[~np.isnan(self.run.positions[:, :, 0])]
        if len(positions):
            # But for the few that have flown off.
            corners = np.percentile(positions, [_OUTLIERS, 100 - _OUTLIERS], axis=0)
            world.add_spheres(corners, float(self.run.radii.max()))
        return world

    def _world(self, index: int) -> World:
        """A world in a recorded state."""
        run = self.run
        there = ~np.isnan(run.positions[index, :, 0])
        world = self._empty.world()
        if run.time[index] > 0:
            # Nothing but colliders moves.
            world.step(dt=float(run.time[index]))
        turned = run.orientations
        if there.any():
            spheres = Points(
                run.positions[index, there],
                run.radii[there],
                masses=run.masses[there],
                orientations=None if turned is None else turned[index, there],
                colors=self._colors[there],
            )
            world.add_spheres(spheres)
        return world


def _colors(
    run: Trajectory, ids: NDArray[np.uint64], spheres: Sequence[Sphere]
) -> NDArray[np.float64]:
    """Colours of the spheres of a run, shape (n, 3); nan for those without one of their own."""
    colors = np.full((len(run.ids), 3), np.nan)
    assert isinstance(spheres, Points)
    if spheres._colors is not None:
        _, own, theirs = np.intersect1d(run.ids, ids, return_indices=True)
        colors[own] = spheres._colors[theirs]
    return colors
