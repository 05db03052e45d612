"""Forces that are functions of Python: Verlet's scheme, between impacts that are exact."""

import copy
import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from interrupts import ctrl_c
from numpy.typing import NDArray

import carom


def trap(frequency: float = 2.0) -> carom.World:
    world = carom.World()
    world.add_sphere(carom.Sphere(position=(1, 0, 0), velocity=(0, 1, 0), radius=0.01, mass=3))
    world.add_force(lambda world: -3 * frequency**2 * world.positions)
    return world


def energy(world: carom.World) -> float:
    return world.kinetic_energy + 0.5 * 3 * 4 * float((world.positions**2).sum())


def test_a_frame_is_the_scheme_of_verlet_to_round_off() -> None:
    world, h = trap(), 0.05
    x, v = np.array([1.0, 0, 0]), np.array([0.0, 1, 0])
    for _ in range(100):
        world.step(dt=h)
        before = -4 * x
        x = x + h * v + 0.5 * h * h * before
        v = v + 0.5 * h * (before + -4 * x)
    # Some roundings in each frame.
    np.testing.assert_allclose(world.positions[0], x, rtol=0, atol=100 * 4e-16)
    np.testing.assert_allclose(world.velocities[0], v, rtol=0, atol=200 * 4e-16)


def test_energy_in_a_trap_swings_by_the_square_of_the_frame_and_does_not_drift() -> None:
    for h in (0.02, 0.04):
        world = trap()
        start = energy(world)
        swings = []
        for _ in range(200):
            world.step(dt=h, frames=10)
            swings.append(abs(energy(world) / start - 1))
        # (omega h / 2)^2 of the energy in the trap, which is all of it at most.
        bound = (2 * h / 2) ** 2
        assert max(swings[:100]) < bound
        assert max(swings[100:]) < bound


def test_frames_in_one_call_are_those_of_many_calls() -> None:
    one, many = trap(), trap()
    one.step(dt=0.01, frames=50)
    for _ in range(50):
        many.step(dt=0.01)
    assert one.state_hash == many.state_hash


def test_a_function_of_gravity_is_gravity_and_impacts_stay_exact() -> None:
    described, function = carom.World(), carom.World()
    for world in (described, function):
        world.add_collider(carom.Collider(carom.HalfSpace()))
        world.add_sphere(carom.Sphere(position=(0, 5, 0), radius=0.5, mass=2))
    described.add_force(carom.Gravity((0, -10, 0)))
    function.add_force(lambda world: np.outer(world.masses, (0, -10, 0)))
    one, other = described.run(2.0, dt=0.01), function.run(2.0, dt=0.01)
    np.testing.assert_allclose(other.positions, one.positions, rtol=0, atol=1e-12)
    np.testing.assert_allclose(other.impacts["time"], one.impacts["time"], rtol=0, atol=1e-12)


def test_a_run_records_what_steps_lead_to() -> None:
    world, stepped = trap(), trap()
    run = world.run(frames=9, dt=0.01, every=3)
    assert run.positions.shape == (4, 1, 3)
    for row in (1, 2, 3):
        stepped.step(dt=0.01, frames=3)
        assert run.positions[row].tolist() == stepped.positions.tolist()
        assert run.velocities[row].tolist() == stepped.velocities.tolist()
    assert world.state_hash == stepped.state_hash


def test_spheres_that_an_emitter_brings_are_under_the_force() -> None:
    world = carom.load("simtest4").world()
    world.add_force(lambda world: np.zeros((len(world), 3)))
    other = carom.load("simtest4").world()
    run, same = world.run(frames=60), other.run(frames=60)
    np.testing.assert_array_equal(run.ids, same.ids)
    np.testing.assert_allclose(run.positions, same.positions, rtol=0, atol=1e-12)


def test_applied_forces_act_beside_functions_and_are_kept() -> None:
    world = carom.World()
    world.add_spheres([(0, 0, 0), (3, 0, 0)], 0.5)
    world.applied_forces = [(2, 0, 0), (0, 0, 0)]
    world.add_force(lambda world: (0, 1, 0))
    world.step(dt=0.5)
    assert world.velocities.tolist() == [[1, 0.5, 0], [0, 0.5, 0]]
    assert world.applied_forces.tolist() == [[2, 0, 0], [0, 0, 0]]


def test_functions_are_found_changed_and_taken_away_by_their_ids() -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(radius=0.5))
    gravity = world.add_force(carom.Gravity((0, 0, 0)))

    def push(world: carom.World) -> tuple[float, float, float]:
        return (1, 0, 0)

    number = world.add_force(push)
    assert (gravity, number) == (0, -1)
    assert world.forces[number] is push
    world.set_force(number, lambda world: (0, 0, 2))
    world.step(dt=1.0)
    assert world.velocities.tolist() == [[0, 0, 2]]
    world.remove_force(number)
    world.step(dt=1.0)
    assert world.velocities.tolist() == [[0, 0, 2]]
    assert list(world.forces) == [gravity]
    with pytest.raises(carom.UnknownError):
        world.remove_force(number)


