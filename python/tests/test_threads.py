"""Long calls let other threads of Python run, and can be stopped."""

import os
import signal
import threading
import time

import pytest
from interrupts import ctrl_c

import carom


def gas() -> carom.World:
    """A world that takes a while to step."""
    lattice = carom.Lattice((10, 10, 10), (-9, -9, -9), (2, 2, 2), carom.Sphere(radius=0.6))
    box = carom.Simulation(boundary=carom.Periodic((20, 20, 20)))
    world = carom.Scene(name="gas", simulation=box, generators=[lattice]).world()
    world.velocities = [(i % 7 - 3, i % 5 - 2, i % 3 - 1) for i in range(1000)]
    return world


@pytest.mark.parametrize("call", ["step", "run"])
def test_other_threads_run_during_a_long_call(call: str) -> None:
    world = gas()
    # Within one frame, for `run` looks up between two.
    arguments = {"dt": 20.0, "frames": 1}
    began, ended = [0.0], [0.0]

    def work() -> None:
        began[0] = time.perf_counter()
        getattr(world, call)(**arguments)
        ended[0] = time.perf_counter()

    thread = threading.Thread(target=work)
    ticks = []
    thread.start()
    while thread.is_alive():
        ticks.append(time.perf_counter())
        time.sleep(0.001)
    within = [tick for tick in ticks if began[0] < tick < ended[0]]
    took = ended[0] - began[0]
    # A call that kept the others waiting would leave a few ticks at its ends. Of those that fit in,
    # a tenth is enough on a machine at work.
    assert len(within) > 0.1 * took / 0.002


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
    with pytest.raises(KeyboardInterrupt), ctrl_c(after=0.5):
        world.run(seconds=1e6)
    stopped = world.time
    assert 0 < stopped < 1e6
    world.step()
    assert world.time > stopped


def test_a_frame_of_minutes_is_stopped_by_ctrl_c() -> None:
    world = gas()
    before = world.state_hash
    with pytest.raises(KeyboardInterrupt), ctrl_c(after=0.5):
        world.step(1e6)
    assert world.time == 0
    assert world.state_hash == before
    world.step()
    assert world.time > 0


def test_a_signal_handler_in_the_middle_of_a_step_is_not_kept_waiting() -> None:
    world, other = gas(), gas()
    seen: list[str] = []

    def look(*_: object) -> None:
        seen.append(f"{other.time}")
        with pytest.raises(RuntimeError) as error:
            seen.append(f"{world.time}")
        seen.append(str(error.value))
        raise InterruptedError

    before = signal.signal(signal.SIGALRM, look)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(InterruptedError):
            world.step(1e6)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen == ["0.0", "this world is in the middle of a step"]


def test_a_signal_handler_may_ask_the_world_how_far_it_is() -> None:
    world = gas()
    seen: list[float] = []

    def look(*_: object) -> None:
        seen.append(world.time)
        raise InterruptedError

    before = signal.signal(signal.SIGALRM, look)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(InterruptedError):
            world.run(seconds=1e6)
    finally:
        signal.signal(signal.SIGALRM, before)
    assert seen == [world.time]
