"""Analysis of runs finds what theory and their own records say of a fluid of hard spheres.

Their tolerances are some four standard errors.
"""

import os
import subprocess
import sys

import numpy as np
import pytest
from fluids import Fluid, hard_spheres

import carom
from carom import analysis


@pytest.fixture(scope="module")
def fluid() -> Fluid:
    """A run over 100 collisions of each sphere: 50,000 impacts."""
    return hard_spheres(frames=200, dt=0.05)


# Collisions


def test_pressure_is_that_of_carnahan_and_starling(fluid: Fluid) -> None:
    found = analysis.virial_pressure(fluid.run, fluid.side**3)
    # 50,000 impacts: 0.45 % is a standard error of Z - 1; 0.1 % are missing with 1,000 spheres.
    assert found.impacts == pytest.approx(50_000, rel=0.02)
    assert found.compressibility - 1 == pytest.approx(analysis.carnahan_starling(0.3) - 1, rel=0.02)
    # p = Z N kT / V.
    assert found.pressure == pytest.approx(found.compressibility * 1000 / fluid.side**3, rel=1e-9)


def test_pressure_from_records_is_that_of_the_run(fluid: Fluid) -> None:
    run = fluid.run
    found = analysis.pressure_from_impacts(
        run.impacts,
        center_distance=1.0,
        kinetic_energy=1500.0,
        duration=run.time[-1] - run.time[0],
        volume=fluid.side**3,
    )
    whole = analysis.virial_pressure(run, fluid.side**3)
    # Rounding of a sum of 50,000 impulses, and of energy over as many impacts.
    assert found.compressibility == pytest.approx(whole.compressibility, rel=1e-9)


def test_a_pair_of_different_spheres_presses_by_the_distance_of_their_centres() -> None:
    # They meet head on, once, when their surfaces touch.
    spheres = [
        carom.Sphere(position=(-2, 0, 0), velocity=(1, 0, 0), radius=0.5, mass=1.0),
        carom.Sphere(position=(2, 0, 0), velocity=(-1, 0, 0), radius=1.0, mass=1.0),
    ]
    scene = carom.Scene(name="pair", simulation=carom.Simulation(), spheres=spheres)
    run = scene.world().run(frames=20, dt=0.1)
    found = analysis.virial_pressure(run, 10.0)
    # Σ r J / (2 K t): distance 1.5, impulse 2, K = 1, t = 2.
    assert found.compressibility == pytest.approx(1 + 1.5 * 2 / (2 * 1 * 2), rel=1e-12)
    assert found.impacts == 1


def test_contact_value_is_that_of_carnahan_and_starling(fluid: Fluid) -> None:
    found = analysis.radial_distribution(fluid.run, [fluid.side] * 3, r_max=1.2, bins=120)
    assert found.pairs[:99].sum() == 0
    # Extrapolated from the ten bins beyond contact by a parabola. Of 40,000 pairs in each bin, a
    # part is independent: some 1 % is a standard error of what is extrapolated.
    line = np.polynomial.Polynomial.fit(found.r[100:] - 1, found.g[100:], 2)
    assert line(0) == pytest.approx(analysis.contact_value(0.3), rel=0.04)


def test_radial_distribution_is_nearly_that_of_percus_and_yevick(fluid: Fluid) -> None:
    few = fluid.run.positions[::10]
    found = analysis.radial_distribution(few, [fluid.side] * 3, r_max=3.5, bins=70)
    beyond = found.r > 1.2
    theory = analysis.percus_yevick_radial_distribution(found.r[beyond], 0.3)
    # The theory is wrong by some 0.03 near the first peak and minimum: Verlet and Weis (1972).
    np.testing.assert_allclose(found.g[beyond], theory, atol=0.05)


def test_structure_factor_is_nearly_that_of_percus_and_yevick(fluid: Fluid) -> None:
    few = fluid.run.positions[::40]
    found = analysis.structure_factor(few, [fluid.side] * 3, q_max=12.0, bins=30)
    theory = analysis.percus_yevick_structure_factor(found.q, 0.3)
    # The standard error is S (frames · vectors)^-½; shells average over their width.
    error = theory / np.sqrt(len(few) * found.vectors)
    assert (np.abs(found.s - theory) < 4 * error + 0.04).all()


