"""Worlds: spheres, what acts on them, and what they bounce off, moving."""

from __future__ import annotations

import copy
import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from carom._carom import Snapshot
from carom._run import tables
from carom._run.bodies import Bodies
from carom._run.functions import Functions
from carom._run.queries import PredictedPath, Queries
from carom._run.recording import Out, check_choice, check_rhythm, run_into
from carom._run.reports import ContactAccount, EnergyAccount, StageCounts, ZoneAccount
from carom._run.strict import Strict
from carom._run.trajectory import Recorded, Selection, Trajectory, box_of, slides_of
from carom._scene import parts
from carom._scene.above import above
from carom._scene.points import Points
from carom._scene.scene import Scene
from carom._scene.text import read_part, read_parts, toml_of, toml_value
from carom._scene.view import SIZE, Quality, Size, View, Viewpoint
from carom.errors import CaromError

if TYPE_CHECKING:
    from typing_extensions import Never

    from carom._scene.above import Still, Viewer


ForceFunction: TypeAlias = Callable[["World"], ArrayLike]
"""Takes a world, and returns the force on each of its spheres [N], spread to shape (n, 3)."""


def _restored(kind: type[World], snapshot: Snapshot) -> World:
    """A world that goes on from a snapshot: what a pickle of one makes."""
    world = kind.__new__(kind)
    world.restore(snapshot)
    return world


