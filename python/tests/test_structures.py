"""Order, structures, clusters, cells and viscosity: what closed forms say of lattices and noise."""

from __future__ import annotations

import numpy as np
import pytest
from fluids import BOX, FACE_CENTERED, SIDE, Floats, hard_spheres, lattice, random_points

import carom
from carom import analysis
from carom.analysis import CrystalStructure

BODY_CENTERED = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.5]]


def hexagonal(cells: int) -> tuple[Floats, list[float]]:
    """Hexagonal close packing of diameter 1 in orthogonal cells of four."""
    sides = np.array([1, np.sqrt(3), np.sqrt(8 / 3)])
    basis = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 1 / 6, 0.5], [0.0, 2 / 3, 0.5]]
    return lattice(cells, basis) * sides, (cells * sides).tolist()


def face_centered(cells: int) -> tuple[Floats, list[float]]:
    return lattice(cells, FACE_CENTERED), [float(cells)] * 3


@pytest.mark.parametrize("averaged", [False, True])
def test_orders_of_close_packings_are_those_of_steinhardt(averaged: bool) -> None:
    # Mickel et al., J. Chem. Phys. 138, 044501 (2013), table I, has five digits of each.
    expected = {face_centered: (0.19094, 0.57452), hexagonal: (0.09722, 0.48476)}
    for make, values in expected.items():
        points, sides = make(4)
        for degree, value in zip((4, 6), values, strict=True):
            found = analysis.bond_order(points, sides, degree=degree, averaged=averaged)
            # Both sites of hcp are images of each other, which even degrees do not tell apart.
            np.testing.assert_allclose(found.local, value, atol=5e-6)
            assert found.total == pytest.approx(value, abs=5e-6)
            distance = 0.85 if make is face_centered else 1.2
            by_distance = analysis.bond_order(
                points, sides, degree=degree, averaged=averaged, distance=distance
            )
            np.testing.assert_allclose(by_distance.local, found.local, atol=1e-12)


def test_order_of_a_fluid_is_low_and_falls_with_the_number_of_bonds() -> None:
    points = random_points(1, 2000)[0]
    found = analysis.bond_order(points, BOX, nearest=12)
    # 24,000 bonds, each counted from both ends: Q² is 1 over their independent number, so that
    # Q is 0.009, with the distribution of 13 squares.
    assert found.total < 0.03
    assert found.local.mean() < 0.4


def test_order_does_not_change_as_space_turns_or_grows() -> None:
    points = random_points(1, 60)[0]
    # A turn about an axis by quaternion (0.5, 0.5, 0.5, 0.5): x to y to z.
    one = analysis.bond_order(points, nearest=9, degree=5)
    other = analysis.bond_order(1e-6 * points[:, [2, 0, 1]], nearest=9, degree=5)
    np.testing.assert_allclose(one.local, other.local, rtol=1e-11)
    assert one.total == pytest.approx(other.total, rel=1e-11)


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_every_sphere_of_a_crystal_has_its_structure(noise: float) -> None:
    cubic = lattice(5, BODY_CENTERED), [5.0] * 3
    for (points, sides), name, distance in (
        (face_centered(4), CrystalStructure.FCC, 0.85),
        (hexagonal(5), CrystalStructure.HCP, 1.2),
        (cubic, CrystalStructure.BCC, 1.2),
    ):
        shaken = points + noise * np.random.default_rng(3).uniform(-1, 1, points.shape)
        assert (analysis.crystal_structure(shaken, sides) == name).all()
        assert (analysis.crystal_structure(shaken, sides, distance=distance) == name).all()


def test_no_structure_is_seen_in_a_gas_and_none_at_an_absent_sphere() -> None:
    points = random_points(1, 500)[0]
    assert (analysis.crystal_structure(points, BOX) == CrystalStructure.OTHER).mean() > 0.99
    points, sides = face_centered(3)
    points[0] = np.nan
    found = analysis.crystal_structure(points, sides)
    assert found[0] == CrystalStructure.OTHER
    # The twelve neighbours of the hole have eleven.
    assert (found == CrystalStructure.FCC).sum() == len(points) - 13


def test_clusters_by_contact_and_by_distance_are_rows_of_spheres() -> None:
    # Rows of 1, 2, 3 and 4 spheres; one across the face of the box.
    rows = [[(i, 2 * count, 0) for i in range(count)] for count in range(1, 5)]
    points = np.array([point for row in rows for point in row], dtype=float)
    points[:, 0] += 4.5
    points[points[:, 0] > 5, 0] -= 10
    contacts = analysis.contact_network(points, 0.5, BOX, tolerance=1e-9)
    found = analysis.clusters(contacts, len(points))
    assert found.sizes.tolist() == [1, 2, 3, 4]
    assert found.labels.tolist() == [0, 1, 1, 2, 2, 2, 3, 3, 3, 3]
    near = analysis.neighbour_pairs(points, BOX, distance=1.01)
    np.testing.assert_array_equal(near, contacts)
    assert analysis.clusters(np.zeros((0, 2)), 3).sizes.tolist() == [1, 1, 1]
    all_ = analysis.neighbour_pairs(points, BOX, distance=2.5)
    assert analysis.clusters(all_, len(points)).sizes.tolist() == [10]


