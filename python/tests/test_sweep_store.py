"""A store of a sweep gives back what was measured, and that alone."""

import os
import sqlite3
import subprocess
import sys
from functools import partial, wraps
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sweeps import cloud, place

import carom
from carom._sweep.fingerprint import fingerprint_of

pytest.importorskip("distributed")
xarray = pytest.importorskip("xarray")
pandas = pytest.importorskip("pandas")


def test_a_store_is_asked_for_the_same_measurement_of_the_same_scene(tmp_path: Path) -> None:
    calls: list[int] = []

    def measure(world: carom.World) -> float:
        calls.append(len(world))
        return place(world)

    def performed(scene: Any, **arguments: Any) -> int:
        calls.clear()
        carom.sweep(
            scene, measure=measure, client="serial", store=tmp_path / "runs.sqlite", **arguments
        )
        return len(calls)

    assert performed(cloud, grid={"count": [2, 3]}, repeats=2) == 4
    assert performed(cloud, grid={"count": [2, 3]}, repeats=2) == 0
    assert performed(cloud, grid={"count": [3, 4, 2]}, repeats=3) == 2 + 3
    assert performed(cloud, grid={"count": [2, 3]}, repeats=2, seed=1) == 4
    assert performed(cloud, grid={"count": [2, 3]}) == 2
    assert performed(cloud, grid={"count": [2, 3]}, repeats=2, version="2") == 4
    assert performed(lambda count: cloud(count + 1), grid={"count": [2, 3]}, repeats=2) == 4
    assert performed(cloud, grid={"count": [2, 3]}, repeats=2) == 0


def test_a_store_knows_what_partial_functions_are_given(tmp_path: Path) -> None:
    def values(b: float) -> list[float]:
        measure = partial(sum_of, b=b)
        store = tmp_path / "runs.sqlite"
        runs = carom.sweep("simtest1", {"a": [1]}, measure=measure, client="serial", store=store)
        return runs.to_xarray().value.values.tolist()  # type: ignore[no-any-return]

    assert [values(2.0), values(3.0), values(2.0)] == [[3.0], [4.0], [3.0]]


def sum_of(world: carom.World, a: float, b: float) -> float:
    return a + b


def of_source(source: str) -> Any:
    """A function `measure`, as an edited script has it."""
    names: dict[str, Any] = {"__name__": "script"}
    exec(source, names)
    return names["measure"]


MEASURE = "def measure(world, a=1):\n    return a + 1\n"


def swept(measure: Any, store: Path, **more: Any) -> list[float]:
    arguments: dict[str, Any] = {"grid": {"a": [1, 2]}, "client": "serial", **more}
    runs = carom.sweep("simtest1", measure=measure, store=store, **arguments)
    return [float(it["value"]) for it in runs.results if it is not None]


@pytest.mark.parametrize(
    "edited",
    [
        MEASURE.replace("a + 1", "a + 2"),
        MEASURE.replace("a + 1", "a - 1"),
        MEASURE.replace("a + 1", "(lambda: a + 3)()"),
        MEASURE.replace("a + 1", "a + len(world)"),
        MEASURE.replace("a=1", "a=2"),
    ],
)
def test_a_store_warns_of_a_measurement_whose_code_was_edited(edited: str, tmp_path: Path) -> None:
    store = tmp_path / "runs.sqlite"
    assert swept(of_source(MEASURE), store) == [2, 3]
    for _ in range(2):
        with pytest.warns(RuntimeWarning, match="store: the code of measure has changed") as told:
            assert swept(of_source(edited), store) == [2, 3]
        assert [Path(it.filename).name for it in told] == [Path(__file__).name]


