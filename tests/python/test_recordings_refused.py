"""The page "My file is refused" lists every message that reading a file may end in."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import ballrace.recordings
from ballrace._base import units as _units
from ballrace.recordings import formats

ROOT = Path(__file__).parents[2]
READERS = Path(ballrace.recordings.__file__).parent
PAGE = " ".join((ROOT / "docs" / "refused.md").read_text(encoding="utf-8").split())

# What writes, and what checks arguments alone, whose messages say what is allowed.
OTHERS = (
    "columns.py",
    "dispatch.py",
    "folder.py",
    "reading.py",
    "recording.py",
    "windows.py",
    "writing.py",
)

# Functions that return what is wrong.
TELLING = (
    "_no_table",
    "_ambiguous",
    "broken_row",
    "_too_wide",
    "_ended",
    "_damaged",
    "other_ways",
    "_remedy",
)

OF_ARGUMENTS = ("what JSON can hold", "a name that ends in", "two rising frequencies above 0 [Hz]")

SHORT = 10
"""Letters of a piece of a message from which it says which one it is."""


def texts(node: ast.AST) -> Iterator[str]:
    for one in ast.walk(node):
        if isinstance(one, ast.Constant) and isinstance(one.value, str):
            yield " ".join(one.value.split()).strip(" ;:(')\"")


def messages() -> Iterator[tuple[str, str]]:
    """Yield where a file is refused, and the longest piece of the message that does not change."""
    for path in [*sorted(READERS.glob("*.py")), Path(_units.__file__)]:
        if path.name in OTHERS:
            continue
        for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(function, ast.FunctionDef) or function.name == "write":
                continue
            assigned: dict[str, list[str]] = {}
            for node in ast.walk(function):
                if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
                    assigned.setdefault(node.targets[0].id, []).extend(texts(node.value))
            for node in ast.walk(function):
                if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call):
                    if getattr(node.exc.func, "id", "") not in ("FileError", "SceneError"):
                        continue
                elif not (isinstance(node, ast.Return) and function.name in TELLING):
                    continue
                used = {one.id for one in ast.walk(node) if isinstance(one, ast.Name)}
                found = [*texts(node), *(text for name in used for text in assigned.get(name, []))]
                longest = max(found, key=len, default="")
                if len(longest) >= SHORT:
                    yield f"{path.name}:{node.lineno}", longest


FOUND = dict(messages())


def test_the_messages_are_found() -> None:
    assert len(FOUND) > 60


@pytest.mark.parametrize("place", FOUND)
def test_the_page_lists_a_message(place: str) -> None:
    message = FOUND[place]
    if message in OF_ARGUMENTS or "Universal File at least" in message:
        pytest.skip("of writing, or of an argument")
    assert message in PAGE, f"docs/refused.md does not list what {place} says: {message}"


def test_the_page_lists_what_is_known_and_not_read() -> None:
    for message in formats._OTHERS.values():
        what, _, way = message.partition(":")
        assert what in PAGE, message
        assert way.strip() in PAGE, message


def test_every_message_of_the_page_has_a_remedy() -> None:
    rows = re.findall(
        r"^\| (`.+) \| (.+) \|$",
        (ROOT / "docs" / "refused.md").read_text(encoding="utf-8"),
        re.MULTILINE,
    )
    assert len(rows) > 50
    assert all(remedy.strip() for _, remedy in rows)
