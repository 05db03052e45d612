"""Batches are, to the bit, the worlds that they are made of."""

from collections.abc import Callable
from typing import Literal

import numpy as np
import pytest
from numpy.typing import NDArray

import carom

N = 6
Rule = Literal["exact", "bisect", "discrete"]
RULES: list[Rule] = ["exact", "bisect", "discrete"]


def gas(rule: Rule = "exact") -> carom.Scene:
    """Spheres between walls, placed by a seed."""
    walls = [
        carom.Collider(carom.HalfSpace(), position=(0, -2, 0)),
        carom.Collider(carom.HalfSpace(), position=(0, 2, 0), rotation=(0, 0, 1, 0)),
    ]
    fill = carom.RandomFill(
        count=12, seed=1, sphere=carom.Sphere(radius=0.2), min=(-2, -2, -2), max=(2, 2, 2)
    )
    return carom.Scene(
        name="gas",
        simulation=carom.Simulation(rule=rule, frame_time=0.02),
        forces=[carom.Gravity((0, -9.81, 0))],
        generators=[fill],
        colliders=walls,
    )


def hashes(worlds: list[carom.World]) -> list[int]:
    return [int(world.state_hash, 16) for world in worlds]


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("threads", [1, 2, 5])
def test_a_batch_has_the_bits_of_single_worlds(rule: Rule, threads: int) -> None:
    seeds = range(3, 3 + N)
    batch = carom.Batch(gas(rule), N, seeds=seeds, threads=threads)
    worlds = [gas(rule).with_seed(seed).world() for seed in seeds]
    for frames in (1, 20, 3):
        batch.step(frames=frames)
        for world in worlds:
            world.step(frames=frames)
    assert batch.state_hashes.tolist() == hashes(worlds)
    np.testing.assert_array_equal(batch.positions, [world.positions for world in worlds])
    np.testing.assert_array_equal(batch.velocities, [world.velocities for world in worlds])
    assert batch.times.tolist() == [world.time for world in worlds]


def test_worlds_of_emitters_have_places_for_the_most_spheres_of_any() -> None:
    heights = [2.0, 5.0, 9.0]
    batch = carom.Batch("simtest1", 3, changes={"emitters.0.period": heights})
    worlds = [batch.world(number) for number in range(3)]
    seen: list[np.ndarray] = []
    for _ in range(60):
        batch.step(frames=10)
        for world in worlds:
            world.step(frames=10)
        most = max(map(len, worlds))
        assert batch.state_hashes.tolist() == hashes(worlds)
        assert batch.counts.tolist() == list(map(len, worlds))
        assert batch.positions.shape == (3, most, 3) and batch.radii.shape == (3, most)
        for number, world in enumerate(worlds):
            count = len(world)
            assert batch.ids[number].tolist() == world.ids.tolist() + [-1] * (most - count)
            for name in ("positions", "velocities", "radii", "masses", "orientations"):
                rows = getattr(batch, name)[number]
                np.testing.assert_array_equal(rows[:count], getattr(world, name))
                assert np.isnan(rows[count:]).all()
        seen.append(batch.positions)
    assert len(set(batch.counts)) > 1
    # The same memory as long as it has enough places.
    assert len({id(array) for array in seen}) == len({array.shape for array in seen})
    batch.reset()
    assert batch.counts.tolist() == [len(batch.world(number)) for number in range(3)]


def test_worlds_with_different_numbers_of_spheres_are_set_where_they_have_some() -> None:
    batch = carom.Batch([carom.load("tutorial1"), carom.load("cradle")])
    few, many = batch.counts
    assert (few, many) == (len(batch.world(0)), len(batch.world(1))) and few < many
    assert repr(batch) == f"<carom.Batch of 2 worlds, {few} to {many} spheres each>"
    batch.velocities = (0, 0, 1)
    batch.radii *= 0.5
    batch.masses[1, -1] = 3.0
    assert batch.world(0).velocities.tolist() == [[0, 0, 1]] * few
    assert batch.world(1).masses[-1] == 3.0
    assert (batch.world(0).radii == 0.5 * carom.load("tutorial1").world().radii).all()
    before = batch.state_hashes
    batch.masses[0, few] = 1.0
    with pytest.raises(
        carom.CaromError, match=rf"masses\[0, {few}\]: this world has {few} spheres"
    ):
        batch.step()
    assert np.isnan(batch.masses[0, few])
    assert batch.state_hashes.tolist() == before.tolist()
    empty = carom.Batch([carom.Scene(name="empty"), carom.Scene(name="empty, too")])
    empty.step(dt=0.1)
    assert empty.positions.shape == (2, 0, 3) and empty.ids.shape == (2, 0)


