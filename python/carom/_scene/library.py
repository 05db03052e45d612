"""Finding scenes by name: those registered in Python, those in folders, the built-in ones."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from carom._carom import find_scene, list_scenes
from carom._scene.scene import NO_CHANGES, Scene, overrides
from carom._scene.text import fields_of
from carom.errors import CaromError, UnknownError

_Maker = TypeVar("_Maker", bound=Callable[..., Scene])

GROUP = "carom.scenes"
"""Entry points of this group are scenes of other packages: functions that return a `Scene`."""


class _Registered(NamedTuple):
    make: Callable[..., Scene]
    description: str


_registered: dict[str, _Registered] = {}


class Listed(NamedTuple):
    """A scene as it is listed."""

    name: str
    title: str
    description: str
    source: str
    """Where it comes from: ``built-in``, ``registered``, or a file."""


def scene(name: str, description: str = "") -> Callable[[_Maker], _Maker]:
    """Registers a function that returns a `Scene`, for `load` and ``python -m carom``.

    The scene gets this name, and this description if it has none. A later one of the same name
    takes its place. Parameters of the function are given to `load`; each needs a default. Other
    packages announce such a function by an entry point of the group ``carom.scenes``, under its
    name.

    Raises:
        CaromError: For an empty name.

    >>> import carom
    >>> @carom.scene("row", "Balls in a row.")
    ... def row(count: int = 3) -> carom.Scene:
    ...     balls = carom.Row(count, (0, 0, 0), (1, 0, 0), carom.Sphere(radius=0.4))
    ...     return carom.Scene(name="row", generators=[balls])
    >>> len(carom.load("row", count=5).world())
    5
    """
    if not name.strip():
        raise CaromError("name: must not be empty", "name")

    def register(make: _Maker) -> _Maker:
        _registered[name] = _Registered(make, description)
        return make

    return register


def load(
    name: str | os.PathLike[str],
    changes: Mapping[str, Any] = NO_CHANGES,
    **parameters: Any,
) -> Scene:
    """The scene with a name or title, in any case, or in a file whose path is given.

    Where no scene has this name or title, it is the only one whose title has all words of it.

    Of several with one name, one registered in Python counts before one of another package, that
    before one in a folder of ``$CAROM_SCENES``, and that before a built-in one.

    Args:
        name: Name, title, or path of a scene file.
        changes: Other values, by their paths, as in `Scene.with_changes`.
        parameters: For the function that makes the scene, if it is one of Python.

    Raises:
        UnknownError: If there is none (the message says what is most like it), or if several
            titles have all its words (the message lists them).
        SceneError: If the scene is invalid, or not with these changes.

    >>> import carom
    >>> carom.load("simtest1").name
    'simtest1'
    >>> carom.load("rain").title
    'Rain on a sphere'
    """
    name = os.fspath(name)
    announced = _announced()
    text, found = _found(name, overrides(changes), announced)
    if text is None:
        scene = _make(found, announced, parameters)
        return scene.with_changes(changes) if changes else scene
    if parameters:
        raise TypeError(f"{name}: takes no parameters ({', '.join(parameters)}); it is a file")
    return Scene(**fields_of(json.loads(text)))


def find(name: str) -> Scene | Callable[..., Scene]:
    """The scene with a name, as `load` finds it, or the function that makes it if it has one."""
    announced = _announced()
    text, found = _found(name, [], announced)
    if text is None:
        return _maker(found, announced).make
    return Scene(**fields_of(json.loads(text)))


def _found(
    name: str, changes: list[str], announced: Mapping[str, EntryPoint]
) -> tuple[str | None, str]:
    """What `find_scene` finds by a name or title, or else by words of a title."""
    names = [(own, "") for own in dict.fromkeys([*_registered, *announced])]
    try:
        return find_scene(name, changes, _folders(), names)
    except UnknownError as error:
        fitting = _of_title(name)
        if len(fitting) > 1:
            listed = ", ".join(f'"{it.name}" ({it.title})' for it in fitting)
            raise UnknownError(
                f'there is no scene "{name}"; several titles have these words: {listed}'
            ) from None
        if not fitting:
            raise error
    return find_scene(fitting[0].name, changes, _folders(), names)


def _of_title(words: str) -> list[Listed]:
    """The scenes whose titles have all these words."""
    wanted = _words(words)
    return [it for it in scenes() if wanted and wanted <= _words(it.title)]


def _words(text: str) -> set[str]:
    return set(re.findall(r"[^\W_]+", text.lower()))


def scenes() -> list[Listed]:
    """All scenes that `load` finds, in the order in which names are looked up."""
    announced = _announced()
    own = [Listed(name, "", it.description, "registered") for name, it in _registered.items()]
    others = [Listed(name, "", "", it.value) for name, it in announced.items()]
    found = [Listed(*row) for row in list_scenes(_folders())]
    # Of several with one name, only the first can be found.
    first: dict[str, Listed] = {}
    for listed in [*own, *others, *found]:
        first.setdefault(listed.name.lower(), listed)
    return list(first.values())


def registered_texts() -> list[str]:
    """The texts of all scenes of Python, for the command line."""
    announced = _announced()
    names = dict.fromkeys([*_registered, *announced])
    return [_make(name, announced, {}).to_toml() for name in names]


def _make(name: str, announced: Mapping[str, EntryPoint], parameters: Mapping[str, Any]) -> Scene:
    """Makes a scene of Python."""
    make, description = _maker(name, announced)
    made = make(**parameters)
    if not isinstance(made, Scene):
        raise TypeError(f"{name}: its function returned a {type(made).__name__}, not a carom.Scene")
    return replace(made, name=name, description=made.description or description)


def _maker(name: str, announced: Mapping[str, EntryPoint]) -> _Registered:
    """What makes a scene of Python."""
    if name not in _registered:
        make = announced[name].load()
        # Its own decorator has registered it by now, unless it has none.
        _registered.setdefault(name, _Registered(make, ""))
    return _registered[name]


def _announced() -> dict[str, EntryPoint]:
    """Scenes of other packages that are not loaded yet."""
    found = entry_points(group=GROUP)
    return {point.name: point for point in found if point.name not in _registered}


def _folders() -> list[Path]:
    folders = os.environ.get("CAROM_SCENES", "").split(os.pathsep)
    return [Path(folder) for folder in folders if folder]
