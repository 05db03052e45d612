"""What a notebook shows: a widget of the layer `carom.notebook`, or a picture where it cannot be.

Widgets need packages that carom does without, so what needs them is imported when it is shown.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from carom._pictures.picture import notebook_picture
from carom._pictures.stage import Stage
from carom._pictures.still import Still
from carom._run.trajectory import Trajectory
from carom._run.world import World
from carom._scene.scene import Scene
from carom._scene.view import Size, View, Viewpoint
from carom.errors import GraphicsError

if TYPE_CHECKING:
    from carom.notebook import AnimatedTrajectory, Viewer

_NO_WIDGETS = "viewers in notebooks need anywidget: pip install 'carom[notebook]'"


def show(subject: Scene | World, height: int) -> Viewer | Still:
    """A viewer of a scene, or of a world as it is now; a picture where there can be none."""
    try:
        from carom.notebook import Viewer

        return Viewer(subject, height=height)
    except ModuleNotFoundError as error:
        return Still(notebook_picture(subject), _reason(error))
    except GraphicsError as error:
        return Still(notebook_picture(subject), str(error))


def show_trajectory(
    run: Trajectory, scene: Scene | World | None, size: Size, camera: Viewpoint
) -> AnimatedTrajectory | Still:
    """A player of a recorded run; a picture of its beginning where there can be none."""
    stage = Stage(run, scene, View.of(size, camera, "good", stamp=True))
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
