"""Actions on a batch are, to the bit, the same actions on its worlds one by one."""

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
import pytest

import carom

N = 5
Rule = Literal["exact", "contact"]
RULES: list[Rule] = ["exact", "contact"]


def plate(rule: Rule = "exact") -> carom.Scene:
    """Two balls on a plate."""
    return carom.Scene(
        name="plate",
        simulation=carom.Simulation(rule=rule, frame_time=0.02),
        forces=[carom.Gravity((0, -9.81, 0))],
        colliders=[
            carom.Collider(carom.Rectangle(4, 4), restitution=0.5, friction=0.3),
            carom.Collider(carom.Box((1, 1, 1)), position=(0, -5, 0)),
        ],
        spheres=[
            carom.Sphere(position=(0.1, 0.3, 0), radius=0.1, mass=2.0),
            carom.Sphere(position=(-0.4, 0.1, 0.2), radius=0.1),
        ],
    )


def hashes(worlds: list[carom.World]) -> list[int]:
    return [int(world.state_hash, 16) for world in worlds]


def alone(batch: carom.Batch) -> list[carom.World]:
    return [batch.world(number) for number in range(len(batch))]


def assert_goes_on_as(batch: carom.Batch, worlds: list[carom.World]) -> None:
    """The batch and the worlds have the same states now, and after ten frames."""
    assert batch.state_hashes.tolist() == hashes(worlds)
    batch.step(frames=10)
    for world in worlds:
        world.step(frames=10)
    assert batch.state_hashes.tolist() == hashes(worlds)


COLUMNS: dict[str, np.ndarray] = {
    "position": np.linspace(-0.1, 0.0, 3 * N).reshape(N, 3),
    "rotation": np.array([(0.01 * k, 0, 0, 1) for k in range(N)], float),
    "velocity": np.linspace(-0.2, 0.2, 3 * N).reshape(N, 3),
    "angular_velocity": np.linspace(0.1, -0.1, 3 * N).reshape(N, 3),
    "restitution": np.linspace(0, 1, N),
    "friction": np.linspace(0, 1, N),
    "rolling_friction": np.linspace(0, 0.1, N),
    "spinning_friction": np.linspace(0, 0.1, N),
    "tangential_restitution": np.linspace(0, 1, N),
}


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("name", COLUMNS)
def test_a_collider_changes_in_each_world_by_its_own_row(rule: Rule, name: str) -> None:
    batch = carom.Batch(plate(rule), N)
    batch.step(frames=3)
    worlds = alone(batch)
    batch.set_collider(0, **{name: COLUMNS[name]})  # type: ignore[arg-type]
    for world, value in zip(worlds, COLUMNS[name].tolist(), strict=True):
        changed = carom.Scene(name="one", colliders=[world.colliders[0]])
        changed = changed.with_changes({f"colliders.0.{name}": value})
        world.set_collider(0, changed.colliders[0])
    # The same bodies, as descriptions too.
    for number, world in enumerate(worlds):
        assert batch.world(number).colliders == world.colliders
    assert_goes_on_as(batch, worlds)


@pytest.mark.parametrize("rule", RULES)
def test_a_motion_moves_the_collider_of_the_marked_worlds_only(rule: Rule) -> None:
    batch = carom.Batch(plate(rule), N)
    worlds = alone(batch)
    swing = carom.Swing(amplitude_degrees=5.0, frequency=1.0)
    mask = np.arange(N) % 2 == 0
    batch.set_collider(0, motion=swing, worlds=mask)
    for world in np.array(worlds)[mask]:
        moving = carom.Collider(carom.Rectangle(4, 4), restitution=0.5, friction=0.3, motion=swing)
        world.set_collider(0, moving)
    assert_goes_on_as(batch, worlds)
    assert batch.world(0).colliders[0].motion == worlds[0].colliders[0].motion
    batch.set_collider(0, motion=(), worlds=[0])
    assert not batch.world(0).colliders[0].motion
    assert batch.world(2).colliders[0].motion


def test_a_scene_of_a_world_whose_collider_was_set_goes_on_the_same_way() -> None:
    batch = carom.Batch(plate(), N)
    batch.set_collider(0, velocity=(0, 0.1, 0), restitution=np.linspace(0, 1, N))
    again = [batch.world(number).to_scene().world() for number in range(N)]
    batch.step(frames=30)
    for world in again:
        world.step(frames=30)
    assert batch.state_hashes.tolist() == hashes(again)


