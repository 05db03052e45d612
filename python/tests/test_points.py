"""Many spheres as arrays: what a scene of them is, and how it comes back from a world."""

import copy
import pickle

import numpy as np
import pytest

import carom


def crystal(**more: object) -> carom.Points:
    places = np.indices((3, 4, 5)).reshape(3, -1).T
    return carom.Points(places, radii=0.4, **more)  # type: ignore[arg-type]


METAL: list[carom.Finish] = ["metal"] * 5
SATIN: list[carom.Finish] = ["satin"] * 55


def everything() -> carom.Points:
    random = np.random.default_rng(1)
    return carom.Points(
        np.indices((3, 4, 5)).reshape(3, -1).T * 2,
        radii=random.uniform(0.2, 0.4, 60),
        velocities=random.normal(size=(60, 3)),
        masses=random.uniform(1, 2, 60),
        restitutions=random.uniform(size=60),
        orientations=(0, 1, 0, 0),
        angular_velocities=random.normal(size=(60, 3)),
        inertia_factors=0.5,
        frictions=np.where(random.uniform(size=60) < 0.5, 0.25, np.nan),
        colors=np.where(np.arange(60)[:, None] < 9, (0.25, 0.5, 1.0), np.nan),
        finishes=[*METAL, *SATIN],
    )


@pytest.mark.parametrize("points", [crystal(), everything()])
def test_a_scene_of_points_is_that_of_its_spheres(points: carom.Points) -> None:
    simulation = carom.Simulation(rule="contact")
    from_points = carom.Scene(name="many", spheres=points, simulation=simulation)
    from_spheres = carom.Scene(name="many", spheres=list(points), simulation=simulation)
    assert from_points == from_spheres
    assert from_points.to_toml() == from_spheres.to_toml()
    one, other = from_points.world(), from_spheres.world()
    assert one.state_hash == other.state_hash
    for world in (one, other):
        world.step(frames=5)
    assert one.state_hash == other.state_hash
    assert one.sphere(3) == other.sphere(3)


def test_a_world_comes_back_as_a_scene_of_points() -> None:
    world = carom.Scene(name="many", spheres=everything()).world()
    scene = world.to_scene()
    assert scene.world().state_hash == world.state_hash
    assert scene.spheres == everything()
    assert scene.spheres[3] == world.sphere(3)
    assert [sphere.color for sphere in scene.spheres[8:10]] == [(0.25, 0.5, 1.0), None]


def test_points_read_like_a_list() -> None:
    points = crystal(velocities=(1, 2, 3))
    assert len(points) == 60
    assert points[-1] == points[59] == list(points)[59]
    assert points[59].position == (2, 3, 4)
    assert points[2:9:3][1] == points[5]
    assert points.positions.shape == (60, 3)
    assert repr(points) == "<carom.Points: 60 spheres>"
    assert points == list(points) and points != list(points)[1:]
    with pytest.raises(IndexError):
        points[60]
    with pytest.raises(AttributeError, match="no 'masses'"):
        _ = points.masses
    with pytest.raises(ValueError, match="read-only"):
        points.positions[0] = 1


@pytest.mark.parametrize("again", [copy.deepcopy, lambda it: pickle.loads(pickle.dumps(it))])
def test_points_are_copied_whole(again: object) -> None:
    scene = carom.Scene(name="many", spheres=everything())
    assert again(scene) == scene  # type: ignore[operator]


