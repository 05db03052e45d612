"""The work of a frame, counted by stage."""

from __future__ import annotations

from typing import NamedTuple


class StageCounts(NamedTuple):
    """The work of a frame by stage: counts that depend on the world alone, not on the machine."""

    predictions: int
    """How often the next events of a sphere were predicted, under the rule ``exact``."""
    pair_tests: int
    """Pairs of spheres that were tested for a meeting; under other rules, for a contact."""
    events: int
    """Events taken from the queue, void ones among them, under the rule ``exact``."""
    cell_crossings: int
    """How many of these events were cell crossings."""
    groups: int
    """Groups of touching bodies that were answered as a whole, under the rule ``exact``."""
    solver_iterations: int
    """Iterations of the solvers of these groups, each counted once for every contact."""
    searches: int
    """How often neighbours were found anew, under the rule ``contact``."""
    sweeps: int
    """How often all contacts were gone through, under the rule ``contact``."""
    contacts: int
    """Contacts that a sweep goes through at the end of the frame, under the rule ``contact``."""
