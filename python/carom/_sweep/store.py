"""Finished runs in a file, which outlives the process that writes it."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import io
import json
import os
import re
import sqlite3
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from types import TracebackType
from typing import Any, Literal, NamedTuple

import numpy as np

from carom._scene.scene import Scene
from carom._scene.text import toml_of
from carom._sweep.experiment import Measured, Run
from carom._sweep.fingerprint import fingerprint_of, tells_of_change
from carom._sweep.plan import Part, canonical_text
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
CREATE {kind} TABLE codes (
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

    SQLite commits a batch of runs wholly or not at all, whatever is killed when. A part of a sweep
    has a file of its own beside the store: processes on several machines share no file, as file
    systems of clusters may not lock.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        measure: Callable[..., Any],
        version: str,
        part: Part | None = None,
    ) -> None:
        """Opens a store, or makes it; the store of a whole sweep takes in the files of parts.

        Raises:
            CaromError: If it cannot be opened, or is another kind of file, or if ``measure`` has
                no name.
        """
        self._measure, self._version = _name_of(measure), version
        self._fingerprint = fingerprint_of(measure)
        with contextlib.ExitStack() as stack:
            if part is None:
                self._database = stack.enter_context(_opened(Path(path)))
                self._databases = [self._database]
                for file in _files_of_parts(Path(path)):
                    self._take_in(file)
            else:
                own = Path(f"{os.fspath(path)}.{part.index}-of-{part.count}")
                self._database = stack.enter_context(_opened(own))
                self._databases = [self._database]
                if Path(path).exists():
                    self._databases.append(stack.enter_context(_opened(Path(path), "ro")))
            self._open = stack.pop_all()

    def _take_in(self, file: Path) -> None:
        """Copies the runs of a part."""
        with _opened(file), _naming(file):
            self._database.execute("ATTACH ? AS part", (os.fspath(file),))
            with self._database:
                for table in ("runs", "codes"):
                    self._database.execute(
                        f"INSERT OR IGNORE INTO {table} SELECT * FROM part.{table}"
                    )
            self._database.execute("DETACH part")

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        where: TracebackType | None,
    ) -> None:
        self._open.close()

    def key(self, run: Run, scene: Scene) -> Key:
        """What a run is found by: its scene, parameters and seed, and how it is measured."""
        parameters = canonical_text(run.parameters)
        parts = [toml_of(scene), parameters, run.seed, self._measure, self._version]
        digest = hashlib.sha256(json.dumps(parts).encode()).hexdigest()
        return Key(digest, parameters, run.seed)

    def find(self, key: Key) -> Measured | None:
        """What a run has measured, if it is finished."""
        row = self._row("SELECT names, arrays FROM runs WHERE key = ?", key)
        return None if row is None else _unpack(*row)

    def is_of_other_code(self, key: Key) -> bool:
        """Whether a finished run was measured before the code of ``measure`` was changed."""
        row = self._row("SELECT fingerprint FROM codes WHERE key = ?", key)
        now = self._fingerprint
        return row is not None and now is not None and tells_of_change(row[0], now)

    def _row(self, question: str, key: Key) -> tuple[Any, ...] | None:
        """The first answer among the files."""
        answers = (it.execute(question, (key.digest,)).fetchone() for it in self._databases)
        return next((row for row in answers if row is not None), None)

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


@contextlib.contextmanager
def _opened(path: Path, mode: Literal["rwc", "ro"] = "rwc") -> Iterator[sqlite3.Connection]:
    """A store, which is made if it is not there and may be written."""
    with contextlib.ExitStack() as stack:
        with _naming(path):
            address = f"{path.absolute().as_uri()}?mode={mode}"
            database = sqlite3.connect(address, timeout=_PATIENCE, uri=True)
            stack.callback(database.close)
            _prepare(database, path, mode)
        yield database


@contextlib.contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Names the file in errors of SQLite."""
    try:
        yield
    except sqlite3.Error as error:
        raise CaromError(f"store: {path}: {error}", "store") from error


def _prepare(database: sqlite3.Connection, path: Path, mode: Literal["rwc", "ro"]) -> None:
    """Checks that a file is a store; makes one of a file that is empty."""
    [application] = database.execute("PRAGMA application_id").fetchone()
    [number] = database.execute("PRAGMA user_version").fetchone()
    tables = {name for [name] in database.execute("SELECT name FROM sqlite_master")}
    if tables and (application, number) != (_APPLICATION, _FORMAT):
        told = f"format {number}" if application == _APPLICATION else "another application"
        raise CaromError(f"store: {path}: is a file of {told}", "store")
    if not tables:
        with database:
            database.execute(_TABLE)
            database.execute(f"PRAGMA application_id = {_APPLICATION}")
            database.execute(f"PRAGMA user_version = {_FORMAT}")
    if "codes" not in tables:
        with database:
            # It belongs to the connection where the file must not be written.
            database.execute(_CODE_TABLE.format(kind="TEMP" if mode == "ro" else ""))


def _files_of_parts(path: Path) -> list[Path]:
    """The files of parts beside a store, in order of their names."""
    name = re.compile(re.escape(path.name) + r"\.\d+-of-\d+")
    return sorted(it for it in path.absolute().parent.iterdir() if name.fullmatch(it.name))


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
