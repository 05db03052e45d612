"""Derivatives through impacts: against closed forms, differences of runs, and each other."""

import math

import numpy as np
import pytest

import carom
from carom import analysis


def shot(angle: float) -> carom.World:
    """A ball that is shot against a cushion, and then meets another one."""
    balls = [
        carom.Sphere(
            position=(0, 0, 0), radius=0.1, velocity=(math.cos(angle), math.sin(angle), 0)
        ),
        carom.Sphere(position=(2.1, 0.1, 0), radius=0.1),
    ]
    cushion = carom.Collider(
        shape=carom.HalfSpace(),
        position=(0, 1, 0),
        rotation=(1, 0, 0, 0),
        restitution=0.9,
    )
    return carom.Scene(name="test", spheres=balls, colliders=[cushion]).world()


def end(angle: float) -> np.ndarray:
    world = shot(angle)
    world.step(dt=4.0)
    return world.positions.copy()


def test_the_gradient_of_a_bank_shot_is_that_of_differences_of_runs() -> None:
    angle = 0.71
    tape = carom.Tape(world := shot(angle))
    tape.step(dt=1.0, frames=4)
    assert tape.impacts == 2
    assert world.time == 4.0
    weights = np.random.default_rng(1).normal(size=(2, 3))
    gradient = tape.gradient(positions=weights)
    turning = np.array([[-math.sin(angle), math.cos(angle), 0], [0, 0, 0]])
    found = (gradient.velocities * turning).sum()
    h = 1e-5
    expected = (weights * (end(angle + h) - end(angle - h))).sum() / (2 * h)
    # Central differences are off by the square of the step, times what the impact makes of it.
    assert found == pytest.approx(expected, rel=1e-6)
    assert 0 < tape.margin.directness < 1
    assert tape.margin.closest == 0


def test_directions_and_gradient_agree() -> None:
    weights = np.random.default_rng(2).normal(size=(2, 3))
    tape = carom.Tape(shot(0.71))
    tape.step(dt=4.0)
    gradient = tape.gradient(velocities=weights)
    directions = np.zeros((6, 2, 3))
    for row in range(6):
        directions[row].flat[row] = 1.0
    tangents = carom.Tangents(shot(0.71), positions=directions)
    tangents.step(dt=4.0)
    forwards = (tangents.velocities * weights).sum(axis=(1, 2))
    assert np.allclose(forwards, gradient.positions.ravel(), rtol=1e-12, atol=1e-12)
    # Of an event that never was, the time is nan.
    assert repr(tangents.margin) == repr(tape.margin)


def test_descent_along_the_gradient_finds_a_bank_shot() -> None:
    target = np.array([2.9, 0.35, 0.0])
    angle = 0.68
    for _ in range(20):
        tape = carom.Tape(world := shot(angle))
        tape.step(dt=4.0)
        miss = world.positions[1] - target
        gradient = tape.gradient(positions=[(0, 0, 0), miss])
        slope = (gradient.velocities[0] * (-math.sin(angle), math.cos(angle), 0)).sum()
        change = carom.Tangents(shot(angle), velocities=[turned(angle)])
        change.step(dt=4.0)
        # The step of Gauss and Newton.
        angle -= slope / (change.positions[0, 1] ** 2).sum()
    assert abs(slope) < 1e-12


def turned(angle: float) -> list[tuple[float, float, float]]:
    return [(-math.sin(angle), math.cos(angle), 0.0), (0.0, 0.0, 0.0)]


