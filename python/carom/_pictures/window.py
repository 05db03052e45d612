"""The window, in a process of its own: a program has one at most, on its first thread."""

from __future__ import annotations

import subprocess
import sys
import tempfile

from carom import _carom as engine
from carom.errors import GraphicsError

START = 1.0
"""By then, a window that cannot be opened has failed, on a machine that is not busy [s]."""


def open_text(text: str) -> subprocess.Popen[bytes]:
    """Opens the window with the scene that is described in TOML, and does not wait for its end.

    Raises:
        GraphicsError: If this build has no window, or it cannot be opened.
    """
    if not engine.HAS_WINDOW:
        raise GraphicsError(
            "this build of carom has no window; in the root of the repository, "
            "MATURIN_PEP517_ARGS='--features view' pip install . makes one that has"
        )
    command = [sys.executable, "-m", "carom._pictures.window_process"]
    with tempfile.TemporaryFile() as errors:
        process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=errors)
        assert process.stdin is not None
        with process.stdin as pipe:
            pipe.write(text.encode())
        try:
            process.wait(START)
        except subprocess.TimeoutExpired:
            return process
        if process.returncode:
            errors.seek(0)
            raise GraphicsError(errors.read().decode(errors="replace").strip())
    return process
