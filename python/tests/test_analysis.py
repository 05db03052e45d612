"""Analysis finds what closed forms, slow sums and published equations say.

Random points and walks have fixed seeds; their tolerances are some four standard errors.
"""

import doctest
import importlib
import importlib.util
import pkgutil
import re
from collections.abc import Callable

import numpy as np
import pytest
from fluids import (
    BOX,
    CUBIC,
    FACE_CENTERED,
    ROOT,
    SIDE,
    Floats,
    hard_spheres,
    lattice,
    random_points,
)

import carom
from carom import analysis

# Structure


def test_points_without_correlations_have_a_flat_radial_distribution() -> None:
    found = analysis.radial_distribution(random_points(20, 500), BOX, r_max=5, bins=20)
    # Each bin counts pairs by Poisson's law; 1/N is missing, for a point has 499 others.
    deviation = (found.g - (1 - 1 / 500)) * np.sqrt(found.pairs) / found.g
    assert np.abs(deviation).max() < 4
    assert (deviation**2).mean() == pytest.approx(1, abs=4 * np.sqrt(2 / 20))


@pytest.mark.parametrize("box", [BOX, (10.0, 11.0, 25.0), (np.inf, 10.0, np.inf), None])
@pytest.mark.parametrize("r_max", [0.5, 3.0, 5.0])
def test_a_cell_list_counts_the_pairs_that_a_double_loop_counts(
    box: tuple[float, ...] | None, r_max: float
) -> None:
    points = random_points(1, 300)
    is_open = box is None or np.isinf(box).any()
    found = analysis.radial_distribution(
        points, box, r_max=r_max, bins=7, volume=1000.0 if is_open else None
    )
    sides = np.array(box or [np.inf] * 3)
    apart = points[0, :, None] - points[0]
    period = np.where(np.isinf(sides), 1e9, sides)
    apart -= period * np.rint(apart / period)
    distances = np.linalg.norm(apart, axis=-1)[np.triu_indices(300, 1)]
    np.testing.assert_array_equal(found.pairs, np.histogram(distances, found.edges)[0])


def test_shells_of_a_cubic_lattice_have_6_12_8_6_24_neighbours() -> None:
    points = lattice(6, CUBIC)
    found = analysis.radial_distribution(points, (6, 6, 6), r_max=2.4, bins=240)
    occupied = np.flatnonzero(found.pairs)
    # The bins of 1, √2, √3, 2 and √5, each 0.01 wide.
    np.testing.assert_allclose(found.r[occupied], np.sqrt(np.arange(1, 6)), atol=0.0051)
    np.testing.assert_array_equal(2 * found.pairs[occupied] / 216, [6, 12, 8, 6, 24])
    assert found.neighbours[-1] == 6 + 12 + 8 + 6 + 24


def test_a_gas_in_the_open_needs_a_volume() -> None:
    with pytest.raises(carom.CaromError, match=r"^volume: is needed") as raised:
        analysis.radial_distribution(random_points(1, 10), r_max=1)
    assert raised.value.field == "volume"
    found = analysis.radial_distribution([[0, 0, 0], [1, 0, 0]], r_max=2, bins=1, volume=8.0)
    # Two of N² = 4 ordered pairs, in a sphere of radius 2.
    assert found.g[0] == pytest.approx(2 * 8 / 4 / (4 / 3 * np.pi * 8), rel=1e-12)


def test_a_lattice_scatters_in_bragg_peaks_alone() -> None:
    cells = 6
    found = analysis.structure_factor(lattice(cells, CUBIC), [cells] * 3, q_max=6.5, bins=650)
    # Of |h|² = 36 are the peaks (6, 0, 0) and permutations, and (4, 4, 2) with all signs: of 30,
    # 6 have S = N, and the others 0.
    peak = np.abs(found.q - 2 * np.pi).argmin()
    assert found.q[peak] == pytest.approx(2 * np.pi, rel=1e-12)
    assert found.vectors[peak] == 15
    assert found.s[peak] == pytest.approx(cells**3 * 6 / 30, rel=1e-9)
    # Phases of 216 points are added; rounding leaves the square of some 1e-14.
    assert np.delete(found.s, peak).max() < 1e-20


