"""What happened, as records of NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

IMPACT = np.dtype(
    [
        ("time", "f8"),
        ("collider", "i8"),
        ("sphere_1", "i8"),
        ("sphere_2", "i8"),
        ("point", "f8", (3,)),
        ("normal", "f8", (3,)),
        ("approach_speed", "f8"),
        ("separation_speed", "f8"),
        ("impulse", "f8"),
        ("tangential_impulse", "f8", (3,)),
    ]
)
"""An impact, in the order of time.

============================ ===============================================================
``time``                     when, on the world's clock [s]
``collider``                 id of body 1 if it is a collider, else -1
``sphere_1``                 id of body 1 if it is a sphere, else -1
``sphere_2``                 id of body 2
``point``                    where on the surface of body 1 [m]
``normal``                   unit normal from body 1 to body 2
``approach_speed``           along the normal before the impact [m/s], > 0
``separation_speed``         along the normal after it and all others at the same instant [m/s]
``impulse``                  on body 2 along the normal, and against it on body 1 [N s]
``tangential_impulse``       of friction on body 2, and against it on body 1 [N s]
============================ ===============================================================
"""

LEDGER = np.dtype(
    [
        *IMPACT.descr,
        ("group", "i8"),
        ("group_size", "i8"),
        ("momentum_before", "f8", (3,)),
        ("momentum_after", "f8", (3,)),
        ("energy_before", "f8"),
        ("energy_after", "f8"),
        ("energy_demanded", "f8"),
    ]
)
"""An impact with the account of its group: the impacts at one instant among bodies that touch.

============================ ===============================================================
``group``                    number of the group in the frame
``group_size``               how many impacts it has
``momentum_before``          of its spheres [kg m/s]
``momentum_after``           momentum afterwards, less what colliders gave
``energy_before``            kinetic energy of its spheres [J]
``energy_after``             kinetic energy afterwards, less the work of moving colliders
``energy_demanded``          change of kinetic energy that restitution demands [J], <= 0
============================ ===============================================================
"""

TRIGGER = np.dtype(
    [("collider", "i8"), ("sphere", "i8"), ("point", "f8", (3,)), ("normal", "f8", (3,))]
)
"""A sphere inside a trigger at the end of a frame: both ids, the nearest point of its surface [m],
and the unit normal there."""

SENSOR_EVENT = np.dtype(
    [
        ("time", "f8"),
        ("collider", "i8"),
        ("sphere", "i8"),
        ("enters", "i8"),
        ("point", "f8", (3,)),
        ("normal", "f8", (3,)),
        ("speed", "f8"),
    ]
)
"""A sphere that enters a trigger or leaves it, in the order of time.

A sphere is in a trigger while their surfaces touch or overlap. Under the rule ``exact`` the time is
that of the flight, however small the trigger and however fast the sphere; under the other rules the
way of a sphere is straight within a frame.

============================ ===============================================================
``time``                     when, on the world's clock [s]
``collider``                 id of the trigger
``sphere``                   id of the sphere
``enters``                   1 where the sphere enters, 0 where it leaves
``point``                    where on the surface of the trigger [m]
``normal``                   unit normal from that surface to the sphere
``speed``                    of the sphere relative to the trigger [m/s]
============================ ===============================================================
"""

WELL_EVENT = np.dtype(
    [
        ("time", "f8"),
        ("sphere_1", "i8"),
        ("sphere_2", "i8"),
        ("kind", "i8"),
        ("normal", "f8", (3,)),
        ("distance", "f8"),
        ("impulse", "f8"),
    ]
)
"""Two spheres at the edge of their square well, in the order of time.

============================ ===============================================================
``time``                     when, on the world's clock [s]
``sphere_1``, ``sphere_2``   ids of the spheres
``kind``                     0 where they enter the well (capture), 1 where they leave it
                             (dissociation), 2 where they turn back at its edge (bounce)
``normal``                   unit vector from the first centre to the second
``distance``                 of the centres [m]
``impulse``                  that drives them apart [N s], negative where it draws them together
============================ ===============================================================
"""

HIT = np.dtype(
    [
        ("collider", "i8"),
        ("sphere", "i8"),
        ("point", "f8", (3,)),
        ("normal", "f8", (3,)),
        ("fraction", "f8"),
    ]
)
"""What a ray or a sphere on its way meets first.

