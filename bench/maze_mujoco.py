"""The same maze in MuJoCo: static boxes, planes for ground and ceiling, the same ball.

All is done that makes MuJoCo fast: contacts without friction (as in Carom), one step of 0.02 s per
frame, no trace kept of collectibles, rewards or episodes.
"""

from __future__ import annotations

import time

import mujoco
import numpy as np
from mujoco import rollout

import carom
import carom.gym

FRAME_TIME = 0.02
GRAVITY = 9.8
STEEPEST = np.radians(20.0)
# Balls and frames of one rollout.
BATCH, FRAMES = 64, 200


def model_xml() -> str:
    """The course's maze as MuJoCo reads it."""
    env = carom.gym.MazeEnv()
    env.reset(seed=0)
    scene = carom.Scene.from_toml(env._engine.scene_toml(0))
    world = scene.world()
    radius, mass, place = world.radii[0], world.masses[0], world.positions[0]
    geoms = [geom for collider in scene.colliders for geom in geom_of(collider)]
    place = " ".join(map(str, place))
    return f"""
    <mujoco>
      <option timestep="{FRAME_TIME}" gravity="0 0 0" integrator="Euler"/>
      <default><geom condim="1" friction="0 0 0"/></default>
      <worldbody>
        {"".join(geoms)}
        <body pos="{place}">
          <freejoint/>
          <geom type="sphere" size="{radius}" mass="{mass}"/>
        </body>
      </worldbody>
    </mujoco>"""


def geom_of(collider: carom.Collider) -> list[str]:
    """A collider as a static geom; nothing for a trigger."""
    if collider.trigger:
        return []
    place = " ".join(map(str, collider.position))
    match collider.shape:
        case carom.Box(size=size):
            x, y, z, w = collider.rotation
            half = " ".join(str(0.5 * edge) for edge in size)
            return [f'<geom type="box" pos="{place}" quat="{w} {x} {y} {z}" size="{half}"/>']
        case carom.Rectangle():
            # A plane's normal is its own z: up, or down for the ceiling.
            up = -1 if abs(collider.rotation[2]) > 0.5 else 1
            normal = f"0 {up} 0"
            return [f'<geom type="plane" pos="{place}" zaxis="{normal}" size="0 0 1"/>']
        case other:
            raise ValueError(f"no geom for {other}")


def weights(speed: float, frames: int, balls: int) -> np.ndarray:
    """Weight [N] of balls of 1 kg under random tilts that are followed at a speed [°/s].

    Shape (balls, frames, 3), along the axes of the maze, as the environment turns it.
    """
    random = np.random.default_rng(1)
    most = np.radians(speed) * FRAME_TIME
    slope = np.zeros((balls, 2))
    result = np.empty((balls, frames, 3))
    for frame in range(frames):
        wanted = STEEPEST * random.uniform(-1.0, 1.0, (balls, 2))
        slope = slope + np.clip(wanted - slope, -most, most)
        angle = np.linalg.norm(slope, axis=1, keepdims=True)
        slope = slope * np.minimum(1.0, STEEPEST / np.maximum(angle, 1e-300))
        angle = np.linalg.norm(slope, axis=1, keepdims=True)
        level = slope * np.sinc(angle / np.pi)
        result[:, frame, [0, 2]] = GRAVITY * level
        result[:, frame, 1] = -GRAVITY * np.cos(angle[:, 0])
    return result


Rates = tuple[float, float]
"""Steps per second, and per second that a processor worked for it."""


def rates(speed: float, seconds: float) -> dict[str, Rates]:
    """Of one thread: stepped from Python, and in MuJoCo's own loop in C++."""
    model = mujoco.MjModel.from_xml_string(model_xml())
    return {"mj_step": stepped(model, speed, seconds), "rollout": rolled_out(model, speed, seconds)}


def stepped(model: mujoco.MjModel, speed: float, seconds: float) -> Rates:
    """One ball, a call from Python for every step."""
    data = mujoco.MjData(model)
    forces = weights(speed, 10_000, 1)[0]
    steps, began, worked = 0, time.perf_counter(), time.process_time()
    while time.perf_counter() - began < seconds:
        for force in forces[:1000]:
            data.qfrc_applied[:3] = force
            mujoco.mj_step(model, data)
        steps += 1000
        forces = np.roll(forces, -1000, axis=0)
    return steps / (time.perf_counter() - began), steps / (time.process_time() - worked)


def rolled_out(model: mujoco.MjModel, speed: float, seconds: float) -> Rates:
    """Many balls, in `mujoco.rollout`, which knows all forces before."""
    data = mujoco.MjData(model)
    states = mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    state = np.empty(states)
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
    state = np.tile(state, (BATCH, 1))
    forces = np.zeros((BATCH, FRAMES, model.nv))
    forces[:, :, :3] = weights(speed, FRAMES, BATCH)
    steps, began, worked = 0, time.perf_counter(), time.process_time()
    with rollout.Rollout(nthread=0) as runner:
        while time.perf_counter() - began < seconds:
            states_after, _ = runner.rollout(
                model,
                data,
                state,
                forces,
                control_spec=mujoco.mjtState.mjSTATE_QFRC_APPLIED.value,
            )
            state = states_after[:, -1]
            steps += BATCH * FRAMES
    return steps / (time.perf_counter() - began), steps / (time.process_time() - worked)
