"""Sweeps: all runs of the plan, each once, whatever is performed where and killed when."""

import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sweeps import GRID, cloud, falling, place, rebound

import carom
from carom._sweep import plan
from carom._sweep.cluster import Pace

pytest.importorskip("distributed")
xarray = pytest.importorskip("xarray")
pandas = pytest.importorskip("pandas")

from distributed import Client, LocalCluster  # noqa: E402


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    """Two workers, which may be killed: they are replaced."""
    with LocalCluster(2, 1, dashboard_address=":0") as cluster, Client(cluster) as client:
        cluster.adapt(minimum=2, maximum=2)
        yield client


FILE = """
name = "dropped"
[parameters]
height = 1.0
[[forces]]
gravity = { acceleration = [0, -9.81, 0] }
[[spheres]]
position = [0, "=height + 0.5", 0]
radius = 0.5
[[colliders]]
shape = "half-space"
"""


def test_parameters_of_a_scene_file_are_swept_by_their_names(tmp_path: Path) -> None:
    file = tmp_path / "dropped.toml"
    file.write_text(FILE, encoding="utf-8")
    grid: dict[str, Any] = {"height": [1.0, 4.0], "spheres.0.restitution": [0.5, 1.0]}
    runs = carom.sweep(str(file), grid, measure=rebound, client="serial")
    # e times the speed of the fall.
    expected = [e * (2 * 9.81 * height) ** 0.5 for height in (1.0, 4.0) for e in (0.5, 1.0)]
    assert runs.to_pandas()["speed"].tolist() == pytest.approx(expected, rel=1e-12)
    with pytest.raises(carom.SceneError, match="heigth"):
        carom.sweep(str(file), {"heigth": [1.0]}, measure=rebound, client="serial")


# The table


def test_the_table_is_in_the_order_of_the_grid() -> None:
    runs = carom.sweep(falling, GRID, measure=rebound, client="serial")
    assert len(runs) == 9
    assert [dict(it) for it in runs.parameters[:4]] == [
        {"height": 0.5, "e": 0.0},
        {"height": 0.5, "e": 0.5},
        {"height": 0.5, "e": 1.0},
        {"height": 1.0, "e": 0.0},
    ]
    data = runs.to_xarray()
    assert dict(data.sizes) == {"height": 3, "e": 3, "end_0": 3}
    assert data.bounces.dims == ("height", "e")
    assert data.bounces.dtype == np.int64
    for height in GRID["height"]:
        for e in GRID["e"]:
            # The floor's restitution is 1, and restitutions multiply.
            expected = e * np.sqrt(2 * 9.81 * height)
            assert float(data.speed.sel(height=height, e=e)) == pytest.approx(expected, rel=1e-9)
    table = runs.to_pandas()
    assert list(table.columns) == ["height", "e", "bounces", "speed", "end"]
    assert table.speed.tolist() == data.speed.values.ravel().tolist()
    assert table.end[4].tolist() == data.end.sel(height=1.0, e=0.5).values.tolist()


def test_every_place_of_work_gives_the_same_table(client: Client, tmp_path: Path) -> None:
    def table(**where: Any) -> Any:
        return carom.sweep(falling, GRID, measure=rebound, repeats=None, **where).to_xarray()

    serial = table(client="serial")
    xarray.testing.assert_identical(table(client=client), serial)
    with LocalCluster(1, 1, processes=False, dashboard_address=":0") as one, Client(one) as alone:
        xarray.testing.assert_identical(table(client=alone), serial)
    store = tmp_path / "runs.sqlite"
    for _ in range(2):
        xarray.testing.assert_identical(table(client="serial", store=store), serial)


def test_samples_are_rows_of_a_table() -> None:
    rows = [{"height": 1.0, "e": 0.25}, {"height": 3.0, "e": 0.75}]
    by_rows = carom.sweep(falling, samples=rows, measure=rebound, client="serial").to_xarray()
    by_table = carom.sweep(
        falling, samples=pandas.DataFrame(rows), measure=rebound, client="serial"
    ).to_xarray()
    assert by_rows.speed.dims == ("sample",)
    assert by_rows.height.values.tolist() == [1.0, 3.0]
    xarray.testing.assert_identical(by_rows, by_table)


