"""Springs of scenes made in code, of worlds as they are now, and of kept states."""

import numpy as np
import pytest

import carom

BALLS = [carom.Sphere(radius=0.1, position=(x, 0, 0)) for x in (0.0, 1.0, 2.5)]
SPRINGS = (
    carom.Spring(stiffness=10.0, spheres=(0, 1), rest_length=0.5),
    carom.Spring(stiffness=20.0, sphere=2, anchor=(4.0, 0.0, 0.0), only_pulls=True),
)
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