def test_every_built_in_scene_can_be_a_batch() -> None:
    for name in ["tutorial1", "tutorial2", "tutorial3", "tutorial4", "maze", "simtest6"]:
        batch, world = carom.Batch(name, 2), carom.load(name).world()
        batch.step(frames=50)
        world.step(frames=50)
        assert batch.state_hashes.tolist() == 2 * hashes([world]), name


def test_worlds_have_parameters_of_their_own() -> None:
    restitutions = np.linspace(0.2, 1.0, N)
    rules = (RULES * N)[:N]
    changes = {"colliders.0.restitution": restitutions, "simulation.rule": rules}
    batch = carom.Batch(gas(), N, changes=changes)
    scenes = [
        gas(rule).with_changes({"colliders.0.restitution": float(restitution)})
        for rule, restitution in zip(rules, restitutions, strict=True)
    ]
    worlds = [scene.world() for scene in scenes]
    twin = carom.Batch(scenes)
    batch.step(frames=50)
    twin.step(frames=50)
    for world in worlds:
        world.step(frames=50)
    assert batch.state_hashes.tolist() == hashes(worlds) == twin.state_hashes.tolist()
    assert len(set(hashes(worlds))) == N


def test_single_worlds_are_reset_and_the_others_go_on() -> None:
    batch = carom.Batch(gas(), N, seeds=range(N))
    start = batch.state_hashes
    batch.step(frames=5)
    then = batch.state_hashes
    batch.reset([1, 4])
    mixed = np.where(np.isin(np.arange(N), [1, 4]), start, then)
    np.testing.assert_array_equal(batch.state_hashes, mixed)
    mask = np.zeros(N, bool)
    mask[0] = True
    batch.reset(mask)
    assert batch.state_hashes[0] == start[0]
    assert batch.state_hashes[2] == then[2]
    batch.step(frames=5)
    np.testing.assert_array_equal(batch.state_hashes[[0, 1, 4]], then[[0, 1, 4]])
    batch.reset()
    np.testing.assert_array_equal(batch.state_hashes, start)


def test_arrays_are_kept_and_written_anew_by_each_step() -> None:
    batch = carom.Batch(gas(), N)
    names = ["positions", "velocities", "radii", "masses", "restitutions", "applied_forces"]
    arrays: dict[str, NDArray[np.float64]] = {name: getattr(batch, name) for name in names}
    addresses = {name: array.ctypes.data for name, array in arrays.items()}
    before = arrays["positions"].copy()
    batch.step(frames=3)
    assert not np.array_equal(before, arrays["positions"])
    batch.radii = 0.1
    assert (arrays["radii"] == 0.1).all()
    batch.reset()
    np.testing.assert_array_equal(before, arrays["positions"])
    for name, array in arrays.items():
        assert getattr(batch, name) is array, name
        assert getattr(batch, name).ctypes.data == addresses[name], name
        assert array.flags.c_contiguous and array.dtype == np.float64, name
    kept = arrays["positions"]
    last = kept.copy()
    del batch
    np.testing.assert_array_equal(kept, last)


def test_each_sphere_of_each_world_is_steered_by_itself() -> None:
    scene = carom.Scene(
        name="two", spheres=[carom.Sphere(radius=1), carom.Sphere(position=(5, 0, 0), radius=1)]
    )
    batch = carom.Batch(scene, 3)
    batch.applied_forces = np.arange(18).reshape(3, 2, 3)
    batch.step(dt=0.5, frames=2)
    # v = F t / m with 1 kg, after 1 s; 2 frames add up without rounding.
    np.testing.assert_array_equal(batch.velocities, batch.applied_forces)
    batch.applied_forces = 0
    batch.step(dt=0.5)
    np.testing.assert_array_equal(batch.velocities, np.arange(18).reshape(3, 2, 3))


def test_a_world_can_be_taken_changed_and_put_back() -> None:
    batch = carom.Batch(gas(), N)
    batch.step(frames=2)
    world = batch.world(3)
    assert int(world.state_hash, 16) == int(batch.state_hashes[3])
    world.add_force(carom.ConstantForce((1, 0, 0)))
    batch.set_world(-1, world)
    batch.step(frames=4)
    world.step(frames=4)
    assert int(world.state_hash, 16) == int(batch.state_hashes[N - 1])
    assert int(world.state_hash, 16) != int(batch.state_hashes[3])
    batch.reset([N - 1])
    assert batch.times[N - 1] == 0.04


def test_impacts_and_triggers_tell_their_world() -> None:
    batch = carom.Batch("maze", 3, changes={"simulation.rule": ["exact"] * 3})
    world = batch.world(1)
    batch.positions = np.array([[(2.23, 0.3, 0.7)], [(-2.62, 0.4, 0.79)], [(2.23, 3.0, 0.7)]])
    world.positions = (-2.62, 0.4, 0.79)
    batch.step()
    world.step()
    assert set(batch.triggers["world"]) == {1}
    np.testing.assert_array_equal(batch.triggers["point"], world.triggers["point"])
    batch.step(frames=10)
    world.step(frames=10)
    own = batch.impacts[batch.impacts["world"] == 1]
    np.testing.assert_array_equal(own["impulse"], world.impacts["impulse"])


