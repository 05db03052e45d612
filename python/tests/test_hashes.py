"""Every built-in scene moves as the native engine moves it, to the bit."""

import json
import os
from pathlib import Path

import pytest

import carom

NATIVE = os.environ.get("CAROM_NATIVE_HASHES")
"""What the native engine makes of each scene after 10 s; `cargo xtask python --test` writes it."""

pytestmark = pytest.mark.skipif(NATIVE is None, reason="no hashes of the native engine at hand")


def native_hashes() -> dict[str, str]:
    if NATIVE is None:
        return {}
    hashes: dict[str, str] = json.loads(Path(NATIVE).read_text())
    return hashes


def test_every_built_in_scene_has_a_native_hash() -> None:
    built_in = {scene.name for scene in carom.scenes() if scene.source == "built-in"}
    assert built_in == set(native_hashes())


@pytest.mark.parametrize("name", native_hashes())
def test_a_built_in_scene_ends_in_the_native_state(name: str) -> None:
    world = carom.load(name).world()
    world.step(frames=round(10 / world.frame_time))
    assert world.state_hash == native_hashes()[name]


@pytest.mark.parametrize("name", native_hashes())
def test_a_scene_rebuilt_of_its_python_parts_is_the_same(name: str) -> None:
    scene = carom.load(name)
    again = carom.Scene.from_toml(scene.to_toml())
    assert again == scene
    world = again.world()
    frames = round(10 / scene.simulation.frame_time)
    for _ in range(frames):
        world.step()
    assert world.state_hash == native_hashes()[name]
