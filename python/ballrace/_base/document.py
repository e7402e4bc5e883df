"""Frozen dataclasses to and from plain documents, by their type hints alone.

A part is a dataclass and a document is JSON. A variant is a part with a tag: ``{tag: {…}}``,
or ``{tag: value}`` when it only wraps one value. A field whose name is a Python keyword ends in ``_``.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import types
import typing
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

import numpy as np

from ..errors import SceneError

T = TypeVar("T")

LEFT_OUT = MappingProxyType({"left_out": True})
"""Metadata of a field that a document leaves out where it is None, False or empty, so that older documents keep
their text."""

INSTEAD = "instead"
"""Metadata of a field: the key that a document may have in its place, only read, and what that means."""


@dataclasses.dataclass(frozen=True, kw_only=True)
class Part:
    """Base of all parts of a document: lists become tuples, dicts read-only mappings."""

    def __post_init__(self) -> None:
        for field in dataclasses.fields(self):
            object.__setattr__(self, field.name, _frozen(getattr(self, field.name)))

    def __getstate__(self) -> dict[str, Any]:
        # A read-only mapping cannot be pickled or copied by itself.
        return {k: dict(v) if isinstance(v, Mapping) else v for k, v in self.__dict__.items()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        for name, value in state.items():
            object.__setattr__(self, name, _frozen(value))

    def to_dict(self) -> dict[str, Any]:
        """Return the part as a plain document of dicts, lists, numbers and text."""
        document = encode(self, "")
        assert isinstance(document, dict)
        return document


@dataclasses.dataclass(frozen=True, kw_only=True)
class Variant(Part):
    """A choice of several, identified by its tag."""

    tag: ClassVar[str]
    wraps: ClassVar[bool]

    def __init_subclass__(cls, *, tag: str, wraps: bool = False) -> None:
        cls.tag = tag
        cls.wraps = wraps


class _OfKind(type):
    """Makes of the fields of a document the kind that they tell."""

    def __call__(cls, **fields: Any) -> Any:
        if Told not in cls.__bases__:
            return super().__call__(**fields)
        kind, own = _told(cls, fields, "")  # type: ignore[arg-type]
        return kind(**own)


if TYPE_CHECKING:
    _OfKind = type  # type: ignore[misc, assignment]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Told(Part, metaclass=_OfKind):
    """Base of a part of several kinds whose fields lie flat in a document: some of the keys tell the kind.

    The part that derives from this names these keys in ``_telling``; the kinds derive from that. What a kind
    has as a plain attribute of its class is the same for all its documents, which hold it beside the kind's
    own fields.
    """

    _telling: ClassVar[tuple[str, ...]]

    @classmethod
    def _kinds(cls) -> tuple[type[Told], ...]:
        """Return all kinds of a part."""
        return tuple(cls.__subclasses__())


@functools.cache
def constants(kind: type[Told]) -> dict[str, Any]:
    """Return what is the same in all documents of a kind."""
    own = {field.name for field in dataclasses.fields(kind)}
    part: type[Told] = kind.__mro__[1]
    others = {field.name for of in part._kinds() for field in dataclasses.fields(of)}
    names = (*kind._telling, *sorted(others - own))
    return {name: getattr(kind, name) for name in names if hasattr(kind, name)}


def _told(
    part: type[Told], fields: Mapping[str, Any], path: str
) -> tuple[type[Told], dict[str, Any]]:
    """Return the kind of a part that a document's fields tell, and those that are the kind's own."""
    told = {key: fields.get(key) for key in part._telling}
    same = (kind for kind in part._kinds() if {key: getattr(kind, key) for key in told} == told)
    kind = next(same, None)
    if kind is None:
        (key, value), *_ = [(key, value) for key, value in told.items() if value is not None]
        known = sorted(
            {str(word) for of in part._kinds() if (word := getattr(of, key)) is not None}
        )
        raise SceneError(_join(path, key), repr(value), f"left out, or {' or '.join(known)}")
    own = dict(fields)
    for key, value in constants(kind).items():
        if own.pop(key, value) != value:
            allowed = f"left out, or {value!r}, for a {kind.__name__}"
            raise SceneError(_join(path, key), repr(fields[key]), allowed)
    return kind, own


def _frozen(value: Any) -> Any:
    if isinstance(value, Mapping):
        return MappingProxyType(dict(value))
    if isinstance(value, np.ndarray):
        return tuple(value.tolist())
    if isinstance(value, list):
        return tuple(value)
    return value


def _key(field: dataclasses.Field[Any]) -> str:
    return field.name.removesuffix("_")


def encode(value: object, path: str) -> Any:
    """Return ``value`` as a document; a number that JSON cannot say is a :class:`SceneError` at ``path``."""
    if isinstance(value, np.generic | np.ndarray):
        value = value.tolist()
    match value:
        case None | bool() | int() | str():
            return value
        case float():
            if not math.isfinite(value):
                raise SceneError(path, str(value), "a finite number")
            return float(value)
        case Variant():
            inner = _join(path, value.tag)
            if value.wraps:
                (field,) = dataclasses.fields(value)
                return {value.tag: encode(getattr(value, field.name), inner)}
            return {value.tag: _encode_fields(value, inner)}
        case Part():
            return _encode_fields(value, path)
        case Mapping():
            return {str(k): encode(v, _join(path, str(k))) for k, v in value.items()}
        case Sequence():
            return [encode(v, f"{path}[{i}]") for i, v in enumerate(value)]
        case _:
            raise SceneError(
                path, repr(value), "a number, text, a list, a mapping or a part of a scene"
            )


def _encode_fields(part: Part, path: str) -> dict[str, Any]:
    document: dict[str, Any] = {}
    if isinstance(part, Told):
        same = constants(type(part)).items()
        document = {k: v for k, v in same if k not in part._telling or v is not None}
    for name, key, left_out in _names(type(part)):
        value = getattr(part, name)
        if not (left_out and (value is None or value is False or value == {})):
            document[key] = encode(value, _join(path, key))
    return document


_NAMES: dict[type, list[tuple[str, str, bool]]] = {}


def _names(kind: type[Part]) -> list[tuple[str, str, bool]]:
    """Return of every field of a part its name, its key in a document, and whether None is left out there."""
    if kind not in _NAMES:
        _NAMES[kind] = [
            (field.name, _key(field), "left_out" in field.metadata)
            for field in dataclasses.fields(kind)
        ]
    return _NAMES[kind]


def decode(kind: type[T], document: object) -> T:
    """Return the part of class ``kind`` that ``document`` describes, refusing what it does not know."""
    part: T = _decode(kind, document, "")
    return part


_UNKNOWN = "what this version of the Python package knows"
"""Words for what is allowed in a document that a core of another version has checked."""


def _decode(hint: Any, value: Any, path: str) -> Any:
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        return _decode(_choose(arguments, value, path), value, path)
    if origin is tuple:
        each = (arguments[0],) * len(value) if arguments[-1] is Ellipsis else arguments
        pairs = zip(each, value, strict=True)
        return tuple(_decode(kind, v, f"{path}[{i}]") for i, (kind, v) in enumerate(pairs))
    if origin is Mapping:
        return {k: _decode(arguments[1], v, _join(path, k)) for k, v in value.items()}
    if origin is typing.Literal:
        if value not in arguments:
            raise SceneError(path, str(value), f"one of {', '.join(map(str, arguments))}")
        return value
    if isinstance(hint, type) and issubclass(hint, Part):
        return _decode_part(hint, value, path)
    return None if value is None else hint(value)


def _decode_part(kind: type[Part], value: Any, path: str) -> Part:
    if issubclass(kind, Told):
        kind, value = _told(kind, value, path)
    fields = {_key(field): field.name for field in dataclasses.fields(kind)}
    hints = _hints(kind)
    if issubclass(kind, Variant):
        value = value[kind.tag]
        path = _join(path, kind.tag)
        if kind.wraps:
            (name,) = fields.values()
            return kind(**{name: _decode(hints[name], value, path)})
    for key in value:
        if key not in fields:
            raise SceneError(_join(path, key), key, _UNKNOWN)
    return kind(
        **{fields[k]: _decode(hints[fields[k]], v, _join(path, k)) for k, v in value.items()}
    )


def _choose(choices: tuple[Any, ...], value: Any, path: str) -> Any:
    """Return the member of a union that ``value`` is meant for."""
    tag = next(iter(value)) if isinstance(value, dict) and len(value) == 1 else None
    for choice in choices:
        kind = typing.get_origin(choice) or choice
        if kind is typing.Literal:
            fits = value in typing.get_args(choice)
        elif issubclass(kind, Variant):
            fits = kind.tag == tag
        elif kind is float:
            fits = isinstance(value, float | int)
        elif kind is tuple:
            # Of numbers, or of rows of them.
            inner = typing.get_origin(typing.get_args(choice)[0])
            rows = isinstance(value, list) and any(isinstance(part, list) for part in value)
            fits = isinstance(value, list) and rows == (inner is tuple)
        else:
            fits = isinstance(value, dict if issubclass(kind, Part) else kind)
        if fits:
            return choice
    raise SceneError(path, str(value), _UNKNOWN)


_HINTS: dict[type, dict[str, Any]] = {}


def _hints(kind: type[Part]) -> dict[str, Any]:
    if kind not in _HINTS:
        _HINTS[kind] = typing.get_type_hints(kind)
    return _HINTS[kind]


def _join(path: str, key: str) -> str:
    return f"{path}.{key}" if path else key