============================ ===============================================================
``collider``                 id of the body if it is a collider, else -1
``sphere``                   id of the body if it is a sphere, else -1
``point``                    where on its surface [m]; nan where nothing is met
``normal``                   unit normal of the body there, out of it; nan where nothing is met
``fraction``                 part of the way before, 0 to 1; inf where nothing is met
============================ ===============================================================
"""

NEAR = np.dtype(
    [
        ("collider", "i8"),
        ("sphere", "i8"),
        ("point", "f8", (3,)),
        ("normal", "f8", (3,)),
        ("distance", "f8"),
    ]
)
"""A body near a place.

============================ ===============================================================
``collider``                 id of the body if it is a collider, else -1
``sphere``                   id of the body if it is a sphere, else -1
``point``                    the nearest point of its surface [m]; nan where no body is near
``normal``                   unit normal of the body there, out of it; nan where no body is near
``distance``                 of the surfaces [m], negative where they overlap; inf where no body
                             is near
============================ ===============================================================
"""

OVERLAPPING = np.dtype([("query", "i8"), *NEAR.descr])
"""A body that touches or overlaps a sphere that was asked about.

``query`` is the number of that sphere; the other fields are those of `carom.NEAR`, with distances
of 0 or less.
"""

LEG = np.dtype(
    [
        ("start", "f8"),
        ("end", "f8"),
        ("flight_start", "f8"),
        ("position", "f8", (3,)),
        ("velocity", "f8", (3,)),
        ("acceleration", "f8", (3,)),
        ("drag_rate", "f8"),
    ]
)
"""A piece of a predicted path: a flight from an event to the next.

============================ ===============================================================
``start``, ``end``           when it begins and ends, on the world's clock [s]
``flight_start``             when the flight's own time is 0, on the world's clock [s]; it may
                             be before ``start``
``position``                 centre then [m]
``velocity``                 velocity then [m/s]
``acceleration``             by everything but drag [m/s²]; along a round surface that of its
                             beginning
``drag_rate``                drag coefficient over mass [1/s], >= 0
============================ ===============================================================
"""

CONTACT = np.dtype(
    [
        ("collider", "i8"),
        ("sphere_1", "i8"),
        ("sphere_2", "i8"),
        ("point", "f8", (3,)),
        ("normal", "f8", (3,)),
        ("gap", "f8"),
        ("normal_force", "f8"),
        ("tangential_force", "f8", (3,)),
        ("is_sliding", "i8"),
    ]
)
"""A contact that persists, in the order of ids, pairs of spheres first.

============================ ===============================================================
``collider``                 id of body 1 if it is a collider, else -1
``sphere_1``                 id of body 1 if it is a sphere, else -1
``sphere_2``                 id of body 2
``point``                    where on the surface of body 1 [m]
``normal``                   unit normal from body 1 to body 2
``gap``                      distance of the two surfaces [m], negative where they overlap
``normal_force``             on body 2 along the normal, and against it on body 1 [N], >= 0
``tangential_force``         of friction on body 2, and against it on body 1 [N]
``is_sliding``               1 where friction is as large as it can be, else 0
============================ ===============================================================
"""


OVERLAP = np.dtype([("collider", "i8"), ("sphere_1", "i8"), ("sphere_2", "i8"), ("depth", "f8")])
"""Two bodies that overlap.

============================ ===============================================================
``collider``                 id of body 1 if it is a collider, else -1
``sphere_1``                 id of body 1 if it is a sphere, else -1
``sphere_2``                 id of body 2
``depth``                    how far their surfaces overlap [m], > 0
============================ ===============================================================
"""


def records(words: NDArray[np.uint64], kind: np.dtype[np.void]) -> NDArray[np.void]:
    """The words that the engine wrote as records; nothing is copied."""
    return words.view(kind)


def flat_columns(table: NDArray[np.void]) -> dict[str, NDArray[Any]]:
    """The columns of a table, vectors as three columns ``name_x``, ``name_y``, ``name_z``."""
    columns: dict[str, NDArray[Any]] = {}
    for name in table.dtype.names or ():
        column = table[name]
        if column.ndim == 1:
            columns[name] = column
        else:
            columns.update({f"{name}_{axis}": column[:, i] for i, axis in enumerate("xyz")})
    return columns
