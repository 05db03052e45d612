"""What is chosen by a name.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

Finish: TypeAlias = Literal["matte", "satin", "glossy", "metal", "glass"]
"""How a surface takes light; it changes no motion.

- ``"matte"``: As chalk and felt: no highlight.
- ``"satin"``: A soft highlight on spheres, none on surfaces.
- ``"glossy"``: As lacquer: a sharp highlight, and the sky mirrored.
- ``"metal"``: Polished: the sky mirrored in its colour.
- ``"glass"``: Clear, in a tint of its colour.
"""
Side: TypeAlias = Literal["left", "right", "bottom", "top", "back", "front"]
"""A side of a box in its own frame.

- ``"left"``: Towards -x.
- ``"right"``: Towards +x.
- ``"bottom"``: Towards -y.
- ``"top"``: Towards +y.
- ``"back"``: Towards -z.
- ``"front"``: Towards +z.
"""
Integrator: TypeAlias = Literal[
    "semi-implicit-euler", "explicit-euler", "velocity-verlet", "runge-kutta-4"
]
"""How spheres move under forces.

- ``"semi-implicit-euler"``: Velocity first, then position with the new velocity. First order.
- ``"explicit-euler"``: Position with the old velocity, then velocity. First order.
- ``"velocity-verlet"``: Second order.
- ``"runge-kutta-4"``: Fourth order.
"""
ImpactLaw: TypeAlias = Literal["reflection", "simultaneous", "sequential"]
"""How impacts at one instant among spheres that touch are answered.

- ``"reflection"``: Generalized reflection: keeps symmetries, and passes impacts on as Newton's
  cradle does.
- ``"simultaneous"``: Newton's law of restitution at all contacts at once; it does not pass impacts
  on.
- ``"sequential"``: Pair after pair, as other engines do; it breaks symmetries.
"""
Rule: TypeAlias = Literal["exact", "contact", "bisect", "discrete"]
"""A step rule.

- ``"exact"``: Fly in closed form from impact to impact, each at its own time: nothing is missed.
- ``"contact"``: Cut frames into sub-steps and solve all contacts of each together: for heaps and
  friction.
- ``"bisect"``: Wind back what intersects and find the time of contact by bisection (the tutorial's
  rule).
- ``"discrete"``: Move every sphere by the frame, then answer what overlaps (the course's rule).
"""
CombineRule: TypeAlias = Literal["product", "minimum", "maximum", "average", "geometric-mean"]
"""Coefficient of a contact from those of its two bodies.

- ``"product"``: Their product: with a sphere of 1, the collider's value governs.
- ``"minimum"``: The smaller one.
- ``"maximum"``: The larger one.
- ``"average"``: Their mean.
- ``"geometric-mean"``: The root of their product.
"""
