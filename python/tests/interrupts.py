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
    """Presses Ctrl-C during the block, even if the shell makes the tests ignore it.

    Args:
        after: The earliest time to press it, from the start of the block [s].
        once: Returns whether it may be pressed; it is pressed when this first holds.
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