def test_paths_of_scenes_and_vectors_are_parameters() -> None:
    pulls = [(0, -1.0, 0), (0, -4.0, 0)]
    runs = carom.sweep(
        falling(),
        {"forces.0.gravity.acceleration": pulls, "spheres.0.restitution": [1.0]},
        measure=rebound,
        client="serial",
    )
    speeds = [float(it["speed"]) for it in runs.results if it is not None]
    # The first does not arrive within a second.
    assert speeds == [0.0, pytest.approx(np.sqrt(8.0))]
    data = runs.to_xarray()
    assert data["forces.0.gravity.acceleration"].values.tolist() == pulls
    assert runs.to_pandas()["forces.0.gravity.acceleration"].tolist() == [list(it) for it in pulls]


def test_parameters_go_to_what_takes_them() -> None:
    def heights(world: carom.World, height: float, seconds: float) -> float:
        world.run(seconds)
        return float(world.positions[0, 1]) / height

    runs = carom.sweep(
        falling,
        {"height": [1.0, 2.0], "seconds": [0.1], "simulation.frame_time": [0.1]},
        measure=heights,
        client="serial",
    )
    fallen = 0.5 * 9.81 * 0.1**2
    expected = [pytest.approx((1.5 - fallen) / 1.0), pytest.approx((2.5 - fallen) / 2.0)]
    assert [float(it["value"]) for it in runs.results if it is not None] == expected


