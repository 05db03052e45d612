"""Recorded states, drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from carom._pictures.picture import painter_of
from carom._run.methods import scene_of
from carom._run.trajectory import Trajectory
from carom._run.world import World
from carom._scene.points import Points
from carom._scene.scene import Scene
from carom._scene.view import View
from carom.errors import CaromError

_OUTLIERS = 2
"""How many of the positions a camera leaves out on either side of each axis [%]."""


class Stage:
    """The states of a trajectory, each drawn as it was recorded, in the surroundings of a scene.

    Colours and finishes are those of the spheres with the same ids at the beginning of the scene.
    What came later looks as its emitters have it, where they agree. Colliders are where they are by
    their velocities at that time.
    """

    def __init__(self, run: Trajectory, scene: Scene | World | None, view: View) -> None:
        """Of a run in surroundings; in nothing without a scene.

        Raises:
            CaromError: If positions were not recorded, or nothing at all.
            GraphicsError: If nothing can be drawn here.
        """
        if run._recorded("positions") is None:
            raise CaromError("quantities: a run without positions cannot be shown", "quantities")
        if not len(run):
            raise CaromError("run: it has no states", "run")
        self.run = run
        start = (Scene(name="run") if scene is None else scene_of(scene)).world()
        told = start.to_scene()
        self._empty = replace(told, spheres=(), emitters=())
        self._colors, self._finishes = _looks(run, start.ids, told)
        # What the camera and the light are fitted to: the scene, as in all pictures of it.
        has_spheres = len(start) > 0 or len(told.emitters) > 0
        self._painter = painter_of(start if has_spheres else self._outlined(), view)
        self.size = (int(view.size[0]), int(view.size[1]))

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
                finishes=self._finishes[there].tolist(),
            )
            world.add_spheres(spheres)
        return world


def _looks(
    run: Trajectory, ids: NDArray[np.uint64], scene: Scene
) -> tuple[NDArray[np.float64], NDArray[np.object_]]:
    """Colours of the spheres of a run, shape (n, 3), nan for those without, and finishes."""
    count = len(run.ids)
    colors, finishes = np.full((count, 3), np.nan), np.full(count, "satin", object)
    emitted = {(emitter.sphere.color, emitter.sphere.finish) for emitter in scene.emitters}
    if len(emitted) == 1:
        [(color, finish)] = emitted
        finishes[:] = finish
        if color is not None:
            colors[:] = color
    spheres = scene.spheres
    assert isinstance(spheres, Points)
    _, own, theirs = np.intersect1d(run.ids, ids, return_indices=True)
    colors[own] = np.nan if spheres._colors is None else spheres._colors[theirs]
    finishes[own] = "satin"
    if spheres._finishes is not None:
        finishes[own] = np.array(spheres._finishes, object)[theirs]
    return colors, finishes