def test_worlds_that_refuse_a_frame_stay_and_the_others_go_on() -> None:
    scene = carom.Scene(name="one", spheres=[carom.Sphere(radius=1)])
    batch = carom.Batch(scene, 4)
    batch.velocities = np.array([[(1, 0, 0)], [(1e308, 0, 0)], [(2, 0, 0)], [(-1e308, 0, 0)]])
    with pytest.raises(carom.StepError, match=r"world 1 \(and 1 others\): sphere 0") as caught:
        batch.step(dt=10.0)
    assert caught.value.worlds == [1, 3]
    assert batch.times.tolist() == [10.0, 0.0, 10.0, 0.0]
    np.testing.assert_array_equal(batch.positions[:, 0, 0], [10.0, 0.0, 20.0, 0.0])


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("positions", np.nan, "positions: .*finite"),
        ("velocities", np.zeros((2, 12, 3)), r"velocities: must be of shape \(6, 12, 3\)"),
        ("masses", -1.0, "masses: .*mass"),
        ("radii", 0.0, "radii: .*radius"),
        ("restitutions", 1.5, r"restitutions: .*\[0, 1\]"),
        ("applied_forces", np.inf, "applied_forces: .*finite"),
    ],
)
def test_what_makes_no_sense_is_refused_and_changes_nothing(
    name: str, value: object, words: str
) -> None:
    batch = carom.Batch(gas(), N)
    batch.step()
    before, arrays = batch.state_hashes, getattr(batch, name).copy()
    with pytest.raises(carom.CaromError, match=words):
        setattr(batch, name, value)
    np.testing.assert_array_equal(batch.state_hashes, before)
    np.testing.assert_array_equal(getattr(batch, name), arrays)


def test_a_value_refused_in_one_world_is_set_in_none() -> None:
    batch = carom.Batch(gas(), N)
    before = batch.state_hashes
    masses = np.ones((N, 12))
    masses[N - 1, 3] = -1.0
    with pytest.raises(carom.CaromError, match="masses"):
        batch.masses = 2.0 * masses
    np.testing.assert_array_equal(batch.state_hashes, before)


def test_arguments_are_named_when_they_make_no_sense() -> None:
    refusals: list[tuple[Callable[[], object], str]] = [
        (lambda: carom.Batch(gas(), 0), "n: must be at least 1"),
        (lambda: carom.Batch([]), "scene: must be at least one"),
        (lambda: carom.Batch(gas(), 2, seeds=[1]), "seeds: must have 2 values, not 1"),
        (lambda: carom.Batch("tutorial1", 2, seeds=[1, 2]), "seed: the scene has no random"),
        (lambda: carom.Batch(gas(), 2, threads=0), "threads: must be at least 1"),
        (lambda: carom.Batch(gas(), 2).step(dt=-1.0), "dt.* must be positive"),
        (lambda: carom.Batch(gas(), 2).reset([2]), "worlds: must be below 2"),
        (lambda: carom.Batch(gas(), 2).reset([True]), "worlds: must be 2 truth values"),
        (lambda: carom.Batch(gas(), 2).world(2), r"index: must be in \[-2, 2\)"),
    ]
    for call, words in refusals:
        with pytest.raises(carom.CaromError, match=words):
            call()
    with pytest.raises(TypeError, match="n: must be given"):
        carom.Batch(gas())
    with pytest.raises(TypeError, match="worlds: must be whole numbers"):
        carom.Batch(gas(), 2).reset([0.5])


def test_what_is_written_into_arrays_of_a_batch_is_what_its_worlds_go_on_with() -> None:
    written, assigned = carom.Batch(gas(), 3), carom.Batch(gas(), 3)
    written.velocities[1, 2] = (1, 2, 3)
    written.masses[2] *= 2
    velocities, masses = assigned.velocities.copy(), assigned.masses.copy()
    velocities[1, 2] = (1, 2, 3)
    masses[2] *= 2
    assigned.velocities, assigned.masses = velocities, masses
    assert written.state_hashes.tolist() == assigned.state_hashes.tolist()
    assert written.kinetic_energies.tolist() == assigned.kinetic_energies.tolist()


def test_a_bad_value_in_an_array_of_a_batch_names_world_and_row() -> None:
    batch = carom.Batch(gas(), 3)
    before = batch.state_hashes.tolist()
    batch.velocities[0] = 1
    batch.masses[0] = 3
    batch.masses[2, 1] = -1
    with pytest.raises(carom.CaromError, match=r"masses\[2, 1\].*must be positive"):
        batch.step()
    assert batch.state_hashes.tolist() == before
    batch.step()
