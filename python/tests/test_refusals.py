"""What is refused names the argument, in the words of the engine, and changes nothing."""

import pickle
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import carom

NAN, INF = float("nan"), float("inf")


@pytest.fixture
def world() -> carom.World:
    return carom.load("tutorial3").world()


def refused(
    world: carom.World, call: Callable[[], Any], error: type[Exception], words: str
) -> pytest.ExceptionInfo[Exception]:
    """Checks that a call is refused with these words, and that nothing has changed."""

    def state() -> tuple[object, ...]:
        arrays = (world.positions, world.velocities, world.radii, world.masses, world.ids)
        described = (world.forces, world.colliders, world.emitters, world.simulation)
        return (world.state_hash, world.time, *described, *(array.tolist() for array in arrays))

    before = state()
    with pytest.raises(error) as caught:
        call()
    assert words in str(caught.value)
    assert state() == before
    return caught


@pytest.mark.parametrize("dt", [0.0, -0.1, NAN, INF])
def test_a_frame_of_no_length(world: carom.World, dt: float) -> None:
    caught = refused(world, lambda: world.step(dt=dt), carom.CaromError, "`dt` must be positive")
    assert isinstance(caught.value, carom.CaromError) and caught.value.field == "dt"


@pytest.mark.parametrize("call", ["step", "run"])
def test_an_argument_of_another_kind(world: carom.World, call: str) -> None:
    run: Callable[..., object] = getattr(world, call)
    refused(world, lambda: run(dt="0.1"), TypeError, "dt: must be a number, not str")
    refused(world, lambda: run(frames=1.5), TypeError, "frames: must be a whole number, not float")
    refused(world, lambda: run(frames=-1), carom.CaromError, "frames: must be in [0, 2^64), not -1")


def test_a_step_that_overflows(world: carom.World) -> None:
    world.velocities = 1e200
    refused(world, lambda: world.step(dt=1e200), carom.StepError, "no longer finite")


def test_the_sixth_of_ten_steps_that_overflows() -> None:
    world = carom.World()
    world.simulation = carom.Simulation(rule="discrete", frame_time=1e153)
    world.add_force(carom.Gravity())
    # It falls g dt² k (k + 1) / 2 in k frames: 1.5e308 m in five, more than a float64 holds in six.
    world.add_sphere(carom.Sphere(radius=1))
    refused(world, lambda: world.step(frames=10), carom.StepError, "no longer finite")
    refused(world, lambda: world.run(frames=10), carom.StepError, "no longer finite")
    world.step(frames=5)
    assert np.isfinite(world.positions).all()


@pytest.mark.parametrize(
    ("quantity", "value", "words"),
    [
        ("positions", NAN, "`position` must be finite"),
        ("velocities", INF, "`velocity` must be finite"),
        ("radii", -1.0, "`radius` must be positive"),
        ("radii", 0.0, "`radius` must be positive"),
        ("masses", -1.0, "`mass` must be positive"),
        ("masses", NAN, "`mass` must be positive"),
        ("restitutions", 1.5, "`restitution` must be in [0, 1]"),
    ],
)
def test_a_bad_number_in_an_array(
    world: carom.World, quantity: str, value: float, words: str
) -> None:
    values = getattr(world, quantity).copy()
    values[-1] = value
    caught = refused(
        world, lambda: setattr(world, quantity, values), carom.CaromError, f"{quantity}: sphere"
    )
    assert words in str(caught.value)
    assert isinstance(caught.value, carom.CaromError) and caught.value.field == quantity


@pytest.mark.parametrize("quantity", ["positions", "velocities"])
@pytest.mark.parametrize("shape", [(2,), (2, 3), (3, 2), (1, 1, 3), (0, 3)])
def test_an_array_of_another_shape(
    world: carom.World, quantity: str, shape: tuple[int, ...]
) -> None:
    if shape == (1, 1, 3):
        shape = (2, len(world), 3)
    words = f"{quantity}: must be of shape ({len(world)}, 3), not {shape}"
    refused(world, lambda: setattr(world, quantity, np.zeros(shape)), carom.CaromError, words)