def test_a_copy_has_the_function_and_goes_its_own_way() -> None:
    world = trap()
    twin = copy.copy(world)
    for one in (world, twin):
        one.step(dt=0.01, frames=9)
    assert world.state_hash == twin.state_hash
    [number] = twin.forces
    twin.remove_force(number)
    assert list(world.forces) == [number]


@pytest.mark.parametrize(
    ("function", "problem"),
    [
        (lambda world: np.zeros((5, 3)), r"force -1: must be of shape \(1, 3\), not \(5, 3\)"),
        (lambda world: (np.nan, 0, 0), r"force -1\[0\]: must be finite"),
    ],
)
def test_a_force_that_makes_no_sense_leaves_the_world(function: object, problem: str) -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(radius=0.5))
    world.add_force(function)  # type: ignore[arg-type]
    before = world.state_hash
    with pytest.raises(carom.CaromError, match=problem):
        world.step(frames=3)
    assert world.state_hash == before


def test_an_exception_of_a_function_leaves_the_world() -> None:
    world, calls = trap(), []

    def fail(world: carom.World) -> tuple[float, float, float]:
        calls.append(world.time)
        if len(calls) > 3:
            raise ZeroDivisionError
        return (0, 0, 0)

    world.add_force(fail)
    before = world.state_hash
    with pytest.raises(ZeroDivisionError):
        world.step(frames=9)
    assert world.state_hash == before
    assert not world.applied_forces.any()


def test_ctrl_c_ends_a_run_under_functions_and_gives_back_what_it_has() -> None:
    world, calls = trap(), []

    def count(world: carom.World) -> tuple[float, float, float]:
        calls.append(world.time)
        return (0, 0, 0)

    world.add_force(count)
    with pytest.raises(KeyboardInterrupt) as stop, ctrl_c(once=lambda: len(calls) > 3):
        world.run(frames=10**7, dt=0.01)
    trajectory = stop.value.trajectory  # type: ignore[attr-defined]
    assert 0 < trajectory.time[-1] <= world.time


def test_what_knows_no_functions_says_so() -> None:
    world, batch = trap(), carom.Batch("tutorial1", 1)
    calls: list[Callable[[], object]] = [
        world.to_scene,
        lambda: world.step_to_next_event(1.0),
        lambda: world.next_event_time(1.0),
        lambda: batch.set_world(0, world),
    ]
    for call in calls:
        with pytest.raises(carom.CaromError, match="knows no functions among the forces"):
            call()


def test_discrete_rules_have_integrators_of_their_own() -> None:
    function, held = (
        carom.Scene(name="trap", simulation=carom.Simulation(rule="discrete")).world()
        for _ in range(2)
    )
    for world in (function, held):
        world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.1))
    function.add_force(lambda world: -world.positions)
    for _ in range(100):
        function.step(dt=0.01)
        held.applied_forces = -held.positions
        held.step(dt=0.01)
    assert function.positions.tolist() == held.positions.tolist()
    assert function.velocities.tolist() == held.velocities.tolist()


def test_threads_that_step_one_world_under_a_function_wait_for_each_other() -> None:
    world = carom.World()
    world.add_sphere(carom.Sphere(radius=0.5))

    def fall(world: carom.World) -> tuple[float, float, float]:
        time.sleep(0)
        return (0, -1, 0)

    world.add_force(fall)

    def work() -> None:
        for _ in range(100):
            world.step(dt=0.01)

    threads = [threading.Thread(target=work) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    # Some roundings in each frame.
    assert world.velocities[0, 1] == pytest.approx(-3.0, rel=1e-13)


def test_a_stopped_run_leaves_the_world_at_the_end_of_its_last_whole_frame() -> None:
    world, calls = trap(), []

    def stop(world: carom.World) -> tuple[float, float, float]:
        calls.append(world.time)
        if len(calls) == 8:
            raise KeyboardInterrupt
        return (0, 0, 0)

    world.add_force(stop)
    with pytest.raises(KeyboardInterrupt) as stopped:
        world.run(frames=100, dt=0.01)
    trajectory = stopped.value.trajectory  # type: ignore[attr-defined]
    assert trajectory.time[-1] == world.time == pytest.approx(0.06)
    assert trajectory.velocities[-1].tolist() == world.velocities.tolist()


def test_a_step_of_a_class_of_ones_own_stands() -> None:
    class Counted(carom.World):
        steps = 0

        def step(self, **arguments: Any) -> None:  # type: ignore[override]
            type(self).steps += 1
            super().step(**arguments)

    world = Counted()
    world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.1))
    world.add_force(lambda world: -world.positions)
    world.step(dt=0.1)
    assert Counted.steps == 1
    assert world.velocities[0, 0] < 0


