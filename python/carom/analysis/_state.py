"""Hard spheres in equilibrium: pressure, contact and collisions, by theory."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from carom.analysis import _arguments as arguments
from carom.analysis._arguments import Floats


def carnahan_starling(packing_fraction: ArrayLike) -> Floats:
    """The compressibility factor Z = pV/(NkT) of the hard-sphere fluid.

    ``(1 + η + η² - η³) / (1 - η)³``: N. F. Carnahan and K. E. Starling, J. Chem. Phys. 51, 635
    (1969). Simulations agree within 0.3 % up to freezing, at η = 0.494.

    Args:
        packing_fraction: η, volume of the spheres over that of the box, in [0, 1), any shape.

    Returns:
        Z, of the shape of ``packing_fraction``.

    Raises:
        CaromError: For a packing fraction out of range.

    >>> from carom import analysis
    >>> float(analysis.carnahan_starling(0.3).round(4))
    3.9738
    """
    p = arguments.packing(packing_fraction)
    z: Floats = (1 + p + p**2 - p**3) / (1 - p) ** 3
    return z


def contact_value(packing_fraction: ArrayLike) -> Floats:
    """The radial distribution function at contact, by the equation of Carnahan and Starling.

    ``g(σ) = (1 - η/2) / (1 - η)³``, from ``Z = 1 + 4 η g(σ)``: J.-P. Hansen and I. R. McDonald,
    Theory of Simple Liquids, 4th ed. (2013), section 2.5.

    Args:
        packing_fraction: η, in [0, 1), any shape.

    Returns:
        g(σ), of the shape of ``packing_fraction``.

    Raises:
        CaromError: For a packing fraction out of range.

    >>> from carom import analysis
    >>> float(analysis.contact_value(0.3).round(4))
    2.4781
    """
    p = arguments.packing(packing_fraction)
    g: Floats = (1 - 0.5 * p) / (1 - p) ** 3
    return g


def enskog_collision_frequency(
    packing_fraction: ArrayLike,
    *,
    diameter: float = 1.0,
    mass: float = 1.0,
    temperature: float = 1.0,
) -> Floats:
    """How often a sphere collides with others in equilibrium, by Enskog's theory.

    ``4 n σ² g(σ) sqrt(π kT / m)``, with n the number density, and ``g(σ)`` from `contact_value`: S.
    Chapman and T. G. Cowling, The Mathematical Theory of Non-Uniform Gases, 3rd ed. (1970), chapter
    16. In equilibrium this is exact but for ``g(σ)``.

    Args:
        packing_fraction: η, in [0, 1), any shape.
        diameter: σ [m].
        mass: m [kg].
        temperature: kT [J].

    Returns:
        Collisions of a sphere in a second [1/s], of the shape of ``packing_fraction``.

    Raises:
        CaromError: For a value that is invalid.

    >>> from carom import analysis
    >>> float(analysis.enskog_collision_frequency(0.3).round(3))
    10.067
    """
    p = arguments.packing(packing_fraction)
    size = arguments.positive(diameter, "diameter")
    ratio = arguments.positive(temperature, "temperature") / arguments.positive(mass, "mass")
    density = 6 * p / (np.pi * size**3)
    frequency: Floats = 4 * density * size**2 * contact_value(p) * np.sqrt(np.pi * ratio)
    return frequency
