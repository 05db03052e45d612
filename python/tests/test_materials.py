"""Materials, pairs of them, and laws of restitution: in scene files, in Python, in worlds."""

import pickle

import pytest

import carom

BILLIARD = """
name = "billiard"
[materials.steel]
density = "7.8 g/cm^3"
restitution = 0.95
[materials.rubber]
restitution_law = { power-law = { restitution = 0.9, speed = "1 m/s" } }
[[material_pairs]]
materials = ["steel", "felt"]
restitution = 0.3
[[material_pairs]]
materials = ["steel", "steel"]
restitution_law = { viscoelastic = { speed = "1e5 km/s" } }
[materials.felt]
friction = 0.2
[[spheres]]
position = [0.0, 1.0, 0.0]
radius = 0.0285
material = "steel"
[[colliders]]
shape = "half-space"
material = "felt"
"""


def dropped() -> carom.Scene:
    """A ball of steel above a floor of felt."""
    return carom.Scene(
        name="drop",
        forces=[carom.Gravity((0, -10, 0))],
        spheres=[carom.Sphere(position=(0, 5.5, 0), radius=0.5, material="steel")],
        colliders=[carom.Collider(carom.HalfSpace(), material="felt")],
        materials={
            "steel": carom.Material(restitution=0.9, density=7800),
            "felt": carom.Material(),
        },
        material_pairs=[carom.MaterialPair(["steel", "felt"], restitution=0.25)],
    )


def test_a_scene_with_materials_is_the_same_after_it_was_written_and_read() -> None:
    scene = carom.Scene.from_toml(BILLIARD)
    assert scene.spheres[0].material == "steel"
    assert scene.materials["rubber"].restitution_law == carom.PowerLaw(1.0, 0.9)
    assert scene.material_pairs[1].restitution_law == carom.Viscoelastic(1e8)
    assert carom.Scene.from_toml(scene.to_toml()) == scene
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_a_change_of_a_material_reaches_its_bodies() -> None:
    scene = carom.Scene.from_toml(BILLIARD)
    softer = scene.with_changes({"materials.steel.restitution": 0.5})
    assert [carom.World(it).restitutions[0] for it in (scene, softer)] == [0.95, 0.5]


def test_a_pair_of_materials_has_the_restitution_of_its_table() -> None:
    impact = dropped().run(seconds=1.2).impacts[0]
    ratio = impact["separation_speed"] / impact["approach_speed"]
    assert ratio == pytest.approx(0.25, rel=1e-12)


def test_a_ball_that_is_added_takes_the_fields_of_its_material() -> None:
    world = carom.World(dropped())
    world.add_sphere(carom.Sphere(position=(3, 5, 0), radius=0.5, material="steel"))
    assert world.restitutions[1] == 0.9
    assert world.masses[1] == world.masses[0]
    assert world.to_scene().material_pairs == dropped().material_pairs
    with pytest.raises(carom.CaromError, match="unknown material"):
        world.add_sphere(carom.Sphere(position=(6, 5, 0), radius=0.5, material="stel"))


def test_a_law_gives_the_restitution_at_the_speed_of_an_impact() -> None:
    # 10 m/s is 16 times the speed, and 16 to the power of -1/4 is 1/2.
    law = carom.PowerLaw(0.625)
    ball = carom.Sphere(position=(0, 5.5, 0), radius=0.5, restitution_law=law)
    forces, floor = [carom.Gravity((0, -10, 0))], carom.Collider(carom.HalfSpace())
    scene = carom.Scene(name="law", forces=forces, spheres=[ball], colliders=[floor])
    impact = scene.run(seconds=1.1).impacts[0]
    ratio = impact["separation_speed"] / impact["approach_speed"]
    assert ratio == pytest.approx(0.5, rel=1e-12)


