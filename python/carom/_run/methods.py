"""What the methods of a scene call that need a world."""

from __future__ import annotations

from carom._run.world import World
from carom._scene.scene import Scene


def world_of(scene: Scene) -> World:
    """The world at the start of a scene."""
    return World(scene)


def scene_of(scene: Scene | World) -> Scene:
    """A scene, or the one that begins as a world is now.

    Raises:
        TypeError: For what is neither.
    """
    if isinstance(scene, World):
        return scene.to_scene()
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: must be a Scene or a World, not {type(scene).__name__}")
    return scene
