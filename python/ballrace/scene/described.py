"""Schema of a document, from the dataclasses themselves: names, types, choices, defaults, meanings with units.

The form is JSON Schema. Ranges of numbers are the core's own; those that depend on other fields are not there.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import json
import re
import types
import typing
from collections.abc import Mapping
from typing import Any

from .. import _core
from .._base.document import INSTEAD, Part, Told, Variant, constants, encode

__all__ = ["described"]


def described(kind: type[Part]) -> dict[str, Any]:
    """Return the JSON Schema of a part: its fields, and those of all parts below it under ``$defs``."""
    known: dict[str, Any] = {}
    whole = _part(kind, known)
    return {**whole, "$defs": dict(sorted(known.items()))}


@functools.cache
def _ranges() -> dict[str, dict[str, dict[str, Any]]]:
    """Return what the schema says of the range of each part's numbers."""
    ranges: dict[str, dict[str, dict[str, Any]]] = json.loads(_core.scene_ranges())
    return ranges


def _ranged(field: dict[str, Any], kind: type[Part], key: str) -> dict[str, Any]:
    """Return a field with the range of its number, or of those in its list."""
    found = _ranges().get(kind.__name__, {}).get(key, {})
    if "items" in found and "items" in field:
        found = {"items": field["items"] | found["items"]}
    return field | found


def _range(field: dict[str, Any]) -> dict[str, Any]:
    return {word: field[word] for word in field if word.lower().endswith(("minimum", "maximum"))}


def _part(kind: type[Part], known: dict[str, Any]) -> dict[str, Any]:
    hints, descriptions = typing.get_type_hints(kind), _descriptions(kind)
    properties, required, either = {}, [], {}
    for field in dataclasses.fields(kind):
        key = field.name.removesuffix("_")
        own = _ranged(_type(hints[field.name], known), kind, key)
        properties[key] = own | _about(field, descriptions)
        if INSTEAD in field.metadata:
            other, meaning = field.metadata[INSTEAD]
            properties[other] = _type(hints[field.name], known) | {"description": meaning}
            either = {"oneOf": [{"required": [key]}, {"required": [other]}]}
        elif field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING:
            required.append(key)
    of = {"type": "object", "properties": properties, "additionalProperties": False}
    text = {"description": _plain((inspect.getdoc(kind) or "").split("\n")[0])}
    return text | of | ({"required": required} if required else {}) | either


def _about(field: dataclasses.Field[Any], descriptions: Mapping[str, str]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    if field.name in descriptions:
        found["description"] = descriptions[field.name]
    if field.default is not dataclasses.MISSING and field.default is not None:
        found["default"] = encode(field.default, field.name)
    return found


def _descriptions(kind: type[Part]) -> dict[str, str]:
    """Return what a docstring says of each field, in words that hold for documents."""
    descriptions: dict[str, str] = {}
    lines = (inspect.getdoc(kind) or "").partition("Attributes\n----------\n")[2].splitlines()
    names: list[str] = []
    for line in lines:
        if not line:
            break
        if line.startswith(" "):
            for name in names:
                descriptions[name] = f"{descriptions.get(name, '')} {line.strip()}".strip()
        else:
            names = re.split(r",\s*", line.partition(" : ")[0])
    return {name: _plain(text) for name, text in descriptions.items()}


def _plain(text: str) -> str:
    """Return the text without the marks of docstrings; what is None there, a document leaves out."""
    text = re.sub(r":\w+:`~?\.?([^`]*)`", r"`\1`", text).replace("``", "`")
    return re.sub(r"\bNone\b", "absent", re.sub(r"(?<=\. )None\b", "Absent", text))


def _type(hint: Any, known: dict[str, Any]) -> dict[str, Any]:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return {"anyOf": [_type(choice, known) for choice in arguments]}
    if origin is typing.Literal:
        return {"enum": list(arguments)}
    if origin is tuple:
        if arguments[-1] is Ellipsis:
            return {"type": "array", "items": _type(arguments[0], known)}
        size = len(arguments)
        return {
            "type": "array",
            "items": _type(arguments[0], known),
            "minItems": size,
            "maxItems": size,
        }
    if origin is Mapping:
        return {"type": "object", "additionalProperties": _type(arguments[1], known)}
    if isinstance(hint, type) and issubclass(hint, Part):
        return _reference(hint, known)
    plain = {float: "number", int: "integer", bool: "boolean", str: "string", type(None): "null"}
    return {"type": plain[hint]}


def _reference(kind: type[Part], known: dict[str, Any]) -> dict[str, Any]:
    name = kind.__name__
    if name not in known:
        known[name] = {}  # stands while its fields are looked at
        if issubclass(kind, Told):
            known[name] = _flat(kind, known)
        else:
            known[name] = _variant(kind, known) if issubclass(kind, Variant) else _part(kind, known)
    return {"$ref": f"#/$defs/{name}"}


def _flat(kind: type[Told], known: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of all kinds of a part side by side, as in a document, and the keys that tell the kind."""
    whole, descriptions = _part(kind, known), _descriptions(kind)
    parts = [_part(each, known) for each in kind._kinds()]
    fields: dict[str, Any] = {}
    for part in (whole, *parts):
        fields = {**part["properties"], **fields}
    told = {}
    for key in kind._telling:
        words = [word for each in kind._kinds() if (word := getattr(each, key)) is not None]
        choices = [{"enum": words}, {"type": "null"}]
        told[key] = {"anyOf": choices, "description": descriptions[key]}
    for key in fields:
        # The keywords of a range that holds for all kinds, of which some have the same number in all documents.
        ranges = [_range(part["properties"][key]) for part in parts if key in part["properties"]]
        same = any(key in constants(each) for each in kind._kinds())
        if same or any(each != ranges[0] for each in ranges):
            fields[key] = {k: v for k, v in fields[key].items() if k not in _range(fields[key])}
    needed = [key for key in fields if all(key in part["required"] for part in parts)]
    return {**whole, "properties": {**fields, **told}, "required": needed}


def _variant(kind: type[Variant], known: dict[str, Any]) -> dict[str, Any]:
    """Return a variant: an object with its tag alone, which holds its fields or its one value."""
    inner = _part(kind, known)
    if kind.wraps:
        (inner,) = inner["properties"].values()
        inner = _ranged(inner, kind, kind.tag)
    of = {"type": "object", "properties": {kind.tag: inner}, "required": [kind.tag]}
    return of | {"additionalProperties": False}
