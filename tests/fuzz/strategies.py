"""Scene documents: presets with any field changed, within its bounds and beyond them.

The types of :mod:`ballrace.scene` say what a document may have, so that a field that is new there is fuzzed here.
"""

from __future__ import annotations

import json
import types
import typing
from collections.abc import Mapping
from typing import Any, ClassVar, Literal

import hypothesis.strategies as st
from hypothesis.strategies import DrawFn, SearchStrategy

import ballrace as br
from ballrace._base.document import Part, Variant
from ballrace.scene import Scene

S = br.scene

TYPICAL = {
    "ball_diameter": 8e-3, "pitch_diameter": 4e-2, "outer_conformity": 0.52, "inner_conformity": 0.52,
    "contact_angle": 0.3, "clearance": 1e-5, "axial_preload": 1e-5, "axial_position": 1e-2, "stiffness": 1e7,
    "damping": 100.0, "play": 1e-4, "force": 500.0, "moment": 1.0, "speed": 200.0, "width": 1e-3, "length": 4e-3,
    "edge_radius": 1e-3, "depth": 1e-5, "density": 7850.0, "youngs_modulus": 2e11, "amplitude": 1e-6, "z": 1e-3,
    "r": 2e-2, "rtol": 1e-6, "first_step": 1e-7, "max_step": 1e-6, "temperature": 330.0, "viscosity_40": 6e-5,
    "viscosity_100": 9e-6, "density_15": 880.0, "pressure_viscosity": 2e-8, "roughness": 1e-7, "oil_layer": 1e-5,
    "constant": 3.6e10, "accuracy": 1e-3, "diameter_errors": 1e-6, "times": 1e-4, "widths": 1e-3,
    "positions": 1e-3, "outer_shoulder_radius": 1e-4, "inner_shoulder_radius": 1e-4, "at": 1e-2, "tilt": 1e-3,
    "start": 1e-4, "end": 2e-4, "coefficient": 0.05, "slip_speed": 0.1, "frequency": 100.0,
}  # fmt: skip
"""What a field may be about, by its name; others about 1."""

EDGES = (0.0, -0.0, 1.0, -1.0, 2.3e-308, 1e-300, 1e-12, 1e12, 1e300, 1.7976931348623157e308, -1e300)
WRONG: tuple[Any, ...] = (
    None,
    True,
    "x",
    "",
    [],
    {},
    [1.0, 2.0],
    {"a": 1},
    -1,
    0,
    0.5,
    10**18,
    10**30,
    "nan",
    [[]],
)
WORDS = (
    "outer",
    "inner",
    "row0.ball0",
    "row0.ball3",
    "row9.ball9",
    "vg68",
    "spall",
    "",
    "a.b",
    "é\x1b[1m",
)


def bases() -> dict[str, dict[str, Any]]:
    """Return documents that run, between them with every part that a scene may have."""
    scenes = {
        "deep groove": br.presets.deep_groove_6205(500.0, 100.0),
        "wheel": br.presets.wheel_bearing(axial_load=3000.0),
        "curve": br.presets.cornering_wheel(),
        "oil": br.presets.deep_groove_6205(lubricant="vg68", temperature_c=60.0),
        "angular": br.bearing(
            "7205B", axial_load=300.0, radial_load=100.0,
            defects=br.defects.spall(on="ball", width_mm=0.5), speed_rpm=1800.0,
        ),
        "driven": br.presets.deep_groove_6205(300.0).replace({"drive": S.TorqueDrive(value=0.1)}),
        "arch": br.presets.deep_groove_6205(300.0, 100.0).replace(
            {
                "rows[0].outer_arch": S.GothicArch(shim_angle=0.3),
                "rows[0].inner_waviness": [S.Waviness(order=7, amplitude=1e-7)],
                "contact.slices": S.FixedSlices(50),
                "contact.law": S.Iso16281(),
                "loads.radial.force": S.Sine(mean=300.0, amplitude=50.0, frequency=500.0, phase=0.0),
            }
        ),
    }  # fmt: skip
    return {name: json.loads(scene.to_json()) for name, scene in scenes.items()}


BASES = bases()


def numbers(name: str) -> SearchStrategy[float]:
    """Numbers of a field's own size, either sign, and those that break things."""
    scale = TYPICAL.get(name, 1.0)
    own = st.builds(
        lambda power, sign: sign * scale * 10.0**power,
        st.floats(-3.0, 3.0),
        st.sampled_from((1.0, 1.0, 1.0, -1.0)),
    )
    return st.one_of(own, own, own, st.sampled_from(EDGES))


