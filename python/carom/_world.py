"""Worlds: spheres, what acts on them, and what they bounce off, moving."""

from __future__ import annotations

import copy
import os
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from carom import _parts as parts
from carom import _pictures as pictures
from carom import _tables as tables
from carom._carom import Engine, Snapshot
from carom._contact_account import ContactAccount
from carom._energy_account import EnergyAccount
from carom._functions import ForceFunction, Functions
from carom._points import Points
from carom._recording import Out, check_choice, check_rhythm, run_into
from carom._stage_counts import StageCounts
from carom._strict import Strict
from carom._text import read_part, read_parts, toml_of, toml_value
from carom._trajectory import Recorded, Selection, Trajectory
from carom._zone_account import ZoneAccount
from carom.errors import CaromError, UnknownError

if TYPE_CHECKING:
    from typing_extensions import Never, TypeIs

    from carom._scene import Scene
    from carom._still import Still
    from carom.notebook import Viewer


def _are_spheres(
    given: ArrayLike | Sequence[parts.Sphere],
) -> TypeIs[Sequence[parts.Sphere]]:
    """Whether these are spheres, and not their centres."""
    if isinstance(given, Points):
        return True
    if not isinstance(given, Sequence) or isinstance(given, (str, bytes)):
        return False
    return len(given) > 0 and all(isinstance(it, parts.Sphere) for it in given)


def _restored(kind: type[World], snapshot: Snapshot) -> World:
    """A world that goes on from a snapshot: what a pickle of one makes."""
    world = kind.__new__(kind)
    world.restore(snapshot)
    return world


