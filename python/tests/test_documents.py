"""Each example of the documents runs by itself, copied as it stands."""

import re
from pathlib import Path

import pytest

import carom

ROOT = Path(__file__).parents[2]
FILES = [ROOT / "README.md", ROOT / "python/README.md", *sorted((ROOT / "docs").glob("*.md"))]

NEEDED = ["anywidget", "gymnasium", "pandas", "xarray"]
"""What a block needs where it speaks of it, besides carom; without it the block is left out."""


def blocks_of(file: Path) -> list[str]:
    text = file.read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)


BLOCKS = [
    pytest.param(file, block, id=f"{file.relative_to(ROOT)}-{number}")
    for file in FILES
    for number, block in enumerate(blocks_of(file), 1)
]


@pytest.mark.parametrize(("file", "block"), BLOCKS)
def test_an_example_runs_by_itself(
    file: Path, block: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in NEEDED:
        if module in block:
            pytest.importorskip(module)
    monkeypatch.setattr(carom._scene.library, "_registered", {})
    # For the files that it writes.
    monkeypatch.chdir(tmp_path)
    text = file.read_text(encoding="utf-8")
    # Scene files that the reader of the document has written by then.
    for scene, name in re.findall(r"```toml\n(# file: (\S+)\n.*?)```", text, re.DOTALL):
        (tmp_path / name).write_text(scene, encoding="utf-8")
    exec(compile(block, f"{file.name}, block", "exec"), {"__name__": "__main__"})


def test_every_example_of_python_is_a_block_that_is_tested() -> None:
    for file in FILES:
        text = file.read_text(encoding="utf-8")
        marked = re.findall(r"^ *(?:```|~~~)+ *(?:python|py|pycon)\b", text, re.MULTILINE)
        assert len(marked) == len(blocks_of(file)), file
    tested = {str(file.relative_to(ROOT)) for file in FILES if blocks_of(file)}
    assert tested >= {"README.md", "docs/python.md", "docs/tutorial.md", "python/README.md"}
