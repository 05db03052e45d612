"""A copy of a world goes on as the world would have; what begins as it is now keeps its colours."""

import copy
from collections.abc import Callable
from dataclasses import replace

import pytest

import carom

RED, GREEN, BLUE = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


@pytest.mark.parametrize("rule", ["exact", "bisect", "discrete"])
@pytest.mark.parametrize("make", [copy.copy, copy.deepcopy])
def test_a_copy_goes_on_bit_for_bit_by_itself(
    rule: str, make: Callable[[carom.World], carom.World]
) -> None:
    # In the middle of flights, and with emitters at work.
    world = carom.load("simtest1", {"simulation.rule": rule}).world()
    world.step(dt=0.0137, frames=150)
    before = world.state_hash
    twin = make(world)
    assert (twin.state_hash, twin.time, len(twin)) == (before, world.time, len(world))
    assert (twin.forces, twin.colliders, twin.simulation) == (
        world.forces,
        world.colliders,
        world.simulation,
    )
    twin.step(frames=100)
    assert world.state_hash == before
    world.step(frames=100)
    assert world.state_hash == twin.state_hash
    assert twin.positions is not world.positions


def test_a_copy_of_a_world_with_more_to_it_has_that_too() -> None:
    class Named(carom.World):
        names: list[str]

    world = Named(carom.load("simtest2"))
    world.names = ["a"]
    twin = copy.deepcopy(world)
    assert isinstance(twin, Named)
    twin.names.append("b")
    assert world.names == ["a"] and twin.names == ["a", "b"]
    assert len(twin) == len(world)


def colors(world: carom.World) -> list[object]:
    """The colours of its spheres, by the scene that begins as it is now."""
    return [sphere.color for sphere in world.to_scene().spheres]


def test_spheres_keep_their_colours() -> None:
    row = carom.Row(2, (0, 0, 0), (1, 0, 0), carom.Sphere(radius=0.1, color=GREEN))
    scene = carom.Scene(
        name="colours",
        spheres=[carom.Sphere(position=(9, 0, 0), radius=0.1, color=RED)],
        generators=[row],
        emitters=[
            carom.Emitter(carom.Sphere(radius=0.1, color=BLUE), 1.0, position=(0, 9, 0)),
            carom.Emitter(carom.Sphere(radius=0.1), 0.75, position=(0, 5, 0)),
        ],
        colors=carom.Colors(spheres=BLUE),
    )
    world = scene.world()
    world.step(dt=0.5)
    assert colors(world) == [RED, GREEN, GREEN, BLUE, None]
    assert world.to_scene().colors == scene.colors
    added = world.add_sphere(carom.Sphere(position=(0, -5, 0), radius=0.1, color=GREEN))
    world.add_spheres([(0, -7, 0)], 0.1)
    world.set_sphere(0, replace(world.sphere(0), radius=0.2))
    world.remove_sphere(1)
    snapshot = world.snapshot()
    # The second emitter at 0.75 s, the first at 1 s.
    world.step(dt=0.6)
    now = [RED, GREEN, BLUE, None, GREEN, None, None, BLUE]
    assert colors(world) == now
    assert colors(copy.copy(world)) == now
    assert [world.sphere(id).color for id in world.ids.tolist()] == now
    world.restore(snapshot)
    assert colors(world) == now[:-2]
    world.set_sphere(added, carom.Sphere(position=(0, -5, 0), radius=0.1))
    assert colors(world)[4] is None


def test_spheres_of_emitters_of_code_have_the_colour_of_theirs() -> None:
    world = carom.World()
    # Not at the end of a frame of its own.
    world.step(dt=0.123)
    red = carom.Emitter(carom.Sphere(radius=0.1, color=RED), 1.0)
    green = carom.Emitter(carom.Sphere(radius=0.1, color=GREEN), 0.75, position=(0, 5, 0))
    first = world.add_emitter(red)
    second = world.add_emitter(green)
    # At 0 both, at 0.75 green, at 1 red.
    world.step(dt=1.2)
    assert colors(world) == [RED, GREEN, GREEN, RED]
    world.remove_emitter(second)
    world.set_emitter(first, replace(red, sphere=carom.Sphere(radius=0.1, color=BLUE)))
    world.step(dt=1.0)
    assert colors(world) == [RED, GREEN, GREEN, RED, BLUE]
