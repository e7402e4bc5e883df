"""Scenes written for people: every field has its meaning and unit, and the text still is the scene."""

from __future__ import annotations

import dataclasses
import json
import re
from collections.abc import Iterator
from typing import Any

import pytest

import ballrace as br
import ballrace.scene as s
from ballrace.cli import main
from ballrace.scene.schema import schema
from test_scene import scenes

FIELD = re.compile(r'(?:[\w-]+|"[^"]*") = ')


def explained(text: str) -> list[str]:
    """Return the fields and tables of a commented scene; each must have a comment at its end or above."""
    lines, found = text.splitlines(), []
    for above, line in zip(["", *lines], lines, strict=False):
        if FIELD.match(line) or line.startswith("["):
            assert above.startswith("# ") or "  # " in line, line
            found.append(line)
    return found


@pytest.mark.parametrize("scene", scenes(), ids=lambda scene: scene.name)
def test_every_field_is_explained_and_the_scene_stays_the_same(scene: s.Scene) -> None:
    text = scene.to_toml(comments=True)
    assert s.Scene.from_toml(text) == scene
    # Nothing but comments has come in.
    plain = scene.to_toml()
    bare = [re.sub(r"  # .*", "", line) for line in explained(text)]
    kept = [line for line in plain.splitlines() if FIELD.match(line) or line.startswith("[")]
    assert bare == kept


def test_a_title_that_looks_like_toml() -> None:
    scene = br.presets.wheel_bearing()
    loads = {"1-2": scene.loads["axial"], "force": scene.loads["radial"]}
    odd = dataclasses.replace(scene, name='two\nlines = 1 # "and', loads=loads)
    text = odd.to_toml(comments=True)
    assert s.Scene.from_toml(text) == odd
    assert '# A title.\nname = """' in text
    assert text.count("# A force on a ring's centre or on another point of it, in a fixed") == 2


@pytest.mark.parametrize("end", ["\x0b", "\x0c", "\x1c", "\x85", "\u2028", "\u2029", "\r", "\n"])
def test_a_name_with_ends_of_lines_that_toml_does_not_know(end: str) -> None:
    scene = br.bearing("6205", speed_rpm=1800.0).replace({"name": f"a{end}b"})
    assert s.Scene.from_toml(scene.to_toml(comments=True)) == scene


def test_comments_are_those_of_the_schema() -> None:
    text = br.presets.wheel_bearing().to_toml(comments=True)
    assert (
        "width = 0.0015  # Arc length along the surface [m]; a number, or a profile along the axis.\n"
        in text
    )
    assert "speed = 188.49555921538757  # Speed [rad/s]; must not jump.\n" in text
    assert "fitted = 6  # Nodes on each piece, 2 to 64.\n" in text
    assert "# Friction with a constant coefficient.\n[friction.coulomb]\n" in text
    assert 'ring = "inner"  # The loaded ring. One of "outer", "inner".\n' in text
    # None is what TOML cannot say, and marks of docstrings are for the reference.
    assert "None" not in text
    assert "`" not in text


def numbers(node: dict[str, Any], path: str) -> Iterator[tuple[str, str]]:
    """Return where a schema wants a number that need not be whole, and what it says of it."""
    if '"number"' in json.dumps([node.get("type"), node.get("items"), node.get("anyOf")]):
        yield path, node.get("description", "")
    for key, each in {**node.get("properties", {}), **node.get("$defs", {})}.items():
        yield from numbers(each, f"{path}.{key}")


def test_every_number_has_its_unit() -> None:
    """A ratio has the unit 1, and a value in time that of the field."""
    found = list(numbers(schema(), "scene"))
    assert len(found) > 80
    for path, comment in found:
        assert re.search(r"\[[^\]]+\]", comment), (path, comment)


def test_the_command_writes_comments(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["scene", "deep-groove-6205"]) == 0
    assert "ball_count = 9  # Number of balls, 1 to 1000.\n" in capsys.readouterr().out
