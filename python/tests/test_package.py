"""What `import carom` brings, and what it leaves alone."""

import importlib.metadata
import subprocess
import sys
from pathlib import Path

import pytest

import carom

MAKE = "gymnasium.make('carom/Maze-v0').reset(seed=0); "


def answer(program: str) -> str:
    """What a program prints in a process of its own, without a word of warning."""
    command = [sys.executable, "-W", "error", "-c", program]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return done.stdout


def test_the_version_is_that_of_the_installed_package() -> None:
    assert carom.__version__ == importlib.metadata.version("carom")
    assert "__version__" in carom.__all__
    assert all(hasattr(carom, name) for name in carom.__all__)
    with pytest.raises(AttributeError, match="'carom' has no attribute 'versoin'"):
        carom.versoin  # type: ignore[attr-defined] # noqa: B018


def test_importing_carom_imports_nothing_large() -> None:
    large = ["gymnasium", "pandas", "xarray", "distributed", "carom.gym"]
    found = answer(f"import carom, sys; print([it for it in {large} if it in sys.modules])")
    assert found == "[]\n"


@pytest.mark.parametrize(
    "imports",
    [
        "import carom, gymnasium",
        "import gymnasium, carom",
        "import carom.gym, gymnasium",
        "import gymnasium, carom.gym",
        "import carom, importlib.util; importlib.util.find_spec('gymnasium'); import gymnasium",
        "import carom; from gymnasium.vector import VectorEnv; import gymnasium",
        "import carom, importlib; importlib.reload(carom); import gymnasium",
    ],
)
def test_gymnasium_makes_the_maze_whatever_is_imported_first(imports: str) -> None:
    pytest.importorskip("gymnasium")
    seen = "print([it for it in map(type, sys.meta_path) if 'carom' in it.__module__])"
    loader = "print(type(gymnasium.__loader__) is type(gymnasium.__spec__.loader), end=' '); "
    assert answer(f"{imports}; {MAKE}{loader}import sys; {seen}") == "True []\n"


def test_gymnasium_that_is_not_installed_is_missed_as_without_carom(tmp_path: Path) -> None:
    # In the place of Gymnasium, nothing.
    hide = (
        "import importlib.machinery as m, sys; "
        "find = m.PathFinder.find_spec; "
        "m.PathFinder.find_spec = classmethod("
        "lambda kind, name, *rest: None if name == 'gymnasium' else find(name, *rest)); "
    )
    program = hide + (
        "import carom\n"
        "try:\n"
        "    import gymnasium\n"
        "except ModuleNotFoundError as error:\n"
        "    print(error)\n"
        "try:\n"
        "    import carom.gym\n"
        "except ModuleNotFoundError as error:\n"
        "    print(error)\n"
    )
    assert answer(program).splitlines() == [
        "No module named 'gymnasium'",
        "carom.gym needs Gymnasium: pip install 'carom[gym]'",
    ]


def test_a_gymnasium_without_a_registry_is_imported_all_the_same(tmp_path: Path) -> None:
    (tmp_path / "gymnasium.py").write_text("flavour = 'other'\n", encoding="utf-8")
    for imports in ["import carom, gymnasium", "import gymnasium, carom"]:
        program = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); {imports}; "
        assert answer(f"{program}print(gymnasium.flavour)") == "other\n"
