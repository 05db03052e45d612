"""What tells whether the code of a function is still the same."""

from __future__ import annotations

import functools
import hashlib
import importlib.util
from types import CodeType
from typing import Any

_INTERPRETER = importlib.util.MAGIC_NUMBER.hex()
"""The bytecode of one function differs from interpreter to interpreter."""


def fingerprint_of(function: Any) -> str | None:
    """The fingerprint of a function's code; ``None`` if it has no code of Python.

    What it calls has code of its own, which does not count, and neither do comments. A docstring
    that is added or taken away may count, another text of one does not.
    """
    told: list[object] = []
    while function is not None:
        if isinstance(function, functools.partial):
            function = function.func
            continue
        code = getattr(function, "__code__", None)
        if isinstance(code, CodeType):
            told.append(_code(code, function.__doc__))
            told.append(_constants((function.__defaults__, function.__kwdefaults__)))
        # What a decorator stands for.
        function = getattr(function, "__wrapped__", None)
    if not told:
        return None
    return f"{_INTERPRETER}:{hashlib.sha256(repr(told).encode()).hexdigest()}"


def tells_of_change(before: str, now: str) -> bool:
    """Whether two fingerprints are of different code, by the same interpreter."""
    return before != now and before.split(":")[0] == now.split(":")[0]


def _code(code: CodeType, doc: str | None = None) -> object:
    constants = [_constants(it) for it in code.co_consts if doc is None or it != doc]
    names = (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars)
    # Where exceptions are caught, from Python 3.11 on.
    caught = getattr(code, "co_exceptiontable", b"")
    return (code.co_code, caught, names, code.co_argcount, code.co_kwonlyargcount, constants)


def _constants(value: object) -> object:
    """A constant, written alike in every process."""
    if isinstance(value, CodeType):
        return _code(value)
    if isinstance(value, tuple):
        return tuple(map(_constants, value))
    if isinstance(value, frozenset):
        return sorted(map(repr, value))
    if isinstance(value, dict):
        return [(name, _constants(it)) for name, it in sorted(value.items())]
    if value is None or isinstance(value, (bool, int, float, complex, str, bytes)):
        return value
    # Other defaults may be written with their address.
    return type(value).__qualname__
