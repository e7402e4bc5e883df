"""Ranges of the numbers of a scene in its JSON Schema."""

from __future__ import annotations

import json
import re

from ballrace.scene.schema import schema

_OTHERWISE = {
    "a function of time": {
        "Given.given", "Load.force", "Moment.moment", "Ramp.ramp", "Scene.outer_speed", "Sine.sine",
        "SpeedDrive.speed", "Spline.spline", "Table.table",
    },
    "a row or a ball that the scene has": {
        "CageProbe.cage", "ContactsProbe.contacts", "Defect.ball", "Defect.row", "LubricationProbe.lubrication",
    },
    "a range that depends on other fields": {
        "Defect.axial_offset", "Floor.depth", "Lubricant.temperature_c", "RaceProfile.z", "Ring.tilt",
        "Row.axial_preload", "Row.clearance", "Row.diameter_errors", "Row.inner_shoulder_radius",
        "Row.outer_shoulder_radius", "Texture.orders", "Waviness.amplitude", "WidthProfile.positions",
    },
    "a direction, a matrix, a list of places": {
        "CoupledSupport.damping", "CoupledSupport.stiffness", "Load.direction", "Mode.sensors", "Moment.direction",
        "Structure.static_compliance", "TableForce.direction",
    },
    "stated for each kind of defect": {"Defect.edge_radius", "Defect.length"},
    "one of two numbers": {"Row.side", "Scene.schema"},
}  # fmt: skip
"""Fields of numbers without a range in the schema, by what they are or have instead."""


def test_every_number_has_a_range_or_a_reason_for_none() -> None:
    """Golden: a number of a new law, force or damage whose range is in no list of the crate is not missed."""
    whole = schema()
    bare = {
        f"{part}.{field}"
        for part, of in {"Scene": whole, **whole["$defs"]}.items()
        for field, what in of.get("properties", {}).items()
        if _is_number(what) and not re.search(r'(?i)"(exclusive)?m(in|ax)imum"', _types(what))
    }
    assert bare == set().union(*_OTHERWISE.values())


def _is_number(what: dict[str, object]) -> bool:
    return re.search(r'"(number|integer)"', _types(what)) is not None


def _types(what: dict[str, object]) -> str:
    """Return a field's schema as text, without words for a reader."""
    return json.dumps(
        {key: of for key, of in what.items() if key not in ("default", "description")}
    )
