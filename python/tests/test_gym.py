"""Environments of Gymnasium: by the book, seeded, the same alone and among others."""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, VectorEnv
from interrupts import turns_of_another_thread
from numpy.typing import NDArray

import carom.gym
from carom.errors import CaromError, SceneError

MAZE = "carom/Maze-v0"
CORRIDOR = "\n".join(["#######", "#S o  E", "#######"])
"""The end wall to the right of the start, a collectible on the way."""
OPEN = "\n".join(["   ", " S ", "E  "])
"""No walls but the end wall: the ball can fall out."""

RIGHT = np.array([1.0, 0.0], np.float32)
LEFT = np.array([-1.0, 0.0], np.float32)


def played(env: gymnasium.Env[Any, Any], action: NDArray[np.float32]) -> list[tuple[Any, ...]]:
    """Steps with one action until an episode is over."""
    env.reset(seed=0)
    steps: list[tuple[Any, ...]] = []
    while not steps or not (steps[-1][2] or steps[-1][3]):
        steps.append(env.step(action))
    return steps


@pytest.mark.parametrize("rule", ["exact", "discrete"])
@pytest.mark.parametrize("maze", ["course", "spiral", "random"])
@pytest.mark.filterwarnings("error")
def test_gymnasium_finds_nothing_to_object_to(rule: str, maze: str) -> None:
    env = gymnasium.make(MAZE, rule=rule, maze=maze, start="random").unwrapped
    check_env(env, skip_render_check=True)


@pytest.mark.filterwarnings("error")
def test_stable_baselines3_finds_nothing_to_object_to() -> None:
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    checker.check_env(gymnasium.make(MAZE).unwrapped)
    checker.check_env(gymnasium.make(MAZE, start="random"))


def vectors(num_envs: int, mode: AutoresetMode, **given: Any) -> tuple[VectorEnv, VectorEnv]:
    """Ours, and single environments that Gymnasium makes a vector of."""
    ours = gymnasium.make_vec(
        MAZE,
        num_envs=num_envs,
        vectorization_mode="vector_entry_point",
        autoreset_mode=mode,
        **given,
    )
    theirs = gymnasium.make_vec(
        MAZE,
        num_envs=num_envs,
        vectorization_mode="sync",
        vector_kwargs={"autoreset_mode": mode},
        **given,
    )
    return ours, theirs


def assert_same(ours: Any, theirs: Any) -> None:
    """The same values, of the same types, to the bit."""
    assert type(ours) is type(theirs)
    if isinstance(ours, np.ndarray) and ours.dtype == object:
        assert ours.shape == theirs.shape
        for one, other in zip(ours, theirs, strict=True):
            assert_same(one, other)
    elif isinstance(ours, np.ndarray):
        assert (ours.dtype, ours.shape) == (theirs.dtype, theirs.shape)
        assert ours.tobytes() == theirs.tobytes()
    elif isinstance(ours, dict):
        assert ours.keys() == theirs.keys()
        for key in ours:
            assert_same(ours[key], theirs[key])
    elif isinstance(ours, tuple):
        assert len(ours) == len(theirs)
        for one, other in zip(ours, theirs, strict=True):
            assert_same(one, other)
    else:
        assert ours == theirs


@pytest.mark.parametrize("rule", ["exact", "discrete"])
@pytest.mark.parametrize("mode", [AutoresetMode.NEXT_STEP, AutoresetMode.SAME_STEP])
def test_the_vector_environment_is_what_gymnasium_makes_of_single_ones(
    rule: str, mode: AutoresetMode
) -> None:
    ours, theirs = vectors(
        5, mode, rule=rule, maze=CORRIDOR, start="random", max_episode_steps=60, step_reward=-0.01
    )
    assert_same(ours.reset(seed=7), theirs.reset(seed=7))
    assert ours.action_space == theirs.action_space
    assert ours.observation_space == theirs.observation_space
    random = np.random.default_rng(1)
    ended = 0
    for _ in range(20):
        actions = random.uniform(-1, 1, (5, 2)).astype(np.float32)
        for _ in range(10):
            step = ours.step(actions)
            assert_same(step, theirs.step(actions))
            ended += int(np.sum(step[2])) + 1000 * int(np.sum(step[3]))
    assert ended % 1000 > 0, "none was won"
    assert ended // 1000 > 0, "none was truncated"


def test_a_vector_of_thousands_is_the_same_on_any_number_of_threads() -> None:
    def rollout(threads: int) -> bytes:
        envs = carom.gym.MazeVectorEnv(
            1500, threads=threads, rule="discrete", start="random", max_episode_steps=25
        )
        observations, _ = envs.reset(seed=3)
        random = np.random.default_rng(5)
        seen = [observations.tobytes()]
        for _ in range(60):
            actions = random.uniform(-1, 1, (1500, 2)).astype(np.float32)
            seen += [array.tobytes() for array in envs.step(actions)[:4]]
        return b"".join(seen)

    assert rollout(1) == rollout(2) == rollout(3)