def test_densities_give_the_masses_of_spheres_with_them() -> None:
    random = np.random.default_rng(2)
    radii, densities = random.uniform(0.1, 0.4, 60), random.uniform(1, 9000, 60)
    places = np.indices((3, 4, 5)).reshape(3, -1).T
    points = carom.Points(places, radii, densities=densities)
    spheres = [
        carom.Sphere(position=place, radius=radius, density=density)
        for place, radius, density in zip(places, radii, densities, strict=True)
    ]
    from_points, from_spheres = carom.World(), carom.World()
    from_points.add_spheres(points)
    from_spheres.add_spheres(spheres)
    assert from_points.masses.tolist() == from_spheres.masses.tolist()
    by_arrays = carom.World()
    by_arrays.add_spheres(places, radii, densities=densities)
    assert by_arrays.masses.tolist() == from_spheres.masses.tolist()


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        ({"radii": [1, 2]}, r"radii: must be of shape \(3,\), not \(2,\)"),
        ({"positions": [(0, 0)]}, r"positions: must be of shape \(1, 3\), not \(1, 2\)"),
        (
            {"velocities": [(0, 0, 0), (0, np.nan, 0), (0, 0, 0)]},
            r"velocities\[1\]: must be finite",
        ),
        ({"masses": 1, "densities": 1}, "give masses or densities"),
        ({"finishes": ["metal"]}, "finishes: must be 3, not 1"),
        ({"positions": [[0], [2], [4]]}, r"positions: must be of shape \(3, 3\), not \(3, 1\)"),
    ],
)
def test_points_refuse_what_does_not_fit(wrong: dict[str, object], problem: str) -> None:
    right = {"positions": [(0, 0, 0), (2, 0, 0), (4, 0, 0)], "radii": 0.5}
    with pytest.raises(carom.CaromError, match=problem):
        carom.Points(**(right | wrong))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("wrong", "problem"),
    [
        ({"radii": [0.5, -1, 0.5]}, r"spheres\[1\]\.radius"),
        ({"masses": [1, 1, 0]}, r"spheres\[2\]\.mass"),
        ({"restitutions": 1.5}, r"spheres\[0\]\.restitution"),
        ({"radii": 1.5}, "overlaps"),
        ({"finishes": ["metal", "wool", "metal"]}, "finishes: .*wool"),
    ],
)
def test_a_scene_refuses_points_by_their_number(wrong: dict[str, object], problem: str) -> None:
    right = {"positions": [(0, 0, 0), (2, 0, 0), (4, 0, 0)], "radii": 0.5}
    scene = carom.Scene(name="three", spheres=carom.Points(**(right | wrong)))  # type: ignore[arg-type]
    with pytest.raises(carom.CaromError, match=problem):
        scene.world()


def test_spheres_are_added_as_a_list_with_their_colours() -> None:
    world = carom.World()
    ids = world.add_spheres(
        [carom.Sphere(radius=0.5, color=(1, 0, 0)), carom.Sphere(position=(2, 0, 0), radius=0.5)]
    )
    assert ids.tolist() == [0, 1]
    assert world.sphere(0).color == (1, 0, 0)
    with pytest.raises(TypeError, match="radii: spheres have their own"):
        world.add_spheres([carom.Sphere(radius=0.5)], 0.5)
    with pytest.raises(TypeError, match="velocities: spheres have their own"):
        world.add_spheres(crystal(), velocities=1)
    assert world.add_spheres([]).tolist() == world.add_spheres([], []).tolist() == []
    assert len(carom.Points([], [])) == 0
    assert world.add_spheres(np.empty((0, 3)), 1.0, overlap="raise").tolist() == []


def test_points_are_added_with_their_colours_and_without_text() -> None:
    by_points, by_list = carom.World(), carom.World()
    by_points.add_spheres(everything())
    by_list.add_spheres(list(everything()))
    assert by_points.state_hash == by_list.state_hash
    assert by_points.to_scene() == by_list.to_scene()


def test_changes_of_other_fields_leave_points_points() -> None:
    scene = carom.Scene(name="many", spheres=everything())
    changed = scene.with_changes({"simulation.rule": "contact"})
    assert isinstance(changed.spheres, carom.Points)
    assert changed == scene.with_changes({"simulation": {"rule": "contact"}})
    moved = scene.with_changes({"spheres.0.position.1": -9.0})
    assert moved.spheres[0].position == (0, -9, 0)


