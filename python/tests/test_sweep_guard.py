"""A script that sweeps without a guard ends in one line that says so."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("distributed")
xarray = pytest.importorskip("xarray")
pandas = pytest.importorskip("pandas")


UNGUARDED = """
import carom, multiprocessing
def measure(world, a):
    return a
print("begin", flush=True)
{}
"""


@pytest.mark.parametrize("store", ["None", "'runs.sqlite'"])
def test_a_script_without_a_guard_ends_in_one_line(store: str, tmp_path: Path) -> None:
    call = f"carom.sweep('simtest1', {{'a': [1, 2]}}, measure=measure, store={store})"
    script = tmp_path / "script.py"
    script.write_text(UNGUARDED.format(call), encoding="utf-8")
    command = [sys.executable, str(script)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 1
    # Processes that print at one time may share a line.
    assert done.stdout.replace("begin", "").split() == []
    [line] = done.stderr.splitlines()
    assert line.startswith("carom.sweep: its worker processes import this script")
    assert 'if __name__ == "__main__":' in line


def test_a_script_can_catch_that_it_has_no_guard(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    call = (
        "try:\n"
        "    carom.sweep('simtest1', {'a': [1, 2]}, measure=measure)\n"
        "except carom.RunError as error:\n"
        "    print('caught', 'CAROM_SWEEP_MARK' in __import__('os').environ)\n"
    )
    script.write_text(UNGUARDED.format(call), encoding="utf-8")
    command = [sys.executable, str(script)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "caught False"
    assert done.stderr == ""


def test_a_sweep_in_this_process_needs_no_guard_beside_one_that_has_it(tmp_path: Path) -> None:
    script = tmp_path / "script.py"
    call = (
        "carom.sweep('simtest1', {'a': [1, 2]}, measure=measure, client='serial')\n"
        "if __name__ == '__main__':\n"
        "    print(len(carom.sweep('simtest1', {'a': [1, 2]}, measure=measure)))\n"
    )
    script.write_text(UNGUARDED.format(call), encoding="utf-8")
    command = [sys.executable, str(script)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[-1] == "2"
