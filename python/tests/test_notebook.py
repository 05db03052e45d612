"""Widgets of notebooks without a browser: what they tell it, and what is shown where none is."""

import base64
import json
import sys
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest
from nbclient import NotebookClient
from nbconvert import HTMLExporter

import carom
from carom._pictures.picture import painter_of
from carom._pictures.stage import Stage
from carom._pictures.still import Still
from carom._scene.view import View
from carom.notebook import AnimatedTrajectory, Viewer
from carom.notebook import _built as built

NOTEBOOK = Path(__file__).parents[2] / "docs" / "notebook.ipynb"
WIDGET = "application/vnd.jupyter.widget-view+json"
PNG = b"\x89PNG\r\n\x1a\n"


def viewer_of(scene: carom.Scene | carom.World) -> Viewer:
    viewer = scene.show()
    assert isinstance(viewer, Viewer)
    return viewer


@pytest.fixture
def viewer() -> Viewer:
    return viewer_of(carom.load("simtest1"))


@pytest.fixture
def sent(viewer: Viewer, monkeypatch: pytest.MonkeyPatch) -> list[tuple[Any, Any]]:
    """Messages that the browser would get."""
    messages: list[tuple[Any, Any]] = []
    monkeypatch.setattr(viewer, "send", lambda it, buffers=None: messages.append((it, buffers)))
    return messages


def linked_text(viewer: Viewer) -> str:
    """The scene file in the link of a viewer."""
    fields = dict(part.split("=", 1) for part in viewer.link.split("&"))
    packed = fields["file"] + "=" * (-len(fields["file"]) % 4)
    return zlib.decompress(base64.urlsafe_b64decode(packed)).decode()


def test_a_viewer_holds_the_scene_whole() -> None:
    scene = carom.load("cradle")
    viewer = viewer_of(scene)
    assert linked_text(viewer) == scene.to_toml()
    assert viewer.scene == scene
    assert (viewer.time, viewer.playing, viewer.picked) == (0.0, False, None)


def test_a_viewer_of_a_world_begins_as_the_world_is_now() -> None:
    world = carom.load("simtest1").world()
    world.step(frames=50)
    shown = viewer_of(world).world()
    np.testing.assert_array_equal(shown.positions, world.positions)
    np.testing.assert_array_equal(shown.velocities, world.velocities)


def test_a_viewer_shows_its_picture_where_there_are_no_widgets(viewer: Viewer) -> None:
    bundle = viewer._repr_mimebundle_()
    assert bundle is not None
    data, _ = bundle
    assert base64.b64decode(data["image/png"]).startswith(PNG)
    assert data[WIDGET]["model_id"] == viewer.model_id
    assert data["text/plain"] == "<carom.notebook.Viewer of 'simtest1' at 0 s, paused>"


def test_methods_set_the_traits_that_the_browser_follows(viewer: Viewer) -> None:
    viewer.play()
    viewer.seek(2)
    viewer.pick(3)
    state = viewer.get_state(["time", "playing", "picked"])
    assert state == {"time": 2.0, "playing": True, "picked": 3}
    viewer.pause()
    viewer.pick(None)
    assert not viewer.playing and viewer.picked is None


@pytest.mark.parametrize("time", [-1.0, float("nan"), float("inf")])
def test_a_time_that_makes_no_sense_is_refused_and_changes_nothing(
    viewer: Viewer, time: float
) -> None:
    with pytest.raises(carom.CaromError, match="time: must be zero or positive"):
        viewer.seek(time)
    assert viewer.time == 0.0


