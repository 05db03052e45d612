"""Triggers report every passage, in a step, in a run and in a batch."""

from pathlib import Path

import numpy as np
import pytest

import carom

PASSES = 1000
SPEEDS = np.geomspace(1, 1000, PASSES)
THICKNESS, RADIUS, START = 0.01, 0.002, -2.0


def gate(rule: carom.Simulation) -> carom.World:
    """Balls of 4 mm that fly through a sheet of 1 cm, and through each other."""
    row, column = np.divmod(np.arange(PASSES), 40)
    places = np.stack([np.full(PASSES, START), row / 4, column / 4], axis=1)
    velocities = np.zeros((PASSES, 3))
    velocities[:, 0] = SPEEDS
    sheet = carom.Collider(carom.Box((THICKNESS, 50, 50)), trigger=True)
    world = carom.Scene(name="gate", simulation=rule, colliders=[sheet]).world()
    world.add_spheres(places, RADIUS, velocities=velocities, groups=0b10, collides_with=0b01)
    return world


def test_a_sensor_of_a_centimetre_sees_a_thousand_passes_at_their_times() -> None:
    world = gate(carom.Simulation())
    run = world.run(frames=240, dt=1 / 60)
    events = run.sensor_events
    assert events.dtype == carom.SENSOR_EVENT
    assert (np.diff(events["time"]) >= 0).all()
    for enters, distance in [(1, -THICKNESS / 2 - RADIUS), (0, THICKNESS / 2 + RADIUS)]:
        seen = np.sort(events[events["enters"] == enters], order="sphere")
        assert seen["sphere"].tolist() == world.ids.tolist()
        # Rounding of a position of 2 m and of a clock that goes to 4 s.
        np.testing.assert_allclose(seen["time"], (distance - START) / SPEEDS, atol=2e-15)
        np.testing.assert_allclose(seen["speed"], SPEEDS, rtol=1e-15)


@pytest.mark.parametrize("rule", ["exact", "contact", "bisect", "discrete"])
def test_no_rule_misses_a_pass(rule: str) -> None:
    world = gate(carom.Simulation(rule=rule))  # type: ignore[arg-type]
    events = world.run(frames=30, dt=0.1, quantities=["positions"]).sensor_events
    for enters in (0, 1):
        assert np.sort(events["sphere"][events["enters"] == enters]).tolist() == [*range(PASSES)]


def falling() -> carom.Scene:
    """A ball that falls through two triggers."""
    sheets = [
        carom.Collider(carom.Box((1, 0.01, 1)), position=(0, height, 0), trigger=True)
        for height in (3.0, 1.0)
    ]
    ball = carom.Sphere(position=(0, 4, 0), radius=0.125)
    return carom.Scene(
        name="falling", spheres=[ball], colliders=sheets, forces=[carom.Gravity((0, -8, 0))]
    )


def test_a_run_records_what_its_frames_report(tmp_path: Path) -> None:
    world, run = falling().world(), falling().world().run(frames=60, dt=1 / 60)
    frames = []
    for _ in range(60):
        world.step(dt=1 / 60)
        frames.append(world.sensor_events)
    assert run.sensor_events.tobytes() == np.concatenate(frames).tobytes()
    assert run.sensor_events["collider"].tolist() == [0, 0, 1, 1]
    assert run.sensor_events["enters"].tolist() == [1, 0, 1, 0]

    run.save(tmp_path / "run.npz")
    again = carom.Trajectory.load(tmp_path / "run.npz")
    assert again.sensor_events.tobytes() == run.sensor_events.tobytes()
    table = pytest.importorskip("pandas") and run.sensor_events_to_pandas()
    assert table["point_y"].tolist() == run.sensor_events["point"][:, 1].tolist()

    positions = np.empty((61, 1, 3))
    into = falling().world().run(frames=60, dt=1 / 60, out={"positions": positions})
    assert into.sensor_events.tobytes() == run.sensor_events.tobytes()
    function = falling().world()
    function.add_force(lambda world: np.zeros(3))
    among = function.run(frames=60, dt=1 / 60)
    assert among.sensor_events["enters"].tolist() == [1, 0, 1, 0]


def test_a_run_without_sensor_events_says_so() -> None:
    for options in ({}, {"out": {"positions": np.empty((6, 1, 3))}}):
        run = falling().world().run(frames=5, sensor_events=False, **options)  # type: ignore[arg-type]
        with pytest.raises(AttributeError, match="sensor_events were not recorded"):
            run.sensor_events  # noqa: B018
    with pytest.raises(TypeError, match="sensor_events: must be True or False"):
        falling().world().run(frames=5, sensor_events=1)  # type: ignore[arg-type]


def test_a_batch_tells_of_which_world_an_event_is() -> None:
    batch = carom.Batch(falling(), 2, changes={"forces.0.gravity.acceleration.1": [-8.0, 0.0]})
    batch.step(dt=1.0)
    events = batch.sensor_events
    assert events["world"].tolist() == [0, 0, 0, 0]
    assert events["enters"].tolist() == [1, 0, 1, 0]
