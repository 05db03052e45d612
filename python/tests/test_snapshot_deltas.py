"""Bytes of snapshots as deltas against earlier ones."""

from typing import Literal

import numpy as np
import pytest
import zstandard

import carom

BALLS = 200
FRAME = 1 / 60

Rule = Literal["exact", "contact"]


def resting(rule: Rule) -> carom.World:
    """Returns a world of balls that lie on a floor, and one that flies."""
    world = carom.World(carom.Scene(name="rest", simulation=carom.Simulation(rule=rule)))
    world.add_force(carom.Gravity(acceleration=[0, -9.81, 0]))
    world.add_collider(carom.Collider(shape=carom.HalfSpace()))
    row, column = np.divmod(np.arange(BALLS), 20)
    places = np.stack([1.1 * column, np.full(BALLS, 0.5), 1.1 * row], axis=1)
    world.add_spheres(places, radii=0.5, restitutions=0.0)
    world.add_sphere(carom.Sphere(position=(0, 20, 0), radius=0.5))
    world.step(frames=60, dt=FRAME)
    return world


@pytest.mark.parametrize("rule", ["exact", "contact"])
def test_a_delta_has_few_bytes_for_balls_at_rest_and_gives_back_every_bit(rule: Rule) -> None:
    world = resting(rule)
    base = world.snapshot().to_bytes()
    world.step(frames=8, dt=FRAME)
    now = world.snapshot().to_bytes()
    known = zstandard.ZstdCompressionDict(base, dict_type=zstandard.DICT_TYPE_RAWCONTENT)
    delta = zstandard.ZstdCompressor(dict_data=known).compress(now)
    # Games aim at this size of a state.
    assert len(delta) < 64 * BALLS
    other = carom.World()
    received = zstandard.ZstdDecompressor(dict_data=known).decompress(delta)
    other.restore(carom.Snapshot.from_bytes(received))
    assert other.state_hash == world.state_hash
