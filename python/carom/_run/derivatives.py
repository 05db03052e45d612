"""Derivatives of a run by what it started with: exact through impacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom._carom import TangentsEngine, TapeEngine
from carom._run.strict import Strict
from carom._run.world import World
from carom.errors import CaromError

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Margin:
    """How near a run came to where derivatives end.

    Attributes:
        directness: The speed of approach in an impact as a part of the relative speed, the least of
            all: 1 head-on, 0 where it grazes. 1 if there was no impact.
        most_grazing: Id of sphere 2 of that impact; None if there was no impact.
        most_grazing_time: When it was, on the world's clock [s]; nan if there was none.
        interval: The shortest time between two impacts of one sphere [s]; inf if none had two.
        closest: Id of that sphere; None if there is none.
        closest_time: When the second of the two was, on the world's clock [s]; nan if none was.
        activity: How near an impact on a group of touching bodies was to pressing other contacts:
            the smallest impulse or rate of opening as a part of the largest. 1 if there was none.
        least_active: Id of a sphere of that group; None if there was none.
        least_active_time: When that was, on the world's clock [s]; nan if there was none.
    """

    directness: float
    most_grazing: int | None
    most_grazing_time: float
    interval: float
    closest: int | None
    closest_time: float
    activity: float
    least_active: int | None
    least_active_time: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Gradient:
    """The derivatives of a number by all that a run started with.

    Rows are spheres in the order of ids, or colliders and springs in the order in which they are in
    the world. Spheres that emitters added come last; what they began with counts for them.

    Attributes:
        positions: By the centres of spheres, shape (n, 3).
        velocities: By their velocities, shape (n, 3).
        angular_velocities: By their angular velocities, shape (n, 3).
        radii: By their radii, with masses as they are, shape (n,).
        masses: By their masses, with radii as they are, shape (n,).
        restitutions: By their coefficients of restitution, shape (n,).
        frictions: By their coefficients of sliding friction, shape (n,).
        accelerations: By a constant acceleration of each, as by an applied force, shape (n, 3).
        collider_positions: By the places of colliders, shape (m, 3).
        collider_rotations: By rotations about these, an angle [rad] along its axis, shape (m, 3);
            nan for colliders that move, bear spheres or are met by groups.
        collider_velocities: By their velocities, shape (m, 3).
        collider_restitutions: By their coefficients of restitution, shape (m,).
        collider_frictions: By their coefficients of sliding friction, shape (m,).
        spring_stiffnesses: By the stiffness of springs, shape (s,).
        spring_rest_lengths: By their rest lengths, shape (s,).
        spring_dampings: By their damping, shape (s,).
        acceleration: By the acceleration of all spheres, that of gravity, shape (3,).
    """

    positions: Array
    velocities: Array
    angular_velocities: Array
    radii: Array
    masses: Array
    restitutions: Array
    frictions: Array
    accelerations: Array
    collider_positions: Array
    collider_rotations: Array
    collider_velocities: Array
    collider_restitutions: Array
    collider_frictions: Array
    spring_stiffnesses: Array
    spring_rest_lengths: Array
    spring_dampings: Array
    acceleration: Array


class Followed(Strict):
    """A world whose steps are followed for their derivatives."""

    __slots__ = ("_engine", "_world")

    _engine: TapeEngine | TangentsEngine
    _world: World

    def step(self, *, dt: float | None = None, frames: int = 1) -> None:
        """Advances the world by ``frames`` frames of ``dt`` [s], and the derivatives with it.

        A change from outside since the last step counts as constant.

        Raises:
            CaromError: As of `World.step`.
            StepError: As of `World.step`, and where there is no derivative: the world has taken the
                frame then, and every later call raises that again.
        """
        self._world._refuse_functions(type(self).__name__)
        self._engine.step(self._world, dt, frames)

    @property
    def margin(self) -> Margin:
        """How near the run came to where derivatives end."""
        return _margin(self._engine.margin)


class Tape(Followed):
    """A record of a run, which gives the gradient of a number by all that the run started with.

    Derivatives are known of worlds under the rule ``exact`` whose spheres fly freely or on springs,
    under the forces of this package, or slide, roll and rest on single planes, or between smooth
    ones, and meet each other and surfaces one at a time, with or without friction. A ball may meet
    several that touch, as in a cradle or a rack: the gradient is then that along changes that keep
    these in touch, and the interval of the margin is 0. What has no derivative is an error, never a
    guess: several bodies that meet at one instant, or spheres pressed against each other.

    >>> import carom
    >>> world = carom.World()
    >>> floor = world.add_collider(carom.Collider(shape=carom.HalfSpace()))
    >>> ball = carom.Sphere(position=(0, 3, 0), radius=1, velocity=(1, -2, 0))
    >>> ball = world.add_sphere(ball)
    >>> tape = carom.Tape(world)
    >>> tape.step(dt=2.0)
    >>> gradient = tape.gradient(positions=[(0, 1, 0)])  # of the height at the end
    >>> gradient.positions.tolist()
    [[0.0, -1.0, 0.0]]
    """

    __slots__ = ()

    _engine: TapeEngine

    def __init__(self, world: World) -> None:
        """Begins with a world as it is now.

        Raises:
            CaromError: If the world has something whose derivatives are not known.
        """
        world._refuse_functions("Tape")
        self._world = world
        self._engine = TapeEngine(world)

    @property
    def impacts(self) -> int:
        """How many impacts are recorded."""
        return self._engine.impacts

    def gradient(
        self,
        *,
        positions: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
    ) -> Gradient:
        """Returns the gradient of a number by all that the run started with.

        Args:
            positions: Derivatives of the number by the centres of spheres now, shape (n, 3); 0
                unless given.
            velocities: By their velocities.
            angular_velocities: By their angular velocities.

        Raises:
            CaromError: If a shape does not fit.
            StepError: The one that ended the record.
        """
        shape = (len(self._world), 3)
        given = {
            "positions": positions,
            "velocities": velocities,
            "angular_velocities": angular_velocities,
        }
        rows = [_numbers(name, values, shape) for name, values in given.items()]
        numbers = self._engine.gradient(rows)
        spheres, colliders, springs = numbers[:8], numbers[8:13], numbers[13:16]
        return Gradient(
            positions=spheres[0].reshape(-1, 3),
            velocities=spheres[1].reshape(-1, 3),
            angular_velocities=spheres[2].reshape(-1, 3),
            radii=spheres[3],
            masses=spheres[4],
            restitutions=spheres[5],
            frictions=spheres[6],
            accelerations=spheres[7].reshape(-1, 3),
            collider_positions=colliders[0].reshape(-1, 3),
            collider_rotations=colliders[1].reshape(-1, 3),
            collider_velocities=colliders[2].reshape(-1, 3),
            collider_restitutions=colliders[3],
            collider_frictions=colliders[4],
            spring_stiffnesses=springs[0],
            spring_rest_lengths=springs[1],
            spring_dampings=springs[2],
            acceleration=numbers[16],
        )


class Tangents(Followed):
    """Small changes of the start of a run, in k directions, carried along with a world.

    Derivatives are known of the same worlds as with `carom.Tape`.

    >>> import carom
    >>> world = carom.World()
    >>> for x, speed in [(-2, 1), (0, 0)]:
    ...     ball = carom.Sphere(position=(x, 0, 0), radius=0.5, velocity=(speed, 0, 0))
    ...     ball = world.add_sphere(ball)
    >>> first_is_faster = [[(1, 0, 0), (0, 0, 0)]]
    >>> tangents = carom.Tangents(world, velocities=first_is_faster)
    >>> tangents.step(dt=3.0)
    >>> tangents.velocities.tolist()  # the other ball has it now
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]]
    """

    __slots__ = ("_count",)

    _engine: TangentsEngine

    def __init__(
        self,
        world: World,
        *,
        positions: ArrayLike | None = None,
        velocities: ArrayLike | None = None,
        angular_velocities: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ) -> None:
        """Begins with a world as it is now.

        Args:
            world: The world.
            positions: Changes of the centres of spheres [m], shape (k, n, 3); 0 unless given.
            velocities: Changes of their velocities [m/s], shape (k, n, 3).
            angular_velocities: Changes of their angular velocities [rad/s], shape (k, n, 3).
            accelerations: Changes of the acceleration of all spheres [m/s²], shape (k, 3).

        Raises:
            CaromError: If the world has something whose derivatives are not known, shapes do not
                fit, or nothing is given.
        """
        world._refuse_functions("Tangents")
        motion = {
            "positions": positions,
            "velocities": velocities,
            "angular_velocities": angular_velocities,
        }
        given = [values for values in (*motion.values(), accelerations) if values is not None]
        if not given:
            raise CaromError("at least one of the changes must be given", "positions")
        count = len(np.asarray(given[0]))
        shape = (count, len(world), 3)
        rows = [_numbers(name, values, shape) for name, values in motion.items()]
        along = _numbers("accelerations", accelerations, (count, 3))
        self._world, self._count = world, count
        self._engine = TangentsEngine(world, count, rows, along)

    @property
    def positions(self) -> Array:
        """How centres change now [m], shape (k, n, 3). A copy."""
        return self._engine.motion()[0].reshape(self._count, -1, 3)

    @property
    def velocities(self) -> Array:
        """How velocities change now [m/s], shape (k, n, 3). A copy."""
        return self._engine.motion()[1].reshape(self._count, -1, 3)

    @property
    def angular_velocities(self) -> Array:
        """How angular velocities change now [rad/s], shape (k, n, 3). A copy."""
        return self._engine.motion()[2].reshape(self._count, -1, 3)

    def orthonormalize(self, *, length: float = 1.0, speed: float = 1.0) -> Array:
        """Makes the directions orthogonal, one after the other, and each of length 1.

        Spins are left out. A change of ``length`` [m] counts as much as one of ``speed`` [m/s].

        Returns:
            How long each was, shape (k,). Their logarithms, summed over a run and divided by its
            time, are the Lyapunov exponents.

        Raises:
            CaromError: If ``length`` or ``speed`` is not positive and finite.
        """
        for name, value in {"length": length, "speed": speed}.items():
            if not (np.isfinite(value) and value > 0):
                raise CaromError(f"{name}: must be positive and finite, not {value}", name)
        return self._engine.orthonormalize(float(length), float(speed))


def _numbers(name: str, values: ArrayLike | None, shape: tuple[int, ...]) -> Array:
    """Returns numbers of a shape in one row; 0 if none are given."""
    if values is None:
        return np.zeros(int(np.prod(shape)))
    numbers = np.asarray(values, dtype=np.float64)
    if numbers.shape != shape:
        raise CaromError(f"{name}: must have the shape {shape}, not {numbers.shape}", name)
    if not np.isfinite(numbers).all():
        raise CaromError(f"{name}: must be finite", name)
    return np.ascontiguousarray(numbers).ravel()


def _margin(numbers: list[tuple[float, int, float]]) -> Margin:
    spheres = [None if sphere < 0 else sphere for _, sphere, _ in numbers]
    directness, interval, activity = [value for value, _, _ in numbers]
    times = [time for _, _, time in numbers]
    return Margin(
        directness=directness,
        most_grazing=spheres[0],
        most_grazing_time=times[0],
        interval=interval,
        closest=spheres[1],
        closest_time=times[1],
        activity=activity,
        least_active=spheres[2],
        least_active_time=times[2],
    )
