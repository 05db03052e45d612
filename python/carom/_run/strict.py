"""Attributes that can be set: those that there are."""

from __future__ import annotations

import difflib
from typing import Any


class Strict:
    """Refuses attributes that a class of this package does not have.

    What somebody's own class adds to one of them is its business.
    """

    __slots__ = ()

    def __setattr__(self, name: str, value: Any) -> None:
        kind = type(self)
        is_own = kind.__module__.split(".")[0] == "carom"
        if not is_own or name.startswith("_") or hasattr(kind, name):
            super().__setattr__(name, value)
            return
        known = [it for it in dir(kind) if not it.startswith("_")]
        meant = difflib.get_close_matches(name, known, 1)
        hint = f"; did you mean {meant[0]!r}?" if meant else ""
        raise AttributeError(f"a carom.{kind.__name__} has no attribute {name!r}{hint}")
