"""What the process of the window runs, as ``python -m``: nothing else imports it.

It opens the window with the scene whose text it reads from its standard input.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

from carom import _carom as engine


def main() -> int:
    """Watches the scene until the window is closed; the code to end with."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "scene.toml"
        file.write_bytes(sys.stdin.buffer.read())
        return engine.run_command(["carom", "view", str(file)], [])


if __name__ == "__main__":
    sys.exit(main())
