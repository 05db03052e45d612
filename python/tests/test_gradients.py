"""Gradients of numbers that are made of the end of a run: against tapes and differences.

Also in batches, and through PyTorch and JAX where they are installed.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import carom
from carom._run.traced import Traced

TARGET = (3.0, 1.0, 0.0)
STRIKE = np.array([(1.0, 0.05, 0.0), (0.0, 0.0, 0.0)])


def two_balls() -> carom.Scene:
    balls = [carom.Sphere(position=(x, 0, 0), radius=0.1) for x in (0, 2)]
    return carom.Scene(name="test", spheres=balls)


def miss(end: carom.RunEnd) -> Any:
    return ((end.positions[1] - TARGET) ** 2).sum()


def test_value_and_gradient_are_those_of_the_tape() -> None:
    value, gradient = carom.value_and_grad(miss, seconds=4.0)(two_balls(), velocities=STRIKE)
    world = two_balls().world()
    world.velocities[:] = STRIKE
    tape = carom.Tape(world)
    tape.step(frames=240)
    off = world.positions[1] - TARGET
    expected = tape.gradient(positions=[(0, 0, 0), 2 * off])
    assert value == pytest.approx((off**2).sum(), rel=1e-12)
    assert np.allclose(gradient.velocities, expected.velocities, rtol=1e-12)
    assert np.allclose(gradient.radii, expected.radii, rtol=1e-12)


def test_a_world_stays_as_it_is() -> None:
    world = two_balls().world()
    world.velocities[:] = STRIKE
    before = world.state_hash
    value, _ = carom.value_and_grad(miss, seconds=4.0)(world)
    assert world.state_hash == before
    assert value == carom.value_and_grad(miss, seconds=4.0)(two_balls(), velocities=STRIKE)[0]


def test_runs_of_a_batch_are_those_that_there_are_alone() -> None:
    shot = carom.value_and_grad(miss, seconds=4.0)
    starts = np.stack([STRIKE * (1 + 0.01 * number) for number in range(5)])
    values, gradients = shot(two_balls(), velocities=starts)
    assert values.shape == (5,)
    assert gradients.positions.shape == (5, 2, 3)
    assert gradients.acceleration.shape == (5, 3)
    for number, start in enumerate(starts):
        value, gradient = shot(two_balls(), velocities=start)
        assert values[number] == value
        assert (gradients.velocities[number] == gradient.velocities).all()


def test_numbers_that_do_not_depend_on_the_end_have_no_gradient() -> None:
    value, gradient = carom.value_and_grad(lambda end: end.world.time, seconds=1.0)(two_balls())
    assert value == 1.0
    assert not gradient.velocities.any()


FORMULAS: list[Callable[[Any], Any]] = [
    lambda a: (a * a[:1]).sum(),
    lambda a: np.sqrt(a).mean(),
    lambda a: (a / a[0]).sum(),
    lambda a: (2 - a[0]) @ a[1],
    lambda a: (a**3).sum(axis=0)[1],
    lambda a: np.hypot(a[0, 0], a[1, 1]) + np.arctan2(a[0, 0], a[2, 1]),
    lambda a: np.linalg.norm(a[0] - a[1]) + np.linalg.norm(a, axis=1)[2],
    lambda a: (np.exp(-a) + np.log(a) + np.sin(a) * np.cos(a)).sum(),
    lambda a: (np.tanh(a) + np.log1p(a) + np.tan(0.3 * a) + np.arctan(a)).mean(),
    lambda a: (np.maximum(a, 1) + np.minimum(a, 0.9) + np.abs(a - 1)).sum(),
    lambda a: (2**a + a**a + np.square(a)).sum(),
    lambda a: (a.reshape(9)[4] * a.mean(axis=1, keepdims=True)).sum(),
    lambda a: np.sum(a, axis=1)[0] + np.mean(a) - a[[0, 0, 1]].sum() * +a[0, 0],
]


@pytest.mark.parametrize("number", range(len(FORMULAS)))
def test_derivatives_of_formulas_are_those_of_differences(number: int) -> None:
    formula = FORMULAS[number]
    place = np.random.default_rng(number).uniform(0.5, 1.5, (3, 3))
    traced = Traced(place)
    (found,) = formula(traced).derivatives((traced,))
    h = 1e-5
    for at in np.ndindex(3, 3):
        step = np.zeros((3, 3))
        step[at] = h
        difference = (float(formula(place + step)) - float(formula(place - step))) / (2 * h)
        # Central differences are off by the square of the step, and by rounding over it.
        assert found[at] == pytest.approx(difference, rel=1e-8, abs=1e-8)


def test_what_would_lose_derivatives_is_refused() -> None:
    shot = carom.value_and_grad
    for loss, message in [
        (lambda end: np.array(end.positions).sum(), "a plain array has no derivatives"),
        (lambda end: np.sort(end.positions)[0, 0], r"not known of numpy\.sort"),
        (lambda end: np.floor(end.positions).sum(), r"not known of numpy\.floor"),
        (lambda end: end.positions, r"loss: must be one number, not an array of shape \(2, 3\)"),
    ]:
        with pytest.raises(carom.CaromError, match=message):
            shot(loss, seconds=1.0)(two_balls())
    with pytest.raises(carom.CaromError, match="seconds: must be positive"):
        shot(miss, seconds=0.0)
    with pytest.raises(carom.CaromError, match="dt: must be positive"):
        shot(miss, seconds=1.0, dt=-1.0)
    run = shot(miss, seconds=1.0)
    with pytest.raises(carom.CaromError, match="speeds: must be one of positions"):
        run(two_balls(), speeds=STRIKE)
    with pytest.raises(carom.CaromError, match=r"velocities: must have the shape \(\.\.\., 2, 3\)"):
        run(two_balls(), velocities=STRIKE[:1])
    with pytest.raises(carom.CaromError, match="positions: must have as many runs as velocities"):
        run(two_balls(), velocities=[STRIKE] * 2, positions=[STRIKE] * 3)
    with pytest.raises(carom.CaromError, match="velocities: must be finite"):
        run(two_balls(), velocities=STRIKE * np.nan)


def test_pytorch_goes_through_runs() -> None:
    torch = pytest.importorskip("torch")
    from carom import torch as runs

    start = torch.tensor(STRIKE, requires_grad=True)
    places, _, _ = runs.run(two_balls(), seconds=4.0, velocities=start)
    ((places[1] - torch.tensor(TARGET)) ** 2).sum().backward()
    _, gradient = carom.value_and_grad(miss, seconds=4.0)(two_balls(), velocities=STRIKE)
    assert np.allclose(start.grad.numpy(), gradient.velocities, rtol=1e-12)
    many = torch.tensor(np.stack([STRIKE, 1.01 * STRIKE]), requires_grad=True)
    places, _, _ = runs.run(two_balls(), seconds=4.0, velocities=many)
    assert places.shape == (2, 2, 3)


def test_jax_goes_through_runs() -> None:
    jax = pytest.importorskip("jax")
    from carom import jax as runs

    jax.config.update("jax_enable_x64", True)

    def loss(velocities: Any) -> Any:
        places, _, _ = runs.run(two_balls(), seconds=4.0, velocities=velocities)
        return ((places[1] - np.array(TARGET)) ** 2).sum()

    _, gradient = carom.value_and_grad(miss, seconds=4.0)(two_balls(), velocities=STRIKE)
    found = jax.jit(jax.grad(loss))(STRIKE)
    assert np.allclose(found, gradient.velocities, rtol=1e-12)
    found = jax.vmap(jax.grad(loss))(np.stack([STRIKE, STRIKE]))
    assert np.allclose(found[1], gradient.velocities, rtol=1e-12)
