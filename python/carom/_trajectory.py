"""What a run leaves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom._tables import flat_columns

if TYPE_CHECKING:
    import pandas
    import xarray

_PARTS = ("x", "y", "z", "w")
"""Of a quaternion; those of a vector are the first three."""
_AXES = _PARTS[:3]


@dataclass(frozen=True, eq=False, repr=False)
class Trajectory:
    """States of all spheres over time, and every impact between them. Arrays are C-ordered.

    Attributes:
        time: When the states were recorded, on the world's clock [s], shape (t,). The first is the
            state at the beginning of the run.
        positions: Centres [m], shape (t, n, 3); NaN where a sphere is not there.
        velocities: Velocities [m/s], shape (t, n, 3); NaN where a sphere is not there.
        ids: Ids of the n spheres that are there at any of these times, ascending, shape (n,).
        radii: Radii [m], shape (n,).
        masses: Masses [kg], shape (n,).
        impacts: Every impact of the run, recorded state or not, records of `carom.IMPACT`.
        orientations: How spheres are turned, quaternions x, y, z, w, shape (t, n, 4); NaN where a
            sphere is not there. None where no sphere turned at the beginning, and no friction
            could make one turn.
        angular_velocities: Angular velocities, along the axes [rad/s], shape (t, n, 3), or None, as
            the orientations.
    """

    time: NDArray[np.float64]
    positions: NDArray[np.float64]
    velocities: NDArray[np.float64]
    ids: NDArray[np.uint64]
    radii: NDArray[np.float64]
    masses: NDArray[np.float64]
    impacts: NDArray[np.void]
    orientations: NDArray[np.float64] | None = None
    angular_velocities: NDArray[np.float64] | None = None

    def __len__(self) -> int:
        """The number of recorded states."""
        return len(self.time)

    def __repr__(self) -> str:
        begin, end = self.time[0], self.time[-1]
        return (
            f"<carom.Trajectory of {len(self.ids)} spheres from {begin} to {end} s, "
            f"{len(self)} states, {len(self.impacts)} impacts>"
        )

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each sphere that is there at each time.

        The columns are those of ``carom run --out``: ``t``, ``ball``, ``x``, ``y``, ``z``, ``vx``,
        ``vy``, ``vz``, and with rotation ``qx``, ``qy``, ``qz``, ``qw``, ``wx``, ``wy``, ``wz``.

        Raises:
            ModuleNotFoundError: Where pandas is not installed.
        """
        import pandas

        is_there = ~np.isnan(self.positions[:, :, 0])
        row, column = np.nonzero(is_there)
        columns: dict[str, NDArray[np.float64] | NDArray[np.uint64]] = {
            "t": self.time[row],
            "ball": self.ids[column],
        }
        recorded = {
            "": self.positions,
            "v": self.velocities,
            "q": self.orientations,
            "w": self.angular_velocities,
        }
        for prefix, values in recorded.items():
            if values is not None:
                names = [f"{prefix}{part}" for part in _PARTS[: values.shape[2]]]
                columns.update(zip(names, values[is_there].T, strict=True))
        return pandas.DataFrame(columns)

    def impacts_to_pandas(self) -> pandas.DataFrame:
        """A row for each impact; vectors as three columns like ``normal_x``.

        Raises:
            ModuleNotFoundError: Where pandas is not installed.
        """
        import pandas

        return pandas.DataFrame(flat_columns(self.impacts))

    def to_xarray(self) -> xarray.Dataset:
        """Positions and velocities over ``time``, ``sphere`` and ``axis``; the arrays are shared.

        Radii and masses are there, too, over ``sphere``. With rotation so are angular velocities,
        and orientations over ``part``, that of a quaternion.

        Raises:
            ModuleNotFoundError: Where xarray is not installed.
        """
        import xarray

        vectors = ("time", "sphere", "axis")
        variables: dict[str, tuple[Any, ...]] = {
            "position": (vectors, self.positions, {"units": "m"}),
            "velocity": (vectors, self.velocities, {"units": "m/s"}),
            "radius": ("sphere", self.radii, {"units": "m"}),
            "mass": ("sphere", self.masses, {"units": "kg"}),
        }
        coordinates: dict[str, Any] = {
            "time": ("time", self.time, {"units": "s"}),
            "sphere": self.ids,
            "axis": list(_AXES),
        }
        if self.angular_velocities is not None:
            variables["angular_velocity"] = (vectors, self.angular_velocities, {"units": "rad/s"})
        if self.orientations is not None:
            quaternions = ("time", "sphere", "part")
            variables["orientation"] = (quaternions, self.orientations, {"units": "1"})
            coordinates["part"] = list(_PARTS)
        return xarray.Dataset(variables, coordinates)
