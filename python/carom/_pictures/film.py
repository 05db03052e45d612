"""Films that a notebook shows."""

from __future__ import annotations

import base64
import os
import tempfile
from pathlib import Path

from carom import _carom as engine
from carom._pictures.picture import check_graphics, checked_path, runtime_folder
from carom._scene.view import View


class Film:
    """A film of a scene in memory: the last value of a cell of a notebook plays in its output.

    What a notebook is exported to, like a page, has the film in it. `Scene.film` makes one.

    Attributes:
        data: The bytes of an mp4 file (H.264).
        size: Width and height [pixels].
        frames: How many frames it has.
        frame_rate: Frames per second.
    """

    __slots__ = ("data", "frame_rate", "frames", "size")

    def __init__(self, data: bytes, size: tuple[int, int], frames: int, frame_rate: int) -> None:
        self.data, self.size, self.frames, self.frame_rate = data, size, frames, frame_rate

    def __repr__(self) -> str:
        width, height = self.size
        seconds = round(self.frames / self.frame_rate, 3)
        kilobytes = round(len(self.data) / 1000)
        return f"<carom.Film of {seconds} s, {width} x {height} pixels, {kilobytes} kB>"

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the film into a file, whose name ends in .mp4.

        Raises:
            CaromError: For another ending.
            OSError: If the file cannot be written.
        """
        checked_path(path, ".mp4").write_bytes(self.data)

    def _repr_html_(self) -> str:
        """A player, with the film in it."""
        text = base64.b64encode(self.data).decode("ascii")
        width, height = self.size
        return (
            f'<video controls loop muted autoplay playsinline width="{width}" height="{height}" '
            f'style="max-width: 100%; height: auto" src="data:video/mp4;base64,{text}"></video>'
        )


def filmed(text: str, seconds: float | None, frame_rate: int, view: View) -> Film:
    """The film of the scene that is described in TOML."""
    with tempfile.TemporaryDirectory(prefix="carom-film-") as folder:
        path = Path(folder) / "film.mp4"
        frames = record(text, path, seconds, frame_rate, view)
        width, height = (int(length) for length in view.size)
        return Film(path.read_bytes(), (width, height), frames, frame_rate)


def record(
    text: str,
    path: str | os.PathLike[str],
    seconds: float | None,
    frame_rate: int,
    view: View,
) -> int:
    """Films the scene that is described in TOML into a file; the number of frames."""
    check_graphics()
    with runtime_folder():
        return engine.film_scene(text, checked_path(path, ".mp4"), seconds, frame_rate, view)
