"""What an array of a world is: the same memory while its spheres stay, never freed under its
holder, never written to from outside."""

import gc

import numpy as np
import pytest

import carom

QUANTITIES = ["positions", "velocities", "radii", "masses", "restitutions", "ids"]


def two_balls() -> carom.World:
    world = carom.World()
    world.add_force(carom.Gravity())
    world.add_spheres([(0, 5, 0), (3, 5, 0)], 0.5)
    return world


def address(array: np.ndarray) -> int:
    return int(array.ctypes.data)


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_reading_twice_gives_the_same_memory(quantity: str) -> None:
    world = two_balls()
    first, second = getattr(world, quantity), getattr(world, quantity)
    assert first is second
    assert address(first) == address(second)


def test_a_step_writes_into_the_array_that_is_held() -> None:
    world = two_balls()
    positions, velocities = world.positions, world.velocities
    places = address(positions), address(velocities)
    before = positions.copy()
    world.step(0.1)
    assert (address(world.positions), address(world.velocities)) == places
    assert np.all(positions[:, 1] < before[:, 1])
    assert np.all(velocities[:, 1] < 0)


def test_arrays_are_float64_in_c_order() -> None:
    world = two_balls()
    for quantity in QUANTITIES:
        array = getattr(world, quantity)
        assert array.dtype == (np.uint64 if quantity == "ids" else np.float64)
        assert array.flags.c_contiguous and array.flags.aligned


@pytest.mark.parametrize("quantity", QUANTITIES)
def test_an_array_refuses_to_be_written_to(quantity: str) -> None:
    world = two_balls()
    with pytest.raises(ValueError, match="read-only"):
        getattr(world, quantity)[0] = 1
    with pytest.raises(ValueError, match="read-only"):
        getattr(world, quantity)[...] *= 2


def test_an_array_outlives_its_world() -> None:
    world = two_balls()
    positions = world.positions
    del world
    gc.collect()
    # Memory that was free would be taken by these.
    rubbish = [np.full((2, 3), np.nan) for _ in range(1000)]
    assert positions.tolist() == [[0, 5, 0], [3, 5, 0]]
    assert len(rubbish) == 1000


def test_an_array_keeps_its_last_values_when_a_sphere_comes() -> None:
    world = two_balls()
    old = world.positions
    held = old.copy()
    world.add_sphere(carom.Sphere(position=(6, 5, 0), radius=0.5))
    world.step(0.1)
    assert np.array_equal(old, held)
    assert world.positions.shape == (3, 3)
    assert not np.shares_memory(old, world.positions)


def test_an_array_keeps_its_last_values_when_a_sphere_goes() -> None:
    world = two_balls()
    old_positions, old_ids = world.positions, world.ids
    world.remove_sphere(0)
    assert world.ids.tolist() == [1]
    assert world.positions.tolist() == [[3, 5, 0]]
    assert old_ids.tolist() == [0, 1]
    assert old_positions.shape == (2, 3)


def test_an_array_is_left_when_an_emitter_replaces_a_sphere_by_another() -> None:
    world = carom.load("simtest4", {"emitters.0.max_spheres": 3}).world()
    while len(world) < 3:
        world.step()
    old, ids = world.positions, world.ids
    while np.array_equal(world.ids, ids):
        world.step()
    assert len(world) == 3
    assert not np.shares_memory(old, world.positions)


def test_restoring_writes_into_the_array_that_is_held() -> None:
    world = two_balls()
    positions = world.positions
    before = positions.copy()
    snapshot = world.snapshot()
    world.step(0.1)
    world.restore(snapshot)
    assert world.positions is positions
    assert np.array_equal(positions, before)


def test_a_quantity_is_set_by_assignment() -> None:
    world = two_balls()
    radii = world.radii
    world.velocities = [[1, 0, 0], [0, 0, 2]]
    world.positions = np.array([[0, 1, 0], [0, 9, 0]], dtype=np.float32)
    world.masses = 2
    world.radii = [0.25, 0.75]
    world.restitutions = np.array([0.5, 0.25])
    assert world.velocities.tolist() == [[1, 0, 0], [0, 0, 2]]
    assert world.positions.tolist() == [[0, 1, 0], [0, 9, 0]]
    assert world.masses.tolist() == [2, 2]
    assert world.radii is radii and radii.tolist() == [0.25, 0.75]
    assert world.restitutions.tolist() == [0.5, 0.25]
    assert world.kinetic_energy == 0.5 * 2 * (1 + 4)


def test_what_was_assigned_is_copied() -> None:
    world = two_balls()
    mine = np.zeros((2, 3))
    world.velocities = mine
    mine[:] = 7
    assert not world.velocities.any()


def test_a_fortran_ordered_array_is_understood() -> None:
    world = two_balls()
    world.velocities = np.asfortranarray([[1, 2, 3], [4, 5, 6]])
    assert world.velocities.tolist() == [[1, 2, 3], [4, 5, 6]]
