"""Friction and rotation: what the engine does reaches Python, and what Python says reaches it."""

import math

import numpy as np
import pytest

import carom


def sliding_ball(friction: float | None = 0.3) -> carom.World:
    """A ball that begins to slide on a floor, under the rule ``contact``."""
    world = carom.World()
    world.simulation = carom.Simulation(rule="contact")
    world.add_force(carom.Gravity())
    world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0.0, friction=friction))
    world.add_sphere(carom.Sphere(position=(0, 0.1, 0), velocity=(1, 0, 0), radius=0.1))
    return world


def test_a_ball_that_slides_comes_to_roll() -> None:
    world = sliding_ball()
    world.step(frames=60)
    # A solid ball that slid at 1 m/s rolls at 5/7 of that.
    assert world.velocities[0, 0] == pytest.approx(5 / 7, rel=0.01)
    assert world.angular_velocities[0, 2] == pytest.approx(-50 / 7, rel=0.01)
    assert np.linalg.norm(world.orientations[0]) == pytest.approx(1.0)
    assert world.orientations[0, 3] != 1.0
    assert world.rotational_energy == pytest.approx(0.2 * 0.01 * (50 / 7) ** 2, rel=0.02)


def test_contacts_and_the_account_tell_of_friction() -> None:
    world = sliding_ball()
    world.step()
    [contact] = world.contacts
    assert contact["is_sliding"] == 1
    assert contact["tangential_force"][0] == pytest.approx(-0.3 * contact["normal_force"])
    account = world.contact_account
    assert isinstance(account, carom.ContactAccount)
    assert account.impulse_work < 0.0
    assert world.work.sweeps > 0


def test_quantities_are_read_and_set() -> None:
    world = carom.World()
    world.add_spheres([(0, 0, 0), (3, 0, 0)], 1.0)
    assert np.isnan(world.frictions).all()
    assert world.inertia_factors.tolist() == [0.4, 0.4]
    assert world.orientations.tolist() == [[0, 0, 0, 1]] * 2
    world.frictions = [0.5, math.nan]
    assert world.frictions[0] == 0.5
    assert math.isnan(world.frictions[1])
    assert world.sphere(1).friction is None
    world.frictions = math.nan
    assert world.sphere(0).friction is None
    world.inertia_factors = 0.5
    world.angular_velocities = (0, 1, 0)
    world.orientations = (0, 3, 0, 4)
    assert world.sphere(0).inertia_factor == 0.5
    np.testing.assert_allclose(world.orientations, [[0, 0.6, 0, 0.8]] * 2)
    assert world.angular_velocities.tolist() == [[0, 1, 0]] * 2
    before = world.state_hash
    for name, value in [
        ("frictions", -1.0),
        ("frictions", math.inf),
        ("inertia_factors", 0.0),
        ("inertia_factors", math.nan),
        ("orientations", [(0, 0, 0, 1), (0, 0, 0, 0)]),
        ("angular_velocities", math.nan),
    ]:
        with pytest.raises(carom.CaromError, match=f"^{name}: "):
            setattr(world, name, value)
    assert world.state_hash == before


def test_a_batch_has_the_same_quantities() -> None:
    batch = carom.Batch(sliding_ball().to_scene(), 2)
    assert batch.orientations.shape == (2, 1, 4)
    batch.frictions = [[0.5], [math.nan]]
    assert batch.world(0).sphere(0).friction == 0.5
    assert batch.world(1).sphere(0).friction is None
    with pytest.raises(carom.CaromError):
        batch.orientations = [[(0, 0, 0, 1)], [(0, 0, 0, 0)]]
    batch.step(frames=30)
    assert (batch.angular_velocities[:, 0, 2] < 0.0).all()


def test_descriptions_keep_friction_and_rotation() -> None:
    sphere = carom.Sphere(
        radius=0.5,
        friction=0.3,
        rolling_friction=0.01,
        spinning_friction=0.02,
        tangential_restitution=0.5,
        orientation=(0.0, 1.0, 0.0, 0.0),
        angular_velocity=(1.0, 2.0, 3.0),
        inertia_factor=0.5,
    )
    world = carom.World()
    kept = world.sphere(world.add_sphere(sphere))
    assert (kept.friction, kept.rolling_friction) == (0.3, 0.01)
    assert (kept.spinning_friction, kept.tangential_restitution) == (0.02, 0.5)
    assert (kept.orientation, kept.angular_velocity) == ((0, 1, 0, 0), (1, 2, 3))
    assert kept.inertia_factor == 0.5
    again = world.to_scene().world().sphere(0)
    assert again == kept


def test_the_parameters_of_the_rule_are_kept() -> None:
    world = carom.World()
    simulation = carom.Simulation(
        rule="contact",
        friction_combine_rule="minimum",
        contact=carom.Contact(sub_steps=3, sweeps=4, converged=True),
    )
    world.simulation = simulation
    assert world.simulation.contact == simulation.contact
    assert world.simulation.friction_combine_rule == "minimum"
    # The engine leaves out what it takes anyway: the defaults are the same.
    plain = carom.Scene(name="plain", simulation=carom.Simulation(contact=carom.Contact()))
    assert "[simulation.contact]" not in plain.to_toml()
