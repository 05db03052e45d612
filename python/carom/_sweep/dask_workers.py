"""Workers of a Dask cluster."""

from __future__ import annotations

import contextlib
import itertools
import uuid
from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING, Any

from carom._sweep.experiment import Experiment, Outcome, Run, perform
from carom._sweep.guard import telling_of_missing_guards
from carom._sweep.workers import Task, WorkerDiedError
from carom.errors import RunError

if TYPE_CHECKING:
    from distributed import Client

_ANY_PORT = ":0"
"""Where the dashboard of a cluster on this machine is: several may be at work."""


class DaskWorkers:
    """The workers of a client."""

    def __init__(self, client: Client, experiment: Experiment) -> None:
        """Sends the experiment.

        Raises:
            Exception: What workers cannot import, or the like.
        """
        from distributed import as_completed, wait

        self._client = client
        # Sent once; as a task, it is made again where a worker takes it with it.
        self._experiment = client.submit(_itself, experiment, pure=False)
        wait(self._experiment)
        if self._experiment.status != "finished":
            self._experiment.result()
        self._name, self._numbers = f"carom-sweep-{uuid.uuid4().hex}", itertools.count()
        self._completed = as_completed(loop=client.loop)

    def threads(self) -> int:
        """The threads of all workers."""
        return sum(self._client.nthreads().values())

    def submit(self, batch: list[Run]) -> Task:
        """Sends a batch."""
        key = f"{self._name}-{next(self._numbers)}"
        task = self._client.submit(perform, self._experiment, batch, key=key, pure=False)
        self._completed.add(task)
        return task

    def wait(self, tasks: Collection[Task]) -> Task:
        """Waits for any task that was sent."""
        return next(self._completed)

    def result(self, task: Task) -> tuple[list[Outcome], float]:
        """Fetches outcomes; Dask performs again what was lost on its way here."""
        from distributed import CancelledError, KilledWorker

        try:
            done: tuple[list[Outcome], float] = task.result()
        except CancelledError as error:
            raise RunError("client: the cluster is gone") from error
        except KilledWorker as error:
            raise WorkerDiedError(error) from error
        return done

    def cancel(self, tasks: Collection[Task]) -> None:
        """Cancels tasks and drops the experiment."""
        self._client.cancel([*tasks, self._experiment])


def _itself(experiment: Experiment) -> Experiment:
    return experiment


def check_client(client: object) -> None:
    """Checks that a client is one of Dask, unless there is none, and that Dask is installed.

    Raises:
        TypeError: If it is something else.
        ModuleNotFoundError: Where Dask is not installed.
    """
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
        raise TypeError(f'client: must be a distributed.Client, "ray" or "serial", not a {kind}')
    if client.asynchronous:
        raise TypeError("client: must not be asynchronous")


@contextlib.contextmanager
def local_client() -> Iterator[Any]:
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
