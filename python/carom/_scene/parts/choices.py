"""What is chosen by a name.

Made by `cargo xtask parts` of the schema of scene files, which says what is to be changed.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

Finish: TypeAlias = Literal["matte", "satin", "glossy", "metal", "glass", "wood", "cloth"]
"""How a surface reflects light.

It changes no motion.

- ``"matte"``: As chalk and felt: no highlight.
- ``"satin"``: A soft highlight on spheres, none on surfaces.
- ``"glossy"``: As lacquer: a sharp highlight, and the sky mirrored.
- ``"metal"``: Polished: the sky mirrored in its colour.
- ``"glass"``: Clear, in a tint of its colour.
- ``"wood"``: As wood: grain along the longer side of a face; spheres are satin.
- ``"cloth"``: As felt: no highlight, and a weave on faces.
"""
Side: TypeAlias = Literal["left", "right", "bottom", "top", "back", "front"]
"""A side of a box in its own coordinates.

- ``"left"``: Towards -x.
- ``"right"``: Towards +x.
- ``"bottom"``: Towards -y.
- ``"top"``: Towards +y.
- ``"back"``: Towards -z.
- ``"front"``: Towards +z.
"""
End: TypeAlias = Literal["bottom", "top"]
"""An end of a pipe in its own coordinates.

- ``"bottom"``: Towards -y.
- ``"top"``: Towards +y.
"""
Integrator: TypeAlias = Literal[
    "semi-implicit-euler", "explicit-euler", "velocity-verlet", "runge-kutta-4"
]
"""Scheme that moves spheres under forces.

- ``"semi-implicit-euler"``: Velocity first, then position with the new velocity. First order.
- ``"explicit-euler"``: Position with the old velocity, then velocity. First order.
- ``"velocity-verlet"``: Second order.
- ``"runge-kutta-4"``: Fourth order.
"""
ImpactLaw: TypeAlias = Literal["reflection", "simultaneous", "sequential"]
"""Law for several impacts at one instant.

- ``"reflection"``: Generalized reflection. Keeps symmetries and passes impacts on, as Newton's
  cradle does.
- ``"simultaneous"``: Newton's law at all contacts at once. Does not pass impacts on.
- ``"sequential"``: One pair after the other, as other engines do. Breaks symmetries.
"""
Rule: TypeAlias = Literal["exact", "contact", "bisect", "discrete"]
"""How the world goes through a frame.

- ``"exact"``: Flies in closed form from impact to impact, each at its own time; misses nothing.
- ``"contact"``: Cuts frames into sub-steps and solves all contacts of each together; for heaps and
  friction.
- ``"bisect"``: Winds back what intersects and finds the time of contact by bisection (the
  tutorial's rule).
- ``"discrete"``: Moves every sphere by the frame, then answers overlaps (the course's rule).
"""
CombineRule: TypeAlias = Literal["product", "minimum", "maximum", "average", "geometric-mean"]
"""Coefficient of a contact from those of its two bodies.

- ``"product"``: Their product: with a sphere of 1, the collider's value governs.
- ``"minimum"``: The smaller one.
- ``"maximum"``: The larger one.
- ``"average"``: Their mean.
- ``"geometric-mean"``: The root of their product.
"""
