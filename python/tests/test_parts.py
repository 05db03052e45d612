"""A part of a wrong kind or number is refused where it is made, in the words of the engine."""

import copy
import pickle
import re
from collections.abc import Callable, Sequence
from dataclasses import MISSING, dataclass, fields, replace
from typing import Any, get_args

import numpy as np
import pytest

import carom
from carom._scene import parts, text
from carom._scene.checks import checks_of

NAN, INF = float("nan"), float("inf")
BALL = carom.Sphere(radius=1)
make: Any = carom
"""Without types: what is made here is wrong."""


@pytest.mark.parametrize(
    ("part", "message"),
    [
        (lambda: make.Gravity(-9.81), "Gravity.acceleration: must be three numbers, not -9.81"),
        (lambda: make.Gravity(object()), "Gravity.acceleration: must be three numbers, not object"),
        (lambda: make.Sphere(velocity=None), "Sphere.velocity: must be three numbers, not None"),
        (
            lambda: make.Sphere(velocity=(1, None, 3)),
            "Sphere.velocity: must be three numbers, not (1, None, 3)",
        ),
        (lambda: make.Sphere(position=np.eye(3)), "Sphere.position: must be three numbers, not ("),
        (lambda: make.Sphere(position="1 2 3"), "Sphere.position: must be three numbers, not "),
        (lambda: make.Sphere(radius="big"), "Sphere.radius: must be a number, not 'big'"),
        (lambda: make.Sphere(radius="5"), "Sphere.radius: must be a number, not '5'"),
        (lambda: make.Sphere(radius=True), "Sphere.radius: must be a number, not True"),
        (lambda: make.Sphere(radius=np.bool_(True)), "Sphere.radius: must be a number, not True"),
        (lambda: make.Sphere(radius=1j), "Sphere.radius: must be a number, not complex"),
        (lambda: make.Sphere(restitution=None), "Sphere.restitution: must be a number, not None"),
        (lambda: make.Sphere(orientation=1), "Sphere.orientation: must be four numbers, not 1"),
        (lambda: make.Sphere(color=0.5), "Sphere.color: must be three numbers, not 0.5"),
        (lambda: make.Row(3.0, (0, 0, 0), (1, 0, 0), BALL), "Row.count: must be a whole number"),
        (lambda: make.Row("3", (0, 0, 0), (1, 0, 0), BALL), "Row.count: must be a whole number"),
        (
            lambda: make.Lattice((2.0, 1, 1), (0, 0, 0), (1, 1, 1), BALL),
            "Lattice.counts: must be three whole numbers, not (2.0, 1, 1)",
        ),
        (
            lambda: make.Row(3, (0, 0, 0), (1, 0, 0), (1, 2, 3)),
            "Row.sphere: must be a carom.Sphere, not (1, 2, 3)",
        ),
        (
            lambda: make.Simulation(spheres_collide=1),
            "Simulation.spheres_collide: must be True or False, not 1",
        ),
        (lambda: make.Simulation(rule=3), "Simulation.rule: must be 'exact', 'contact', 'bisect'"),
        (
            lambda: make.Simulation(exact={"zones": "never"}),
            "Simulation.exact: must be a carom.Exact, not {'zones': 'never'}",
        ),
        (
            lambda: make.Simulation(boundary=(1, 1, 1)),
            "Simulation.boundary: must be 'open' or a carom.Periodic, not (1, 1, 1)",
        ),
        (
            lambda: make.Collider("box"),
            "Collider.shape: must be a carom.Ball, carom.Rectangle, carom.HalfSpace, carom.Box, "
            "carom.Container, carom.Cylinder, carom.Cone, carom.Capsule, carom.Disc, carom.Torus, "
            "carom.Pipe, carom.Bowl, carom.Funnel, carom.Mesh, carom.HeightField or carom.Track, "
            "not 'box'; write carom.Box(...)",
        ),
        (lambda: make.Collider({"sphere": {"radius": 1}}), "; write carom.Ball(...)"),
        (lambda: make.Collider(carom.HalfSpace), "; write carom.HalfSpace(...)"),
        (lambda: make.Collider(BALL), ", not carom.Sphere"),
        (lambda: make.Collider(carom.Ball(1), name=3), "Collider.name: must be text, not 3"),
        (lambda: make.Emitter(carom.Ball(1), 1), "Emitter.sphere: must be a carom.Sphere, not"),
        (lambda: make.Container((1, 1, 1), 3), "Container.open: must be 'left', 'right', "),
        (lambda: make.Scene(name=3), "Scene.name: must be text, not 3"),
        (
            lambda: make.Scene(name="x", forces=carom.Gravity()),
            "Scene.forces: must be a sequence of a carom.ConstantForce, carom.Gravity, "
            "carom.ViscousDrag, carom.PointAttractor, carom.MutualGravity, carom.Wind, "
            "carom.Vortex, carom.QuadraticDrag or carom.Buoyancy, not carom.Gravity; put it into "
            "a list",
        ),
        (
            lambda: make.Scene(name="x", spheres=[BALL, (0, 0, 0)]),
            "Scene.spheres[1]: must be a carom.Sphere, not (0, 0, 0)",
        ),
        (lambda: make.Scene(name="x", spheres=(it for it in [BALL])), ", not generator"),
        (lambda: make.Scene(name="x", camera=(0, 0, 9)), "Scene.camera: must be a carom.Camera"),
    ],
)
def test_a_value_of_another_kind(part: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError, match=re.escape(message)):
        part()