def test_percolation_does_not_depend_on_the_order_of_pairs() -> None:
    points = random_points(1, 300)[0]
    pairs = analysis.neighbour_pairs(points, BOX, distance=1.3)
    shuffled = np.random.default_rng(1).permutation(pairs)[:, ::-1]
    one, other = analysis.clusters(pairs, 300), analysis.clusters(shuffled, 300)
    np.testing.assert_array_equal(one.labels, other.labels)
    assert one.sizes.sum() == 300


def test_cells_of_lattices_are_parts_of_the_box_that_are_alike() -> None:
    for points, sides in (
        face_centered(3),
        hexagonal(3),
        (lattice(3, BODY_CENTERED), [3.0] * 3),
        (lattice(3, [[0.0, 0.0, 0.0]]) * (1, 2, 0.5), [3.0, 6.0, 1.5]),
        (np.zeros((1, 3)), [1.0, 2.0, 3.0]),
    ):
        volumes = analysis.voronoi_volumes(points, sides)
        # Qhull joins corners that differ by rounding.
        np.testing.assert_allclose(volumes, np.prod(sides) / len(points), rtol=1e-9)


def test_cells_fill_the_box_and_are_what_is_nearest() -> None:
    points = random_points(1, 100)[0]
    points[0] = np.nan
    volumes = analysis.voronoi_volumes(points, BOX)
    assert np.isnan(volumes[0])
    assert volumes[1:].sum() == pytest.approx(SIDE**3, rel=1e-9)
    places = random_points(1, 20_000, seed=9)[0]
    apart = places[:, None] - points[1:]
    apart -= SIDE * np.rint(apart / SIDE)
    nearest = np.bincount((apart**2).sum(axis=2).argmin(axis=1), minlength=99)
    expected = volumes[1:] / SIDE**3 * len(places)
    # Counts by Poisson's law: 99 deviations, none beyond five.
    assert (np.abs(nearest - expected) < 5 * np.sqrt(expected)).all()
    with pytest.raises(carom.CaromError, match=r"^positions: two spheres have one centre"):
        analysis.voronoi_volumes(points[[1, 2, 1]], BOX)
    with pytest.raises(carom.CaromError, match=r"^box: must be periodic"):
        analysis.voronoi_volumes(points, (10, 10, np.inf))


def test_partial_functions_of_a_mixture_add_up_to_the_whole() -> None:
    points = random_points(3, 300)
    species = np.where(np.arange(300) < 100, "small", "large")
    found = analysis.partial_radial_distribution(points, species, BOX, r_max=5, bins=10)
    whole = analysis.radial_distribution(points, BOX, r_max=5, bins=10)
    assert found.species.tolist() == ["large", "small"]
    parts = np.array([200, 100]) / 300
    np.testing.assert_allclose(np.einsum("a,b,abr->r", parts, parts, found.g), whole.g, rtol=1e-12)
    np.testing.assert_array_equal(
        found.pairs[0, 0] + found.pairs[0, 1] + found.pairs[1, 1], whole.pairs
    )
    # Without correlations unlike species have 1, and like ones 1 - 1/N.
    for one, other, expected in ((0, 1, 1.0), (0, 0, 1 - 1 / 200), (1, 1, 1 - 1 / 100)):
        deviation = (found.g[one, other] - expected) * np.sqrt(found.pairs[one, other] + 1)
        assert np.abs(deviation[2:]).max() < 5


def test_salt_has_unlike_neighbours_first() -> None:
    points = lattice(4, [[0.0, 0.0, 0.0]])
    species = points.sum(axis=1) % 2
    found = analysis.partial_radial_distribution(points, species, (4, 4, 4), r_max=1.9, bins=19)
    around = np.cumsum(found.pairs, axis=2)
    # Six unlike neighbours at 1, twelve like ones at √2, eight unlike ones at √3.
    assert (around[0, 1, [9, 10, 18]] / 32).tolist() == [0, 6, 14]
    assert (2 * around[0, 0, [13, 14]] / 32).tolist() == [0, 12]


def test_the_box_of_a_run_is_that_of_its_analysis() -> None:
    lattice = carom.Lattice(
        [4] * 3, [-1.5] * 3, [1.0] * 3, carom.Sphere(radius=0.3, velocity=(3, 0, 0))
    )
    box = carom.Simulation(boundary=carom.Periodic([4] * 3))
    scene = carom.Scene(name="row", simulation=box, generators=[lattice])
    run = scene.run(frames=20, dt=0.1)
    assert run.box is not None
    sides = [4.0, 4.0, 4.0]
    for own, given in (
        (
            analysis.radial_distribution(run, r_max=2).g,
            analysis.radial_distribution(run, sides, r_max=2).g,
        ),
        (
            analysis.structure_factor(run, q_max=7).s,
            analysis.structure_factor(run, sides, q_max=7).s,
        ),
        (analysis.unwrap(run), analysis.unwrap(run, sides)),
        (
            analysis.mean_square_displacement(run),
            analysis.mean_square_displacement(run, sides),
        ),
    ):
        np.testing.assert_array_equal(own, given)
    # All fly at 3 m/s through the box.
    msd = analysis.mean_square_displacement(run)
    np.testing.assert_allclose(msd, (3 * run.time) ** 2, atol=1e-11)


