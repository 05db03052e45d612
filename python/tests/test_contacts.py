"""Persistent contacts, steps to the next impact and the work of a frame, as Python has them.

The engine's own tests check the forces and times; these prove that they arrive as they are.
"""

import math
from typing import Any

import numpy as np
import pytest

import carom

G = 9.81


def column(masses: list[float], rule: str = "exact") -> carom.World:
    """A world with balls of these masses [kg] and of radius 1 m, one on the other on the floor."""
    world = carom.Scene(name="column").with_changes({"simulation.rule": rule}).world()
    world.add_force(carom.Gravity((0, -G, 0)))
    world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0))
    places = [(0, 1 + 2 * i, 0) for i in range(len(masses))]
    world.add_spheres(places, 1.0, masses=masses, restitutions=0)
    return world


def ball_above_floor(rule: str = "exact") -> carom.World:
    """A world with an elastic ball whose lowest point is 1 m above the floor."""
    world = carom.Scene(name="ball").with_changes({"simulation.rule": rule}).world()
    world.add_force(carom.Gravity((0, -G, 0)))
    world.add_collider(carom.Collider(carom.HalfSpace()))
    world.add_sphere(carom.Sphere(position=(0, 2, 0), radius=1))
    return world


def test_each_contact_of_a_column_carries_the_weight_above_it() -> None:
    world = column([1, 2, 4])
    assert len(world.contacts) == 0, "no step yet"
    world.step(dt=0.5)
    contacts = world.contacts
    assert contacts.dtype == carom.CONTACT
    # Pairs of spheres first, then the floor.
    assert contacts["collider"].tolist() == [-1, -1, 0]
    assert contacts["sphere_1"].tolist() == [0, 1, -1]
    assert contacts["sphere_2"].tolist() == [1, 2, 0]
    # The solver leaves a few roundings of the forces.
    np.testing.assert_allclose(contacts["normal_force"], np.array([6, 4, 7]) * G, rtol=1e-12)
    np.testing.assert_allclose(contacts["point"][:, 1], [2, 4, 0], atol=1e-12)
    np.testing.assert_allclose(contacts["normal"], [(0, 1, 0)] * 3, atol=1e-12)
    np.testing.assert_allclose(contacts["gap"], 0, atol=1e-12)


@pytest.mark.parametrize("rule", ["discrete", "bisect"])
def test_other_rules_know_no_persistent_contact(rule: str) -> None:
    world = column([1, 2], rule)
    world.step()
    assert len(world.contacts) == 0
    assert world.contacts.dtype == carom.CONTACT


def test_a_bouncing_ball_meets_the_floor_at_odd_multiples_of_its_fall() -> None:
    world = ball_above_floor()
    fall = math.sqrt(2 / G)
    positions = world.positions
    for bounce in range(20):
        time = (2 * bounce + 1) * fall
        assert world.next_event_time(10) == pytest.approx(time, rel=1e-13)
        world.step_to_next_event(10)
        assert world.time == pytest.approx(time, rel=1e-13)
        assert world.impacts["time"].tolist() == [pytest.approx(time, rel=1e-13)]
        assert positions is world.positions
        assert positions[0, 1] == pytest.approx(1, abs=1e-12)


def test_without_an_impact_the_step_is_as_long_as_it_may_be() -> None:
    world = ball_above_floor()
    state = world.state_hash
    assert world.next_event_time(0.25) is None
    assert world.state_hash == state
    world.step_to_next_event(0.25)
    assert (world.time, len(world.impacts)) == (0.25, 0)


@pytest.mark.parametrize("rule", ["discrete", "bisect"])
def test_steps_to_the_next_impact_are_refused_under_rules_by_frames(rule: str) -> None:
    world = ball_above_floor(rule)
    state = world.state_hash
    with pytest.raises(carom.CaromError, match="exact"):
        world.step_to_next_event(1)
    with pytest.raises(carom.CaromError, match="exact"):
        world.next_event_time(1)
    assert world.state_hash == state


@pytest.mark.parametrize("within", [0, -1, math.nan, math.inf])
def test_a_time_that_makes_no_sense_is_refused(within: float) -> None:
    with pytest.raises(carom.CaromError):
        ball_above_floor().step_to_next_event(within)


def test_the_work_of_a_frame_follows_from_the_world_alone() -> None:
    world = column([1, 2, 4])
    assert not any(world.work)
    world.step(dt=0.5)
    again = column([1, 2, 4])
    again.step(dt=0.5)
    assert world.work == again.work
    assert world.work.predictions > 0
    assert world.work.solver_iterations > 0
    assert world.work._asdict()["cell_crossings"] <= world.work.events


def heap(**exact: Any) -> carom.World:
    """A block of balls that falls into a narrow box, under the rule ``exact``."""
    world = carom.World()
    world.simulation = carom.Simulation(exact=carom.Exact(**exact))
    world.add_force(carom.Gravity())
    box = carom.Container(size=(3.2, 8.0, 3.2), open=("top",))
    world.add_collider(carom.Collider(box, position=(0, 4, 0), restitution=0.3))
    for number in range(45):
        layer, place = divmod(number, 9)
        x, z = divmod(place, 3)
        position = (1.04 * (x - 1), 0.7 + 1.05 * layer, 1.04 * (z - 1))
        world.add_sphere(carom.Sphere(position=position, radius=0.5, restitution=0.3))
    return world


def test_a_heap_is_stepped_and_says_so() -> None:
    world = heap(zone_budget=2_000)
    most = 0
    for _ in range(60):
        world.step()
        most = max(most, world.zone_account.spheres)
    assert most > 20
    assert world.was_stepped
    assert world.zone_account.joined >= 0
    assert world.contact_account.largest_overlap < 0.1
    assert len(world.contacts) > 0


def test_without_zones_nothing_is_stepped() -> None:
    world = heap(zone_budget=2_000, zones="never")
    world.step(frames=10)
    assert not world.was_stepped
    assert world.zone_account == carom.ZoneAccount(0, 0.0, 0, 0, 0)
