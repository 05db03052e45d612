"""What a run leaves."""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from carom._carom import Engine
from carom._run import particles
from carom._run.tables import IMPACT, SENSOR_EVENT, flat_columns
from carom._scene.above import above
from carom._scene.scene import Scene
from carom._scene.view import NOTEBOOK_SIZE, Size, Viewpoint
from carom.errors import CaromError

if TYPE_CHECKING:
    import pandas
    import xarray

    from carom._scene.above import AnimatedTrajectory, Still, World


_PARTS = ("x", "y", "z", "w")
"""Of a quaternion; those of a vector are the first three."""
_AXES = _PARTS[:3]

_EVENTS = {"impacts": IMPACT, "sensor_events": SENSOR_EVENT}
"""Records of what happens between states."""


Recorded: TypeAlias = Literal["positions", "velocities", "orientations", "angular_velocities"]
"""What a run can record of each state."""


class Selection(NamedTuple):
    """What a run records."""

    quantities: list[Recorded] | None
    """Of each state; ``None``: those that change."""
    is_single: bool
    """Whether numbers of states are rounded to single precision."""
    has_impacts: bool
    """Whether impacts are recorded, too."""
    has_sensor_events: bool
    """Whether events of sensors are recorded, too."""


RunRecord: TypeAlias = tuple[
    NDArray[np.float64],
    NDArray[np.uint64],
    NDArray[np.float64],
    NDArray[np.float64],
    list[NDArray[np.uint64]],
    list[tuple[Recorded, NDArray[np.float64]]],
    BaseException | None,
]
"""What the engine records of a run: times, ids, radii, masses, events, what changes, its end."""

_COLUMNS: dict[Recorded, str] = {
    "positions": "position",
    "velocities": "velocity",
    "orientations": "orientation",
    "angular_velocities": "angular_velocity",
}
"""What they are called in files."""


_REQUIRED = ("positions", "velocities", "impacts", "sensor_events")
"""What is there unless it was not recorded."""


def box_of(world: Engine) -> NDArray[np.float64] | None:
    """The sides of the periodic box of a world, if it has one."""
    sides = world._box_sides
    return None if sides is None else np.array(sides)


