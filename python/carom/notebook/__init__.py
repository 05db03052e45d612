"""Carom in Jupyter notebooks: the viewer of the page in the output of a cell.

`Scene.show` and `World.show` make a `Viewer`, `Trajectory.show` an `AnimatedTrajectory`. Both need
the extra `carom[notebook]`.
"""

from carom.notebook._animated import AnimatedTrajectory
from carom.notebook._viewer import Viewer

__all__ = ["AnimatedTrajectory", "Viewer"]
