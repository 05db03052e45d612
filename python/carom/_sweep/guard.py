"""Scripts that start processes, which import the script again: they need a guard."""

from __future__ import annotations

import contextlib
import logging
import multiprocessing
import os
import tempfile
from collections.abc import Iterator
from pathlib import Path

from carom.errors import RunError

_MARK = "CAROM_SWEEP_MARK"
"""The variable of the environment that tells workers which file to make if they find no guard."""

_PROBLEM = (
    "carom.sweep: its worker processes import this script, so the call must stand under "
    'if __name__ == "__main__": (or give client="serial" to work in this process)'
)


class UnguardedError(RunError, SystemExit):
    """A worker has come to the call that started it.

    A script that does not catch it ends with the message in one line, as by `sys.exit`: a traceback
    would lead through Dask and not to the mistake.
    """

    def __init__(self) -> None:
        super().__init__(_PROBLEM)
        self.code = _PROBLEM


def check_not_in_worker() -> None:
    """Ends a process that reaches a sweep while it imports the script that started it."""
    is_importing = getattr(multiprocessing.current_process(), "_inheriting", False)
    if is_importing and (mark := os.environ.get(_MARK)) is not None:
        # The process that started this one tells.
        with contextlib.suppress(OSError):
            Path(mark).touch()
        raise SystemExit(1)


@contextlib.contextmanager
def telling_of_missing_guards() -> Iterator[None]:
    """While workers start, has their failure told as `UnguardedError` if it is that."""
    with tempfile.TemporaryDirectory(prefix="carom-sweep-", ignore_cleanup_errors=True) as folder:
        mark = Path(folder) / "unguarded"
        before = os.environ.get(_MARK)
        os.environ[_MARK] = str(mark)

        def is_of_interest(record: logging.LogRecord) -> bool:
            """Whether Dask tells of something else: workers that end early may worry it."""
            return not mark.exists()

        handlers = list(logging.getLogger("distributed").handlers)
        for handler in handlers:
            handler.addFilter(is_of_interest)
        try:
            yield
        except Exception:
            if mark.exists():
                raise UnguardedError from None
            raise
        finally:
            for handler in handlers:
                handler.removeFilter(is_of_interest)
            if before is None:
                os.environ.pop(_MARK, None)
            else:
                os.environ[_MARK] = before
