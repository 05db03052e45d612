"""Where runs are performed: in this process, or by the workers of a Dask cluster."""

from __future__ import annotations

import contextlib
import itertools
import uuid
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING, Any, Literal

from carom._sweep.experiment import Experiment, Fault, Outcome, Run, fault, perform
from carom._sweep.guard import telling_of_missing_guards
from carom.errors import RunError

if TYPE_CHECKING:
    from distributed import Client

_BATCH_SECONDS = 0.25
"""Work in a batch: a task costs Dask about 1 ms, and what is in a batch can get lost together."""
_BATCHES_WAITING = 2
"""Batches for each thread, so that none waits for the client; Dask holds back all but these."""
_FEWEST_BATCHES = 16
"""A cluster that grows by demand, and has no worker yet, must see some."""

_ANY_PORT = ":0"
"""Where the dashboard of a cluster on this machine is: several may be at work."""


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


def on_cluster(
    client: Client, experiment: Experiment, runs: Iterator[Run], total: int
) -> Generator[list[Outcome]]:
    """Performs the runs on the workers of a cluster, and gives outcomes as they come.

    A batch whose worker dies is performed again by another one. If that happens too often, its
    runs are performed at the end, each alone, to find the one to blame.

    Raises:
        RunError: If the cluster is lost.
        Exception: What workers cannot import, or the like.
    """
    from distributed import CancelledError, KilledWorker, as_completed, wait

    # Sent once; as a task, it is made again where a worker takes it with it.
    shared = client.submit(_itself, experiment, pure=False)
    wait(shared)
    if shared.status != "finished":
        shared.result()
    name, numbers = f"carom-sweep-{uuid.uuid4().hex}", itertools.count()
    completed = as_completed(loop=client.loop)
    pending: dict[Any, list[Run]] = {}
    suspects: list[Run] = []
    pace = Pace(total)

    def submit(batch: list[Run]) -> None:
        key = f"{name}-{next(numbers)}"
        future = client.submit(perform, shared, batch, key=key, pure=False)
        pending[future] = batch
        completed.add(future)

    try:
        while True:
            threads = max(sum(client.nthreads().values()), 1)
            while len(pending) < max(_BATCHES_WAITING * threads, _FEWEST_BATCHES):
                batch = pace.take(runs, threads)
                if not batch:
                    break
                submit(batch)
            is_alone = not pending
            if is_alone:
                if not suspects:
                    return
                submit([suspects.pop()])
            future = next(completed)
            batch = pending.pop(future)
            try:
                # What was lost on its way here is performed again.
                outcomes, seconds = future.result()
            except CancelledError as error:
                raise RunError("client: the cluster is gone") from error
            except Exception as error:
                if isinstance(error, KilledWorker) and not is_alone:
                    suspects += batch
                else:
                    yield [Outcome(run.row, _fault_of_task(error)) for run in batch]
            else:
                pace.learn(len(batch), seconds)
                yield outcomes
    finally:
        with contextlib.suppress(Exception):
            client.cancel([*pending, shared])


@contextlib.contextmanager
def performing(
    client: Client | Literal["serial"] | None,
    experiment: Experiment,
    runs: Iterator[Run],
    total: int,
) -> Iterator[Iterator[list[Outcome]]]:
    """Performs the runs by a client; by a cluster on this machine if there is none."""
    if client == "serial":
        yield serially(experiment, runs, total)
        return
    with contextlib.ExitStack() as stack:
        client = stack.enter_context(_local_client()) if client is None else client
        yield stack.enter_context(contextlib.closing(on_cluster(client, experiment, runs, total)))


def check_client(client: object) -> None:
    """Checks that a client is one, and that there is what it takes.

    Raises:
        TypeError: If it is something else.
        ModuleNotFoundError: Where Dask is not installed.
    """
    if client == "serial":
        return
    try:
        from distributed import Client
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "carom.sweep works on a Dask cluster: pip install 'carom[sweep]', "
            'or give client="serial" to work in this process',
            name=error.name,
        ) from error
    if client is None:
        return
    if not isinstance(client, Client):
        kind = type(client).__name__
        raise TypeError(f'client: must be a distributed.Client or "serial", not a {kind}')
    if client.asynchronous:
        raise TypeError("client: must not be asynchronous")


@contextlib.contextmanager
def _local_client() -> Iterator[Any]:
    """A cluster on this machine, with a process of one thread for each core."""
    from distributed import Client, LocalCluster

    with contextlib.ExitStack() as stack:
        with telling_of_missing_guards():
            cluster = LocalCluster(
                processes=True, threads_per_worker=1, dashboard_address=_ANY_PORT
            )
            stack.enter_context(cluster)
            client = stack.enter_context(Client(cluster))
        # A process that dies while it starts is not started again, unless the number is kept up.
        count = len(cluster.workers)
        cluster.adapt(minimum=count, maximum=count)
        yield client


def _itself(experiment: Experiment) -> Experiment:
    return experiment


def _fault_of_task(error: BaseException) -> Fault:
    """Why a whole task failed; no traceback of this process tells that."""
    return fault(error.with_traceback(None))
