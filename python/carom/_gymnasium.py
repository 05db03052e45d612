"""Has Gymnasium know the environments of `carom.gym` as soon as both packages are imported.

`carom` does not import Gymnasium, which takes longer than all of `carom`. The environments are
registered at once if somebody has imported it, and else when somebody does.
"""

from __future__ import annotations

import contextlib
import importlib.abc
import importlib.machinery
import sys
import types
from collections.abc import Sequence
from typing import Any

MAZE = "carom/Maze-v0"
"""The name under which Gymnasium knows the maze."""

PLATE = "carom/Plate-v0"
"""The name of the tilting plate."""

BILLIARDS = "carom/Billiards-v0"
"""The name of the billiard table."""

_GYMNASIUM = "gymnasium"

# The classes of one and of many, and steps after which an episode is truncated: 40 s, 20 s, 50
# shots.
_ENVIRONMENTS = {
    MAZE: ("MazeEnv", "MazeVectorEnv", 2000),
    PLATE: ("PlateEnv", "PlateVectorEnv", 1200),
    BILLIARDS: ("BilliardsEnv", "BilliardsVectorEnv", 50),
}


def register_environments(gymnasium: Any) -> None:
    """Registers the environments; `carom.gym` is imported when the first of them is made."""
    for name, (one, many, most_steps) in _ENVIRONMENTS.items():
        if name not in gymnasium.registry:
            gymnasium.register(
                id=name,
                entry_point=f"carom.gym:{one}",
                vector_entry_point=f"carom.gym:{many}",
                max_episode_steps=most_steps,
            )


def register_with_gymnasium() -> None:
    """Registers the environments now, or after the import of Gymnasium if it is still to come."""
    gymnasium = sys.modules.get(_GYMNASIUM)
    if hasattr(gymnasium, "registry") and hasattr(gymnasium, "register"):
        with contextlib.suppress(Exception):
            register_environments(gymnasium)
    elif not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())


class _Finder(importlib.abc.MetaPathFinder):
    """Finds Gymnasium as the other finders do, once, and has it registered after its import."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None,
        target: types.ModuleType | None = None,
    ) -> importlib.machinery.ModuleSpec | None:
        if fullname != _GYMNASIUM:
            return None
        for finder in sys.meta_path:
            if finder is not self and (find := getattr(finder, "find_spec", None)) is not None:
                spec: importlib.machinery.ModuleSpec | None = find(fullname, path, target)
                if spec is not None:
                    if spec.loader is not None:
                        spec.loader = _Loader(spec.loader, self)
                    return spec
        return None


class _Loader(importlib.abc.Loader):
    """Loads Gymnasium by its own loader, and registers the environments."""

    def __init__(self, own: Any, finder: _Finder) -> None:
        self._own, self._finder = own, finder

    def __getattr__(self, name: str) -> Any:
        # Resources and sources of the package.
        return getattr(self._own, name)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> types.ModuleType | None:
        created: types.ModuleType | None = self._own.create_module(spec)
        return created

    def exec_module(self, module: types.ModuleType) -> None:
        # As if nothing had stood in between.
        module.__loader__ = self._own
        if module.__spec__ is not None:
            module.__spec__.loader = self._own
        self._own.exec_module(module)
        if self._finder in sys.meta_path:
            sys.meta_path.remove(self._finder)
        # An import of Gymnasium for something else must not fail on account of this; an import of
        # carom.gym tries again, and tells.
        with contextlib.suppress(Exception):
            register_environments(module)
