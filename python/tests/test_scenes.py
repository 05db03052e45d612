"""Scenes: values, found by name, written and read."""

import copy
import pickle
import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import carom
from carom._scene import library


@pytest.fixture(autouse=True)
def only_own_scenes(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a test registers is gone after it."""
    monkeypatch.setattr(library, "_registered", {})
    monkeypatch.delenv("CAROM_SCENES", raising=False)


def test_every_built_in_scene_is_listed_and_loads() -> None:
    listed = carom.scenes()
    assert "simtest1" in [scene.name for scene in listed]
    for scene in listed:
        assert carom.load(scene.name).name == scene.name
        assert carom.load(scene.title or scene.name).name == scene.name


@pytest.mark.parametrize("name", [scene.name for scene in carom.scenes()])
def test_a_scene_survives_text_pickle_and_copy(name: str) -> None:
    scene = carom.load(name)
    assert carom.Scene.from_toml(scene.to_toml()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene
    assert copy.deepcopy(scene) == scene


def test_every_kind_of_part_survives_text() -> None:
    ball = carom.Sphere(diameter=0.5, density=3.0, color=(1, 0, 0.5))
    fill = carom.RandomFill(4, (0, 5, 0), (9, 9, 9), 1, ball, 2.0, (0.1, 0.2))
    peg = carom.Collider(carom.Ball(0.5), name="peg", color=(0, 0, 1))
    scene = carom.Scene(
        name="all",
        title='Quotes " and \\ and ü',
        description="Two\nlines.",
        origin="here",
        simulation=carom.Simulation(
            boundary=carom.Periodic((50, float("inf"), 50)),
            exact=carom.Exact(impact_law="sequential", contact_duration=1e-9, max_impacts=1000),
            bisect=carom.Bisect(
                integrator="runge-kutta-4",
                tolerance=1e-6,
                max_halvings=30,
                max_impacts=40,
                wind_back="all",
            ),
            discrete=carom.Discrete(integrator="velocity-verlet"),
        ),
        forces=[carom.Gravity(), carom.ConstantForce((1, 2, 3)), carom.ViscousDrag(1)],
        spheres=[carom.Sphere(position=np.array([0, 20, 0]), radius=1)],
        generators=[
            carom.Row(2, (0, 30, 0), (2, 0, 0), ball),
            carom.Lattice((2, 1, 1), (0, 40, 0), (2, 2, 2), ball),
            carom.StaggeredRows(3, (1, 2), (0, 45, 0), (2, 0, 0), (0, 0, 2), sphere=ball),
            carom.StaggeredRows(2, (3,), (0, -20, 0), (2, 0, 0), (0, 0, 2), collider=peg),
            carom.ClosePacking((2, 1, 1), (0, 50, 0), ball, 0.6, "fcc"),
            carom.Ring(3, (0, 60, 0), 1, ball, (1, 0, 0)),
            fill,
        ],
        colliders=[
            carom.Collider(carom.Ball(1), color=(0, 0, 1), visible=False),
            carom.Collider(carom.Rectangle(1, 2), (0, -5, 0), trigger=True),
            carom.Collider(carom.HalfSpace(), (0, -9, 0), angular_velocity=(0, 1, 0)),
            carom.Collider(carom.Box((1, 1, 1)), (20, 0, 0), (0, 0, 1, 1)),
            carom.Collider(carom.Container((1, 1, 1)), (30, 0, 0)),
            carom.Collider(carom.Container((1, 1, 1), "top"), (40, 0, 0)),
            carom.Collider(carom.Container((1, 1, 1), ["back"]), (50, 0, 0)),
            carom.Collider(carom.Container((1, 1, 1), ["top", "front"]), (60, 0, 0)),
        ],
        emitters=[carom.Emitter(ball, 1.0, (-20, 0, 0), max_spheres=5, name="tap \u2192")],
        camera=carom.Camera((0, 0, 9)),
        sun=carom.Sun((0, 0, 0, 1), (1, 1, 1), 0.5),
        colors=carom.Colors((0, 0, 0), densities=[carom.DensityColor(3.0, (1, 1, 0))]),
        tries=[carom.Try("Fall slowly", "forces.0.gravity.acceleration.1", (-20, 0))],
    )
    assert carom.Scene.from_toml(scene.to_toml()) == scene
    world = scene.world()
    assert len(world) == 1 + 2 + 2 + 4 + 2 + 3 + 4
    assert [each.name for each in world.colliders.values()][-2:] == ["peg 2-2", "peg 2-3"]


@pytest.mark.parametrize("mark", ["\x1b", "\x7f", "\n", "\u0085"])
@pytest.mark.parametrize(
    "field", ["name", "title", "origin", "colliders[0].name", "emitters[0].name"]
)
def test_names_have_no_control_characters(field: str, mark: str) -> None:
    owner, _, attribute = field.rpartition(".")
    text: dict[str, Any] = {attribute: f"tap{mark}"}
    if not owner:
        scene = carom.Scene(**{"name": "taps", **text})
    elif owner.startswith("colliders"):
        scene = carom.Scene(name="taps", colliders=[carom.Collider(carom.Ball(1), **text)])
    else:
        ball = carom.Sphere(radius=0.5)
        scene = carom.Scene(name="taps", emitters=[carom.Emitter(ball, 1.0, max_spheres=5, **text)])
    with pytest.raises(carom.SceneError, match=re.escape(f"{field}: must have no control")):
        scene.to_toml()


def test_a_scene_of_python_is_found_by_name_in_any_case() -> None:
    @carom.scene("Two-Balls", "Two balls.")
    def two_balls(gap: float = 1.0) -> carom.Scene:
        balls = [carom.Sphere(radius=0.5), carom.Sphere(position=(1 + gap, 0, 0), radius=0.5)]
        return carom.Scene(name="anything", spheres=balls)

    scene = carom.load("two-balls")
    assert (scene.name, scene.description) == ("Two-Balls", "Two balls.")
    assert carom.load("Two-Balls", gap=3.0).spheres[1].position == (4.0, 0, 0)
    assert carom.load("two-balls", {"spheres.0.radius": 0.25}).spheres[0].radius == 0.25
    assert ("Two-Balls", "Two balls.", "registered") in [
        (it.name, it.description, it.source) for it in carom.scenes()
    ]
    assert two_balls(2.0).spheres[1].position == (3.0, 0, 0)


def test_a_scene_of_python_comes_before_a_built_in_one() -> None:
    carom.scene("simtest1")(lambda: carom.Scene(name="mine"))
    assert carom.load("SimTest1").spheres == ()
    assert [it.name for it in carom.scenes()].count("simtest1") == 1


def test_a_function_that_returns_no_scene_is_told() -> None:
    carom.scene("nothing")(lambda: None)  # type: ignore[type-var]
    with pytest.raises(TypeError, match="nothing: its function returned a NoneType"):
        carom.load("nothing")


def test_a_file_takes_no_parameters() -> None:
    with pytest.raises(TypeError, match="simtest1: takes no parameters"):
        carom.load("simtest1", count=3)


def test_a_scene_of_another_package_is_found_by_its_entry_point(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "other_package.py").write_text(
        "import carom\n"
        "def swarm(count=2):\n"
        "    ball = carom.Sphere(radius=0.1)\n"
        "    return carom.Scene(name='x', generators=[carom.Row(count, (0,0,0), (1,0,0), ball)])\n"
    )
    information = tmp_path / "other_package-1.0.dist-info"
    information.mkdir()
    (information / "METADATA").write_text(
        "Metadata-Version: 2.1\nName: other-package\nVersion: 1.0\n"
    )
    (information / "entry_points.txt").write_text("[carom.scenes]\nswarm = other_package:swarm\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    assert "swarm" in [scene.name for scene in carom.scenes()]
    assert "other_package" not in sys.modules
    assert len(carom.load("swarm", count=7).world()) == 7
    with pytest.raises(carom.UnknownError, match='did you mean "swarm"'):
        carom.load("swarn")


def test_folders_of_scenes_are_searched(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('name = "mine"\ntitle = "My own"\n')
    assert carom.load(str(file)).title == "My own"
    assert carom.load(file) == carom.load(str(file))
    assert carom.Scene.from_file(file).title == "My own"
    monkeypatch.setenv("CAROM_SCENES", str(tmp_path))
    assert carom.load("my own").name == "mine"


def test_a_picture_is_said_to_be_no_scene(tmp_path: Path) -> None:
    photo = tmp_path / "photo.jpg"
    photo.write_bytes(b"\xff\xd8\xff\xe0\0\x10JFIF\0")
    words = r"photo\.jpg: it is not a scene file: it begins like a JPEG picture, and is not text"
    with pytest.raises(carom.SceneError, match=words):
        carom.Scene.from_file(photo)
    with pytest.raises(carom.SceneError, match=words):
        carom.load(str(photo))


TITLED = 'name = "{}"\ntitle = "{}"\n'


@pytest.fixture
def titled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Three scenes in a folder."""
    for name, title in [("a", "Zebra on a swing"), ("b", "A zebra's swing"), ("c", "Zeppelin")]:
        (tmp_path / f"{name}.toml").write_text(TITLED.format(name, title), encoding="utf-8")
    monkeypatch.setenv("CAROM_SCENES", str(tmp_path))


@pytest.mark.usefixtures("titled")
@pytest.mark.parametrize(
    ("words", "name"), [("swing ON", "a"), ("zebra's", "b"), ("swing, a zebra on", "a")]
)
def test_words_that_one_title_alone_has_find_its_scene(words: str, name: str) -> None:
    assert carom.load(words).name == name
    assert carom.load(words, {"title": "Other"}).title == "Other"


@pytest.mark.usefixtures("titled")
def test_a_name_or_title_counts_before_words_of_another_title(tmp_path: Path) -> None:
    (tmp_path / "d.toml").write_text(TITLED.format("zeppelin", "Balloon"), encoding="utf-8")
    # It is a title, too, of a file that comes before.
    assert carom.load("zeppelin").name == "c"
    (tmp_path / "d.toml").write_text(TITLED.format("swing", "Balloon"), encoding="utf-8")
    assert carom.load("Swing").title == "Balloon"


@pytest.mark.usefixtures("titled")
def test_words_of_several_titles_are_refused_with_their_names() -> None:
    with pytest.raises(carom.UnknownError) as caught:
        carom.load("zebra swing")
    listed = '"a" (Zebra on a swing), "b" (A zebra\'s swing)'
    assert str(caught.value) == (
        f'there is no scene "zebra swing"; several titles have these words: {listed}'
    )


@pytest.mark.usefixtures("titled")
@pytest.mark.parametrize("name", ["zeb", "zebra zeppelin", "", "'", "..."])
def test_parts_of_words_and_words_of_no_single_title_find_nothing(name: str) -> None:
    with pytest.raises(carom.UnknownError, match="there is no scene"):
        carom.load(name)


def test_values_are_taken_out_by_none() -> None:
    assert carom.load("simtest4").emitters[0].max_spheres is not None
    assert carom.load("simtest4", {"emitters.0.max_spheres": None}).emitters[0].max_spheres is None


def test_a_scene_cannot_be_changed_but_replaced() -> None:
    scene = carom.load("simtest1")
    with pytest.raises(AttributeError):
        scene.name = "other"  # type: ignore[misc]
    assert replace(scene, forces=[]).forces == ()
