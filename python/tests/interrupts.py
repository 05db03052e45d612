"""Ctrl-C, as a test presses it."""

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

_PATIENCE = 60.0
"""How long a busy machine may take for what happens soon [s]."""


@contextmanager
def ctrl_c(after: float = 0.0, once: Callable[[], bool] = lambda: True) -> Iterator[None]:
    """Presses Ctrl-C after so many seconds, also where the shell has the tests ignore it.

    Args:
        after: How many [s].
        once: Whether it may be pressed now: it is as soon as this is so.
    """

    def press() -> None:
        end = time.monotonic() + _PATIENCE
        while not once() and time.monotonic() < end:
            time.sleep(0.001)
        signal.raise_signal(signal.SIGINT)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(after, press)
    timer.start()
    try:
        yield
    finally:
        timer.join()
        signal.signal(signal.SIGINT, before)