@pytest.mark.parametrize(
    ("part", "message"),
    [
        (lambda: make.Sphere(position=(1, 2)), "position: must be three numbers, not (1, 2)"),
        (lambda: make.Sphere(position=(0, NAN, 0)), "position: must be finite, not (0, nan, 0)"),
        (lambda: make.Sphere(radius=-1), "Sphere.radius: must be positive and finite, not -1"),
        (lambda: make.Sphere(radius=0), "Sphere.radius: must be positive and finite, not 0"),
        (lambda: make.Sphere(radius=INF), "Sphere.radius: must be positive and finite, not inf"),
        (lambda: make.Sphere(density=NAN), "Sphere.density: must be positive and finite, not nan"),
        (lambda: make.Sphere(mass=10**400), "Sphere.mass: must be positive and finite, not 1000"),
        (lambda: make.Sphere(mass=10**9999), "Sphere.mass: must be positive and finite, not a nu"),
        (lambda: make.Sphere(restitution=1.5), "Sphere.restitution: must be in [0, 1], not 1.5"),
        (lambda: make.Sphere(friction=-0.1), "friction: must be zero or positive, and finite, not"),
        (lambda: make.Sphere(orientation=(0, 0, 0, 0)), "must be a quaternion x, y, z, w that is"),
        (lambda: make.Sphere(orientation=(0, 0, 1)), "must be four numbers, not (0, 0, 1)"),
        (lambda: make.Sphere(color=(1, 2, 0)), "color: must be three parts in [0, 1], not (1, 2"),
        (lambda: make.Sphere(color="rde"), 'Sphere.color: "rde" is no colour: write three numbers'),
        (lambda: make.Sphere(color='a"\\\n'), "Sphere.color: "),
        (lambda: make.Sphere(finish="shiny"), "not 'shiny'"),
        (lambda: make.ViscousDrag(-1), "ViscousDrag.coefficient: must be zero or positive, and"),
        (lambda: make.Box((1, 0, 1)), "Box.size: must be positive and finite along every axis"),
        (lambda: make.Periodic((1, 0, 1)), "must be positive along every axis; infinite where it"),
        (lambda: make.Emitter(BALL, 0), "Emitter.period: must be positive and finite, not 0"),
        (lambda: make.Emitter(BALL, 1, max_spheres=0), "max_spheres: must be at least 1, not 0"),
        (lambda: make.Row(0, (0, 0, 0), (1, 0, 0), BALL), "Row.count: must be at least 1, not 0"),
        (lambda: make.Row(2**32, (0, 0, 0), (1, 0, 0), BALL), "must be in [0, 2^32), not"),
        (lambda: make.Lattice((1, 0, 1), (0, 0, 0), (1, 1, 1)), "must be at least 1 each, not"),
        (lambda: make.Lattice((1, 1), (0, 0, 0), (1, 1, 1)), "must be three whole numbers, not"),
        (lambda: make.Ring(3, (0, 0, 0), 1, BALL, (0, 0, 0)), "must be a direction that is finite"),
        (lambda: make.RandomFill(1, (0, 0, 0), (9, 9, 9), -1, BALL), "must be in [0, 2^32), not -"),
        (
            lambda: make.RandomFill(1, (0, 0, 0), (9, 9, 9), 1, BALL, radius_range=(2, 1)),
            "RandomFill.radius_range: must be two positive radii in order, not (2, 1)",
        ),
        (lambda: make.Contact(sub_steps=0), "Contact.sub_steps: must be at least 1, not 0"),
        (lambda: make.Camera((0, 0, NAN)), "Camera.position: must be finite, not (0, 0, nan)"),
        (lambda: make.Camera((0, 0, 9), near=2, far=1), "Camera.far: must be farther than `near`"),
        (
            lambda: make.Camera((0, 0, 9), vertical_fov_degrees=180),
            "Camera.vertical_fov_degrees: must be between 0 and 180, not 180",
        ),
        (
            lambda: make.Simulation(rule="verlet"),
            "Simulation.rule: must be 'exact', 'contact', 'bisect' or 'discrete', not 'verlet'",
        ),
        (lambda: make.Simulation(rule="exakt"), "not 'exakt'; did you mean 'exact'?"),
        (lambda: make.Simulation(boundary="closed"), "must be 'open' or a carom.Periodic, not 'c"),
        (lambda: make.Exact(impact_law="newton"), "Exact.impact_law: must be 'reflection', "),
        (lambda: make.Container((1, 1, 1), "roof"), "Container.open: must be 'left', "),
        (lambda: make.Container((1, 1, 1), ["top", "botom"]), "did you mean 'bottom'?"),
        (lambda: make.Sphere(radius=1, diameter=2), "Sphere.diameter: `radius` says it already"),
        (
            lambda: make.Sphere(radius=1, mass=1, density=2),
            "Sphere.density: `mass` says it already",
        ),
        (lambda: make.Row(2, (0, 0, 0), (1, 0, 0)), "Row: needs `sphere` or `collider`"),
        (
            lambda: make.Ring(2, (0, 0, 0), 1, BALL, collider=carom.Collider(carom.Ball(1))),
            "Ring.collider: `sphere` says it already",
        ),
    ],
)
def test_a_value_that_makes_no_sense(part: Callable[[], object], message: str) -> None:
    with pytest.raises(carom.CaromError, match=re.escape(message)) as caught:
        part()
    assert caught.value.field is not None
    assert str(caught.value).startswith(f"{caught.value.field}: ")


