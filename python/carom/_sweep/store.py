"""Finished runs in a file, which outlives the process that writes it."""

from __future__ import annotations

import functools
import hashlib
import io
import json
import os
import sqlite3
from collections.abc import Callable, Iterable, Mapping
from types import TracebackType
from typing import Any, NamedTuple

import numpy as np

from carom._scene.scene import Scene
from carom._scene.text import toml_of
from carom._sweep.experiment import Measured, Run
from carom._sweep.fingerprint import fingerprint_of, tells_of_change
from carom._sweep.plan import canonical_text
from carom.errors import CaromError

_APPLICATION = 0x4361_726F
"""Distinguishes stores from other files of SQLite: "Caro"."""
_FORMAT = 1
_PATIENCE = 60.0
"""How long to wait [s] for another process that writes into the same store."""

_TABLE = """
CREATE TABLE IF NOT EXISTS runs (
    key TEXT PRIMARY KEY,
    measure TEXT NOT NULL,
    version TEXT NOT NULL,
    parameters TEXT NOT NULL,
    seed INTEGER,
    names TEXT NOT NULL,
    arrays BLOB NOT NULL
)
"""
"""What was measured is an ``.npz``, with an array for each of the names (JSON)."""

_CODE_TABLE = """
CREATE TABLE IF NOT EXISTS codes (
    key TEXT PRIMARY KEY,
    fingerprint TEXT NOT NULL
)
"""
"""The code of ``measure`` by which a run was measured; none for runs of older stores."""


class Key(NamedTuple):
    """What finds a finished run, and what describes it to people."""

    digest: str
    parameters: str
    seed: int | None


class Store:
    """A file of SQLite, into which one process writes.

    SQLite commits a batch of runs wholly or not at all, whatever is killed when.
    """

    def __init__(
        self, path: str | os.PathLike[str], measure: Callable[..., Any], version: str
    ) -> None:
        """Opens a store, or makes it.

        Raises:
            CaromError: If it cannot be opened, or is another kind of file, or if ``measure`` has
                no name.
        """
        self._measure, self._version = _name_of(measure), version
        self._fingerprint = fingerprint_of(measure)
        self._path = os.fspath(path)
        try:
            self._database = sqlite3.connect(self._path, timeout=_PATIENCE)
            try:
                self._prepare()
            except BaseException:
                self._database.close()
                raise
        except sqlite3.Error as error:
            raise CaromError(f"store: {self._path}: {error}", "store") from error

    def _prepare(self) -> None:
        [application] = self._database.execute("PRAGMA application_id").fetchone()
        [number] = self._database.execute("PRAGMA user_version").fetchone()
        [tables] = self._database.execute("SELECT count(*) FROM sqlite_master").fetchone()
        if tables and (application, number) != (_APPLICATION, _FORMAT):
            told = f"format {number}" if application == _APPLICATION else "another application"
            raise CaromError(f"store: {self._path}: is a file of {told}", "store")
        if not tables:
            with self._database:
                self._database.execute(_TABLE)
                self._database.execute(f"PRAGMA application_id = {_APPLICATION}")
                self._database.execute(f"PRAGMA user_version = {_FORMAT}")
        with self._database:
            self._database.execute(_CODE_TABLE)

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        self._database.close()

    def key(self, run: Run, scene: Scene) -> Key:
        """What a run is found by: its scene, parameters and seed, and how it is measured."""
        parameters = canonical_text(run.parameters)
        parts = [toml_of(scene), parameters, run.seed, self._measure, self._version]
        digest = hashlib.sha256(json.dumps(parts).encode()).hexdigest()
        return Key(digest, parameters, run.seed)

    def find(self, key: Key) -> Measured | None:
        """What a run has measured, if it is finished."""
        question = "SELECT names, arrays FROM runs WHERE key = ?"
        row = self._database.execute(question, (key.digest,)).fetchone()
        return None if row is None else _unpack(*row)

    def is_of_other_code(self, key: Key) -> bool:
        """Whether a finished run was measured before the code of ``measure`` was changed."""
        question = "SELECT fingerprint FROM codes WHERE key = ?"
        row = self._database.execute(question, (key.digest,)).fetchone()
        now = self._fingerprint
        return row is not None and now is not None and tells_of_change(row[0], now)

    def add(self, finished: Iterable[tuple[Key, Measured]]) -> None:
        """Writes down finished runs, all or none of them; those that are there stay."""
        rows = [
            (key.digest, self._measure, self._version, key.parameters, key.seed, *_pack(measured))
            for key, measured in finished
        ]
        codes = [] if self._fingerprint is None else [(row[0], self._fingerprint) for row in rows]
        with self._database:
            self._database.executemany(
                "INSERT OR IGNORE INTO runs VALUES (?, ?, ?, ?, ?, ?, ?)", rows
            )
            self._database.executemany("INSERT OR IGNORE INTO codes VALUES (?, ?)", codes)


def _pack(measured: Mapping[str, Any]) -> tuple[str, bytes]:
    file = io.BytesIO()
    np.savez(file, *measured.values())
    return json.dumps(list(measured)), file.getvalue()


def _unpack(names: str, arrays: bytes) -> Measured:
    with np.load(io.BytesIO(arrays), allow_pickle=False) as file:
        return {name: file[f"arr_{index}"] for index, name in enumerate(json.loads(names))}


def _name_of(measure: Callable[..., Any]) -> str:
    """The qualified name of a function, and of what `functools.partial` gives it."""
    if isinstance(measure, functools.partial):
        given = {f"#{place}": value for place, value in enumerate(measure.args)}
        return f"{_name_of(measure.func)}({canonical_text({**given, **measure.keywords})})"
    name = getattr(measure, "__qualname__", None)
    if name is None or name.endswith("<lambda>"):
        raise CaromError(
            "measure: needs a name to be found in a store again: give a function made by def",
            "measure",
        )
    return f"{measure.__module__}.{name}"
