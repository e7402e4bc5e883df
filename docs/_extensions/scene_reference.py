"""The reference of scenes: every part of the one schema with its fields, as Markdown."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from ballrace.scene.schema import schema

if TYPE_CHECKING:
    from collections.abc import Mapping

    Node = Mapping[str, Any]

PLAIN = {
    "number": "number",
    "integer": "whole number",
    "boolean": "true or false",
    "string": "text",
}


def markdown() -> str:
    """Return a section a part, in the order in which a scene comes to them."""
    document = schema()
    parts = [_section("Scene", document, heading="The whole document")]
    for name in _in_order(document, document, {}):
        node = document["$defs"][name]
        tag = _tag(node)
        if tag is None:
            parts.append(_section(name, node, heading=name))
        else:
            inner = node["properties"][tag]
            if "properties" in inner:
                parts.append(_section(name, inner, heading=f"{name}: `{tag}`"))
            else:
                text = f"{inner['description']} ({_holds(inner)})"
                parts.append(f"({name.lower()})=\n## {name}: `{tag} = …`\n\n{text}")
    return "\n\n".join(parts)


def _in_order(node: Any, document: Node, seen: dict[str, None]) -> dict[str, None]:
    """Return the names of all parts below a node, each where it is met first."""
    if isinstance(node, list):
        for each in node:
            _in_order(each, document, seen)
    elif isinstance(node, dict):
        name = str(node.get("$ref", "")).rpartition("/")[2]
        if name and name not in seen:
            seen[name] = None
            _in_order(document["$defs"][name], document, seen)
        for key, each in node.items():
            if key not in ("$ref", "$defs", "default"):
                _in_order(each, document, seen)
    return seen


def _section(name: str, node: Node, *, heading: str) -> str:
    rows = [f"({name.lower()})=\n## {heading}\n", f"{node['description']}\n"]
    if node["properties"]:
        rows += ["| field | holds | by default | meaning |", "|---|---|---|---|"]
        rows += [_row(key, each, node) for key, each in node["properties"].items()]
    return "\n".join(rows)


def _row(key: str, node: Node, of: Node) -> str:
    default = "must be given" if key in of.get("required", ()) else _default(node)
    cells = (f"`{key}`", _holds(node), default, node.get("description", ""))
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def _default(node: Node) -> str:
    if "default" not in node:
        return "none" if "additionalProperties" in node else "absent"
    if isinstance(node["default"], dict):
        return "its own defaults"
    return f"`{json.dumps(node['default'], ensure_ascii=False)}`"


def _holds(node: Node) -> str:
    """Return in words what a field may hold."""
    if "$ref" in node:
        name = node["$ref"].rpartition("/")[2]
        return f"[{name}](#{name.lower()})"
    if "anyOf" in node:
        return " or ".join(_holds(each) for each in node["anyOf"] if each != {"type": "null"})
    if "enum" in node:
        return ", ".join(f'`"{name}"`' for name in node["enum"])
    if node["type"] == "array":
        count = f"{node['minItems']} of " if "minItems" in node else ""
        return f"list: {count}{_holds(node['items'])}"
    if node["type"] == "object":
        return f"table by name: {_holds(node['additionalProperties'])}"
    return PLAIN[node["type"]]


def _tag(node: Node) -> str | None:
    """Return the tag of a variant; None of any other part."""
    if "description" in node:
        return None
    (tag,) = node["properties"]
    return str(tag)
