"""Structure, motion and pressure of hard spheres, from the arrays of a run.

>>> import numpy
>>> from carom import analysis
>>> points = numpy.random.default_rng(1).uniform(0, 10, (5, 1000, 3))
>>> found = analysis.radial_distribution(points, (10, 10, 10), r_max=4, bins=4)
>>> bool(abs(found.g - 1).max() < 0.1)
True

Units are those of the arrays, SI for those of Carom. Temperatures are energies kT [J]. Where a
function takes positions or velocities, it takes a `carom.Trajectory`, too. NaN in an array marks a
sphere that is not there, as in a `carom.Trajectory`; every function leaves such spheres out.
What cannot be measured, because nothing is there, is NaN. A value that is invalid raises a
`carom.CaromError` that names the argument; so does a run without the states or impacts that a
function needs. The same arrays have the same results to the bit, whatever the number of threads:
no sum is left to a library of linear algebra, which would divide it among them.
"""

from carom.analysis._bond_order import (
    BondOrder,
    CrystalStructure,
    bond_order,
    crystal_structure,
)
from carom.analysis._clusters import Clusters, clusters, neighbour_pairs
from carom.analysis._collisions import collision_frequency, mean_free_path
from carom.analysis._contacts import contact_network, coordination_numbers, pairs_in_contact
from carom.analysis._correlation import green_kubo_diffusion, velocity_autocorrelation
from carom.analysis._displacement import diffusion_coefficient, mean_square_displacement, unwrap
from carom.analysis._lyapunov import LyapunovSpectrum, lyapunov_spectrum
from carom.analysis._percus_yevick import (
    percus_yevick_radial_distribution,
    percus_yevick_structure_factor,
)
from carom.analysis._pressure import VirialPressure, pressure_from_impacts, virial_pressure
from carom.analysis._radial_distribution import (
    PartialRadialDistribution,
    RadialDistribution,
    partial_radial_distribution,
    radial_distribution,
)
from carom.analysis._speeds import (
    SpeedHistogram,
    maxwell_speed_density,
    speed_histogram,
    temperature,
)
from carom.analysis._state import carnahan_starling, contact_value, enskog_collision_frequency
from carom.analysis._structure_factor import StructureFactor, structure_factor
from carom.analysis._viscosity import (
    StressSeries,
    green_kubo_viscosity,
    infinite_diffusion,
    stress_autocorrelation,
    stress_series,
)
from carom.analysis._voronoi import voronoi_volumes

__all__ = [
    "BondOrder",
    "Clusters",
    "CrystalStructure",
    "LyapunovSpectrum",
    "PartialRadialDistribution",
    "RadialDistribution",
    "SpeedHistogram",
    "StressSeries",
    "StructureFactor",
    "VirialPressure",
    "bond_order",
    "carnahan_starling",
    "clusters",
    "collision_frequency",
    "contact_network",
    "contact_value",
    "coordination_numbers",
    "crystal_structure",
    "diffusion_coefficient",
    "enskog_collision_frequency",
    "green_kubo_diffusion",
    "green_kubo_viscosity",
    "infinite_diffusion",
    "lyapunov_spectrum",
    "maxwell_speed_density",
    "mean_free_path",
    "mean_square_displacement",
    "neighbour_pairs",
    "pairs_in_contact",
    "partial_radial_distribution",
    "percus_yevick_radial_distribution",
    "percus_yevick_structure_factor",
    "pressure_from_impacts",
    "radial_distribution",
    "speed_histogram",
    "stress_autocorrelation",
    "stress_series",
    "structure_factor",
    "temperature",
    "unwrap",
    "velocity_autocorrelation",
    "virial_pressure",
    "voronoi_volumes",
]
