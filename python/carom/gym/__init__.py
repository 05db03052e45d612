"""Environments of Gymnasium: a maze, a plate that balances a ball, a billiard table.

To import `carom` and Gymnasium, in either order, registers them, and to import this module does;
``pip install 'carom[gym]'`` brings Gymnasium.

>>> import carom
>>> import gymnasium
>>> env = gymnasium.make("carom/Maze-v0")
>>> observation, info = env.reset(seed=1)
>>> observation.shape, env.action_space.shape
((10,), (2,))
>>> envs = gymnasium.make_vec("carom/Maze-v0", num_envs=64)
>>> observations, infos = envs.reset(seed=1)
>>> observations.shape
(64, 10)
>>> plates = gymnasium.make_vec("carom/Plate-v0", num_envs=8, max_episode_steps=300)
>>> plates.reset(seed=1)[0].shape
(8, 6)
"""

try:
    import gymnasium
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(
        "carom.gym needs Gymnasium: pip install 'carom[gym]'", name=error.name
    ) from error

from carom._gymnasium import BILLIARDS, MAZE, PLATE, register_environments
from carom.gym._arguments import MazeArguments
from carom.gym._billiards import BilliardsArguments, BilliardsEnv, BilliardsVectorEnv
from carom.gym._maze import MazeEnv
from carom.gym._maze_vector import MazeVectorEnv
from carom.gym._plate import PlateArguments, PlateEnv, PlateVectorEnv

__all__ = [
    "BILLIARDS",
    "MAZE",
    "PLATE",
    "BilliardsArguments",
    "BilliardsEnv",
    "BilliardsVectorEnv",
    "MazeArguments",
    "MazeEnv",
    "MazeVectorEnv",
    "PlateArguments",
    "PlateEnv",
    "PlateVectorEnv",
]

register_environments(gymnasium)
