"""Packings by `carom.pack`: the bits of the command, no overlap, scenes with them."""

import itertools
import subprocess
import sys
from collections.abc import Callable

import numpy as np
import pytest

import carom


def test_pack_has_the_bits_of_the_command() -> None:
    fluid = carom.pack(60, 0.4, sizes="0.5:2,0.6-0.7:1", seed=3, growth=0.1, equilibrate=5)
    command = [
        sys.executable,
        "-m",
        "carom",
        "pack",
        "--spheres",
        "60",
        "--packing-fraction",
        "0.4",
    ]
    command += [
        "--sizes",
        "0.5:2,0.6-0.7:1",
        "--seed",
        "3",
        "--growth",
        "0.1",
        "--equilibrate",
        "5",
    ]
    said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    figures = dict(line.rsplit(maxsplit=1) for line in said.splitlines() if "rate" not in line)
    assert figures["state hash"] == fluid.state_hash
    assert figures["reduced pressure"] == f"{fluid.pressure:.6f}"
    assert figures["collisions"] == str(fluid.collisions)


def test_a_packing_fills_its_box_without_overlap() -> None:
    fluid = carom.pack(80, 0.45, growth=0.1)
    assert fluid.positions.shape == (80, 3) and len(fluid) == 80
    volume = (4 / 3 * np.pi * fluid.radii**3).sum() / fluid.box.prod()
    # Radii grow in some hundred frames, in each of which they are rounded.
    assert abs(volume - 0.45) < 1e-12 and abs(fluid.packing_fraction - 0.45) < 1e-12
    for one, other in itertools.combinations(range(80), 2):
        distance = fluid.positions[one] - fluid.positions[other]
        distance -= np.round(distance / fluid.box) * fluid.box
        assert np.linalg.norm(distance) > (fluid.radii[one] + fluid.radii[other]) * (1 - 1e-12)
    assert fluid.rattlers is None and fluid.collision_rate > 0


def test_radii_may_be_given_one_by_one() -> None:
    radii = np.linspace(0.4, 0.6, 50)
    fluid = carom.pack(packing_fraction=0.3, sizes=radii, growth=0.1)
    # As above.
    assert np.allclose(fluid.radii, radii, rtol=1e-12, atol=0)
    # Masses go with the cubes of radii.
    assert np.allclose(fluid.masses, radii**3, rtol=1e-12, atol=0)


def test_a_scene_of_a_packing_goes_on_with_it() -> None:
    fluid = carom.pack(60, 0.4, growth=0.1)
    world = fluid.scene("fluid").world()
    assert world.positions.tolist() == fluid.positions.tolist()
    energy = world.kinetic_energy
    world.step(frames=5)
    # Elastic impacts keep it but for rounding.
    assert abs(world.kinetic_energy / energy - 1) < 1e-12


def test_a_dense_fluid_is_a_generator() -> None:
    ball = carom.Sphere(mass=2.0)
    fluid = carom.DenseFluid(100, 1.5, 1, ball, packing_fraction=0.4)
    box = carom.Simulation(boundary=carom.Periodic(size=(6, 6, 6)))
    scene = carom.Scene(name="fluid", generators=[fluid], simulation=box)
    assert carom.Scene.from_toml(scene.to_toml()).generators == (fluid,)
    world = scene.world()
    # k T is two thirds of the mean kinetic energy, rounded.
    assert abs(world.kinetic_energy / 100 / 1.5 - 1.5) < 1e-12
    assert scene.with_seed(2).world().positions.tolist() != world.positions.tolist()


REFUSALS: list[tuple[Callable[[], object], str]] = [
    (lambda: carom.pack(0), "spheres: must be in "),
    (lambda: carom.pack(100, 1.5), "packing_fraction"),
    (lambda: carom.pack(100, 0.4, sizes="0.5:x"), "sizes: 0.5:x: a positive number is needed"),
    (lambda: carom.pack(100, 0.4, sizes=-1), "radius"),
    (lambda: carom.pack(100, 0.4, seed=-1), "seed: must be in"),
    (lambda: carom.pack(100, 0.4, growth=0), "growth"),
    (lambda: carom.pack(100, 0.4, pressure=9, equilibrate=5), "equilibrate: "),
    (
        lambda: carom.pack(40, 0.72, growth=1),
        "packing_fraction: jammed at a packing fraction of 0.",
    ),
    (
        lambda: carom.DenseFluid(9, 1, 1, carom.Sphere()),
        "DenseFluid.sphere: needs `radius` or `diameter`, or give `radius_range` or",
    ),
    (
        lambda: carom.DenseFluid(9, 1, 1, carom.Sphere(radius=1), packing_fraction=0.4),
        "DenseFluid.packing_fraction: must not be given beside a radius",
    ),
    (
        lambda: carom.DenseFluid(9, 1, 1, carom.Sphere(), packing_fraction=1.4),
        "DenseFluid.packing_fraction: must be between 0 and 1, not 1.4",
    ),
]


@pytest.mark.parametrize(("make", "message"), REFUSALS)
def test_what_makes_no_packing_is_refused(make: Callable[[], object], message: str) -> None:
    with pytest.raises(carom.CaromError) as refusal:
        make()
    assert message in str(refusal.value)


def test_sizes_of_another_kind_are_refused() -> None:
    with pytest.raises(TypeError, match="sizes: must be a text, a radius, or an array"):
        carom.pack(10, 0.4, sizes=[[0.5]])
