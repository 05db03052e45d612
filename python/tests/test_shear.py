"""Steady shear of a periodic box, from Python."""

import numpy as np

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