def test_points_without_correlations_have_a_structure_factor_of_1() -> None:
    frames = 10
    found = analysis.structure_factor(random_points(frames, 500), BOX, q_max=10, bins=20)
    # S of a wave vector is distributed exponentially: its standard deviation is 1.
    deviation = (found.s - 1) * np.sqrt(found.vectors * frames)
    assert np.abs(deviation).max() < 4
    # All vectors in half of a sphere of radius 10, but for those at its surface: 3 %.
    expected = 4 / 3 * np.pi * 10**3 * SIDE**3 / (2 * np.pi) ** 3 / 2
    assert found.vectors.sum() == pytest.approx(expected, rel=0.03)


def test_the_structure_factor_is_that_of_its_definition() -> None:
    points, box = random_points(1, 40), np.array([10.0, 8.0, 5.0])
    found = analysis.structure_factor(points, box, q_max=3.0, bins=9)
    numbers = np.stack(np.meshgrid(*[np.arange(-5, 6)] * 3, indexing="ij"), -1).reshape(-1, 3)
    q = 2 * np.pi * numbers / box
    power = np.abs(np.exp(-1j * points[0] @ q.T).sum(axis=0)) ** 2 / 40
    lengths = np.linalg.norm(q, axis=1)
    keep = (lengths > 0) & (lengths <= 3.0)
    shell = (lengths[keep] * 3).astype(int)
    count = np.bincount(shell, minlength=9)
    np.testing.assert_array_equal(2 * found.vectors, count[count > 0])
    expected = np.bincount(shell, power[keep], 9)[count > 0] / count[count > 0]
    np.testing.assert_allclose(found.s, expected, rtol=1e-10)


# Motion


def wrapped(paths: Floats) -> Floats:
    return paths - SIDE * np.rint(paths / SIDE)


def flights(frames: int = 60, count: int = 20) -> tuple[Floats, Floats]:
    """Straight flights, and their velocities for frames that are 1 s apart."""
    random = np.random.default_rng(2)
    # Less than half a side in a frame.
    velocities = random.uniform(-4.9, 4.9, (count, 3))
    start = random.uniform(-5, 5, (count, 3))
    return start + np.arange(frames)[:, None, None] * velocities, velocities


def test_unwrapped_flights_are_straight() -> None:
    paths, _ = flights()
    # Rounding of coordinates up to 300.
    np.testing.assert_allclose(analysis.unwrap(wrapped(paths), BOX), paths, atol=1e-12)
    # Along open axes nothing is wrapped.
    np.testing.assert_array_equal(analysis.unwrap(paths, [np.inf] * 3), paths)


def test_ballistic_displacement_is_v2_t2() -> None:
    paths, velocities = flights()
    mean_square = (velocities**2).sum(axis=1).mean()
    found = analysis.mean_square_displacement(wrapped(paths), BOX)
    # 1e-15 of 500², the square of the longest path, and as many terms again.
    np.testing.assert_allclose(found, mean_square * np.arange(60) ** 2, rtol=1e-12, atol=1e-9)


def test_displacement_by_transforms_is_that_of_a_double_sum() -> None:
    paths = np.cumsum(np.random.default_rng(3).standard_normal((50, 30, 3)), axis=0)
    # Some come late, some go early.
    paths[:10, :5], paths[30:, 5:9] = np.nan, np.nan
    found = analysis.mean_square_displacement(paths, lags=45)
    direct = [
        np.nanmean(((paths[lag:] - paths[: len(paths) - lag]) ** 2).sum(axis=2))
        for lag in range(45)
    ]
    # Rounding of squares up to some 1e3.
    np.testing.assert_allclose(found, direct, rtol=1e-11, atol=1e-11)


def test_a_random_walk_diffuses() -> None:
    steps = np.random.default_rng(4).standard_normal((1000, 300, 3))
    msd = analysis.mean_square_displacement(np.cumsum(steps, axis=0), lags=51)
    # A step of variance 1 along each axis in each unit of time: D = 1/2. Standard error: there are
    # 300 · 1000 / 50 walks of 50 steps along each axis, (2 / 18,000)^½ = 1 %.
    diffusion = analysis.diffusion_coefficient(np.arange(51), msd, begin=5)
    assert diffusion == pytest.approx(0.5, rel=0.04)


def test_autocorrelation_by_transforms_is_that_of_a_double_sum() -> None:
    velocities = np.random.default_rng(5).standard_normal((40, 25, 3))
    for gaps in (False, True):
        if gaps:
            velocities[:7, :5], velocities[20:, 5:9] = np.nan, np.nan
        found = analysis.velocity_autocorrelation(velocities)
        direct = [
            np.nanmean((velocities[lag:] * velocities[: len(velocities) - lag]).sum(axis=2))
            for lag in range(40)
        ]
        np.testing.assert_allclose(found, direct, rtol=1e-11, atol=1e-13)


