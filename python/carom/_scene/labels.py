"""Whole numbers of spheres that forces know nothing of: groups, and data of programs."""

from __future__ import annotations

from operator import index as as_index

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.errors import CaromError

GROUPS = 2**32
"""Values that the bits of all groups can have."""

LABELS = {"groups": GROUPS, "collides_with": GROUPS, "user_data": 2**63}
"""Values that each of them can have; data as far as scene files have whole numbers."""


def whole(name: str, value: object, end: int) -> int:
    """A whole number in [0, end).

    Raises:
        CaromError: If it is outside.
        TypeError: For something else.
    """
    if isinstance(value, (bool, np.bool_)) or not hasattr(value, "__index__"):
        raise TypeError(f"{name}: must be a whole number, not {type(value).__name__}")
    number = as_index(value)
    if not 0 <= number < end:
        raise CaromError(f"{name}: must be in [0, 2^{end.bit_length() - 1}), not {number}", name)
    return number


def labels_of(name: str, values: ArrayLike, count: int) -> NDArray[np.uint64]:
    """A label of all spheres as an array that cannot be written to.

    Raises:
        CaromError: For a shape that does not fit, and for numbers that the label cannot have.
        TypeError: For what are no whole numbers.
    """
    # NumPy would make floating-point numbers of a list with very large whole ones.
    array = values if isinstance(values, np.ndarray) else np.array(values, dtype=object)
    if array.dtype.kind == "O":
        for value in array.ravel().tolist():
            whole(name, value, LABELS[name])
    elif array.dtype.kind not in "iu":
        raise TypeError(f"{name}: must be whole numbers, not {array.dtype}")
    for value in array[(array < 0) | (array >= LABELS[name])].ravel()[:1]:
        whole(name, value, LABELS[name])
    try:
        spread = np.array(np.broadcast_to(array, (count,)), dtype=np.uint64, order="C")
    except ValueError:
        problem = f"must be of shape {(count,)}, not {array.shape}"
        raise CaromError(f"{name}: {problem}", name) from None
    spread.flags.writeable = False
    return spread
