"""The examples of the guide run."""

import re
from pathlib import Path

import pytest

import carom

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize(
    "file", ["README.md", "docs/python.md", "docs/tutorial.md", "python/README.md"]
)
def test_the_examples_run_one_after_the_other(
    file: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("pandas")
    pytest.importorskip("xarray")
    monkeypatch.setattr(carom._library, "_registered", {})
    # For the files that they write.
    monkeypatch.chdir(tmp_path)
    text = (ROOT / file).read_text(encoding="utf-8")
    # Scene files that the reader writes on the way.
    for block, name in re.findall(r"```toml\n(# file: (\S+)\n.*?)```", text, re.DOTALL):
        (tmp_path / name).write_text(block, encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks
    names: dict[str, object] = {"carom": carom}
    for block in blocks:
        exec(block, names)
