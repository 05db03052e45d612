"""Arrays that remember what they were made of, so that a number made of them has a gradient."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike, NDArray

from carom.errors import CaromError

Array = NDArray[np.float64]
Share = Callable[[Array], Array]
"""From the derivatives by a result, those by one of the things that it was made of."""

_numbers = itertools.count()

# The derivative of each function of numbers by each of them, from the result and the numbers.
_DERIVATIVES: dict[np.ufunc, tuple[Callable[..., Any], ...]] = {
    np.add: (lambda y, a, b: 1.0, lambda y, a, b: 1.0),
    np.subtract: (lambda y, a, b: 1.0, lambda y, a, b: -1.0),
    np.multiply: (lambda y, a, b: b, lambda y, a, b: a),
    np.divide: (lambda y, a, b: 1.0 / b, lambda y, a, b: -y / b),
    np.power: (
        lambda y, a, b: b * np.power(a, b - 1.0),
        lambda y, a, b: y * np.log(np.where(a > 0, a, 1.0)),
    ),
    np.maximum: (lambda y, a, b: a >= b, lambda y, a, b: a < b),
    np.minimum: (lambda y, a, b: a <= b, lambda y, a, b: a > b),
    np.hypot: (lambda y, a, b: _ratio(a, y), lambda y, a, b: _ratio(b, y)),
    np.arctan2: (lambda y, a, b: b / (a * a + b * b), lambda y, a, b: -a / (a * a + b * b)),
    np.negative: (lambda y, a: -1.0,),
    np.positive: (lambda y, a: 1.0,),
    np.absolute: (lambda y, a: np.sign(a),),
    np.square: (lambda y, a: 2.0 * a,),
    np.sqrt: (lambda y, a: 0.5 / y,),
    np.exp: (lambda y, a: y,),
    np.log: (lambda y, a: 1.0 / a,),
    np.log1p: (lambda y, a: 1.0 / (1.0 + a),),
    np.sin: (lambda y, a: np.cos(a),),
    np.cos: (lambda y, a: -np.sin(a),),
    np.tan: (lambda y, a: 1.0 + y * y,),
    np.arctan: (lambda y, a: 1.0 / (1.0 + a * a),),
    np.tanh: (lambda y, a: 1.0 - y * y,),
}

_COMPARISONS = {
    np.less,
    np.less_equal,
    np.greater,
    np.greater_equal,
    np.equal,
    np.not_equal,
    np.isfinite,
    np.isnan,
}


class Traced(NDArrayOperatorsMixin):
    """An array of float64 that remembers what it was made of.

    It supports operators, elementary functions of NumPy, ``sum``, ``mean``, ``dot``,
    ``numpy.linalg.norm``, ``reshape`` and indexing. Comparisons return plain arrays. Everything
    else raises an error, because it would lose the derivatives. ``value`` is the plain array.
    """

    __slots__ = ("_made_of", "_number", "value")

    def __init__(self, value: ArrayLike, made_of: tuple[tuple[Traced, Share], ...] = ()) -> None:
        self.value: Array = np.asarray(value, dtype=np.float64)
        self._made_of = made_of
        self._number = next(_numbers)

    def __repr__(self) -> str:
        return f"Traced({self.value!r})"

    def __len__(self) -> int:
        return len(self.value)

    def __bool__(self) -> bool:
        return bool(self.value)

    def __float__(self) -> float:
        return float(self.value)

    @property
    def shape(self) -> tuple[int, ...]:
        """Its shape."""
        return self.value.shape

    @property
    def ndim(self) -> int:
        """How many axes it has."""
        return self.value.ndim

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return self.value.size

    def __array__(self, *_: Any, **__: Any) -> Array:
        raise CaromError(
            "a plain array has no derivatives: compute with this one, or take its value", "loss"
        )

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **options: Any) -> Any:
        values = [_value_of(it) for it in inputs]
        if method == "reduce" and ufunc is np.add:
            return inputs[0].sum(**options)
        if method != "__call__" or options:
            raise _unknown(f"numpy.{ufunc.__name__}.{method}")
        if ufunc in _COMPARISONS:
            return ufunc(*values)
        if ufunc not in _DERIVATIVES:
            raise _unknown(f"numpy.{ufunc.__name__}")
        result = ufunc(*values)
        shares = []
        for it, derivative in zip(inputs, _DERIVATIVES[ufunc], strict=True):
            if isinstance(it, Traced):
                factor = np.asarray(derivative(result, *values), dtype=np.float64)
                shares.append((it, _spread_share(factor, it.shape)))
        return Traced(result, tuple(shares))

    def __array_function__(self, function: Any, _: Any, args: Any, options: Any) -> Any:
        if function not in _FUNCTIONS:
            raise _unknown(f"numpy.{function.__name__}")
        return _FUNCTIONS[function](*args, **options)

    def __getitem__(self, key: Any) -> Traced:
        def share(by: Array) -> Array:
            whole = np.zeros(self.shape)
            np.add.at(whole, key, by)
            return whole

        return Traced(self.value[key], ((self, share),))

    def sum(self, axis: Any = None, **options: Any) -> Traced:
        """Sum over all or some axes."""
        keeps = _keeps(options)
        result = self.value.sum(axis=axis, keepdims=True)
        shape = self.shape

        def share(by: Array) -> Array:
            return np.broadcast_to(by.reshape(result.shape), shape)

        return Traced(result if keeps else self.value.sum(axis=axis), ((self, share),))

    def mean(self, axis: Any = None, **options: Any) -> Traced:
        """Mean over all or some axes."""
        total = self.sum(axis, **options)
        mean: Traced = total * (total.size / self.size)
        return mean

    def reshape(self, *shape: Any) -> Traced:
        """The same numbers in another shape."""
        return Traced(self.value.reshape(*shape), ((self, lambda by: by.reshape(self.shape)),))

    def dot(self, other: Any) -> Traced:
        """Sum of the products with the numbers of another row."""
        if self.ndim != 1 or np.ndim(_value_of(other)) != 1:
            raise _unknown("numpy.dot of more than rows")
        product: Traced = (self * other).sum()
        return product

    def derivatives(self, by: tuple[Traced, ...]) -> list[Array]:
        """The derivatives of this, which is one number, by others."""
        known: dict[Traced, Array] = {self: np.ones(self.shape)}
        found: dict[Traced, Array] = {}
        while known:
            latest = max(known, key=lambda it: it._number)
            found[latest] = derivative = known.pop(latest)
            for it, share in latest._made_of:
                known[it] = known[it] + share(derivative) if it in known else share(derivative)
        return [found.get(it, np.zeros(it.shape)) for it in by]

    __hash__ = object.__hash__

    def __matmul__(self, other: Any) -> Traced:
        return self.dot(other)


def _keeps(options: dict[str, Any]) -> bool:
    keeps = bool(options.pop("keepdims", False))
    given = [name for name, value in options.items() if value is not None]
    if given:
        raise _unknown(f"{given[0]} of a sum")
    return keeps


def _value_of(it: Any) -> Any:
    return it.value if isinstance(it, Traced) else it


def _ratio(part: Array, whole: Array) -> Array:
    ratio: Array = part / np.where(whole == 0.0, 1.0, whole)
    return ratio


def _spread_share(factor: Array, shape: tuple[int, ...]) -> Share:
    """Undoes that an array of this shape was spread over a larger one."""

    def share(by: Array) -> Array:
        product: Array = np.asarray(by * factor)
        product = np.asarray(product.sum(axis=tuple(range(product.ndim - len(shape)))))
        narrow = tuple(place for place, size in enumerate(shape) if size == 1)
        return np.asarray(product.sum(axis=narrow, keepdims=True)) if narrow else product

    return share


def _norm(array: Traced, ord: None = None, axis: Any = None, keepdims: bool = False) -> Traced:
    if ord is not None:
        raise _unknown("another norm than that of Euclid")
    square = (array * array).sum(axis, keepdims=keepdims)
    length = np.sqrt(square.value)
    # At zero it has none; 0 is what lies in the middle of all directions.
    return Traced(
        length, ((square, _spread_share(_ratio(np.full_like(length, 0.5), length), square.shape)),)
    )


def _unknown(what: str) -> CaromError:
    return CaromError(f"derivatives are not known of {what}", "loss")


_FUNCTIONS: dict[Any, Callable[..., Any]] = {
    np.sum: lambda array, axis=None, **options: array.sum(axis, **options),
    np.mean: lambda array, axis=None, **options: array.mean(axis, **options),
    np.dot: lambda first, second: (
        first.dot(second) if isinstance(first, Traced) else second.dot(first)
    ),
    np.reshape: lambda array, shape: array.reshape(shape),
    np.linalg.norm: _norm,
    np.shape: lambda array: array.shape,
    np.ndim: lambda array: array.ndim,
}
