"""The interface for browsers, as it was built into the package."""

from __future__ import annotations

import hashlib
from functools import cache
from pathlib import Path
from typing import NamedTuple

from carom.errors import GraphicsError

_FOLDER = Path(__file__).with_name("built")


class Interface(NamedTuple):
    """What a browser is handed, compressed by gzip."""

    script: bytes
    module: bytes
    version: str
    """Another text for another interface."""


@cache
def built_interface() -> Interface:
    """The interface for browsers.

    Raises:
        GraphicsError: If the package was built without it.
    """
    try:
        script = (_FOLDER / "page.js.gz").read_bytes()
        module = (_FOLDER / "carom.wasm.gz").read_bytes()
    except OSError as error:
        raise GraphicsError(
            "this build of carom has no viewer for notebooks; in the root of the repository, "
            "cargo xtask notebook builds it, and pip install '.[notebook]' then makes one that has"
        ) from error
    version = hashlib.sha256(script + module).hexdigest()[:16]
    return Interface(script, module, version)
