"""Runs record what the command line records."""

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import carom_command
from interrupts import ctrl_c
from numpy.lib.format import open_memmap

import carom
from carom._run import recording
from carom._run.recording import Out


@pytest.mark.parametrize("name", ["simtest1", "simtest4", "tutorial4"])
def test_a_run_is_that_of_the_command_line(name: str, tmp_path: Path) -> None:
    states, impacts = tmp_path / "states.csv", tmp_path / "impacts.csv"
    files = ["--out", str(states), "--impacts", str(impacts)]
    carom_command("run", name, "--seconds", "5", *files)
    run = carom.load(name).run(seconds=5)

    rows = np.loadtxt(states, delimiter=",", skiprows=1)
    written = {(row[0], int(row[1])): row[2:] for row in rows}
    is_there = ~np.isnan(run.positions[1:, :, 0])
    assert is_there.sum() == len(rows)
    for frame, column in np.argwhere(is_there):
        row = written[run.time[1 + frame], int(run.ids[column])]
        assert row[:3].tolist() == run.positions[1 + frame, column].tolist()
        assert row[3:].tolist() == run.velocities[1 + frame, column].tolist()

    lines = [line.split(",") for line in impacts.read_text().splitlines()[1:]]
    assert len(lines) == len(run.impacts)
    for line, impact in zip(lines, run.impacts, strict=True):
        other = impact["collider" if line[1] == "collider" else "sphere_1"]
        assert (int(line[2]), int(line[3])) == (other, impact["sphere_2"])
        numbers = [impact["time"], *impact["point"], *impact["normal"]]
        numbers += [impact["approach_speed"], impact["impulse"], *impact["tangential_impulse"]]
        assert [float(text) for text in (line[0], *line[4:])] == numbers


def test_the_first_state_is_that_at_the_beginning() -> None:
    scene = carom.load("tutorial4")
    run = scene.run(frames=4, every=2)
    assert len(run) == 3
    np.testing.assert_array_equal(run.time, np.arange(3) * 2 * scene.simulation.frame_time)
    assert run.positions[0].tolist() == scene.world().positions.tolist()
    assert run.positions.flags.c_contiguous
    assert run.positions.dtype == np.float64


def test_a_run_goes_on_where_the_world_is() -> None:
    whole, halves = carom.load("simtest2").world(), carom.load("simtest2").world()
    all_of_it = whole.run(frames=100)
    first, second = halves.run(frames=50), halves.run(frames=50)
    assert whole.state_hash == halves.state_hash
    assert len(first.impacts) + len(second.impacts) == len(all_of_it.impacts)
    assert second.time[0] == first.time[-1]


def test_a_run_takes_the_duration_of_the_scene_unless_told() -> None:
    scene = carom.load("simtest1").with_changes({"simulation.duration": 0.5})
    assert scene.run().time[-1] == pytest.approx(0.5)


def test_tables_of_pandas() -> None:
    pandas = pytest.importorskip("pandas")
    run = carom.load("simtest1").run(seconds=3)
    table = run.to_pandas()
    assert list(table.columns) == ["t", "ball", "x", "y", "z", "vx", "vy", "vz"]
    assert len(table) == (~np.isnan(run.positions[:, :, 0])).sum()
    last = table[(table.t == run.time[-1]) & (table.ball == run.ids[0])]
    assert last[["x", "y", "z"]].to_numpy()[0].tolist() == run.positions[-1, 0].tolist()
    impacts = run.impacts_to_pandas()
    assert isinstance(impacts, pandas.DataFrame)
    assert impacts.normal_y.tolist() == run.impacts["normal"][:, 1].tolist()


def test_a_dataset_of_xarray() -> None:
    pytest.importorskip("xarray")
    run = carom.load("simtest1").run(seconds=3)
    data = run.to_xarray()
    assert dict(data.sizes) == {"time": len(run), "sphere": len(run.ids), "axis": 3}
    assert np.shares_memory(data.position.values, run.positions)
    assert data.velocity.attrs["units"] == "m/s"
    height = data.position.sel(axis="y", sphere=0).isel(time=-1)
    assert float(height) == run.positions[-1, 0, 1]


