"""Springs of scenes made in code, of worlds as they are now, and of kept states.

And those that come into a running world, change there, and go.
"""

from typing import Any

import numpy as np
import pytest

import carom

BALLS = [carom.Sphere(radius=0.1, position=(x, 0, 0)) for x in (0.0, 1.0, 2.5)]
SPRINGS = (
    carom.Spring(stiffness=10.0, spheres=(0, 1), rest_length=0.5),
    carom.Spring(stiffness=20.0, sphere=2, anchor=(4.0, 0.0, 0.0), only_pulls=True),
)
make: Any = carom
"""Without types, which know no numbers with units and no formulas."""
FALLING = carom.Scene(name="springs", spheres=BALLS, springs=SPRINGS)


def test_a_spring_pulls_with_its_stiffness_times_its_extension() -> None:
    world = carom.World(FALLING)
    # k x² / 2 of both: 0.5 m too long, and at its rest length.
    assert world.potential_energy == pytest.approx(0.5 * 10.0 * 0.5**2, rel=1e-14)


def test_points_are_joined_as_single_spheres_are() -> None:
    points = carom.Points(np.array([ball.position for ball in BALLS]), radii=0.1)
    worlds = [
        carom.World(carom.Scene(name="springs", spheres=it, springs=SPRINGS))
        for it in (BALLS, points)
    ]
    for world in worlds:
        world.step(frames=50)
    assert worlds[0].positions.tolist() == worlds[1].positions.tolist()


def test_a_world_with_springs_is_a_scene_with_the_same_springs() -> None:
    world = carom.World(FALLING)
    world.step(frames=20)
    scene = world.to_scene()
    assert scene.springs[0].spheres == (0, 1)
    # The length at the start of the first scene, which its file left open.
    assert scene.springs[1].rest_length == pytest.approx(1.5, rel=1e-15)
    again = carom.World(scene)
    for it in (world, again):
        it.step(frames=20)
    # Frames begin at another time, which rounds otherwise.
    np.testing.assert_allclose(again.positions, world.positions, rtol=0, atol=1e-13)


def test_springs_of_a_sphere_that_is_removed_go_with_it() -> None:
    world = carom.World(FALLING)
    world.remove_sphere(world.ids[1])
    springs = world.to_scene().springs
    assert [spring.sphere for spring in springs] == [1]


def test_kept_states_have_their_springs() -> None:
    world = carom.World(FALLING)
    world.step(frames=7)
    kept = carom.Snapshot.from_bytes(world.snapshot().to_bytes())
    other = carom.World()
    other.restore(kept)
    for it in (world, other):
        it.step(frames=30)
    assert other.state_hash == world.state_hash


def test_a_spring_to_a_sphere_that_is_not_there_is_refused() -> None:
    scene = carom.Scene(
        name="x", spheres=BALLS, springs=[carom.Spring(stiffness=1.0, spheres=(0, 3))]
    )
    with pytest.raises(carom.SceneError, match=r"springs\[0\]\.spheres: there is no sphere 3"):
        carom.World(scene)


def rejoined() -> carom.World:
    """The world of `FALLING`, to which its springs were added one by one."""
    world = carom.World(carom.Scene(name="balls", spheres=BALLS))
    assert [world.add_spring(spring) for spring in SPRINGS] == [0, 1]
    return world


def test_springs_that_are_added_make_the_bits_of_a_scene_with_them() -> None:
    worlds = (carom.World(FALLING), rejoined())
    assert worlds[0].springs == worlds[1].springs
    for world in worlds:
        world.step(frames=50)
    assert worlds[0].state_hash == worlds[1].state_hash
    free = carom.World(carom.Scene(name="balls", spheres=BALLS))
    free.step(frames=50)
    assert free.state_hash != worlds[0].state_hash


def test_springs_name_spheres_by_their_ids() -> None:
    world = rejoined()
    world.remove_sphere(0)
    # The spring of the sphere went with it; numbers would have moved up.
    assert [(id, spring.sphere) for id, spring in world.springs.items()] == [(1, 2)]
    id = world.add_spring(make.Spring(spheres=world.ids, stiffness="2 kN/m"))
    assert id == 2
    # The length of now.
    assert world.springs[id] == carom.Spring(spheres=(1, 2), rest_length=1.5, stiffness=2000.0)
    assert [spring.spheres for spring in world.to_scene().springs] == [None, (0, 1)]


def test_a_spring_that_is_changed_or_removed_acts_so() -> None:
    world = rejoined()
    world.set_spring(0, carom.Spring(spheres=(0, 1), rest_length=0.5, stiffness=30.0))
    assert list(world.springs) == [0, 1]
    assert world.potential_energy == pytest.approx(0.5 * 30.0 * 0.5**2, rel=1e-14)
    world.remove_spring(0)
    assert (list(world.springs), world.potential_energy) == ([1], 0.0)


def test_ids_of_springs_are_never_given_twice() -> None:
    world = rejoined()
    world.remove_spring(1)
    assert world.add_spring(SPRINGS[1]) == 2
    with pytest.raises(carom.UnknownError, match="there is no spring 1 in this world"):
        world.remove_spring(1)
    with pytest.raises(carom.UnknownError, match="there is no spring 1 in this world"):
        world.set_spring(1, SPRINGS[1])


@pytest.mark.parametrize(
    ("spring", "error", "message"),
    [
        (carom.Spring(spheres=(0, 7), stiffness=1), carom.UnknownError, "there is no sphere 7 in"),
        (
            carom.Spring(spheres=(0, 7), rest_length=1, stiffness=1),
            carom.UnknownError,
            "there is no sphere 7 in",
        ),
        (carom.Spring(spheres=(1, 1), stiffness=1), carom.SceneError, "spheres: must be two sph"),
        (carom.Spring(chain=(0, 2), stiffness=1), carom.SceneError, "chain: a running world takes"),
        (carom.Spring(sphere=0, stiffness=1), carom.SceneError, "needs `spheres`, `sphere` and"),
        (
            make.Spring(spheres=(0, 1), stiffness="=1 - 2"),
            carom.SceneError,
            "stiffness: must be zero or positive",
        ),
        (carom.Gravity(), TypeError, "spring: must be a carom.Spring"),
    ],
)
def test_a_spring_that_makes_no_sense_leaves_the_world_as_it_was(
    spring: carom.Spring, error: type[Exception], message: str
) -> None:
    world = rejoined()
    before = world.springs
    with pytest.raises(error, match=message):
        world.add_spring(spring)
    with pytest.raises(error, match=message):
        world.set_spring(0, spring)
    assert world.springs == before


@pytest.mark.parametrize("value", [-1.0, float("nan"), float("inf")])
@pytest.mark.parametrize("name", ["stiffness", "rest_length", "damping"])
def test_numbers_of_a_spring_are_not_negative(name: str, value: float) -> None:
    with pytest.raises(carom.CaromError, match=rf"Spring\.{name}: must be zero or positive"):
        make.Spring(**{"spheres": (0, 1), "stiffness": 1.0, name: value})


def test_springs_of_points_take_units() -> None:
    points = carom.Points(np.array([ball.position for ball in BALLS]), radii=0.1)
    spring = make.Spring(spheres=(0, 1), stiffness="2 kN/m")
    world = carom.World(carom.Scene(name="springs", spheres=points, springs=[spring]))
    assert world.springs[0].stiffness == 2000.0


def test_copies_and_kept_states_have_springs_that_were_added() -> None:
    world = rejoined()
    start = world.snapshot()
    world.remove_spring(0)
    assert list(world.springs) == [1]
    world.restore(start)
    assert list(world.springs) == [0, 1]
