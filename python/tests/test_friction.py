"""Friction and rotation: what the engine does reaches Python, and what Python says reaches it."""

import math
from typing import Any, Literal

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


def test_a_ball_on_a_belt_comes_to_roll_at_two_sevenths_of_its_speed() -> None:
    world = carom.World()
    world.add_force(carom.Gravity())
    belt = carom.Collider(carom.HalfSpace(), friction=0.3, surface_velocity=(0.7, 0, 0))
    world.add_collider(belt)
    world.add_sphere(carom.Sphere(position=(0, 0.1, 0), radius=0.1, restitution=0.0))
    world.step(frames=60)
    assert world.velocities[0, 0] == pytest.approx(0.2, rel=1e-12)
    assert world.to_scene().colliders[0].surface_velocity == (0.7, 0, 0)


@pytest.mark.parametrize("rule", ["exact", "contact"])
def test_an_impact_tells_its_impulse_of_friction(rule: Literal["exact", "contact"]) -> None:
    world = carom.World()
    world.simulation = carom.Simulation(rule=rule, frame_time=0.5)
    world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0.5, friction=0.25))
    ball = carom.Sphere(position=(0, 0.8, 0), velocity=(4, -2, 0), radius=0.1, mass=2)
    world.add_sphere(ball)
    world.step()
    [impact] = world.impacts
    # It slides all the time: friction takes 0.25 of m (1 + e) v.
    assert impact["impulse"] == pytest.approx(6.0, rel=1e-12)
    np.testing.assert_allclose(impact["tangential_impulse"], (-1.5, 0, 0), rtol=0, atol=1e-12)
    np.testing.assert_allclose(world.velocities[0], (3.25, 1, 0), rtol=0, atol=1e-12)


def test_contacts_and_the_account_tell_of_friction() -> None:
    world = sliding_ball()
    world.step()
    [contact] = world.contacts
    assert contact["is_sliding"] == 1
    assert contact["tangential_force"][0] == pytest.approx(-0.3 * contact["normal_force"])
    account = world.contact_account
    assert isinstance(account, carom.ContactAccount)
    assert account.asleep == 0
    assert isinstance(world.energy_account, carom.EnergyAccount)
    assert world.energy_account.contacts < 0.0
    assert world.work.sweeps > 0


def test_the_account_counts_the_spheres_asleep() -> None:
    world = sliding_ball()
    world.velocities = 0.0
    # Half a second of rest, and some frames to come to it.
    world.step(frames=60)
    assert world.contact_account.asleep == 1


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
    world.rolling_frictions = [0.01, math.nan]
    world.spinning_frictions = [math.nan, 0.02]
    world.tangential_restitutions = 0.5
    assert world.sphere(0).rolling_friction == 0.01
    assert world.sphere(1).rolling_friction is None
    assert world.sphere(1).spinning_friction == 0.02
    assert world.tangential_restitutions.tolist() == [0.5, 0.5]
    assert np.isnan(world.frictions).all()
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
        ("rolling_frictions", -1.0),
        ("spinning_frictions", math.inf),
        ("tangential_restitutions", 1.5),
        ("inertia_factors", 0.0),
        ("inertia_factors", math.nan),
        ("orientations", [(0, 0, 0, 1), (0, 0, 0, 0)]),
        ("angular_velocities", math.nan),
    ]:
        with pytest.raises(carom.CaromError, match=f"^{name}: "):
            setattr(world, name, value)
    assert world.state_hash == before