def test_registered_scenes_run_on_workers(client: Client, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(carom._scene.library, "_registered", {})

    @carom.scene("drop")
    def drop(height: float = 1.0) -> carom.Scene:
        return falling(height)

    runs = carom.sweep("Drop", {"height": [1.0, 2.0]}, measure=rebound, client=client)
    assert not runs.errors
    assert runs.scene(1) == falling(2.0)


# Seeds


def test_repeats_have_seeds_of_their_own() -> None:
    runs = carom.sweep(cloud, {"count": [3, 4]}, measure=place, repeats=50, client="serial")
    assert len({*runs.seeds}) == 100
    assert all(seed is not None and 0 <= seed < 2**32 for seed in runs.seeds)
    data = runs.to_xarray()
    assert data.value.dims == ("count", "repeat")
    assert data.seed.values.ravel().tolist() == runs.seeds
    assert len({*data.value.values.ravel().tolist()}) == 100
    again = runs.scene(57)
    assert again.generators[0].seed == runs.seeds[57]  # type: ignore[union-attr]
    assert place(again.world()) == float(data.value[1, 7])


def test_seeds_stay_when_a_sweep_grows_or_is_told_in_another_order() -> None:
    def seeds(grid: dict[str, Any], repeats: int, seed: int = 5) -> dict[tuple[Any, ...], Any]:
        of = plan.make_plan(grid, None, repeats, seed)
        return {(*sorted(run.parameters.items()), run.row % repeats): run.seed for run in of}

    small = seeds({"a": [1, 2], "b": [0.5]}, 3)
    large = seeds({"b": [0.25, 0.5], "a": np.array([0.0, 1.0, 2.0])}, 4)
    assert small == {run: large[run] for run in small}
    assert not {*small.values()} & {*seeds({"a": [1, 2], "b": [0.5]}, 3, seed=6).values()}


def test_functions_take_seeds_by_name() -> None:
    def scene(seed: int) -> carom.Scene:
        return falling(height=1.0 + seed)

    def measure(world: carom.World, *, seed: int) -> float:
        return float(world.positions[0, 1]) - seed

    runs = carom.sweep(scene, measure=measure, repeats=3, client="serial")
    assert [float(it["value"]) for it in runs.results if it is not None] == [1.5, 1.5, 1.5]


def test_several_random_fillings_get_several_seeds() -> None:
    ball = carom.Sphere(radius=0.2)
    here = carom.RandomFill(5, (0, 0, 0), (9, 9, 9), 1, ball)
    there = carom.RandomFill(5, (-9, -9, -9), (0, 0, 0), 1, ball)
    scene = carom.Scene(name="two", generators=[here, there])
    runs = carom.sweep(scene, measure=place, repeats=2, client="serial")
    first, second = runs.scene(1).generators
    assert first.seed == runs.seeds[1]  # type: ignore[union-attr]
    assert second.seed == (runs.seeds[1] + 1) % 2**32  # type: ignore[union-attr, operator]


# Failures


def fails_at_two(world: carom.World, a: int) -> int:
    if a == 2:
        raise ZeroDivisionError("a is two")
    return a


@pytest.mark.parametrize("where", ["serial", "cluster"])
def test_a_run_that_raises_does_not_stop_the_others(where: str, client: Client) -> None:
    here: Any = client if where == "cluster" else "serial"
    with pytest.warns(RuntimeWarning, match=r"1 of 4 runs failed .* run 1 \(a = 2\): Zero"):
        runs = carom.sweep("simtest1", {"a": [1, 2, 3, 4]}, measure=fails_at_two, client=here)
    [failure] = runs.errors
    assert (failure.run, failure.parameters) == (1, {"a": 2})
    assert failure.error == "ZeroDivisionError: a is two"
    assert "fails_at_two" in failure.traceback
    assert runs.results[1] is None
    np.testing.assert_array_equal(runs.to_xarray().value, [1, np.nan, 3, 4])
    with pytest.raises(carom.RunError, match=r"a = 2.*a is two"):
        carom.sweep("simtest1", {"a": [1, 2]}, measure=fails_at_two, client=here, on_error="raise")


def test_failed_runs_are_tried_again(tmp_path: Path) -> None:
    store, flag = tmp_path / "runs.sqlite", tmp_path / "works"

    def measure(world: carom.World, a: int) -> int:
        if a == 2 and not flag.exists():
            raise OSError("not yet")
        return a

    arguments: dict[str, Any] = {"measure": measure, "client": "serial", "store": store}
    with pytest.warns(RuntimeWarning, match="not yet"):
        carom.sweep("simtest1", {"a": [1, 2]}, **arguments)
    flag.touch()
    runs = carom.sweep("simtest1", {"a": [1, 2]}, **arguments)
    assert not runs.errors
    assert runs.to_xarray().value.values.tolist() == [1, 2]


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("text", "'value' must be numbers, not a str"),
        ({"a": 1.0}, "'a' is the name of a parameter"),
        ([[1], [1, 2]], "'value' has rows of different lengths"),
        (None, "'value' must be numbers, not a NoneType"),
    ],
)
def test_what_is_no_measurement_is_a_failure(value: Any, message: str) -> None:
    with pytest.warns(RuntimeWarning, match=message):
        carom.sweep("simtest1", {"a": [1]}, measure=lambda world, a: value, client="serial")


def test_arrays_of_different_shapes_make_no_table() -> None:
    runs = carom.sweep(
        "simtest1", {"a": [1, 2]}, measure=lambda world, a: np.zeros(a), client="serial"
    )
    with pytest.raises(carom.CaromError, match=r"'value' has shape \(2,\) in run 1, and \(1,\)"):
        runs.to_xarray()
    assert [it["value"].shape for it in runs.results if it is not None] == [(1,), (2,)]


# Killed


