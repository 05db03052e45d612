"""Runs as functions of JAX: arrays at the end, differentiable by arrays at the start.

``pip install 'carom[jax]'`` brings JAX.
"""

from __future__ import annotations

from typing import Any

try:
    import jax
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "carom.jax needs JAX: pip install 'carom[jax]'", name=error.name
    ) from error

import numpy as np

from carom._run.gradients import MOTION, TapedRuns
from carom._run.world import World
from carom._scene.scene import Scene
from carom.errors import CaromError

__all__ = ["run"]


def run(
    start: Scene | World,
    *,
    seconds: float,
    dt: float | None = None,
    positions: jax.Array | None = None,
    velocities: jax.Array | None = None,
    angular_velocities: jax.Array | None = None,
) -> tuple[jax.Array, jax.Array, jax.Array]:
    """Runs a scene, or a copy of a world, from a motion that arrays give.

    Arrays of shape (n, 3) replace the motion at the start; arrays of shape (b, n, 3) make b runs,
    on all cores. ``jax.jit``, ``jax.grad`` and ``jax.vmap`` support it. Derivatives repeat the run.
    They are known of the same worlds as for `carom.Tape`, and of first order, backwards.

    Args:
        start: The scene or world.
        seconds: How long a run is [s].
        dt: The length of frames [s]; that of the scene unless given.
        positions: Centres of spheres [m].
        velocities: Their velocities [m/s].
        angular_velocities: Their angular velocities [rad/s].

    Returns:
        Centres, velocities and angular velocities at the end, in the precision that JAX has.

    Raises:
        CaromError: If a shape does not fit, or the world has something whose derivatives are not
            known.
        StepError: Where there is no derivative; inside of ``jax.jit``, as an error of JAX.
    """
    world = start.world() if isinstance(start, Scene) else start
    motion = dict(zip(MOTION, (positions, velocities, angular_velocities), strict=True))
    start_motion = {name: getattr(world, name) if it is None else it for name, it in motion.items()}
    for name, it in start_motion.items():
        if np.shape(it)[-2:] != (len(world), 3):
            shape = f"(..., {len(world)}, 3), not {np.shape(it)}"
            raise CaromError(f"{name}: must have the shape {shape}", name)
    arrays = jax.numpy.broadcast_arrays(*map(jax.numpy.asarray, start_motion.values()))
    ends: tuple[jax.Array, jax.Array, jax.Array] = _function(world, (seconds, dt))(*arrays)
    return ends


def _function(world: World, time: tuple[float, float | None]) -> Any:
    """Returns the run of a world as a function of the motion at its start."""

    def taped(motion: Any) -> TapedRuns:
        return TapedRuns(world, dict(zip(MOTION, map(np.asarray, motion), strict=True)), time)

    def called(function: Any, motion: Any, *others: Any) -> Any:
        shapes = [jax.ShapeDtypeStruct(it.shape, it.dtype) for it in motion]

        def cast(*arrays: Any) -> Any:
            results = function(*arrays)
            return [np.asarray(it, dtype) for it, dtype in zip(results, types, strict=True)]

        types = [it.dtype for it in motion]
        return jax.pure_callback(cast, shapes, *motion, *others, vmap_method="broadcast_all")

    def ends_of(*motion: Any) -> Any:
        return taped(motion).ends()

    def gradients_of(*arrays: Any) -> Any:
        gradient = taped(arrays[:3]).gradient(*map(np.asarray, arrays[3:]))
        return [getattr(gradient, name) for name in MOTION]

    def end_of(*motion: Any) -> Any:
        return tuple(called(ends_of, motion))

    end = jax.custom_vjp(end_of)

    def forwards(*motion: Any) -> Any:
        return end(*motion), motion

    def backwards(motion: Any, derivatives: Any) -> Any:
        return tuple(called(gradients_of, motion, *derivatives))

    end.defvjp(forwards, backwards)
    return end