SIZELESS = carom.Sphere(position=(0, 1, 0), density=1000)
NO_SIZE = "needs `radius` or `diameter`"


@pytest.mark.parametrize(
    ("part", "message"),
    [
        (lambda: make.Scene(name="x", spheres=[BALL, SIZELESS]), f"Scene.spheres[1]: {NO_SIZE}"),
        (lambda: make.Emitter(SIZELESS, 1), f"Emitter.sphere: {NO_SIZE}"),
        (lambda: make.Row(2, (0, 0, 0), (1, 0, 0), SIZELESS), f"Row.sphere: {NO_SIZE}"),
        (lambda: make.Lattice((2, 1, 1), (0, 0, 0), (1, 1, 1), SIZELESS), "Lattice.sphere: needs"),
        (
            lambda: make.StaggeredRows(1, (2,), (0, 0, 0), (1, 0, 0), (0, 0, 1), SIZELESS),
            f"StaggeredRows.sphere: {NO_SIZE}",
        ),
        (lambda: make.ClosePacking((1, 1, 1), (0, 0, 0), SIZELESS), "ClosePacking.sphere: needs"),
        (lambda: make.Ring(2, (0, 0, 0), 1, SIZELESS), f"Ring.sphere: {NO_SIZE}"),
        (
            lambda: make.RandomFill(1, (0, 0, 0), (9, 9, 9), 1, SIZELESS),
            f"RandomFill.sphere: {NO_SIZE}, or give `radius_range`",
        ),
    ],
)
def test_a_sphere_without_a_size_is_no_part_of_a_scene(
    part: Callable[[], object], message: str
) -> None:
    with pytest.raises(carom.CaromError, match=re.escape(message)) as caught:
        part()
    assert str(caught.value).startswith(f"{caught.value.field}: ")


