"""Materials, pairs of them, and laws of restitution.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeAlias

from carom._scene.parts.choices import Finish
from carom._scene.parts.kinds import (
    Color,
    NonAdditivity,
    NonNegative,
    Positive,
    Restitution,
    TwoNames,
)
from carom._scene.parts.part import Part


@dataclass(frozen=True)
class PowerLaw(Part):
    """Plastic impacts: ``restitution (v/speed)^-exponent`` above ``speed``, ``restitution`` below.

    Attributes:
        speed: In m/s, > 0.
        restitution: Coefficient at low speeds, in [0, 1]; by default 1, with which nothing comes to
            rest.
        exponent: In [0, 1]; by default 1/4, that of spheres that yield.
    """

    tag: ClassVar[str] = "power-law"
    speed: Positive
    restitution: Restitution = 1.0
    exponent: Restitution = 0.25


@dataclass(frozen=True)
class Viscoelastic(Part):
    """Viscoelastic spheres: 1 - 1.153 (v/speed)^(1/5) at low speeds.

    Attributes:
        speed: Speed at which the coefficient is 0.3987 [m/s], > 0.
    """

    tag: ClassVar[str] = "viscoelastic"
    speed: Positive


@dataclass(frozen=True)
class Cutoff(Part):
    """``restitution`` from ``speed`` on, and 1 below it.

    Attributes:
        speed: In m/s, > 0.
        restitution: Coefficient at high speeds, in [0, 1].
    """

    tag: ClassVar[str] = "cutoff"
    speed: Positive
    restitution: Restitution


RestitutionLaw: TypeAlias = PowerLaw | Viscoelastic | Cutoff
"""Restitution that depends on the speed of approach along the normal."""


@dataclass(frozen=True, kw_only=True)
class Material(Part):
    """Fields that spheres and colliders of a material share; a body's own fields win.

    Attributes:
        restitution: Coefficient of restitution in [0, 1].
        restitution_law: Restitution by the speed of approach; beside it ``restitution`` does not
            count.
        friction: Coulomb's coefficient of friction, >= 0.
        rolling_friction: Coefficient of rolling friction, >= 0.
        spinning_friction: Coefficient of spinning friction, >= 0.
        tangential_restitution: Coefficient of tangential restitution in [0, 1].
        density: Density of spheres without ``mass`` [kg/m³], > 0.
        color: Colour.
        finish: How surfaces reflect light.
    """

    restitution: Restitution | None = None
    restitution_law: RestitutionLaw | None = None
    friction: NonNegative | None = None
    rolling_friction: NonNegative | None = None
    spinning_friction: NonNegative | None = None
    tangential_restitution: Restitution | None = None
    density: Positive | None = None
    color: Color | None = None
    finish: Finish | None = None


@dataclass(frozen=True)
class MaterialPair(Part):
    """Coefficients of the contacts of two materials, instead of those that combine rules give.

    Attributes:
        materials: Names of the two materials, which may be the same.
        restitution: Coefficient of restitution in [0, 1]. If missing, the combine rule gives it.
        restitution_law: Restitution by the speed of approach; beside it ``restitution`` does not
            count.
        friction: Coulomb's coefficient of friction, >= 0. If missing, the combine rule gives it.
        rolling_friction: Coefficient of rolling friction, >= 0. If missing, the combine rule gives
            it.
        spinning_friction: Coefficient of spinning friction, >= 0. If missing, the combine rule
            gives it.
        tangential_restitution: Coefficient of tangential restitution in [0, 1]. If missing, the
            combine rule gives it.
        non_additivity: Non-additivity parameter D from -0.9 to 9: spheres touch where their centres
            are (1 + D) times the sum of their radii apart.
    """

    materials: TwoNames
    restitution: Restitution | None = None
    restitution_law: RestitutionLaw | None = None
    friction: NonNegative | None = None
    rolling_friction: NonNegative | None = None
    spinning_friction: NonNegative | None = None
    tangential_restitution: Restitution | None = None
    non_additivity: NonAdditivity = 0.0
