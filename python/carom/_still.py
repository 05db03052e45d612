"""What a notebook shows where there are no widgets: a picture, and how to get them."""

from __future__ import annotations

import base64
import html
from typing import TYPE_CHECKING, Any, NoReturn

from carom import _pictures as pictures
from carom._trajectory import Trajectory
from carom.errors import GraphicsError

if TYPE_CHECKING:
    from carom._scene import Scene
    from carom._world import World
    from carom.notebook import AnimatedTrajectory, Viewer

_NO_WIDGETS = "viewers in notebooks need anywidget: pip install 'carom[notebook]'"


class Still:
    """A picture in the place of a viewer that is not there, with the reason why.

    Attributes:
        reason: Why there is no viewer, and how to get it.
        picture: A PNG file; None where nothing can be drawn.
    """

    def __init__(self, picture: bytes | None, reason: str) -> None:
        self.picture, self.reason = picture, reason

    def __repr__(self) -> str:
        return f"<a picture; {self.reason}>"

    def __getattr__(self, name: str) -> NoReturn:
        raise AttributeError(f"a picture has no attribute {name!r}; {self.reason}")

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        data = {"text/plain": repr(self)}
        if self.picture is not None:
            picture = base64.b64encode(self.picture).decode("ascii")
            data["image/png"] = picture
            data["text/html"] = (
                f'<img src="data:image/png;base64,{picture}" alt="">'
                f"<p><em>A picture: {html.escape(self.reason)}</em></p>"
            )
        return data


def show(scene: Scene | World, height: int) -> Viewer | Still:
    """A viewer of a scene, or of a world as it is now; a picture where there can be none."""
    try:
        from carom.notebook import Viewer

        return Viewer(scene, height=height)
    except ModuleNotFoundError as error:
        return Still(pictures.notebook_picture(scene), _reason(error))
    except GraphicsError as error:
        return Still(pictures.notebook_picture(scene), str(error))


def show_trajectory(
    run: Trajectory, scene: Scene | World | None, size: pictures.Size, camera: pictures.Viewpoint
) -> AnimatedTrajectory | Still:
    """A player of a recorded run; a picture of its beginning where there can be none."""
    from carom._stage import Stage

    stage = Stage(run, scene, pictures.View.of(size, camera, "good", stamp=True))
    try:
        from carom.notebook import AnimatedTrajectory

        return AnimatedTrajectory(stage)
    except ModuleNotFoundError as error:
        return Still(stage.png(0), _reason(error))


def _reason(error: ModuleNotFoundError) -> str:
    """What is missing; another module than those of widgets is a mistake of somebody else."""
    if error.name not in ("anywidget", "ipywidgets", "traitlets"):
        raise error
    return _NO_WIDGETS
