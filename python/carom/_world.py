"""Worlds: spheres, what acts on them, and what they bounce off, moving."""

from __future__ import annotations

import copy
import os
from typing import TYPE_CHECKING, Any, NoReturn, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom import _parts as parts
from carom import _pictures as pictures
from carom import _tables as tables
from carom._carom import Engine
from carom._contact_account import ContactAccount
from carom._stage_counts import StageCounts
from carom._strict import Strict
from carom._text import read_part, read_parts, toml_of, toml_value
from carom._trajectory import Trajectory
from carom._zone_account import ZoneAccount

if TYPE_CHECKING:
    from carom._scene import Scene


class World(Strict, Engine):
    """Spheres that move.

    A world is made from a scene, and then has a life of its own. Arrays of spheres (``positions``,
    ``velocities``, ``radii``, ``masses``, ``restitutions``, ``orientations``,
    ``angular_velocities``, ``inertia_factors``, ``frictions``, ``rolling_frictions``,
    ``spinning_frictions``, ``tangential_restitutions``, ``ids``) are in ascending order of id:

    - To read one copies nothing: it is the same object for as long as no sphere comes or goes, and
      every frame writes the new state into it. Take ``world.positions.copy()`` to keep a state.
    - When spheres come or go, the attribute is a new array; the old one stays valid, with the last
      values of its spheres.
    - It cannot be written to. To set a quantity, assign to the attribute: ``world.velocities = 0``.
      What is assigned is copied, spread by NumPy's rules of broadcasting, and checked first.

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
        return super().__new__(cls, toml_of(scene))

    def __init__(self, scene: Scene | None = None) -> None:
        """Everything is made by then."""

    def __copy__(self) -> World:
        """A world of its own that goes on as this one does, bit for bit.

        What happened in the last frame is not copied.
        """
        return self.__deepcopy__({})

    def __deepcopy__(self, memo: dict[int, Any]) -> World:
        twin = type(self).__new__(type(self))
        twin.restore(self.snapshot())
        twin.__dict__.update(copy.deepcopy(self.__dict__, memo))
        return twin

    def __reduce__(self) -> NoReturn:
        raise TypeError(
            "a carom.World cannot be pickled: flights under the rule exact have no written form; "
            "pickle world.to_scene(), which begins as the world is now, or copy.copy the world"
        )

    def __repr__(self) -> str:
        return f"<carom.World at {self.time} s, {len(self)} spheres>"

    # Time

    def run(
        self,
        seconds: float | None = None,
        *,
        frames: int | None = None,
        dt: float | None = None,
        every: int = 1,
    ) -> Trajectory:
        """Runs on, and records what happens.

        Other threads run meanwhile; Ctrl-C stops after the frame at work, and leaves the world
        there. If a frame is refused, the world is as it was before the call.

        Args:
            seconds: How long [s], up to whole frames; the scene's own duration unless given.
            frames: How many frames instead.
            dt: Length of a frame [s]; the scene's own unless given.
            every: States are recorded after every so many frames, and at the beginning.

        Raises:
            CaromError: For a number that makes no sense.
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
        time, ids, radii, masses, words, motion = self._record(frames, dt, every)
        impacts = tables.records(words, tables.IMPACT)
        return Trajectory(
            time=time, ids=ids, radii=radii, masses=masses, impacts=impacts, **dict(motion)
        )

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
    def contact_account(self) -> ContactAccount:
        """What contacts did to energy in the last frame.

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
        [number] = self._add_described_spheres(f"spheres = [{toml_value(sphere, 'sphere')}]")
        return number

    def add_spheres(
        self,
        positions: ArrayLike,
        radii: ArrayLike,
        *,
        velocities: ArrayLike = 0.0,
        masses: ArrayLike = 1.0,
        restitutions: ArrayLike = 1.0,
        orientations: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
        inertia_factors: ArrayLike | None = None,
        frictions: ArrayLike | None = None,
        rolling_frictions: ArrayLike | None = None,
        spinning_frictions: ArrayLike | None = None,
        tangential_restitutions: ArrayLike | None = None,
    ) -> NDArray[np.uint64]:
        """Adds n spheres, which may overlap, and returns their ids, shape (n,).

        Args:
            positions: Centres [m], shape (n, 3).
            radii: Radii [m], > 0, spread to shape (n,).
            velocities: Velocities [m/s], spread to shape (n, 3).
            masses: Masses [kg], > 0, spread to shape (n,).
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

        Raises:
            CaromError: For shapes that do not fit, and numbers that make no sense; then no sphere
                is added.
            TypeError: For arrays that are not of numbers.

        >>> import carom
        >>> world = carom.World()
        >>> world.add_spheres([(0, 0, 0), (3, 0, 0)], radii=[1.0, 0.5])
        array([0, 1], dtype=uint64)
        """
        try:
            shape = np.shape(positions)
        except ValueError:
            # Rows of different lengths: refused below, by name.
            shape = ()
        count = shape[0] if len(shape) == 2 else 1
        motion = (positions, velocities)
        properties = (radii, masses, restitutions)
        rotation = (orientations, angular_velocities, inertia_factors)
        friction = (frictions, rolling_frictions, spinning_frictions, tangential_restitutions)
        return self._add_spheres(count, (*motion, *properties, *rotation, *friction))

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
        self._set_sphere(id, f"spheres = [{toml_value(sphere, 'sphere')}]")

    # Forces, colliders, emitters

    @property
    def forces(self) -> dict[int, parts.Force]:
        """The forces by their ids, in the order in which they are added up. A copy."""
        return read_parts("forces", self._forces_json())

    def add_force(self, force: parts.Force) -> int:
        """Adds a force on every sphere, and returns its id."""
        return self._add_force(f"forces = [{toml_value(force, 'force')}]")

    def set_force(self, id: int, force: parts.Force) -> None:
        """Puts a force in the place of another."""
        self._set_force(id, f"forces = [{toml_value(force, 'force')}]")

    @property
    def colliders(self) -> dict[int, parts.Collider]:
        """The colliders by their ids, where they are now. A copy."""
        return read_parts("colliders", self._colliders_json())

    def add_collider(self, collider: parts.Collider) -> int:
        """Adds a collider, and returns its id."""
        return self._add_collider(f"colliders = [{toml_value(collider, 'collider')}]")

    def set_collider(self, id: int, collider: parts.Collider) -> None:
        """Changes a collider; spheres feel no velocity but the one it is given."""
        self._set_collider(id, f"colliders = [{toml_value(collider, 'collider')}]")

    @property
    def emitters(self) -> dict[int, parts.Emitter]:
        """The emitters by their ids. A copy."""
        return read_parts("emitters", self._emitters_json())

    def add_emitter(self, emitter: parts.Emitter) -> int:
        """Adds an emitter, and returns its id; its first sphere is due now."""
        return self._add_emitter(f"emitters = [{toml_value(emitter, 'emitter')}]")

    def set_emitter(self, id: int, emitter: parts.Emitter) -> None:
        """Changes an emitter; with another period it starts anew, now."""
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
        """A scene that begins as the world is now: time begins at 0 there, emitters begin anew."""
        from carom._scene import Scene

        return Scene.from_toml(self._scene_toml())

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

    def _repr_png_(self) -> bytes | None:
        """The world of now in a notebook."""
        return pictures.notebook_picture(self)
