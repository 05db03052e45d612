"""``python -m carom``: the command line, with the scenes of Python."""

from __future__ import annotations

import sys

from carom._carom import run_command
from carom._scene.library import registered_texts
from carom.errors import CaromError


def main() -> int:
    """Does what the command line says, and returns the code to end with."""
    try:
        return run_command(["carom", *sys.argv[1:]], registered_texts())
    except CaromError as error:
        print(f"carom: {error}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main())
