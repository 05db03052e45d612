"""How a scene is stepped.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Literal, TypeAlias

from carom._scene.parts.choices import CombineRule, ImpactLaw, Integrator, Rule
from carom._scene.parts.kinds import Count, Finite, LargeNumber, NonNegative, Period, Positive
from carom._scene.parts.part import Part


@dataclass(frozen=True, kw_only=True)
class Exact(Part):
    """Parameters of the rule ``exact``.

    Attributes:
        impact_law: Law for several impacts at one instant.
        contact_duration: Shortest duration of a contact [s], > 0. Bodies that would meet again
            sooner stay in contact.
        max_impacts: Most impacts and other work of a sphere in a frame, >= 1. More makes a stepped
            zone; without zones the step is refused.
        zones: Whether spheres in contact that take too much work are stepped as by the rule
            ``contact``, until they have come apart.
        zone_budget: Most work of a group of spheres in a tick, in contacts times iterations, >= 1.
            More makes a stepped zone. By default 300,000.
        zone_tick: Time between two ticks, at which zones are stepped [s], > 0. Small spheres
            shorten it, and so do short frames; long frames lengthen it. By default 1/480.
        force_tick: Time between two force ticks [s], > 0. Forces on spheres in persistent contact
            that are not linear, and mutual gravity of more than 32 spheres, are constant from one
            to the next. Stiff springs shorten it. By default 1/240.
    """

    impact_law: ImpactLaw = "reflection"
    contact_duration: Positive | None = None
    max_impacts: Count | None = None
    zones: Literal["automatic", "never"] = "automatic"
    zone_budget: Count | None = None
    zone_tick: Positive | None = None
    force_tick: Positive | None = None


@dataclass(frozen=True, kw_only=True)
class Bisect(Part):
    """Parameters of the rule ``bisect``.

    Attributes:
        integrator: Scheme that moves spheres under forces.
        tolerance: Distance of surfaces that counts as touching [m], >= 0.
        max_halvings: Halvings of a search for a contact, >= 1.
        max_impacts: Most impacts of two bodies in a frame, >= 1. After them the rest of the frame
            is one piece.
        wind_back: Which spheres a contact winds back.
    """

    integrator: Integrator = "semi-implicit-euler"
    tolerance: NonNegative | None = None
    max_halvings: Count | None = None
    max_impacts: Count | None = None
    wind_back: Literal["touched", "all"] = "touched"


@dataclass(frozen=True, kw_only=True)
class Discrete(Part):
    """Parameters of the rule ``discrete``.

    Attributes:
        integrator: Scheme that moves spheres under forces.
    """

    integrator: Integrator = "semi-implicit-euler"


@dataclass(frozen=True, kw_only=True)
class Contact(Part):
    """Parameters of the rule ``contact``.

    Attributes:
        sub_steps: Sub-steps of a frame, >= 1. Overlaps fall with the square of their length.
        sweeps: Sweeps over all contacts in a sub-step, >= 1.
        converged: Whether sweeps go on until the solution converges. Slow; for comparison.
        sleep_speed: Speed below which a supported ball may fall asleep, as a part of ``sqrt(a r)``,
            >= 0. With 0 none sleeps. By default 0.02.
    """

    sub_steps: Count = 8
    sweeps: Count = 2
    converged: bool = False
    sleep_speed: NonNegative = 0.02


@dataclass(frozen=True)
class Periodic(Part):
    """A periodic box about the origin; only under the rules ``exact`` and ``contact``.

    Attributes:
        size: Edges [m], each > 0; infinite along an axis that is open.
        shear_rate: Shear rate, in 1/s: what is above, along y, moves along x with this times the
            distance. By default 0. Only under the rules ``exact`` and ``contact``.
        relative_velocities: Whether the velocities of spheres at the start are relative to the mean
            flow of the shear, which adds its own.
    """

    tag: ClassVar[str] = "periodic"
    size: Period = (math.inf, math.inf, math.inf)
    shear_rate: Finite = 0.0
    relative_velocities: bool = False


@dataclass(frozen=True)
class Andersen(Part):
    """Each ball gets a velocity of Maxwell's distribution at random times (Andersen).

    Attributes:
        frequency: Mean number of these times in a second, in Hz, > 0.
        temperature: Temperature k T [J], > 0.
        seed: Seed of the times and velocities. By default 0.
    """

    tag: ClassVar[str] = "andersen"
    frequency: Positive
    temperature: Positive
    seed: LargeNumber = 0


@dataclass(frozen=True)
class Rescale(Part):
    """All velocities are scaled so that two thirds of the mean kinetic energy is the temperature.

    Attributes:
        interval: Time from one change to the next [s], > 0.
        temperature: Temperature k T [J], > 0.
    """

    tag: ClassVar[str] = "rescale"
    interval: Positive
    temperature: Positive


@dataclass(frozen=True)
class WhiteNoise(Part):
    """Random changes of all velocities that keep the momentum: a driven granular gas.

    Attributes:
        interval: Time from one change to the next [s], > 0.
        strength: Variance that each component of a velocity gains in a second, in m2/s3, > 0.
        seed: Seed of the changes. By default 0.
    """

    tag: ClassVar[str] = "white-noise"
    interval: Positive
    strength: Positive
    seed: LargeNumber = 0


Thermostat: TypeAlias = Andersen | Rescale | WhiteNoise
"""What changes the velocities of all spheres, at times that do not depend on frames."""


@dataclass(frozen=True)
class SquareWell(Part):
    """A well around each ball; a short one makes sticky balls.

    Attributes:
        depth: Depth of the well [J]; below 0 a shoulder, which repels.
        range_ratio: Range of the well, between centres, as a multiple of the sum of the radii, from
            1.000001 to 100.
    """

    tag: ClassVar[str] = "square-well"
    depth: Finite
    range_ratio: Positive


PairPotential: TypeAlias = SquareWell
"""Potential energy of two spheres besides their hard cores."""


@dataclass(frozen=True, kw_only=True)
class Simulation(Part):
    """Rule, frame and other settings of the simulation.

    Attributes:
        rule: The rule.
        dimensions: Number of dimensions, 2 or 3. With 2 balls are discs in the plane z = 0. By
            default 3.
        frame_time: Length of a frame [s], > 0.
        duration: Time worth watching [s], > 0: what a run takes by default.
        spheres_collide: Whether spheres collide with each other. They always collide with
            colliders.
        combine_rule: How the restitution of a contact follows from those of its bodies.
        friction_combine_rule: How the friction of a contact follows from those of its bodies. By
            default ``geometric-mean``.
        allow_overlap: Whether spheres may overlap each other or colliders at the start.
        boundary: Open space or a periodic box.
        thermostat: Thermostat, if there is one; only under the rule ``exact``.
        pair_potential: Potential energy of two balls by their distance, if there is some; only
            under the rule ``exact``.
        exact: Parameters of the rule ``exact``.
        bisect: Parameters of the rule ``bisect``.
        discrete: Parameters of the rule ``discrete``.
        contact: Parameters of the rule ``contact``.
    """

    rule: Rule = "exact"
    dimensions: Count = 3
    frame_time: Positive = 1.0 / 60.0
    duration: Positive = 10.0
    spheres_collide: bool = True
    combine_rule: CombineRule = "product"
    friction_combine_rule: CombineRule = "geometric-mean"
    allow_overlap: bool = False
    boundary: Literal["open"] | Periodic = "open"
    thermostat: Thermostat | None = None
    pair_potential: PairPotential | None = None
    exact: Exact = field(default_factory=Exact)
    bisect: Bisect = field(default_factory=Bisect)
    discrete: Discrete = field(default_factory=Discrete)
    contact: Contact = field(default_factory=Contact)
