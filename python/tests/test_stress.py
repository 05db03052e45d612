"""Stress by `carom.StressMeter`: a closed form, the force of a column at rest, refusals."""

from typing import Literal

import numpy as np
import pytest

import carom


def test_a_ball_between_walls_presses_as_its_impulses_say() -> None:
    walls = carom.Collider(shape=carom.Container(size=(2, 2, 2)))
    ball = carom.Sphere(radius=0.5, velocity=(1, 0, 0), mass=3)
    world = carom.Scene(name="ball", colliders=[walls], spheres=[ball]).world()
    meter = carom.StressMeter(world)
    meter.step(dt=0.1, frames=40)
    stress = meter.stress()
    # 6 N s on each of two walls of 4 m², once in 2 s.
    assert abs(stress.total[0, 0] - 0.75) < 1e-12
    assert np.count_nonzero(stress.total) == 1
    assert abs(stress.pressure - 0.25) < 1e-12
    assert abs(meter.time - 4) < 1e-12 and abs(world.time - 4) < 1e-12
    # In half of the volume twice as much.
    assert abs(meter.stress(volume=4).pressure - 0.5) < 1e-12


@pytest.mark.parametrize("rule", ["exact", "contact"])
def test_a_ball_at_rest_presses_with_its_weight(rule: Literal["exact", "contact"]) -> None:
    walls = carom.Collider(shape=carom.Container(size=(2, 2, 2)))
    ball = carom.Sphere(radius=0.5, position=(0, -0.5, 0), mass=3)
    scene = carom.Scene(
        name="ball",
        colliders=[walls],
        spheres=[ball],
        forces=[carom.Gravity()],
        simulation=carom.Simulation(rule=rule),
    )
    world = scene.world()
    world.step(frames=30)
    meter = carom.StressMeter(world)
    meter.step(frames=10)
    # Weight times radius by volume.
    expected = 3 * 9.81 * 0.5 / 8
    assert abs(meter.stress().contact[1, 1] / expected - 1) < 1e-6


def test_what_makes_no_stress_is_refused() -> None:
    world = carom.World()
    meter = carom.StressMeter(world)
    with pytest.raises(carom.CaromError, match="time"):
        meter.stress(volume=1)
    meter.step()
    with pytest.raises(carom.CaromError, match="volume"):
        meter.stress()
    world.add_force(lambda world: np.zeros((0, 3)))
    with pytest.raises(carom.CaromError, match="StressMeter knows no functions"):
        meter.step()