def test_what_makes_no_sense_is_refused_by_its_name(viewer: Viewer) -> None:
    with pytest.raises(carom.CaromError, match="picked: must be an id"):
        viewer.pick(-1)
    still = viewer_of(carom.load("cradle"))
    for id in (-1, 99):
        with pytest.raises(carom.CaromError, match=f"id: no sphere has the id {id}"):
            still.set_sphere(id, mass=2)
        with pytest.raises(carom.CaromError, match=f"id: no sphere has the id {id}"):
            still.remove_sphere(id)
    still.set_sphere(3, mass=2)
    with pytest.raises(TypeError, match="colour: must be one of position, velocity"):
        viewer.set_sphere(0, colour=1)
    with pytest.raises(carom.CaromError, match="height: must be in"):
        carom.load("simtest1").show(height=10)
    with pytest.raises(TypeError, match="scene: must be a Scene or a World, not str"):
        carom.load("simtest1").run(seconds=0.1).show("simtest1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="scene: must be a Scene or a World, not int"):
        viewer.scene = 1  # type: ignore[assignment]
    with pytest.raises(TypeError, match="height: must be a whole number"):
        carom.load("simtest1").show(height="tall")  # type: ignore[arg-type]


def test_edits_wait_for_the_interface_and_arrive_in_their_order(
    viewer: Viewer, sent: list[tuple[Any, Any]]
) -> None:
    viewer.set_sphere(3, velocity=(0, 5, 0), mass=2)
    viewer.set_restitution(0.5)
    assert sent == []
    viewer._ready = True
    texts = [message["content"] for message, _ in sent if message["kind"] == "edit"]
    velocity = "changes = { velocity = [0.0, 5.0, 0.0], mass = 2.0 }"
    assert texts == [
        f"change = {{ sphere = {{ sphere = 3, {velocity} }} }}",
        "change = { all-collider-restitutions = 0.5 }",
    ]
    viewer.remove_sphere(1)
    last = {"kind": "edit", "content": "change = { remove-sphere = 1 }", "number": 4}
    assert sent[-1][0] == last


def test_a_report_that_was_on_its_way_does_not_undo_a_command(
    viewer: Viewer, sent: list[tuple[Any, Any]]
) -> None:
    viewer._ready = True
    [(caught_up, _)] = sent
    assert caught_up["content"] == {"time": 0.0, "playing": False, "picked": None}
    viewer.play()
    before = {"time": 0.5, "playing": False, "picked": None, "number": caught_up["number"]}
    viewer.set_state({"_shown": before, "_scene_shown": {"text": "", "number": 0}})
    assert viewer.playing and viewer.time == 0.0 and viewer.scene.name == "simtest1"
    after = {"time": 0.5, "playing": True, "picked": 1, "number": sent[-1][0]["number"]}
    viewer.set_state({"_shown": after})
    assert (viewer.time, viewer.playing, viewer.picked) == (0.5, True, 1)
    # What the browser reported is no command.
    assert [message["content"] for message, _ in sent[1:]] == [{"playing": True}]


def test_a_viewer_hands_the_interface_to_a_document_that_has_none(
    viewer: Viewer, sent: list[tuple[Any, Any]]
) -> None:
    viewer._hear(viewer, {"kind": "interface"}, [])
    [(message, [script, module])] = sent
    assert message == {"kind": "interface"}
    assert zlib.decompress(module, 31).startswith(b"\0asm")
    assert b"export" in zlib.decompress(script, 31)


def test_what_was_edited_in_the_browser_is_the_scene(viewer: Viewer) -> None:
    changed = carom.load("simtest1").with_changes({"colliders.0.restitution": 0.25})
    told = {"time": 1.5, "playing": False, "picked": 2, "number": 0}
    viewer.set_state({"_scene_shown": {"text": changed.to_toml(), "number": 0}, "_shown": told})
    assert viewer.scene == changed
    assert (viewer.time, viewer.picked) == (1.5, 2)
    viewer.set_state({"_scene_shown": {"text": "", "number": 0}})
    with pytest.raises(carom.CaromError, match="too large to come back"):
        _ = viewer.scene


@pytest.mark.usefixtures("sent")
def test_a_scene_on_its_way_is_out_of_date_only_after_what_may_change_it(viewer: Viewer) -> None:
    viewer._ready = True
    changed = carom.load("simtest1").with_changes({"colliders.0.restitution": 0.25})
    viewer.seek(1.5)
    told = {"text": changed.to_toml(), "number": viewer._last_command}
    viewer.pick(2)
    viewer.set_state({"_scene_shown": told})
    assert viewer.scene == changed
    told = {"text": "name = 'old'\n", "number": viewer._last_command}
    viewer.set_restitution(0.5)
    viewer.set_state({"_scene_shown": told})
    assert viewer.scene == changed


def test_another_scene_takes_the_place_of_one(viewer: Viewer, sent: list[tuple[Any, Any]]) -> None:
    viewer._ready = True
    told = {"time": 1.5, "playing": False, "picked": None, "number": 1}
    viewer.set_state({"_scene_shown": {"text": "name = 'old'\n", "number": 1}, "_shown": told})
    assert viewer.time == 1.5
    viewer.scene = carom.load("cradle")
    assert viewer.scene == carom.load("cradle") and viewer.time == 0.0
    contents = [(message["kind"], message["content"]) for message, _ in sent[1:]]
    assert contents == [("open", viewer.link), ("set", {"time": 0.0})]


def test_a_scene_that_makes_no_sense_is_refused() -> None:
    twice = [carom.Sphere(radius=1), carom.Sphere(radius=1)]
    with pytest.raises(carom.SceneError):
        carom.Scene(name="twice", spheres=twice).show()


def still_of(shown: object) -> Still:
    assert isinstance(shown, Still)
    return shown


@pytest.fixture
def without_anywidget(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [it for it in sys.modules if it.startswith("carom.notebook")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "anywidget", None)


@pytest.mark.usefixtures("without_anywidget")
def test_without_anywidget_pictures_say_how_to_get_it() -> None:
    scene = carom.load("simtest1")
    for shown in [scene.show(), scene.world().show(), scene.run(seconds=0.1).show(scene)]:
        still = still_of(shown)
        data = still._repr_mimebundle_()
        assert base64.b64decode(data["image/png"]).startswith(PNG)
        assert "pip install &#x27;carom[notebook]&#x27;" in data["text/html"]
        with pytest.raises(AttributeError, match=r"pip install 'carom\[notebook\]'"):
            still.play()


@pytest.fixture
def without_interface(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    monkeypatch.setattr(built, "_FOLDER", tmp_path)
    built.built_interface.cache_clear()
    yield
    built.built_interface.cache_clear()


@pytest.mark.usefixtures("without_interface")
def test_a_build_without_the_interface_shows_a_picture_that_says_so() -> None:
    still = still_of(carom.load("simtest1").show())
    assert "cargo xtask notebook" in still._repr_mimebundle_()["text/plain"]


def player_of(run: carom.Trajectory, scene: carom.Scene | None = None) -> AnimatedTrajectory:
    player = run.show(scene)
    assert isinstance(player, AnimatedTrajectory)
    return player


# Spheres and colliders that move, that come, of several colours and finishes.
@pytest.mark.parametrize("name", ["simtest1", "galton", "hourglass", "avalanche"])
def test_a_player_draws_states_as_they_are_drawn_when_they_come(name: str) -> None:
    scene = carom.load(name)
    world = scene.world()
    player = player_of(world.run(frames=40), scene)
    sent: list[tuple[Any, Any]] = []
    player.send = lambda it, buffers=None: sent.append((it, buffers))
    player._hear(player, {"state": 40}, [])
    [(message, [picture])] = sent
    assert message == {"state": 40}
    view = View.of((640, 360), "scene", "good", stamp=True)
    assert picture == painter_of(scene.world(), view).png(world)


def test_a_player_without_a_scene_looks_at_where_the_spheres_go() -> None:
    # The first of them come after a while.
    run = carom.load("simtest1").run(seconds=2.5)
    stage = Stage(run, None, View.of((160, 90), "scene", "good", stamp=False))
    empty = stage._painter.paint(stage._empty.world()).astype(int)
    seen = (
        abs(stage._painter.paint(stage._world(len(run) - 1)).astype(int) - empty).max(axis=2) > 30
    )
    # Four spheres, as large as they can be in the picture without filling it.
    assert 0.005 < seen.mean() < 0.5


def test_a_player_hears_of_no_state_that_is_not_there() -> None:
    player = player_of(carom.load("simtest1").run(seconds=0.1))
    player.send = lambda *_, **__: pytest.fail("an answer")
    for state in [-1, 1000, "1", None]:
        player._hear(player, {"state": state}, [])


def test_a_player_refuses_what_makes_no_sense() -> None:
    scene = carom.load("simtest1")
    player = player_of(scene.run(seconds=0.1))
    with pytest.raises(carom.CaromError, match="speed: must be positive"):
        player.speed = 0
    with pytest.raises(carom.CaromError, match="positions"):
        scene.run(seconds=0.1, quantities=["velocities"]).show()


def test_the_notebook_of_the_documents_runs_and_shows_what_it_says(tmp_path: Path) -> None:
    written = nbformat.read(NOTEBOOK, as_version=4)
    again = nbformat.read(NOTEBOOK, as_version=4)
    NotebookClient(again, timeout=300, kernel_name="python3", store_widget_state=False).execute(
        cwd=str(tmp_path)
    )
    for before, after in zip(written.cells, again.cells, strict=True):
        if before.cell_type == "code":
            assert kinds_and_texts(before) == kinds_and_texts(after), before.source
    page, _ = HTMLExporter().from_notebook_node(written)
    assert page.count('src="data:image/png;base64') == 2


def kinds_and_texts(cell: Any) -> list[Any]:
    """What a cell has put out: kinds of data, and text."""
    return [(sorted(it.get("data", {})), it.get("text"), texts(it)) for it in cell.outputs]


def texts(output: Any) -> Any:
    return json.dumps(output.get("data", {}).get("text/plain"))
