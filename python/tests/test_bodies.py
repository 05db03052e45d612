"""What a game needs of spheres: impulses at a point, groups, and data of its own."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

import carom


def test_an_impulse_beside_the_centre_turns_a_ball() -> None:
    world = carom.World()
    ball = world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.5, mass=2))
    world.apply_impulse(ball, (0, 4, 0))
    assert world.velocities[0].tolist() == [0, 2, 0]
    assert not world.angular_velocities.any()
    world.apply_impulse_at(ball, (1, 0, 0), (1, 0.5, 0))
    assert world.velocities[0].tolist() == [0.5, 2, 0]
    # r × J over 2/5 m r² = 0.2 kg m², to rounding of 0.4.
    np.testing.assert_allclose(world.angular_velocities[0], (0, 0, -2.5), rtol=1e-15)


def test_one_sphere_gets_another_velocity_by_its_id() -> None:
    world = carom.World()
    _, ball = world.add_spheres([(0, 0, 0), (3, 0, 0)], radii=1)
    world.set_velocity(ball, (1, 2, 3))
    world.set_angular_velocity(ball, (4, 5, 6))
    assert world.velocities.tolist() == [[0, 0, 0], [1, 2, 3]]
    assert world.angular_velocities.tolist() == [[0, 0, 0], [4, 5, 6]]
    with pytest.raises(carom.UnknownError, match="no sphere 9"):
        world.set_velocity(9, (0, 0, 0))
    with pytest.raises(carom.CaromError, match="velocity"):
        world.set_velocity(ball, (np.inf, 0, 0))
    with pytest.raises(carom.CaromError, match=r"impulse: must be of shape \(3,\)"):
        world.apply_impulse(ball, (1, 2))
    with pytest.raises(TypeError, match="point: must be an array of numbers"):
        world.apply_impulse_at(ball, (1, 2, 3), "top")
    assert world.velocities.tolist() == [[0, 0, 0], [1, 2, 3]]


def facing() -> carom.World:
    """Two balls that move towards each other."""
    world = carom.World()
    velocities = [(1, 0, 0), (-1, 0, 0)]
    world.add_spheres([(-2, 0, 0), (2, 0, 0)], radii=0.5, velocities=velocities)
    return world


def test_spheres_of_other_groups_pass_through_each_other() -> None:
    world = facing()
    assert (world.groups.tolist(), world.user_data.tolist()) == ([1, 1], [0, 0])
    assert world.collides_with.tolist() == [0xFFFFFFFF] * 2
    world.collides_with = [0b10, 0b10]
    world.step(dt=4.0)
    assert (len(world.impacts), world.positions[0, 0]) == (0, 2.0)
    world.groups = 0b10
    world.velocities *= -1
    world.step(dt=2.0)
    assert len(world.impacts) == 1


def test_groups_and_data_go_with_spheres_wherever_they_go() -> None:
    world = facing()
    world.user_data = [7, 2**63 - 1]
    world.groups = np.array([0b01, 0b10], dtype=np.uint8)
    twins = [copy.copy(world), pickle.loads(pickle.dumps(world)), world.to_scene().world()]
    for twin in twins:
        assert twin.user_data.tolist() == [7, 2**63 - 1]
        assert twin.groups.tolist() == [0b01, 0b10]
    assert world.sphere(1) == dataclasses.replace(world.sphere(1), user_data=2**63 - 1)
    points = world.to_scene().spheres
    assert isinstance(points, carom.Points)
    assert pickle.loads(pickle.dumps(points)) == points
    assert points[1].groups == 0b10
    assert points[1:].user_data.tolist() == [2**63 - 1]
    world.remove_sphere(0)
    assert world.user_data.tolist() == [2**63 - 1]
    other = carom.World()
    other.add_spheres([(0, 0, 0), (5, 0, 0)], radii=1, user_data=[3, 4])
    assert other.user_data.tolist() == [3, 4]


def test_groups_that_make_no_sense_are_refused() -> None:
    world = facing()
    with pytest.raises(carom.CaromError, match=r"groups: must be in \[0, 2\^32\), not 4294967296"):
        world.groups = [1, 2**32]
    with pytest.raises(carom.CaromError, match=r"user_data: must be in \[0, 2\^63\), not -1"):
        world.user_data = -1
    with pytest.raises(carom.CaromError, match=r"user_data: must be in \[0, 2\^63\)"):
        world.user_data = 2**63
    with pytest.raises(carom.CaromError, match=r"groups: must be of shape \(2,\)"):
        world.groups = [1, 2, 3]
    with pytest.raises(TypeError, match="groups: must be a whole number, not float"):
        world.groups = 1.5
    with pytest.raises(TypeError, match="groups: must be whole numbers, not float64"):
        world.groups = np.ones(2)
    with pytest.raises(ValueError, match="read-only"):
        world.groups[0] = 2
    assert world.groups.tolist() == [1, 1]
