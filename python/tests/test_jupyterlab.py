"""The viewer in a real JupyterLab, in Chromium: it draws, obeys Python, and tells it what a person
does."""

import base64
import time
import zlib
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import parse_qs, urlsplit

import pytest
from laboratory import CHROMIUM, Laboratory, laboratory, until

CELLS = [
    "import carom\nscene = carom.load('simtest1')\nviewer = scene.show(height=420)\nviewer",
    "player = scene.run(seconds=2).show(scene, size=(480, 270))\nplayer",
    "other = carom.load('cradle').show(height=300)\nother",
]

pytestmark = pytest.mark.skipif(
    not Path(CHROMIUM).exists(), reason=f"there is no Chromium at {CHROMIUM}"
)


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Laboratory]:
    with laboratory(CELLS, tmp_path_factory.mktemp("lab")) as lab:
        lab.run_cells()
        until(lambda: lab.python("'other' in globals() and other._ready"), "the last viewer")
        until(lambda: lab.python("viewer._ready"), "the first viewer")
        yield lab
        assert lab.complaints == []
        # Pictures and scripts that a page hands itself are no requests.
        asked = [urlsplit(url) for url in lab.requests]
        hosts = {url.hostname for url in asked if url.scheme not in ("blob", "data")}
        assert hosts == {"127.0.0.1"}


def time_of(lab: Laboratory, name: str = "viewer") -> float:
    now: float = lab.python(f"{name}.time")
    return now


def until_shown(lab: Laboratory) -> None:
    """Waits until Python has what the first viewer shows after the last command."""
    until(
        lambda: lab.python("viewer._shown.get('number') == viewer._last_command"),
        "what the viewer shows",
    )


def edits_of(lab: Laboratory) -> str:
    """The edits in the link of the first viewer, as text."""
    [packed] = parse_qs(lab.python("viewer.link")).get("edits", [""])
    padded = packed + "=" * (-len(packed) % 4)
    return zlib.decompress(base64.urlsafe_b64decode(padded)).decode() if packed else ""


def colours_of(lab: Laboratory, element: str) -> int:
    """How many colours a picture of the first such element has."""
    place = lab.page.locator(element).first
    place.scroll_into_view_if_needed()
    # In the page, which can read its own pictures.
    return int(
        lab.page.evaluate(
            """async (bytes) => {
              const picture = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
              const canvas = new OffscreenCanvas(picture.width, picture.height);
              const context = canvas.getContext("2d");
              context.drawImage(picture, 0, 0);
              const { data } = context.getImageData(0, 0, picture.width, picture.height);
              return new Set(new Uint32Array(data.buffer)).size;
            }""",
            list(place.screenshot()),
        )
    )


def test_the_viewer_draws_a_scene(lab: Laboratory) -> None:
    # A blank canvas has one colour, an interface without a scene a few dozen.
    until(lambda: colours_of(lab, ".carom-viewer canvas") > 1000, "a picture of a scene")


def test_time_goes_on_when_python_plays_and_stands_when_it_pauses(lab: Laboratory) -> None:
    lab.run("viewer.play()")
    begin = time_of(lab)
    until(lambda: time_of(lab) > begin + 0.2, "time going on")
    lab.run("viewer.pause()")
    until_shown(lab)
    then = time_of(lab)
    time.sleep(1)
    assert time_of(lab) == then and lab.python("viewer.playing") is False


def test_python_goes_to_a_time_and_picks_a_ball(lab: Laboratory) -> None:
    lab.run("viewer.seek(1.0); viewer.pick(0)")
    until(lambda: lab.python("viewer.link.endswith('&t=1')"), "a link to that time")
    assert lab.python("[viewer.time, viewer.picked]") == [1.0, 0]
    # The scene that comes back is that of a run in Python.
    until_shown(lab)
    assert lab.python("len(viewer.scene.spheres)") == 2
    lab.run("world = scene.world(); world.step(frames=round(1 / world.frame_time))")
    same = "(viewer.world().positions == world.positions).all().item()"
    assert lab.python(same) is True