def test_a_collider_reaches_its_next_pose_in_one_step() -> None:
    batch = carom.Batch(plate(), N)
    angles = np.linspace(-0.5, 0.5, N)
    zeros = np.zeros(N)
    rotations = np.stack([np.sin(angles / 2), zeros, zeros, np.cos(angles / 2)], axis=1)
    positions = np.stack([zeros, angles, zeros], axis=1)
    batch.set_next_pose(0, position=positions, rotation=rotations)
    batch.step()
    places, turned = batch.collider_poses(0)
    # Rounding of a product and a quotient, and of a rotation vector.
    np.testing.assert_allclose(places, positions, rtol=0, atol=4e-16)
    np.testing.assert_allclose(turned, rotations, rtol=0, atol=1e-15)
    with pytest.raises(carom.CaromError, match=r"world 0.*motion"):
        batch.set_collider(0, velocity=0, angular_velocity=0, motion=carom.Turn(rate=1.0))
        batch.set_next_pose(0, position=positions)


def test_a_ball_on_a_tilted_plate_rolls_five_sevenths_as_fast_as_it_would_slide() -> None:
    batch = carom.Batch(plate("contact"), 2)
    slopes = np.array([0.05, 0.1])
    half = np.arcsin(slopes) / 2
    zeros = np.zeros(2)
    batch.set_collider(0, rotation=np.stack([zeros, zeros, -np.sin(half), np.cos(half)], axis=1))
    normal = np.stack([slopes, np.sqrt(1 - slopes**2), zeros], axis=1)
    batch.set_position(0, 0.1 * normal)
    batch.step(frames=25)
    speeds = np.linalg.norm(batch.velocities[:, 0], axis=1)
    # 0.5 s; sub-steps of `contact` press the ball on by about 1e-3 of the fall in one.
    np.testing.assert_allclose(speeds, 5 / 7 * 9.81 * slopes * 0.5, rtol=2e-3)


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("name", ["set_velocity", "set_angular_velocity", "apply_impulse"])
def test_a_stroke_moves_a_ball_of_each_world_by_its_own_row(rule: Rule, name: str) -> None:
    batch = carom.Batch(plate(rule), N)
    batch.step(frames=5)
    worlds = alone(batch)
    rows = np.linspace(-1, 1, 3 * (N - 1)).reshape(N - 1, 3)
    getattr(batch, name)(1, rows, worlds=[4, 2, 1, 0])
    for number, row in zip([4, 2, 1, 0], rows, strict=True):
        getattr(worlds[number], name)(1, row)
    assert_goes_on_as(batch, worlds)


def test_a_position_of_a_ball_is_set_and_its_velocity_stays() -> None:
    batch = carom.Batch(plate(), N)
    batch.step(frames=5)
    before = batch.velocities.copy()
    places = np.linspace(1, 2, 3 * N).reshape(N, 3)
    batch.set_position(0, places)
    np.testing.assert_array_equal(batch.positions[:, 0], places)
    np.testing.assert_array_equal(batch.velocities, before)


def test_worlds_that_are_not_named_do_not_step() -> None:
    batch = carom.Batch(plate(), N)
    twin = carom.Batch(plate(), N)
    batch.step(frames=4, worlds=[1, 3])
    mask = np.isin(np.arange(N), [1, 3])
    twin.step(frames=4)
    assert batch.times.tolist() == [0.0, 0.08, 0.0, 0.08, 0.0]
    np.testing.assert_array_equal(batch.state_hashes[mask], twin.state_hashes[mask])
    batch.step(frames=4, worlds=~mask)
    np.testing.assert_array_equal(batch.state_hashes, twin.state_hashes)