def test_spheres_collide_as_often_as_enskog_says(fluid: Fluid) -> None:
    found = analysis.collision_frequency(fluid.run)
    # 50,000 impacts: 0.45 %, and the error of the contact value of 0.3 %.
    assert found == pytest.approx(float(analysis.enskog_collision_frequency(0.3)), rel=0.02)
    duration = float(fluid.run.time[-1] - fluid.run.time[0])
    assert analysis.collision_frequency(fluid.run.impacts, 1000, duration) == found
    # The mean speed is (8/π)^½; λ = 1 / (√2 π n g).
    path = analysis.mean_free_path(fluid.run, found)
    g, density = float(analysis.contact_value(0.3)), 6 * 0.3 / np.pi
    assert path == pytest.approx(1 / (np.sqrt(2) * np.pi * density * g), rel=0.02)


def test_impacts_with_colliders_are_no_collisions_of_spheres() -> None:
    impacts = np.zeros(5, carom.IMPACT)
    impacts["sphere_1"] = [-1, 0, -1, 1, -1]
    assert analysis.collision_frequency(impacts, count=4, duration=1.0) == 1.0


# Speeds


def test_speeds_in_equilibrium_are_those_of_maxwell(fluid: Fluid) -> None:
    found = analysis.speed_histogram(fluid.run, fluid.run.masses, bins=25)
    assert found.temperature == pytest.approx(1, rel=1e-9)
    assert found.counts.sum() == 1000 * len(fluid.run)
    # Each sphere has some 70 independent speeds of 201: χ² of 20 bins that are not nearly empty.
    expected = found.maxwell * np.diff(found.edges) * 70_000
    chi_squared = (((found.density - found.maxwell) / found.maxwell) ** 2 * expected)[:20].sum()
    assert chi_squared < 20 + 4 * np.sqrt(40)


def test_density_of_maxwell_has_its_moments() -> None:
    speed = np.linspace(0, 40, 40_001)
    density = analysis.maxwell_speed_density(speed, mass=0.5, temperature=3.0)
    step = speed[1]
    # By the trapezoidal rule, exact but for rounding: the density and its slope vanish at the ends.
    assert density.sum() * step == pytest.approx(1, rel=1e-9)
    assert (density * speed**2).sum() * step == pytest.approx(3 * 3.0 / 0.5, rel=1e-9)


def test_a_mixture_has_the_mean_of_the_densities_of_maxwell() -> None:
    random = np.random.default_rng(6)
    masses = np.repeat([1.0, 9.0], 50_000)
    velocities = random.standard_normal((100_000, 3)) * np.sqrt(2.0 / masses)[:, None]
    found = analysis.speed_histogram(velocities, masses, bins=30)
    assert found.temperature == pytest.approx(2, rel=4 * np.sqrt(2 / 300_000))
    errors = np.sqrt(np.maximum(found.counts, 1)) / (100_000 * np.diff(found.edges))
    # A bin with none has an error of one.
    assert (np.abs(found.density - found.maxwell) < 4 * errors).all()


def test_a_run_that_did_not_record_a_quantity_says_so() -> None:
    run = carom.load("tutorial1").run(frames=3, quantities=["positions"])
    with pytest.raises(carom.CaromError, match="velocities: were not recorded by the run"):
        analysis.velocity_autocorrelation(run)
    analysis.mean_square_displacement(run)


def test_impacts_after_the_last_recorded_state_do_not_count() -> None:
    lattice = carom.Lattice([6] * 3, [0.0] * 3, [1.2] * 3, carom.Sphere(diameter=1.0, mass=1.0))
    simulation = carom.Simulation(boundary=carom.Periodic([7.2] * 3))
    world = carom.Scene(name="fluid", simulation=simulation, generators=[lattice]).world()
    world.velocities = np.random.default_rng(1).standard_normal((216, 3))
    snapshot = world.snapshot()
    run = world.run(frames=199, dt=0.02, every=100)
    world.restore(snapshot)
    same = world.run(frames=100, dt=0.02, every=100)
    one, other = (analysis.virial_pressure(it, volume=7.2**3) for it in (run, same))
    assert one == other
    assert analysis.collision_frequency(run) == analysis.collision_frequency(same)