@pytest.mark.filterwarnings("error")
def test_a_store_warns_of_nothing_but_other_code_of_stored_runs(tmp_path: Path) -> None:
    store = tmp_path / "runs.sqlite"
    assert swept(of_source(MEASURE), store) == [2, 3]
    documented = MEASURE.replace("\n", '\n    """Adds."""\n    # One.\n', 1)
    other = of_source(MEASURE.replace("a + 1", "a + 2"))
    for same in [MEASURE, "\n\n" + MEASURE]:
        assert swept(of_source(same), store) == [2, 3]
    assert swept(of_source(documented), tmp_path / "other") == [2, 3]
    documented = documented.replace("Adds", "Adds one").replace("# One", "# Two")
    assert swept(of_source(documented), tmp_path / "other") == [2, 3]
    # Other runs, and another version.
    assert swept(other, store, grid={"a": [3]}) == [5]
    assert swept(other, store, version="2") == [3, 4]


@pytest.mark.filterwarnings("error")
def test_a_store_of_before_fingerprints_is_taken_without_a_warning(tmp_path: Path) -> None:
    store = tmp_path / "runs.sqlite"
    assert swept(of_source(MEASURE), store) == [2, 3]
    with sqlite3.connect(store) as database:
        database.execute("DROP TABLE codes")
    edited = of_source(MEASURE.replace("a + 1", "a + 2"))
    assert swept(edited, store, grid={"a": [1, 2, 3]}) == [2, 3, 5]
    with sqlite3.connect(store) as database:
        # As by another version of Python.
        database.execute("UPDATE codes SET fingerprint = '00:1'")
    assert swept(edited, store, grid={"a": [1, 2, 3]}) == [2, 3, 5]


def doubled(function: Any) -> Any:
    @wraps(function)
    def call(*given: Any, **named: Any) -> Any:
        return 2 * function(*given, **named)

    return call


def test_a_fingerprint_is_the_same_in_every_process_and_sees_through_wrappers() -> None:
    source = "def measure(world, a=1, *, b=object):\n    return a in {'x', 'y', 'z', 1.5}\n"
    program = (
        "from carom._sweep.fingerprint import fingerprint_of\n"
        f"names = {{}}\nexec({source!r}, names)\nprint(fingerprint_of(names['measure']))"
    )
    found = {
        subprocess.run(
            [sys.executable, "-c", program],
            capture_output=True,
            text=True,
            check=True,
            env={**os.environ, "PYTHONHASHSEED": seed},
        ).stdout.strip()
        for seed in "123"
    }
    assert found == {fingerprint_of(of_source(source))}
    one, other = of_source(MEASURE), of_source(MEASURE.replace("+", "-"))
    assert fingerprint_of(partial(one, a=2)) == fingerprint_of(one) != fingerprint_of(other)
    assert fingerprint_of(doubled(one)) not in (fingerprint_of(one), fingerprint_of(doubled(other)))
    assert fingerprint_of(len) is None


def test_a_store_keeps_every_bit(tmp_path: Path) -> None:
    values = {
        "nan": np.nan,
        "infinite": -np.inf,
        "tiny": 5e-324,
        "third": 1 / 3,
        "file": np.arange(6, dtype=np.int8).reshape(2, 3),
        "none": np.empty((0, 3)),
        "flag": True,
        "phase": 1 + 2j,
    }

    def measure(world: carom.World) -> dict[str, Any]:
        return values

    for _ in range(2):
        runs = carom.sweep(
            "simtest1", measure=measure, client="serial", store=tmp_path / "runs.sqlite"
        )
        [result] = runs.results
        assert result is not None
        for name, value in values.items():
            expected = np.array(value)
            assert result[name].dtype == expected.dtype
            np.testing.assert_array_equal(result[name], expected)


def test_what_is_no_store_is_refused_and_left_alone(tmp_path: Path) -> None:
    text, other = tmp_path / "text", tmp_path / "other.sqlite"
    text.write_text("not a database, but long enough to be read as one" * 100)
    with sqlite3.connect(other) as database:
        database.execute("CREATE TABLE runs (mine INTEGER)")
    for file, message in [
        (text, "file is not a database"),
        (other, "is a file of another application"),
        (tmp_path / "nowhere" / "runs", "unable to open"),
    ]:
        before = file.read_bytes() if file.exists() else None
        with pytest.raises(carom.CaromError, match=f"store: .*{message}"):
            carom.sweep("simtest1", measure=place, client="serial", store=file)
        assert before == (file.read_bytes() if file.exists() else None)
