"""The oil as a document: by name or by its data sheet, in scenes and where scenes are made."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from dataclasses import replace

import jsonschema
import pytest

import ballrace as br
from ballrace._base.document import decode
from ballrace.scene import Lubricant
from ballrace.scene.schema import schema
from oils import astm_d341

VG68 = Lubricant.named("vg68", temperature_c=55.0)

MAKERS: list[Callable[..., br.Scene]] = [
    lambda **oil: br.bearing("6205", radial_load=500.0, speed_rpm=1800.0, **oil),
    lambda **oil: br.presets.deep_groove_6205(500.0, **oil),
    lambda **oil: br.presets.wheel_bearing(3000.0, **oil),
]


def test_a_name_and_a_temperature() -> None:
    assert Lubricant(oil="vg68", temperature=328.15) == VG68
    assert VG68.viscosity_40 is None
    assert (VG68.film, VG68.damping, VG68.traction, VG68.rolling) == (True,) * 4


def test_a_dry_scene_keeps_its_text(wheel: br.Scene) -> None:
    document = wheel.to_dict()
    assert "lubricant" not in document
    assert "lubricant" not in document["rows"][0]
    assert decode(br.Scene, document) == wheel


def test_documents_hold_an_oil(wheel: br.Scene) -> None:
    """Of the scene and of a row; there and back by the dataclasses alone."""
    flooded = replace(VG68, oil_layer="flooded")
    rows = (replace(wheel.rows[0], lubricant=flooded), wheel.rows[1])
    oiled = replace(wheel, lubricant=VG68, rows=rows)
    document = json.loads(json.dumps(oiled.to_dict()))
    assert decode(br.Scene, document) == oiled
    assert document["lubricant"]["temperature"] == pytest.approx(328.15)
    assert document["rows"][0]["lubricant"]["oil_layer"] == "flooded"
    assert "lubricant" not in document["rows"][1]


def test_the_schema_knows_oils(wheel: br.Scene) -> None:
    found = schema()
    fields = found["$defs"]["Lubricant"]["properties"]
    assert all("description" in field for field in fields.values())
    document = replace(wheel, lubricant=VG68).to_dict()
    validate = jsonschema.Draft202012Validator(found)
    assert list(validate.iter_errors(document)) == []
    for field, value in (("oil_layer", "much"), ("base", "butter"), ("film", 1), ("viscosity", 1)):
        wrong = {**document, "lubricant": {**document["lubricant"], field: value}}
        assert list(validate.iter_errors(wrong)), field
    for degrees, usable in (
        ({"temperature_c": 55.0}, True),
        ({"temperature": 328.15}, True),
        ({"temperature_c": 55.0, "temperature": 328.15}, False),
        ({}, False),
    ):
        given = {**document, "lubricant": {"oil": "vg68", **degrees}}
        assert (not list(validate.iter_errors(given))) == usable, degrees


@pytest.mark.parametrize("make", MAKERS)
def test_unusable_arguments_are_named(make: Callable[..., br.Scene]) -> None:
    """Before the core looks at anything."""
    for arguments, named, allowed in (
        ({"lubricant": "vg68"}, "temperature_c", "°C"),
        ({"temperature_c": 55.0}, "temperature_c", "no lubricant"),
        ({"lubricant": VG68, "temperature_c": 55.0}, "temperature_c", "its own"),
        ({"lubricant": "vg68", "temperature_c": math.nan}, "temperature_c", "°C"),
        ({"lubricant": "vg68", "temperature_c": "hot"}, "temperature_c", "°C"),
        ({"lubricant": 68, "temperature_c": 55.0}, "lubricant", "lubricants()"),
    ):
        with pytest.raises(br.SceneError) as caught:
            make(**arguments)
        assert caught.value.path == named, arguments
        assert allowed in caught.value.allowed, arguments
    with pytest.raises(br.SceneError, match="oil = 68"):
        Lubricant.named(68, temperature_c=55.0)  # type: ignore[arg-type]


@pytest.mark.parametrize("make", MAKERS)
def test_scenes_are_made_with_an_oil(make: Callable[..., br.Scene]) -> None:
    scene = make(lubricant="vg68", temperature_c=55.0)
    assert scene.lubricant == VG68
    assert replace(scene, lubricant=None) == make()
    assert make(lubricant=VG68) == scene
    assert br.Scene.from_toml(scene.to_toml()) == scene


def test_an_oil_comes_and_goes_by_its_path(wheel: br.Scene) -> None:
    """Although documents leave it out where there is none."""
    oiled = wheel.replace({"lubricant": VG68, "rows[0].lubricant": VG68})
    assert oiled.lubricant == VG68
    assert oiled.rows[0].lubricant == VG68
    assert oiled.replace({"lubricant.temperature": 300.0}).lubricant == replace(
        VG68, temperature=300.0
    )
    assert oiled.replace({"lubricant": None, "rows[0].lubricant": None}) == wheel


def test_the_core_takes_a_temperature_in_degrees_celsius(wheel: br.Scene) -> None:
    document = wheel.to_dict() | {"lubricant": {"oil": "vg68", "temperature_c": 55.0}}
    assert br.Scene.from_json(json.dumps(document)).lubricant == VG68


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("oil", "vg69"),
        ("temperature", 500.0),
        ("viscosity_40", -1.0),
        ("roughness", 0.0),
        ("oil_layer", 0.0),
        ("limiting_stress", 0.5),
        ("boundary_friction", 0.0),
        ("fill", 1.5),
    ],
)
def test_the_core_refuses_by_the_field(wheel: br.Scene, field: str, value: object) -> None:
    oiled = replace(wheel, lubricant=VG68)
    with pytest.raises(br.SceneError) as caught:
        oiled.replace({f"lubricant.{field}": value})
    assert caught.value.path == f"lubricant.{field}"
    if field == "oil":
        assert "vg68" in caught.value.allowed


def test_named_oils_have_their_numbers() -> None:
    oils = {oil.name: oil for oil in br.lubricants()}
    assert (oils["vg68"].viscosity_40, oils["vg68"].viscosity_100) == pytest.approx((68e-6, 8.7e-6))
    assert oils["fva3"].density_15 == 882.0
    assert all(oil.source for oil in oils.values())


def test_an_oil_at_its_temperature() -> None:
    """Truth: ASTM D341, the density's slope and Gold et al. 2001, here once more."""
    found = VG68.properties()
    nu, hotter = (astm_d341(68.0, 8.7, celsius) for celsius in (55.0, 55.01))
    density = 880.0 * (1.0 - 6.5e-4 * (328.15 - 288.15))
    assert nu == pytest.approx(34.8162, rel=1e-4)
    assert found.kinematic_viscosity == pytest.approx(1e-6 * nu)
    assert found.density == pytest.approx(density)
    assert found.viscosity == pytest.approx(1e-6 * nu * density)
    assert found.temperature_viscosity == pytest.approx(math.log(nu / hotter) / 0.01, rel=1e-3)
    assert found.pressure_viscosity == pytest.approx(9.904e-9 * nu**0.139)
    assert found.limiting_stress == 0.047
    assert "Gold" in found.sources["pressure_viscosity"]
