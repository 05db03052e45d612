"""Scenes of Unity and of glTF in Python, with a warning for each omission."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path

import pytest

import carom

CRATES = Path(__file__).parents[2] / "crates"
PROJECT = CRATES / "carom-unity/tests/fixtures/Project"
GLTF = CRATES / "carom-gltf/tests/fixtures"


def imported(call: Callable[[], carom.Scene]) -> tuple[carom.Scene, list[str]]:
    """What a call gives, and the lines of its warnings."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        scene = call()
    assert all(warning.category is carom.OmissionWarning for warning in caught)
    return scene, [str(warning.message) for warning in caught]


def test_a_scene_of_unity_is_the_course_s() -> None:
    scene, omissions = imported(
        lambda: carom.Scene.from_unity(PROJECT / "Assets/Scenes/First.unity")
    )
    assert "Main Camera: AudioListener: has no counterpart" in omissions
    world, course = scene.world(), carom.load("simtest1").world()
    for _ in range(100):
        world.step()
        course.step()
    assert world.state_hash == course.state_hash


def test_a_scene_of_a_folder_is_named() -> None:
    by_name, _ = imported(lambda: carom.Scene.from_unity(PROJECT / "Assets", scene="Bodies"))
    by_path, _ = imported(
        lambda: carom.Scene.from_unity(PROJECT, scene="Assets/Scenes/Bodies.unity")
    )
    assert by_name == by_path
    for scene in (None, "Nothing"):
        with pytest.raises(carom.CaromError, match=r"scene: .*Bodies\.unity"):
            carom.Scene.from_unity(PROJECT, scene=scene)


def test_a_mapping_says_what_fields_of_scripts_mean() -> None:
    path = PROJECT / "Assets/Scenes/Own.unity"
    scene, _ = imported(lambda: carom.Scene.from_unity(path, mapping=PROJECT / "fields.toml"))
    assert scene.emitters


def test_a_scene_of_gltf_has_its_bodies() -> None:
    scene, omissions = imported(lambda: carom.Scene.from_gltf(GLTF / "bodies.gltf"))
    assert omissions == ["Pill: collider: a capsule has no counterpart"]
    assert [sphere.mass for sphere in scene.spheres] == [2.0, 1.0]
    assert {collider.name for collider in scene.colliders} == {"Ground", "Wall", "Lift"}
    scene.world().step(dt=0.01)


def test_files_that_are_missing_or_broken_are_refused(tmp_path: Path) -> None:
    for call in (carom.Scene.from_unity, carom.Scene.from_gltf):
        with pytest.raises(FileNotFoundError):
            call(tmp_path / "nowhere")
    broken = tmp_path / "broken.gltf"
    broken.write_text('{\n"nodes": 1}')
    with pytest.raises(carom.SceneError, match=r"broken\.gltf: line 2, nodes: "):
        carom.Scene.from_gltf(broken)
    scene = tmp_path / "broken.unity"
    scene.write_text("%YAML 1.1\n--- !u!1 &x\n")
    with pytest.raises(carom.SceneError, match=r"broken\.unity:2: "):
        carom.Scene.from_unity(scene)
