"""Worlds in Python do what the engine does."""

import dataclasses

import numpy as np
import pytest

import carom


def cradle() -> carom.Scene:
    """Five touching balls in a row, and a sixth that comes in from the left."""
    balls = [carom.Sphere(position=(x, 0, 0), radius=0.5) for x in range(5)]
    first = carom.Sphere(position=(-3, 0, 0), velocity=(2, 0, 0), radius=0.5)
    return carom.Scene(name="cradle", spheres=[first, *balls])


def test_a_cradle_lets_only_the_last_ball_go() -> None:
    world = cradle().world()
    energy = world.kinetic_energy
    run = world.run(seconds=2)
    # Reflection of equal masses: to rounding of numbers of order 1.
    expected = np.zeros((6, 3))
    expected[-1, 0] = 2
    np.testing.assert_allclose(world.velocities, expected, atol=1e-14)
    assert world.kinetic_energy == pytest.approx(energy, rel=1e-14)
    assert len(run.impacts) == 5
    # The gap of 2 m at 2 m/s.
    np.testing.assert_allclose(run.impacts["time"], 1.0, rtol=1e-14)


def test_impact_laws_answer_a_cradle_differently() -> None:
    scene = cradle().with_changes({"simulation.exact.impact_law": "simultaneous"})
    world = scene.world()
    world.run(seconds=2)
    assert np.count_nonzero(np.abs(world.velocities[:, 0]) > 1e-3) > 1


def test_the_ledger_accounts_for_every_impact() -> None:
    world = cradle().world()
    while not len(world.impacts):
        world.step()
    ledger = world.ledger
    assert ledger.dtype == carom.LEDGER
    assert [ledger[name].tolist() for name in carom.IMPACT.names or ()] == [
        world.impacts[name].tolist() for name in carom.IMPACT.names or ()
    ]
    assert set(ledger["group_size"]) == {5}
    np.testing.assert_allclose(ledger["momentum_before"], ledger["momentum_after"], rtol=1e-14)
    np.testing.assert_allclose(ledger["energy_after"], 2.0, rtol=1e-14)
    assert not ledger["energy_demanded"].any()


def test_a_snapshot_brings_everything_back() -> None:
    world = carom.load("tutorial4").world()
    world.step(frames=30)
    snapshot, hash_then, forces = world.snapshot(), world.state_hash, world.forces
    world.step(frames=30)
    later = world.state_hash
    for force in list(world.forces):
        world.remove_force(force)
    world.add_sphere(carom.Sphere(position=(0, 100, 0), radius=1))
    world.restore(snapshot)
    assert (world.state_hash, world.forces) == (hash_then, forces)
    assert world.time == snapshot.time
    assert len(world.impacts) == 0
    world.step(frames=30)
    assert world.state_hash == later


def test_a_snapshot_into_the_memory_of_another_brings_back_the_later_state() -> None:
    world = carom.load("simtest1").world()
    world.step(frames=30)
    snapshot = world.snapshot()
    world.add_force(carom.ViscousDrag(0.5))
    world.step(frames=30)
    world.snapshot_into(snapshot)
    hash_then, forces = world.state_hash, world.forces
    assert snapshot.time == world.time
    assert carom.Snapshot.from_bytes(snapshot.to_bytes()).to_bytes() == world.snapshot().to_bytes()
    world.step(frames=30)
    later = world.state_hash
    other = carom.World()
    for it in (world, other):
        it.restore(snapshot)
        assert (it.state_hash, it.forces) == (hash_then, forces)
        it.step(frames=30)
        assert it.state_hash == later


def test_a_world_says_whether_it_turns_and_how_long_its_frames_may_be() -> None:
    world = carom.World(carom.Scene(name="spring", simulation=carom.Simulation(rule="discrete")))
    assert world.longest_stable_frame == np.inf
    ball = world.add_sphere(carom.Sphere(radius=0.5, mass=4))
    world.add_spring(carom.Spring(sphere=ball, anchor=(0, 1, 0), stiffness=16))
    # Two over the frequency of the spring.
    assert world.longest_stable_frame == 1.0
    assert (world.has_spin, world.unfinished_islands) == (False, 0)
    world.set_angular_velocity(ball, (0, 1, 0))
    assert world.has_spin


def test_a_step_of_many_frames_is_as_many_steps() -> None:
    one, many = carom.load("simtest3").world(), carom.load("simtest3").world()
    for _ in range(100):
        one.step()
    many.step(frames=100)
    assert one.state_hash == many.state_hash


def test_parts_are_added_changed_and_removed() -> None:
    world = carom.World()
    gravity = world.add_force(carom.Gravity((0, -1, 0)))
    drag = world.add_force(carom.ViscousDrag(0.5))
    world.set_force(gravity, carom.ConstantForce((0, 3, 0)))
    assert world.forces == {gravity: carom.ConstantForce((0, 3, 0)), drag: carom.ViscousDrag(0.5)}
    world.remove_force(gravity)
    assert list(world.forces) == [drag]

    floor = world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0.5, name="floor"))
    lift = world.add_collider(carom.Collider(carom.Box((1, 1, 1)), (0, 5, 0), velocity=(0, 1, 0)))
    world.step(dt=1.0)
    assert world.colliders[lift].position == (0, 6, 0)
    assert world.colliders[floor].name == "floor"
    world.set_collider(floor, carom.Collider(carom.Rectangle(2, 3)))
    assert world.colliders[floor].shape == carom.Rectangle(2, 3)
    world.remove_collider(lift)
    assert list(world.colliders) == [floor]

    source = carom.Emitter(carom.Sphere(radius=0.1), period=0.5, position=(0, 9, 0), max_spheres=2)
    emitter = world.add_emitter(source)
    world.step(dt=1.2)
    assert world.emitted.tolist() == [0, 1, 2]
    assert world.retired.tolist() == [0]
    assert world.emitters[emitter].max_spheres == 2
    world.remove_emitter(emitter)
    world.step(dt=5.0)
    assert (world.ids.tolist(), world.emitters) == ([1, 2], {})

    ball = carom.Sphere(position=(7, 7, 7), radius=0.25, mass=2.0, restitution=0.5)
    world.set_sphere(1, ball)
    assert world.sphere(1) == ball


