"""What a sweep asks of the workers of a cluster."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any, Protocol, TypeAlias

from carom._sweep.experiment import Outcome, Run

Task: TypeAlias = Any
"""A batch in work: a future of Dask, a reference of Ray. Hashable."""


class WorkerDiedError(Exception):
    """Workers died at every attempt to perform a batch.

    Attributes:
        reason: The error of the cluster.
    """

    def __init__(self, reason: Exception) -> None:
        super().__init__(str(reason))
        self.reason = reason


class Workers(Protocol):
    """Processes that perform batches of runs, and perform a batch again if one of them dies."""

    def threads(self) -> int:
        """Returns how many batches are performed at a time; it may change."""

    def submit(self, batch: list[Run]) -> Task:
        """Sends a batch."""

    def wait(self, tasks: Collection[Task]) -> Task:
        """Waits until one of the tasks is done, and returns it."""

    def result(self, task: Task) -> tuple[list[Outcome], float]:
        """Returns the outcomes of a task that is done, and how long it took [s].

        Raises:
            WorkerDiedError: If too many workers died of it.
            RunError: If the cluster is lost.
            Exception: If it failed as a whole.
        """

    def cancel(self, tasks: Collection[Task]) -> None:
        """Cancels tasks, and drops what all of them share."""
