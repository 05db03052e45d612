"""Queries agree with closed forms, and a predicted path with what then happens."""

from typing import Any, Literal

import numpy as np
import pytest

import carom

Rule = Literal["exact", "contact", "bisect", "discrete"]
RULES: list[Rule] = ["exact", "contact", "bisect", "discrete"]


def scattered(count: int = 60) -> carom.World:
    """Spheres of several sizes, apart from each other, above a floor."""
    random = np.random.default_rng(5)
    places = 3.0 * np.stack(np.unravel_index(np.arange(count), (4, 4, 4)), axis=1)
    world = carom.World()
    world.add_spheres(places + random.uniform(-0.4, 0.4, (count, 3)), random.uniform(0.2, 1, count))
    world.add_collider(carom.Collider(carom.HalfSpace(), position=(0, -2, 0)))
    return world


def test_a_ray_meets_a_sphere_where_the_quadratic_says() -> None:
    random = np.random.default_rng(1)
    world = carom.World()
    center, radius = np.array([1.0, -2.0, 3.0]), 1.5
    ball = world.add_sphere(carom.Sphere(position=tuple(center), radius=radius))
    origins = center + 10 * random.normal(size=(500, 3))
    origins = origins[np.linalg.norm(origins - center, axis=1) > 2]
    aims = center + 0.5 * radius * random.uniform(-1, 1, origins.shape)
    ways = 1.5 * (aims - origins)
    hits = world.cast_ray(origins, ways)
    apart = origins - center
    a, b = (ways**2).sum(axis=1), (ways * apart).sum(axis=1)
    root = np.sqrt(b**2 - a * ((apart**2).sum(axis=1) - radius**2))
    assert hits["sphere"].tolist() == [ball] * len(origins)
    # Rays pass the centre at less than 0.87 of the radius, so that rounding grows by 2 at most.
    np.testing.assert_allclose(hits["fraction"], (-b - root) / a, rtol=1e-13)
    expected = origins + hits["fraction"][:, None] * ways
    np.testing.assert_allclose(hits["point"], expected, atol=1e-12)
    np.testing.assert_allclose(hits["normal"], (expected - center) / radius, atol=1e-12)


def test_a_sphere_on_its_way_stops_its_radius_above_the_floor() -> None:
    world = carom.World()
    floor = world.add_collider(carom.Collider(carom.HalfSpace()))
    hits = world.cast_sphere((0, 5, 0), [0.5, 1.0, 2.0], (0, -8, 0))
    assert hits["collider"].tolist() == [floor] * 3
    # From 5 m down to the radius, on a way of 8 m; all are dyadic.
    assert hits["fraction"].tolist() == [4.5 / 8, 4.0 / 8, 3.0 / 8]
    assert hits["normal"].tolist() == [[0, 1, 0]] * 3


def test_many_queries_in_one_call_have_the_bits_of_single_ones() -> None:
    world, random = scattered(), np.random.default_rng(2)
    origins, ways = random.uniform(-2, 12, (2, 40, 3))
    assert world.cast_ray(origins, ways - origins).tobytes() == b"".join(
        world.cast_ray(one, way - one).tobytes() for one, way in zip(origins, ways, strict=True)
    )
    radii = random.uniform(0.1, 1, 40)
    assert world.nearest(origins).tobytes() == b"".join(
        world.nearest(one).tobytes() for one in origins
    )
    both = world.overlapping(origins, radii)
    for number, (one, radius) in enumerate(zip(origins, radii, strict=True)):
        single = world.overlapping(one, radius)
        assert single["query"].tolist() == [0] * len(single)
        for name in carom.NEAR.names or ():
            own = both[both["query"] == number][name]
            assert own.tobytes() == single[name].tobytes()


def test_the_nearest_and_the_overlapping_bodies_are_those_of_a_loop_over_all() -> None:
    world, random = scattered(), np.random.default_rng(3)
    points = random.uniform(0, 12, (50, 3))
    apart = np.linalg.norm(points[:, None] - world.positions, axis=2) - world.radii
    only_spheres = carom.QueryFilter(colliders=False)
    near = world.nearest(points, filter=only_spheres)
    assert near["sphere"].tolist() == world.ids[apart.argmin(axis=1)].tolist()
    np.testing.assert_allclose(near["distance"], apart.min(axis=1), atol=1e-13)
    found = world.overlapping(points, 1.5, filter=only_spheres)
    query, sphere = np.nonzero(apart <= 1.5)
    assert found["query"].tolist() == query.tolist()
    assert found["sphere"].tolist() == world.ids[sphere].tolist()
    far = world.nearest((0, 100, 0), within=1.0)
    assert far.tolist()[:2] == (-1, -1)
    assert far["distance"] == np.inf