def test_a_random_filling_with_a_range_of_radii_needs_no_other_size() -> None:
    fill = carom.RandomFill(
        3, (0, 0, 0), (9, 9, 9), 1, carom.Sphere(density=1000), radius_range=(0.1, 0.2)
    )
    radii = carom.Scene(name="grains", generators=[fill]).world().radii
    assert len(radii) == 3 and (radii >= 0.1).all() and (radii <= 0.2).all()


def test_replacing_a_field_checks_it() -> None:
    with pytest.raises(carom.CaromError, match=r"^Sphere\.restitution: must be in \[0, 1\]"):
        replace(BALL, restitution=2)


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        (np.array([1, 2, 3]), (1, 2, 3)),
        (np.array([1, 2, 3], np.float32), (1.0, 2.0, 3.0)),
        ([np.float64(1), np.int32(2), 3], (1.0, 2, 3)),
        (range(3), (0, 1, 2)),
        (("5 cm", "=2 * 3", 0), ("5 cm", "=2 * 3", 0)),
    ],
)
def test_a_vector_is_kept_as_a_tuple(given: Any, kept: tuple[object, ...]) -> None:
    position = carom.Sphere(radius=1, position=given).position
    assert position == kept
    assert isinstance(position, tuple)
    assert {type(item) for item in position} <= {float, int, str}


@pytest.mark.parametrize("radius", [np.float32(0.5), np.array(0.5), "50 cm", "=1 / 2", ".5m"])
def test_a_number_of_numpy_and_a_text_with_a_unit_are_numbers(radius: Any) -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(radius=radius))
    assert world.radii.tolist() == [0.5]


def test_colours_and_turns_are_taken_as_scene_files_take_them() -> None:
    turned: Any = {"normal": (1, 0, 0)}
    world = carom.World()
    world.add_collider(carom.Collider(carom.HalfSpace(), rotation=turned, color="red"))
    [collider] = world.colliders.values()
    assert collider.color == (1, 0, 0)
    assert collider.rotation == pytest.approx((0, 0, -(0.5**0.5), 0.5**0.5))


def test_whole_numbers_past_64_bits_are_floats() -> None:
    sphere = carom.Sphere(radius=1, mass=10**20)
    assert (sphere.mass, type(sphere.mass)) == (1e20, float)
    world = carom.World()
    world.add_sphere(sphere)
    assert world.masses.tolist() == [1e20]


class Lazy(Sequence[carom.Sphere]):
    """Spheres that are never to be read."""

    __module__ = "carom.many"

    def __len__(self) -> int:
        return 1_000_000

    def __getitem__(self, index: Any) -> Any:
        raise AssertionError("a sphere was made")


def test_a_sequence_of_this_package_is_kept_as_it_is() -> None:
    many = Lazy()
    assert carom.Scene(name="many", spheres=many).spheres is many


