"""Pictures and films show what is there, where it is. They need a graphics driver, for which one in
software is enough."""

import base64
import math
import os
import re
import struct
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest
from command import carom_command
from interrupts import ctrl_c
from numpy.typing import NDArray

import carom
from carom import _carom as engine

SMALL = (320, 180)
NAN, INF = float("nan"), float("inf")
RED, GREEN = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
CAMERA = carom.Camera((0, 0, 10), vertical_fov_degrees=60)


def lone(position: tuple[float, float, float]) -> carom.Scene:
    """A red ball of 0.2 m before nothing."""
    ball = carom.Sphere(position=position, radius=0.2, color=RED)
    return carom.Scene(name="lone", spheres=[ball], camera=CAMERA)


def is_red(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    red, green, blue = np.moveaxis(picture.astype(int), -1, 0)
    return np.asarray((red > green + 60) & (red > blue + 60))


def is_green(picture: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return is_red(picture[..., [1, 0, 2]])


def middle(mask: NDArray[np.bool_]) -> tuple[float, float]:
    """Column and row [pixels], counted from the corner of the picture."""
    rows, columns = np.nonzero(mask)
    return float(columns.mean() + 0.5), float(rows.mean() + 0.5)


@pytest.mark.parametrize("x", [-3.0, 0.0, 2.5])
@pytest.mark.parametrize("y", [-1.5, 2.0])
def test_a_ball_is_seen_where_it_is(x: float, y: float) -> None:
    picture = lone((x, y, 0)).picture(size=SMALL, stamp=False)
    width, height = SMALL
    # Similar triangles: half the height is seen under half the field of view.
    scale = 0.5 * height / (10 * math.tan(math.radians(30)))
    # The outline of a ball of 0.2 m at 10 m lies about its centre to a hundredth of a pixel;
    # shaded edges may be counted or not.
    column, row = middle(is_red(picture))
    assert column == pytest.approx(0.5 * width + scale * x, abs=0.7)
    assert row == pytest.approx(0.5 * height - scale * y, abs=0.7)
    assert is_red(picture).sum() == pytest.approx(math.pi * (0.2 * scale) ** 2, rel=0.25)


def test_a_ball_is_seen_from_where_the_camera_is() -> None:
    scene = lone((0, 0, 0))
    from_above = scene.picture(size=SMALL, stamp=False, camera=((1, 5, 0), (1, 0, 0)))
    # Seen from above, -z is up; the ball is 1 m to the left of what is looked at.
    column, row = middle(is_red(from_above))
    assert column < 0.5 * SMALL[0] - 20
    assert row == pytest.approx(0.5 * SMALL[1], abs=0.7)
    other = scene.picture(size=SMALL, stamp=False, camera=carom.Camera((0, 1, 10)))
    assert middle(is_red(other))[1] > 0.5 * SMALL[1] + 5
    fitted = scene.picture(size=SMALL, stamp=False, camera="fit")
    assert is_red(fitted).sum() > 20 * is_red(other).sum()


def test_a_picture_is_that_of_the_command_line_byte_for_byte(tmp_path: Path) -> None:
    ours, theirs = tmp_path / "new" / "ours.png", tmp_path / "theirs.png"
    carom.load("simtest1").picture(ours, seconds=2, size=SMALL)
    carom_command("picture", "simtest1", "--at", "2", "--size", "320x180", "--out", str(theirs))
    assert ours.read_bytes() == theirs.read_bytes()


def test_a_world_is_seen_as_it_is_now() -> None:
    scene = carom.load("simtest1")
    world = scene.world()
    world.step(frames=100)
    np.testing.assert_array_equal(
        world.picture(size=SMALL), scene.picture(seconds=100 * world.frame_time, size=SMALL)
    )
    before = world.picture(size=SMALL, stamp=False)
    world.step(frames=10)
    assert (world.picture(size=SMALL, stamp=False) != before).any()


def test_a_stamp_is_at_the_lower_left() -> None:
    scene = lone((0, 0, 0))
    plain, stamped = scene.picture(size=SMALL, stamp=False), scene.picture(size=SMALL)
    rows, columns = np.nonzero((plain != stamped).any(axis=-1))
    assert len(rows) > 500
    assert rows.min() > 0.8 * SMALL[1] and columns.max() < 0.6 * SMALL[0]


def test_a_renderer_draws_one_world_after_the_other() -> None:
    world = lone((0, 0, 0)).world()
    renderer = carom.Renderer(world, size=(192, 144), quality="fine")
    first = renderer.render(world)
    assert first.shape == (144, 192, 3)
    assert first.dtype == np.uint8
    assert first.flags.c_contiguous and first.flags.writeable
    np.testing.assert_array_equal(first, world.picture(size=(192, 144), stamp=False))
    world.positions = (1, 0, 0)
    moved = renderer.render(world)
    assert middle(is_red(moved))[0] > middle(is_red(first))[0] + 2
    other = carom.World()
    assert not is_red(renderer.render(other)).any()


def test_what_is_added_is_drawn_in_its_own_colour() -> None:
    world = carom.Scene(name="empty", camera=CAMERA).world()
    renderer = carom.Renderer(world, size=SMALL)

    def seen() -> tuple[bool, bool]:
        picture = renderer.render(world)
        return bool(is_red(picture).any()), bool(is_green(picture).any())

    assert seen() == (False, False)
    ball = world.add_sphere(carom.Sphere(radius=0.5, color=RED))
    assert seen() == (True, False)
    world.set_sphere(ball, carom.Sphere(radius=0.5, color=GREEN))
    assert seen() == (False, True)
    world.remove_sphere(ball)
    plate = world.add_collider(carom.Collider(carom.Box((1, 1, 1)), color=RED))
    assert seen() == (True, False)
    world.set_collider(plate, carom.Collider(carom.Box((1, 1, 1)), color=GREEN))
    assert seen() == (False, True)
    world.set_collider(plate, carom.Collider(carom.Box((1, 1, 1)), color=RED, visible=False))
    assert seen() == (False, False)
    world.add_emitter(carom.Emitter(carom.Sphere(radius=0.5, color=GREEN), period=1))
    world.step(dt=0.01)
    # The plate is hidden and there all the same: the ball appears within it.
    assert seen() == (False, True)


def boxes(content: bytes) -> dict[str, bytes]:
    """The innermost boxes of an mp4 file (ISO 14496-12) by their kinds, the last of each."""
    found: dict[str, bytes] = {}
    place = 0
    while place + 8 <= len(content):
        length, name = struct.unpack(">I4s", content[place : place + 8])
        assert length >= 8, "a box has a head"
        kind, inner = name.decode("latin-1"), content[place + 8 : place + length]
        is_full = kind in {"moov", "trak", "mdia", "minf", "stbl"}
        found.update(boxes(inner) if is_full else {kind: inner})
        place += length
    return found


def film(path: Path) -> tuple[int, float, tuple[int, int]]:
    """Frames, seconds and size of a film, by what its boxes say."""
    found = boxes(path.read_bytes())
    _, _, frames = struct.unpack(">III", found["stsz"][:12])
    ticks, duration = struct.unpack(">II", found["mdhd"][12:20])
    width, height = struct.unpack(">II", found["tkhd"][-8:])
    return frames, duration / ticks, (width >> 16, height >> 16)


def test_a_film_has_the_length_and_size_that_were_asked_for(tmp_path: Path) -> None:
    path = tmp_path / "films" / "a.mp4"
    scene = carom.load("simtest1")
    assert scene.record(path, seconds=0.5, frame_rate=24, size=(128, 72), quality="draft") == 12
    assert film(path) == (12, 0.5, (128, 72))
    short = scene.with_changes({"simulation.duration": 0.1})
    assert short.record(path, size=(128, 72), quality="draft") == 3
    assert film(path) == (3, 0.1, (128, 72))


def test_a_film_is_that_of_the_command_line_byte_for_byte(tmp_path: Path) -> None:
    ours, theirs = tmp_path / "ours.mp4", tmp_path / "theirs.mp4"
    carom.load("simtest1").record(ours, seconds=0.2, size=SMALL)
    arguments = ("--seconds", "0.2", "--size", "320x180", "--out", str(theirs))
    carom_command("record", "simtest1", *arguments)
    assert ours.read_bytes() == theirs.read_bytes()


def test_a_film_in_memory_is_that_of_a_file_and_shows_itself(tmp_path: Path) -> None:
    scene = carom.load("simtest1")
    film = scene.film(0.2, frame_rate=24, size=(128, 72), quality="draft")
    path = tmp_path / "film.mp4"
    scene.record(path, seconds=0.2, frame_rate=24, size=(128, 72), quality="draft")
    assert film.data == path.read_bytes()
    assert (film.frames, film.size, film.frame_rate) == (5, (128, 72), 24)
    assert repr(film).startswith("<carom.Film of 0.208 s, 128 x 72 pixels, ")
    film.save(tmp_path / "saved.mp4")
    assert (tmp_path / "saved.mp4").read_bytes() == film.data
    with pytest.raises(carom.CaromError, match=r"must end in \.mp4"):
        film.save(tmp_path / "saved.gif")
    page = film._repr_html_()
    text = re.search(r'src="data:video/mp4;base64,([^"]*)"', page)
    assert text is not None and base64.b64decode(text[1]) == film.data


def test_what_was_filmed_until_ctrl_c_is_a_film(tmp_path: Path) -> None:
    path = tmp_path / "a.mp4"

    def has_begun() -> bool:
        return sum(file.stat().st_size for file in tmp_path.iterdir()) > 10_000

    # Ctrl-C is pressed by another thread, which runs meanwhile.
    with pytest.raises(KeyboardInterrupt), ctrl_c(once=has_begun):
        carom.load("simtest1").record(path, seconds=1e6, size=(128, 72), quality="draft")
    frames, seconds, _ = film(path)
    assert frames >= 1 and seconds == pytest.approx(frames / 30)
    assert [file.name for file in tmp_path.iterdir()] == ["a.mp4"]


def test_a_film_of_a_scene_that_overflows_ends_before(tmp_path: Path) -> None:
    scene = carom.Scene(
        name="far",
        simulation=carom.Simulation(rule="discrete", frame_time=0.5),
        forces=[carom.Gravity((0, -1e308, 0))],
        spheres=[carom.Sphere(radius=1)],
        camera=CAMERA,
    )
    with pytest.raises(carom.StepError, match="no longer finite"):
        scene.record(tmp_path / "a.mp4", seconds=10, size=(128, 72), quality="draft")
    assert film(tmp_path / "a.mp4")[0] >= 1


Case: TypeAlias = tuple[dict[str, Any], type[Exception], str]


def refusals(*cases: Case) -> Callable[..., Any]:
    return pytest.mark.parametrize(("arguments", "error", "words"), cases)


# Only the engine reads texts.
NEARER_THAN_NOTHING = carom.Camera((0, 0, 9), near="-1 m")  # type: ignore[arg-type]

BOTH: list[Case] = [
    ({"size": (0, 9)}, carom.CaromError, "size: "),
    ({"size": (-1, 9)}, carom.CaromError, "size: must be in [1, 2^32) each, not (-1, 9)"),
    ({"size": (2**40, 9)}, carom.CaromError, "size: "),
    ({"size": (10**6, 100)}, carom.CaromError, "size: "),
    ({"size": 9}, TypeError, "size: must be width and height in pixels, not 9"),
    ({"size": (1.5, 9)}, TypeError, "size: "),
    ({"camera": "left"}, carom.CaromError, "camera: must be one of scene, fit, front, top, not l"),
    ({"camera": 3}, TypeError, "camera: must be a name, a carom.Camera, or two points"),
    ({"camera": [(1, 2, 3), (1, 2, 3)]}, carom.CaromError, "camera: "),
    ({"camera": [(1, 2, 3), (1, 2, NAN)]}, carom.CaromError, "camera: "),
    ({"camera": NEARER_THAN_NOTHING}, carom.SceneError, "camera.near: must be positive"),
    ({"quality": "best"}, carom.CaromError, "quality: must be fine, good or draft, not best"),
    ({"seconds": -1}, carom.CaromError, "seconds: must be zero or positive, and finite, not -1"),
    ({"seconds": NAN}, carom.CaromError, "seconds: "),
    ({"seconds": INF}, carom.CaromError, "seconds: "),
    ({"seconds": "1"}, TypeError, "seconds: must be a number, not str"),
    ({"path": 5}, TypeError, "path: must be a path, not int"),
    ({"path": "/dev/null/a.{}"}, OSError, "path: cannot write /dev/null/a."),
    ({"path": "a.jpg"}, carom.CaromError, "path: a.jpg must end in ."),
]


def ending(arguments: dict[str, Any], kind: str) -> dict[str, Any]:
    path = arguments.get("path", "a.{}")
    return {**arguments, "path": path.format(kind) if isinstance(path, str) else path}


@refusals(*BOTH)
def test_a_picture_that_cannot_be(
    arguments: dict[str, Any],
    error: type[Exception],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error) as caught:
        lone((0, 0, 0)).picture(**ending(arguments, "png"))
    assert str(caught.value).startswith(words)
    assert not list(tmp_path.iterdir())


@refusals(
    *BOTH,
    ({"size": (33, 64)}, carom.CaromError, "size: a film cannot have 33 x 64 pixels"),
    ({"frame_rate": 0}, carom.CaromError, "frame_rate: a film cannot have 0 frames per second"),
    ({"frame_rate": 77}, carom.CaromError, "frame_rate: "),
    ({"frame_rate": -1}, carom.CaromError, "frame_rate: "),
    ({"frame_rate": 29.97}, TypeError, "frame_rate: must be a whole number, not float"),
)
def test_a_film_that_cannot_be(
    arguments: dict[str, Any],
    error: type[Exception],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error) as caught:
        lone((0, 0, 0)).record(**ending(arguments, "mp4"))
    assert str(caught.value).startswith(words)
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform != "linux", reason="limits the size of files")
def test_where_a_film_cannot_be_finished_the_error_says_where_its_frames_are(
    tmp_path: Path,
) -> None:
    # Where a folder is, no film can be made of the frames; and then a frame does not fit.
    (tmp_path / "film.mp4.0.closing").mkdir()
    program = """
import resource, sys
import carom
try:
    if sys.argv[1:]:
        resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[1]),) * 2)
    carom.load("simtest1").record("film.mp4", seconds=1, size=(96, 54), quality="draft")
except OSError as error:
    print(error, "|", error.__cause__)
"""
    env = {**os.environ, "MESA_SHADER_CACHE_DISABLE": "true"}
    for limit in ([], ["6000"]):
        command = [sys.executable, "-c", program, *limit]
        done = subprocess.run(
            command, cwd=tmp_path, env=env, capture_output=True, text=True, check=False
        )
        assert "film.mp4.0.unfinished, for `carom recover`" in done.stdout, done
        assert ("File too large" in done.stdout) == bool(limit), done.stdout
        (tmp_path / "film.mp4.0.unfinished").unlink()


def test_a_notebook_shows_a_png() -> None:
    scene = lone((0, 0, 0))
    for content in (scene._repr_png_(), scene.world()._repr_png_()):
        assert content is not None
        assert content[:8] == b"\x89PNG\r\n\x1a\n"
        assert struct.unpack(">II", content[16:24]) == (640, 360)


@pytest.mark.skipif(sys.platform != "linux", reason="hides the drivers of Linux")
def test_without_a_driver_the_error_names_one() -> None:
    program = (
        "import carom; print(carom.load('simtest1')._repr_png_()); carom.Renderer(carom.World())"
    )
    hidden = {
        "VK_DRIVER_FILES": "/nowhere",
        "VK_ICD_FILENAMES": "/nowhere",
        "__EGL_VENDOR_LIBRARY_DIRS": "/nowhere",
    }
    command = [sys.executable, "-c", program]
    done = subprocess.run(
        command, env={**os.environ, **hidden}, capture_output=True, text=True, check=False
    )
    assert done.stdout == "None\n"
    assert "GraphicsError: no graphics adapter found" in done.stderr
    assert "mesa-vulkan-drivers" in done.stderr


def test_without_graphics_a_notebook_shows_no_picture(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise carom.GraphicsError("no graphics adapter found")

    monkeypatch.setattr(engine, "Painter", refuse)
    assert lone((0, 0, 0))._repr_png_() is None
    assert lone((0, 0, 0)).world()._repr_png_() is None
    broken = carom.Scene(name="broken", spheres=[carom.Sphere(radius=1)] * 2)
    assert broken._repr_png_() is None


def test_a_build_without_pictures_says_so(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delattr(engine, "Painter")
    scene = lone((0, 0, 0))
    for call in (scene.picture, scene.world().picture, lambda: carom.Renderer(scene)):
        with pytest.raises(carom.GraphicsError, match="pip install"):
            call()
    with pytest.raises(carom.GraphicsError, match="pip install"):
        scene.record(tmp_path / "a.mp4")


@pytest.mark.skipif(sys.platform != "linux", reason="there is always a display")
@pytest.mark.parametrize("has_window", [engine.HAS_WINDOW, True])
def test_a_window_that_cannot_be_opened_says_why(
    has_window: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    # A build without a window that believes to have one refuses the command `view` instead.
    monkeypatch.setattr(engine, "HAS_WINDOW", has_window)
    # Until it fails, however busy the machine is.
    monkeypatch.setattr("carom._pictures.window.START", 120.0)
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_SOCKET", raising=False)
    with pytest.raises(carom.GraphicsError) as caught:
        lone((0, 0, 0)).view()
    assert len(str(caught.value)) > 20
    with pytest.raises(carom.SceneError):
        carom.Scene(name="broken", spheres=[carom.Sphere(radius=1)] * 2).view()


def test_no_library_complains_where_a_server_names_no_runtime_folder() -> None:
    program = (
        "import os, carom; carom.load('simtest1').picture(size=(64, 36)); "
        "assert 'XDG_RUNTIME_DIR' not in os.environ"
    )
    environment = {name: it for name, it in os.environ.items() if name != "XDG_RUNTIME_DIR"}
    command = [sys.executable, "-c", program]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")