def test_shapes_of_queries_are_spread_to_each_other() -> None:
    world = scattered()
    down = world.cast_ray(np.zeros((2, 5, 3)) + 20, (0, -30, 0))
    assert down.shape == (2, 5)
    assert world.cast_ray((0, 20, 0), (0, -30, 0)).shape == ()
    assert world.cast_sphere((0, 20, 0), np.ones((4, 1)), np.ones((6, 3))).shape == (4, 6)
    assert world.nearest(np.empty((0, 3))).shape == (0,)
    assert world.cast_ray([], []).shape == (0,)


def test_an_empty_world_has_nothing_to_meet() -> None:
    world = carom.World()
    hit = world.cast_ray((0, 0, 0), (1, 0, 0))
    assert hit.tolist()[:2] == (-1, -1)
    assert hit["fraction"] == np.inf
    assert np.isnan(hit["point"]).all()
    assert len(world.overlapping((0, 0, 0), 1.0)) == 0


@pytest.mark.parametrize("scale", [2.0**-20, 2.0**20])
def test_queries_know_no_length(scale: float) -> None:
    world, large = scattered(), carom.World()
    large.add_spheres(world.positions * scale, world.radii * scale)
    large.add_collider(carom.Collider(carom.HalfSpace(), position=(0, -2 * scale, 0)))
    origins, ways = np.random.default_rng(4).uniform(-15, 15, (2, 60, 3))
    one = world.cast_ray(origins, ways)
    other = large.cast_ray(origins * scale, ways * scale)
    assert one["sphere"].tolist() == other["sphere"].tolist()
    assert one["fraction"].tobytes() == other["fraction"].tobytes()


def test_a_filter_leaves_out_what_its_options_say() -> None:
    world = carom.World()
    box = carom.Box((1, 1, 1))
    trigger = world.add_collider(carom.Collider(box, position=(1, 0, 0), trigger=True))
    near, far = world.add_spheres([(3, 0, 0), (6, 0, 0)], radii=0.5, groups=[0b01, 0b10])
    wall = world.add_collider(carom.Collider(box, position=(9, 0, 0)))

    def first(**options: Any) -> tuple[int, int]:
        filter = carom.QueryFilter(**options)
        hit = world.cast_ray((-1, 0, 0), (20, 0, 0), filter=filter)
        return int(hit["sphere"]), int(hit["collider"])

    assert first() == (near, -1)
    assert first(triggers=True) == (-1, trigger)
    assert first(without_sphere=near) == (far, -1)
    assert first(collides_with=0b10) == (far, -1)
    assert first(spheres=False) == (-1, wall)
    assert first(spheres=False, colliders=False) == (-1, -1)


@pytest.mark.parametrize("rule", RULES)
def test_queries_see_the_world_of_now_under_every_rule(rule: Rule) -> None:
    simulation = carom.Simulation(rule=rule, frame_time=0.25)
    ball = carom.Sphere(position=(0, 0, 0), velocity=(2, 0, 0), radius=0.5)
    world = carom.Scene(name="one", simulation=simulation, spheres=[ball]).world()
    before = world.state_hash
    assert world.cast_ray((-4, 0, 0), (8, 0, 0))["fraction"] == 3.5 / 8
    assert world.state_hash == before
    world.step(frames=2)
    assert world.cast_ray((-4, 0, 0), (8, 0, 0))["fraction"] == 4.5 / 8
    # What was written counts, as for a step.
    world.positions[0] = (2, 0, 0)
    assert world.cast_ray((-4, 0, 0), (8, 0, 0))["fraction"] == 5.5 / 8


@pytest.mark.parametrize(
    ("query", "problem"),
    [
        (lambda world: world.cast_ray((0, 0), (1, 0, 0)), r"origins: must be of shape \(\.\.\., 3"),
        (lambda world: world.cast_ray((0, np.nan, 0), (1, 0, 0)), "`origin` must be finite"),
        (lambda world: world.cast_ray(np.eye(3), np.eye(3) / [[1], [1], [0]]), r"rays\[2\]"),
        (lambda world: world.cast_ray(np.eye(3), np.ones((2, 3))), "ways: must fit the shape"),
        (lambda world: world.cast_sphere((0, 0, 0), -1.0, (1, 0, 0)), "`radius` must be positive"),
        (lambda world: world.nearest((0, 0, 0), within=-1.0), "`within` must be zero or positive"),
        (lambda world: world.overlapping((0, 0, 0), [1, 0]), r"spheres\[1\]"),
        (lambda world: world.predict(0, -1.0), "`horizon` must be positive"),
        (lambda world: world.predict(7, 1.0), "there is no sphere 7"),
        (lambda world: world.predict(0, 1.0, most_impacts=-1), "most_impacts: must be in"),
        (lambda world: carom.QueryFilter(groups=2**32), r"groups: must be in \[0, 2\^32\)"),
    ],
)
@pytest.mark.filterwarnings("ignore:divide by zero", "ignore:invalid value")
def test_a_query_that_makes_no_sense_is_refused(query: Any, problem: str) -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(position=(5, 0, 0), radius=1))
    with pytest.raises(carom.CaromError, match=problem):
        query(world)


