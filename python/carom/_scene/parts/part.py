"""What parts of scenes have in common: they check their fields, and are values."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import MISSING, fields
from typing import Any

from carom._scene.checks import Checked, checks_of, listed


class Part(Checked):
    """Something that a scene is made of. Arrays and lists become tuples: parts are values."""

    def __post_init__(self) -> None:
        values = self.__dict__
        kind: Any = type(self)
        for name, default, keep in checks_of(kind):
            value = values[name]
            if value is not default:
                values[name] = keep(value)

    @classmethod
    def _of_engine(cls, given: Mapping[str, Any]) -> Any:
        """A part of the fields that the engine writes: the engine has checked them."""
        part = object.__new__(cls)
        values = part.__dict__
        for each in fields(cls):  # type: ignore[arg-type]  # Only dataclasses are made of it.
            if each.default_factory is not MISSING:
                values[each.name] = each.default_factory()
            else:
                values[each.name] = each.default
        if unknown := given.keys() - values.keys():
            raise TypeError(f"carom.{cls.__name__} has no field {', '.join(sorted(unknown))}")
        values.update(given)
        return part


def expect(name: str, value: object, *kinds: type[Part] | str) -> None:
    """Refuses a value that is of none of these classes.

    Args:
        name: What errors call it.
        value: What was given.
        kinds: Classes of parts, and words for what else may be given.

    Raises:
        TypeError: For any other value.
    """
    classes = tuple(kind for kind in kinds if not isinstance(kind, str))
    if isinstance(value, classes):
        return
    words = listed(it if isinstance(it, str) else f"carom.{it.__name__}" for it in kinds)
    shown, remedy = type(value).__name__, ""
    if isinstance(value, type):
        shown = f"the class {value.__name__}"
        remedy = f"; write carom.{value.__name__}(...)" if value in classes else ""
    elif isinstance(value, Part):
        shown = f"carom.{shown}"
    raise TypeError(
        f"{name}: must be {'' if isinstance(kinds[0], str) else 'a '}{words}, not {shown}{remedy}"
    )
