"""Checks of the fields of parts, made from their annotations.

The type in an annotation says which kind of value a field takes; what stands beside it in
`Annotated` says which of these values make sense, in the words of the engine.
"""

from __future__ import annotations

import difflib
import inspect
import math
import re
import types
import typing
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cache, lru_cache
from typing import Annotated, Any, Literal, NamedTuple, Union, get_args, get_origin

import numpy as np

from carom._carom import canonical_toml
from carom.errors import CaromError


class Requirement(NamedTuple):
    """What a number must be, or the numbers of a vector together."""

    words: str
    holds: Callable[[Any], bool]


class Numbers(NamedTuple):
    """Says that a field takes several numbers."""

    words: str
    length: int | None = None
    """How many; ``None``: any number of them."""
    are_whole: bool = False


class Rows(NamedTuple):
    """Says that a field takes rows of numbers, or an array of them."""

    row: Any
    """The annotation of a row."""


class Whole(NamedTuple):
    """Says that a field takes a part only if nothing is missing in it."""

    problem: str
    """What is wrong with one in which something is missing."""
    holds: Callable[[Any], bool]


class ColorText:
    """Says that a field takes a colour as text, too, like ``"red"``."""


class Turn:
    """Says that a field takes a turn as scene files describe it, too: ``{"normal": (1, 0, 0)}``."""


class Checked:
    """Base of all parts: a field that takes one is checked by its class."""


class FieldCheck(NamedTuple):
    """A field of a class, and what checks it."""

    name: str
    default: object
    keep: Callable[[Any], Any]
    """Takes a value, and returns it as the part keeps it; raises an error for a wrong one."""


@dataclass(frozen=True)
class _Kind:
    """A kind of values that a field takes.

    Attributes:
        words: What a value must be.
        keep: Returns a value as the part keeps it; `_OTHER` for one of another kind. Raises
            `CaromError` for one of this kind that is invalid.
        names: The texts among which a value is chosen.
        remedy: What to write instead of a value of another kind, if that is clear.
        problem: What is missing in a value of this kind, if anything is.
    """

    words: str
    keep: Callable[[Any], Any]
    names: tuple[str, ...] = ()
    remedy: Callable[[Any], str | None] = lambda value: None
    problem: Callable[[Any], str | None] = lambda value: None


_OTHER = object()
"""Instead of a value that is of another kind."""

_NUMBER_TEXT = re.compile(r"=.*|\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*[^\d\s.].*", re.DOTALL)
"""A formula, or a number with a unit, which the engine reads: ``"=2 * 3"``, ``"5 cm"``."""

_MOST_DIGITS = 2**63
"""Scene files hold whole numbers below this."""

_LONGEST = 60
"""Longer values are cut in messages."""


@cache
def checks_of(part: type) -> tuple[FieldCheck, ...]:
    """The fields of a dataclass with their checks."""
    return tuple(
        FieldCheck(it.name, it.default, _check(_hint(part, it.name), f"{part.__name__}.{it.name}"))
        for it in fields(part)
    )