def test_memory_that_decays_exponentially_has_its_integral() -> None:
    time = np.linspace(0, 20, 2001)
    integral = analysis.green_kubo_diffusion(time, 3 * np.exp(-time / 2))
    # kT/m times the relaxation time, 2; of the trapezoidal rule h²/12 τ² is left, 2e-6.
    np.testing.assert_allclose(integral, 2 * (1 - np.exp(-time / 2)), atol=1e-5)


def test_einstein_and_green_kubo_agree() -> None:
    fluid = hard_spheres(frames=1000, dt=0.01)
    time = fluid.run.time - fluid.run.time[0]
    msd = analysis.mean_square_displacement(fluid.run, [fluid.side] * 3, lags=201)
    memory = analysis.velocity_autocorrelation(fluid.run, lags=201)
    green_kubo = analysis.green_kubo_diffusion(time[:201], memory)
    # 20 collisions, until the memory is below 1 %: the integral is half of the slope of the same
    # run's displacement but for 1e-3 of the trapezoidal rule, and for other weights at the ends.
    einstein = analysis.diffusion_coefficient(time[:201], msd, begin=1.5)
    assert einstein == pytest.approx(green_kubo[150:].mean(), rel=0.02)
    # What simulations find by R. J. Speedy, Mol. Phys. 62, 509 (1987). Some 3 % is noise here, and
    # neither is corrected for the size of its box.
    n = 6 * 0.3 / np.pi
    speedy = 3 / 8 / (n * np.sqrt(np.pi)) * (1 - n / 1.09) * (1 + n**2 * (0.4 - 0.83 * n**2))
    assert einstein == pytest.approx(speedy, rel=0.1)


# Contacts


