"""Bytes of snapshots, compressed alone and as a delta against an earlier snapshot.

A delta is made by Zstandard with the bytes of the base as its dictionary; whoever has the base
reads it back.
"""

from typing import Literal

import numpy as np
import zstandard

import carom

BALLS = 800
FRAME = 1 / 60
LEVEL = 3


def fallen(rule: Literal["contact", "exact"]) -> carom.World:
    """Returns balls in ten layers above a floor, as in the benchmark `snapshots` of the engine."""
    number = np.arange(BALLS)
    x, y, z = number % 10, number // 80, number // 10 % 8
    scene = carom.Scene(name="fallen", simulation=carom.Simulation(rule=rule))
    world = carom.World(scene)
    world.add_force(carom.Gravity(acceleration=[0, -9.81, 0]))
    world.add_collider(carom.Collider(shape=carom.HalfSpace()))
    places = np.stack([1.1 * x + 0.01 * y, 0.6 + 1.1 * y, 1.1 * z + 0.01 * y], axis=1)
    world.add_spheres(places, radii=0.5, restitutions=0.5)
    return world


def delta(base: bytes, now: bytes) -> bytes:
    """Compresses `now` against `base`, and checks that it comes back."""
    known = zstandard.ZstdCompressionDict(base, dict_type=zstandard.DICT_TYPE_RAWCONTENT)
    packed = zstandard.ZstdCompressor(level=LEVEL, dict_data=known).compress(now)
    assert zstandard.ZstdDecompressor(dict_data=known).decompress(packed) == now
    return packed


def main() -> None:
    """Prints bytes for a ball while the balls move, and when they rest."""
    for rule in ("contact", "exact"):
        world = fallen(rule)
        for seconds, state in ((1.0, "moving"), (40.0, "at rest")):
            world.step(frames=round(seconds / FRAME), dt=FRAME)
            base = world.snapshot().to_bytes()
            world.step(frames=8, dt=FRAME)
            now = world.snapshot().to_bytes()
            alone = zstandard.ZstdCompressor(level=LEVEL).compress(now)
            sizes = [len(it) / BALLS for it in (now, alone, delta(base, now))]
            plain, compressed, against = (f"{it:.0f}" for it in sizes)
            print(f"{rule}, {state}: {plain} bytes, {compressed} compressed, {against} as a delta")


if __name__ == "__main__":
    main()
