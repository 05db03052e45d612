"""Ctrl-C and alarms in tests, and turns of other threads."""

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_PATIENCE = 300.0
"""How long a busy machine may take for what happens soon [s]."""


def at_work(work: float = 0.2) -> Callable[[], bool]:
    """Returns a condition that holds when this process has used some processor time from now on.

    Time on the clock passes while a busy machine lets the process wait.

    Args:
        work: The processor time [s].
    """
    begin = time.process_time()
    return lambda: time.process_time() - begin > work


@contextmanager
def ctrl_c(once: Callable[[], bool]) -> Iterator[None]:
    """Presses Ctrl-C during the block, even if the shell makes the tests ignore it.

    Args:
        once: Returns whether it may be pressed; it is pressed when this first holds.
    """

    def press() -> None:
        end = time.monotonic() + _PATIENCE
        while not once() and time.monotonic() < end:
            time.sleep(0.001)
        signal.raise_signal(signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    presser = threading.Thread(target=press)
    presser.start()
    try:
        yield
    finally:
        presser.join()
        signal.signal(signal.SIGINT, before)


@contextmanager
def alarms_every(pause: float, handler: Callable[..., object]) -> Iterator[None]:
    """Calls a handler of SIGALRM again and again during the block, with a pause between [s]."""
    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, pause, pause)
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


@contextmanager
def turns_of_another_thread() -> Iterator[Callable[[], int]]:
    """Yields a function that returns how often another thread of Python has run in the block."""
    count = 0
    ended = threading.Event()

    def work() -> None:
        nonlocal count
        while not ended.wait(0.001):
            count += 1

    thread = threading.Thread(target=work)
    thread.start()
    try:
        yield lambda: count
    finally:
        ended.set()
        thread.join()
