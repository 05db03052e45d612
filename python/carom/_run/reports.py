"""What a world reports of its last frame: work, energy, contacts, zones."""

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
    """How often neighbours were searched for, under the rule ``contact``."""
    sweeps: int
    """How often all contacts were gone through, under the rule ``contact``."""
    contacts: int
    """Contacts that a sweep goes through at the end of the frame, under the rule ``contact``."""


class EnergyAccount(NamedTuple):
    """Changes of the energy of a world in a frame, by cause, under any rule.

    The total energy after the frame is that before it, the sum of these, and the error of the
    integration, which is what is left.
    """

    contacts: float
    """Work of contacts [J]: what restitution and friction took, <= 0 but for errors."""
    colliders: float
    """Work of moving colliders [J]."""
    kicks: float
    """Work of the kicks of colliders [J]."""
    growth: float
    """Work of spheres that grow [J]."""
    shear: float
    """Work of the steady shear of a periodic box [J]."""
    thermostat: float
    """Energy that a thermostat added [J]; < 0 where it took some."""
    forces: float
    """Work of forces without a potential [J]: drag, wind, vortices, dampers of springs."""
    applied: float
    """Work of the forces applied to single spheres [J]."""
    correction: float
    """Work of moving spheres out of what they overlap [J]."""
    emission: float
    """Energy of emitted spheres, less that of those taken out [J]."""
    integration: float
    """Energy that held forces add under ``exact``, in zones and some persistent contacts [J]."""


class ContactAccount(NamedTuple):
    """How good the solution of a frame is.

    Under the rule ``contact``, and in the stepped zones of ``exact``; else 0.
    """

    limited_sub_steps: int
    """Sub-steps in which impulses were scaled down for them not to add energy."""
    residual: float
    """Largest change of a normal impulse in the last sweep, as a part of the largest impulse."""
    largest_overlap: float
    """Largest overlap before it was corrected, as a part of the sum of radii."""
    asleep: int
    """Spheres that sleep at the end of the frame, until something comes near or changes."""
    squeezed: int
    """How often a sphere was pressed into a surface by half its radius, in each sub-step."""


class ZoneAccount(NamedTuple):
    """Spheres that were not moved from impact to impact but stepped; 0 under other rules.

    Their contacts took too much work. How good their motion is, `ContactAccount` tells.
    """

    spheres: int
    """Spheres in a zone at the end of the frame."""
    sphere_seconds: float
    """Time that they spent in it in this frame, of all together [s]."""
    ticks: int
    """Ticks at which a zone was stepped."""
    joined: int
    """Spheres that came into a zone."""
    left: int
    """Spheres that left one."""