def test_a_run_whose_states_span_no_time_has_no_rate() -> None:
    run = carom.load("gas").run(frames=0)
    with pytest.raises(carom.CaromError, match=r"^run: its one recorded state spans no time"):
        analysis.virial_pressure(run, volume=1.0)
    with pytest.raises(carom.CaromError, match=r"^impacts: its one recorded state spans no time"):
        analysis.collision_frequency(run)


HASH = """
import hashlib, sys
import numpy as np
import carom
from carom import analysis

numbers = np.random.default_rng(1)
box = (10.0, 10.0, 10.0)
points = numbers.uniform(0, 10, (3, 3000, 3))
impacts = np.zeros(100_000, carom.IMPACT)
impacts["impulse"] = numbers.uniform(0, 1, len(impacts))
time = np.arange(100_000.0)
run = carom.Trajectory(
    time=np.arange(3.0),
    ids=np.arange(3000, dtype=np.uint64),
    radii=np.full(3000, 0.1),
    masses=numbers.uniform(1, 2, 3000),
    impacts=impacts[:0],
    positions=points,
    velocities=points,
)
results = [
    analysis.radial_distribution(points, box, r_max=4).g,
    analysis.structure_factor(points, box, q_max=6).s,
    analysis.mean_square_displacement(points, box),
    analysis.velocity_autocorrelation(points),
    analysis.diffusion_coefficient(time, time + numbers.uniform(0, 1, len(time))),
    analysis.green_kubo_diffusion(time, numbers.uniform(0, 1, len(time))),
    analysis.temperature(points, numbers.uniform(1, 2, 3000)),
    analysis.temperature(numbers.uniform(0, 1, (2, 200_000, 3)), numbers.uniform(1, 2, 200_000)),
    analysis.speed_histogram(points, 1.0).maxwell,
    analysis.mean_free_path(points, 1.0),
    analysis.virial_pressure(run, 1000.0).pressure,
    analysis.pressure_from_impacts(
        impacts,
        center_distance=numbers.uniform(0.5, 1, len(impacts)),
        kinetic_energy=1.0,
        duration=1.0,
        volume=1.0,
    ).pressure,
    analysis.percus_yevick_radial_distribution(np.linspace(1, 4, 100), 0.3),
]
one, kinds = points[0], np.arange(3000) % 2
stress = numbers.standard_normal((5000, 3, 3))
pairs = analysis.neighbour_pairs(one, box, distance=0.8)
results += [
    analysis.partial_radial_distribution(points, kinds, box, r_max=4).g,
    analysis.bond_order(one, box, nearest=12, averaged=True).local,
    analysis.crystal_structure(one, box, distance=1.2),
    analysis.voronoi_volumes(one[:300], box),
    analysis.clusters(pairs, 3000).sizes,
    analysis.coordination_numbers(pairs, 3000),
    analysis.stress_autocorrelation(stress, lags=100),
    analysis.green_kubo_viscosity(time[:100], stress[:100, 0, 0], volume=10.0, temperature=1.0),
    analysis.infinite_diffusion(stress, side=10.0, viscosity=1.0, temperature=1.0),
]
for result in results:
    print(hashlib.sha256(np.asarray(result).tobytes()).hexdigest())
"""


def test_results_have_the_same_bits_whatever_the_number_of_threads() -> None:
    # Where a library of linear algebra takes sums, it divides them among its threads.
    names = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")
    one, two = (
        subprocess.run(
            [sys.executable, "-c", HASH],
            env={**os.environ, **dict.fromkeys(names, threads)},
            capture_output=True,
            check=True,
            text=True,
        ).stdout.split()
        for threads in ("1", "2")
    )
    assert one == two
    assert len(one) == 22


def test_a_box_is_the_boundary_of_a_scene_too() -> None:
    paths = np.array([[[9.0, 0, 0]], [[1.0, 0, 0]]])
    of_sides = analysis.unwrap(paths, [10.0, 10.0, 10.0])
    of_boundary = analysis.unwrap(paths, carom.Periodic((10.0, 10.0, 10.0)))
    assert of_boundary.tolist() == of_sides.tolist() == [[[9, 0, 0]], [[11, 0, 0]]]
