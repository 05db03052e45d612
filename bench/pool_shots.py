"""Ten shots on a table without pockets, event by event beside pooltool.

``python bench/pool_shots.py`` needs pooltool-billiards 0.6; without its viewer, ``panda3d`` of
PyPI will do (``pip install --no-deps``). Both have the same balls, cloth and table: sliding,
rolling and spinning friction, balls with restitution 0.95 and friction 0.05, and cushions with
restitution 0.85 and friction 0.2 at the height of the nose, in pooltool as an impulse
(``impulse_frictional_inelastic``) or by its default (Stronge). After impacts pooltool sets
vertical velocities to zero. Here spin about a level axis throws balls up, cushions press them
down, and the cloth answers with its own friction.

The columns: events alike from the first on, of all of pooltool and of ours; their largest
difference of time up to the first cushion, and after it [s]; the largest distance of a ball at
the end [m]. The last lines are processor times of a break.
"""

import math
import time
from dataclasses import dataclass, field

import attrs
import numpy as np
import pooltool
from pooltool.events import EventType
from pooltool.physics.engine import PhysicsEngine
from pooltool.physics.resolve.ball_ball.friction import AverageBallBallFriction
from pooltool.physics.resolve.ball_ball.frictional_inelastic import FrictionalInelastic
from pooltool.physics.resolve.ball_cushion.impulse_frictional_inelastic.model import (
    ImpulseFrictionalInelasticLinear,
)
from pooltool.physics.resolve.resolver import default_resolver

import carom

R, MASS, G = 0.028575, 0.170097, 9.81
WIDTH, LENGTH, NOSE = 0.9906, 1.9812, 0.036576
"""Of the table between the noses, and height of the noses [m]."""
BALL, CUSHION, SLIDE, ROLL, SPIN = (0.95, 0.05), (0.85, 0.2), 0.2, 0.01, 4 / 9 * R
"""Restitution and friction of balls and cushions; frictions of the cloth as pooltool has them."""
SPACING = 1e-4
"""Gap between the balls of a rack [m]."""


@dataclass
class Shot:
    """A cue ball, other balls, and a strike: speed, azimuth [deg], offset to the left and up."""

    name: str
    balls: list[tuple[float, float]]
    speed: float
    azimuth: float
    offset: tuple[float, float] = (0.0, 0.0)
    elevation: float = 0.0


@dataclass
class Run:
    """Events as (time, what) in the order of time, places of balls at the end, processor time."""

    events: list[tuple[float, str]] = field(default_factory=list)
    places: np.ndarray = field(default_factory=lambda: np.empty((0, 2)))
    seconds: float = 0.0


def rack() -> list[tuple[float, float]]:
    """Returns a cue ball behind the head string, and nine balls about the foot spot."""
    step = 2 * R + SPACING
    rows = [(0, 1), (1, 2), (2, 3), (3, 2), (4, 1)]
    balls = [
        (WIDTH / 2 + (i - (n - 1) / 2) * step, 0.75 * LENGTH + row * step * math.sqrt(0.75))
        for row, n in rows
        for i in range(n)
    ]
    return [(WIDTH / 2 - 0.05, 0.25 * LENGTH), *balls]


def shots() -> list[Shot]:
    """Returns the ten shots."""
    cue, ahead = (0.45, 0.5), (0.45, 1.1)
    aside = math.degrees(math.atan2(0.6, 0.027))
    return [
        Shot("stop", [cue, ahead], 2.0, 90.0, (0.0, -0.12)),
        Shot("follow", [cue, ahead], 2.0, 90.0, (0.0, 0.4)),
        Shot("draw", [cue, ahead], 3.0, 90.0, (0.0, -0.45)),
        Shot("cut by 28 degrees", [cue, ahead], 2.0, aside),
        Shot("cut with side spin", [cue, ahead], 2.0, aside, (0.3, 0.0)),
        Shot("bank of the ball", [(0.3, 0.5), (0.45, 0.9)], 2.5, 69.0),
        Shot("one cushion, running side", [cue], 2.0, 30.0, (-0.4, 0.0)),
        Shot("three cushions", [(0.2, 0.3)], 3.0, 52.0),
        Shot("massé", [cue], 2.0, 90.0, (0.4, 0.0), 20.0),
        Shot("break", rack(), 8.0, math.degrees(math.atan2(0.5 * LENGTH, 0.05))),
    ]


def table() -> pooltool.Table:
    """Returns a table of pooltool with four whole cushions and no pockets."""
    segments = pooltool.Table.default().cushion_segments
    kind = type(next(iter(segments.linear.values())))
    ends = [
        (0.0, 0.0, 0.0, LENGTH),
        (WIDTH, 0.0, WIDTH, LENGTH),
        (0.0, 0.0, WIDTH, 0.0),
        (0.0, LENGTH, WIDTH, LENGTH),
    ]
    linear = {
        str(i): kind(str(i), np.array([a, b, NOSE]), np.array([c, d, NOSE]))
        for i, (a, b, c, d) in enumerate(ends)
    }
    return pooltool.Table(
        cushion_segments=attrs.evolve(segments, linear=linear, circular={}),
        pockets={},
        table_type=pooltool.TableType.BILLIARD,
    )


def engine(cushion: str) -> PhysicsEngine:
    """Returns pooltool's engine with this model of cushions."""
    resolver = default_resolver()
    resolver.ball_ball = FrictionalInelastic(friction=AverageBallBallFriction())
    if cushion == "impulse":
        resolver.ball_linear_cushion = ImpulseFrictionalInelasticLinear()
    resolver.stick_ball.squirt_throttle = 0.0
    return PhysicsEngine(resolver=resolver)


