"""How a scene is stepped.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import ClassVar, Literal

from carom._scene.parts.choices import CombineRule, ImpactLaw, Integrator, Rule
from carom._scene.parts.kinds import Count, NonNegative, Period, Positive
from carom._scene.parts.part import Part


@dataclass(frozen=True, kw_only=True)
class Exact(Part):
    """Parameters of the rule ``exact``.

    Attributes:
        impact_law: How impacts at one instant among spheres that touch are answered.
        contact_duration: How long a contact lasts at least [s], > 0: bodies that would meet again
            sooner stay together.
        max_impacts: Impacts and other work per sphere in a frame, >= 1; more makes a stepped zone,
            or without zones is refused.
        zones: Whether spheres in contact that take too much work are stepped as by the rule
            ``contact``, until they have come apart.
        zone_budget: Work of a group of spheres in a tick, in contacts times iterations, >= 1; more
            makes a stepped zone.
        zone_tick: Time between two ticks, at which zones are stepped [s], > 0.
        force_tick: Time between two force ticks [s], > 0: springs, forces between spheres and
            others that are not linear are held constant from one to the next. It is halved where
            springs need it.
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
        integrator: How spheres move under forces.
        tolerance: Distance of surfaces that counts as touching [m], >= 0.
        max_halvings: Halvings in search of a contact, >= 1.
        max_impacts: How often two bodies may meet in a frame, >= 1; then the rest of it is taken in
            one piece.
        wind_back: Which spheres go through the pieces into which a contact cuts the frame.
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
        integrator: How spheres move under forces.
    """

    integrator: Integrator = "semi-implicit-euler"


@dataclass(frozen=True, kw_only=True)
class Contact(Part):
    """Parameters of the rule ``contact``.

    Attributes:
        sub_steps: Sub-steps of a frame, >= 1: overlaps fall with the square of their length.
        sweeps: Sweeps over all contacts in a sub-step, >= 1.
        converged: Whether sweeps go on until the solution has converged: slow, to compare with.
        sleep_speed: Speed below which a ball that bears or is borne may fall asleep, as a part of
            ``sqrt(a r)``, the speed after falling through half its radius, >= 0; with 0 none
            sleeps.
    """

    sub_steps: Count = 8
    sweeps: Count = 2
    converged: bool = False
    sleep_speed: NonNegative = 0.02


@dataclass(frozen=True)
class Periodic(Part):
    """A box about the origin that repeats itself without end; only with the rule ``exact``.

    Attributes:
        size: Edges [m], each > 0; infinite along an axis that is open.
    """

    tag: ClassVar[str] = "periodic"
    size: Period = (math.inf, math.inf, math.inf)


@dataclass(frozen=True, kw_only=True)
class Simulation(Part):
    """How a scene is stepped.

    Attributes:
        rule: The step rule.
        frame_time: Length of a frame [s], > 0.
        duration: Time worth watching [s], > 0: what a run takes by default.
        spheres_collide: Whether spheres collide with one another; with colliders they always do.
        combine_rule: Restitution of a contact from that of its two bodies.
        friction_combine_rule: Friction of a contact from that of its two bodies.
        allow_overlap: Whether spheres may overlap each other or colliders at the start.
        boundary: What is around the spheres, besides colliders.
        exact: Parameters of the rule ``exact``.
        bisect: Parameters of the rule ``bisect``.
        discrete: Parameters of the rule ``discrete``.
        contact: Parameters of the rule ``contact``.
    """

    rule: Rule = "exact"
    frame_time: Positive = 1.0 / 60.0
    duration: Positive = 10.0
    spheres_collide: bool = True
    combine_rule: CombineRule = "product"
    friction_combine_rule: CombineRule = "geometric-mean"
    allow_overlap: bool = False
    boundary: Literal["open"] | Periodic = "open"
    exact: Exact = field(default_factory=Exact)
    bisect: Bisect = field(default_factory=Bisect)
    discrete: Discrete = field(default_factory=Discrete)
    contact: Contact = field(default_factory=Contact)