def test_other_threads_run_during_a_step() -> None:
    envs = carom.gym.MazeVectorEnv(500, threads=1, rule="discrete", frames_per_step=1000)
    envs.reset(seed=0)
    actions = np.zeros((500, 2), np.float32)
    with turns_of_another_thread() as turns:
        before = turns()
        envs.step(actions)
        within = turns() - before
    # A step that keeps the others waiting leaves them a turn at its begin and one at its end.
    assert within > 10


def test_the_name_with_its_module_is_enough() -> None:
    script = f"import gymnasium; gymnasium.make('carom.gym:{MAZE}').reset(seed=0)"
    subprocess.run([sys.executable, "-c", script], check=True)


def test_what_a_step_returned_stays_as_it_was() -> None:
    envs = carom.gym.MazeVectorEnv(3)
    envs.reset(seed=0)
    arrays = [array for _ in range(3) for array in envs.step(np.tile(RIGHT, (3, 1)))[:4]]
    kept = [array.copy() for array in arrays]
    envs.step(np.tile(LEFT, (3, 1)))
    assert all(np.array_equal(one, other) for one, other in zip(arrays, kept, strict=True))
    for place, array in enumerate(arrays):
        assert not any(np.shares_memory(array, other) for other in arrays[:place])


def test_a_collectible_and_the_end_wall_are_rewarded_and_the_end_wall_terminates() -> None:
    steps = played(gymnasium.make(MAZE, maze=CORRIDOR), RIGHT)
    rewards = [reward for _, reward, *_ in steps]
    assert sorted(reward for reward in rewards if reward != 0) == [1.0, 1.0]
    observation, reward, terminated, truncated, info = steps[-1]
    assert (reward, terminated, truncated) == (1.0, True, False)
    assert info == {"collected": 1, "is_success": True}
    assert observation[-1] == 0.0


def test_falling_terminates_without_success() -> None:
    _, reward, terminated, _, info = played(gymnasium.make(MAZE, maze=OPEN), RIGHT)[-1]
    assert (reward, terminated, info["is_success"]) == (-1.0, True, False)


def test_time_truncates_and_does_not_terminate() -> None:
    env = gymnasium.make(MAZE, maze=CORRIDOR, max_episode_steps=30)
    steps = played(env, LEFT)
    assert len(steps) == 30
    assert steps[-1][2:4] == (False, True)


def test_the_first_number_of_an_observation_grows_where_the_first_action_is_positive() -> None:
    env = gymnasium.make(MAZE, maze=OPEN)
    start, _ = env.reset()
    for _ in range(20):
        seen, *_ = env.step(RIGHT)
    assert seen[0] > start[0] and seen[2] > 0 and seen[4] > 0
    assert np.all(seen[[1, 3, 5]] == start[[1, 3, 5]])


def test_the_same_seed_starts_at_the_same_places_and_another_elsewhere() -> None:
    env = gymnasium.make(MAZE, start="random")
    places = [env.reset(seed=4)[0], env.reset()[0], env.reset(seed=4)[0], env.reset()[0]]
    assert np.array_equal(places[:2], places[2:])
    assert not np.array_equal(places[0], places[1])
    assert not np.array_equal(places[0], env.reset(seed=5)[0])


def test_a_start_asked_for_at_a_reset_is_for_that_episode() -> None:
    env = gymnasium.make(MAZE)
    usual, _ = env.reset(seed=1)
    elsewhere, _ = env.reset(options={"start": "random"})
    again, _ = env.reset()
    assert np.array_equal(usual, again)
    assert not np.array_equal(usual, elsewhere)


def test_a_mask_resets_some_and_leaves_the_others() -> None:
    envs = carom.gym.MazeVectorEnv(4, autoreset_mode="Disabled")
    start, _ = envs.reset(seed=0)
    actions = np.tile(RIGHT, (4, 1))
    before, *_ = envs.step(actions)
    mask = np.array([True, False, True, False])
    after, infos = envs.reset(options={"reset_mask": mask})
    assert np.array_equal(after[mask], start[mask])
    assert np.array_equal(after[~mask], before[~mask])
    assert np.array_equal(infos["_collected"], mask)


def test_observations_keep_to_their_space() -> None:
    envs = carom.gym.MazeVectorEnv(200, rule="discrete", maze=OPEN, start="random")
    envs.reset(seed=0)
    envs.action_space.seed(0)
    for _ in range(50):
        actions = envs.action_space.sample()
        for _ in range(10):
            observations, *_ = envs.step(actions)
            assert observations in envs.observation_space