class World(Strict, Queries, Bodies):
    """Spheres that move.

    A world is made from a scene, and then has a life of its own. Arrays of spheres (``positions``,
    ``velocities``, ``radii``, ``masses``, ``restitutions``, ``orientations``,
    ``angular_velocities``, ``inertia_factors``, ``frictions``, ``rolling_frictions``,
    ``spinning_frictions``, ``tangential_restitutions``, ``groups``, ``collides_with``,
    ``user_data``, ``ids``) are in ascending order of id:

    - To read one copies nothing: it is the same object for as long as no sphere comes or goes, and
      every frame writes the new state into it. Take ``world.positions.copy()`` to keep a state.
    - When spheres come or go, the attribute is a new array; the old one stays valid, with the last
      values of its spheres, and cannot be written to any more.
    - What is written into it, the next call checks and takes over: ``world.velocities[3] = 0``,
      ``world.positions += (0, 1, 0)``. If a value is refused, the exception names the array and the
      row, and the array is as the world again.
    - What is assigned to the attribute is copied, spread by NumPy's rules of broadcasting, and
      checked first: ``world.velocities = 0``. ``ids`` cannot be changed. ``groups``,
      ``collides_with`` and ``user_data`` are copies, to be changed by assignment only.

    A world can be copied (``copy.copy``) and pickled; the copy goes on by itself, bit for bit.

    Calls that take long let other threads run; threads that use one world wait for each other. What
    is refused raises a `carom.CaromError` that names the argument, and leaves the world unchanged.

    Args:
        scene: What there is at the start; an empty world, stepped by the rule ``exact``, unless
            given.

    >>> import carom
    >>> world = carom.World()
    >>> world.add_force(carom.Gravity((0, -9.81, 0)))
    0
    >>> world.add_collider(carom.Collider(carom.HalfSpace()))
    0
    >>> ball = world.add_sphere(carom.Sphere(position=(0, 2, 0), radius=0.5))
    >>> world.step(frames=60)
    >>> world.positions.shape
    (1, 3)
    >>> bool(world.positions[0, 1] > 0.499)
    True
    """

    def __new__(cls, scene: Scene | None = None) -> World:
        """Makes the world of a scene."""
        if scene is None:
            scene = Scene(name="world")
        if not isinstance(scene, Scene):
            raise TypeError(f"scene: must be a carom.Scene, not {type(scene).__name__}")
        if isinstance(scene.spheres, Points):
            text = toml_of(replace(scene, spheres=(), springs=()))
            springs = f"springs = {toml_value(scene.springs, 'springs')}"
            return super().__new__(cls, text, scene.spheres._given(), springs)
        return super().__new__(cls, toml_of(scene))

    def __init__(self, scene: Scene | None = None) -> None:
        """Everything is made by then."""

    _functions: Functions | None = None
    """The functions among the forces, if there are any."""

    def __copy__(self) -> World:
        """A world of its own that goes on as this one does, bit for bit.

        What happened in the last frame is not copied.
        """
        return self.__deepcopy__({})

    def __deepcopy__(self, memo: dict[int, Any]) -> World:
        twin = type(self).__new__(type(self))
        twin.restore(self.snapshot())
        memo[id(self)] = twin
        own = {name: it for name, it in self.__dict__.items() if name != "_functions"}
        twin.__dict__.update(copy.deepcopy(own, memo))
        twin._functions = None if self._functions is None else self._functions.copy()
        return twin

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (type(self), self.snapshot()), dict(self.__dict__)

    def __repr__(self) -> str:
        return f"<carom.World at {self.time} s, {len(self)} spheres>"

    # Time

    def step(self, *unnamed: Never, dt: float | None = None, frames: int = 1) -> None:
        """Advances the world by ``frames`` frames of ``dt`` [s], or of the scene's own frame time.

        Both go by their names. Other threads run meanwhile. If a frame is refused, the world is as
        it was before the call.

        Raises:
            CaromError: If ``dt`` is not positive and finite, an emitter runs away, or a periodic
                box is too small for the spheres.
            StepError: If a number would overflow, or there are too many impacts.
            KeyboardInterrupt: On Ctrl-C, within a tenth of a second; the world is then as it was
                before the call.
        """
        if self._functions is None or unnamed:
            super().step(*unnamed, dt=dt, frames=frames)
        else:
            self._functions.step(self, dt, frames)

    def run(
        self,
        seconds: float | None = None,
        *,
        frames: int | None = None,
        dt: float | None = None,
        every: int = 1,
        quantities: Recorded | Sequence[Recorded] | None = None,
        dtype: DTypeLike | None = None,
        out: Out | None = None,
        impacts: bool = True,
        sensor_events: bool = True,
    ) -> Trajectory:
        """Runs on, and records what happens.

        Other threads run meanwhile. Ctrl-C stops within a tenth of a second, and leaves the world
        at the last whole frame; what was recorded until then is the attribute ``trajectory`` of the
        `KeyboardInterrupt`. If a frame is refused, the world is as it was before the call.

        Args:
            seconds: How long [s], up to whole frames; the scene's own duration unless given.
            frames: How many frames instead.
            dt: Length of a frame [s]; the scene's own unless given.
            every: States are recorded after this number of frames, and at the beginning; at most
                the number of frames.
            quantities: What is recorded of each state; unless given, positions, velocities and,
                where spheres may turn, orientations and angular velocities.
            dtype: Of what is recorded; float64 unless given, ``"float32"`` takes half the memory.
            out: Arrays to record into, by name, instead of quantities and dtype: a row for each
                state, float64 or float32. With those of ``numpy.lib.format.open_memmap`` a run may
                be larger than memory. Spheres must neither come nor go.
            impacts: Whether impacts are recorded: 128 bytes for each one, in memory in any case,
                whatever ``out`` and ``every`` are; `carom.impact_chunks` yields them in chunks.
                `carom.analysis` takes rates and pressures from them.
            sensor_events: Whether entries into triggers and exits are recorded: 88 bytes for each.

        Raises:
            CaromError: For a number that is invalid.
            MemoryError: If there is not enough for the states, before the first frame.
            StepError: If a number would overflow, or there are too many impacts.

        >>> import carom
        >>> trajectory = carom.load("simtest1").world().run(1.0)
        >>> trajectory.time.shape, trajectory.positions.shape
        ((51,), (51, 2, 3))
        """
        if frames is None:
            frames = self._count_frames(seconds, dt)
        elif seconds is not None:
            raise TypeError("seconds and frames: give one of them")
        frames, every = check_rhythm(frames, every)
        has_impacts = check_choice("impacts", impacts)
        has_sensor_events = check_choice("sensor_events", sensor_events)
        selection = Selection(None, False, has_impacts, has_sensor_events)
        if out is not None:
            if quantities is not None or dtype is not None:
                raise TypeError("out: goes without quantities and dtype, for it says both")

            def take(frames: int, selection: Selection) -> Trajectory:
                return self._run(frames, dt, every, selection)

            return run_into(self, take, out, frames, every, selection)
        kind = np.dtype(np.float64 if dtype is None else dtype)
        if kind not in (np.float64, np.float32):
            raise CaromError(f"dtype: must be float64 or float32, not {kind}", "dtype")
        one = [quantities] if isinstance(quantities, str) else quantities
        names: list[Recorded] | None = None if one is None else list(one)
        selection = selection._replace(quantities=names, is_single=kind == np.float32)
        return self._run(frames, dt, every, selection)

    def _run(self, frames: int, dt: float | None, every: int, selection: Selection) -> Trajectory:
        """Takes frames, and records them; they may end before the second state."""
        if self._functions is not None:
            return self._functions.record(self, frames, dt, every, selection)
        time, ids, radii, masses, words, motion, stopped = self._record(
            frames, dt, every, selection
        )
        recorded: dict[str, Any] = dict(motion)
        if selection.has_impacts:
            recorded["impacts"] = tables.records(words[0], tables.IMPACT)
        if selection.has_sensor_events:
            recorded["sensor_events"] = tables.records(words[1], tables.SENSOR_EVENT)
        recorded["box"] = box_of(self)
        recorded["slides"] = slides_of(self, time)
        trajectory = Trajectory(time=time, ids=ids, radii=radii, masses=masses, **recorded)
        if stopped is not None:
            stopped.trajectory = trajectory  # type: ignore[attr-defined]
            raise stopped
        return trajectory

    # What happened in the last frame

    @property
    def impacts(self) -> NDArray[np.void]:
        """The impacts of the last frame, records of `carom.IMPACT`. A copy."""
        return tables.records(self._impact_words(), tables.IMPACT)

    @property
    def ledger(self) -> NDArray[np.void]:
        """The impacts of the last frame with the account of their groups.

        Records of `carom.LEDGER`, a copy; none under the rules ``discrete`` and ``bisect``.
        """
        return tables.records(self._ledger_words(), tables.LEDGER)

    @property
    def triggers(self) -> NDArray[np.void]:
        """The spheres inside triggers at the end of the last frame, records of `carom.TRIGGER`."""
        return tables.records(self._trigger_words(), tables.TRIGGER)

    @property
    def sensor_events(self) -> NDArray[np.void]:
        """Who entered and left triggers in the last frame, records of `carom.SENSOR_EVENT`.

        However small the trigger and however fast the sphere. A copy.
        """
        return tables.records(self._sensor_event_words(), tables.SENSOR_EVENT)

    @property
    def well_events(self) -> NDArray[np.void]:
        """What happened at the edges of square wells in the last frame: `carom.WELL_EVENT`."""
        return tables.records(self._well_event_words(), tables.WELL_EVENT)

    @property
    def work(self) -> StageCounts:
        """The work of the last frame, counted by stage."""
        return StageCounts(*self._work())

    @property
    def energy_account(self) -> EnergyAccount:
        """Changes of the energy in the last frame, by cause."""
        return EnergyAccount(*self._energy_account())

    @property
    def contact_account(self) -> ContactAccount:
        """How good the solution of the last frame is.

        Under the rule ``contact``, and in stepped zones under ``exact``.
        """
        return ContactAccount(*self._contact_account())

    @property
    def zone_account(self) -> ZoneAccount:
        """What was stepped in the last frame under the rule ``exact``.

        `was_stepped` tells whether anything was so far.
        """
        return ZoneAccount(*self._zone_account())

    # What holds now

    @property
    def contacts(self) -> NDArray[np.void]:
        """The contacts that persist, with their forces: records of `carom.CONTACT`. A copy.

        Known under the rules ``exact`` and ``contact`` after a step; none where something was
        changed since, or under other rules. Under ``exact``, reading them solves for the forces.
        """
        return tables.records(self._contact_words(), tables.CONTACT)

    # Forces

    @property
    def forces(self) -> dict[int, parts.Force | ForceFunction]:
        """The forces by their ids, in the order in which they are added up. A copy."""
        described: dict[int, parts.Force | ForceFunction] = read_parts(
            "forces", self._forces_json()
        )
        return described | ({} if self._functions is None else self._functions.by_id)

    def add_force(self, force: parts.Force | ForceFunction) -> int:
        """Adds a force on every sphere, and returns its id.

        A force may be a function: it takes the world, and returns the force on each sphere [N],
        spread to shape (n, 3). It is called once in each frame, and once more at the start of each
        call of `step` and `run`; its id is negative. Velocities follow by Verlet's scheme, whose
        error is of the second order in the length of a frame: in a trap of frequency ω energy
        swings by (ω dt / 2)² of itself at most, and does not drift; each impact adds an error of
        that order. Under ``discrete`` and ``bisect`` it is that of their integrators. A sphere that
        an emitter brings is under it from its first whole frame on. While a function is at work,
        the world is not to be changed. Copies of the world have the function, snapshots and scenes
        do not.

        >>> import carom
        >>> world = carom.World()
        >>> ball = world.add_sphere(carom.Sphere(position=(1, 0, 0), radius=0.1))
        >>> spring = world.add_force(lambda world: -4 * world.positions)
        >>> world.step(dt=0.01, frames=157)  # Half a swing.
        >>> world.positions.round(3).tolist()
        [[-1.0, 0.0, 0.0]]
        """
        if isinstance(force, (parts.Part, type)) or not callable(force):
            parts.expect("force", force, *parts.FORCES, "a function")
            return self._add_force(f"forces = [{toml_value(force, 'force')}]")
        if self._functions is None:
            self._functions = Functions()
        return self._functions.add(force)

    def set_force(self, id: int, force: parts.Force | ForceFunction) -> None:
        """Puts a force in the place of another; a function in that of a function."""
        is_function = callable(force) and not isinstance(force, (parts.Part, type))
        if self._functions is not None and id in self._functions.by_id:
            if not is_function:
                raise TypeError(f"force: {id} is a function; remove it, and add the other")
            self._functions.by_id[id] = force  # type: ignore[assignment]
            return
        parts.expect("force", force, *parts.FORCES)
        self._set_force(id, f"forces = [{toml_value(force, 'force')}]")

    def remove_force(self, id: int) -> None:
        """Takes a force away.

        Raises:
            UnknownError: If there is none with this id (any more).
        """
        if self._functions is None or id not in self._functions.by_id:
            super().remove_force(id)
            return
        del self._functions.by_id[id]
        if not self._functions.by_id:
            self._functions = None

    def _refuse_functions(self, what: str) -> None:
        if self._functions is not None:
            raise CaromError(f"{what} knows no functions among the forces: remove them", "forces")

    # Events

    def next_event_time(self, within: float) -> float | None:
        """The time of the next impact on the world's clock [s], if one comes so soon.

        Only under the rule ``exact``, and without functions among the forces. It costs as much as a
        copy of the world and the step to that impact. Other threads run meanwhile.

        Args:
            within: How soon [s]; None is the answer if none comes within it.

        Raises:
            CaromError: Under another rule, or if ``within`` is not positive and finite.
            StepError: If a number would overflow, or there are too many impacts.
        """
        self._refuse_functions("next_event_time")
        return super().next_event_time(within)

    def step_to_next_event(self, within: float) -> None:
        """Advances the world to its next impact, and answers it with all others at that instant.

        By ``within`` [s] if none comes before; `impacts` tells which it was. Only under the rule
        ``exact``, and without functions among the forces. Other threads run meanwhile. If the step
        is refused, the world is as it was before the call.

        Raises:
            CaromError: Under another rule, or if ``within`` is not positive and finite.
            StepError: If a number would overflow, or there are too many impacts.
        """
        self._refuse_functions("step_to_next_event")
        super().step_to_next_event(within)

    def predict(self, sphere: int, horizon: float, *, most_impacts: int = 10_000) -> PredictedPath:
        self._refuse_functions("predict")
        return super().predict(sphere, horizon, most_impacts=most_impacts)

    # How it is stepped

    @property
    def simulation(self) -> parts.Simulation:
        """How the world is stepped: rule, impact law, boundary and the like. Can be assigned to."""
        simulation: parts.Simulation = read_part("simulation", self._simulation_json())
        return simulation

    @simulation.setter
    def simulation(self, simulation: parts.Simulation) -> None:
        self._set_simulation(f"simulation = {toml_value(simulation, 'simulation')}")

    def to_scene(self) -> Scene:
        """A scene that begins as the world is now: its time begins at 0, its emitters start again.

        Its spheres are `Points`, which read like a list of `Sphere`. Forces that are applied to
        single spheres are no part of a scene.
        """
        self._refuse_functions("to_scene")
        text, points, springs = self._scene()
        return replace(
            Scene.from_toml(text),
            spheres=Points._told(*points),
            springs=read_part("springs", springs),
        )

    # Pictures

    @overload
    def picture(
        self,
        path: None = None,
        *,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8]: ...
    @overload
    def picture(
        self,
        path: str | os.PathLike[str],
        *,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> None: ...
    def picture(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        size: Size = SIZE,
        camera: Viewpoint = "scene",
        quality: Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8] | None:
        """Draws the world as it is now: see `Scene.picture`; `carom.Renderer` draws many faster."""
        view = View.of(size, camera, quality, stamp)
        return above.pictures.picture_of_world(self, path, view)

    def show(self, *, height: int = 480) -> Viewer | Still:
        """The viewer of the page, at the world of now, for notebooks: see `Scene.show`.

        What happens in it leaves this world as it is: `carom.notebook.Viewer.world` makes another.
        """
        return above.notebook.show(self, height)

    def _repr_png_(self) -> bytes | None:
        """The world of now in a notebook."""
        return above.pictures.notebook_picture(self)

    def _drawn(self) -> World:
        """What a picture of it shows."""
        return self