def test_python_hears_what_a_person_does(lab: Laboratory) -> None:
    canvas = lab.page.locator(".carom-viewer canvas").first
    canvas.scroll_into_view_if_needed()
    box = canvas.bounding_box()
    assert box is not None
    # The sky, where no ball is.
    lab.page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 0.15 * box["height"])
    until(lambda: lab.python("viewer.picked") is None, "nothing picked")
    lab.page.keyboard.press("p")
    until(lambda: lab.python("viewer.playing"), "playing")
    lab.page.keyboard.press("p")
    until(lambda: not lab.python("viewer.playing"), "pausing")
    # The scene has emitted more while it played.
    before = lab.python("len(viewer.scene.spheres)")
    # Keys of the notebook: they would delete the cell and add another. The last throws a ball.
    for key in "ddb":
        lab.page.keyboard.press(key)
    until(lambda: lab.python("len(viewer.scene.spheres)") == before + 1, "a ball thrown")
    assert lab.page.locator(".jp-Notebook .jp-Cell").count() == len(CELLS)


def test_an_edit_arrives_on_either_side(lab: Laboratory) -> None:
    lab.run("viewer.set_restitution(0.25)")
    restitutions = "[collider.restitution for collider in viewer.scene.colliders]"
    until(lambda: set(lab.python(restitutions)) == {0.25}, "the edit of Python")
    # By hand: it is taken back.
    lab.page.locator(".carom-viewer canvas").first.focus()
    lab.page.keyboard.press("Control+z")
    until(lambda: 0.25 not in lab.python(restitutions), "the edit by hand")


def test_another_scene_is_shown(lab: Laboratory) -> None:
    lab.run("other.scene = carom.load('hourglass')")
    until(lambda: lab.python("other.scene.name == 'hourglass'"), "the other scene")
    until(lambda: lab.python("len(other.scene.spheres) > 0"), "its spheres")
    assert lab.python("viewer.scene.name") == "simtest1"


def test_viewers_of_a_notebook_share_one_module(lab: Laboratory) -> None:
    assert lab.page.evaluate("Object.keys(caromInterfaces).length") == 1
    assert lab.page.locator(".carom-viewer canvas").count() == 2


def test_a_recorded_run_is_played_to_its_end_and_goes_where_it_is_told(lab: Laboratory) -> None:
    lab.run("player.play()")
    until(lambda: not lab.python("player.playing"), "the end of the run")
    assert time_of(lab, "player") == 2.0
    canvas = lab.page.locator(".carom-animated canvas")
    until(lambda: canvas.get_attribute("data-state") == "100", "its last state")
    lab.run("player.seek(0.5)")
    until(lambda: canvas.get_attribute("data-state") == "25", "the state of a time")
    assert colours_of(lab, ".carom-animated canvas") > 1000
    slider = lab.page.locator(".carom-animated input")
    slider.fill("50")
    until(lambda: time_of(lab, "player") == 1.0, "the time of the slider")


def test_a_page_opened_anew_goes_on_where_it_was(lab: Laboratory) -> None:
    lab.run("viewer.pause(); viewer.seek(1.5); viewer.set_restitution(0.75)")
    until(lambda: lab.python("viewer.scene.colliders[0].restitution == 0.75"), "the edit")
    # The link comes later than the scene, and is what the page opens.
    until(
        lambda: "&t=1.5" in lab.python("viewer.link") and "0.75" in edits_of(lab),
        "a link to that time, with the edit",
    )
    lab.page.evaluate("jupyterapp.commands.execute('docmanager:save')")
    lab.run("viewer._ready = False; viewer._scene_text = None")
    lab.page.reload()
    until(lambda: lab.python("viewer._ready"), "the viewer again")
    until(lambda: lab.python("viewer._scene_text is not None"), "its scene")
    assert time_of(lab) == 1.5
    assert lab.python("viewer.scene.colliders[0].restitution") == 0.75


def test_a_viewer_that_plays_is_not_held_back_by_what_it_tells(lab: Laboratory) -> None:
    lab.run("viewer.seek(0); told = []; viewer.observe(lambda it: told.append(it.new), 'time')")
    lab.run("viewer.play()")
    until(lambda: time_of(lab) > 1.0, "a second")
    until(lambda: len(lab.python("told")) > 3, "reported times")
    lab.run("viewer.pause()")
    times = lab.python("told")
    assert times == sorted(times)


def test_the_last_of_two_seeks_counts_and_its_scene_comes_again(lab: Laboratory) -> None:
    lab.run("viewer.pause(); viewer.seek(0.5)")
    until_shown(lab)
    # Back where it was: the browser has sent this scene before, but Python no longer has it.
    lab.run("before, viewer._scene_text = viewer._scene_text, None")
    lab.run("viewer.seek(0.6); viewer.seek(0.5)")
    until(lambda: lab.python("viewer._scene_text is not None"), "the scene")
    assert lab.python("viewer._scene_text") == lab.python("before")