def test_parts_are_values_as_before() -> None:
    one = carom.Sphere(radius=1, position=[0, 0, 1], velocity=np.zeros(3))
    other = carom.Sphere(radius=1.0, position=(0.0, 0.0, 1.0), velocity=(0, 0, 0))
    assert one == other
    assert hash(one) == hash(other)
    assert pickle.loads(pickle.dumps(one)) == copy.deepcopy(one) == one


def test_what_the_engine_holds_is_read_though_it_could_not_be_made_here() -> None:
    # Under another rule, the engine does not look at this number.
    text = 'name = "x"\nsimulation = { rule = "exact", contact = { sub_steps = 0 } }\n'
    scene = carom.Scene.from_toml(text)
    assert scene.simulation.contact.sub_steps == 0
    assert carom.Scene.from_toml(scene.to_toml()) == scene
    assert scene.world().simulation == scene.simulation


def test_a_field_that_the_engine_has_and_no_part_knows_is_told() -> None:
    with pytest.raises(TypeError, match=r"carom\.Gravity has no field pull"):
        text.part_of("forces", {"gravity": {"acceleration": [0, -1, 0], "pull": 1}})


KINDS: list[Any] = [
    it
    for it in [*vars(parts).values(), carom.Scene]
    if isinstance(it, type) and issubclass(it, parts.Part) and it is not parts.Part
]


@pytest.mark.parametrize("kind", KINDS)
def test_every_field_of_a_part_is_checked_and_its_default_is_sound(kind: Any) -> None:
    checks = checks_of(kind)
    assert [it.name for it in checks] == [it.name for it in fields(kind)]
    for check in checks:
        with pytest.raises(TypeError, match=rf"^{kind.__name__}\.{check.name}: must be "):
            check.keep(object())
        if check.default is not MISSING:
            assert check.keep(check.default) == check.default


def test_a_scene_of_ones_own_has_fields_of_its_own() -> None:
    @dataclass(frozen=True, kw_only=True)
    class Labelled(carom.Scene):
        label: "Label" = None  # type: ignore[assignment]
        number: int = 0

    class Label:
        pass

    label = Label()
    assert Labelled(name="x", label=label).label is label
    with pytest.raises(TypeError, match=r"Labelled\.number: must be a whole number, not 'a'"):
        Labelled(name="x", number="a")  # type: ignore[arg-type]


def test_every_name_of_a_finish_is_taken() -> None:
    for finish in get_args(carom.Finish):
        assert carom.Sphere(finish=finish).finish == finish


def test_a_camera_that_looks_at_a_point_is_the_one_of_a_scene_file() -> None:
    for position, target in [
        ((3, 4, 5), (0, 1, 0)),
        ((-1, -2, 7), (4, 9, 0)),
        ((0, 5, 0), (0, 0, 0)),
    ]:
        camera = carom.Camera(position, look_at=target)
        ball = "spheres = [{ radius = 1 }]"
        written = f"{ball}\ncamera = {{ position = {list(position)}, look_at = {list(target)} }}"
        read = carom.Scene.from_toml(written).camera
        assert read is not None
        # Both compute sines and cosines of angles, by other libraries.
        np.testing.assert_allclose(camera.rotation, read.rotation, rtol=0, atol=1e-15)
        scene = carom.Scene(name="looking", camera=camera, spheres=[BALL])
        assert carom.Scene.from_toml(scene.to_toml()).camera == camera
        assert replace(camera, near=1.0).rotation == camera.rotation
    with pytest.raises(carom.CaromError, match="look_at: must be another point than `position`"):
        carom.Camera((1, 1, 1), look_at=(1, 1, 1))
    with pytest.raises(carom.CaromError, match="takes `rotation` or `look_at`, not both"):
        carom.Camera((1, 1, 1), (0, 1, 0, 0), look_at=(0, 0, 0))
