"""Scenes in TOML with a comment at every field that says what it is, and in which unit.

Comments and the JSON Schema take their text from the docstrings of the parts.
"""

from __future__ import annotations

import textwrap
import tomllib
from typing import TYPE_CHECKING, Any

from .described import described

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from .._base.document import Part

__all__ = ["commented"]

_WIDTH = 110
"""Longest line of a comment; a longer one stands above its field."""


def commented(toml: str, kind: type[Part]) -> str:
    """Return the TOML of a part, as the core writes it, with a comment at every field and table.

    Examples
    --------
    >>> import ballrace as br
    >>> text = br.presets.deep_groove_6205().to_toml(comments=True)
    >>> [line for line in text.splitlines() if line.startswith("ball_count")]
    ['ball_count = 9  # Number of balls, 1 to 1000.']
    """
    document = described(kind)
    lines: list[str] = []
    table: list[str] = []
    for statement in _statements(toml):
        if statement.startswith("["):
            table = _path(statement)
            lines += [*_wrapped(_meaning(document, table)), statement]
        elif statement:
            lines += _beside(statement, _meaning(document, [*table, *_path(statement)]))
        else:
            lines.append("")
    return "\n".join(lines) + "\n"


def _statements(toml: str) -> Iterator[str]:
    """Return headings, fields and empty lines; a text that goes over several lines is one."""
    held = ""
    # Python knows more ends of lines than TOML, which a name may have in it.
    for line in toml.removesuffix("\n").split("\n"):
        held = f"{held}\n{line}" if held else line
        try:
            tomllib.loads(held)
        except tomllib.TOMLDecodeError:
            continue
        yield held
        held = ""


def _path(statement: str) -> list[str]:
    """Return the keys of a heading, or of a field: one, whatever its value holds."""
    found: Any = tomllib.loads(statement)
    path: list[str] = []
    while isinstance(found, dict | list) and found:
        if isinstance(found, list):
            (found,) = found
            continue
        ((key, found),) = found.items()
        path.append(key)
        if not statement.startswith("["):
            break
    return path


def _meaning(document: Mapping[str, Any], path: list[str]) -> str:
    """Return what the schema says of the field at a path; arrays are looked through."""
    node: Mapping[str, Any] = document
    for key in path:
        node = next(
            found for each in _choices(node, document) if (found := _entry(each, key)) is not None
        )
    text = node.get("description") or next(_choices(node, document)).get("description", "")
    names = [name for each in _choices(node, document) for name in each.get("enum", ())]
    chosen = ", ".join(f'"{name}"' for name in names)
    return (f"{text} One of {chosen}." if len(names) > 1 else str(text)).replace("`", "")


def _choices(node: Mapping[str, Any], document: Mapping[str, Any]) -> Iterator[Mapping[str, Any]]:
    """Return what a node may be, references and alternatives resolved."""
    if "$ref" in node:
        yield from _choices(document["$defs"][node["$ref"].rpartition("/")[2]], document)
    elif "anyOf" in node:
        for each in node["anyOf"]:
            yield from _choices(each, document)
    elif node.get("type") == "array":
        yield from _choices(node["items"], document)
    else:
        yield node


def _entry(node: Mapping[str, Any], key: str) -> Mapping[str, Any] | None:
    found: Mapping[str, Any] | None = node.get("properties", {}).get(key)
    return found or node.get("additionalProperties") or None


def _wrapped(text: str) -> list[str]:
    return [f"# {line}" for line in textwrap.wrap(text, _WIDTH - 2, break_on_hyphens=False)]


def _beside(field: str, text: str) -> list[str]:
    """Return a field with its comment: at its end where it fits, else above."""
    line = f"{field}  # {text}"
    return [line] if len(line) <= _WIDTH and "\n" not in field else [*_wrapped(text), field]
