"""Pickles and bytes: what is read goes on as what was written would have."""

import copy
import io
import multiprocessing
import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import carom


def again(world: carom.World) -> carom.World:
    twin = pickle.loads(pickle.dumps(world))
    assert isinstance(twin, carom.World)
    return twin


def of_bytes(world: carom.World) -> carom.World:
    twin = carom.World()
    twin.restore(carom.Snapshot.from_bytes(world.snapshot().to_bytes()))
    return twin


@pytest.mark.parametrize("make", [again, of_bytes])
@pytest.mark.parametrize("rule", ["exact", "contact", "bisect", "discrete"])
def test_a_world_goes_on_bit_for_bit(rule: str, make: Callable[[carom.World], carom.World]) -> None:
    # In the middle of flights, and with emitters at work.
    world = carom.load("simtest1", {"simulation.rule": rule}).world()
    world.step(dt=0.0137, frames=150)
    twin = make(world)
    assert (twin.state_hash, twin.time) == (world.state_hash, world.time)
    assert (twin.forces, twin.colliders, twin.emitters) == (
        world.forces,
        world.colliders,
        world.emitters,
    )
    assert twin.simulation == world.simulation
    assert twin.to_scene() == world.to_scene()
    for _ in range(3):
        world.step(frames=100)
        twin.step(frames=100)
        assert twin.state_hash == world.state_hash
        assert (twin.impacts == world.impacts).all()


def test_a_gas_and_a_heap_go_on_bit_for_bit() -> None:
    for name, overrides in [("gas", {}), ("pour", {}), ("pour", {"simulation.rule": "exact"})]:
        world = carom.load(name, overrides).world()
        world.step(frames=60)
        twin = again(world)
        world.step(frames=60)
        twin.step(frames=60)
        assert twin.state_hash == world.state_hash, name


def test_the_same_state_has_the_same_bytes() -> None:
    worlds = [carom.load("gas").world() for _ in range(2)]
    for world in worlds:
        world.step(frames=10)
    assert worlds[0].snapshot().to_bytes() == worlds[1].snapshot().to_bytes()


def test_a_snapshot_is_pickled_and_copied() -> None:
    world = carom.load("cradle").world()
    world.step(frames=10)
    snapshot = world.snapshot()
    world.step(frames=10)
    for other in (pickle.loads(pickle.dumps(snapshot)), copy.copy(snapshot)):
        assert other.time == snapshot.time
        twin = carom.World()
        twin.restore(other)
        twin.step(frames=10)
        assert twin.state_hash == world.state_hash


class Named(carom.World):
    """A world with more to it."""

    names: list[str]


def trap(world: carom.World) -> np.ndarray:
    return -world.positions


def test_what_else_a_world_has_is_in_its_pickle() -> None:
    world = Named(carom.load("simtest2"))
    world.names = ["a"]
    world.add_force(trap)
    twin = pickle.loads(pickle.dumps(world))
    assert isinstance(twin, Named) and twin.names == ["a"]
    for it in (world, twin):
        it.step(frames=50)
    assert twin.state_hash == world.state_hash
    # The next function gets another id than the first.
    assert twin.add_force(trap) == world.add_force(trap)


def test_colours_are_in_the_bytes() -> None:
    red = (1.0, 0.0, 0.0)
    row = carom.Row(2, (0, 0, 0), (1, 0, 0), carom.Sphere(radius=0.1, color=red))
    emitter = carom.Emitter(carom.Sphere(radius=0.1, color=red), 0.5, position=(0, 9, 0))
    colors = carom.Colors(spheres=(0.0, 0.0, 1.0))
    scene = carom.Scene(name="colours", generators=[row], emitters=[emitter], colors=colors)
    world = scene.world()
    world.step(dt=0.7)
    world.add_sphere(carom.Sphere(position=(0, -5, 0), radius=0.1))
    twin = of_bytes(world)
    for it in (world, twin):
        it.step(dt=0.7)
    found = [world.sphere(id).color for id in world.ids.tolist()]
    assert [twin.sphere(id).color for id in twin.ids.tolist()] == found
    assert found == [red, red, red, red, None, red]
    assert twin.to_scene() == world.to_scene()


def test_a_batch_goes_on_bit_for_bit_and_starts_where_it_did() -> None:
    heights = [5.0, 6.0, 7.0]
    batch = carom.Batch("tutorial1", 3, changes={"spheres.0.position.1": heights}, threads=1)
    batch.step(frames=20)
    changed = batch.world(1)
    changed.velocities += (0, 1, 0)
    batch.set_world(1, changed)
    batch.step(frames=20)
    twin = pickle.loads(pickle.dumps(batch))
    assert isinstance(twin, carom.Batch) and repr(twin) == repr(batch)
    for it in (batch, twin):
        it.step(frames=20)
    assert (twin.state_hashes == batch.state_hashes).all()
    for it in (batch, twin):
        it.reset()
    assert (twin.state_hashes == batch.state_hashes).all()
    assert twin.times.tolist() == batch.times.tolist() == [0.0, changed.time, 0.0]


def test_worlds_that_share_their_start_are_written_with_one() -> None:
    few, many = (carom.Batch("tutorial1", n) for n in (1, 50))
    of_few, of_many = (len(pickle.dumps(batch)) for batch in (few, many))
    # One start and 50 states, not 50 of both.
    assert of_many < 30 * of_few


def hash_later(world: carom.World) -> str:
    world.step(frames=50)
    return world.state_hash


def test_another_process_goes_on_with_a_world() -> None:
    world = carom.load("tutorial2").world()
    world.step(frames=10)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(hash_later, (world,))
    assert there == hash_later(world)


def test_bytes_that_are_no_snapshot_are_refused() -> None:
    good = carom.load("simtest1").world().snapshot().to_bytes()
    wrong = {
        "no snapshot of Carom": [b"", b"[scene]", good[1:]],
        "damaged": [good[:-1], good[:40], good + b"x", good[:200] + b"?" + good[201:]],
        "only the same version": [good[:9] + b"9" + good[10:]],
    }
    for words, all_bytes in wrong.items():
        for data in all_bytes:
            with pytest.raises(carom.CaromError, match=words):
                carom.Snapshot.from_bytes(data)
    with pytest.raises(TypeError):
        carom.Snapshot.from_bytes("text")  # type: ignore[arg-type]


def test_a_file_holds_several(tmp_path: Path) -> None:
    worlds = [carom.load(name).world() for name in ("cradle", "bounce")]
    file = io.BytesIO()
    for world in worlds:
        pickle.dump(world, file)
    file.seek(0)
    hashes = [pickle.load(file).state_hash for _ in worlds]
    assert hashes == [world.state_hash for world in worlds]