def typed(hint: Any, name: str = "") -> SearchStrategy[Any]:
    """Documents of a type, fields present or not, numbers of their field's size."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if alike := kinds(hint):
        return st.one_of([typed(each, name) for each in alike])
    if origin is Literal:
        return st.sampled_from(arguments)
    if origin is tuple:
        each = typed(arguments[0], name)
        if arguments[-1] is Ellipsis:
            return st.lists(each, max_size=6)
        return st.lists(each, min_size=len(arguments), max_size=len(arguments))
    if origin is Mapping:
        return st.dictionaries(st.sampled_from(WORDS), typed(arguments[1]), max_size=2)
    if isinstance(hint, type) and issubclass(hint, Part):
        return _part(hint, name)
    plain: dict[Any, SearchStrategy[Any]] = {
        float: numbers(name),
        int: st.one_of(st.integers(0, 12), st.sampled_from((-1, 1000, 1001, 10**6, 2**63, 2**64))),
        bool: st.booleans(),
        str: st.sampled_from(WORDS),
        type(None): st.none(),
    }
    return plain[hint]


def _later(hint: Any, name: str) -> SearchStrategy[Any]:
    """Strategies of a type, made where they are first drawn from."""
    return st.deferred(lambda: typed(hint, name))


def _part(kind: type[Part], name: str) -> SearchStrategy[Any]:
    fields = {key: _later(hint, key) for key, hint in hints(kind).items()}
    if not issubclass(kind, Variant):
        constants = {key: st.just(each) for key, each in told_by(kind).items() if each is not None}
        return st.fixed_dictionaries(constants, optional=fields)
    if kind.wraps:
        (inner,) = hints(kind).values()
        return st.builds(lambda value: {kind.tag: value}, typed(inner, name or kind.tag))
    return st.builds(lambda value: {kind.tag: value}, st.fixed_dictionaries(fields))


_HINTS: dict[type, dict[str, Any]] = {}


def hints(kind: type) -> dict[str, Any]:
    """Return the types of a part's fields, by their keys in documents."""
    if kind not in _HINTS:
        found = typing.get_type_hints(kind)
        _HINTS[kind] = {
            k.removesuffix("_"): v
            for k, v in found.items()
            if k not in ("tag", "wraps") and typing.get_origin(v) is not ClassVar
        }
    return _HINTS[kind]


def told_by(kind: type) -> dict[str, Any]:
    """Return the constants of a class that tell it from its like in documents, None where they have none."""
    return {key: getattr(kind, key) for key in getattr(kind, "_telling", ())}


def kinds(hint: Any) -> tuple[Any, ...]:
    """Return the types of a union, or those that share a base which tells them by constants."""
    if typing.get_origin(hint) in (typing.Union, types.UnionType):
        return typing.get_args(hint)
    return tuple(hint.__subclasses__()) if "_telling" in getattr(hint, "__dict__", ()) else ()


@st.composite
def scenes(draw: DrawFn, most: int = 3, wrong: bool = True) -> dict[str, Any]:
    """Draw documents of scenes: one that runs, with a few fields changed."""
    document = BASES[draw(st.sampled_from(sorted(BASES)))]
    for _ in range(draw(st.integers(0, most))):
        document = _changed_fields(draw, Scene, document, wrong)
    return document


def _changed(draw: DrawFn, hint: Any, value: Any, name: str, wrong: bool) -> Any:
    """Return a document with one place of it changed, the document itself left as it is."""
    if wrong and draw(st.integers(0, 40)) == 0:
        return draw(st.sampled_from(WRONG))
    hint = _fitting(hint, value)
    if isinstance(value, dict) and typing.get_origin(hint) is Mapping:
        return _changed_entry(draw, hint, value, wrong)
    if isinstance(value, list) and typing.get_origin(hint) is tuple:
        return _changed_item(draw, typing.get_args(hint)[0], value, name, wrong)
    if isinstance(value, dict) and isinstance(hint, type) and issubclass(hint, Part):
        return _changed_part(draw, hint, value, name, wrong)
    if isinstance(value, float | int) and not isinstance(value, bool) and draw(st.booleans()):
        return type(value)(value * 10.0 ** draw(st.floats(-0.5, 0.5)))
    return draw(typed(hint, name))


def _changed_part(draw: DrawFn, kind: type, value: Any, name: str, wrong: bool) -> Any:
    if issubclass(kind, Variant):
        if draw(st.integers(0, 5)) == 0 or kind.tag not in value:
            return draw(typed(kind, name))
        if kind.wraps:
            (inner,) = hints(kind).values()
            return {kind.tag: _changed(draw, inner, value[kind.tag], kind.tag, wrong)}
        return {kind.tag: _changed_fields(draw, kind, value[kind.tag], wrong)}
    return _changed_fields(draw, kind, value, wrong)


def _changed_fields(draw: DrawFn, kind: type, value: Any, wrong: bool) -> Any:
    fields = hints(kind)
    if not isinstance(value, dict) or not fields:
        return value
    key = draw(st.sampled_from(sorted(fields)))
    return {**value, key: _changed(draw, fields[key], value.get(key), key, wrong)}