def test_arguments_are_those_of_a_world_without_functions() -> None:
    functional, plain = trap(), carom.World()
    for world in (functional, plain):
        with pytest.raises(carom.CaromError, match="every: must be at least 1"):
            world.run(frames=1, dt=0.1, every=0)
        with pytest.raises(carom.CaromError, match=r"frames: must be in \[0, 2\^64\), not -3"):
            world.step(frames=-3)
        for frames in (True, 2.5):
            with pytest.raises(TypeError, match="frames: must be a whole number, not"):
                world.step(frames=frames)  # type: ignore[arg-type]
        with pytest.raises(TypeError, match="by its name"):
            world.step(10)  # type: ignore[arg-type]


def remove_another(world: carom.World) -> tuple[float, float, float]:
    world.remove_sphere(world.ids[-1])
    return (0, 0, 0)


def step_on(world: carom.World) -> tuple[float, float, float]:
    world.step()
    return (0, 0, 0)


def move_by_mistake(world: carom.World) -> NDArray[np.float64]:
    positions = world.positions
    positions -= positions.mean(axis=0)
    return -positions


@pytest.mark.parametrize(
    ("function", "error", "problem"),
    [
        (remove_another, carom.CaromError, "neither add nor remove spheres"),
        (step_on, carom.CaromError, "must not step the world"),
        (move_by_mistake, ValueError, "read-only"),
    ],
)
def test_a_function_that_changes_its_world_is_refused(
    function: Callable[[carom.World], Any], error: type[Exception], problem: str
) -> None:
    world = carom.World()
    world.add_spheres([(1, 0, 0), (4, 0, 0)], 0.5)
    number = world.add_force(function)
    before = world.state_hash
    with pytest.raises(error, match=problem):
        world.step(dt=0.1)
    assert world.state_hash == before
    world.remove_force(number)
    # Arrays can be written to as before.
    world.positions[0] = (0, 0, 0)
    world.step(dt=0.1)


def test_a_copy_shares_functions_and_whatever_they_hold() -> None:
    class Spring:
        def __init__(self) -> None:
            self.calls = 0
            self.lock = threading.Lock()

        def force(self, world: carom.World) -> NDArray[np.float64]:
            self.calls += 1
            return -world.positions

    spring, world = Spring(), carom.World()
    world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.1))
    world.add_force(spring.force)
    copy.copy(world).step(dt=0.1)
    assert spring.calls == 2


@pytest.mark.parametrize(
    ("call", "problem"),
    [
        (
            lambda w: w.add_force((0, -9.81, 0)),
            "force: must be a carom.ConstantForce, .* or a function",
        ),
        (
            lambda w: w.add_force(carom.Gravity),
            r"the class Gravity; write carom\.Gravity\(\.\.\.\)",
        ),
        (
            lambda w: w.add_collider(carom.HalfSpace()),
            "collider: must be a carom.Collider, not carom.HalfSpace",
        ),
        (lambda w: w.add_sphere((0, 0, 0)), "sphere: must be a carom.Sphere, not tuple"),
        (lambda w: w.add_emitter(None), "emitter: must be a carom.Emitter, not NoneType"),
        (lambda w: w.set_sphere(0, 1), "sphere: must be a carom.Sphere, not int"),
        (lambda w: w.set_force(-1, carom.Gravity()), "force: -1 is a function; remove it"),
    ],
)
def test_parts_of_another_kind_are_refused_by_name(
    call: Callable[[carom.World], object], problem: str
) -> None:
    with pytest.raises(TypeError, match=problem):
        call(trap())


def test_without_its_functions_a_heap_sleeps_again() -> None:
    world = carom.Scene(name="heap", simulation=carom.Simulation(rule="contact")).world()
    world.add_collider(carom.Collider(carom.HalfSpace(), restitution=0.0))
    world.add_force(carom.Gravity())
    world.add_spheres([(0, 0.5, 0), (2, 0.5, 0)], 0.5, restitutions=0.0)
    number = world.add_force(lambda world: np.zeros((len(world), 3)))
    world.step(frames=5)
    world.remove_force(number)
    world.step(frames=120)
    assert world.contact_account.asleep == 2


def test_ctrl_c_while_numpy_reads_an_argument_is_no_wrong_argument() -> None:
    class Stopped:
        def __array__(self, *_: object, **__: object) -> object:
            raise KeyboardInterrupt

    world, name = trap(), "applied_forces"
    with pytest.raises(KeyboardInterrupt):
        setattr(world, name, Stopped())