@pytest.mark.parametrize(
    "values", ["abc", [1j], [None], [[1, 2], [3]], [True], np.array(["1"]), object()]
)
@pytest.mark.parametrize("quantity", ["velocities", "masses"])
def test_an_array_that_is_not_of_numbers(world: carom.World, quantity: str, values: object) -> None:
    words = f"{quantity}: must be an array of numbers"
    refused(world, lambda: setattr(world, quantity, values), TypeError, words)


def test_ids_cannot_be_assigned(world: carom.World) -> None:
    refused(world, lambda: setattr(world, "ids", [1]), AttributeError, "ids")


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"positions": [0, 0, 0], "radii": [1, 2]}, "radii: must be of shape (1,), not (2,)"),
        ({"positions": np.zeros((2, 2)), "radii": 1}, "positions: must be of shape (2, 3)"),
        ({"positions": np.zeros((2, 3)), "radii": [1, -1]}, "`radius` must be positive"),
        ({"positions": np.zeros((2, 3)), "radii": 1, "masses": -1}, "`mass` must be positive"),
        ({"positions": np.full((2, 3), NAN), "radii": 1}, "positions[0]: must be finite"),
    ],
)
def test_spheres_that_make_no_sense(
    world: carom.World, arguments: dict[str, Any], words: str
) -> None:
    refused(world, lambda: world.add_spheres(**arguments), carom.CaromError, words)


@pytest.mark.parametrize(
    ("sphere", "words"),
    [
        (carom.Sphere(), "spheres[0]: needs `radius` or `diameter`"),
        (carom.Sphere(radius="-1 m"), "spheres[0].radius: must be positive"),  # type: ignore[arg-type]
        (carom.Sphere(radius=1, mass="-1 g"), "spheres[0].mass: must be positive"),  # type: ignore[arg-type]
        (carom.Sphere(radius="1 kg"), 'spheres[0].radius: "1 kg" is in kg'),  # type: ignore[arg-type]
    ],
)
def test_a_sphere_in_which_only_the_engine_finds_no_sense(
    world: carom.World, sphere: carom.Sphere, words: str
) -> None:
    refused(world, lambda: world.add_sphere(sphere), carom.SceneError, words)
    refused(world, lambda: world.set_sphere(0, sphere), carom.SceneError, words)


def test_other_parts_in_which_only_the_engine_finds_no_sense(world: carom.World) -> None:
    flat = carom.Collider(carom.Box((1, "0 m", 1)))  # type: ignore[arg-type]
    refused(world, lambda: world.add_collider(flat), carom.SceneError, "shape.box.size.y")
    drive = carom.ViscousDrag("-1 kg/s")  # type: ignore[arg-type]
    refused(world, lambda: world.add_force(drive), carom.SceneError, "viscous-drag.coefficient")
    hasty = carom.Emitter(carom.Sphere(radius=1), period="0 s")  # type: ignore[arg-type]
    refused(world, lambda: world.add_emitter(hasty), carom.SceneError, "emitters[0].period")
    coarse = carom.Simulation(frame_time="-1 s")  # type: ignore[arg-type]
    words = "simulation.frame_time: must be positive"
    refused(world, lambda: setattr(world, "simulation", coarse), carom.SceneError, words)


def test_what_is_no_scene_makes_no_world() -> None:
    with pytest.raises(TypeError, match=r"scene: must be a carom\.Scene, not str"):
        carom.World("simtest1")  # type: ignore[arg-type]


@pytest.mark.parametrize("kind", ["sphere", "force", "spring", "collider", "emitter"])
def test_an_id_that_was_never_given(world: carom.World, kind: str) -> None:
    words = f"there is no {kind} 99 in this world"
    refused(world, lambda: getattr(world, f"remove_{kind}")(99), carom.UnknownError, words)