def test_noise_without_memory_has_the_viscosity_of_its_variance() -> None:
    count, dt = 40_000, 0.5
    noise = np.random.default_rng(2).standard_normal((count, 3, 3))
    correlation = analysis.stress_autocorrelation(noise, lags=20)
    # Of P symmetric without trace, all components of variance 1: 5 independent ones of the
    # symmetric part count, each of half the variance and twice in the sum of squares.
    assert correlation[0] == pytest.approx(0.5, rel=0.02)
    assert np.abs(correlation[1:]).max() < 4 * 0.5 / np.sqrt(5 * count)
    time = dt * np.arange(20)
    viscosity = analysis.green_kubo_viscosity(time, correlation, volume=3.0, temperature=2.0)
    # Half of the first interval: V / kT C(0) dt / 2, and noise of the other lags.
    expected = 3 / 2 * 0.5 * dt / 2
    assert viscosity[-1] == pytest.approx(expected, rel=0.06)


def test_the_integral_is_the_displacement_of_momentum() -> None:
    shear = np.zeros((400, 3, 3))
    shear[:, 0, 1] = shear[:, 1, 0] = np.random.default_rng(5).standard_normal(400)
    correlation = analysis.stress_autocorrelation(shear, lags=40)
    # One component off the diagonal of five independent ones.
    values = shear[:, 0, 1]
    by_hand = [(values[: 400 - lag] * values[lag:]).mean() / 5 for lag in range(40)]
    np.testing.assert_allclose(correlation, by_hand, atol=1e-13)


def test_the_viscosity_of_a_fluid_is_that_of_enskog() -> None:
    fluid = hard_spheres(frames=1, dt=0.01)
    spheres = carom.Points(fluid.run.positions[-1], radii=0.5, masses=1.0)
    box = carom.Simulation(boundary=carom.Periodic([fluid.side] * 3))
    world = carom.Scene(name="fluid", spheres=spheres, simulation=box).world()
    world.velocities = fluid.run.velocities[-1]
    series = analysis.stress_series(world, frames=1500, dt=0.02)
    # Five collisions: the memory of hard spheres is over, but for a small tail.
    correlation = analysis.stress_autocorrelation(series.stress, lags=26)
    volume = fluid.side**3
    found = analysis.green_kubo_viscosity(
        0.02 * np.arange(26), correlation, volume=volume, temperature=1.0
    )[-1]
    # Enskog: Chapman and Cowling (1970), 16.4, with 1.016 of the fourth approximation.
    packing = 0.3
    b_rho, g = 4 * packing, float(analysis.contact_value(packing))
    dilute = 1.016 * 5 / (16 * np.sqrt(np.pi))
    enskog = dilute * (1 / g + 0.8 * b_rho + 0.761 * b_rho**2 * g)
    # Ten such runs scatter by 9 %.
    assert found == pytest.approx(enskog, rel=0.2)


def test_a_box_of_infinite_size_changes_no_diffusion() -> None:
    found = analysis.infinite_diffusion([0.1, 0.2], side=1e9, viscosity=1.0, temperature=1.0)
    np.testing.assert_allclose(found, [0.1, 0.2], rtol=1e-8)
    one = analysis.infinite_diffusion(0.0, side=2.0, viscosity=3.0, temperature=4.0)
    assert float(one) == pytest.approx(2.837297 * 4 / (6 * np.pi * 3 * 2), rel=1e-15)


def test_nonsense_is_refused_by_its_argument() -> None:
    points = random_points(1, 20)[0]
    for call, field in (
        (lambda: analysis.bond_order(points, degree=-1), "degree"),
        (lambda: analysis.bond_order(points, nearest=0), "nearest"),
        (lambda: analysis.bond_order(points, nearest=3, distance=1), "nearest"),
        (lambda: analysis.bond_order(points, nearest=20), "nearest"),
        (lambda: analysis.bond_order(points[None]), "positions"),
        (lambda: analysis.bond_order(points, BOX, distance=6), "distance"),
        (lambda: analysis.crystal_structure(points[:10]), "nearest"),
        (lambda: analysis.neighbour_pairs(points, distance=0), "distance"),
        (lambda: analysis.clusters([[0, 3]], 3), "pairs"),
        (lambda: analysis.stress_autocorrelation(np.zeros((3, 3))), "stress"),
        (lambda: analysis.green_kubo_viscosity([0], [1], volume=0, temperature=1), "volume"),
        (lambda: analysis.infinite_diffusion(1, side=1, viscosity=0, temperature=1), "viscosity"),
        (lambda: analysis.partial_radial_distribution(points, [1], BOX, r_max=1), "species"),
    ):
        with pytest.raises(carom.CaromError) as raised:
            call()
        assert raised.value.field == field, field