def test_a_run_records_what_is_asked_for() -> None:
    scene = carom.load("tutorial4")
    whole = scene.run(frames=5)
    run = scene.run(frames=5, quantities=["positions"], dtype="float32")
    assert run.positions.dtype == np.float32
    np.testing.assert_array_equal(run.positions, whole.positions.astype(np.float32))
    with pytest.raises(AttributeError, match="velocities were not recorded"):
        _ = run.velocities
    turned = scene.run(frames=1, quantities=["orientations"])
    assert turned.orientations is not None and turned.orientations.shape == (2, 147, 4)
    with pytest.raises(carom.CaromError, match=r"quantities: must be of .* not \"speeds\""):
        scene.run(frames=1, quantities=["speeds"])  # type: ignore[list-item]
    with pytest.raises(carom.CaromError, match="dtype: must be float64 or float32, not int64"):
        scene.run(frames=1, dtype=int)


@pytest.mark.parametrize("has_function", [False, True])
def test_chunks_of_impacts_are_those_of_the_run(has_function: bool) -> None:
    scene = carom.load("gas")
    one, other = scene.world(), scene.world()
    if has_function:
        for world in (one, other):
            world.add_force(lambda world: -0.1 * world.positions)
    whole = one.run(frames=30).impacts
    chunks = list(carom.impact_chunks(other, 30, size=100))
    assert len(chunks) > 2 and all(len(chunk) >= 100 for chunk in chunks[:-1])
    assert (np.concatenate(chunks) == whole).all()
    assert other.state_hash == one.state_hash
    assert list(carom.impact_chunks(other, 0)) == []
    for frames, size in [(-1, 1), (1, 0)]:
        with pytest.raises(carom.CaromError, match="must be"):
            carom.impact_chunks(other, frames, size=size)


def test_a_run_without_impacts_moves_the_same_and_keeps_none(tmp_path: Path) -> None:
    scene = carom.load("gas")
    whole, run = scene.run(frames=20), scene.run(frames=20, impacts=False)
    assert len(whole.impacts) > 0
    assert not hasattr(run, "impacts") and "impacts" not in repr(run)
    assert (run.positions == whole.positions).all()
    positions = np.empty_like(whole.positions)
    into = scene.run(frames=20, out={"positions": positions}, impacts=False)
    assert not hasattr(into, "impacts") and (positions == whole.positions).all()
    world = scene.world()
    world.add_force(lambda world: 0 * world.positions)
    assert not hasattr(world.run(frames=2, impacts=False), "impacts")
    run.save(tmp_path / "run.npz")
    assert not hasattr(carom.Trajectory.load(tmp_path / "run.npz"), "impacts")
    with pytest.raises(carom.CaromError, match=r"^impacts: were not recorded.*impacts=True"):
        carom.analysis.collision_frequency(run)
    with pytest.raises(carom.CaromError, match=r"^impacts: were not recorded.*impacts=True"):
        carom.analysis.virial_pressure(run, 1.0)


def test_a_run_of_no_frames_records_the_state_of_now() -> None:
    run = carom.load("cradle").run(frames=0, every=10)
    assert len(run) == 1 and len(run.impacts) == 0


@pytest.mark.parametrize("name", ["simtest4", "billiards"])
def test_a_trajectory_is_saved_and_loaded_to_the_bit(name: str, tmp_path: Path) -> None:
    run = carom.load(name).run(seconds=3)
    run.save(tmp_path / "run.npz")
    again = carom.Trajectory.load(tmp_path / "run.npz")
    for field in dataclasses.fields(carom.Trajectory):
        one, other = getattr(run, field.name), getattr(again, field.name)
        assert (one is None) == (other is None)
        if one is not None:
            assert one.dtype == other.dtype
            assert one.tobytes() == other.tobytes()