def test_shaping_adds_up_to_the_difference_of_potentials() -> None:
    def total(**given: Any) -> float:
        steps = played(gymnasium.make(MAZE, maze=CORRIDOR, **given), RIGHT)
        return float(sum(reward for _, reward, *_ in steps))

    plain, shaped = total(), total(shaping=1.0, discount=1.0)
    # No potential at the end, and at the start the way to the collectible: 2.9 m, less the radii of
    # ball and collectible, and more for what is near walls.
    assert 2.1 < shaped - plain < 3.5


@pytest.fixture
def drawing(tmp_path: Path) -> Iterator[Path]:
    path = tmp_path / "maze.txt"
    path.write_text(CORRIDOR)
    yield path


def test_a_maze_is_read_from_a_file(drawing: Path) -> None:
    env = gymnasium.make(MAZE, maze=drawing)
    assert env.observation_space == gymnasium.make(MAZE, maze=CORRIDOR).observation_space


def test_a_ball_with_friction_rolls_five_sevenths_as_fast() -> None:
    speeds = []
    for friction in (0.0, 0.4):
        env = gymnasium.make(
            MAZE, maze=OPEN, friction=friction, tilt_speed_degrees_per_second=float("inf")
        )
        env.reset()
        for _ in range(10):
            observation = env.step(np.array([0.2, 0.0], dtype=np.float32))[0]
        speeds.append(float(observation[2]))
    assert speeds[1] / speeds[0] == pytest.approx(5 / 7, rel=1e-5)


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"maze": "no such maze"}, "maze"),
        ({"rule": "bisect"}, "rule"),
        ({"frame_time": float("nan")}, "frame_time"),
        ({"frames_per_step": 0}, "frames_per_step"),
        ({"friction": -0.1}, "friction"),
        ({"max_tilt_degrees": 60.0}, "max_tilt_degrees"),
        ({"start": "anywhere"}, "start"),
        ({"maze": "random", "maze_size": (1, 1)}, "maze_size"),
        ({"discount": 2.0}, "discount"),
        ({"shaping": -1.0}, "shaping"),
        ({"render_mode": "human"}, "render_mode"),
        ({"num_envs": 0}, "num_envs"),
        ({"threads": 0}, "threads"),
        ({"max_episode_steps": 0}, "max_steps"),
    ],
)
def test_an_argument_that_makes_no_sense_is_named(given: dict[str, Any], name: str) -> None:
    with pytest.raises(CaromError, match=name):
        carom.gym.MazeVectorEnv(**given)


def test_an_argument_of_the_wrong_kind_or_unknown_is_named() -> None:
    wrong: list[dict[str, Any]] = [
        {"frame_time": "long"},
        {"maze_size": 3, "maze": "random"},
        {"wind": 1.0},
    ]
    for given in wrong:
        with pytest.raises(TypeError, match=next(iter(given))):
            carom.gym.MazeEnv(**given)


def test_a_drawing_that_is_no_maze_is_refused_with_its_place() -> None:
    with pytest.raises(SceneError, match="2:3"):
        carom.gym.MazeEnv(maze="#####\n#S?E#\n#####")


@pytest.mark.parametrize(
    "actions", [np.zeros((2, 2)), np.zeros((3, 3)), np.full((3, 2), np.nan), [["a", "b"]]]
)
def test_actions_that_make_no_sense_are_refused_and_nothing_moves(actions: Any) -> None:
    envs, twin = carom.gym.MazeVectorEnv(3), carom.gym.MazeVectorEnv(3)
    for each in (envs, twin):
        each.reset(seed=0)
    with pytest.raises((CaromError, TypeError), match="actions"):
        envs.step(actions)
    right = np.tile(RIGHT, (3, 1))
    assert_same(envs.step(right), twin.step(right))


def test_pictures_show_what_changes() -> None:
    if not hasattr(carom._carom, "Painter"):
        pytest.skip("a build without pictures")
    envs = carom.gym.MazeVectorEnv(2, maze=CORRIDOR, render_mode="rgb_array")
    envs.reset(seed=0)
    pictures = envs.render()
    assert pictures is not None
    for _ in range(60):
        envs.step(np.stack([RIGHT, LEFT]))
    later = envs.render()
    assert later is not None
    assert pictures[0].shape == (480, 640, 3) and pictures[0].dtype == np.uint8
    assert np.array_equal(pictures[0], pictures[1])
    assert not np.array_equal(pictures[0], later[0])
    assert not np.array_equal(later[0], later[1])
