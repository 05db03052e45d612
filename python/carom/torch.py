"""Runs as functions of PyTorch: tensors at the end, differentiable by tensors at the start.

``pip install 'carom[torch]'`` brings PyTorch.
"""

from __future__ import annotations

from typing import Any

try:
    import torch
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "carom.torch needs PyTorch: pip install 'carom[torch]'", name=error.name
    ) from error

from carom._run.gradients import MOTION, TapedRuns
from carom._run.world import World
from carom._scene.scene import Scene

__all__ = ["run"]


class _Run(torch.autograd.Function):  # type: ignore[misc]
    """A run, and its way back."""

    @staticmethod
    def forward(
        ctx: Any, start: Scene | World, time: tuple[float, float | None], *motion: Any
    ) -> tuple[Any, ...]:
        given = {
            name: None if it is None else it.detach().cpu().double().numpy()
            for name, it in zip(MOTION, motion, strict=True)
        }
        ctx.runs = TapedRuns(start, given, time)
        ctx.motion = motion
        known = [it for it in motion if it is not None]
        like = known[0] if known else torch.empty(0, dtype=torch.float64)
        return tuple(torch.from_numpy(it).to(like) for it in ctx.runs.ends())

    @staticmethod
    def backward(ctx: Any, *derivatives: Any) -> tuple[Any, ...]:
        return _differentiable_once(ctx, *derivatives)  # type: ignore[no-any-return]


def _backward(ctx: Any, *derivatives: Any) -> tuple[Any, ...]:
    gradient = ctx.runs.gradient(*[it.detach().cpu().double().numpy() for it in derivatives])
    by = []
    for name, it in zip(MOTION, ctx.motion, strict=True):
        rows = None if it is None else torch.from_numpy(getattr(gradient, name))
        # What was given once for several runs has the sum of their derivatives.
        by.append(None if rows is None else rows.to(it).sum_to_size(it.shape))
    return (None, None, *by)


_differentiable_once = torch.autograd.function.once_differentiable(_backward)


def run(
    start: Scene | World,
    *,
    seconds: float,
    dt: float | None = None,
    positions: torch.Tensor | None = None,
    velocities: torch.Tensor | None = None,
    angular_velocities: torch.Tensor | None = None,
) -> tuple[torch.Tensor, torch.Tensor, torch.Tensor]:
    """Runs a scene, or a copy of a world, from a motion that tensors give.

    Tensors of shape (n, 3) replace the motion at the start; tensors of shape (b, n, 3) make b runs,
    on all cores. Derivatives are known of the same worlds as for `carom.Tape`, and of first order.

    Args:
        start: The scene or world.
        seconds: How long a run is [s].
        dt: The length of frames [s]; that of the scene unless given.
        positions: Centres of spheres [m].
        velocities: Their velocities [m/s].
        angular_velocities: Their angular velocities [rad/s].

    Returns:
        Centres, velocities and angular velocities at the end, of the type of the first tensor that
        is given.

    Raises:
        CaromError: If a shape does not fit, or the world has something whose derivatives are not
            known.
        StepError: Where there is no derivative.
    """
    ends: tuple[torch.Tensor, torch.Tensor, torch.Tensor] = _Run.apply(
        start, (seconds, dt), positions, velocities, angular_velocities
    )
    return ends
