"""Steady shear of a periodic box, from Python."""

import numpy as np
import pytest

import carom


def test_a_ball_enters_where_the_sheared_box_has_slid_to() -> None:
    box = carom.Periodic([4.0] * 3, shear_rate=0.25)
    scene = carom.Scene(
        name="sheared",
        simulation=carom.Simulation(boundary=box),
        spheres=[carom.Sphere(radius=0.5, velocity=(0, 1, 0))],
    )
    assert carom.Scene.from_toml(scene.to_toml()).simulation.boundary == box
    world = scene.world()
    # Relative to the flow, which is at rest at the middle.
    before = world.kinetic_energy
    world.step(dt=3.0)
    np.testing.assert_array_equal(world.positions[0], [1.0, -1.0, 0.0])
    assert abs(world.kinetic_energy - before - world.energy_account.shear) < 1e-14


def test_rough_balls_in_shear_move_under_contact_and_the_account_closes() -> None:
    lattice = [(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)]
    scene = carom.Scene(
        name="sheared grains",
        simulation=carom.Simulation(
            rule="contact", boundary=carom.Periodic([3.1] * 3, shear_rate=1.0)
        ),
        spheres=[
            carom.Sphere(position=place, radius=0.5, velocity=(place[1], 0, 0.1), friction=0.4)
            for place in lattice
        ],
    )
    world = scene.world()
    box = carom.Periodic([3.1] * 3, shear_rate=1.0, relative_velocities=True)
    slow = [carom.Sphere(position=it, radius=0.5, velocity=(0, 0, 0.1)) for it in lattice]
    same = carom.Scene(name="same", simulation=carom.Simulation(boundary=box), spheres=slow)
    np.testing.assert_array_equal(same.world().velocities, world.velocities)
    before, total = world.kinetic_energy, 0.0
    for _ in range(50):
        world.step(dt=0.01)
        total += sum(world.energy_account)
    assert world.kinetic_energy - before == pytest.approx(total, abs=1e-11)
