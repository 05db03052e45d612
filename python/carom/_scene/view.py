"""How something is to be seen: values; what draws them is a layer above."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, TypeAlias

import numpy as np

from carom._scene import parts
from carom._scene.text import toml_value
from carom.errors import CaromError

Size: TypeAlias = Sequence[int]
"""Width and height in pixels."""
Viewpoint: TypeAlias = (
    Literal["scene", "fit", "front", "top"] | parts.Camera | Sequence[parts.Vector]
)
"""Where to look from.

``"scene"``, the scene's own camera, or ``"fit"`` where it has none; ``"fit"``, everything is shown,
from a little to the right and above; ``"front"``, along -z; ``"top"``, from straight above; a
`carom.Camera`; or two points, of the camera and of what it looks at [m].
"""
Quality: TypeAlias = Literal["fine", "good", "draft"]
"""How much work goes into a picture; ``"draft"`` is for slow machines."""

_PLACES = ("scene", "fit", "front", "top")

SIZE = (1280, 720)
"""Of pictures and films, by default."""
NOTEBOOK_SIZE = (640, 360)
"""Of pictures and films in notebooks: of the proportions for which scenes are made."""


class View(NamedTuple):
    """How something is to be seen, as the engine reads it."""

    size: Size
    camera: str
    quality: str
    stamp: bool

    @classmethod
    def of(cls, size: Size, camera: Viewpoint, quality: Quality, stamp: bool) -> View:
        """As users say it."""
        return cls(size, _camera_text(camera), str(quality), bool(stamp))


def _camera_text(camera: Viewpoint) -> str:
    if isinstance(camera, str):
        if camera not in _PLACES:
            names = ", ".join(_PLACES)
            raise CaromError(f"camera: must be one of {names}, not {camera}", "camera")
        return camera
    if isinstance(camera, parts.Camera):
        return f"camera = {toml_value(camera, 'camera')}"
    try:
        points = np.asarray(camera, dtype=np.float64)
    except (TypeError, ValueError):
        points = np.empty(0)
    if points.shape != (2, 3):
        raise TypeError("camera: must be a name, a carom.Camera, or two points")
    return ",".join(map(repr, points.ravel().tolist()))