def test_a_shot_that_slides_and_rolls_to_rest_has_the_derivative_of_its_closed_form() -> None:
    sliding, rolling, speed = 0.2, 0.05, 0.9
    table = carom.Collider(shape=carom.HalfSpace(), friction=sliding, rolling_friction=rolling)
    ball = carom.Sphere(position=(0, 0.03, 0), radius=0.03, velocity=(speed, 0, 0))
    gravity = [carom.Gravity()]
    scene = carom.Scene(name="test", spheres=[ball], colliders=[table], forces=gravity)
    tape = carom.Tape(world := scene.world())
    tape.step(dt=1.0, frames=6)
    gradient = tape.gradient(positions=[(1, 0, 0)])
    # A ball that slides without spin goes 12/49 v²/(mu g), then rolls on with 5/7 v.
    way = (12 / 49 / sliding + 0.5 * (5 / 7) / rolling) * speed**2 / 9.81
    assert world.positions[0, 0] == pytest.approx(way, rel=1e-12)
    assert gradient.velocities[0, 0] == pytest.approx(2 * way / speed, rel=1e-12)
    assert gradient.acceleration[1] == pytest.approx(way / 9.81, rel=1e-12)


def test_the_spectrum_of_a_gas_comes_in_pairs() -> None:
    side = 4.0
    grid = (np.arange(2) - 0.5) * side / 2
    places = np.array(np.meshgrid(grid, grid, grid)).reshape(3, -1).T
    velocities = np.random.default_rng(3).normal(size=places.shape)
    velocities -= velocities.mean(axis=0)
    spheres = carom.Points(positions=places, velocities=velocities, radii=0.6)
    simulation = carom.Simulation(boundary=carom.Periodic(size=(side,) * 3))
    world = carom.Scene(name="test", spheres=spheres, simulation=simulation).world()
    found = analysis.lyapunov_spectrum(world, 60.0, dt=0.25)
    assert found.exponents.shape == (48,)
    assert found.history.shape == (240, 48)
    assert found.exponents[0] > 0.5
    # Motion without loss keeps volumes.
    assert abs(found.exponents.sum()) < 1e-10
    pairs = found.exponents + found.exponents[::-1]
    # After a run of this length the exponents still fluctuate.
    assert np.abs(pairs).max() < 0.1 * found.exponents[0]


def test_what_has_no_derivative_is_refused() -> None:
    # Along a rough groove.
    rest = carom.Sphere(position=(0.5, 0.5, 0), radius=0.5, velocity=(0, 0, 1))
    floor = carom.Collider(shape=carom.HalfSpace(), friction=0.2)
    half = math.sqrt(0.5)
    turned = (0, 0, -half, half)
    wall = carom.Collider(shape=carom.HalfSpace(), rotation=turned, friction=0.2)
    gravity = [carom.Gravity(acceleration=(-5, -9, 0))]
    scene = carom.Scene(name="test", spheres=[rest], colliders=[floor, wall], forces=gravity)
    world = scene.world()
    tape = carom.Tape(world)
    with pytest.raises(carom.StepError, match="sphere 0 did not fly freely"):
        tape.step()
    with pytest.raises(carom.StepError, match="did not fly freely"):
        tape.gradient()
    world.simulation = carom.Simulation(rule="contact")
    with pytest.raises(carom.CaromError, match="a rule other than `exact`"):
        carom.Tape(world)
    with pytest.raises(carom.CaromError, match=r"positions: must have the shape \(1, 2, 3\)"):
        carom.Tangents(shot(0.5), positions=np.zeros((1, 3)))
    with pytest.raises(carom.CaromError, match="at least one"):
        carom.Tangents(shot(0.5))
    with pytest.raises(carom.CaromError, match="count: must be from 1 to 12"):
        analysis.lyapunov_spectrum(shot(0.5), 1.0, count=13)


def test_a_ball_on_a_spring_has_the_derivatives_of_an_oscillator() -> None:
    # x = l + A cos wt with w = sqrt(k/m); a force F on it adds F/k (1 - cos wt).
    stiffness, mass, rest, amplitude, seconds = 3.0, 0.7, 1.5, 0.4, 2.0
    world = carom.World()
    ball = carom.Sphere(position=(rest + amplitude, 0, 0), radius=0.1, mass=mass)
    world.add_spring(
        carom.Spring(
            sphere=world.add_sphere(ball),
            anchor=(0, 0, 0),
            rest_length=rest,
            stiffness=stiffness,
        )
    )
    tape = carom.Tape(world)
    tape.step(dt=seconds / 4, frames=4)
    gradient = tape.gradient(positions=[(1, 0, 0)])
    rate = math.sqrt(stiffness / mass)
    phase = rate * seconds
    by_rate = -amplitude * seconds * math.sin(phase)
    expected = {
        "positions": math.cos(phase),
        "velocities": math.sin(phase) / rate,
        "accelerations": (1 - math.cos(phase)) / rate**2,
        "masses": -by_rate * rate / (2 * mass),
        "spring_stiffnesses": by_rate * rate / (2 * stiffness),
        "spring_rest_lengths": 1 - math.cos(phase),
    }
    for name, value in expected.items():
        # Rounding of the weights of the quadrature.
        assert getattr(gradient, name).flat[0] == pytest.approx(value, abs=2e-12)


