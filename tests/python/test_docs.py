"""What the documentation shows is true: the blocks of README and guide run, and so do docstrings.

Blocks of a page run in their order in one empty folder: ``python`` in one namespace, ``sh`` in a shell that knows
``ballrace``. ``toml`` whose first line is a comment with a file's name becomes that file. ``rust`` has to be an
example of the crate's own documentation, which cargo runs. A second word says what a block is instead: ``no-run``,
or ``record`` where it wants a measured record.
"""

from __future__ import annotations

import doctest
import importlib
import os
import pkgutil
import re
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import ballrace

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs"
RECORDS = Path(os.environ.get("BALLRACE_CWRU") or ROOT.parent / "shared" / "data" / "cwru")
MODULES = [
    m.name
    for m in pkgutil.walk_packages(ballrace.__path__, "ballrace.")
    if m.name not in ("ballrace.__main__", "ballrace._core", "ballrace.explore.app")
]
BLOCK = re.compile(r"^```(\w+)(?: +([\w-]+))? *\n(.*?)^```", flags=re.DOTALL | re.MULTILINE)
SHELL = f'ballrace() {{ "{sys.executable}" -m ballrace "$@"; }}\n'


class Block(NamedTuple):
    """A block of code: its language, the word behind that, its text and the line before it."""

    language: str
    kind: str
    text: str
    line: int


def blocks(page: Path) -> Iterator[Block]:
    text = page.read_text(encoding="utf-8")
    for found in BLOCK.finditer(text):
        yield Block(found[1], found[2] or "", found[3], text.count("\n", 0, found.start(3)))


PAGES = [
    page
    for page in [ROOT / "README.md", *sorted(GUIDE.glob("*.md"))]
    if any(block.language in ("python", "sh", "toml") for block in blocks(page))
]


def run_toml(text: str) -> None:
    """Have a document be one, and write it where its first line has a name for it."""
    tomllib.loads(text)
    if name := re.match(r"# (\S+\.toml)", text):
        Path(name[1]).write_text(text, encoding="utf-8")


def run_shell(text: str) -> None:
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", SHELL + text],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{text}{done.stdout}{done.stderr}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_runs(page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    records = [RECORDS / "97.mat", RECORDS / "105.mat"]
    kinds = {""}
    if all(record.is_file() for record in records):
        for record in records:
            (tmp_path / record.name).symlink_to(record)
        kinds.add("record")
    names: dict[str, object] = {"__name__": page.stem}
    for block in blocks(page):
        if block.kind not in kinds:
            assert block.kind in ("record", "no-run"), block
        elif block.language == "python":
            exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
        elif block.language == "sh":
            run_shell(block.text)
        elif block.language == "toml":
            run_toml(block.text)


def rust_examples() -> Iterator[str]:
    """Return the examples of the crate's documentation, as rustdoc shows them."""
    for file in sorted((ROOT / "src").rglob("*.rs")):
        lines = file.read_text(encoding="utf-8").splitlines()
        docs = [re.sub(r"^\s*//[/!] ?", "", line) for line in lines if re.match(r"\s*//[/!]", line)]
        for example in re.findall(
            r"^```\n(.*?)^```", "\n".join(docs) + "\n", re.DOTALL | re.MULTILINE
        ):
            yield "".join(
                line for line in example.splitlines(keepends=True) if not re.match(r"#( |$)", line)
            )


def test_rust_is_that_of_the_crates_documentation() -> None:
    examples = list(rust_examples())
    shown = [block for page in [ROOT / "README.md", *GUIDE.glob("*.md")] for block in blocks(page)]
    rust = [block for block in shown if block.language == "rust"]
    assert rust
    for block in rust:
        assert any(block.text.strip() in example for example in examples), block.text


@pytest.mark.parametrize("name", MODULES)
def test_docstrings(name: str) -> None:
    module = importlib.import_module(name)
    assert doctest.testmod(module).failed == 0


def test_package_docstring() -> None:
    assert doctest.testmod(ballrace).failed == 0


def test_everything_public_has_a_docstring() -> None:
    for name in ballrace.__all__:
        assert getattr(ballrace, name).__doc__, name