def plain(value: object) -> object:
    """Numbers of NumPy as those of Python; arrays and lists as tuples."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return tuple(plain(item) for item in value)
    return value


def wrong_value(where: str, words: str, value: object, remedy: str = "") -> CaromError:
    """The error for a value of the right kind that is invalid."""
    return CaromError(f"{where}: must be {words}, not {_shown(value)}{remedy}", where)


def _shown(value: object) -> str:
    """A value in a message."""
    value = plain(value)
    if value is not None and not isinstance(value, (bool, int, float, str, tuple, Mapping)):
        name = type(value).__name__
        return f"carom.{name}" if _is_own(type(value)) else name
    try:
        text = repr(value)
    except ValueError:
        # A whole number of more digits than Python writes.
        return "a number with too many digits"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def _is_own(kind: type) -> bool:
    return kind.__module__.split(".")[0] == "carom"


def _hint(part: type, name: str) -> Any:
    """The annotation of a field; `Any` if it names something that is not known here."""
    for base in part.__mro__:
        annotations = inspect.get_annotations(base)
        if name in annotations:
            alone = type(base.__name__, (), {"__annotations__": {name: annotations[name]}})
            alone.__module__ = base.__module__
            try:
                return typing.get_type_hints(alone, include_extras=True)[name]
            except NameError:
                # In a class that somebody else wrote inside a function.
                return Any
    return Any


def _check(hint: Any, where: str) -> Callable[[Any], Any]:
    """What checks the values of a field; ``where`` is what errors call it."""
    kinds = _kinds(hint, where)
    if not kinds:
        return plain
    is_optional = type(None) in get_args(hint)

    def check(value: Any) -> Any:
        if value is None and is_optional:
            return None
        return _kept(kinds, value, where)

    return check


def _kept(kinds: Sequence[_Kind], value: Any, where: str) -> Any:
    for kind in kinds:
        kept = kind.keep(value)
        if kept is not _OTHER:
            if problem := kind.problem(kept):
                raise CaromError(f"{where}: {problem}", where)
            return kept
    words = " or ".join(kind.words for kind in kinds)
    names = [name for kind in kinds for name in kind.names]
    if names and isinstance(value, str):
        meant = difflib.get_close_matches(value, names, 1)
        raise wrong_value(where, words, value, f"; did you mean {meant[0]!r}?" if meant else "")
    remedies = [remedy for kind in kinds if (remedy := kind.remedy(value))]
    remedy = f"; {remedies[0]}" if remedies else ""
    raise TypeError(f"{where}: must be {words}, not {_shown(value)}{remedy}")


def _kinds(hint: Any, where: str) -> list[_Kind]:
    """The kinds of values that an annotation names; none if one of them is not known here."""
    options = [hint]
    if get_origin(hint) in (Union, types.UnionType):
        options = [option for option in get_args(hint) if option is not type(None)]
    if all(_is_part(option) for option in options):
        return [_part(tuple(options))]
    kinds = [_kind(option, where) for option in options]
    return [] if None in kinds else [kind for kind in kinds if kind is not None]


def _kind(hint: Any, where: str) -> _Kind | None:
    extras: tuple[Any, ...] = ()
    if get_origin(hint) is Annotated:
        hint, *rest = get_args(hint)
        extras = tuple(rest)
    requirements = [it for it in extras if isinstance(it, Requirement)]
    if numbers := [it for it in extras if isinstance(it, Numbers)]:
        # The last is the outermost.
        vector = _vector(numbers[-1], requirements, where)
        if any(it is ColorText for it in extras):
            return _or_color_text(vector, where)
        return _or_turn(vector) if any(it is Turn for it in extras) else vector
    if rows := [it for it in extras if isinstance(it, Rows)]:
        return _sequence(_kinds(rows[-1].row, where), where)
    if hint in (float, int):
        return _number(hint, requirements, where)
    if hint is bool:
        return _instance(bool, "True or False")
    if hint is str:
        return _instance(str, "text")
    if get_origin(hint) is Literal:
        return _choice(get_args(hint))
    if get_origin(hint) is Sequence:
        elements = _kinds(get_args(hint)[0], where)
        return _sequence(elements, where) if elements else None
    if get_origin(hint) is Mapping:
        elements = _kinds(get_args(hint)[1], where)
        return _named(elements, where) if elements else None
    if not _is_part(hint):
        return None
    return _part((hint,), [it for it in extras if isinstance(it, Whole)])


# Numbers


def _number(kind: type, requirements: Sequence[Requirement], where: str) -> _Kind:
    number = _real if kind is float else _whole

    def keep(value: Any) -> Any:
        if type(value) is not kind:
            given, value = value, number(value)
            if value is _OTHER or isinstance(value, str):
                return value
        else:
            given = value
        for words, holds in requirements:
            if not holds(value):
                raise wrong_value(where, words, given)
        return value

    return _Kind("a number" if kind is float else "a whole number", keep)


def _real(value: Any) -> Any:
    """A number, or a text that the engine reads as one."""
    value = plain(value)
    if isinstance(value, bool) or not isinstance(value, (float, int, str)):
        return _OTHER
    if isinstance(value, str):
        return value if _NUMBER_TEXT.fullmatch(value) else _OTHER
    if isinstance(value, int) and not -_MOST_DIGITS <= value < _MOST_DIGITS:
        try:
            return float(value)
        except OverflowError:
            return math.inf if value > 0 else -math.inf
    return value


def _whole(value: Any) -> Any:
    """A whole number, or a formula."""
    value = plain(value)
    is_formula = isinstance(value, str) and value.startswith("=")
    is_whole = isinstance(value, int) and not isinstance(value, bool)
    return value if is_whole or is_formula else _OTHER


def _vector(numbers: Numbers, requirements: Sequence[Requirement], where: str) -> _Kind:
    words, length, are_whole = numbers
    number, quick = (_whole, (int,)) if are_whole else (_real, (float, int))

    def keep(value: Any) -> Any:
        given = value
        if type(value) is not tuple:
            value = _tuple(value)
            if value is _OTHER:
                return _OTHER
        has_text = False
        for item in value:
            if type(item) not in quick:
                value = tuple(number(item) for item in value)
                if _OTHER in value:
                    return _OTHER
                has_text = any(isinstance(item, str) for item in value)
                break
        if length is not None and len(value) != length:
            raise wrong_value(where, words, given)
        # What a text means is known to the engine alone.
        if not has_text:
            for requirement, holds in requirements:
                if not holds(value):
                    raise wrong_value(where, requirement, given)
        return value

    return _Kind(words, keep)


def _tuple(value: Any) -> Any:
    """A sequence as a tuple."""
    value = plain(value)
    if isinstance(value, Sequence) and not isinstance(value, (str, bytes, bytearray)):
        return value if isinstance(value, tuple) else tuple(value)
    return _OTHER


def _or_color_text(vector: _Kind, where: str) -> _Kind:
    def keep(value: Any) -> Any:
        if not isinstance(value, str):
            return vector.keep(value)
        problem = _problem_of_color(value)
        if problem is not None:
            raise CaromError(f"{where}: {problem}", where)
        return value

    return _Kind(vector.words, keep)


@lru_cache(maxsize=1024)
def _problem_of_color(text: str) -> str | None:
    """What the engine finds wrong with the text of a colour."""
    quoted = text.encode("unicode_escape").decode("ascii").replace('"', '\\"')
    try:
        canonical_toml(f'name = "colors"\ncolors.spheres = "{quoted}"\n')
    except CaromError as error:
        return str(error).removeprefix("colors.spheres: ")
    return None


def _or_turn(vector: _Kind) -> _Kind:
    # The engine reads what is in it.
    def keep(value: Any) -> Any:
        return value if isinstance(value, Mapping) else vector.keep(value)

    return _Kind(vector.words, keep)


# Other values


def _instance(kind: type, words: str) -> _Kind:
    def keep(value: Any) -> Any:
        value = plain(value)
        return value if isinstance(value, kind) else _OTHER

    return _Kind(words, keep)


def _choice(names: tuple[str, ...]) -> _Kind:
    def keep(value: Any) -> Any:
        value = plain(value)
        return value if isinstance(value, str) and value in names else _OTHER

    return _Kind(listed(repr(name) for name in names), keep, names)


def _sequence(elements: Sequence[_Kind], where: str) -> _Kind:
    def keep(value: Any) -> Any:
        if _is_own(type(value)) and isinstance(value, Sequence):
            # It has checked what it holds, and makes parts of it only where they are read.
            return value
        values = _tuple(value)
        if values is _OTHER:
            return _OTHER
        return tuple(_kept(elements, it, f"{where}[{i}]") for i, it in enumerate(values))

    def remedy(value: Any) -> str | None:
        is_element = any(kind.keep(value) is not _OTHER for kind in elements)
        return "put it into a list" if is_element else None

    return _Kind(f"a sequence of {' or '.join(it.words for it in elements)}", keep, remedy=remedy)


def _named(elements: Sequence[_Kind], where: str) -> _Kind:
    def keep(value: Any) -> Any:
        if not isinstance(value, Mapping) or not all(isinstance(name, str) for name in value):
            return _OTHER
        return {name: _kept(elements, it, f"{where}[{name!r}]") for name, it in value.items()}

    return _Kind(f"a mapping of names to {' or '.join(it.words for it in elements)}", keep)


def _is_part(hint: Any) -> bool:
    return isinstance(hint, type) and issubclass(hint, Checked)


def _part(kinds: tuple[type, ...], needs: Sequence[Whole] = ()) -> _Kind:
    by_tag = {getattr(kind, "tag", None): kind.__name__ for kind in kinds}

    def remedy(value: Any) -> str | None:
        """The class that a name of scene files means."""
        name = next(iter(value), None) if isinstance(value, Mapping) else value
        found = by_tag.get(name) if isinstance(name, str) else None
        if found is None and isinstance(value, type) and issubclass(value, kinds):
            found = value.__name__
        return f"write carom.{found}(...)" if found else None

    def keep(value: Any) -> Any:
        return value if isinstance(value, kinds) else _OTHER

    def problem(part: Any) -> str | None:
        return next((it.problem for it in needs if not it.holds(part)), None)

    names = [f"carom.{kind.__name__}" for kind in kinds]
    words = f"a {names[0]}" if len(names) == 1 else f"a {listed(names)}"
    return _Kind(words, keep, remedy=remedy, problem=problem)


def listed(names: Iterable[str]) -> str:
    """Names as people list them."""
    *most, last = names
    return f"{', '.join(most)} or {last}" if most else last
