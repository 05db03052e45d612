"""Workers of a Ray cluster."""

from __future__ import annotations

import contextlib
import logging
import os
from collections.abc import Collection, Iterable, Iterator

from carom._sweep import experiment as of
from carom._sweep.experiment import Experiment, Fault, Outcome, Run
from carom._sweep.workers import Task, WorkerDiedError
from carom.errors import RunError

_ATTEMPTS = 4
"""Workers that may die of a batch: as many as Dask allows by default."""
_STATISTICS = "RAY_USAGE_STATS_ENABLED"


class RayWorkers:
    """The workers of the cluster to which this process is connected."""

    def __init__(self, experiment: Experiment) -> None:
        """Sends the experiment.

        Raises:
            Exception: What workers cannot import, or the like.
        """
        import ray

        self._ray = ray
        self._perform = ray.remote(num_cpus=1, max_retries=_ATTEMPTS - 1)(of.perform)
        # Sent once: this process has a copy, so that none is lost with a worker.
        self._experiment = ray.put(experiment)
        ray.get(self._perform.remote(self._experiment, []))

    def threads(self) -> int:
        """The cores of the cluster."""
        return int(self._ray.cluster_resources().get("CPU", 0))

    def submit(self, batch: list[Run]) -> Task:
        """Sends a batch."""
        return self._perform.remote(self._experiment, batch)

    def wait(self, tasks: Collection[Task]) -> Task:
        """Waits for any of the tasks."""
        [done], _ = self._ray.wait(list(tasks), num_returns=1)
        return done

    def result(self, task: Task) -> tuple[list[Outcome], float]:
        """Fetches outcomes; Ray performs again what was lost on its way here."""
        errors = self._ray.exceptions
        try:
            outcomes, seconds = self._ray.get(task)
        except (errors.WorkerCrashedError, errors.OutOfMemoryError, errors.NodeDiedError) as error:
            raise WorkerDiedError(error) from error
        except errors.RayTaskError:
            # It may be a system error, too: one of the worker.
            raise
        except errors.RaySystemError as error:
            raise RunError("client: the cluster is gone") from error
        return list(_copies(outcomes)), seconds

    def cancel(self, tasks: Collection[Task]) -> None:
        """Cancels tasks."""
        for task in tasks:
            self._ray.cancel(task)


def _copies(outcomes: Iterable[Outcome]) -> Iterator[Outcome]:
    """Copies arrays, which lie in the memory of the cluster and cannot be written there."""
    for row, result in outcomes:
        if not isinstance(result, Fault):
            result = {name: array.copy() for name, array in result.items()}
        yield Outcome(row, result)


def check_ray() -> None:
    """Checks that Ray is installed.

    Raises:
        ModuleNotFoundError: Where it is not.
    """
    try:
        import ray  # noqa: F401
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError(
            "carom.sweep with client=\"ray\" needs Ray: pip install 'carom[ray]'", name=error.name
        ) from error


@contextlib.contextmanager
def ray_session() -> Iterator[None]:
    """Connects this process to a cluster, unless it is connected already.

    It is the cluster of ``RAY_ADDRESS``, or a new one on this machine, which sends no statistics
    of use to its makers unless the user allows it.
    """
    import ray

    if ray.is_initialized():
        yield
        return
    is_ours = _STATISTICS not in os.environ
    if is_ours:
        os.environ[_STATISTICS] = "0"
    try:
        ray.init(include_dashboard=False, log_to_driver=False, logging_level=logging.WARNING)
        yield
    finally:
        ray.shutdown()
        if is_ours:
            del os.environ[_STATISTICS]
