"""Square wells, growth and two dimensions: in Python, in scene files, in worlds."""

import math
import pickle

import numpy as np
import pytest

import carom

WELL = carom.SquareWell(depth=0.5, range_ratio=1.5)


def pair(**simulation: object) -> carom.Scene:
    """Two balls that come near each other, the first of which grows where there is no well."""
    growth = 0.0 if simulation else 0.25
    first = carom.Sphere(position=(-1, 0, 0), radius=0.5, velocity=(1, 0, 0), growth_speed=growth)
    return carom.Scene(
        name="pair",
        simulation=carom.Simulation(**simulation),  # type: ignore[arg-type]
        spheres=[first, carom.Sphere(position=(0.75, 0, 0), radius=0.5)],
    )


def test_a_well_is_the_same_after_it_was_written_and_read() -> None:
    scene = pair(pair_potential=WELL)
    assert carom.Scene.from_toml(scene.to_toml()).simulation.pair_potential == WELL
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_energy_in_a_well_is_potential_energy() -> None:
    world = pair(pair_potential=WELL).world()
    world.step(dt=0.3)
    assert world.potential_energy == -0.5
    assert world.kinetic_energy == pytest.approx(1.0, abs=1e-14)


def test_events_of_wells_are_records_of_their_own() -> None:
    world = pair(pair_potential=WELL).world()
    world.step(dt=0.3)
    assert len(world.impacts) == 0
    (capture,) = world.well_events
    assert world.well_events.dtype == carom.WELL_EVENT
    # The centres are 1.75 m apart and meet the edge at 1.5 m with 1 m/s.
    assert (capture["kind"], capture["sphere_1"], capture["sphere_2"]) == (0, 0, 1)
    assert capture["time"] == pytest.approx(0.25, abs=1e-15)
    assert capture["distance"] == pytest.approx(1.5, abs=1e-15)
    np.testing.assert_array_equal(capture["normal"], (1, 0, 0))
    # The relative speed rises from 1 m/s to √(1 + 2 ε/μ), drawn together by μ times the change.
    mass = world.masses[0] / 2
    gained = math.sqrt(1 + 2 * 0.5 / mass) - 1
    assert capture["impulse"] == pytest.approx(-mass * gained, rel=1e-14)
    batch = carom.Batch([pair(pair_potential=WELL), pair(pair_potential=WELL)])
    batch.step(dt=0.3)
    assert batch.well_events["world"].tolist() == [0, 1]
    assert batch.well_events["time"].tolist() == [capture["time"], capture["time"]]


def test_balls_grow_at_the_speed_of_their_scene() -> None:
    scene = pair()
    assert carom.Scene.from_toml(scene.to_toml()).spheres[0].growth_speed == 0.25
    world = scene.world()
    world.step(dt=0.5)
    assert world.radii.tolist() == [0.625, 0.5]


def test_a_range_inside_the_cores_is_refused() -> None:
    with pytest.raises(ValueError, match="range_ratio"):
        carom.SquareWell(depth=1.0, range_ratio=0.0)
    with pytest.raises(ValueError, match="range_ratio"):
        pair(pair_potential=carom.SquareWell(depth=1.0, range_ratio=0.5)).world()


def test_discs_have_the_pressure_of_a_plane() -> None:
    box = carom.Periodic((4, 4, float("inf")))
    balls = [carom.Sphere(position=(x, 0, 0), radius=0.5, velocity=(-x, 0, 0)) for x in (-1.0, 1.0)]
    simulation = carom.Simulation(dimensions=2, boundary=box)
    world = carom.Scene(name="discs", simulation=simulation, spheres=balls).world()
    meter = carom.StressMeter(world)
    meter.step(dt=0.25)
    stress = meter.stress()
    # Two masses of 1 kg at 1 m/s in 16 m2, by two dimensions.
    assert stress.pressure == pytest.approx(2.0 / 16.0 / 2.0)
    assert stress.dimensions == 2


def test_generators_make_gases_of_discs() -> None:
    box = carom.Periodic((10, 10, float("inf")))
    disc = carom.Sphere(radius=0.2, mass=1.0)
    gas = carom.RandomFill(50, (-4, -4, 0), (4, 4, 0), 1, disc, speed=2.0)
    fluid = carom.DenseFluid(100, 3.0, 1, carom.Sphere(mass=1.0), packing_fraction=0.4)
    for generator, energy in ((gas, 100.0), (fluid, 300.0)):
        simulation = carom.Simulation(dimensions=2, boundary=box)
        scene = carom.Scene(name="discs", simulation=simulation, generators=[generator])
        world = scene.world()
        world.step(dt=0.5)
        assert not world.positions[:, 2].any()
        assert not world.velocities[:, 2].any()
        # Fifty discs with 2 m/s; a disc of a fluid has k T of kinetic energy.
        assert world.kinetic_energy == pytest.approx(energy, rel=1e-12)