def _changed_entry(draw: DrawFn, hint: Any, value: dict[str, Any], wrong: bool) -> Any:
    each = typing.get_args(hint)[1]
    if not value or draw(st.integers(0, 4)) == 0:
        return {**value, draw(st.sampled_from(WORDS)): draw(typed(each))}
    key = draw(st.sampled_from(sorted(value)))
    if draw(st.integers(0, 9)) == 0:
        return {k: v for k, v in value.items() if k != key}
    return {**value, key: _changed(draw, each, value[key], key, wrong)}


def _changed_item(draw: DrawFn, hint: Any, value: list[Any], name: str, wrong: bool) -> Any:
    if not value or draw(st.integers(0, 6)) == 0:
        return [*value, draw(typed(hint, name))]
    at = draw(st.integers(0, len(value) - 1))
    if draw(st.integers(0, 9)) == 0:
        return value[:at] + value[at + 1 :]
    return [*value[:at], _changed(draw, hint, value[at], name, wrong), *value[at + 1 :]]


def _fitting(hint: Any, value: Any) -> Any:
    """Return the member of a union that a value is of, or the union where it is of none."""
    for each in kinds(hint):
        kind = typing.get_origin(each) or each
        if kind is Literal:
            continue
        if isinstance(kind, type) and issubclass(kind, Variant):
            if isinstance(value, dict) and kind.tag in value:
                return each
        elif isinstance(kind, type) and issubclass(kind, Part):
            if isinstance(value, dict) and all(
                value.get(key) == constant for key, constant in told_by(kind).items()
            ):
                return each
        elif (kind is tuple and isinstance(value, list)) or (
            kind is float and type(value) in (int, float)
        ):
            return each
    return hint


@st.composite
def damaged(draw: DrawFn, texts: tuple[str, ...]) -> str:
    """Draw texts that were cut, doubled, mixed or overwritten at places."""
    text = draw(st.sampled_from(texts))
    for _ in range(draw(st.integers(1, 4))):
        text = _damage(draw, text, draw(st.sampled_from(texts)))
    return text


TOKENS = (
    "", " ", "\n", "\0", "\ufeff", "{", "}", "[", "]", "[[", "=", ",",
    '"', "'''", "#", ".", "-", "1e999", "nan", "inf",
    "-0", "0x", "1_000", "1979-05-27", "true", "null", "\\u0000", "\\ud800", "\r", "é", "a.b = 1", "[rows]",
    "[[rows]]\n", "[" * 200, '{"a":' * 200, "9" * 400, "schema = 2\n", "schema = -1\n", '"rows"', "e", "+",
)  # fmt: skip


def _damage(draw: DrawFn, text: str, other: str) -> str:
    a, b = sorted((draw(st.integers(0, len(text))), draw(st.integers(0, len(text)))))
    short = min(b, a + draw(st.integers(0, 12)))
    c = draw(st.integers(0, len(other)))
    kind = draw(st.integers(0, 6))
    match kind:
        case 0:
            return text[:a] + text[b:]
        case 1:
            return text[:b] + text[a:]
        case 2:
            return text[:a] + draw(st.sampled_from(TOKENS)) + text[short:]
        case 3:
            return text[:a] + other[c:]
        case 4:
            lines = text.splitlines(keepends=True) or [""]
            at = draw(st.integers(0, len(lines) - 1))
            return "".join([*lines[:at], *lines[at + 1 :], lines[at]])
        case 5:
            return text[:a] + draw(st.text(max_size=4)) + text[short:]
    return text[:a]


def mild() -> SearchStrategy[dict[str, Any]]:
    """Documents with single numbers changed by a factor of three at most, most of which run."""
    return st.composite(_mild)()


def _mild(draw: DrawFn) -> dict[str, Any]:
    document = BASES[draw(st.sampled_from(sorted(BASES)))]
    for _ in range(draw(st.integers(0, 3))):
        places = list(_numbers(document, ()))
        document = _set(document, draw(st.sampled_from(places)), 10.0 ** draw(st.floats(-0.5, 0.5)))
    return document


def _numbers(document: Any, path: tuple[Any, ...]) -> typing.Iterator[tuple[Any, ...]]:
    """Yield the places of the floats of a document."""
    pairs = document.items() if isinstance(document, dict) else enumerate(document)
    for key, value in pairs:
        if isinstance(value, dict | list):
            yield from _numbers(value, (*path, key))
        elif isinstance(value, float):
            yield (*path, key)


def _set(document: Any, path: tuple[Any, ...], factor: float) -> Any:
    if not path:
        return document * factor
    copy = dict(document) if isinstance(document, dict) else list(document)
    copy[path[0]] = _set(copy[path[0]], path[1:], factor)
    return copy