def test_spheres_that_emitters_add_come_last_in_gradients() -> None:
    scene = carom.Scene(
        name="falls",
        spheres=[carom.Sphere(position=(3, 2, 0), radius=0.1)],
        colliders=[carom.Collider(shape=carom.HalfSpace(), restitution=1.0)],
        emitters=[
            carom.Emitter(
                sphere=carom.Sphere(position=(0, 1.1, 0), radius=0.1, velocity=(1, 0, 0)),
                period=0.25,
                count=2,
            )
        ],
        forces=[carom.Gravity(acceleration=(0, -8, 0))],
    )
    world = scene.world()
    tape = carom.Tape(world)
    tape.step(dt=0.1, frames=10)
    assert len(world) == 3
    gradient = tape.gradient(positions=[(0, 0, 0), (0, 0, 0), (1, 1, 0)])
    # The last one begins at .25 s, falls for .5 s, and flies up for .25 s at 4 m/s.
    np.testing.assert_allclose(gradient.velocities[2], (0.75, -0.75 + 0.5, 0), atol=1e-12)
    np.testing.assert_allclose(gradient.velocities[:2], np.zeros((2, 3)), atol=1e-12)

    def height(end: carom.RunEnd) -> object:
        return end.positions[0, 1] + end.positions[2, 1]

    _, gradient = carom.value_and_grad(height, seconds=0.5, dt=0.1)(scene)
    assert gradient.velocities.shape == (1, 3)
    np.testing.assert_allclose(gradient.velocities[0], (0, 0.5, 0), atol=1e-12)

    world = scene.world()
    tangents = carom.Tangents(world, accelerations=[(0, -1, 0)])
    tangents.step(dt=0.1, frames=6)
    fallen = [-0.5 * 0.6**2, -0.5 * 0.35**2]
    np.testing.assert_allclose(tangents.positions[0, [0, 2], 1], fallen, atol=1e-12)


def test_a_ramp_that_turns_sends_a_ball_elsewhere_by_twice_the_angle() -> None:
    ball = carom.Sphere(position=(0, 1.1, 0), radius=0.1, velocity=(0, -1, 0))
    ramp = carom.Collider(shape=carom.HalfSpace(), restitution=1.0)
    scene = carom.Scene(name="test", spheres=[ball], colliders=[ramp])
    run = carom.value_and_grad(lambda end: end.velocities[0, 0], seconds=2.0)
    _, gradient = run(scene)
    # Turned about z by an angle a, it sends the ball back along (-sin 2a, cos 2a).
    assert np.allclose(gradient.collider_rotations, [[0, 0, -2]], atol=1e-12)


def test_the_margin_of_a_cradle_has_its_activity() -> None:
    balls = [carom.Sphere(position=(x, 0, 0), radius=0.1) for x in (0.0, 0.2, 0.4)]
    struck = carom.Sphere(position=(-0.7, 0.05, 0), radius=0.1, velocity=(1, 0, 0))
    world = carom.Scene(name="test", spheres=[struck, *balls]).world()
    tape = carom.Tape(world)
    assert (tape.margin.activity, tape.margin.least_active) == (1.0, None)
    tape.step(dt=1.0)
    margin = tape.margin
    assert 0 < margin.activity < 1
    assert margin.least_active in range(4)
    assert 0.5 < margin.least_active_time < 0.6
    assert margin.interval == 0