def test_points_are_picked_by_marks_and_tell_how_they_look() -> None:
    points = everything()
    heavy = points[points.masses > 1.5]
    assert 0 < len(heavy) < 60 and all(sphere.mass > 1.5 for sphere in heavy)  # type: ignore[operator]
    assert points.colors is not None and points.colors.shape == (60, 3)
    assert points.finishes is not None and points.finishes[4:6] == ("metal", "satin")
    assert crystal(finishes="glass")[7].finish == "glass"
    assert crystal().colors is None


def test_an_error_of_many_spheres_names_the_row() -> None:
    world = carom.World()
    places = [(0, 0, 0), (3, 0, 0)]
    with pytest.raises(carom.CaromError, match=r"spheres\[1\].*radius.*must be positive"):
        world.add_spheres(places, [1, -1])
    with pytest.raises(carom.CaromError, match=r"positions\[1\]: must be finite"):
        world.add_spheres([(0, 0, 0), (np.nan, 0, 0)], 1)
    assert len(world) == 0


def test_spheres_that_overlap_are_refused_if_that_is_asked_for() -> None:
    world = carom.World()
    world.add_collider(carom.Collider(carom.HalfSpace()))
    world.add_spheres([(0, 1, 0), (3, 1, 0)], 1.0)
    before = world.state_hash
    cases: list[tuple[list[tuple[float, float, float]], str]] = [
        ([(6, 1, 0), (7, 1, 0)], r"sphere 1 of these overlaps sphere 0 of these by 1\.000e0 m"),
        ([(6, 5, 0), (3, 2, 0)], r"sphere 1 of these overlaps the sphere with the id 1 by"),
        ([(6, 0.5, 0)], r"sphere 0 of these overlaps the collider with the id 0 by 5\.000e-1 m"),
    ]
    for places, problem in cases:
        with pytest.raises(carom.CaromError, match=problem):
            world.add_spheres(places, 1.0, overlap="raise")
        described = [carom.Sphere(position=place, radius=1.0) for place in places]
        with pytest.raises(carom.CaromError, match=problem):
            world.add_spheres(described, overlap="raise")
        assert world.state_hash == before
    world.add_spheres([(6, 1, 0)], 1.0, overlap="raise")
    assert world.largest_overlap == 0
    with pytest.raises(carom.CaromError, match="overlap: must be 'allow' or 'raise'"):
        world.add_spheres([(6, 1, 0)], 1.0, overlap="no")  # type: ignore[arg-type]


def test_overlaps_tell_bodies_and_depth() -> None:
    world = carom.World()
    world.add_collider(carom.Collider(carom.HalfSpace()))
    world.add_spheres([(0, 0.75, 0), (1.5, 1, 0), (9, 1, 0)], 1.0)
    overlaps = world.overlaps()
    assert overlaps.dtype == carom.OVERLAP
    assert overlaps[["collider", "sphere_1", "sphere_2"]].tolist() == [(-1, 0, 1), (0, -1, 0)]
    np.testing.assert_allclose(overlaps["depth"], [2 - np.hypot(1.5, 0.25), 0.25], rtol=1e-15)
    assert world.largest_overlap == overlaps["depth"].max()
    assert len(world.overlaps(0.3)) == 1


def test_many_spheres_are_taken_out_at_once() -> None:
    world = carom.World()
    world.add_spheres([(3 * i, 0, 0) for i in range(10)], 1.0)
    world.remove_spheres([3, 7, 7])
    assert world.ids.tolist() == [0, 1, 2, 4, 5, 6, 8, 9]
    world.remove_spheres(world.positions[:, 0] > 12)
    assert world.ids.tolist() == [0, 1, 2, 4]
    before = world.state_hash
    for ids in ([0, 3], [-1]):
        with pytest.raises(carom.UnknownError, match="there is no sphere"):
            world.remove_spheres(ids)
    with pytest.raises(carom.CaromError, match="ids: must be 4 truth values"):
        world.remove_spheres([True])
    with pytest.raises(TypeError, match="ids: must be whole numbers or truth values"):
        world.remove_spheres([0.5])
    world.remove_spheres([])
    assert world.state_hash == before
