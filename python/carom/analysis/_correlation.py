"""How long velocities are remembered."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom._run.trajectory import Trajectory
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.analysis._lags import blocks, correlate


def velocity_autocorrelation(
    velocities: Trajectory | ArrayLike, *, lags: int | None = None
) -> Floats:
    """The velocity autocorrelation over the lag, averaged over spheres and all time origins.

    ``<v(t0 + t)·v(t0)>``, all origins at once by Fourier transforms: M. P. Allen and D. J.
    Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), section 8.3. At lag 0 it is the mean
    square speed. Frames must be equally far apart in time.

    Args:
        velocities: Velocities [m/s], shape (t, n, 3), or a run.
        lags: How many lags, from 0; as many as there are frames unless given.

    Returns:
        Autocorrelation [m²/s²] at lags of 0, 1, 2, ... frames, shape (lags,); NaN where no sphere
        is there at both ends of a lag.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> to_and_fro = [[[2, 0, 0]], [[-2, 0, 0]], [[2, 0, 0]]]
    >>> analysis.velocity_autocorrelation(to_and_fro).round(9).tolist()
    [4.0, -4.0, 4.0]
    """
    paths = arguments.path(velocities, "velocities")
    count = arguments.lag_count(lags, len(paths))
    sums, samples = np.zeros(count), np.zeros(count)
    for block in blocks(paths):
        there = arguments.is_there(block)
        known = np.where(there[:, :, None], block, 0.0)
        sums += correlate(known, known, count)
        if there.all():
            samples += there.shape[1] * (len(paths) - np.arange(count))
        else:
            weights = there.astype(np.float64)
            samples += np.rint(correlate(weights, weights, count))
    with np.errstate(invalid="ignore"):
        return np.where(samples > 0, sums / samples, np.nan)


def green_kubo_diffusion(time: ArrayLike, autocorrelation: ArrayLike) -> Floats:
    """The self-diffusion coefficient by the integral of Green and Kubo, up to each lag.

    ``D(t) = 1/3 ∫_0^t <v(s)·v(0)> ds`` by the trapezoidal rule: D. Frenkel and B. Smit,
    Understanding Molecular Simulation, 2nd ed. (2002), section 4.4. It is the diffusion coefficient
    where it no longer grows: that of the periodic box, as in `diffusion_coefficient`.

    Args:
        time: Lags [s], from 0, shape (t,).
        autocorrelation: Velocity autocorrelation at them [m²/s²], shape (t,).

    Returns:
        Integral up to each lag [m²/s], shape (t,).

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> analysis.green_kubo_diffusion([0, 1, 2], [3, 1.5, 0]).tolist()
    [0.0, 0.75, 1.0]
    """
    times, values = arguments.same_shape(time, autocorrelation, "autocorrelation")
    integral = np.zeros(len(times))
    integral[1:] = np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(times)) / 3
    return integral
