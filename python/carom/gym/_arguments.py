"""What can be said of a maze and of how it is played."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from typing import Any, Literal, TypedDict

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from carom._carom import MazeEpisodes
from carom.errors import CaromError

Start = Literal["maze", "random"]
"""Where episodes start: where the maze says, or anywhere on the floor, from the seed."""


class MazeArguments(TypedDict, total=False):
    """Arguments of `MazeEnv` and `MazeVectorEnv`, by name; all may be left out.

    Attributes:
        maze: ``"course"`` (default), ``"spiral"``, ``"random"``, a drawing (several lines), or the
            path of a file with one.
        maze_seed: Of a random maze, 0.
        maze_size: Columns and rows of a random maze, (5, 4).
        rule: ``"exact"`` (default), or ``"discrete"``, which is faster: `docs/physics/`.
        frame_time: Length of a frame, 0.02 [s].
        frames_per_step: Frames in a step, 1: for so long an action holds.
        friction: Coefficient of friction of the ball, 0. Without any it slides, as in the course's
            maze; with some it rolls, and the rule ``contact`` takes all frames, whatever ``rule``
            says.
        max_tilt_degrees: Steepest tilt, 20 [°], at most 45.
        tilt_speed_degrees_per_second: How fast the maze follows an action about each axis,
            60 [°/s]; ``inf``: at once.
        start: ``"maze"`` (default), or ``"random"``: anywhere on the floor.
        collectible_reward: For each collectible, 1.
        end_wall_reward: For the end wall, 1.
        fall_reward: For falling out of the maze, -1.
        step_reward: For each step, 0.
        shaping: For each metre of the way to the nearest collectible that is left, or to the end
            wall if none is, 0. It shows the way, and leaves the best way to play the best: with
            Φ = -shaping · way, each step adds discount · Φ(after) - Φ(before) (A. Y. Ng, D. Harada,
            S. Russell, ICML 1999).
        discount: Discount of the agent that is shaped, 0.99.
    """

    maze: str | PathLike[str]
    maze_seed: int
    maze_size: tuple[int, int]
    rule: Literal["exact", "discrete"]
    frame_time: float
    frames_per_step: int
    friction: float
    max_tilt_degrees: float
    tilt_speed_degrees_per_second: float
    start: Start
    collectible_reward: float
    end_wall_reward: float
    fall_reward: float
    step_reward: float
    shaping: float
    discount: float


DEFAULTS = MazeArguments(
    maze="course",
    maze_seed=0,
    maze_size=(5, 4),
    rule="exact",
    frame_time=0.02,
    frames_per_step=1,
    friction=0.0,
    max_tilt_degrees=20.0,
    tilt_speed_degrees_per_second=60.0,
    start="maze",
    collectible_reward=1.0,
    end_wall_reward=1.0,
    fall_reward=-1.0,
    step_reward=0.0,
    shaping=0.0,
    discount=0.99,
)

METADATA: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 50}
"""What Gymnasium wants to know of an environment."""


class Episodes:
    """Episodes of balls, as the arguments say, and the spaces of one of them."""

    def __init__(
        self,
        num_envs: int,
        given: MazeArguments,
        *,
        max_episode_steps: int | None = None,
        threads: int | None = 1,
        autoreset_mode: str = "Disabled",
    ) -> None:
        check_names(given, DEFAULTS, "a maze")
        arguments: dict[str, Any] = {**DEFAULTS, **given, "max_episode_steps": max_episode_steps}
        arguments["maze"] = fspath(arguments["maze"])
        start = arguments.pop("start")
        self.engine = MazeEpisodes(num_envs, threads, autoreset_mode, start, arguments)
        low, high = self.engine.bounds
        self.observation_space = spaces.Box(low, high, dtype=np.float32)
        self.action_space = spaces.Box(-1.0, 1.0, (2,), dtype=np.float32)
        step = arguments["frame_time"] * arguments["frames_per_step"]
        self.metadata = {**METADATA, "render_fps": max(1, round(1.0 / step))}


def check_names(given: Mapping[str, object], known: Mapping[str, object], what: str) -> None:
    """Checks the names of arguments of a kind of environments.

    Raises:
        TypeError: For an argument that there is not.
    """
    for name in given:
        if name not in known:
            raise TypeError(f"{name}: there is no such argument of {what}")


def chosen(name: str, value: str, known: tuple[str, str]) -> str:
    """One of two texts.

    Raises:
        CaromError: For any other.
    """
    if value not in known:
        raise CaromError(f'{name}: must be "{known[0]}" or "{known[1]}", not "{value}"', name)
    return value


def checked_mask(mask: object, count: int) -> NDArray[np.bool_]:
    """Which of the environments start again; all of them, unless given.

    Raises:
        CaromError: For anything but an array of bool with a value for each.
    """
    if mask is None:
        return np.ones(count, np.bool_)
    if not isinstance(mask, np.ndarray) or mask.dtype != np.bool_ or mask.shape != (count,):
        message = f"reset_mask: must be an array of bool of shape ({count},)"
        raise CaromError(message, "reset_mask")
    return mask


def checked_mode(render_mode: str | None) -> str | None:
    """A way to render that there is.

    Raises:
        CaromError: For any other.
    """
    if render_mode is not None and render_mode not in METADATA["render_modes"]:
        raise CaromError(
            f'render_mode: must be None or "rgb_array", not {render_mode}', "render_mode"
        )
    return render_mode


def engine_seed(seed: int) -> int:
    """A seed as the engine takes it: any whole number that is not negative, modulo 2^64."""
    if seed < 0:
        raise CaromError(f"seed: must be zero or positive, not {seed}", "seed")
    return int(seed) % 2**64


def chosen_start(options: dict[str, Any] | None) -> str | None:
    """What the options of a reset say of where to start.

    Raises:
        CaromError: For an option that there is not.
    """
    for name in options or {}:
        if name not in ("start", "reset_mask"):
            raise CaromError(f"options: there is no {name}, but start", "options")
    return (options or {}).get("start")


def in_range(name: str, value: float, low: float, high: float) -> float:
    """A number within bounds.

    Raises:
        CaromError: For another one.
        TypeError: For no number.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise TypeError(f"{name}: must be a number, not {type(value).__name__}")
    if not low <= value <= high:
        raise CaromError(f"{name}: must be in [{low:g}, {high:g}], not {value}", name)
    return value


def seeds_of(
    seed: int | Sequence[int | None] | None, count: int, drawn: Callable[[], int] | None
) -> list[int | None]:
    """The seed of each environment: those of a sequence, or ``seed``, ``seed + 1``, and so on.

    Args:
        seed: As `reset` takes it.
        count: How many environments there are.
        drawn: Gives a seed where there is none; ``None`` where all go on as they are.

    Raises:
        CaromError: For a seed that is invalid.
    """
    if seed is None:
        if drawn is None:
            return [None] * count
        seed = drawn()
    if isinstance(seed, Sequence):
        return [None if it is None else engine_seed(it) for it in seed]
    return [engine_seed(seed + place) for place in range(count)]
