"""The three tasks of Zhong, Han and Brikis, arXiv 2207.05060, beside what they print.

``python bench/gradients/tasks.py`` sets each up as the paper and its scripts
(github.com/DesmondZhong/diff_sim_grads) say, and prints Carom's numbers beside theirs and beside
closed forms. What differs: the scripts cut time into steps of 1/480 s, in each of which they move
the balls by Euler's method; Carom's motion is exact, in frames of the same length where a control
changes from step to step.

1. A ball bounces off the floor once: derivatives of its last height.
2. A ball is launched over floor and wall to a target, from the first guess of the scripts, by
   Newton's method; theirs take a thousand steps of descent. They print the launch to four digits.
3. One ball is pushed by a free force in each of 480 steps, so that the other one, which it strikes,
   comes near a goal: the least loss, by L-BFGS; theirs take a thousand steps of descent at a rate
   of 10. One ball is pushed at the other along the line of centres, so that the loss is that of the
   optimal control of Hu et al., arXiv 2205.08622: 1.396542, for controls that are free at any time.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import carom

Array = NDArray[np.float64]

STEPS = 480
"""Steps of task 3, of 1/480 s each."""
GOAL_WEIGHT = 0.1
"""Weight of the integral of the square of the force in the loss of task 3."""
TASK_3 = {
    "optimal control, closed form": 1.396542,
    "DiffTaichi with time of impact": 1.395813,
    "DiffCoSim with time of impact": 1.407855,
    "Nimble (LCP)": 1.408629,
    "Brax, positions": 1.429720,
    "Warp, positions": 1.430243,
    "Warp, compliant": 1.662277,
    "Brax, compliant": 2.000000,
    "DiffCoSim without time of impact": 2.001379,
    "DiffTaichi without time of impact": 2.001444,
}
"""Last losses that ``analyze_two_balls_1.ipynb`` prints."""


def floor_and_wall(wall: float | None, restitution: float) -> carom.World:
    """Returns a world with a floor, and a wall that faces the origin at ``wall`` [m]."""
    world = carom.World()
    half = np.sqrt(0.5)
    world.add_collider(carom.Collider(shape=carom.HalfSpace(), restitution=restitution))
    if wall is not None:
        turned = {"position": (wall, 0, 0), "rotation": (0, 0, half, half)}
        shape = carom.HalfSpace()
        world.add_collider(carom.Collider(shape=shape, restitution=restitution, **turned))
    return world


def bounce() -> None:
    """Task 1: derivatives of the last height by place, velocity and the force of the first step."""
    world = floor_and_wall(None, 1.0)
    world.add_sphere(carom.Sphere(position=(-1, 1, 0), radius=0.1, mass=1, velocity=(2, -2, 0)))
    step = 1.0 / STEPS
    first = carom.Tape(world)
    first.step(dt=step)
    rest = carom.Tape(world)
    rest.step(dt=1.0 - step)
    later = rest.gradient(positions=[(0, 1, 0)])
    start = first.gradient(positions=later.positions, velocities=later.velocities)
    found = [start.positions[0, 1], start.velocities[0, 1], start.accelerations[0, 1]]
    exact = [-1.0, -1.0, -step * (1.0 - 0.5 * step)]
    printed = [-1.0, -0.99559, -2.0698e-3]
    print("task 1: derivatives of the height at the end")
    names = ["by height", "by velocity", "by force of step 1"]
    for name, ours, closed, theirs in zip(names, found, exact, printed, strict=True):
        print(f"{name:>34} {ours:14.7e}, closed form {closed:14.7e}, DiffCoSim {theirs:11.4e}")


def launch() -> None:
    """Task 2: the launch that ends at (-2, 1.5) after 0.6 s."""
    velocity, target = np.array([5.0, -5.0]), np.array([-2.0, 1.5])
    for _number in range(20):
        world = floor_and_wall(1.75, 0.92)
        world.add_force(carom.Gravity(acceleration=(0, -9.8, 0)))
        ball = carom.Sphere(position=(-0.5, 1, 0), radius=0.1, velocity=(*velocity, 0))
        world.add_sphere(ball)
        tape = carom.Tape(world)
        tape.step(dt=0.6)
        off = world.positions[0, :2] - target
        if np.abs(off).max() < 1e-12:
            break
        axes = [(1, 0, 0), (0, 1, 0)]
        rows = [tape.gradient(positions=[axis]).velocities[0, :2] for axis in axes]
        velocity = velocity - np.linalg.solve(np.array(rows), off)
    print(f"task 2: launch {velocity.round(6)} m/s, off the target by {np.abs(off).max():.0e} m")
    print("      paper: launch [10.1957, -4.0907] m/s")


def push(forces: Array) -> tuple[float, Array]:
    """Returns the loss of task 3 and its gradient by the force of each step, shape (480, 2)."""
    world, step = carom.World(), 1.0 / STEPS
    for place in (-2.0, -1.0):
        world.add_sphere(carom.Sphere(position=(place, place, 0), radius=0.2, mass=1.0))
    tapes = []
    for force in forces:
        world.applied_forces = np.array([(*force, 0.0), (0.0, 0.0, 0.0)])
        tapes.append(carom.Tape(world))
        tapes[-1].step(dt=step)
    end = world.positions[1, :2]
    loss = float(end @ end + GOAL_WEIGHT * step * (forces**2).sum())
    by_places = np.array([(0.0, 0.0, 0.0), (*(2.0 * end), 0.0)])
    by_velocities = np.zeros((2, 3))
    gradient = 2.0 * GOAL_WEIGHT * step * forces
    for number in reversed(range(STEPS)):
        before = tapes[number].gradient(positions=by_places, velocities=by_velocities)
        gradient[number] += before.accelerations[0, :2]
        by_places, by_velocities = before.positions, before.velocities
    return loss, gradient


def descend(of: Callable[[Array], tuple[float, Array]], start: Array) -> tuple[float, int]:
    """Returns the least value of a function by L-BFGS (Nocedal 1980), and the number of calls."""
    here, (value, slope), calls = start, of(start), 1
    changes: list[tuple[Array, Array]] = []
    while np.abs(slope).max() > 1e-9 and calls < 400:
        way, factors = slope.copy(), []
        for step, turn in reversed(changes):
            factors.append((step * way).sum() / (step * turn).sum())
            way -= factors[-1] * turn
        step, turn = changes[-1] if changes else (slope, slope / (2.0 * GOAL_WEIGHT / STEPS))
        way *= abs((step * turn).sum()) / (turn * turn).sum()
        for (step, turn), factor in zip(changes, reversed(factors), strict=True):
            way += (factor - (turn * way).sum() / (step * turn).sum()) * step
        part = 1.0
        while part > 1e-6:
            there = here - part * way
            next_value, next_slope = of(there)
            calls += 1
            if next_value <= value - 1e-4 * part * (way * slope).sum():
                break
            part *= 0.5
        else:
            break
        if ((there - here) * (next_slope - slope)).sum() > 0:
            changes = [*changes[-9:], (there - here, next_slope - slope)]
        here, value, slope = there, next_value, next_slope
    return value, calls


def main() -> None:
    """Prints the three tasks."""
    bounce()
    launch()
    began = time.process_time()
    loss, calls = descend(push, np.full((STEPS, 2), 3.0))
    seconds = time.process_time() - began
    print(f"task 3: least loss {loss:.6f} after {calls} runs, {seconds:.1f} s of processor time")
    for name, theirs in TASK_3.items():
        print(f"{name:>34} {theirs:.6f}")


if __name__ == "__main__":
    main()
