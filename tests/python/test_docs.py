"""What the documentation shows is true: README and docstrings run."""

from __future__ import annotations

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import pytest

import ballrace

README = Path(__file__).parents[2] / "README.md"
MODULES = [
    m.name
    for m in pkgutil.walk_packages(ballrace.__path__, "ballrace.")
    if m.name not in ("ballrace.__main__", "ballrace._core")
]


def test_readme_code_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run the ```python blocks in their order, in one namespace; ```python no-run is left out."""
    monkeypatch.chdir(tmp_path)
    text = README.read_text(encoding="utf-8")
    blocks = list(re.finditer(r"^```python *\n(.*?)^```", text, flags=re.DOTALL | re.MULTILINE))
    assert blocks, "README.md shows no Python"
    names: dict[str, object] = {"__name__": "readme"}
    for block in blocks:
        line = text.count("\n", 0, block.start(1))
        exec(compile("\n" * line + block[1], str(README), "exec"), names)


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    module = importlib.import_module(name)
    assert doctest.testmod(module).failed == 0


def test_package_docstring() -> None:
    assert doctest.testmod(ballrace).failed == 0


def test_everything_public_has_a_docstring() -> None:
    for name in ballrace.__all__:
        assert getattr(ballrace, name).__doc__, name