def test_spheres_of_a_pair_with_a_non_additivity_meet_nearer_or_farther_than_their_radii() -> None:
    def met(non_additivity: float) -> float:
        pair = carom.MaterialPair(("a", "b"), non_additivity=non_additivity)
        scene = carom.Scene(
            name="pair",
            materials={"a": carom.Material(), "b": carom.Material()},
            material_pairs=[pair],
            spheres=[
                carom.Sphere(radius=1.0, material="a"),
                carom.Sphere(radius=1.0, position=(20, 0, 0), velocity=(-1, 0, 0), material="b"),
            ],
        )
        assert list(carom.Scene.from_toml(scene.to_toml()).material_pairs) == [pair]
        return float(scene.run(seconds=22).impacts["time"][0])

    for non_additivity in (-0.5, 0.0, 2.0):
        assert met(non_additivity) == pytest.approx(20 - 2 * (1 + non_additivity), rel=1e-12)
    with pytest.raises(carom.CaromError, match=r"MaterialPair\.non_additivity"):
        carom.MaterialPair(("a", "b"), non_additivity=-1.0)


def test_wrong_values_are_refused_by_their_names() -> None:
    with pytest.raises(carom.CaromError, match=r"MaterialPair\.restitution"):
        carom.MaterialPair(("a", "b"), restitution=2.0)
    with pytest.raises(TypeError, match=r"MaterialPair\.materials"):
        carom.MaterialPair("steel")
    with pytest.raises(TypeError, match=r"Scene\.materials: must be a mapping of names"):
        carom.Scene(name="x", materials=[carom.Material()])  # type: ignore[arg-type]
    with pytest.raises(TypeError, match=r"Scene\.materials\['felt'\]: must be a carom\.Material"):
        carom.Scene(name="x", materials={"felt": 0.3})  # type: ignore[dict-item]


def test_pairs_of_a_running_world_are_read_and_changed() -> None:
    world = dropped().world()
    assert world.material_pairs == (carom.MaterialPair(("steel", "felt"), restitution=0.25),)
    pair = carom.MaterialPair(("felt", "steel"), restitution=0.5, friction=0.25)
    world.material_pairs = [pair]
    assert world.material_pairs == (pair,)
    assert world.to_scene().material_pairs == (pair,)
    # 5 m in 1 s; a rounding of the time of impact.
    world.step(dt=1.5)
    assert world.impacts["separation_speed"][0] == pytest.approx(5.0, rel=1e-14)
    with pytest.raises(carom.SceneError, match=r"material_pairs\[0\]\.materials"):
        world.material_pairs = [carom.MaterialPair(("felt", "cork"))]
    with pytest.raises(TypeError, match=r"material_pairs\[0\]"):
        world.material_pairs = ["felt"]  # type: ignore[list-item]
    assert world.material_pairs == (pair,)
    world.material_pairs = ()
    assert world.material_pairs == ()


def test_the_stress_meter_counts_impacts_at_the_distance_of_a_pair_with_a_non_additivity() -> None:
    for non_additivity in (-0.5, 0.0, 1.0):
        scene = carom.Scene(
            name="pair",
            simulation=carom.Simulation(boundary=carom.Periodic([20.0] * 3)),
            materials={"a": carom.Material(), "b": carom.Material()},
            material_pairs=[carom.MaterialPair(("a", "b"), non_additivity=non_additivity)],
            spheres=[
                carom.Sphere(radius=1.0, position=(-6, 0, 0), velocity=(1, 0, 0), material="a"),
                carom.Sphere(radius=1.0, position=(6, 0, 0), velocity=(-1, 0, 0), material="b"),
            ],
        )
        meter = carom.StressMeter(scene.world())
        meter.step(dt=8.0)
        # One impact of 2 N s, the centres being as far apart as the pair says.
        virial = float(meter.stress().collisional[0, 0]) * 8000.0 * 8.0
        assert virial == pytest.approx(2.0 * 2.0 * (1.0 + non_additivity), rel=1e-12)
