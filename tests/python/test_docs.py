"""What the documentation shows is true: README and docstrings run."""

from __future__ import annotations

import doctest
import importlib
import os
import pkgutil
import re
from pathlib import Path

import pytest

import ballrace

README = Path(__file__).parents[2] / "README.md"
GUIDE = README.parent / "docs"
RECORDS = Path(os.environ.get("BALLRACE_CWRU") or README.parents[1] / "shared" / "data" / "cwru")
MODULES = [
    m.name
    for m in pkgutil.walk_packages(ballrace.__path__, "ballrace.")
    if m.name not in ("ballrace.__main__", "ballrace._core")
]
PAGES = sorted(GUIDE.glob("*.md"))


def run_blocks(page: Path, kinds: str) -> None:
    """Run the ```python blocks of a page in their order, in one namespace, of these kinds and of none."""
    text = page.read_text(encoding="utf-8")
    pattern = rf"^```python *(?:{kinds}) *\n(.*?)^```"
    blocks = list(re.finditer(pattern, text, flags=re.DOTALL | re.MULTILINE))
    assert blocks, f"{page.name} shows no Python"
    names: dict[str, object] = {"__name__": page.stem}
    for block in blocks:
        line = text.count("\n", 0, block.start(1))
        exec(compile("\n" * line + block[1], str(page), "exec"), names)


def test_readme_code_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """All but ```python no-run."""
    monkeypatch.chdir(tmp_path)
    run_blocks(README, "")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_guide_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Blocks that want a measured record run where it is."""
    monkeypatch.chdir(tmp_path)
    record = RECORDS / "105.mat"
    if record.is_file():
        (tmp_path / record.name).symlink_to(record)
        run_blocks(page, "|record")
    else:
        run_blocks(page, "")


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    module = importlib.import_module(name)
    assert doctest.testmod(module).failed == 0


def test_package_docstring() -> None:
    assert doctest.testmod(ballrace).failed == 0


def test_everything_public_has_a_docstring() -> None:
    for name in ballrace.__all__:
        assert getattr(ballrace, name).__doc__, name