def test_an_emitter_that_needs_room_leaves_spheres_out() -> None:
    still = carom.Emitter(carom.Sphere(radius=0.1), period=0.5, needs_room=True)
    world = carom.Scene(name="full", emitters=[still]).world()
    world.step(dt=1.2)
    assert (world.emitted.tolist(), world.left_out.tolist()) == ([0], [1, 2])
    assert world.emitters[0].needs_room
    world.set_emitter(0, dataclasses.replace(still, needs_room=None))
    world.step(dt=0.5)
    assert (world.emitted.tolist(), world.left_out.tolist()) == ([3], [])


def test_an_emitter_ends_with_its_count_and_goes_on_with_a_larger_one() -> None:
    source = carom.Emitter(carom.Sphere(radius=0.1, velocity=(9, 0, 0)), period=0.5, count=2)
    world = carom.Scene(name="two", emitters=[source]).world()
    world.step(dt=5.0)
    assert world.emitted.tolist() == [0, 1]
    assert world.emitters[0].count == 2
    world.set_emitter(0, dataclasses.replace(source, count=3))
    world.step(dt=5.0)
    assert world.emitted.tolist() == [2]
    with pytest.raises(ValueError, match="count: must be at least 1"):
        world.set_emitter(0, dataclasses.replace(source, count=0))


def test_how_a_world_is_stepped_can_be_changed() -> None:
    world = carom.World()
    box = carom.Simulation(boundary=carom.Periodic((4, 5, float("inf"))), frame_time=0.25)
    world.simulation = box
    assert world.simulation.boundary == carom.Periodic((4, 5, float("inf")))
    assert world.frame_time == 0.25
    world.add_sphere(carom.Sphere(position=(1.5, 0, 0), velocity=(1, 0, 0), radius=0.5))
    world.step(dt=1.0)
    # What leaves through a face comes in through the opposite one.
    assert world.positions.tolist() == [[-1.5, 0, 0]]


def test_triggers_report_who_is_inside() -> None:
    world = carom.World()
    gate = world.add_collider(carom.Collider(carom.Box((2, 2, 2)), trigger=True))
    ball = world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.5))
    world.step(dt=0.1)
    assert world.triggers[["collider", "sphere"]].tolist() == [(gate, ball)]


def test_a_scene_of_now_begins_where_the_world_is() -> None:
    world = carom.load("tutorial2").world()
    world.step(frames=50)
    again = world.to_scene().world()
    assert np.array_equal(again.positions, world.positions)
    assert np.array_equal(again.velocities, world.velocities)
    assert again.time == 0


def test_sums_are_those_of_the_arrays() -> None:
    world = carom.load("tutorial4").world()
    world.step(frames=20)
    momentum = (world.masses[:, None] * world.velocities).sum(axis=0)
    np.testing.assert_allclose(world.momentum, momentum, rtol=1e-12, atol=1e-9)
    kinetic = (0.5 * world.masses * (world.velocities**2).sum(axis=1)).sum()
    assert world.kinetic_energy == pytest.approx(kinetic, rel=1e-12)
    assert world.total_energy == world.kinetic_energy + world.potential_energy
    assert world.angular_momentum.shape == (3,)


def test_a_paddle_on_its_way_to_a_pose_strikes_a_ball_to_twice_its_speed() -> None:
    world = carom.World()
    paddle = world.add_collider(carom.Collider(carom.Box((1, 1, 1))))
    ball = world.add_sphere(carom.Sphere(position=(1.5, 0, 0), radius=0.5))
    world.set_next_pose(paddle, position=(2, 0, 0), dt=1.0)
    world.step(dt=1.0)
    assert world.impacts["time"].tolist() == [0.25]
    assert world.sphere(ball).velocity == (4, 0, 0)
    assert world.colliders[paddle].position == (2, 0, 0)
    # What is not given stays, and the frame time is the scene's own.
    world.set_next_pose(paddle, rotation=(0, 1, 0, 1))
    moving = world.colliders[paddle]
    assert moving.velocity == (0, 0, 0)
    # A quarter turn; rounding of the angle and the quotient.
    assert moving.angular_velocity[1] == pytest.approx(np.pi / 2 / world.frame_time, rel=1e-15)


def test_a_next_pose_that_makes_no_sense_is_refused_and_nothing_moves() -> None:
    world = carom.World()
    lift = world.add_collider(carom.Collider(carom.Box((1, 1, 1))))
    with pytest.raises(carom.CaromError, match="position"):
        world.set_next_pose(lift, position=(0, np.nan, 0))
    with pytest.raises(carom.CaromError, match="position: must be of shape"):
        world.set_next_pose(lift, position=(0, 1))
    with pytest.raises(carom.CaromError, match="dt"):
        world.set_next_pose(lift, position=(0, 1, 0), dt=0.0)
    with pytest.raises(carom.UnknownError):
        world.set_next_pose(lift + 1, position=(0, 1, 0))
    assert world.colliders[lift].velocity == (0, 0, 0)
    turning = carom.Collider(carom.Box((1, 1, 1)), motion=carom.Turn(rate=1.0))
    world.set_collider(lift, turning)
    with pytest.raises(carom.CaromError, match="motion"):
        world.set_next_pose(lift, position=(0, 1, 0))