@pytest.mark.parametrize(
    ("basis", "radius", "expected"), [(CUBIC, 0.5, 6), (FACE_CENTERED, np.sqrt(0.125), 12)]
)
def test_lattices_have_6_and_12_contacts(
    basis: list[list[float]], radius: float, expected: int
) -> None:
    points = lattice(4, basis)
    pairs = analysis.contact_network(points, radius, (4, 4, 4), tolerance=1e-12)
    assert len(np.unique(pairs, axis=0)) == len(pairs) == expected * len(points) // 2
    assert (analysis.coordination_numbers(pairs, len(points)) == expected).all()
    # Nothing touches what is a bit smaller, and one that is not there touches none.
    smaller = analysis.contact_network(points, 0.999 * radius, (4, 4, 4), tolerance=1e-12)
    assert smaller.shape == (0, 2)
    points[5] = np.nan
    pairs = analysis.contact_network(points, radius, (4, 4, 4), tolerance=1e-12)
    assert len(pairs) == expected * (len(points) // 2 - 1)
    assert 5 not in pairs


def test_spheres_of_different_sizes_touch_by_both_radii() -> None:
    points = np.array([[0, 0, 0], [3, 0, 0], [3, 1.5, 0], [10, 0, 0]])
    pairs = analysis.contact_network(points, [2, 1, 0.4, 5], tolerance=0.1)
    # Gaps of 0, 0.1, and 2.
    assert pairs.tolist() == [[0, 1], [1, 2]]


def test_contacts_of_a_world_are_those_of_its_positions() -> None:
    spheres = carom.Row(5, start=(0, 0.5, 0), step=(0, 1, 0), sphere=carom.Sphere(radius=0.5))
    floor = carom.Collider(carom.HalfSpace())
    scene = carom.Scene(
        name="stack",
        simulation=carom.Simulation(rule="contact"),
        generators=[spheres],
        colliders=[floor],
        forces=[carom.Gravity((0, -9.81, 0))],
    )
    world = scene.world()
    world.step(frames=5)
    recorded = analysis.pairs_in_contact(world.contacts, world.ids)
    assert recorded.tolist() == [[0, 1], [1, 2], [2, 3], [3, 4]]
    found = analysis.contact_network(world.positions, world.radii, tolerance=0.01)
    assert found.tolist() == recorded.tolist()


# Theory


@pytest.mark.parametrize("p", [0.05, 0.3, 0.45, 0.58])
def test_percus_and_yevick_has_the_compressibility_of_wertheim(p: float) -> None:
    limit = (1 - p) ** 4 / (1 + 2 * p) ** 2
    near = analysis.percus_yevick_structure_factor([0.0, 1e-6], p)
    np.testing.assert_allclose(near, limit, rtol=1e-11)
    # The series and the closed form meet at q = 1; S changes by some 1e-9 over this step.
    both = analysis.percus_yevick_structure_factor([1 - 1e-9, 1 + 1e-9], p)
    assert both[0] == pytest.approx(both[1], rel=1e-8)


@pytest.mark.parametrize("p", [0.05, 0.3, 0.45])
def test_percus_and_yevick_has_the_contact_value_of_wertheim(p: float) -> None:
    g = analysis.percus_yevick_radial_distribution([1.0, 40.0], p)
    assert g[0] == pytest.approx((1 + p / 2) / (1 - p) ** 2, rel=1e-9)
    assert g[1] == 1


def test_structure_factor_and_radial_distribution_of_percus_and_yevick_are_transforms() -> None:
    p, q = 0.4, 7.0
    r = np.linspace(1, 30, 290_001)
    h = analysis.percus_yevick_radial_distribution(r, p) - 1
    density = 6 * p / np.pi
    values = 4 * np.pi * r * h * np.sin(q * r) / q
    beyond = (values.sum() - 0.5 * values[0]) * (r[1] - r[0])
    within = -4 * np.pi * (np.sin(q) - q * np.cos(q)) / q**3
    s = float(analysis.percus_yevick_structure_factor(q, p))
    # g is linear between steps but for 1e-6.
    assert 1 + density * (beyond + within) == pytest.approx(s, abs=1e-4)


def test_few_spheres_per_volume_are_an_ideal_gas() -> None:
    assert analysis.carnahan_starling(0.0) == 1
    np.testing.assert_array_equal(analysis.percus_yevick_structure_factor([0.0, 5.0], 0.0), 1)
    np.testing.assert_array_equal(
        analysis.percus_yevick_radial_distribution([0.5, 2.0], 0.0), [0, 1]
    )
    p = np.array([0.1, 0.3])
    np.testing.assert_allclose(
        analysis.carnahan_starling(p), 1 + 4 * p * analysis.contact_value(p), rtol=1e-14
    )


# Nothing, and nonsense


def test_nothing_is_measured_as_nan_and_warns_of_nothing() -> None:
    for empty in (np.zeros((0, 0, 3)), np.zeros((3, 0, 3)), np.full((3, 2, 3), np.nan)):
        assert np.isnan(analysis.radial_distribution(empty, BOX, r_max=2).g).all()
        assert np.isnan(analysis.structure_factor(empty, BOX, q_max=2).s).all()
        assert np.isnan(analysis.mean_square_displacement(empty, BOX)).all()
        assert np.isnan(analysis.velocity_autocorrelation(empty)).all()
        assert np.isnan(analysis.temperature(empty, 1.0)).all()
        assert np.isnan(analysis.speed_histogram(empty, 1.0).density).all()
        assert np.isnan(analysis.mean_free_path(empty, 1.0))
        assert analysis.unwrap(empty, BOX).shape == empty.shape
    nothing = analysis.contact_network(np.zeros((0, 3)), 1.0, tolerance=0.0)
    assert nothing.shape == (0, 2)
    assert analysis.coordination_numbers(nothing, 0).shape == (0,)
    run = carom.World().run(frames=2, dt=0.1)
    assert np.isnan(analysis.virial_pressure(run, 1.0).pressure)
    assert np.isnan(analysis.collision_frequency(run))


POINTS = np.zeros((2, 3, 3))
REFUSED: list[tuple[str, Callable[[], object]]] = [
    ("r_max", lambda: analysis.radial_distribution(POINTS, BOX, r_max=5.1)),
    ("r_max", lambda: analysis.radial_distribution(POINTS, BOX, r_max=np.nan)),
    ("bins", lambda: analysis.radial_distribution(POINTS, BOX, r_max=1, bins=0)),
    ("box", lambda: analysis.radial_distribution(POINTS, (1, 2), r_max=1)),
    ("box", lambda: analysis.radial_distribution(POINTS, (1, 2, -1), r_max=1)),
    ("volume", lambda: analysis.radial_distribution(POINTS, BOX, r_max=1, volume=1.0)),
    ("positions", lambda: analysis.radial_distribution([1, 2, 3], BOX, r_max=1)),
    ("positions", lambda: analysis.radial_distribution([[np.inf, 0, 0]], BOX, r_max=1)),
    ("positions", lambda: analysis.radial_distribution(np.array([["a", "b", "c"]]), BOX, r_max=1)),
    ("box", lambda: analysis.structure_factor(POINTS, (1, 1, np.inf), q_max=9)),
    ("q_max", lambda: analysis.structure_factor(POINTS, BOX, q_max=0.1)),
    ("positions", lambda: analysis.unwrap(POINTS[0], BOX)),
    ("lags", lambda: analysis.mean_square_displacement(POINTS, lags=3)),
    ("msd", lambda: analysis.diffusion_coefficient([0, 1], [0, 1, 2])),
    ("time", lambda: analysis.diffusion_coefficient([0, 0], [0, 1])),
    ("begin", lambda: analysis.diffusion_coefficient([0, 1], [0, 1], begin=1)),
    ("dimensions", lambda: analysis.diffusion_coefficient([0, 1], [0, 1], dimensions=4)),
    ("autocorrelation", lambda: analysis.green_kubo_diffusion([0, 1], [1])),
    ("impacts", lambda: analysis.collision_frequency(np.zeros(3, [("a", "f8")]), 1, 1.0)),
    ("count", lambda: analysis.collision_frequency(np.zeros(1, carom.IMPACT), duration=1.0)),
    ("frequency", lambda: analysis.mean_free_path(POINTS, 0.0)),
    ("masses", lambda: analysis.temperature(POINTS, [1.0, 2.0])),
    ("radii", lambda: analysis.contact_network(POINTS[0], -1.0, tolerance=0)),
    ("tolerance", lambda: analysis.contact_network(POINTS[0], 1.0, tolerance=-1)),
    ("box", lambda: analysis.contact_network(POINTS[0], 1.0, (3, 9, 9), tolerance=0)),
    ("ids", lambda: analysis.pairs_in_contact(np.zeros(1, carom.CONTACT), [1, 2])),
    ("pairs", lambda: analysis.coordination_numbers([[0, 3]], 3)),
    ("packing_fraction", lambda: analysis.carnahan_starling([0.1, 1.0])),
    ("packing_fraction", lambda: analysis.percus_yevick_radial_distribution(1.0, 0.7)),
    ("diameter", lambda: analysis.percus_yevick_structure_factor(1.0, 0.1, diameter=0)),
]


@pytest.mark.parametrize(("field", "call"), REFUSED)
def test_what_makes_no_sense_is_refused_by_name(field: str, call: Callable[[], object]) -> None:
    with pytest.raises(carom.CaromError, match=rf"^{field}: ") as raised:
        call()
    assert raised.value.field == field


def test_the_examples_of_the_documentation_are_true() -> None:
    names = [it.name for it in pkgutil.iter_modules(analysis.__path__)]
    modules = [analysis] + [importlib.import_module(f"carom.analysis.{name}") for name in names]
    results = [doctest.testmod(module) for module in modules]
    assert sum(it.failed for it in results) == 0
    assert sum(it.attempted for it in results) > 20


def test_each_block_of_the_page_runs_by_itself() -> None:
    text = (ROOT / "docs/analysis.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    for block in blocks:
        exec(block, {})


def test_the_page_names_every_function() -> None:
    text = (ROOT / "docs/analysis.md").read_text(encoding="utf-8")
    functions = [name for name in analysis.__all__ if name[0].islower()]
    is_named = {name: f"`{name}(" in text or f"`{name}`" in text for name in functions}
    assert [name for name, named in is_named.items() if not named] == []


def test_the_example_finds_the_structure_of_percus_and_yevick() -> None:
    specification = importlib.util.spec_from_file_location(
        "hard_sphere_structure", ROOT / "python/examples/hard_sphere_structure.py"
    )
    assert specification is not None
    assert specification.loader is not None
    it = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(it)
    found = it.structure(0.3, cells=8, states=20)
    beyond = found.r > 1.1
    # The theory is wrong by 0.03; 20 states of 512 spheres add some 0.03 of noise.
    assert np.abs(found.g - it.bin_means(found.edges, 0.3))[beyond].max() < 0.13
    t, mean, _ = it.memory(cells=6, collisions=1)
    # The first collision leaves exp(-2/3) by Enskog; others before it, less.
    assert mean[0] == 1
    assert mean[it.PER_COLLISION] == pytest.approx(np.exp(-2 / 3), abs=0.03)
    assert it.tail(4 * t[-1:], 0.3) == pytest.approx(it.tail(t[-1:], 0.3) / 8, rel=1e-12)
