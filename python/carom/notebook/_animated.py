"""A recorded run in the output of a notebook."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import traitlets

from carom._pictures.stage import Stage
from carom.errors import CaromError
from carom.notebook._widget import Widget


class AnimatedTrajectory(Widget):
    """A player of a recorded run, in the output of a cell: `Trajectory.show` makes it.

    It shows the recorded states and nothing else: whatever moved the spheres, each is drawn as
    `carom.Renderer` draws it, when it is seen first. Python has to be there for that; while it is
    at work on a cell, the player waits.

    Attributes:
        time: Where it is, on the clock of the run [s]: the state nearest to it is shown.
        playing: Whether time goes on; it ends with the last state.
        speed: Seconds of the run per second, > 0.
        height: Of the picture [pixels].
    """

    _esm = Path(__file__).with_name("animated.js")
    _css = Path(__file__).with_name("animated.css")

    speed = traitlets.Float(1.0).tag(sync=True)
    _times = traitlets.List(traitlets.Float()).tag(sync=True)
    _width = traitlets.Int().tag(sync=True)

    def __init__(self, stage: Stage) -> None:
        """A player of what was put on a stage: `Trajectory.show` does both."""
        self._stage = stage
        width, height = stage.size
        super().__init__(
            time=float(stage.run.time[0]),
            height=height,
            _width=width,
            _times=stage.run.time.tolist(),
            _picture=stage.png(0),
        )
        self.on_msg(self._hear)

    def __repr__(self) -> str:
        begin, end = self._times[0], self._times[-1]
        going_on = "playing" if self.playing else "paused"
        return (
            f"<carom.notebook.AnimatedTrajectory of {len(self._times)} states from {begin:.6g} to "
            f"{end:.6g} s, at {self.time:.6g} s, {going_on}>"
        )

    @traitlets.validate("speed")
    def _check_speed(self, proposal: dict[str, Any]) -> float:
        speed = float(proposal["value"])
        if not 0 < speed < math.inf:
            raise CaromError(f"speed: must be positive and finite, not {speed}", "speed")
        return speed

    def _hear(self, _: Any, message: dict[str, Any], buffers: list[bytes]) -> None:
        """Draws a state that the browser has none of yet."""
        index = message.get("state")
        if isinstance(index, int) and 0 <= index < len(self._times):
            self.send({"state": index}, buffers=[self._stage.png(index)])