@pytest.mark.parametrize("rule", RULES)
def test_energies_contacts_and_impacts_are_those_of_the_worlds(rule: Rule) -> None:
    batch = carom.Batch(plate(rule), N)
    batch.set_velocity(0, [(0.1 * k, 0, 0) for k in range(N)])
    worlds = alone(batch)
    seen = np.zeros(N, int)
    for _ in range(4):
        batch.step(frames=15)
        counts = np.zeros(N, int)
        for number, world in enumerate(worlds):
            for _ in range(15):
                world.step()
                counts[number] += len(world.impacts)
        assert batch.impact_counts.tolist() == counts.tolist()
        seen += counts
        for name in ("kinetic", "potential", "total"):
            expected = [getattr(world, f"{name}_energy") for world in worlds]
            assert getattr(batch, f"{name}_energies").tolist() == expected
        assert batch.contact_counts.tolist() == [len(world.contacts) for world in worlds]
    assert seen.min() > 0 and batch.contact_counts.max() > 0
    batch.reset()
    assert batch.impact_counts.tolist() == [0] * N


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_observations_are_written_in_place(dtype: Any) -> None:
    batch = carom.Batch(plate(), N)
    out = np.full((N, 20), np.nan, dtype)
    for _ in range(3):
        batch.step()
        assert batch.observe("positions", "velocities", "orientations", out=out) is out
        wanted = [batch.positions, batch.velocities, batch.orientations]
        rows = np.concatenate([array.reshape(N, -1) for array in wanted], axis=1)
        np.testing.assert_array_equal(out, rows.astype(dtype))
    assert batch.observe().dtype == np.float32 and batch.observe().shape == (N, 12)


def test_a_run_records_the_states_and_impacts_of_its_steps() -> None:
    batch, twin = carom.Batch(plate(), N), carom.Batch(plate(), N)
    run = batch.run(31, every=10)
    states, met = [twin.positions.copy()], []
    for frame in range(31):
        twin.step()
        met.append(twin.impacts)
        if frame % 10 == 9:
            states.append(twin.positions.copy())
    np.testing.assert_array_equal(run.states["positions"], states)
    assert run.states["velocities"].shape == (4, N, 2, 3) and run.times.shape == (4, N)
    assert run.impacts is not None
    np.testing.assert_array_equal(run.impacts, np.concatenate(met))
    assert len(run.impacts) > 0
    np.testing.assert_array_equal(batch.state_hashes, twin.state_hashes)


def test_a_run_without_impacts_has_the_same_states_and_no_records() -> None:
    batch, twin = carom.Batch(plate(), N), carom.Batch(plate(), N)
    quantities = ["positions", "angular_velocities", "radii"]
    run = batch.run(40, every=8, quantities=quantities, impacts=False)
    other = twin.run(40, every=8, quantities=quantities)
    assert run.impacts is None and list(run.states) == quantities
    assert run.states["radii"].shape == (6, N, 2, 1)
    for name in quantities:
        np.testing.assert_array_equal(run.states[name], other.states[name])
    np.testing.assert_array_equal(batch.state_hashes, twin.state_hashes)


def test_a_run_leaves_places_for_spheres_that_come() -> None:
    batch = carom.Batch("simtest1", 2, changes={"emitters.0.period": [2.0, 5.0]})
    run = batch.run(200, every=50, impacts=False)
    assert run.states["positions"].shape[2] == batch.counts.max()
    assert np.isnan(run.states["positions"][0]).any()


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("rule", RULES)
def test_a_step_to_a_pose_is_what_its_three_parts_are(rule: Rule, threads: int) -> None:
    one, three = (carom.Batch(plate(rule), 150, threads=threads) for _ in range(2))
    seen, other = np.zeros((150, 14), np.float32), np.zeros((150, 14), np.float32)
    quantities = ("positions", "orientations")
    random = np.random.default_rng(1)
    for _ in range(10):
        rotations = random.uniform(-0.01, 0.01, (150, 4)) + np.array([0, 0, 0, 1])
        places = random.uniform(-0.01, 0.01, (150, 3))
        one.step_to_pose(0, position=places, rotation=rotations, out=seen, quantities=quantities)
        three.set_next_pose(0, position=places, rotation=rotations)
        three.step()
        three.observe(*quantities, out=other)
        np.testing.assert_array_equal(seen, other)
    np.testing.assert_array_equal(one.state_hashes, three.state_hashes)
    mask = np.arange(150) % 3 == 0
    one.step_to_pose(0, position=(0, 1, 0), worlds=mask)
    three.set_next_pose(0, position=(0, 1, 0), worlds=mask)
    three.step(worlds=mask, out=other, quantities=quantities)
    np.testing.assert_array_equal(one.state_hashes, three.state_hashes)
    np.testing.assert_array_equal(one.observe(*quantities), other)