def test_a_trajectory_of_the_command_line_is_loaded(tmp_path: Path) -> None:
    path = tmp_path / "states.npz"
    carom_command("run", "simtest4", "--seconds", "3", "--out", str(path))
    again, run = carom.Trajectory.load(path), carom.load("simtest4").run(seconds=3)
    # The command writes the state after each frame, and not the start.
    np.testing.assert_array_equal(again.time, run.time[1:])
    np.testing.assert_array_equal(again.positions, run.positions[1:])
    np.testing.assert_array_equal(again.velocities, run.velocities[1:])
    np.testing.assert_array_equal(again.ids, run.ids)
    np.testing.assert_array_equal(again.radii, run.radii)
    np.testing.assert_array_equal(again.masses, run.masses)
    with pytest.raises(AttributeError, match="impacts were not recorded"):
        _ = again.impacts
    assert "impacts" not in repr(again)
    again.save(tmp_path / "again.npz")
    assert not hasattr(carom.Trajectory.load(tmp_path / "again.npz"), "impacts")
    with pytest.raises(carom.CaromError, match="impacts: were not recorded by the run"):
        carom.analysis.collision_frequency(again)


def test_the_arrays_of_a_saved_trajectory_are_those_of_the_command_line(tmp_path: Path) -> None:
    theirs, ours = tmp_path / "theirs.npz", tmp_path / "ours.npz"
    carom_command("run", "billiards", "--frames", "9", "--out", str(theirs))
    carom.load("billiards").run(frames=9).save(ours)
    with np.load(theirs) as one, np.load(ours) as other:
        assert set(one.files) | {"impacts", "sensor_events"} == set(other.files)
        for name in one.files:
            assert one[name].dtype == other[name].dtype
            # The start is in one of them.
            start = {"frame_start": 1, "time": 1, "id": 0, "radius": 0, "mass": 0}.get(name, 16)
            if name != "frame_start":
                np.testing.assert_array_equal(one[name], other[name][start:])


@pytest.mark.parametrize("ending", [".csv", ".glb", ""])
def test_a_trajectory_is_not_saved_under_the_ending_of_another_format(
    ending: str, tmp_path: Path
) -> None:
    path = tmp_path / f"run{ending}"
    with pytest.raises(carom.CaromError, match=r"^path: .* must end in \.npz, ") as raised:
        carom.load("cradle").run(frames=1).save(path)
    assert raised.value.field == "path"
    assert not path.exists()


def test_a_file_of_something_else_is_no_trajectory(tmp_path: Path) -> None:
    path = tmp_path / "other.npz"
    np.savez(path, a=np.zeros(3))
    with pytest.raises(carom.CaromError, match=r"other\.npz: no trajectory of carom"):
        carom.Trajectory.load(path)
    for text in (b"PK but no archive", b"t,ball,x"):
        path.write_bytes(text)
        with pytest.raises(carom.CaromError, match=r"no trajectory of carom: no \.npz file"):
            carom.Trajectory.load(path)
    with pytest.raises(FileNotFoundError):
        carom.Trajectory.load(tmp_path / "none.npz")


def test_a_run_is_recorded_into_arrays_of_a_file(tmp_path: Path) -> None:
    world, other = (carom.load("gas").world() for _ in range(2))
    shape = (7, len(world), 3)
    positions = open_memmap(tmp_path / "positions.npy", "w+", "f4", shape)
    velocities = np.empty(shape)
    out: Out = {"positions": positions, "velocities": velocities}
    run = world.run(frames=65, every=10, out=out)
    whole = other.run(frames=65, every=10)
    assert world.state_hash == other.state_hash
    assert (run.time == whole.time).all() and (run.impacts == whole.impacts).all()
    assert (velocities == whole.velocities).all()
    positions.flush()
    assert (np.load(tmp_path / "positions.npy") == whole.positions.astype("f4")).all()
    assert run.velocities.base is velocities or run.velocities is velocities


