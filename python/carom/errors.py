"""What is raised, in the words of the engine."""

from __future__ import annotations


class CaromError(ValueError):
    """A value is invalid where it was given. Nothing was changed.

    Attributes:
        field: What is to blame, like ``radii``, ``dt`` or ``colliders[1].restitution``.
        line: Line in the text of a scene, from 1.
    """

    def __init__(self, message: str, field: str | None = None, line: int | None = None) -> None:
        super().__init__(message)
        self.field = field
        self.line = line


class SceneError(CaromError):
    """A scene, or a part of one, is invalid."""


class UnknownError(CaromError, LookupError):
    """A name or an id that names nothing."""


class OmissionWarning(UserWarning):
    """What an import of another program's scene leaves out, or takes for something else."""


class GraphicsError(CaromError, RuntimeError):
    """Nothing can be drawn here: there is no graphics driver, or this build has no pictures."""


class StepError(CaromError, ArithmeticError):
    """A step that cannot be taken: a number would overflow, or there are too many impacts.

    Attributes:
        worlds: The numbers of the worlds that refused it, in a `Batch`.
    """

    worlds: list[int] | None = None


class RunError(CaromError, RuntimeError):
    """A run of a sweep failed, or the cluster that performs it."""