def is_alive(process: int) -> bool:
    """Whether it runs; a dead process that only waits for its parent does not."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")")[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


def workers(log: Path) -> set[int]:
    """The processes that performed runs."""
    return {int(line.split()[1]) for line in log.read_text().splitlines()}


def test_killed_workers_lose_nothing_and_repeat_nothing(client: Client, tmp_path: Path) -> None:
    log, store = tmp_path / "log", tmp_path / "runs.sqlite"
    count = 200

    def measure(world: carom.World, a: int) -> int:
        first = tmp_path / f"first{a}"
        if a in (60, 120) and not first.exists():
            first.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.005)
        with log.open("a") as lines:
            lines.write(f"{a}\n")
        return 3 * a

    runs = carom.sweep("simtest1", {"a": range(count)}, measure=measure, client=client, store=store)
    assert (tmp_path / "first60").exists()
    assert (tmp_path / "first120").exists()
    assert not runs.errors
    assert runs.to_xarray().value.values.tolist() == [3 * a for a in range(count)]
    [kept] = sqlite3.connect(store).execute("SELECT count(*) FROM runs").fetchone()
    assert kept == count
    performed = [int(line) for line in log.read_text().split()]
    assert {*performed} == {*range(count)}
    # What a worker is at, and has not yet reported, dies with it: at most two batches, each time.
    assert len(performed) - count < 2 * 2 * 50


def test_a_run_that_kills_every_worker_is_blamed_alone(
    client: Client, monkeypatch: pytest.MonkeyPatch
) -> None:
    def measure(world: carom.World, a: int) -> int:
        if a == 20:
            # Not while it starts: that takes longer to be noticed.
            time.sleep(0.3)
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.01)
        return a

    monkeypatch.setattr(client.cluster.scheduler, "allowed_failures", 1)
    with pytest.warns(RuntimeWarning, match=r"1 of 100 runs failed .*\(a = 20\): KilledWorker"):
        runs = carom.sweep("simtest1", {"a": range(100)}, measure=measure, client=client)
    expected = [float(a) for a in range(100)]
    expected[20] = np.nan
    np.testing.assert_array_equal(runs.to_xarray().value, expected)


@pytest.mark.parametrize("where", ["None", "'serial'"])
def test_a_killed_sweep_goes_on_where_it_was(where: str, tmp_path: Path) -> None:
    store, log, script = tmp_path / "runs.sqlite", tmp_path / "log", tmp_path / "script.py"
    again = tmp_path / "again"
    script.write_text(
        "import carom, os, time\n"
        "def slow(world, a):\n"
        "    time.sleep(0.02)\n"
        # The first time none gets further: it is killed meanwhile.
        f"    while a >= 60 and not os.path.exists({str(again)!r}):\n"
        "        time.sleep(0.02)\n"
        f"    with open({str(log)!r}, 'a') as lines:\n"
        "        lines.write(f'{a} {os.getpid()}\\n')\n"
        "    return a * a\n"
        "if __name__ == '__main__':\n"
        f"    runs = carom.sweep('simtest1', {{'a': range(100)}}, measure=slow, client={where},\n"
        f"                       store={str(store)!r})\n"
        "    print(int(runs.to_xarray().value.sum()), os.getpid())\n"
    )
    command = [sys.executable, str(script)]
    killed = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)

    def kept() -> int:
        try:
            with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as database:
                return int(database.execute("SELECT count(*) FROM runs").fetchone()[0])
        except sqlite3.OperationalError:
            # Not made yet.
            return 0

    deadline = time.monotonic() + 300
    while kept() < 15 and time.monotonic() < deadline:
        time.sleep(0.01)
    killed.kill()
    killed.communicate()
    while any(map(is_alive, workers(log))) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(map(is_alive, workers(log)))

    finished = kept()
    assert 15 <= finished < 100
    log.unlink()
    again.touch()
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    total, process = (int(word) for word in done.stdout.split())
    assert total == sum(a * a for a in range(100))
    performed = [int(line.split()[0]) for line in log.read_text().splitlines()]
    assert len(performed) == len({*performed}) == 100 - finished
    assert (process in workers(log)) == (where == "'serial'")
    assert not any(map(is_alive, workers(log)))


# Arguments


@pytest.mark.parametrize(
    ("arguments", "kind", "message"),
    [
        ({"measure": 3}, TypeError, "measure: must be a function"),
        ({"grid": [1]}, TypeError, "grid: must be a mapping"),
        ({"grid": {"a": 1}}, TypeError, "grid: a: must be a sequence"),
        ({"grid": {"a": "text"}}, TypeError, "grid: a: must be a sequence"),
        ({"grid": {"a": []}}, ValueError, "grid: a: has no values"),
        ({"grid": {"a": [1, 2, 1.0]}}, ValueError, "grid: a = 1 is there twice"),
        ({"grid": {"repeat": [1]}}, ValueError, "grid: .*'repeat'"),
        ({"grid": {3: [1]}}, TypeError, "grid: names must be text"),
        ({"grid": {"a": [object()]}}, TypeError, "a: a scene can hold no object"),
        ({"grid": {"a": [1]}, "samples": [{"a": 1}]}, TypeError, "grid and samples"),
        ({"samples": {"a": [1]}}, TypeError, "samples: must be a table"),
        ({"samples": []}, ValueError, "samples: there are none"),
        ({"samples": [{"a": 1}, {"b": 1}]}, ValueError, "samples: 1 has other names"),
        ({"samples": [{"a": 1}, {"a": 1}]}, ValueError, "samples: a = 1 is there twice"),
        ({"samples": [3]}, TypeError, "samples: must be mappings"),
        ({"repeats": 0}, ValueError, "repeats: must be at least 1"),
        ({"repeats": 2.5}, TypeError, "repeats: must be a whole number"),
        ({"repeats": 2, "seed": -1}, ValueError, "seed: must be at least 0"),
        ({"repeats": 2}, ValueError, "repeats: nothing is random"),
        ({"on_error": "ignore"}, ValueError, "on_error: must be"),
        ({"version": 2}, TypeError, "version: must be text"),
        ({"client": "cluster"}, TypeError, "client: must be a distributed.Client"),
        ({"scene": 3}, TypeError, "scene: must be a carom.Scene"),
        ({"scene": "simtst1"}, carom.UnknownError, "did you mean"),
        ({"scene": lambda: 3}, TypeError, "scene: the function returned a int"),
        ({"scene": falling, "grid": {"b": [1]}}, TypeError, "b: neither the function"),
        ({"grid": {"simulation.rules": ["exact"]}}, carom.SceneError, "rules"),
        ({"store": "x", "measure": lambda world: 1}, ValueError, "measure: needs a name"),
    ],
)
def test_arguments_that_make_no_sense_are_named(
    arguments: dict[str, Any], kind: type[Exception], message: str
) -> None:
    def measure(world: carom.World, a: float = 0) -> float:
        return a

    given: dict[str, Any] = {"scene": "simtest1", "measure": measure, "client": "serial"}
    with pytest.raises(kind, match=message):
        carom.sweep(**{**given, **arguments})


def test_without_dask_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'carom\[sweep\]'"):
        carom.sweep("simtest1", measure=place)
    assert len(carom.sweep(cloud, measure=place, client="serial")) == 1


def test_progress_is_shown_where_it_is_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("tqdm")
    for progress, expected in ((True, "3/3"), (False, ""), (None, "")):
        carom.sweep(
            falling, {"e": [0, 0.5, 1]}, measure=rebound, client="serial", progress=progress
        )
        shown = capsys.readouterr().err
        assert expected in shown
        assert bool(shown) == bool(expected)


# Batches


def test_tiny_runs_go_in_batches_and_long_ones_alone() -> None:
    def sizes(seconds: float) -> list[int]:
        runs = iter(plan.make_plan({"a": range(10_000)}, None, None, 0))
        pace, found = Pace(10_000), []
        while batch := pace.take(runs, 4):
            found.append(len(batch))
            pace.learn(len(batch), seconds * len(batch))
        assert sum(found) == 10_000
        return found

    tiny = sizes(1e-4)
    assert (tiny[0], tiny[-1]) == (1, 1)
    assert max(tiny) > 1000
    assert len(tiny) < 100
    assert {*sizes(0.5)} == {1}