def test_many_blocks_are_one_run(monkeypatch: pytest.MonkeyPatch) -> None:
    world = carom.load("cradle").world()
    whole = carom.load("cradle").run(frames=20, every=3)
    monkeypatch.setattr(recording, "_BLOCK_BYTES", 1)
    positions = np.empty_like(whole.positions)
    run = world.run(frames=20, every=3, out={"positions": positions})
    assert (positions == whole.positions).all()
    assert (run.impacts == whole.impacts).all() and (run.time == whole.time).all()


@pytest.mark.parametrize(
    ("out", "words"),
    [
        ({}, "out: must have arrays"),
        ({"radii": np.empty((3, 5))}, "must be of positions"),
        ({"positions": np.empty((2, 5, 3))}, r"must have the shape \(3, 5, 3\), not \(2, 5, 3\)"),
        ({"positions": np.empty((3, 5, 3), int)}, "float64 or float32"),
    ],
)
def test_arrays_into_which_a_run_does_not_fit(out: Out, words: str) -> None:
    world = carom.load("tutorial1").world()
    before = world.state_hash
    with pytest.raises(carom.CaromError, match=words):
        world.run(frames=2, out=out)
    with pytest.raises(TypeError, match="goes without quantities"):
        world.run(frames=2, out=out, dtype="float32")
    assert world.state_hash == before


def test_arrays_without_names_are_no_place_for_a_run() -> None:
    with pytest.raises(TypeError, match="out: must be a dict of arrays by name, not ndarray"):
        carom.load("cradle").run(frames=2, out=np.empty((3, 15, 3)))  # type: ignore[arg-type]


def test_spheres_that_come_have_no_place_in_arrays() -> None:
    world = carom.load("simtest1").world()
    before = world.state_hash
    with pytest.raises(carom.CaromError, match="came or went"):
        world.run(frames=200, out={"positions": np.empty((201, len(world), 3))})
    assert world.state_hash == before


def test_ctrl_c_leaves_what_was_recorded_in_the_arrays(monkeypatch: pytest.MonkeyPatch) -> None:
    # In pieces of ten states: the one in which it is pressed may be lost.
    monkeypatch.setattr(recording, "_BLOCK_BYTES", 10 * 300 * 12)
    world = carom.load("gas").world()
    positions = np.full((100_001, len(world), 3), np.nan, "f4")
    with (
        pytest.raises(KeyboardInterrupt) as stop,
        ctrl_c(once=lambda: not np.isnan(positions[50]).any()),
    ):
        world.run(frames=100_000, dt=1e-3, out={"positions": positions})
    run = stop.value.trajectory  # type: ignore[attr-defined]
    assert 50 < len(run) < 100_000 and run.time[-1] == world.time
    assert not np.isnan(positions[: len(run)]).any() and np.isnan(positions[len(run) :]).all()


@pytest.mark.parametrize("number", [1, 2, 5])
@pytest.mark.parametrize("comes_after", [False, True])
def test_ctrl_c_between_two_pieces_of_a_run_leaves_whole_ones(
    monkeypatch: pytest.MonkeyPatch, number: int, comes_after: bool
) -> None:
    monkeypatch.setattr(recording, "_BLOCK_BYTES", 1)
    world, take = carom.load("gas").world(), carom.World._run
    pieces: list[carom.Trajectory] = []

    def interrupted(*arguments: Any) -> carom.Trajectory:
        # The first call records the beginning.
        is_last = len(pieces) == number
        if is_last and not comes_after:
            raise KeyboardInterrupt
        pieces.append(take(*arguments))
        if is_last:
            raise KeyboardInterrupt
        return pieces[-1]

    monkeypatch.setattr(carom.World, "_run", interrupted)
    positions = np.full((11, len(world), 3), np.nan)
    with pytest.raises(KeyboardInterrupt) as stop:
        world.run(frames=20, every=2, dt=1e-3, out={"positions": positions})
    run = stop.value.trajectory  # type: ignore[attr-defined]
    # The piece that was lost is taken back.
    assert len(run) == number and run.time[-1] == world.time
    assert run.positions[-1].tolist() == world.positions.tolist()
    assert not np.isnan(positions[: len(run)]).any() and np.isnan(positions[len(run) :]).all()
