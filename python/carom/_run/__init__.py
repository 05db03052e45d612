"""The layer above scenes: worlds that move, and what is recorded of them."""

from carom._run import methods
from carom._scene.above import above

above.run = methods