def slides_of(world: Engine, time: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """How far the box above has slid at each of some times, in a world in steady shear."""
    return world._slides(np.ascontiguousarray(time, np.float64))


def _not_recorded() -> Any:
    """Stands for what was not recorded, until it is taken out."""
    return None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Trajectory:
    """States of all spheres over time, and every impact. Arrays are C-ordered.

    Positions, velocities and events that were not recorded are not there: to read them raises an
    `AttributeError` that says so.

    Attributes:
        time: When the states were recorded, on the world's clock [s], shape (t,). The first is the
            state at the beginning of the run.
        positions: Centres [m], shape (t, n, 3); NaN where a sphere is not there.
        velocities: Velocities [m/s], shape (t, n, 3); NaN where a sphere is not there.
        ids: Ids of the n spheres that are there at any of these times, ascending, shape (n,).
        radii: Radii [m], shape (n,).
        masses: Masses [kg], shape (n,).
        impacts: Every impact of the run, those after its last recorded state among them, records
            of `carom.IMPACT`: 128 bytes for each.
        sensor_events: Every entry of a sphere into a trigger, and every exit, records of
            `carom.SENSOR_EVENT`: 88 bytes for each.
        orientations: How spheres are turned, quaternions x, y, z, w, shape (t, n, 4); NaN where a
            sphere is not there. None where they were not recorded: unless asked for, where no
            sphere turned at the beginning, and no friction could make one turn.
        angular_velocities: Angular velocities, along the axes [rad/s], shape (t, n, 3), or None, as
            the orientations.
        box: Sides of the periodic box around the origin [m], shape (3,), infinite along an axis
            that is open; None where no axis is periodic.
        slides: How far the box above, along y, has slid along x at each time [m], shape (t,), at
            most half a side; None without steady shear.
    """

    time: NDArray[np.float64]
    ids: NDArray[np.uint64]
    radii: NDArray[np.float64]
    masses: NDArray[np.float64]
    impacts: NDArray[np.void] = field(default_factory=_not_recorded)
    sensor_events: NDArray[np.void] = field(default_factory=_not_recorded)
    positions: NDArray[np.float64] = field(default_factory=_not_recorded)
    velocities: NDArray[np.float64] = field(default_factory=_not_recorded)
    orientations: NDArray[np.float64] | None = None
    angular_velocities: NDArray[np.float64] | None = None
    box: NDArray[np.float64] | None = None
    slides: NDArray[np.float64] | None = None

    def __post_init__(self) -> None:
        for name in _REQUIRED:
            if getattr(self, name) is None:
                object.__delattr__(self, name)

    def __getattr__(self, name: str) -> Any:
        if name in _REQUIRED:
            raise AttributeError(f"{name} were not recorded: see `World.run`")
        raise AttributeError(f"a carom.Trajectory has no attribute {name!r}")

    def __len__(self) -> int:
        """The number of recorded states."""
        return len(self.time)

    def __repr__(self) -> str:
        begin, end = self.time[0], self.time[-1]
        impacts = self.__dict__.get("impacts")
        told = "" if impacts is None else f", {len(impacts)} impacts"
        return (
            f"<carom.Trajectory of {len(self.ids)} spheres from {begin} to {end} s, "
            f"{len(self)} states{told}>"
        )

    def _recorded(self, name: Recorded) -> NDArray[np.float64] | None:
        """What was recorded under this name, if anything was."""
        values: NDArray[np.float64] | None = self.__dict__.get(name)
        return values

    def _is_there(self) -> NDArray[np.bool_]:
        """Which sphere is there at which time, shape (t, n)."""
        recorded = [values for name in _COLUMNS if (values := self._recorded(name)) is not None]
        if not recorded:
            return np.ones((len(self.time), len(self.ids)), dtype=bool)
        there: NDArray[np.bool_] = ~np.isnan(recorded[0][:, :, 0])
        return there

    def show(
        self,
        scene: Scene | World | None = None,
        *,
        size: Size = NOTEBOOK_SIZE,
        camera: Viewpoint = "scene",
    ) -> AnimatedTrajectory | Still:
        """A player of the recorded states: see `carom.notebook.AnimatedTrajectory`.

        It needs the extra `carom[notebook]`; without it, it is a picture that says how to get it.

        Args:
            scene: What was run, as it was at the time 0: colliders, looks and camera come from it.
            size: Width and height [pixels].
            camera: Where to look from: see `carom.Viewpoint`.

        Raises:
            CaromError: If no positions were recorded, or for an argument that is invalid.
            GraphicsError: If nothing can be drawn here.
        """
        return above.notebook.show_trajectory(self, scene, size, camera)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file, which `load` reads: to the bit what this is.

        An .npz file has the arrays that ``carom run --out`` writes, one row for each sphere that is
        there at each time, and the events besides, as records of `carom.IMPACT` and
        `carom.SENSOR_EVENT`. Extended XYZ (.xyz, .extxyz), dumps of LAMMPS (.lammpstrj, .dump) and
        GSD (.gsd) are for other programs: they hold the states and the box, in steady shear with
        edges along y that lean, but no events.

        Args:
            path: Of the file, with its ending. A file that is there is replaced.

        Raises:
            CaromError: For another ending, or if positions were not recorded, for a format of other
                programs.
            OSError: If it cannot be written.

        >>> import carom, tempfile, pathlib
        >>> run = carom.load("tutorial1").run(seconds=1)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder) / "run.npz"
        ...     run.save(path)
        ...     again = carom.Trajectory.load(path)
        >>> bool((again.positions == run.positions).all())
        True
        """
        if particles.is_particle_file(path):
            particles.write(path, self._particles())
            return
        if Path(path).suffix.lower() != ".npz":
            known = ", ".join(sorted(particles.ENDINGS))
            problem = f"must end in .npz, {known}; `to_pandas` makes a table"
            raise CaromError(f"path: {os.fspath(path)} {problem}", "path")
        is_there = self._is_there()
        row, column = np.nonzero(is_there)
        arrays: dict[str, NDArray[Any]] = {
            "t": self.time[row],
            "ball": self.ids[column].astype(np.int64),
            "frame_start": np.concatenate(([0], np.cumsum(is_there.sum(axis=1)))),
            "time": self.time,
            "id": self.ids.astype(np.int64),
            "radius": self.radii,
            "mass": self.masses,
        }
        if self.box is not None:
            arrays["box"] = self.box
        if self.slides is not None:
            arrays["slide"] = self.slides
        arrays.update({name: self.__dict__[name] for name in _EVENTS if name in self.__dict__})
        for name, column_name in _COLUMNS.items():
            values = self._recorded(name)
            if values is not None:
                arrays[column_name] = values[is_there]
        with open(path, "wb") as file:
            np.savez(file, **arrays)  # type: ignore[arg-type]  # Names are no options of it.

    def _particles(self) -> particles.Particles:
        """The states, for other programs."""
        if self._recorded("positions") is None:
            raise CaromError("positions: were not recorded by the run", "positions")

        def double(values: NDArray[np.float64]) -> NDArray[np.float64]:
            return np.ascontiguousarray(values, dtype=np.float64)

        def doubles(name: Recorded) -> NDArray[np.float64] | None:
            values = self._recorded(name)
            return None if values is None else double(values)

        return particles.Particles(
            time=double(self.time),
            ids=np.ascontiguousarray(self.ids, dtype=np.uint64),
            radii=double(self.radii),
            masses=double(self.masses),
            sides=[np.inf] * 3 if self.box is None else [float(side) for side in self.box],
            slides=None if self.slides is None else double(self.slides),
            positions=double(self.positions),
            velocities=doubles("velocities"),
            orientations=doubles("orientations"),
            angular_velocities=doubles("angular_velocities"),
        )

    @classmethod
    def load(cls, path: str | os.PathLike[str], *, radius: float | None = None) -> Trajectory:
        """Reads a file of `save`, of ``carom run --out``, or of another program.

        Only `save` writes events, into .npz files. Of extended XYZ, dumps of LAMMPS and GSD, times
        that the file lacks are the numbers of its frames, a mass that it lacks is 1 kg, and the
        periodic box is moved to the origin, so that positions of `save` keep their bits.

        Args:
            path: Of the file; its ending tells the format, .npz unless it is another one of `save`.
            radius: Radius of every particle [m], for a file of another program without radii.

        Raises:
            CaromError: If it is no such file, with the line in its message, or if it is not clear
                which radius particles have.
            OSError: If it cannot be read.
        """
        if particles.is_particle_file(path):
            return cls(**particles.read(path, radius))
        if radius is not None:
            raise CaromError("radius: .npz files have radii of their own", "radius")
        with open(path, "rb") as file:
            if not zipfile.is_zipfile(file):
                raise CaromError(f"{os.fspath(path)}: no trajectory of carom: no .npz file", "path")
        try:
            with np.load(path, allow_pickle=False) as file:
                arrays = {name: file[name] for name in file.files}
            return cls._of_arrays(arrays)
        except (KeyError, ValueError, IndexError, EOFError, zipfile.BadZipFile) as error:
            problem = f"no trajectory of carom: {error}"
            raise CaromError(f"{os.fspath(path)}: {problem}", "path") from error

    @classmethod
    def _of_arrays(cls, arrays: dict[str, NDArray[Any]]) -> Trajectory:
        """The trajectory of the arrays of a file."""
        time, ids = arrays["time"], arrays["id"].astype(np.uint64)
        counts = np.diff(arrays["frame_start"])
        row = np.repeat(np.arange(len(time)), counts)
        column = np.searchsorted(ids, arrays["ball"].astype(np.uint64))
        motion: dict[str, NDArray[Any]] = {}
        for name, column_name in _COLUMNS.items():
            if column_name in arrays:
                values = arrays[column_name]
                spread = np.full((len(time), len(ids), values.shape[1]), np.nan, values.dtype)
                spread[row, column] = values
                motion[name] = spread
        for events, kind in _EVENTS.items():
            if events in arrays:
                if arrays[events].dtype != kind:
                    raise ValueError(f"its {events} are of another version")
                motion[events] = arrays[events]
        return cls(
            time=time,
            ids=ids,
            radii=arrays["radius"],
            masses=arrays["mass"],
            box=arrays.get("box"),
            slides=arrays.get("slide"),
            **motion,
        )

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each sphere that is there at each time.

        The columns are those of ``carom run --out``: ``t``, ``ball``, ``x``, ``y``, ``z``, ``vx``,
        ``vy``, ``vz``, and with rotation ``qx``, ``qy``, ``qz``, ``qw``, ``wx``, ``wy``, ``wz``.

        Raises:
            ModuleNotFoundError: Where pandas is not installed.
        """
        import pandas

        is_there = self._is_there()
        row, column = np.nonzero(is_there)
        columns: dict[str, NDArray[np.float64] | NDArray[np.uint64]] = {
            "t": self.time[row],
            "ball": self.ids[column],
        }
        prefixes: dict[Recorded, str] = {
            "positions": "",
            "velocities": "v",
            "orientations": "q",
            "angular_velocities": "w",
        }
        for name, prefix in prefixes.items():
            values = self._recorded(name)
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

    def sensor_events_to_pandas(self) -> pandas.DataFrame:
        """A row for each entry into a trigger and each exit; vectors as columns like ``point_x``.

        Raises:
            ModuleNotFoundError: Where pandas is not installed.
        """
        import pandas

        return pandas.DataFrame(flat_columns(self.sensor_events))

    def to_xarray(self) -> xarray.Dataset:
        """Positions and velocities over ``time``, ``sphere`` and ``axis``; the arrays are shared.

        Radii and masses are there, too, over ``sphere``, the sides of a periodic box over
        ``axis``, and its slide under shear over ``time``. With rotation so are angular velocities,
        and orientations over ``part``, that of a quaternion.

        Raises:
            ModuleNotFoundError: Where xarray is not installed.
        """
        import xarray

        vectors = ("time", "sphere", "axis")
        variables: dict[str, tuple[Any, ...]] = {
            "radius": ("sphere", self.radii, {"units": "m"}),
            "mass": ("sphere", self.masses, {"units": "kg"}),
        }
        coordinates: dict[str, Any] = {
            "time": ("time", self.time, {"units": "s"}),
            "sphere": self.ids,
            "axis": list(_AXES),
        }
        motion: dict[Recorded, tuple[str, str]] = {
            "positions": ("position", "m"),
            "velocities": ("velocity", "m/s"),
        }
        for name, (singular, unit) in motion.items():
            values = self._recorded(name)
            if values is not None:
                variables[singular] = (vectors, values, {"units": unit})
        if self.angular_velocities is not None:
            variables["angular_velocity"] = (vectors, self.angular_velocities, {"units": "rad/s"})
        if self.orientations is not None:
            quaternions = ("time", "sphere", "part")
            variables["orientation"] = (quaternions, self.orientations, {"units": "1"})
            coordinates["part"] = list(_PARTS)
        if self.box is not None:
            variables["box"] = ("axis", self.box, {"units": "m"})
        if self.slides is not None:
            variables["slide"] = ("time", self.slides, {"units": "m"})
        return xarray.Dataset(variables, coordinates)
