"""What the widgets of notebooks have in common: a picture of theirs, where there are no widgets."""

from __future__ import annotations

import base64
import math
from typing import Any

import anywidget
import traitlets

from carom.errors import CaromError


class Widget(anywidget.AnyWidget):
    """A widget with a picture, which shows where it cannot."""

    time = traitlets.Float(0.0).tag(sync=True)
    playing = traitlets.Bool(False).tag(sync=True)
    height = traitlets.Int(480).tag(sync=True)
    _picture = traitlets.Bytes(b"").tag(sync=True)

    @traitlets.validate("time")
    def _check_time(self, proposal: dict[str, Any]) -> float:
        time = float(proposal["value"])
        if not 0 <= time < math.inf:
            raise CaromError(f"time: must be zero or positive, and finite, not {time}", "time")
        return time

    def play(self) -> None:
        """Plays."""
        self.playing = True

    def pause(self) -> None:
        """Pauses."""
        self.playing = False

    def seek(self, time: float) -> None:
        """Goes to the frame nearest to a time [s].

        Raises:
            CaromError: For a time that is negative or not finite.
        """
        self.time = time

    def _repr_mimebundle_(self, **_: Any) -> tuple[dict[str, Any], dict[str, Any]] | None:
        """The widget, its picture where there are none, as on pages, and its text."""
        bundle = super()._repr_mimebundle_()
        if bundle is None:
            return None
        data, metadata = bundle
        data["text/plain"] = repr(self)
        if self._picture:
            data["image/png"] = base64.b64encode(self._picture).decode("ascii")
        return data, metadata


def checked_height(height: int) -> int:
    """The height of a widget [pixels]."""
    if isinstance(height, bool) or not isinstance(height, int):
        raise TypeError(f"height: must be a whole number, not {type(height).__name__}")
    if not 240 <= height <= 2000:
        raise CaromError(f"height: must be in [240, 2000], not {height}", "height")
    return height
