"""The layer above worlds: pictures, films and the window."""

from carom._pictures import methods
from carom._scene.above import above

above.pictures = methods
