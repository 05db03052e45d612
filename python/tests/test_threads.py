"""Long calls let other threads of Python run, and can be stopped."""

import multiprocessing
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable
from functools import partial
from typing import TypeAlias

import pytest
from interrupts import alarms_every, at_work, ctrl_c, turns_of_another_thread

import carom

Call: TypeAlias = Callable[[], object]

_PATIENCE = 300
"""How long a busy machine may take for what happens soon [s]."""


def gas() -> carom.World:
    """A world that takes a while to step."""
    world = gas_scene().world()
    world.velocities = [(i % 7 - 3, i % 5 - 2, i % 3 - 1) for i in range(1000)]
    return world


def gas_scene() -> carom.Scene:
    """The scene of it, where all is at rest."""
    lattice = carom.Lattice((10, 10, 10), (-9, -9, -9), (2, 2, 2), carom.Sphere(radius=0.6))
    box = carom.Simulation(boundary=carom.Periodic((20, 20, 20)))
    return carom.Scene(name="gas", simulation=box, generators=[lattice])


@pytest.mark.parametrize("call", ["step", "run"])
def test_other_threads_run_during_a_long_call(call: str) -> None:
    world = gas()
    with turns_of_another_thread() as turns:
        before = turns()
        # Within one frame, for `run` looks up between two.
        getattr(world, call)(dt=100.0, frames=1)
        within = turns() - before
    # A call that keeps the others waiting leaves them a turn at its begin and one at its end.
    assert within > 10


def test_threads_that_use_one_world_wait_for_each_other() -> None:
    world, alone = gas(), gas()
    threads = [threading.Thread(target=lambda: world.step(frames=5)) for _ in range(4)]
    for thread in threads:
        thread.start()
    seen = [len(world) for _ in range(100)]
    for thread in threads:
        thread.join()
    alone.step(frames=20)
    assert seen == [1000] * 100
    assert world.state_hash == alone.state_hash


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no forked processes")
@pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning")
def test_a_heap_is_stepped_in_a_forked_process_as_in_its_parent() -> None:
    # So many that threads share them.
    ball = carom.Sphere(radius=0.5, restitution=0.0)
    balls = carom.Lattice((12, 10, 12), (0, 0.6, 0), (1.05, 1.05, 1.05), ball)
    scene = carom.Scene(
        name="heap",
        simulation=carom.Simulation(rule="contact"),
        forces=[carom.Gravity((0, -9.81, 0))],
        colliders=[carom.Collider(carom.HalfSpace())],
        generators=[balls],
    )
    world = scene.world()
    world.step(frames=3)
    child = os.fork()
    if child == 0:
        world.step(frames=3)
        os._exit(int(world.state_hash, 16) % 251)
    world.step(frames=3)
    _, status = os.waitpid(child, 0)
    assert os.waitstatus_to_exitcode(status) == int(world.state_hash, 16) % 251


def test_a_run_is_stopped_by_ctrl_c() -> None:
    world = gas()
    with pytest.raises(KeyboardInterrupt) as stop, ctrl_c(once=at_work()):
        world.run(seconds=1e6)
    stopped = world.time
    assert 0 < stopped < 1e6
    # What was recorded until then is there.
    trajectory = stop.value.trajectory  # type: ignore[attr-defined]
    assert trajectory.time[-1] == stopped
    assert trajectory.positions[-1].tolist() == world.positions.tolist()
    world.step()
    assert world.time > stopped


def test_a_frame_of_minutes_is_stopped_by_ctrl_c() -> None:
    world = gas()
    before = world.state_hash
    with pytest.raises(KeyboardInterrupt), ctrl_c(once=at_work()):
        world.step(dt=1e6)
    assert world.time == 0
    assert world.state_hash == before
    world.step()
    assert world.time > 0


def test_a_signal_handler_in_the_middle_of_a_step_is_not_kept_waiting() -> None:
    world, other = gas(), gas()
    rings = [0]
    seen: list[str] = []

    def look(*_: object) -> None:
        rings[0] += 1
        try:
            # Before the step begins, the world answers.
            assert len(world) == 1000 and rings[0] < 1000
        except RuntimeError as error:
            seen.extend([str(other.time), str(error)])
            raise InterruptedError from None

    with alarms_every(0.02, look), pytest.raises(InterruptedError):
        world.step(dt=1e6)
    assert seen == ["0.0", "this world is in the middle of a step"]


@pytest.mark.parametrize("dt", [None, 1e6], ids=["short frames", "one frame of minutes"])
def test_a_signal_handler_may_ask_the_world_how_far_it_is(dt: float | None) -> None:
    world = gas()
    world.step()
    seen: list[float] = []

    def look(*_: object) -> None:
        seen.append(world.time)
        raise InterruptedError

    before = signal.signal(signal.SIGALRM, look)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(InterruptedError):
            world.run(seconds=1e6, dt=dt)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen == [world.time]
    assert seen[0] > 0


def few(n: int, threads: int = 2) -> carom.Batch:
    """Worlds of a few balls that collide often."""
    return carom.Batch("gas", n, threads=threads)


# Calls that would take for ever, of worlds that are there.


def many_frames() -> Call:
    return partial(gas().step, dt=1e-3, frames=10**9)


def many_frames_of_many_spheres() -> Call:
    return partial(crowd().step, dt=1e-3, frames=10**9)


def a_long_frame_of_many_spheres() -> Call:
    return partial(crowd().step, dt=1e6)


