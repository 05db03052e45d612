"""Thermostats: in Python, in scene files, in worlds."""

import pickle

import pytest

import carom

KINDS = [
    carom.Andersen(frequency=2.0, temperature=0.5, seed=3),
    carom.Rescale(interval=0.05, temperature=1.0),
    carom.WhiteNoise(interval=0.1, strength=0.25),
]


def gas(thermostat: carom.Thermostat) -> carom.Scene:
    """Two balls in a periodic box."""
    return carom.Scene(
        name="gas",
        simulation=carom.Simulation(boundary=carom.Periodic([4.0] * 3), thermostat=thermostat),
        spheres=[
            carom.Sphere(position=(x, 0, 0), radius=0.5, velocity=(0, x, 1)) for x in (-1.0, 1.0)
        ],
    )


@pytest.mark.parametrize("thermostat", KINDS)
def test_a_thermostat_is_the_same_after_it_was_written_and_read(
    thermostat: carom.Thermostat,
) -> None:
    scene = gas(thermostat)
    read = carom.Scene.from_toml(scene.to_toml())
    assert read.simulation.thermostat == thermostat
    assert pickle.loads(pickle.dumps(scene)) == scene


@pytest.mark.parametrize("thermostat", KINDS)
def test_the_account_has_the_energy_of_a_thermostat(thermostat: carom.Thermostat) -> None:
    world = gas(thermostat).world()
    before = world.kinetic_energy
    world.step(dt=1.0)
    added = world.energy_account.thermostat
    assert added != 0.0
    assert world.kinetic_energy - before == pytest.approx(added, abs=1e-13)


def test_a_temperature_below_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="temperature"):
        carom.Rescale(interval=0.05, temperature=-1.0)
