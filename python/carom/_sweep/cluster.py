"""Where runs are performed: in this process, or by the workers of a cluster."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING, Any, Literal

from carom._sweep.dask_workers import DaskWorkers, check_client, local_client
from carom._sweep.experiment import Experiment, Outcome, Run, fault, perform
from carom._sweep.ray_workers import RayWorkers, check_ray, ray_session
from carom._sweep.workers import Task, WorkerDiedError, Workers
from carom.errors import RunError

if TYPE_CHECKING:
    from distributed import Client

_BATCH_SECONDS = 0.25
"""Work in a batch: a task costs Dask about 1 ms, and what is in a batch can get lost together."""
_BATCHES_WAITING = 2
"""Batches for each thread, so that none waits for this process; the cluster gets no more."""
_FEWEST_BATCHES = 16
"""A cluster that grows by demand, and has no worker yet, must see some."""


class Pace:
    """How many runs make a batch, from how long they have taken."""

    def __init__(self, total: int) -> None:
        self.left = total
        self._runs, self._seconds = 0, 0.0

    def learn(self, runs: int, seconds: float) -> None:
        """Takes note of a batch."""
        self._runs += runs
        self._seconds += seconds

    def take(self, runs: Iterator[Run], threads: int) -> list[Run]:
        """The next batch; small at first, and at the end, so that all threads end together."""
        if not self._runs:
            count = 1
        else:
            mean = max(self._seconds / self._runs, 1e-9)
            count = int(min(_BATCH_SECONDS / mean, self.left / (_BATCHES_WAITING * threads)))
        batch = list(itertools.islice(runs, max(count, 1)))
        self.left -= len(batch)
        return batch


def serially(experiment: Experiment, runs: Iterator[Run], total: int) -> Iterator[list[Outcome]]:
    """Performs the runs in this process."""
    pace = Pace(total)
    while batch := pace.take(runs, 1):
        outcomes, seconds = perform(experiment, batch)
        pace.learn(len(batch), seconds)
        yield outcomes


def by_workers(workers: Workers, runs: Iterator[Run], total: int) -> Generator[list[Outcome]]:
    """Performs the runs on the workers of a cluster, and gives outcomes as they come.

    A batch whose worker dies is performed again by another one. If that happens too often, its
    runs are performed at the end, each alone, to find the one to blame.

    Raises:
        RunError: If the cluster is lost.
    """
    pending: dict[Task, list[Run]] = {}
    suspects: list[Run] = []
    pace = Pace(total)
    try:
        while True:
            threads = max(workers.threads(), 1)
            while len(pending) < max(_BATCHES_WAITING * threads, _FEWEST_BATCHES):
                batch = pace.take(runs, threads)
                if not batch:
                    break
                pending[workers.submit(batch)] = batch
            is_alone = not pending
            if is_alone:
                if not suspects:
                    return
                batch = [suspects.pop()]
                pending[workers.submit(batch)] = batch
            task = workers.wait(pending)
            batch = pending.pop(task)
            try:
                outcomes, seconds = workers.result(task)
            except WorkerDiedError as error:
                if is_alone:
                    yield _failed(batch, error.reason)
                else:
                    suspects += batch
            except RunError:
                raise
            except Exception as error:
                yield _failed(batch, error)
            else:
                pace.learn(len(batch), seconds)
                yield outcomes
    finally:
        with contextlib.suppress(Exception):
            workers.cancel(pending)


@contextlib.contextmanager
def performing(
    client: Client | Literal["ray", "serial"] | None,
    experiment: Experiment,
    runs: Iterator[Run],
    total: int,
) -> Iterator[Iterator[list[Outcome]]]:
    """Performs the runs where ``client`` says; on a cluster of this machine if it is ``None``."""
    if client == "serial":
        yield serially(experiment, runs, total)
        return
    with contextlib.ExitStack() as stack:
        workers = stack.enter_context(_workers(client, experiment))
        yield stack.enter_context(contextlib.closing(by_workers(workers, runs, total)))


@contextlib.contextmanager
def _workers(client: Any, experiment: Experiment) -> Iterator[Workers]:
    with contextlib.ExitStack() as stack:
        if client == "ray":
            stack.enter_context(ray_session())
            yield RayWorkers(experiment)
            return
        client = stack.enter_context(local_client()) if client is None else client
        yield DaskWorkers(client, experiment)


def check_place(client: object) -> None:
    """Checks that there is what performs the runs.

    Raises:
        TypeError: If ``client`` is none.
        ModuleNotFoundError: Where a package is not installed.
    """
    if client == "ray":
        check_ray()
    elif client != "serial":
        check_client(client)


def _failed(batch: list[Run], error: Exception) -> list[Outcome]:
    """The outcomes of a batch that failed as a whole; no traceback of this process says why."""
    why = fault(error.with_traceback(None))
    return [Outcome(run.row, why) for run in batch]
