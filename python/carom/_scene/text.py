"""Parts of scenes to the text of scene files, and back from what the engine tells."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any, get_args

import numpy as np

from carom._scene import parts
from carom.errors import CaromError


def toml_of(table: parts.Part) -> str:
    """The fields of a part as TOML, one a line.

    Raises:
        TypeError: For a value that no scene file can hold; the message names its field.
        CaromError: For a whole number that is too large; the message names its field.
    """
    lines = [f"{key} = {toml_value(value, key)}" for key, value in _fields(table).items()]
    return "\n".join(lines) + "\n"


def toml_value(value: object, name: str) -> str:
    """A value as TOML; ``name`` is what errors call it.

    >>> toml_value(parts.Gravity((0, -9.81, 0)), "force")
    '{ gravity = { acceleration = [0, -9.81, 0] } }'
    """
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        if not -(2**63) <= value < 2**63:
            raise CaromError(f"{name}: must be in [-2^63, 2^63), not {value}", name)
        return str(value)
    if isinstance(value, float):
        # Python writes inf and nan as TOML does.
        return repr(value)
    if isinstance(value, str):
        # What JSON escapes, TOML escapes alike, but for one character that JSON leaves alone.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, parts.Part):
        fields, tag = _fields(value), getattr(value, "tag", None)
        if tag is not None:
            return toml_value({tag: fields} if fields else tag, name)
        return toml_value(fields, name)
    if isinstance(value, Mapping):
        pairs = [
            f"{_key(key)} = {toml_value(item, f'{name}.{key}')}" for key, item in value.items()
        ]
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, Sequence):
        items = [toml_value(item, f"{name}[{index}]") for index, item in enumerate(value)]
        return "[" + ", ".join(items) + "]"
    raise TypeError(f"{name}: a scene can hold no {type(value).__name__}")


def _key(name: object) -> str:
    """A key of a table as TOML."""
    text = str(name)
    is_bare = re.fullmatch("[A-Za-z0-9_-]+", text) is not None
    return text if is_bare else toml_value(text, "key")


def _fields(part: parts.Part) -> dict[str, object]:
    """Names and values; what is ``None`` is left out."""
    assert dataclasses.is_dataclass(part)
    pairs = [(field.name, getattr(part, field.name)) for field in dataclasses.fields(part)]
    pairs = [(_RENAMED.get(name, name), value) for name, value in pairs]
    written = {name: value for name, value in pairs if value is not None}
    if isinstance(part, parts.Camera) and part.look_at is not None:
        del written["rotation"]
    if isinstance(part, (parts.Sphere, parts.Collider)) and part.material is not None:
        # What is usual is left to the material.
        for name in ("restitution", "finish"):
            if written[name] == type(part).__dataclass_fields__[name].default:
                del written[name]
    return written


_RENAMED = {"tries": "try"}
"""Fields whose names in scene files are words of the language."""

_NAMES = {name: field for field, name in _RENAMED.items()}

_KINDS: dict[str, type[parts.Part]] = {
    "bisect": parts.Bisect,
    "camera": parts.Camera,
    "collider": parts.Collider,
    "colliders": parts.Collider,
    "colors": parts.Colors,
    "contact": parts.Contact,
    "densities": parts.DensityColor,
    "discrete": parts.Discrete,
    "emitters": parts.Emitter,
    "exact": parts.Exact,
    "material_pairs": parts.MaterialPair,
    "simulation": parts.Simulation,
    "sphere": parts.Sphere,
    "spheres": parts.Sphere,
    "springs": parts.Spring,
    "strike": parts.Strike,
    "sun": parts.Sun,
    "tries": parts.Try,
}
"""What is described under a name."""

_CHOICES: dict[str, tuple[type[parts.Part], ...]] = {
    "boundary": (parts.Periodic,),
    "forces": parts.FORCES,
    "generators": get_args(parts.Generator),
    "motion": get_args(parts.Motion),
    "pair_potential": (parts.PairPotential,),
    "pieces": get_args(parts.Piece),
    "restitution_law": get_args(parts.RestitutionLaw),
    "shape": get_args(parts.Shape),
    "thermostat": get_args(parts.Thermostat),
}
"""What may be described under a name; tags distinguish the variants."""


def read_part(key: str, text: str) -> Any:
    """The part that the engine describes in JSON, as it stands under a name of scene files."""
    return part_of(key, json.loads(text))


def read_parts(key: str, text: str) -> dict[int, Any]:
    """Parts of a scene, by their ids."""
    return {number: part_of(key, value) for number, value in json.loads(text)}


def part_of(key: str, value: Any) -> Any:
    """What stands under a name of scene files as a part, a tuple, or what it is."""
    if isinstance(value, list):
        # Infinite numbers come as nothing.
        return tuple(math.inf if item is None else part_of(key, item) for item in value)
    if key in _CHOICES:
        kinds = {kind.tag: kind for kind in _CHOICES[key]}  # type: ignore[attr-defined]
        tag, fields = (value, {}) if isinstance(value, str) else next(iter(value.items()))
        return kinds[tag]._of_engine(fields_of(fields)) if tag in kinds else value
    if isinstance(value, dict) and key == "materials":
        return {name: parts.Material._of_engine(fields_of(it)) for name, it in value.items()}
    if isinstance(value, dict):
        return _KINDS[key]._of_engine(fields_of(value))
    return value


def fields_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """The arguments that make a part."""
    named = {_NAMES.get(name, name): value for name, value in values.items()}
    return {name: part_of(name, value) for name, value in named.items()}
