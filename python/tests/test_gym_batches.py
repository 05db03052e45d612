"""The plate and the billiard table: by the book, seeded, the same alone and among others."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, VectorEnv
from numpy.typing import NDArray

import carom.gym
from carom.errors import CaromError

PLATE, BILLIARDS = "carom/Plate-v0", "carom/Billiards-v0"
FRAMES: dict[str, Any] = {"frames_per_step": 20}
"""Tables whose steps are frames: a whole shot takes longer."""

KINDS: list[tuple[str, dict[str, Any]]] = [
    (PLATE, {}),
    (PLATE, {"rule": "exact", "frames_per_step": 3}),
    (BILLIARDS, {}),
    (BILLIARDS, FRAMES),
    (BILLIARDS, {"rule": "contact", **FRAMES}),
]


@pytest.mark.parametrize(("name", "given"), KINDS)
@pytest.mark.filterwarnings("error")
def test_gymnasium_finds_nothing_to_object_to(name: str, given: dict[str, Any]) -> None:
    check_env(gymnasium.make(name, **given).unwrapped, skip_render_check=True)


@pytest.mark.filterwarnings("error")
def test_stable_baselines3_finds_nothing_to_object_to() -> None:
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    for name in (PLATE, BILLIARDS):
        checker.check_env(gymnasium.make(name))


def vectors(name: str, mode: AutoresetMode, **given: Any) -> tuple[VectorEnv, VectorEnv]:
    """Ours, and single environments that Gymnasium makes a vector of."""
    ours = gymnasium.make_vec(
        name,
        num_envs=4,
        vectorization_mode="vector_entry_point",
        autoreset_mode=mode,
        **given,
    )
    theirs = gymnasium.make_vec(
        name,
        num_envs=4,
        vectorization_mode="sync",
        vector_kwargs={"autoreset_mode": mode},
        **given,
    )
    return ours, theirs


def assert_same(ours: Any, theirs: Any) -> None:
    """The same values, of the same types, to the bit."""
    assert type(ours) is type(theirs)
    if isinstance(ours, np.ndarray) and ours.dtype != object:
        assert (ours.dtype, ours.shape) == (theirs.dtype, theirs.shape)
        assert ours.tobytes() == theirs.tobytes()
    elif isinstance(ours, dict):
        assert ours.keys() == theirs.keys()
        for key in ours:
            assert_same(ours[key], theirs[key])
    elif isinstance(ours, tuple | np.ndarray):
        assert len(ours) == len(theirs)
        for one, other in zip(ours, theirs, strict=True):
            assert_same(one, other)
    else:
        assert ours == theirs


@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
@pytest.mark.parametrize(
    ("name", "given", "steps"),
    [
        (PLATE, {"max_episode_steps": 70, "start_range": 1.0}, 150),
        (BILLIARDS, {"max_episode_steps": 2, "start": "rack"}, 4),
        (BILLIARDS, {"max_episode_steps": 12, **FRAMES}, 30),
    ],
)
def test_the_vector_environment_is_what_gymnasium_makes_of_single_ones(
    name: str, given: dict[str, Any], steps: int, mode: AutoresetMode
) -> None:
    ours, theirs = vectors(name, mode, **given)
    assert_same(ours.reset(seed=7), theirs.reset(seed=7))
    assert ours.action_space == theirs.action_space
    assert ours.observation_space == theirs.observation_space
    random = np.random.default_rng(1)
    ended = np.zeros(2, int)
    for _ in range(steps):
        actions = random.uniform(-1, 1, (4, 2)).astype(np.float32)
        step = ours.step(actions)
        assert_same(step, theirs.step(actions))
        ended += [int(np.sum(step[2])), int(np.sum(step[3]))]
    assert ended[1] > 0, "none was truncated"
    assert ended[0] > 0 or name == BILLIARDS, "no ball fell"


@pytest.mark.parametrize(
    ("name", "given", "most", "steps"),
    # A thread takes 64 balls at least.
    [(PLATE, {}, 150, 12), (BILLIARDS, {}, 9, 2), (BILLIARDS, FRAMES, 20, 6)],
)
def test_the_bits_of_an_environment_do_not_depend_on_the_others(
    name: str, given: dict[str, Any], most: int, steps: int
) -> None:
    def rollout(count: int, threads: int) -> list[bytes]:
        envs = gymnasium.make_vec(
            name,
            num_envs=count,
            vectorization_mode="vector_entry_point",
            threads=threads,
            max_episode_steps=steps // 2 + 1,
            **given,
        )
        seen, _ = envs.reset(seed=3)
        random = np.random.default_rng(5)
        rows = [seen[:2].tobytes()]
        for _ in range(steps):
            actions = random.uniform(-1, 1, (most, 2)).astype(np.float32)[:count]
            step = envs.step(actions)
            rows += [array[:2].tobytes() for array in step[:4]]
        return rows

    assert rollout(2, 1) == rollout(most, 1) == rollout(most, 2) == rollout(most, 3)


@pytest.mark.parametrize("name", [PLATE, BILLIARDS])
def test_the_same_seed_starts_at_the_same_places_and_another_elsewhere(name: str) -> None:
    env = gymnasium.make(name)
    places = [env.reset(seed=4)[0], env.reset()[0], env.reset(seed=4)[0], env.reset()[0]]
    assert np.array_equal(places[:2], places[2:])
    assert not np.array_equal(places[0], places[1])
    assert not np.array_equal(places[0], env.reset(seed=5)[0])


@pytest.mark.parametrize("name", [PLATE, BILLIARDS])
def test_a_mask_resets_some_and_leaves_the_others(name: str) -> None:
    envs: Any = gymnasium.make_vec(
        name, num_envs=4, vectorization_mode="vector_entry_point", autoreset_mode="Disabled"
    )
    start, _ = envs.reset(seed=[1, 2, 3, 4])
    before, *_ = envs.step(np.full((4, 2), 0.3, np.float32))
    mask = np.array([True, False, True, False])
    after, _ = envs.reset(seed=[1, None, 3, None], options={"reset_mask": mask})
    assert np.array_equal(after[mask], start[mask])
    assert np.array_equal(after[~mask], before[~mask])


@pytest.mark.parametrize("name", [PLATE, BILLIARDS])
def test_what_a_step_returned_stays_as_it_was(name: str) -> None:
    envs = gymnasium.make_vec(name, num_envs=3, vectorization_mode="vector_entry_point")
    envs.reset(seed=0)
    action = np.full((3, 2), 0.5, np.float32)
    arrays = [array for _ in range(2) for array in envs.step(action)[:4]]
    kept = [array.copy() for array in arrays]
    envs.step(-action)
    assert all(np.array_equal(one, other) for one, other in zip(arrays, kept, strict=True))


@pytest.mark.parametrize(("name", "given"), KINDS)
def test_observations_keep_to_their_space(name: str, given: dict[str, Any]) -> None:
    envs = gymnasium.make_vec(name, num_envs=6, vectorization_mode="vector_entry_point", **given)
    envs.reset(seed=0)
    envs.action_space.seed(0)
    for _ in range(20):
        assert envs.step(envs.action_space.sample())[0] in envs.observation_space


def held(action: tuple[float, float], **given: Any) -> list[tuple[Any, ...]]:
    """Steps with one action until an episode is over."""
    env = gymnasium.make(PLATE, start_range=0.0, **given)
    env.reset(seed=0)
    steps: list[tuple[Any, ...]] = []
    while not steps or not (steps[-1][2] or steps[-1][3]):
        steps.append(env.step(np.array(action, np.float32)))
    return steps


@pytest.mark.parametrize("rule", ["contact", "exact"])
def test_the_ball_rolls_where_the_action_points_and_falls(rule: str) -> None:
    for action, place in (((1.0, 0.0), 0), ((0.0, -1.0), 1)):
        steps = held(action, rule=rule, max_episode_steps=300)
        last, reward, terminated, *_ = steps[-1]
        assert (reward, terminated) == (0.0, True)
        assert last[place] * sum(action) > 0.28 and last[2 + place] * sum(action) > 0
        # Symmetry: nothing drives it across, beyond the rounding of rotations.
        assert abs(last[1 - place]) < 1e-9


def test_a_ball_on_a_level_plate_stays_and_is_rewarded() -> None:
    steps = held((0.0, 0.0), max_episode_steps=50)
    assert len(steps) == 50 and steps[-1][2:4] == (False, True)
    # The ball sinks by some micrometres of overlap at most, and not sideways.
    assert all(reward == pytest.approx(1.0, abs=1e-12) for _, reward, *_ in steps)


def test_a_controller_balances_the_ball() -> None:
    envs = carom.gym.PlateVectorEnv(20, start_range=1.0, autoreset_mode="Disabled")
    seen, _ = envs.reset(seed=1)
    fell = np.zeros(20, np.bool_)
    for _ in range(600):
        # Slopes against place and velocity, followed as fast as the plate can.
        wanted = -1.0 * seen[:, :2] - 0.6 * seen[:, 2:4]
        seen, reward, terminated, *_ = envs.step(np.clip(20 * (wanted - seen[:, 4:]), -1, 1))
        fell |= terminated
    assert not fell.any()
    assert reward.min() > 0.99


def test_a_tilt_is_as_fast_and_steep_as_said() -> None:
    env = carom.gym.PlateEnv(max_tilt_degrees=5.0, tilt_speed_degrees_per_second=60.0)
    env.reset(seed=0)
    slopes = [env.step(np.array([1.0, -1.0], np.float32))[0][4:] for _ in range(10)]
    # 1° in a frame, up to the sine of 5°.
    np.testing.assert_allclose(slopes[1], [np.radians(2), -np.radians(2)], rtol=1e-6)
    np.testing.assert_allclose(slopes[-1], [np.sin(np.radians(5)), -np.sin(np.radians(5))])


def shot(action: tuple[float, float], **given: Any) -> tuple[Any, ...]:
    env = gymnasium.make(BILLIARDS, **given)
    env.reset(seed=0)
    return env.step(np.array(action, np.float32))


def test_a_break_scatters_the_rack_and_all_balls_come_to_rest() -> None:
    seen, reward, terminated, *_ = shot((1.0, 0.0), start="rack")
    hit = seen[64:79]
    assert reward == pytest.approx(hit.sum() - 0.1) and hit.sum() >= 12
    assert terminated == hit.all()
    assert (seen[32:64] == 0).all() and seen[79] == 1


def test_a_ball_that_hops_off_the_table_is_lost_and_ends_the_episode() -> None:
    envs = carom.gym.BilliardsVectorEnv(20, max_speed=30.0, autoreset_mode="Disabled")
    envs.reset(seed=0)
    actions = np.full((20, 2), 0.7, np.float32)
    _, rewards, terminated, *_ = envs.step(actions)
    lost = (envs.batch.positions[:, :, 1] < 0).any(axis=1)
    assert lost.any() and terminated[lost].all()
    hit = envs.step(actions)[0][:, 64:79]
    assert (rewards[lost] < hit.sum(axis=1)[lost] - 1.0).all()


def test_a_shot_in_frames_ends_where_the_whole_shot_does() -> None:
    whole = shot((0.6, 0.35))
    env = gymnasium.make(BILLIARDS, frames_per_step=15, max_episode_steps=1000)
    env.reset(seed=0)
    seen, first, *_ = env.step(np.array([0.6, 0.35], np.float32))
    total = float(first)
    while seen[79] == 0:
        # A stroke counts only when all balls rest.
        seen, reward, *_ = env.step(np.array([-1.0, 0.0], np.float32))
        total += float(reward)
    assert np.array_equal(seen, whole[0])
    assert total == pytest.approx(whole[1])


def test_a_stroke_of_no_speed_moves_nothing() -> None:
    seen, reward, *_ = shot((0.0, 0.0))
    assert reward == pytest.approx(-0.1) and seen[64:79].sum() == 0 and seen[79] == 1


def test_a_faster_stroke_than_the_fastest_is_shortened() -> None:
    def speed(action: tuple[float, float]) -> float:
        seen, *_ = shot(action, frames_per_step=1)
        return float(np.hypot(*seen[32:34]))

    # A diagonal action of length sqrt(2), and one of length 1; a frame takes both as much of it.
    assert speed((1.0, 1.0)) == pytest.approx(speed((0.70710678, 0.70710678)), rel=1e-6)


def test_balls_start_apart_and_within_the_cushions() -> None:
    envs = carom.gym.BilliardsVectorEnv(300)
    seen, _ = envs.reset(seed=0)
    places: NDArray[np.float64] = seen[:, :32].reshape(300, 16, 2).astype(float)
    gaps = np.linalg.norm(places[:, :, None] - places[:, None], axis=3)
    gaps += np.eye(16)
    assert gaps.min() > 2 * 0.028575
    assert (np.abs(places) <= np.array([1.27, 0.635]) - 0.028575).all()


@pytest.mark.parametrize(
    ("name", "given", "words"),
    [
        (PLATE, {"rule": "bisect"}, "rule"),
        (PLATE, {"size": 0.0}, "size"),
        (PLATE, {"friction": -0.1}, "friction"),
        (PLATE, {"max_tilt_degrees": 60.0}, "max_tilt_degrees"),
        (PLATE, {"tilt_speed_degrees_per_second": float("nan")}, "tilt_speed"),
        (PLATE, {"start_range": 2.0}, "start_range"),
        (PLATE, {"frames_per_step": 0}, "frames_per_step"),
        (PLATE, {"render_mode": "human"}, "render_mode"),
        (PLATE, {"num_envs": 0}, "n: must be at least 1"),
        (PLATE, {"max_episode_steps": 0}, "max_episode_steps"),
        (BILLIARDS, {"rule": "discrete"}, "rule"),
        (BILLIARDS, {"start": "anywhere"}, "start"),
        (BILLIARDS, {"max_speed": -1.0}, "max_speed"),
        (BILLIARDS, {"frames_per_step": -1}, "frames_per_step"),
        (BILLIARDS, {"threads": 0}, "threads"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(
    name: str, given: dict[str, Any], words: str
) -> None:
    kinds = {PLATE: carom.gym.PlateVectorEnv, BILLIARDS: carom.gym.BilliardsVectorEnv}
    with pytest.raises(CaromError, match=words):
        kinds[name](**given)


def test_an_argument_of_the_wrong_kind_or_unknown_is_named() -> None:
    with pytest.raises(TypeError, match="size"):
        carom.gym.PlateEnv(size="large")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="wind"):
        carom.gym.PlateEnv(wind=1.0)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="pockets"):
        carom.gym.BilliardsEnv(pockets=6)  # type: ignore[call-arg]


@pytest.mark.parametrize("name", [PLATE, BILLIARDS])
@pytest.mark.parametrize(
    "actions", [np.zeros((2, 2)), np.zeros((3, 3)), np.full((3, 2), np.nan), [["a", "b"]] * 3]
)
def test_actions_that_make_no_sense_are_refused_and_nothing_moves(name: str, actions: Any) -> None:
    both = [
        gymnasium.make_vec(name, num_envs=3, vectorization_mode="vector_entry_point")
        for _ in range(2)
    ]
    for each in both:
        each.reset(seed=0)
    with pytest.raises(CaromError, match="actions"):
        both[0].step(actions)
    right = np.full((3, 2), 0.2, np.float32)
    assert_same(both[0].step(right), both[1].step(right))


def test_pictures_show_what_changes() -> None:
    if not hasattr(carom._carom, "Painter"):
        pytest.skip("a build without pictures")
    env = gymnasium.make(PLATE, render_mode="rgb_array")
    env.reset(seed=0)
    before: Any = env.render()
    for _ in range(20):
        env.step(np.ones(2, np.float32))
    after: Any = env.render()
    assert before.shape == (480, 640, 3) and before.dtype == np.uint8
    assert not np.array_equal(before, after)


@pytest.mark.parametrize("name", [PLATE, BILLIARDS])
@pytest.mark.filterwarnings("error")
def test_pictures_are_announced_before_an_environment_is_made(name: str) -> None:
    env = gymnasium.make(name, render_mode="rgb_array")
    assert env.metadata["render_modes"] == ["rgb_array"]
    assert env.metadata["render_fps"] > 0
