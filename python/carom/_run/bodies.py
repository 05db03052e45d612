"""What there is in a world: spheres, springs between them, colliders, emitters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import Engine
from carom._run import tables
from carom._scene import parts
from carom._scene.labels import labels_of
from carom._scene.points import Points
from carom._scene.text import read_part, read_parts, toml_value
from carom.errors import CaromError, UnknownError

if TYPE_CHECKING:
    from typing_extensions import TypeIs


def _are_spheres(
    given: ArrayLike | Sequence[parts.Sphere],
) -> TypeIs[Sequence[parts.Sphere]]:
    """Whether these are spheres, and not their centres."""
    if isinstance(given, Points):
        return True
    if not isinstance(given, Sequence) or isinstance(given, (str, bytes)):
        return False
    return len(given) > 0 and all(isinstance(it, parts.Sphere) for it in given)


class Bodies(Engine):
    """A world as far as it has bodies and what joins them; `carom.World` moves them."""

    # Spheres

    def add_sphere(self, sphere: parts.Sphere) -> int:
        """Adds a sphere, which may overlap others, and returns its id.

        Raises:
            SceneError: For a number that is invalid.
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
        groups: ArrayLike | None = None,
        collides_with: ArrayLike | None = None,
        user_data: ArrayLike | None = None,
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
            groups: Groups that they are in, one bit for each of 32, spread to shape (n,); the first
                unless given.
            collides_with: Groups that they collide with, one bit for each, spread to shape (n,);
                all unless given.
            user_data: Whole numbers for programs to find them by, spread to shape (n,); 0 unless
                given.
            overlap: ``"raise"`` refuses spheres that overlap each other, or what is there.

        Raises:
            CaromError: For shapes that do not fit, and invalid numbers, by the number of
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
            "groups": groups,
            "collides_with": collides_with,
            "user_data": user_data,
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
            SceneError: For a number that is invalid.
        """
        parts.expect("sphere", sphere, parts.Sphere)
        self._set_sphere(id, f"spheres = [{toml_value(sphere, 'sphere')}]")

    def strike(self, id: int, strike: parts.Strike) -> None:
        """Strikes a sphere with a cue: its velocity and its angular velocity change at once.

        Raises:
            UnknownError: If the world does not (or no longer) contain it.
            CaromError: For a number that is invalid.

        >>> import carom
        >>> world = carom.World()
        >>> ball = world.add_sphere(carom.Sphere(radius=0.0286, mass=0.17))
        >>> world.strike(ball, carom.Strike(speed=2.0, offset=(0.0, -0.4)))
        >>> world.velocities[0, 0].round(2), world.angular_velocities[0, 2].round(1)
        (np.float64(2.35), np.float64(82.3))
        """
        angles = (strike.azimuth_degrees, strike.elevation_degrees)
        self._strike(id, (strike.speed, *angles, *strike.offset, strike.cue_mass))

    @property
    def groups(self) -> NDArray[np.uint64]:
        """Groups that spheres are in, one bit for each of 32, shape (n,). A copy; can be assigned.

        >>> import carom
        >>> world = carom.World()
        >>> ids = world.add_spheres([(0, 0, 0), (3, 0, 0)], radii=1)
        >>> world.groups = [0b01, 0b10]
        >>> world.sphere(ids[1]).groups
        2
        """
        return self._label("groups")

    @groups.setter
    def groups(self, values: ArrayLike) -> None:
        self._set_labels("groups", labels_of("groups", values, len(self)))

    @property
    def collides_with(self) -> NDArray[np.uint64]:
        """Groups that spheres collide with, one bit for each, shape (n,). A copy; can be assigned.

        Two bodies collide if each is in a group that the other collides with.
        """
        return self._label("collides_with")

    @collides_with.setter
    def collides_with(self, values: ArrayLike) -> None:
        self._set_labels("collides_with", labels_of("collides_with", values, len(self)))

    @property
    def user_data(self) -> NDArray[np.uint64]:
        """Whole numbers for programs to find spheres by, shape (n,). A copy; can be assigned."""
        return self._label("user_data")

    @user_data.setter
    def user_data(self, values: ArrayLike) -> None:
        self._set_labels("user_data", labels_of("user_data", values, len(self)))

    def _label(self, name: str) -> NDArray[np.uint64]:
        labels = self._labels(name)
        # What is written into a copy would be lost.
        labels.flags.writeable = False
        return labels

    # Springs

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
            SceneError: For a spring that is invalid.

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
            SceneError: For a spring that is invalid.
        """
        parts.expect("spring", spring, parts.Spring)
        self._set_spring(id, f"springs = [{toml_value(spring, 'spring')}]")

    # Pairs of materials

    @property
    def material_pairs(self) -> tuple[parts.MaterialPair, ...]:
        """Pairs of materials whose contacts have coefficients of their own. Can be assigned to.

        The materials are those of the scene that the world was made from.
        """
        pairs: tuple[parts.MaterialPair, ...]
        pairs = read_part("material_pairs", self._material_pairs_json())
        return pairs

    @material_pairs.setter
    def material_pairs(self, pairs: Sequence[parts.MaterialPair]) -> None:
        pairs = tuple(pairs)
        for number, pair in enumerate(pairs):
            parts.expect(f"material_pairs[{number}]", pair, parts.MaterialPair)
        self._set_material_pairs(f"material_pairs = {toml_value(pairs, 'material_pairs')}")

    # Colliders, emitters

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

    def set_next_pose(
        self,
        id: int,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
        dt: float | None = None,
    ) -> None:
        """Sets the velocities of a collider so that the next step takes it to a pose.

        It turns the shorter way, and spheres feel how it moves. It moves on until it gets other
        velocities.

        Args:
            id: Of the collider.
            position: Of its centre [m], (3,); where it is, unless given.
            rotation: Quaternion x, y, z, w, (4,); as it is, unless given.
            dt: Length of that step [s]; the scene's own frame time unless given.

        Raises:
            UnknownError: If the world has no such collider.
            CaromError: For a value that makes no sense, or if a motion moves the collider.

        >>> import carom
        >>> world = carom.World()
        >>> paddle = world.add_collider(carom.Collider(carom.Box(size=(1, 1, 1))))
        >>> world.set_next_pose(paddle, position=(1, 0, 0), dt=0.5)
        >>> world.colliders[paddle].velocity
        (2.0, 0.0, 0.0)
        """
        self._set_next_pose((id, position, rotation), dt)

    @property
    def emitters(self) -> dict[int, parts.Emitter]:
        """The emitters by their ids. A copy."""
        return read_parts("emitters", self._emitters_json())

    def add_emitter(self, emitter: parts.Emitter) -> int:
        """Adds an emitter, and returns its id; its first sphere is due now."""
        parts.expect("emitter", emitter, parts.Emitter)
        return self._add_emitter(f"emitters = [{toml_value(emitter, 'emitter')}]")

    def set_emitter(self, id: int, emitter: parts.Emitter) -> None:
        """Changes an emitter. With another period it starts again at the present time."""
        parts.expect("emitter", emitter, parts.Emitter)
        self._set_emitter(id, f"emitters = [{toml_value(emitter, 'emitter')}]")
