"""``python -m carom`` is the command ``carom``."""

import json
from pathlib import Path

import pytest
from command import carom_command

import carom


def test_a_scene_runs_to_the_same_state() -> None:
    summary = json.loads(carom_command("run", "simtest1", "--seconds", "2", "--json").stdout)
    world = carom.load("simtest1").world()
    world.run(seconds=2)
    assert world.state_hash in json.dumps(summary)


def test_mistakes_end_as_they_do_on_the_command_line() -> None:
    assert "did you mean" in carom_command("run", "simtst1", code=2).stderr
    assert "Usage" in carom_command("rum", code=2).stderr
    assert "Usage" in carom_command("--help").stdout


def test_scenes_of_other_packages_are_found(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "far_away.py").write_text("import carom\nlone = lambda: carom.Scene(name='x')\n")
    information = tmp_path / "far_away-1.0.dist-info"
    information.mkdir()
    (information / "METADATA").write_text("Metadata-Version: 2.1\nName: far-away\nVersion: 1.0\n")
    (information / "entry_points.txt").write_text("[carom.scenes]\nlone = far_away:lone\n")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert "lone" in carom_command("scenes").stdout
    assert 'name = "lone"' in carom_command("show", "lone").stdout
