"""``python -m carom``, as a process of its own."""

import subprocess
import sys


def carom_command(*arguments: str, code: int = 0) -> subprocess.CompletedProcess[str]:
    """Runs it, and checks the code that it ends with."""
    command = [sys.executable, "-m", "carom", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == code, done.stderr
    return done