def crowd() -> carom.World:
    """So many that threads share them, while the caller waits."""
    lattice = carom.Lattice((15, 10, 10), (-14, -9, -9), (2, 2, 2), carom.Sphere(radius=0.6))
    box = carom.Simulation(boundary=carom.Periodic((30, 20, 20)))
    world = carom.Scene(name="crowd", simulation=box, generators=[lattice]).world()
    world.velocities = [(i % 7 - 3, i % 5 - 2, i % 3 - 1) for i in range(1500)]
    return world


def many_worlds() -> Call:
    return partial(few(4).step, dt=1e-3, frames=10**9)


def many_worlds_in_one_thread() -> Call:
    return partial(few(4, threads=1).step, dt=1e-3, frames=10**9)


def a_long_frame_of_sub_steps() -> Call:
    overrides = {"simulation.rule": "contact", "simulation.contact.sub_steps": 2**32 - 1}
    return partial(carom.load("pour", overrides).world().step, dt=1e3)


def a_long_frame_of_worlds() -> Call:
    return partial(few(4).step, dt=1e6)


def a_long_frame_of_a_batch_of_sub_steps() -> Call:
    overrides = {"simulation.rule": "contact", "simulation.contact.sub_steps": 2**32 - 1}
    return partial(carom.Batch(carom.load("billiards", overrides), 4, threads=2).step, dt=1e3)


def a_long_run() -> Call:
    return partial(gas().run, frames=10**6, dt=1e-3, quantities=[])


@pytest.mark.parametrize(
    "prepared",
    [
        many_frames,
        many_frames_of_many_spheres,
        a_long_frame_of_many_spheres,
        many_worlds,
        many_worlds_in_one_thread,
        a_long_frame_of_sub_steps,
        a_long_frame_of_worlds,
        a_long_frame_of_a_batch_of_sub_steps,
        a_long_run,
    ],
)
def test_ctrl_c_ends_every_long_call(prepared: Callable[[], Call]) -> None:
    call = prepared()
    with pytest.raises(KeyboardInterrupt), ctrl_c(once=at_work()):
        call()


def test_worlds_of_a_batch_that_was_stopped_are_at_the_end_of_a_frame() -> None:
    batch = few(4)
    with pytest.raises(KeyboardInterrupt), ctrl_c(once=at_work()):
        batch.step(dt=1e-3, frames=10**9)
    assert batch.times[0] > 0
    world = few(1).world(0)
    world.step(dt=1e-3, frames=round(batch.times[0] / 1e-3))
    assert int(world.state_hash, 16) == batch.state_hashes[0]


def stepped_by(process: multiprocessing.Process) -> int:
    process.start()
    process.join(_PATIENCE)
    if process.is_alive():
        process.kill()
        pytest.fail("a child waits for threads of its parent")
    assert process.exitcode is not None
    return process.exitcode


@pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning")
@pytest.mark.parametrize("method", multiprocessing.get_all_start_methods())
def test_batches_and_environments_step_in_children_of_every_kind(method: str) -> None:
    # Threads are at work in the parent before.
    batch_in_a_child()
    context = multiprocessing.get_context(method)
    for _ in range(5):
        assert stepped_by(context.Process(target=batch_in_a_child)) == 0  # type: ignore[attr-defined]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no forked processes")
@pytest.mark.filterwarnings("ignore:.*use of fork:DeprecationWarning")
def test_a_batch_made_before_a_fork_is_stepped_after_it() -> None:
    batch = few(8)
    batch.step(frames=2)
    for _ in range(50):
        child = os.fork()
        if child == 0:
            signal.alarm(_PATIENCE)
            batch.step()
            os._exit(int(batch.state_hashes[0] % 251))
        batch.step()
        _, status = os.waitpid(child, 0)
        assert os.waitstatus_to_exitcode(status) == batch.state_hashes[0] % 251


def batch_in_a_child() -> None:
    batch = few(8)
    batch.step(frames=2)


@pytest.mark.skipif(sys.platform != "linux", reason="limits of memory are those of Linux")
@pytest.mark.parametrize(
    "call",
    [
        "world.run(frames=20_000)",
        "world.run(frames=20_000, dtype='float32')",
        "world.run(frames=2**63)",
        "carom.Batch('tutorial4', 10**9)",
    ],
)
def test_what_does_not_fit_into_memory_is_refused_before_the_work(call: str) -> None:
    program = f"""
import resource
import carom

scene = carom.load("gas")
ball = carom.Sphere(radius=0.01)
balls = carom.Lattice((40, 25, 10), (0, 0, 0), (0.1, 0.1, 0.1), ball)
world = carom.Scene(name="many", generators=[balls]).world()
resource.setrlimit(resource.RLIMIT_AS, (3 * 2**30, 3 * 2**30))
try:
    {call}
except MemoryError as error:
    assert world.time == 0
    print("refused:", error)
"""
    answer = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert answer.returncode == 0, answer.stderr
    assert answer.stdout.startswith("refused:")


def test_a_handler_that_comes_while_an_error_is_made_is_not_kept_waiting() -> None:
    world = gas()
    seen: list[float] = []
    with alarms_every(0.001, lambda *_: seen.append(world.time)):
        while len(seen) < 300:
            with pytest.raises(carom.CaromError):
                world.step(dt=-1.0)
            with pytest.raises(carom.CaromError):
                world.masses = -1
    assert set(seen) == {0.0}