def by_pooltool(shot: Shot, cushion: str) -> Run:
    """Returns the run of pooltool."""
    params = pooltool.BallParams(
        m=MASS,
        R=R,
        u_s=SLIDE,
        u_r=ROLL,
        u_sp_proportionality=4 / 9,
        u_b=BALL[1],
        e_b=BALL[0],
        e_c=CUSHION[0],
        f_c=CUSHION[1],
        g=G,
    )
    balls = {
        str(i): pooltool.Ball.create(str(i), xy=place, **attrs.asdict(params))
        for i, place in enumerate(shot.balls)
    }
    cue = pooltool.Cue(cue_ball_id="0")
    a, b = shot.offset
    cue.set_state(V0=shot.speed, phi=shot.azimuth, theta=shot.elevation, a=a, b=b)
    system = pooltool.System(cue=cue, table=table(), balls=balls)
    start = time.process_time()
    pooltool.simulate(system, engine=engine(cushion), inplace=True)
    run = Run(seconds=time.process_time() - start)
    for event in system.events:
        if event.event_type == EventType.BALL_BALL:
            run.events.append((event.time, "-".join(sorted(event.ids))))
        elif event.event_type == EventType.BALL_LINEAR_CUSHION:
            run.events.append((event.time, f"{event.ids[0]}|{event.ids[1]}"))
    run.places = np.array([ball.state.rvw[0][:2] for ball in system.balls.values()])
    return run


def scene(shot: Shot) -> carom.Scene:
    """Returns the shot as a scene; y of pooltool is -z."""
    own = math.sqrt(BALL[0])
    a, b = shot.offset
    strike = carom.Strike(shot.speed, shot.azimuth, shot.elevation, (-a, b))
    spheres = [
        carom.Sphere(
            position=(x, R, -y),
            radius=R,
            mass=MASS,
            restitution=own,
            friction=BALL[1],
            strike=strike if i == 0 else None,
        )
        for i, (x, y) in enumerate(shot.balls)
    ]
    # The geometric mean with the balls' friction is the friction of the contact. A ball with a
    # torque mu r N against rolling slows down by 5/7 mu g.
    cloth = carom.Collider(
        carom.HalfSpace(),
        restitution=0.0,
        friction=SLIDE**2 / BALL[1],
        rolling_friction=1.4 * ROLL,
        spinning_friction=SPIN,
    )
    # Pooltool's balls meet the vertical plane of the nose, ours the nose itself.
    inset = R - math.sqrt(R**2 - (NOSE - R) ** 2)
    width, length, thick = WIDTH - 2 * inset, LENGTH - 2 * inset, 0.1
    sides = [(-1, 0), (1, 0), (0, 1), (0, -1)]
    cushions = [
        carom.Collider(
            carom.Box((thick, 0.05, 3.0) if x else (3.0, 0.05, thick)),
            (
                WIDTH / 2 + x * (width + thick) / 2,
                NOSE + 0.025,
                -LENGTH / 2 + z * (length + thick) / 2,
            ),
            restitution=CUSHION[0] / own,
            friction=CUSHION[1] ** 2 / BALL[1],
        )
        for x, z in sides
    ]
    return carom.Scene(
        name="shot",
        forces=[carom.Gravity((0.0, -G, 0.0))],
        spheres=spheres,
        colliders=[cloth, *cushions],
    )


def by_carom(shot: Shot, until: float) -> Run:
    """Returns the run under `exact`."""
    world = scene(shot).world()
    run, tick = Run(), 1.0
    start = time.process_time()
    for _ in range(math.ceil(until / tick)):
        world.step(dt=tick)
        for impact in world.impacts:
            one, other = int(impact["sphere_1"]), int(impact["sphere_2"])
            collider = int(impact["collider"])
            if collider < 0:
                run.events.append((float(impact["time"]), f"{one}-{other}"))
            elif collider > 0:
                run.events.append((float(impact["time"]), f"{max(one, other)}|{collider - 1}"))
    run.seconds = time.process_time() - start
    run.places = np.array([(x, -z) for x, _, z in world.positions])
    return run


def compare(shot: Shot, cushion: str) -> str:
    """Returns a line that compares the events of a shot."""
    theirs = by_pooltool(shot, cushion)
    ours = by_carom(shot, 20.0)
    alike, before, after, at_cushion = 0, 0.0, 0.0, False
    for (their_time, their_event), (time_, event) in zip(theirs.events, ours.events, strict=False):
        if their_event != event:
            break
        alike += 1
        off = abs(time_ - their_time)
        if at_cushion:
            after = max(after, off)
        else:
            before = max(before, off)
        at_cushion |= "|" in event
    off = np.linalg.norm(theirs.places - ours.places, axis=1).max()
    counts = f"{alike:>3} of {len(theirs.events):>3}, {len(ours.events):>3}"
    return f"{shot.name:>26} {cushion:>8} {counts} {before:>9.1e} {after:>9.1e} {off:>9.1e}"


def main() -> None:
    """Prints the tables."""
    print(f"{'shot':>26} {'cushion':>8} {'alike':>12} {'before':>9} {'after':>9} {'places':>9}")
    for shot in shots():
        for cushion in ("impulse", "Stronge"):
            print(compare(shot, cushion), flush=True)
    breaking = shots()[-1]
    by_pooltool(breaking, "Stronge")
    theirs = [by_pooltool(breaking, "Stronge") for _ in range(5)]
    ours = [by_carom(breaking, 20.0) for _ in range(5)]
    for name, runs in (("pooltool", theirs), ("carom", ours)):
        seconds = sorted(run.seconds for run in runs)[2]
        print(f"break, {name}: {1e3 * seconds:.1f} ms, {len(runs[0].events)} impacts")


if __name__ == "__main__":
    main()