def test_spheres_added_by_arrays_are_those_added_one_by_one() -> None:
    arrays, single = carom.World(), carom.World()
    arrays.add_spheres(
        [(0, 0, 0), (3, 0, 0)],
        [1.0, 0.5],
        velocities=(1, 2, 3),
        orientations=[(0, 3, 0, 4), (0, 0, 0, 1)],
        angular_velocities=(0, 1, 2),
        inertia_factors=[0.4, 0.5],
        frictions=[0.3, math.nan],
        rolling_frictions=0.01,
        spinning_frictions=[math.nan, 0.02],
        tangential_restitutions=[0.5, 1.0],
    )
    both: dict[str, Any] = {
        "velocity": (1, 2, 3),
        "angular_velocity": (0, 1, 2),
        "rolling_friction": 0.01,
    }
    first = carom.Sphere(
        radius=1.0,
        orientation=(0, 3, 0, 4),
        friction=0.3,
        tangential_restitution=0.5,
        **both,
    )
    second = carom.Sphere(
        position=(3, 0, 0),
        radius=0.5,
        inertia_factor=0.5,
        spinning_friction=0.02,
        tangential_restitution=1.0,
        **both,
    )
    for sphere in (first, second):
        single.add_sphere(sphere)
    assert arrays.state_hash == single.state_hash
    # The hash does not cover friction.
    assert [arrays.sphere(i) for i in (0, 1)] == [single.sphere(i) for i in (0, 1)]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"frictions": -0.1}, "`friction` must be zero or positive"),
        ({"rolling_frictions": math.inf}, r"rolling_frictions\[0\]: must be finite"),
        ({"tangential_restitutions": 2}, "`tangential_restitution` must be"),
        ({"orientations": (0, 0, 0, 0)}, "`orientation` must"),
        ({"orientations": (0, 0, 1)}, r"orientations: must be of shape \(2, 4\), not \(3,\)"),
        ({"angular_velocities": math.nan}, r"angular_velocities\[0\]: must be finite"),
        ({"inertia_factors": 0}, "`inertia_factor` must be positive"),
    ],
)
def test_spheres_with_wrong_friction_or_rotation_are_refused(given: Any, words: str) -> None:
    world = carom.World()
    with pytest.raises(carom.CaromError, match=words):
        world.add_spheres([(0, 0, 0), (3, 0, 0)], 1.0, **given)
    assert len(world) == 0


def test_a_trajectory_records_rotation_where_there_is_spin() -> None:
    world, other = sliding_ball(), sliding_ball()
    run = world.run(frames=60, every=20)
    assert run.orientations is not None
    assert run.angular_velocities is not None
    assert run.orientations.shape == (4, 1, 4)
    assert run.orientations[0, 0].tolist() == [0, 0, 0, 1]
    for row in range(1, 4):
        other.step(frames=20)
        assert np.array_equal(run.orientations[row], other.orientations)
        assert np.array_equal(run.angular_velocities[row], other.angular_velocities)
    without = sliding_ball(friction=None).run(frames=2)
    assert without.orientations is None
    assert without.angular_velocities is None


def test_rotation_is_nan_where_a_sphere_is_not_there() -> None:
    changes = {"emitters.0.sphere.angular_velocity": [0, 3, 0]}
    run = carom.load("simtest1", changes).run(seconds=3)
    assert run.orientations is not None
    assert run.angular_velocities is not None
    is_missing = np.isnan(run.positions)
    assert is_missing.any()
    assert np.array_equal(np.isnan(run.angular_velocities), is_missing)
    assert np.array_equal(np.isnan(run.orientations[:, :, :3]), is_missing)
    assert (run.angular_velocities[~is_missing[:, :, 0]] == (0, 3, 0)).all()


def test_tables_have_rotation_where_there_is_spin() -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    run = sliding_ball().run(frames=3)
    assert run.orientations is not None
    table = run.to_pandas()
    assert list(table.columns[-7:]) == ["qx", "qy", "qz", "qw", "wx", "wy", "wz"]
    assert np.array_equal(table[["qx", "qy", "qz", "qw"]], run.orientations[:, 0])
    data = run.to_xarray()
    assert data["orientation"].dims == ("time", "sphere", "part")
    assert np.array_equal(data["orientation"].sel(part="w"), run.orientations[:, :, 3])
    assert data["angular_velocity"].attrs["units"] == "rad/s"
    plain = sliding_ball(friction=None).run(frames=3)
    assert list(plain.to_pandas().columns[-3:]) == ["vx", "vy", "vz"]
    assert "orientation" not in plain.to_xarray()


def test_a_batch_has_the_same_quantities() -> None:
    batch = carom.Batch(sliding_ball().to_scene(), 2)
    assert batch.orientations.shape == (2, 1, 4)
    batch.frictions = [[0.5], [math.nan]]
    assert batch.world(0).sphere(0).friction == 0.5
    assert batch.world(1).sphere(0).friction is None
    batch.spinning_frictions = [[math.nan], [0.1]]
    assert batch.world(0).sphere(0).spinning_friction is None
    assert batch.spinning_frictions[1].tolist() == [0.1]
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
