"""Files of other programs: what Carom writes, ASE and the library of GSD read, and back.

MDAnalysis and OVITO read it, too, where they are installed. MDAnalysis reads no dumps of LAMMPS
that name the time.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ase.io
import gsd.hoomd
import numpy as np
import pytest
from command import carom_command

import carom

PRECISIONS = ["single", "double"] if sys.version_info >= (3, 11) else ["single"]
"""Those that the library of GSD writes: the last one for CPython 3.10 knows one."""

ENDINGS = ["xyz", "extxyz", "lammpstrj", "dump", "gsd"]
SIDES = (3.0, 3.3, 4.0)


def spinning() -> carom.Trajectory:
    """Two rough spheres of two sizes that collide in a periodic box."""
    spheres = [
        carom.Sphere(position=(-0.7, 0.1, 0), radius=0.3, velocity=(3, 0, 0.1), friction=0.5),
        carom.Sphere(position=(0.9, 0, 0), radius=0.2, velocity=(-1, 0, 0), friction=0.5, mass=0.3),
    ]
    box = carom.Simulation(boundary=carom.Periodic(SIDES), frame_time=0.05)
    return carom.Scene(name="two", spheres=spheres, simulation=box).run(frames=20)


def sheared() -> carom.Trajectory:
    """Two spheres in a box whose images slide by more than half a side."""
    spheres = [
        carom.Sphere(position=(-0.7, 1.3, 0), radius=0.3, velocity=(1, 2, 0.1)),
        carom.Sphere(position=(0.9, 0, 0), radius=0.2, velocity=(-1, 0, 0), mass=0.3),
    ]
    box = carom.Simulation(boundary=carom.Periodic(SIDES, shear_rate=0.7), frame_time=0.05)
    run = carom.Scene(name="sheared", spheres=spheres, simulation=box).run(frames=20)
    assert run.slides is not None
    assert run.slides.min() < -0.1
    assert run.slides.max() > 1.3
    return run


def same(one: carom.Trajectory, other: carom.Trajectory) -> None:
    """Checks that two runs have the same states to the bit."""
    for name in ("time", "ids", "radii", "masses", "positions", "velocities"):
        np.testing.assert_array_equal(getattr(one, name), getattr(other, name), name)
    for name in ("orientations", "angular_velocities", "box", "slides"):
        mine, its = getattr(one, name), getattr(other, name)
        assert (mine is None) == (its is None), name
        if mine is not None:
            np.testing.assert_array_equal(mine, its, name)


@pytest.mark.parametrize("ending", [*ENDINGS, "npz"])
def test_a_run_comes_back_to_the_bit(ending: str, tmp_path: Path) -> None:
    run = spinning()
    assert run.angular_velocities is not None
    assert np.abs(run.angular_velocities[-1]).max() > 0.1
    run.save(tmp_path / f"run.{ending}")
    same(carom.Trajectory.load(tmp_path / f"run.{ending}"), run)


@pytest.mark.parametrize("ending", [*ENDINGS, "npz"])
def test_a_sheared_run_comes_back_to_the_bit(ending: str, tmp_path: Path) -> None:
    run = sheared()
    run.save(tmp_path / f"run.{ending}")
    again = carom.Trajectory.load(tmp_path / f"run.{ending}")
    same(again, run)
    assert run.slides is not None
    # The speed of the box above is 0.7 / s times 3.3 m.
    way = 0.7 * SIDES[1] * run.time
    np.testing.assert_allclose(run.slides, way - np.round(way / 3) * 3, atol=1e-15)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_scene_does_not_begin_with_boxes_that_have_slid(ending: str, tmp_path: Path) -> None:
    run = sheared()
    run.save(tmp_path / f"run.{ending}")
    with pytest.raises(carom.SceneError, match="begins with aligned boxes"):
        carom.Scene.from_particles(tmp_path / f"run.{ending}")
    scene = carom.Scene.from_particles(tmp_path / f"run.{ending}", frame=0)
    np.testing.assert_array_equal(scene.world().positions, run.positions[0])


def test_analysis_of_a_sheared_run_asks_for_a_box() -> None:
    run = sheared()
    with pytest.raises(carom.CaromError, match=r"^box: must be given"):
        carom.analysis.radial_distribution(run, r_max=1.0)
    carom.analysis.radial_distribution(run, [np.inf] * 3, r_max=1.0, volume=39.6)


@pytest.mark.parametrize("ending", ENDINGS)
def test_spheres_come_and_go_in_files_of_other_programs(ending: str, tmp_path: Path) -> None:
    run = carom.load("simtest3").run(seconds=1)
    assert np.isnan(run.positions).any()
    run.save(tmp_path / f"run.{ending}")
    again = carom.Trajectory.load(tmp_path / f"run.{ending}")
    same(again, run)
    assert again.box is None


@pytest.mark.parametrize("ending", [*ENDINGS, "npz"])
def test_the_command_writes_what_python_reads(ending: str, tmp_path: Path) -> None:
    scene, path = tmp_path / "two.toml", tmp_path / f"run.{ending}"
    size = "[simulation]\nframe_time = 0.1\nboundary = { periodic = { size = [3, 3.3, inf] } }\n"
    scene.write_text(f"{size}[[spheres]]\nradius = 0.3\nvelocity = [3, 2, 1]\n")
    carom_command("run", str(scene), "--frames", "20", "--every", "2", "--out", str(path))
    run = carom.Trajectory.load(path)
    whole = carom.Scene.from_file(scene).run(frames=20, every=2)
    np.testing.assert_array_equal(run.time, whole.time[1:])
    np.testing.assert_array_equal(run.positions, whole.positions[1:])
    assert run.box is not None
    assert run.box.tolist() == [3.0, 3.3, np.inf]


@pytest.mark.parametrize("ending", [*ENDINGS, "npz"])
def test_the_command_writes_how_far_boxes_slid(ending: str, tmp_path: Path) -> None:
    scene, path = tmp_path / "two.toml", tmp_path / f"run.{ending}"
    box = "size = [3, 3.3, inf], shear_rate = 0.7"
    scene.write_text(
        f"[simulation]\nframe_time = 0.1\nboundary = {{ periodic = {{ {box} }} }}\n"
        "[[spheres]]\nradius = 0.3\nvelocity = [3, 2, 1]\n"
    )
    carom_command("run", str(scene), "--frames", "10", "--out", str(path))
    run = carom.Trajectory.load(path)
    whole = carom.Scene.from_file(scene).run(frames=10)
    assert run.slides is not None
    assert whole.slides is not None
    np.testing.assert_array_equal(run.slides, whole.slides[1:])
    np.testing.assert_array_equal(run.positions, whole.positions[1:])


def test_ase_reads_extended_xyz_with_box_and_times(tmp_path: Path) -> None:
    run = spinning()
    run.save(tmp_path / "run.xyz")
    frames = ase.io.read(tmp_path / "run.xyz", index=":")
    assert len(frames) == len(run)
    for row, frame in enumerate(frames):
        np.testing.assert_array_equal(frame.positions, run.positions[row])
        np.testing.assert_array_equal(frame.arrays["velo"], run.velocities[row])
        np.testing.assert_array_equal(frame.arrays["radius"], run.radii)
        assert frame.cell.lengths().tolist() == list(SIDES)
        assert frame.pbc.all()
        assert frame.info["Time"] == run.time[row]


def test_other_programs_see_how_far_boxes_slid(tmp_path: Path) -> None:
    run = sheared()
    assert run.slides is not None
    for ending in ("xyz", "lammpstrj", "gsd"):
        run.save(tmp_path / f"run.{ending}")
    frames: Any = ase.io.read(tmp_path / "run.xyz", index=":")
    path = tmp_path / "run.lammpstrj"
    dumps: Any = ase.io.read(path, index=":", format="lammps-dump-text")
    with gsd.hoomd.open(tmp_path / "run.gsd", "r") as boxes:
        for row, slide in enumerate(run.slides):
            cell = [[SIDES[0], 0, 0], [slide, SIDES[1], 0], [0, 0, SIDES[2]]]
            np.testing.assert_array_equal(frames[row].cell[...], cell)
            # ASE takes the sides from the bounds of the leaning box.
            np.testing.assert_allclose(dumps[row].cell[...], cell, atol=1e-14)
            np.testing.assert_array_equal(dumps[row].positions, run.positions[row])
            tilt = np.float32(slide / SIDES[1])
            assert boxes[row].configuration.box.tolist() == [*map(np.float32, SIDES), tilt, 0, 0]


def test_ase_reads_dumps_of_lammps(tmp_path: Path) -> None:
    run = spinning()
    run.save(tmp_path / "run.lammpstrj")
    frames = ase.io.read(tmp_path / "run.lammpstrj", index=":", format="lammps-dump-text")
    assert len(frames) == len(run)
    for row, frame in enumerate(frames):
        np.testing.assert_array_equal(frame.positions, run.positions[row])
        # ASE takes the sides from the corners.
        np.testing.assert_allclose(frame.cell.lengths(), SIDES, rtol=1e-15)
        assert frame.pbc.all()


def test_the_library_of_gsd_reads_the_schema_of_hoomd(tmp_path: Path) -> None:
    run = spinning()
    run.save(tmp_path / "run.gsd")
    with gsd.hoomd.open(tmp_path / "run.gsd", "r") as frames:
        assert len(frames) == len(run)
        for row, frame in enumerate(frames):
            # Single precision, as the schema has it.
            single = run.positions[row].astype(np.float32)
            np.testing.assert_array_equal(frame.particles.position, single)
            np.testing.assert_array_equal(frame.particles.diameter, np.float32(2 * run.radii))
            np.testing.assert_array_equal(frame.particles.mass, np.float32(run.masses))
            assert frame.configuration.box.tolist() == [*map(np.float32, SIDES), 0, 0, 0]
            assert frame.configuration.step == row
            assert frame.log["time"].tolist() == [run.time[row]]
            # To the bit, as logged quantities of each particle.
            np.testing.assert_array_equal(frame.log["particles/position"], run.positions[row])
            assert run.orientations is not None
            turned = np.roll(run.orientations[row], 1, axis=1)
            np.testing.assert_array_equal(frame.particles.orientation, np.float32(turned))


def frictionless() -> carom.Trajectory:
    """Spheres without rotations."""
    run = carom.load("cradle").run(frames=5)
    assert run.angular_velocities is None
    return run


def test_the_library_of_gsd_reads_every_frame_of_spheres_that_do_not_turn(tmp_path: Path) -> None:
    run = frictionless()
    run.save(tmp_path / "run.gsd")
    with gsd.hoomd.open(tmp_path / "run.gsd", "r") as frames:
        for row, frame in enumerate(frames):
            np.testing.assert_array_equal(frame.log["particles/position"], run.positions[row])


@pytest.mark.parametrize("make", [spinning, frictionless])
@pytest.mark.parametrize("ending", ["xyz", "gsd"])
def test_mdanalysis_reads_every_frame(
    ending: str, make: Callable[[], carom.Trajectory], tmp_path: Path
) -> None:
    analysis = pytest.importorskip("MDAnalysis")
    run = make()
    run.save(tmp_path / f"run.{ending}")
    universe = analysis.Universe(tmp_path / f"run.{ending}")
    assert len(universe.trajectory) == len(run)
    for row, step in enumerate(universe.trajectory):
        # It works in single precision.
        np.testing.assert_array_equal(step.positions, run.positions[row].astype(np.float32))
    if ending == "gsd" and run.box is not None:
        assert universe.dimensions.tolist() == [*map(np.float32, SIDES), 90, 90, 90]


@pytest.mark.parametrize("make", [spinning, frictionless])
@pytest.mark.parametrize("ending", ["xyz", "lammpstrj", "gsd"])
def test_ovito_reads_every_frame(
    ending: str,
    make: Callable[[], carom.Trajectory],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("OVITO_GUI_MODE", "0")
    ovito = pytest.importorskip("ovito.io")
    run = make()
    run.save(tmp_path / f"run.{ending}")
    pipeline = ovito.import_file(str(tmp_path / f"run.{ending}"))
    assert pipeline.num_frames == len(run)
    # GSD has single precision, and the last digit of text is not always rounded right.
    rtol, atol = (1e-7, 1e-9) if ending == "gsd" else (1e-15, 0.0)
    for row in range(len(run)):
        frame = pipeline.compute(row)
        particles = frame.particles
        for name, expected in [("Position", run.positions), ("Velocity", run.velocities)]:
            np.testing.assert_allclose(particles[name][...], expected[row], rtol, atol)
        # OVITO has radii in single precision.
        np.testing.assert_array_equal(particles["Radius"][...], run.radii.astype(np.float32))
        if run.box is not None:
            # It takes the sides from the corners.
            np.testing.assert_allclose(np.diag(frame.cell[...]), SIDES, rtol=1e-7)
            assert frame.cell.pbc == (True, True, True)
        if ending != "gsd":
            assert frame.attributes["Time"] == run.time[row]


def test_angular_momenta_of_gsd_are_those_of_hoomd(tmp_path: Path) -> None:
    path = tmp_path / "run.gsd"
    scene = "[simulation]\nframe_time = 0.1\n[[spheres]]\nradius = 0.5\nmass = 2\n"
    (tmp_path / "a.toml").write_text(f"{scene}angular_velocity = [1, 2, 3]\n")
    carom_command("run", str(tmp_path / "a.toml"), "--frames", "3", "--out", str(path))
    with gsd.hoomd.open(path, "r") as frames:
        particles = frames[-1].particles
    inertia = 0.4 * 2 * 0.25
    np.testing.assert_allclose(particles.moment_inertia[0], inertia, rtol=1e-7)
    # p = 2 q (0, L'), with L' the angular momentum along the axes of the body, so L = q L' q*.
    w, *v = particles.orientation[0].astype(float)
    p, *u = particles.angmom[0].astype(float)
    scalar = p * w + np.dot(u, v)
    momentum = 0.5 * (w * np.array(u) - p * np.array(v) + np.cross(v, u))
    assert scalar == pytest.approx(0, abs=1e-6)
    # Single precision has 1e-7.
    np.testing.assert_allclose(momentum, inertia * np.array([1, 2, 3]), rtol=2e-6)


@pytest.mark.parametrize("precision", PRECISIONS)
def test_what_the_library_of_gsd_writes_begins_a_scene(precision: str, tmp_path: Path) -> None:
    path = tmp_path / "hoomd.gsd"
    number = np.float32 if precision == "single" else np.float64
    options = {} if precision == "single" else {"precision": precision}
    with gsd.hoomd.open(path, "w", **options) as frames:
        for step in range(200):
            frame = gsd.hoomd.Frame()
            frame.configuration.step = 10 * step
            frame.configuration.box = [8, 8, 8, 0, 0, 0]
            frame.particles.N = 2
            frame.particles.position = [[-1, 0, 0], [1, 0.01 * step, 0]]
            frame.particles.velocity = [[0, 0, 0], [0, 1, 0]]
            frame.particles.diameter = [0.5, 0.75]
            frame.particles.mass = [1, 2]
            frame.particles.moment_inertia = [[0, 0, 0], [0.5] * 3]
            frame.particles.angmom = [[0, 0, 0, 0], [0, 0, 0, 2]]
            frames.append(frame)
    run = carom.Trajectory.load(path)
    assert run.positions.shape == (200, 2, 3)
    assert run.positions[-1, 1, 1] == number(0.01 * 199)
    assert run.radii.tolist() == [0.25, 0.375]
    assert run.angular_velocities is not None
    # p = 2 q (0, I ω) with q = 1.
    assert run.angular_velocities[0].tolist() == [[0, 0, 0], [0, 0, 2]]
    scene = carom.Scene.from_particles(path, frame=50)
    assert scene.spheres[1].position == (1, 0.5, 0)
    assert scene.simulation.boundary == carom.Periodic((8, 8, 8))
    scene.run(frames=2)


def test_what_ase_writes_begins_a_scene(tmp_path: Path) -> None:
    atoms = ase.Atoms("Ar2", positions=[[1, 1, 1], [3, 3, 3]], cell=[4, 4, 4], pbc=True)
    atoms.write(tmp_path / "ase.xyz")
    scene = carom.Scene.from_particles(tmp_path / "ase.xyz", radius=0.5)
    # The box of ASE begins at the origin, that of Carom has its middle there.
    assert [sphere.position for sphere in scene.spheres] == [(-1, -1, -1), (1, 1, 1)]
    run = carom.Trajectory.load(tmp_path / "ase.xyz", radius=0.5)
    assert run.time.tolist() == [0.0]
    assert run.masses.tolist() == [1.0, 1.0]


def test_scenes_begin_with_any_frame_of_a_run(tmp_path: Path) -> None:
    run = spinning()
    for ending in ENDINGS:
        run.save(tmp_path / f"run.{ending}")
        for frame in (None, 5):
            scene = carom.Scene.from_particles(tmp_path / f"run.{ending}", frame=frame)
            world = scene.world()
            row = len(run) - 1 if frame is None else frame
            np.testing.assert_array_equal(world.positions, run.positions[row])
            np.testing.assert_array_equal(world.velocities, run.velocities[row])
            assert run.angular_velocities is not None
            np.testing.assert_array_equal(world.angular_velocities, run.angular_velocities[row])


def test_files_that_make_no_sense_are_refused(tmp_path: Path) -> None:
    broken = tmp_path / "broken.xyz"
    broken.write_text("1\nProperties=species:S:1:pos:R:3:radius:R:1\nX 0 0 no 1\n")
    with pytest.raises(carom.CaromError, match=r"broken\.xyz:3: column 4 is no finite number"):
        carom.Trajectory.load(broken)
    with pytest.raises(carom.SceneError, match=r"broken\.xyz:3: "):
        carom.Scene.from_particles(broken)
    bare = tmp_path / "bare.xyz"
    bare.write_text("1\n\nX 0 0 0\n")
    with pytest.raises(carom.CaromError, match=r"^radius: ") as raised:
        carom.Trajectory.load(bare)
    assert raised.value.field == "radius"
    with pytest.raises(carom.CaromError, match=r"^frame: must be >= 0"):
        carom.Scene.from_particles(bare, frame=-1, radius=1)
    with pytest.raises(carom.SceneError, match=r"has no frame 3: its last whole frame is 0"):
        carom.Scene.from_particles(bare, frame=3, radius=1)
    with pytest.raises(FileNotFoundError):
        carom.Trajectory.load(tmp_path / "nowhere.gsd")
    with pytest.raises(OSError, match=r"run\.gsd"):
        spinning().save(tmp_path / "bare.xyz" / "run.gsd")
    positions = carom.load("simtest1").run(frames=2, quantities="velocities")
    with pytest.raises(carom.CaromError, match=r"^positions: were not recorded"):
        positions.save(tmp_path / "run.xyz")
