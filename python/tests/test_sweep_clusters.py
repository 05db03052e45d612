"""A sweep on a cluster has the bits of one in this process, analysis included.

Those of Ray run where it is installed. Its start takes long on a busy machine, and fails after
30 s; with ``RAY_ADDRESS`` a cluster that is there is taken.
"""

import os
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Literal

import numpy as np
import pytest

import carom
from carom import analysis
from carom._sweep.ray_workers import ray_session

pytest.importorskip("distributed")

from distributed import Client, LocalCluster

SIDE = 4.0


@pytest.fixture(scope="module")
def dask() -> Iterator[Client]:
    """Two workers of Dask, which are replaced when they die."""
    with LocalCluster(2, 1, dashboard_address=":0") as cluster, Client(cluster) as client:
        cluster.adapt(minimum=2, maximum=2)
        yield client


@pytest.fixture(scope="module")
def ray() -> Iterator[Literal["ray"]]:
    """A connection to Ray for all tests."""
    pytest.importorskip("ray")
    with ray_session():
        yield "ray"


@pytest.fixture(params=["dask", "ray"])
def cluster(request: pytest.FixtureRequest) -> Any:
    """What `carom.sweep` takes as its client."""
    return request.getfixturevalue(request.param)


def bits(runs: carom.Runs) -> list[dict[str, bytes]]:
    """What each run measured, to the bit."""
    assert not runs.errors
    return [
        {name: values.tobytes() for name, values in result.items()}
        for result in runs.results
        if result is not None
    ]


def test_runs_on_a_cluster_have_the_bits_of_serial_ones_though_a_worker_is_killed(
    cluster: Any, tmp_path: Path
) -> None:
    here, died = os.getpid(), tmp_path / "died"

    # Within the test: workers of Ray cannot import it.
    def gas(count: int, restitution: float) -> carom.Scene:
        ball = carom.Sphere(radius=0.3, restitution=restitution)
        half = SIDE / 2
        fill = carom.RandomFill(count, (-half,) * 3, (half,) * 3, 1, ball, speed=1.0)
        box = carom.Simulation(boundary=carom.Periodic((SIDE,) * 3), frame_time=0.05)
        return carom.Scene(name="gas", generators=[fill], simulation=box)

    def measure(world: carom.World, count: int, restitution: float, seed: int) -> dict[str, Any]:
        if (count, restitution) == (30, 0.9) and os.getpid() != here and not died.exists():
            died.touch()
            os.kill(os.getpid(), signal.SIGKILL)
        run = world.run(frames=40)
        found = analysis.radial_distribution(run, r_max=2.0, bins=20)
        return {
            "impacts": len(run.impacts),
            "g": found.g,
            "displacement": analysis.mean_square_displacement(run, lags=10),
            "pressure": analysis.virial_pressure(run, SIDE**3).pressure,
            "state": np.uint64(int(world.state_hash, 16)),
        }

    grid: dict[str, Any] = {"count": [20, 25, 30, 35], "restitution": [0.8, 0.9, 1.0]}
    arguments: dict[str, Any] = {"grid": grid, "measure": measure, "repeats": 4, "seed": 3}
    serial = carom.sweep(gas, **arguments, client="serial")
    parallel = carom.sweep(gas, **arguments, client=cluster)
    assert died.exists()
    assert len(serial) == len({it["state"] for it in bits(serial)}) == 48
    assert bits(parallel) == bits(serial)
    for result in parallel.results:
        assert result is not None
        assert result["g"].flags.writeable


def test_a_run_that_raises_or_kills_on_ray_is_blamed_alone(ray: Literal["ray"]) -> None:
    def measure(world: carom.World, a: int) -> int:
        if a == 5:
            raise ZeroDivisionError("a is five")
        if a == 3:
            os.kill(os.getpid(), signal.SIGKILL)
        return a

    with pytest.warns(RuntimeWarning, match="2 of 20 runs failed"):
        runs = carom.sweep("simtest1", {"a": range(20)}, measure=measure, client=ray)
    assert [failure.run for failure in runs.errors] == [3, 5]
    assert runs.errors[1].error == "ZeroDivisionError: a is five"
    assert [it and int(it["value"]) for it in runs.results] == [
        None if a in (3, 5) else a for a in range(20)
    ]


def test_what_workers_of_ray_cannot_make_stops_a_sweep(ray: Literal["ray"]) -> None:
    class Unreadable:
        def __reduce__(self) -> Any:
            return (int, ("no number",))

    unreadable = Unreadable()

    def measure(world: carom.World, a: int) -> bool:
        return unreadable is None

    with pytest.raises(Exception, match="no number"):
        carom.sweep("simtest1", {"a": [1, 2]}, measure=measure, client=ray)


def test_without_ray_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install 'carom\[ray\]'"):
        carom.sweep("simtest1", {"a": [1]}, measure=len, client="ray")