def test_what_cannot_be_an_id(world: carom.World) -> None:
    refused(world, lambda: world.remove_sphere(-1), carom.UnknownError, "no sphere -1 in this")
    refused(world, lambda: world.sphere(2**70), carom.UnknownError, f"no sphere {2**70} in this")
    words = "id: must be a whole number, not str"
    refused(world, lambda: world.remove_force("0"), TypeError, words)  # type: ignore[arg-type]


def test_runs_that_make_no_sense(world: carom.World) -> None:
    refused(world, lambda: world.run(-1), carom.CaromError, "seconds: must be zero or positive")
    refused(world, lambda: world.run(NAN), carom.CaromError, "seconds: must be zero or positive")
    refused(world, lambda: world.run(1, dt=0), carom.CaromError, "dt: must be positive")
    refused(world, lambda: world.run(1e300), carom.CaromError, "more than can be counted")
    refused(world, lambda: world.run(1, every=0), carom.CaromError, "every: must be at least 1")
    refused(world, lambda: world.run(1, frames=1), TypeError, "seconds and frames")
    lost = "every: must be at most 5, the number of frames, not 6: no state after the first"
    refused(world, lambda: world.run(frames=5, every=6), carom.CaromError, lost)
    out: Any = {"positions": np.empty((1, len(world), 3))}
    refused(world, lambda: world.run(frames=5, every=6, out=out), carom.CaromError, lost)
    words = "impacts: must be True or False, not str"
    refused(world, lambda: world.run(1, impacts="no"), TypeError, words)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("name", "meant"),
    [("velocites", "velocities"), ("position", "positions"), ("gravity", None)],
)
def test_what_a_world_has_not_cannot_be_set(
    world: carom.World, name: str, meant: str | None
) -> None:
    hint = f"; did you mean '{meant}'?" if meant else ""
    for one, kind in [(world, "World"), (carom.Batch("tutorial3", 2), "Batch")]:
        text = f"a carom.{kind} has no attribute '{name}'{hint}"
        with pytest.raises(AttributeError, match=f"^{re.escape(text)}$"):
            setattr(one, name, 0)


def test_a_class_of_ones_own_has_attributes_of_its_own() -> None:
    class Labelled(carom.World):
        pass

    world = Labelled()
    setattr(world, "label", "empty")  # noqa: B010
    assert vars(world) == {"label": "empty"}


def test_an_unknown_scene_is_told_with_the_nearest_name() -> None:
    with pytest.raises(carom.UnknownError, match='no scene "simtst1"; did you mean "simtest1"'):
        carom.load("simtst1")
    assert issubclass(carom.UnknownError, LookupError)


def test_a_broken_scene_text_is_told_with_its_line() -> None:
    with pytest.raises(carom.SceneError) as caught:
        carom.Scene.from_toml('name = "x"\n\n[[spheres]]\nradus = 1\n', source="x.toml")
    assert str(caught.value).startswith("x.toml:4: spheres[0].radus: unknown field")
    assert 'did you mean "radius"' in str(caught.value)
    assert (caught.value.field, caught.value.line) == ("spheres[0].radus", 4)


def test_a_change_that_leads_nowhere() -> None:
    with pytest.raises(carom.SceneError, match="there is no element 7"):
        carom.load("simtest1", {"emitters.7.period": 1})
    with pytest.raises(carom.SceneError, match=r"^simulation\.frame_time=-1: "):
        carom.load("simtest1", {"simulation.frame_time": -1})


def test_an_error_survives_the_way_to_another_process() -> None:
    with pytest.raises(carom.SceneError) as caught:
        carom.Scene.from_toml('name = "x"\nspheres = [{ radius = -1 }]\n')
    again = pickle.loads(pickle.dumps(caught.value))
    assert str(again) == str(caught.value)
    assert (again.field, again.line) == ("spheres[0].radius", 2)


def test_every_refusal_is_a_value_error() -> None:
    for error in (carom.SceneError, carom.UnknownError, carom.StepError):
        assert issubclass(error, carom.CaromError) and issubclass(error, ValueError)