@pytest.mark.parametrize(
    "query",
    [
        lambda world: world.cast_ray("up", (1, 0, 0)),
        lambda world: world.cast_ray([(0, 0, 0), (0,)], (1, 0, 0)),
        lambda world: world.cast_ray((0, 0, 0), (1, 0, 0), filter=None),
        lambda world: world.nearest((0, 0, 0), within="far"),
        lambda world: world.predict(0, "long"),
        lambda world: carom.QueryFilter(spheres=1),  # type: ignore[arg-type]
    ],
)
def test_a_query_of_the_wrong_kind_is_a_type_error(query: Any) -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(radius=1))
    with pytest.raises(TypeError):
        query(world)


def bouncing() -> tuple[carom.World, int]:
    """A ball that bounces on a floor with drag and comes to a wall; another falls elsewhere."""
    world = carom.World()
    world.add_force(carom.Gravity((0, -9.81, 0)))
    world.add_force(carom.ViscousDrag(0.05))
    world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0.8))
    wall = carom.Collider(carom.HalfSpace(), position=(6, 0, 0), rotation=(0, 0, 1, 1))
    world.add_collider(wall)
    flying = carom.Sphere(position=(0, 2, 0), velocity=(3, 1, 0), radius=0.25)
    ball = world.add_sphere(flying)
    world.add_sphere(carom.Sphere(position=(0, 30, 8), radius=0.25))
    return world, ball


def test_a_predicted_path_is_what_then_happens_to_the_bit() -> None:
    world, ball = bouncing()
    world.step(dt=1 / 64)
    path = world.predict(ball, 4.0)
    assert (path.end, path.end_time) == ("horizon", world.time + 4)
    run = world.run(frames=256, dt=1 / 64)
    assert path.positions_at(run.time).tobytes() == run.positions[:, 0].tobytes()
    assert path.velocities_at(run.time).tobytes() == run.velocities[:, 0].tobytes()
    own = run.impacts[run.impacts["sphere_2"] == ball]
    assert set(own["collider"]) == {0, 1}
    assert len(path.impacts) == len(own)
    for name in ("collider", "point", "normal", "approach_speed", "impulse"):
        assert path.impacts[name].tobytes() == own[name].tobytes()
    # Impacts count their time from different starts, whose sum is rounded.
    np.testing.assert_allclose(path.impacts["time"], own["time"], rtol=0, atol=1e-15)
    assert (path.legs["start"][1:] == path.legs["end"][:-1]).all()


def test_a_path_up_to_some_impacts_ends_at_the_last() -> None:
    world, ball = bouncing()
    path = world.predict(ball, 100.0, most_impacts=2)
    assert (path.end, len(path.impacts)) == ("impacts", 2)
    assert path.end_time == path.impacts["time"][1]
    assert np.isnan(path.positions_at([-1.0, path.end_time + 1])).all()
    assert path.positions_at(np.zeros((2, 3))).shape == (2, 3, 3)
    assert "2 impacts" in repr(path)
    # A ball that loses nothing bounces for ever.
    endless = carom.World()
    endless.add_force(carom.Gravity((0, -9.81, 0)))
    endless.add_collider(carom.Collider(carom.HalfSpace()))
    ball = endless.add_sphere(carom.Sphere(position=(0, 1, 0), radius=0.1))
    path = endless.predict(ball, 1e12)
    assert (path.end, len(path.impacts)) == ("impacts", 10_000)


@pytest.mark.parametrize("rule", RULES)
def test_a_path_is_that_of_exact_under_every_rule(rule: Rule) -> None:
    world, ball = bouncing()
    expected = world.predict(ball, 1.0)
    world.simulation = carom.Simulation(rule=rule)
    path = world.predict(ball, 1.0)
    times = np.linspace(0, 1, 11)
    assert path.positions_at(times).tobytes() == expected.positions_at(times).tobytes()


def test_motion_without_a_closed_form_has_no_path() -> None:
    world = carom.World()
    one, other = world.add_spheres([(0, 0, 0), (3, 0, 0)], radii=1)
    spring = world.add_spring(carom.Spring(spheres=(one, other), stiffness=2.0))
    with pytest.raises(carom.CaromError, match="spring"):
        world.predict(one, 1.0)
    world.remove_spring(spring)
    force = world.add_force(lambda world: -world.positions)
    with pytest.raises(carom.CaromError, match="predict knows no functions"):
        world.predict(one, 1.0)
    world.remove_force(force)
    assert world.predict(one, 1.0).end == "horizon"
