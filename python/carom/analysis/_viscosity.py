"""Shear viscosity by the fluctuations of the stress, and what it corrects."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom._run.stress import StressMeter
from carom._run.world import World
from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats
from carom.analysis._lags import correlate
from carom.errors import CaromError

_CUBIC = 2.837297
"""Of the lattice sum of a cubic box: Yeh and Hummer."""


class StressSeries(NamedTuple):
    """The mean stress of each of many frames."""

    time: Floats
    """Ends of frames on the world's clock [s], shape (t,)."""
    stress: Floats
    """Mean stress of each frame [Pa], shape (t, 3, 3)."""


def stress_series(
    world: World, *, frames: int, dt: float | None = None, volume: float | None = None
) -> StressSeries:
    """Advances a world, and measures the mean stress of each frame.

    Args:
        world: The world.
        frames: How many frames.
        dt: Length of a frame [s]; the world's own unless given.
        volume: Volume of the spheres [m³]; that of the periodic box or of the first closed
            container unless given.

    Returns:
        The stress of each frame, as `carom.StressMeter` has it.

    Raises:
        CaromError: For a value that is invalid.
        StepError: If a frame cannot be taken; the frames before are.
    """
    if arguments.whole(frames, "frames") < 0:
        raise CaromError(f"frames: must be >= 0, not {frames}", "frames")
    time, stress = np.empty(frames), np.empty((frames, 3, 3))
    for frame in range(frames):
        meter = StressMeter(world)
        meter.step(dt=dt)
        time[frame], stress[frame] = world.time, meter.stress(volume).total
    return StressSeries(time, stress)


def stress_autocorrelation(stress: ArrayLike, *, lags: int | None = None) -> Floats:
    """The autocorrelation of the shear stress over the lag, averaged over all time origins.

    ``<P(t0) : P(t0 + t)> / 10``, with P the symmetric part of the stress without its trace, so that
    all of its components count: P. J. Daivis and D. J. Evans, J. Chem. Phys. 100, 541 (1994). In an
    isotropic fluid it is that of one component off the diagonal.

    Args:
        stress: Mean stress of frames that follow each other [Pa], shape (t, 3, 3), from
            `stress_series`.
        lags: How many lags, from 0; as many as there are frames unless given.

    Returns:
        Autocorrelation [Pa²] at lags of 0, 1, 2, ... frames, shape (lags,).

    Raises:
        CaromError: For a value that is invalid.

    >>> import numpy
    >>> from carom import analysis
    >>> shear = numpy.zeros((3, 3, 3))
    >>> shear[:, 0, 1] = shear[:, 1, 0] = (5.0, -5.0, 5.0)
    >>> analysis.stress_autocorrelation(shear).round(9).tolist()
    [5.0, -5.0, 5.0]
    """
    tensors = arguments.floats(stress, "stress")
    if tensors.ndim != 3 or tensors.shape[1:] != (3, 3):
        raise CaromError(f"stress: must have the shape (t, 3, 3), not {tensors.shape}", "stress")
    if not np.isfinite(tensors).all():
        raise CaromError("stress: must be finite", "stress")
    count = arguments.lag_count(lags, len(tensors))
    if not len(tensors):
        return np.zeros(0)
    pressure = (tensors[:, 0, 0] + tensors[:, 1, 1] + tensors[:, 2, 2]) / 3
    shear = 0.5 * (tensors + tensors.transpose(0, 2, 1)) - pressure[:, None, None] * np.eye(3)
    sums = correlate(shear.reshape(-1, 9), shear.reshape(-1, 9), count)
    correlation: Floats = sums / (10 * (len(tensors) - np.arange(count)))
    return correlation


def green_kubo_viscosity(
    time: ArrayLike, autocorrelation: ArrayLike, *, volume: float, temperature: float
) -> Floats:
    """The shear viscosity by the integral of Green and Kubo, up to each lag.

    ``η(t) = V / kT ∫_0^t C(s) ds`` by the trapezoidal rule, with C from `stress_autocorrelation`:
    M. P. Allen and D. J. Tildesley, Computer Simulation of Liquids, 2nd ed. (2017), section 2.7.
    Impacts make the stress of hard spheres a row of pulses. Of means over frames the rule gives
    what the displacement of momentum gives at the ends of frames (Helfand, Phys. Rev. 119, 1,
    1960), pulses included, whatever the length of frames.

    Args:
        time: Lags [s], from 0, shape (t,).
        autocorrelation: Autocorrelation of the stress at them [Pa²], shape (t,).
        volume: Of the spheres [m³].
        temperature: kT [J].

    Returns:
        Viscosity up to each lag [Pa s], shape (t,).

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> viscosity = analysis.green_kubo_viscosity([0, 1, 2], [2, 1, 0], volume=3, temperature=2)
    >>> viscosity.tolist()
    [0.0, 2.25, 3.0]
    """
    times, values = arguments.same_shape(time, autocorrelation, "autocorrelation")
    factor = arguments.positive(volume, "volume") / arguments.positive(temperature, "temperature")
    integral = np.zeros(len(times))
    integral[1:] = factor * np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(times))
    return integral


def infinite_diffusion(
    diffusion: ArrayLike, *, side: float, viscosity: float, temperature: float
) -> Floats:
    """The self-diffusion coefficient of an infinite fluid, from that of a cubic periodic box.

    ``D = D_L + 2.837297 kT / (6π η L)``: B. Dünweg and K. Kremer, J. Chem. Phys. 99, 6983 (1993);
    I.-C. Yeh and G. Hummer, J. Phys. Chem. B 108, 15873 (2004). What is left falls with the volume
    of the box.

    Args:
        diffusion: D_L in the box [m²/s], any shape.
        side: L, side of the box [m].
        viscosity: η, shear viscosity [Pa s].
        temperature: kT [J].

    Returns:
        D [m²/s], of the shape of ``diffusion``.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> float(analysis.infinite_diffusion(0.203, side=24.1, viscosity=2.0, temperature=1).round(5))
    0.20612
    """
    side = arguments.positive(side, "side")
    viscosity = arguments.positive(viscosity, "viscosity")
    energy = arguments.positive(temperature, "temperature")
    found: Floats = arguments.floats(diffusion, "diffusion") + _CUBIC * energy / (
        6 * np.pi * viscosity * side
    )
    return found