class World(Strict, Engine):
    """Spheres that move.

    A world is made from a scene, and then has a life of its own. Arrays of spheres (``positions``,
    ``velocities``, ``radii``, ``masses``, ``restitutions``, ``orientations``,
    ``angular_velocities``, ``inertia_factors``, ``frictions``, ``rolling_frictions``,
    ``spinning_frictions``, ``tangential_restitutions``, ``ids``) are in ascending order of id:

    - To read one copies nothing: it is the same object for as long as no sphere comes or goes, and
      every frame writes the new state into it. Take ``world.positions.copy()`` to keep a state.
    - When spheres come or go, the attribute is a new array; the old one stays valid, with the last
      values of its spheres, and cannot be written to any more.
    - What is written into it, the next call checks and takes over: ``world.velocities[3] = 0``,
      ``world.positions += (0, 1, 0)``. If a value is refused, the exception names the array and the
      row, and the array is as the world again.
    - What is assigned to the attribute is copied, spread by NumPy's rules of broadcasting, and
      checked first: ``world.velocities = 0``. ``ids`` cannot be changed.

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
        from carom._scene import Scene

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
    ) -> Trajectory:
        """Runs on, and records what happens.

        Other threads run meanwhile. Ctrl-C stops within a tenth of a second, and leaves the world
        at the last whole frame; what was recorded until then is the attribute ``trajectory`` of the
        `KeyboardInterrupt`. If a frame is refused, the world is as it was before the call.

        Args:
            seconds: How long [s], up to whole frames; the scene's own duration unless given.
            frames: How many frames instead.
            dt: Length of a frame [s]; the scene's own unless given.
            every: States are recorded after every so many frames, and at the beginning; at most as
                many as there are frames.
            quantities: What is recorded of each state; unless given, positions, velocities and,
                where spheres may turn, orientations and angular velocities.
            dtype: Of what is recorded; float64 unless given, ``"float32"`` takes half the memory.
            out: Arrays to record into, by name, instead of quantities and dtype: a row for each
                state, float64 or float32. With those of ``numpy.lib.format.open_memmap`` a run may
                be larger than memory. Spheres must neither come nor go.
            impacts: Whether impacts are recorded: 128 bytes for each one, in memory in any case,
                whatever ``out`` and ``every`` are. `carom.analysis` takes rates and pressures from
                them.

        Raises:
            CaromError: For a number that makes no sense.
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
        if out is not None:
            if quantities is not None or dtype is not None:
                raise TypeError("out: goes without quantities and dtype, for it says both")
            return run_into(self, out, frames, dt, every, has_impacts)
        kind = np.dtype(np.float64 if dtype is None else dtype)
        if kind not in (np.float64, np.float32):
            raise CaromError(f"dtype: must be float64 or float32, not {kind}", "dtype")
        one = [quantities] if isinstance(quantities, str) else quantities
        names: list[Recorded] | None = None if one is None else list(one)
        return self._run(frames, dt, every, Selection(names, kind == np.float32, has_impacts))

    def _run(self, frames: int, dt: float | None, every: int, selection: Selection) -> Trajectory:
        """Takes frames, and records them; they may end before the second state."""
        if self._functions is not None:
            return self._functions.record(self, frames, dt, every, selection)
        time, ids, radii, masses, words, motion, stopped = self._record(
            frames, dt, every, selection
        )
        recorded: dict[str, Any] = dict(motion)
        if selection.has_impacts:
            recorded["impacts"] = tables.records(words, tables.IMPACT)
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
    def work(self) -> StageCounts:
        """The work of the last frame, counted by stage."""
        return StageCounts(*self._work())

    @property
    def energy_account(self) -> EnergyAccount:
        """What became of the energy in the last frame."""
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

    # Spheres

    def add_sphere(self, sphere: parts.Sphere) -> int:
        """Adds a sphere, which may overlap others, and returns its id.

        Raises:
            SceneError: For a number that makes no sense.
        """
        parts.expect("sphere", sphere, parts.Sphere)
        text = f"spheres = [{toml_value(sphere, 'sphere')}]"
        return int(self._add_described_spheres(text, True)[0])

    def add_spheres(
        self,
        positions: ArrayLike | Sequence[parts.Sphere],
        radii: ArrayLike | None = None,
        *,
        velocities: ArrayLike | None = None,
        masses: ArrayLike | None = None,
        densities: ArrayLike | None = None,
        restitutions: ArrayLike | None = None,
        orientations: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
        inertia_factors: ArrayLike | None = None,
        frictions: ArrayLike | None = None,
        rolling_frictions: ArrayLike | None = None,
        spinning_frictions: ArrayLike | None = None,
        tangential_restitutions: ArrayLike | None = None,
        overlap: Literal["allow", "raise"] = "allow",
    ) -> NDArray[np.uint64]:
        """Adds n spheres, and returns their ids, shape (n,).

        Args:
            positions: Centres [m], shape (n, 3); or the spheres themselves, without anything else.
            radii: Radii [m], > 0, spread to shape (n,).
            velocities: Velocities [m/s], spread to shape (n, 3).
            masses: Masses [kg], > 0, spread to shape (n,); 1 unless these or ``densities`` are
                given.
            densities: Densities [kg/m³], > 0, spread to shape (n,), instead of masses.
            restitutions: Coefficients of restitution in [0, 1], spread to shape (n,).
            orientations: How they are turned, quaternions x, y, z, w of any length but zero, spread
                to shape (n, 4); not turned unless given.
            angular_velocities: Angular velocities, along the axes [rad/s], spread to shape (n, 3);
                they do not turn unless given.
            inertia_factors: Moments of inertia divided by m r², > 0, spread to shape (n,); 0.4,
                those of solid balls, unless given.
            frictions: Coefficients of friction, >= 0, spread to shape (n,), nan for spheres that
                say nothing of it, as all do unless given: then what they touch decides.
            rolling_frictions: Coefficients of rolling friction, as ``frictions``.
            spinning_frictions: Coefficients of spinning friction, as ``frictions``.
            tangential_restitutions: Coefficients of tangential restitution in [0, 1], as
                ``frictions``.
            overlap: ``"raise"`` refuses spheres that overlap each other, or what is there.

        Raises:
            CaromError: For shapes that do not fit, and numbers that make no sense, by the number of
                the sphere; then no sphere is added.
            TypeError: For arrays that are not of numbers.

        >>> import carom
        >>> world = carom.World()
        >>> world.add_spheres([(0, 0, 0), (3, 0, 0)], radii=[1.0, 0.5])
        array([0, 1], dtype=uint64)
        """
        if overlap not in ("allow", "raise"):
            raise CaromError(f"overlap: must be 'allow' or 'raise', not {overlap!r}", "overlap")
        may_overlap = overlap == "allow"
        given = {
            "radii": radii,
            "velocities": velocities,
            "masses": masses,
            "densities": densities,
            "restitutions": restitutions,
            "orientations": orientations,
            "angular_velocities": angular_velocities,
            "inertia_factors": inertia_factors,
            "frictions": frictions,
            "rolling_frictions": rolling_frictions,
            "spinning_frictions": spinning_frictions,
            "tangential_restitutions": tangential_restitutions,
        }
        named = {name: values for name, values in given.items() if values is not None}
        if _are_spheres(positions):
            if named:
                raise TypeError(f"{next(iter(named))}: spheres have their own")
            if isinstance(positions, Points):
                return self._add_spheres(positions._given(), may_overlap)
            texts = [toml_value(it, f"spheres[{number}]") for number, it in enumerate(positions)]
            return self._add_described_spheres(f"spheres = [{', '.join(texts)}]", may_overlap)
        if radii is None:
            if np.shape(positions) == (0,):
                return np.empty(0, np.uint64)
            raise TypeError("radii: must be given")
        return self._add_spheres(Points(positions, **named)._given(), may_overlap)  # type: ignore[arg-type]

    def remove_spheres(self, ids: ArrayLike) -> None:
        """Takes spheres out of the world. Those after them move up in the arrays.

        Args:
            ids: Their ids; or n truth values that mark them.

        Raises:
            UnknownError: If one of them is not in the world (any more); then none is taken out.
            TypeError: For what are neither ids nor truth values.

        >>> import carom
        >>> world = carom.load("tutorial4").world()
        >>> world.remove_spheres(world.positions[:, 1] > 6)
        >>> bool((world.positions[:, 1] <= 6).all())
        True
        """
        given = np.asarray(ids)
        if given.dtype == bool:
            if given.shape != (len(self),):
                problem = f"must be {len(self)} truth values, not of shape {given.shape}"
                raise CaromError(f"ids: {problem}", "ids")
            given = self.ids[given]
        if given.size and given.dtype.kind not in "iu":
            raise TypeError(f"ids: must be whole numbers or truth values, not {given.dtype}")
        numbers = given.reshape(-1).tolist()
        if any(number < 0 for number in numbers):
            raise UnknownError(f"there is no sphere {min(numbers)} in this world")
        self._remove_spheres(numbers)

    def overlaps(self, tolerance: float = 0.0) -> NDArray[np.void]:
        """The bodies that overlap by more than ``tolerance`` [m]: records of `carom.OVERLAP`.

        In a periodic box across its faces, too. A copy, in order of the bodies.
        """
        return tables.records(self._overlap_words(float(tolerance)), tables.OVERLAP)

    @property
    def largest_overlap(self) -> float:
        """How deep two bodies overlap at most [m]; 0 where none do."""
        return float(self.overlaps()["depth"].max(initial=0.0))

    def sphere(self, id: int) -> parts.Sphere:
        """The sphere with this id, as it is now.

        Raises:
            UnknownError: If it is not in the world (any more).
        """
        sphere: parts.Sphere = read_part("sphere", self._sphere_json(id))
        return sphere

    def set_sphere(self, id: int, sphere: parts.Sphere) -> None:
        """Changes a sphere.

        Raises:
            UnknownError: If it is not in the world.
            SceneError: For a number that makes no sense.
        """
        parts.expect("sphere", sphere, parts.Sphere)
        self._set_sphere(id, f"spheres = [{toml_value(sphere, 'sphere')}]")

    # Forces, springs, colliders, emitters

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

    @property
    def springs(self) -> dict[int, parts.Spring]:
        """The springs by their ids, in the order in which their forces are added up. A copy.

        Spheres go by their ids here: those of a spring that came with the scene, too.
        """
        return read_parts("springs", self._springs_json())

    def add_spring(self, spring: parts.Spring) -> int:
        """Adds a spring between two spheres, or from one to a fixed point, and returns its id.

        The spring names spheres by their ids, where a scene has numbers; without a ``rest_length``
        it is at rest now. It goes with either sphere. A chain is added spring by spring.

        Raises:
            UnknownError: If one of its spheres is not in the world (any more).
            SceneError: For a spring that makes no sense.

        >>> import carom
        >>> world = carom.World()
        >>> one, other = world.add_spheres([(0, 0, 0), (1, 0, 0)], radii=0.1)
        >>> world.add_spring(carom.Spring(spheres=(one, other), rest_length=0.5, stiffness=8))
        0
        >>> world.potential_energy
        1.0
        """
        parts.expect("spring", spring, parts.Spring)
        return self._add_spring(f"springs = [{toml_value(spring, 'spring')}]")

    def set_spring(self, id: int, spring: parts.Spring) -> None:
        """Puts a spring in the place of another.

        Raises:
            UnknownError: If it, or one of its spheres, is not in the world (any more).
            SceneError: For a spring that makes no sense.
        """
        parts.expect("spring", spring, parts.Spring)
        self._set_spring(id, f"springs = [{toml_value(spring, 'spring')}]")

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

    @property
    def colliders(self) -> dict[int, parts.Collider]:
        """The colliders by their ids, where they are now. A copy."""
        return read_parts("colliders", self._colliders_json())

    def add_collider(self, collider: parts.Collider) -> int:
        """Adds a collider, and returns its id."""
        parts.expect("collider", collider, parts.Collider)
        return self._add_collider(f"colliders = [{toml_value(collider, 'collider')}]")

    def set_collider(self, id: int, collider: parts.Collider) -> None:
        """Changes a collider; spheres feel no velocity but the one it is given."""
        parts.expect("collider", collider, parts.Collider)
        self._set_collider(id, f"colliders = [{toml_value(collider, 'collider')}]")

    @property
    def emitters(self) -> dict[int, parts.Emitter]:
        """The emitters by their ids. A copy."""
        return read_parts("emitters", self._emitters_json())

    def add_emitter(self, emitter: parts.Emitter) -> int:
        """Adds an emitter, and returns its id; its first sphere is due now."""
        parts.expect("emitter", emitter, parts.Emitter)
        return self._add_emitter(f"emitters = [{toml_value(emitter, 'emitter')}]")

    def set_emitter(self, id: int, emitter: parts.Emitter) -> None:
        """Changes an emitter; with another period it starts anew, now."""
        parts.expect("emitter", emitter, parts.Emitter)
        self._set_emitter(id, f"emitters = [{toml_value(emitter, 'emitter')}]")

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
        """A scene that begins as the world is now: time begins at 0 there, emitters begin anew.

        Its spheres are `Points`, which read like a list of `Sphere`. Forces that are applied to
        single spheres are no part of a scene.
        """
        from carom._scene import Scene

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
        size: pictures.Size = pictures.SIZE,
        camera: pictures.Viewpoint = "scene",
        quality: pictures.Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8]: ...
    @overload
    def picture(
        self,
        path: str | os.PathLike[str],
        *,
        size: pictures.Size = pictures.SIZE,
        camera: pictures.Viewpoint = "scene",
        quality: pictures.Quality = "fine",
        stamp: bool = True,
    ) -> None: ...
    def picture(
        self,
        path: str | os.PathLike[str] | None = None,
        *,
        size: pictures.Size = pictures.SIZE,
        camera: pictures.Viewpoint = "scene",
        quality: pictures.Quality = "fine",
        stamp: bool = True,
    ) -> NDArray[np.uint8] | None:
        """Draws the world as it is now: see `Scene.picture`; `carom.Renderer` draws many faster."""
        view = pictures.View.of(size, camera, quality, stamp=stamp)
        file = None if path is None else pictures.checked_path(path, ".png")
        return pictures.picture(self, file, view)

    def show(self, *, height: int = 480) -> Viewer | Still:
        """The viewer of the page, at the world of now, for notebooks: see `Scene.show`.

        What happens in it leaves this world as it is: `carom.notebook.Viewer.world` makes another.
        """
        from carom._still import show

        return show(self, height)

    def _repr_png_(self) -> bytes | None:
        """The world of now in a notebook."""
        return pictures.notebook_picture(self)