def test_a_step_observes_spheres_that_come_only_where_there_are_places() -> None:
    batch = carom.Batch("simtest1", 2)
    with pytest.raises(carom.CaromError, match=r"out: must be of shape \(2, 0\)"):
        batch.step(out=np.zeros((2, 6)))
    batch.step(frames=100)
    out = batch.observe()
    batch.step(frames=400, out=out)
    assert batch.counts.max() * 6 > out.shape[1]
    count = out.shape[1] // 6
    np.testing.assert_array_equal(out[0, :3], batch.positions[0, 0].astype(np.float32))
    assert (
        out[0, 3 * count : 3 * count + 3].tolist()
        == batch.velocities[0, 0].astype(np.float32).tolist()
    )


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_actions_have_the_same_bits_on_any_number_of_threads(threads: int) -> None:
    def end(threads: int) -> list[int]:
        batch = carom.Batch(plate("contact"), 200, threads=threads)
        random = np.random.default_rng(1)
        for _ in range(20):
            batch.set_collider(0, angular_velocity=random.uniform(-0.3, 0.3, (200, 3)))
            batch.apply_impulse(0, random.uniform(-0.1, 0.1, (200, 3)))
            batch.step()
        return [int(number) for number in batch.state_hashes]

    assert end(threads) == end(1)


REFUSED: list[tuple[Callable[[carom.Batch], object], str]] = [
    (lambda it: it.set_collider(7, restitution=0.5), "no collider 7"),
    (lambda it: it.set_collider(0, restitution=[0, 0, 0, 0, 2]), r"world 4: .*restitution"),
    (lambda it: it.set_collider(0, friction=[0, 0, 0, -1, 0]), "world 3: .*friction"),
    (lambda it: it.set_collider(0, position=np.nan), "world 0: .*position"),
    (lambda it: it.set_collider(0, rotation=np.zeros((N, 4))), "world 0: .*rotation"),
    (lambda it: it.set_collider(0, position=np.zeros((2, 3))), r"position: .*\(5, 3\)"),
    (lambda it: it.set_collider(0, position=0, worlds=[5]), "worlds: must be below 5, not 5"),
    (lambda it: it.set_next_pose(0, position=0, dt=0.0), "world 0: .*dt"),
    (lambda it: it.step_to_pose(7, position=0), "no collider 7"),
    (lambda it: it.step_to_pose(0, position=np.nan), "position.* must be finite"),
    (lambda it: it.set_velocity(9, 0), "no sphere 9"),
    (lambda it: it.set_velocity(0, [(0, 0, 0)] * 4 + [(0, np.inf, 0)]), "world 4: velocity"),
    (lambda it: it.observe("positions", out=np.zeros((2, 6))), r"out: .*\(5, 6\)"),
    (lambda it: it.observe("places"), "quantities: must be of positions"),
    (lambda it: it.observe(out=np.zeros((N, 24))[:, ::2]), "out: must be writable"),
    (lambda it: it.step(worlds=[True]), "worlds: must be 5 truth values"),
    (lambda it: it.step(worlds=[-1]), "worlds: must be below 5, not -1"),
    (lambda it: it.run(3, every=5), "every: must be at most 3"),
]


@pytest.mark.parametrize(("action", "words"), REFUSED)
def test_an_action_that_one_world_refuses_changes_none(
    action: Callable[[carom.Batch], object], words: str
) -> None:
    batch, twin = carom.Batch(plate(), N), carom.Batch(plate(), N)
    batch.step(frames=3)
    twin.step(frames=3)
    with pytest.raises(carom.CaromError, match=words):
        action(batch)
    batch.step(frames=20)
    twin.step(frames=20)
    np.testing.assert_array_equal(batch.state_hashes, twin.state_hashes)


def test_an_impulse_that_would_overflow_is_refused_in_all_worlds() -> None:
    batch = carom.Batch(plate(), N)
    batch.set_velocity(0, (1e308, 0, 0), worlds=[3])
    before = batch.state_hashes
    # The mass is 2 kg.
    with pytest.raises(carom.CaromError, match="world 3: impulse: must be finite"):
        batch.apply_impulse(0, (1.7e308, 0, 0))
    np.testing.assert_array_equal(batch.state_hashes, before)


def test_arguments_of_the_wrong_kind_are_named() -> None:
    batch = carom.Batch(plate(), N)
    with pytest.raises(TypeError, match="worlds: must be whole numbers"):
        batch.step(worlds=[0.5])
    with pytest.raises(TypeError, match="position: must be an array of numbers"):
        batch.set_collider(0, position="here")
    with pytest.raises(TypeError, match="out: must be an array of float32 or float64"):
        batch.observe(out=np.zeros((N, 12), np.int64))  # type: ignore[arg-type]
