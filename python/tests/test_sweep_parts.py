"""Parts of a sweep in processes of their own, as the jobs of an array, make the whole."""

import os
import signal
import sqlite3
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import carom

PARTS = 3

SCRIPT = """
import contextlib, os, signal, sys
import carom
from carom import analysis

def gas(count, restitution):
    ball = carom.Sphere(radius=0.3, restitution=restitution)
    fill = carom.RandomFill(count, (-2, -2, -2), (2, 2, 2), 1, ball, speed=1.0)
    box = carom.Simulation(boundary=carom.Periodic((4, 4, 4)), frame_time=0.05)
    return carom.Scene(name="gas", generators=[fill], simulation=box)

def measure(world, count, restitution, seed):
    if (count, restitution) == (25, 0.9):
        # Only the first to come here removes it.
        with contextlib.suppress(FileNotFoundError):
            os.remove("kill")
            os.kill(os.getpid(), signal.SIGKILL)
    with open("log", "a") as lines:
        lines.write(f"{seed}\\n")
    run = world.run(frames=10)
    found = analysis.radial_distribution(run, r_max=2.0, bins=20)
    return {"g": found.g, "state": int(world.state_hash, 16) >> 1}

if __name__ == "__main__":
    job = os.environ.get("SLURM_ARRAY_TASK_ID")
    runs = carom.sweep(
        gas, {"count": [20, 25, 30], "restitution": [0.8, 0.9, 1.0, 0.5]}, repeats=4, seed=3,
        measure=measure, client="serial", store=sys.argv[1],
        part=None if job is None else (int(job), 3),
    )
    print([it and [it["g"].tobytes(), it["state"].tobytes()] for it in runs.results])
"""


def started(store: str, folder: Path, job: int | None) -> subprocess.Popen[str]:
    """The script as a job of an array, or alone."""
    environment = {name: value for name, value in os.environ.items() if "SLURM" not in name}
    if job is not None:
        environment["SLURM_ARRAY_TASK_ID"] = str(job)
    command = [sys.executable, str(folder / "script.py"), store]
    return subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, text=True)


def ended(process: subprocess.Popen[str]) -> str:
    """What a job prints, which ends well."""
    output, _ = process.communicate(timeout=300)
    assert process.returncode == 0
    return output


@pytest.mark.skipif(os.name == "nt", reason="no signals")
def test_parts_of_which_one_is_killed_make_the_whole_to_the_bit(tmp_path: Path) -> None:
    (tmp_path / "script.py").write_text(SCRIPT)
    whole = ended(started("whole", tmp_path, None))
    (tmp_path / "log").unlink()
    (tmp_path / "kill").touch()

    jobs = [started("runs", tmp_path, job) for job in range(PARTS)]
    codes = []
    for job in jobs:
        job.communicate(timeout=300)
        codes.append(job.returncode)
    assert sorted(codes) == [-signal.SIGKILL, 0, 0]
    again = codes.index(-signal.SIGKILL)
    performed = (tmp_path / "log").read_text().splitlines()
    assert len({*performed}) < 48
    ended(started("runs", tmp_path, again))
    performed = (tmp_path / "log").read_text().splitlines()
    assert len({*performed}) == 48
    assert not (tmp_path / "runs").exists()

    (tmp_path / "log").write_text("")
    assert ended(started("runs", tmp_path, None)) == whole
    assert (tmp_path / "log").read_text() == ""
    # The files of the parts are no longer needed.
    for number in range(PARTS):
        (tmp_path / f"runs.{number}-of-{PARTS}").unlink()
    assert ended(started("runs", tmp_path, None)) == whole
    assert (tmp_path / "log").read_text() == ""


def value(world: carom.World, a: int) -> int:
    return a


def values(store: Path, grid: range, part: tuple[int, int] | None = None) -> list[int | None]:
    """What each run has measured."""
    runs = carom.sweep(
        "simtest1", {"a": grid}, measure=value, client="serial", store=store, part=part
    )
    assert not runs.errors
    return [None if it is None else int(it["value"]) for it in runs.results]


def stored(file: Path) -> int:
    """How many runs are in a file."""
    database = sqlite3.connect(file)
    [count] = database.execute("SELECT count(*) FROM runs").fetchone()
    database.close()
    return int(count)


def test_a_part_performs_only_its_own_runs_that_the_store_has_not(tmp_path: Path) -> None:
    store = tmp_path / "runs of ?#%.sqlite"
    assert values(store, range(4), (1, 3)) == [None, 1, None, None]
    assert not store.exists()
    # What no part has performed, the whole does.
    assert values(store, range(4)) == [0, 1, 2, 3]
    assert stored(store) == 4
    assert values(store, range(8), (0, 2)) == [0, None, 2, None, 4, None, 6, None]
    assert stored(tmp_path / f"{store.name}.0-of-2") == 2
    # More parts than runs.
    assert values(store, range(2), (5, 9)) == [None, None]
    assert values(store, range(8)) == [*range(8)]
    assert stored(store) == 8


def test_a_store_of_before_fingerprints_is_read_by_parts(tmp_path: Path) -> None:
    store = tmp_path / "runs"
    values(store, range(4))
    with sqlite3.connect(store) as database:
        database.execute("DROP TABLE codes")
    before = store.read_bytes()
    assert values(store, range(5), (0, 2)) == [0, None, 2, None, 4]
    assert store.read_bytes() == before
    assert stored(tmp_path / "runs.0-of-2") == 1


def test_a_file_beside_a_store_that_is_no_part_is_refused_and_named(tmp_path: Path) -> None:
    store = tmp_path / "runs"
    values(store, range(2))
    (tmp_path / "runs.0-of-2").write_text("no database, but long enough to be read as one" * 100)
    with pytest.raises(carom.CaromError, match=r"store: .*runs\.0-of-2: file is not a database"):
        values(store, range(2))


@pytest.mark.parametrize(
    ("part", "kind", "message"),
    [
        (3, TypeError, "part: must be a tuple of two whole numbers, not 3"),
        ((0.5, 2), TypeError, "part: must be a tuple"),
        ((0, 1, 2), TypeError, "part: must be a tuple"),
        ((2, 2), ValueError, r"part: must be \(i, n\) with 0 <= i < n, not \(2, 2\)"),
        ((-1, 2), ValueError, "part: must be"),
    ],
)
def test_parts_that_make_no_sense_are_refused(
    part: Any, kind: type[Exception], message: str, tmp_path: Path
) -> None:
    with pytest.raises(kind, match=message):
        values(tmp_path / "runs", range(2), part)
