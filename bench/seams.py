"""Largest hop of a ball that slides over tiles and triangles, beside PyBullet.

``python bench/seams.py`` runs the same floor under Carom and PyBullet: a row of boxes side by side,
and the same plane cut into triangles. Nothing slows the ball, so it should keep its speed and its
height.
"""

from collections.abc import Callable

import numpy as np
import pybullet

import carom

RADIUS, TILE, COUNT, WIDTH = 0.1, 0.25, 60, 12
SECONDS, FRAME = 2.0, 1.0 / 240.0
START = np.array([-0.5, RADIUS, 0.013])
COLUMNS = "{:>10} {:>12} {:>9} {:>22} {:>22}"

Floor = tuple[list[list[float]], list[list[int]]]


def triangles() -> Floor:
    """Returns vertices [m] and triangles of the plane y = 0 in cells of the length of a tile."""
    edges = [TILE * (row - WIDTH / 2) for row in range(WIDTH + 1)]
    vertices = [[-1.125 + TILE * cell, 0.0, z] for cell in range(COUNT + 1) for z in edges]
    faces = []
    for cell in range(COUNT):
        for row in range(WIDTH):
            first = cell * (WIDTH + 1) + row
            second = first + WIDTH + 1
            faces += [[first, first + 1, second + 1], [first, second + 1, second]]
    return vertices, faces


def under_carom(kind: str, restitution: float, speed: float, rule: str) -> tuple[float, float]:
    """Returns the largest hop [m] and the change of the speed as a part of it."""
    if kind == "boxes":
        shape = carom.Box(size=(TILE, 0.1, WIDTH * TILE))
        tile = carom.Collider(shape=shape, restitution=restitution)
        floor = carom.Row(COUNT, start=(-1.0, -0.05, 0.0), step=(TILE, 0.0, 0.0), collider=tile)
        parts = {"generators": [floor]}
    else:
        vertices, faces = triangles()
        mesh = carom.Mesh(vertices=vertices, triangles=faces)
        parts = {"colliders": [carom.Collider(shape=mesh, restitution=restitution)]}
    ball = carom.Sphere(
        position=START, velocity=(speed, 0.0, 0.0), radius=RADIUS, restitution=restitution
    )
    scene = carom.Scene(
        name="seams",
        simulation=carom.Simulation(rule=rule, frame_time=FRAME),
        forces=[carom.Gravity((0.0, -9.81, 0.0))],
        spheres=[ball],
        **parts,
    )
    world = scene.world()
    hop = 0.0
    for _ in range(round(SECONDS / FRAME)):
        world.step()
        hop = max(hop, world.positions[0, 1] - RADIUS)
    return hop, world.velocities[0, 0] / speed - 1.0


def under_pybullet(kind: str, restitution: float, speed: float) -> tuple[float, float]:
    """Returns the largest hop [m] and the change of the speed as a part of it; there z is up."""
    pybullet.connect(pybullet.DIRECT)
    pybullet.setGravity(0.0, 0.0, -9.81)
    pybullet.setTimeStep(FRAME)
    smooth = {
        "restitution": restitution,
        "lateralFriction": 0.0,
        "rollingFriction": 0.0,
        "spinningFriction": 0.0,
        "linearDamping": 0.0,
        "angularDamping": 0.0,
    }
    if kind == "boxes":
        half = [TILE / 2, WIDTH * TILE / 2, 0.05]
        shape = pybullet.createCollisionShape(pybullet.GEOM_BOX, halfExtents=half)
        places = [[-1.0 + TILE * number, 0.0, -0.05] for number in range(COUNT)]
    else:
        vertices, faces = triangles()
        turned = [[x, -z, y] for x, y, z in vertices]
        shape = pybullet.createCollisionShape(
            pybullet.GEOM_MESH,
            vertices=turned,
            indices=[corner for face in faces for corner in face],
            flags=pybullet.GEOM_FORCE_CONCAVE_TRIMESH,
        )
        places = [[0.0, 0.0, 0.0]]
    for place in places:
        pybullet.changeDynamics(
            pybullet.createMultiBody(0, shape, basePosition=place), -1, **smooth
        )
    ball = pybullet.createMultiBody(
        1.0,
        pybullet.createCollisionShape(pybullet.GEOM_SPHERE, radius=RADIUS),
        basePosition=[START[0], -START[2], START[1]],
    )
    pybullet.changeDynamics(ball, -1, **smooth)
    pybullet.resetBaseVelocity(ball, [speed, 0.0, 0.0])
    hop = 0.0
    for _ in range(round(SECONDS / FRAME)):
        pybullet.stepSimulation()
        hop = max(hop, pybullet.getBasePositionAndOrientation(ball)[0][2] - RADIUS)
    (along, _, _), _ = pybullet.getBaseVelocity(ball)
    pybullet.disconnect()
    return hop, along / speed - 1.0


def main() -> None:
    """Prints a table of both."""
    engines: dict[str, Callable[[str, float, float], tuple[float, float]]] = {
        "exact": lambda *ball: under_carom(*ball, rule="exact"),
        "contact": lambda *ball: under_carom(*ball, rule="contact"),
        "pybullet": under_pybullet,
    }
    print(COLUMNS.format("floor", "restitution", "speed", "engine", "hop [m], speed gained"))
    for kind in ("boxes", "triangles"):
        for restitution in (0.0, 1.0):
            for speed in (0.5, 2.0, 5.0):
                for name, run in engines.items():
                    hop, gain = run(kind, restitution, speed)
                    print(COLUMNS.format(kind, restitution, speed, name, f"{hop:.1e} {gain:+.1e}"))


if __name__ == "__main__":
    main()
