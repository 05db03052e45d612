"""Sums over all pairs of states that are a lag apart."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from carom.analysis._arguments import Floats

_BLOCK = 1 << 21
"""Numbers that are transformed at once, about: 32 MiB of complex ones."""


def blocks(paths: Floats) -> Iterator[Floats]:
    """The paths of some spheres at a time, so that transforms need little memory."""
    width = max(1, _BLOCK // max(6 * len(paths), 1))
    for begin in range(0, paths.shape[1] if len(paths) else 0, width):
        yield paths[:, begin : begin + width]


def correlate(early: Floats, late: Floats, lags: int) -> Floats:
    """``Σ early(t0) late(t0 + lag)`` over all time origins t0 and all further axes.

    By Fourier transforms of twice the length, filled up with zeros, so that the end does not meet
    the beginning. Time is the first axis of both.
    """
    length = 1 << (2 * len(early) - 1).bit_length()
    one = np.fft.rfft(early, length, axis=0)
    other = one if late is early else np.fft.rfft(late, length, axis=0)
    spectrum = (one.conj() * other).reshape(len(one), -1).sum(axis=1)
    sums: Floats = np.fft.irfft(spectrum, length)[:lags]
    return sums
