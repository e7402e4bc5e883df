"""What the documentation shows is true: the blocks of README and guide run, and so do docstrings.

Blocks of a page run in their order in one empty folder: ``python`` in one namespace, ``sh`` in a shell that knows
``ballrace``. ``toml`` whose first line is a comment with a file's name becomes that file. ``rust`` has to be an
example of the crate's own documentation, which cargo runs. A second word says what a block is instead: ``no-run``,
or ``record`` where it wants a measured record. ``text output`` is what the block before it prints: words as they
stand, numbers within 5 %.
"""

from __future__ import annotations

import ast
import contextlib
import doctest
import importlib
import io
import math
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
import ballrace.cli

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs"
SKILL = Path(ballrace.cli.__file__).with_name("skill.md")
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
    for page in [ROOT / "README.md", SKILL, *sorted(GUIDE.glob("*.md"))]
    if any(block.language in ("python", "sh", "toml") for block in blocks(page))
]


def run_toml(text: str) -> None:
    """Have a document be one, and write it where its first line has a name for it."""
    tomllib.loads(text)
    if name := re.match(r"# (\S+\.toml)", text):
        Path(name[1]).write_text(text, encoding="utf-8")


def run_shell(text: str) -> str:
    done = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", SHELL + text],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, f"{text}{done.stdout}{done.stderr}"
    return done.stdout


def is_output(shown: str, printed: str) -> bool:
    """Whether a page shows what was printed: words as they stand, numbers within 5 %, all blanks alike."""
    number = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
    words = [" ".join(number.sub("#", text).split()) for text in (shown, printed)]
    numbers = [[float(each) for each in number.findall(text)] for text in (shown, printed)]
    return words[0] == words[1] and all(
        math.isclose(one, other, rel_tol=0.05) for one, other in zip(*numbers, strict=True)
    )


def test_another_output_is_seen() -> None:
    assert is_output("load 101 N,\n  2 balls", "load 100.0 N, 2 balls\n")
    assert not is_output("load 110 N", "load 100 N")
    assert not is_output("load 100 N", "loads 100 N")


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
    printed = ""
    for block in blocks(page):
        if block.kind == "output":
            assert is_output(block.text, printed), f"{page.name}:{block.line}: {printed}"
        elif block.kind not in kinds:
            assert block.kind in ("record", "no-run"), block
        elif block.language == "python":
            with contextlib.redirect_stdout(io.StringIO()) as out:
                exec(compile("\n" * block.line + block.text, str(page), "exec"), names)
            printed = out.getvalue()
        elif block.language == "sh":
            printed = run_shell(block.text)
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


DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
SUBJECTLESS = re.compile(
    r"(its?|their|they|th(is|at|ese|ose)|ones?|none|some|such|another|others?|wh(at|ich|ose|ere|en|o)|so|there"
    r"|about|above|across|after|along|among|around|as|at|before|behind|below|beside|between|beyond|by|during|for"
    r"|from|in(side|to)?|near|of|off|on|out|over|since|through|to(wards?)?|under|until|up|with(in|out)?"
    r"|(how|whether)( \w+)? (it|they))\b",
    re.IGNORECASE,
)
"""How a line begins that cannot be understood without what it stands at."""


def first_lines() -> Iterator[tuple[str, str]]:
    """First lines of the documentation of Rust and Python, private items too, each with its place."""
    for path in sorted((ROOT / "src").rglob("*.rs")):
        before = ""
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            found = re.match(r"\s*(//[/!]) ?(.*)", line)
            mark = found[1] if found else ""
            if found and mark != before:
                yield f"{path.relative_to(ROOT)}:{number}", found[2]
            before = mark
    for path in sorted((ROOT / "python").rglob("*.py*")):
        if path.suffix not in (".py", ".pyi"):
            continue
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            for part in getattr(node, "body", ()) if isinstance(node, DOCUMENTED) else ():
                if isinstance(part, ast.Expr) and isinstance(part.value, ast.Constant):
                    text = str(part.value.value).strip()
                    yield f"{path.relative_to(ROOT)}:{part.lineno}", text.partition("\n")[0]


def test_first_lines_name_their_subject() -> None:
    """An editor shows that line alone; of two hundred one may begin with a pronoun, a preposition or "What"."""
    lines = list(first_lines())
    assert len(lines) > 6000
    anaphoric = [f"{place}: {line}" for place, line in lines if SUBJECTLESS.match(line)]
    assert len(anaphoric) <= len(lines) // 200, "\n".join(anaphoric)


@pytest.mark.parametrize("line", ["Of all slices.", "What it takes.", "How far it has turned."])
def test_a_line_without_a_subject_is_seen(line: str) -> None:
    assert SUBJECTLESS.match(line)
    assert not SUBJECTLESS.match("Load of all slices.")
    assert not SUBJECTLESS.match("Whether the ring has tilts.")
