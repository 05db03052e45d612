"""What an array of a world is: the same memory while its spheres stay, never freed under its
holder; what is written into it, the next call takes over."""

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
    world.step(dt=0.1)
    assert (address(world.positions), address(world.velocities)) == places
    assert np.all(positions[:, 1] < before[:, 1])
    assert np.all(velocities[:, 1] < 0)


def test_arrays_are_float64_in_c_order() -> None:
    world = two_balls()
    for quantity in QUANTITIES:
        array = getattr(world, quantity)
        assert array.dtype == (np.uint64 if quantity == "ids" else np.float64)
        assert array.flags.c_contiguous and array.flags.aligned


def test_ids_refuse_to_be_written_to() -> None:
    world = two_balls()
    with pytest.raises(ValueError, match="read-only"):
        world.ids[0] = 1


def test_what_is_written_into_an_array_is_what_the_world_goes_on_with() -> None:
    written, assigned = two_balls(), two_balls()
    written.velocities[1] = (0, 0, 2)
    written.positions += (0, 1, 0)
    written.masses[0] = 3
    written.restitutions[...] = 0.5
    written.orientations[1] = (0, 2, 0, 0)
    written.angular_velocities[0, 1] = 7
    written.frictions[1] = 0.25
    assigned.velocities = [(0, 0, 0), (0, 0, 2)]
    assigned.positions = [(0, 6, 0), (3, 6, 0)]
    assigned.masses = [3, 1]
    assigned.restitutions = 0.5
    assigned.orientations = [(0, 0, 0, 1), (0, 2, 0, 0)]
    assigned.angular_velocities = [(0, 7, 0), (0, 0, 0)]
    assigned.frictions = [np.nan, 0.25]
    assert written.kinetic_energy == assigned.kinetic_energy == 2 + 0.5 * 0.4 * 3 * 0.25 * 49
    assert written.state_hash == assigned.state_hash
    assert written.orientations[1].tolist() == [0, 1, 0, 0]
    assert written.sphere(1).friction == 0.25
    for world in (written, assigned):
        world.step(dt=0.1, frames=3)
    assert written.state_hash == assigned.state_hash


def test_a_force_written_into_its_array_acts() -> None:
    world = two_balls()
    world.applied_forces[1, 0] = 2
    world.step(dt=0.5)
    assert world.velocities[:, 0].tolist() == [0, 1]


def test_a_sphere_that_nobody_wrote_to_keeps_its_flight_to_the_bit() -> None:
    touched, alone = carom.load("gas").world(), carom.load("gas").world()
    for world in (touched, alone):
        world.step(dt=1e-4)
    touched.velocities[0] = touched.velocities[0].copy()
    for world in (touched, alone):
        world.step(dt=1e-4)
    assert touched.state_hash == alone.state_hash


@pytest.mark.parametrize(
    ("quantity", "row", "value", "problem"),
    [
        ("positions", 1, np.nan, r"positions\[1\]: must be finite"),
        ("velocities", 0, np.inf, r"velocities\[0\]: must be finite"),
        ("applied_forces", 1, -np.inf, r"applied_forces\[1\]: must be finite"),
        ("masses", 1, -1.0, r"masses\[1\].*must be positive"),
        ("radii", 0, 0.0, r"radii\[0\].*must be positive"),
        ("restitutions", 1, 1.5, r"restitutions\[1\].*must be in"),
        ("frictions", 0, -0.5, r"frictions\[0\].*must be"),
        ("orientations", 1, 0.0, r"orientations\[1\]"),
    ],
)
def test_a_bad_value_names_array_and_row_and_leaves_the_world(
    quantity: str, row: int, value: float, problem: str
) -> None:
    world = two_balls()
    before, array = world.state_hash, getattr(world, quantity)
    held = array.copy()
    # A good value beside the bad one is not taken over either.
    world.velocities[:] = 5
    array[row] = value
    with pytest.raises(carom.CaromError, match=problem):
        world.step()
    assert world.time == 0
    assert world.state_hash == before
    np.testing.assert_array_equal(getattr(world, quantity), held)
    assert not world.velocities.any()
    world.step()


def test_an_array_of_spheres_that_are_no_longer_all_is_not_to_be_written_to() -> None:
    world = two_balls()
    old = world.positions
    world.remove_sphere(0)
    with pytest.raises(ValueError, match="read-only"):
        old[0] = 1


def test_every_call_notices_what_was_written() -> None:
    def touched() -> carom.World:
        world = two_balls()
        world.positions[0] = (0, 9, 0)
        return world

    assert touched().sphere(0).position == (0, 9, 0)
    assert touched().to_scene().spheres[0].position == (0, 9, 0)
    assert touched().run(frames=1).positions[0, 0].tolist() == [0, 9, 0]
    copied = carom.World()
    copied.restore(touched().snapshot())
    assert copied.positions[0].tolist() == [0, 9, 0]
    added = touched()
    added.add_sphere(carom.Sphere(position=(6, 5, 0), radius=0.5))
    assert added.positions[0].tolist() == [0, 9, 0]
    removed = touched()
    removed.remove_sphere(1)
    assert removed.positions.tolist() == [[0, 9, 0]]


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
    world.step(dt=0.1)
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
    world.step(dt=0.1)
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


def test_restoring_voids_what_was_written() -> None:
    world = two_balls()
    snapshot = world.snapshot()
    world.masses[0] = -1
    world.restore(snapshot)
    assert world.masses.tolist() == [1, 1]
    world.step()
