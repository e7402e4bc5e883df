"""Oils across the border: the list of names, and numbers with their sources."""

from __future__ import annotations

import json

import pytest

from ballrace import _core
from ballrace.errors import SceneError


def test_named_oils_are_listed_with_sources() -> None:
    oils = {oil["name"]: oil for oil in json.loads(_core.named_oils())}
    assert list(oils) == ["vg32", "vg68", "vg100", "vg220", "fva3"]
    assert oils["fva3"]["density_15"] == 882.0
    assert oils["vg68"]["viscosity_40"] == 68e-6
    assert all(oil["source"] and oil["base"] == "mineral" for oil in oils.values())


def test_a_lubricant_is_resolved_with_sources() -> None:
    oil = json.loads(_core.oil('{"oil": "vg68", "temperature_c": 55, "limiting_stress": 0.05}'))
    assert oil["temperature"] == pytest.approx(328.15)
    assert oil["viscosity"]["value"] == pytest.approx(0.029842, rel=1e-4)
    assert oil["temperature_viscosity"]["value"] == pytest.approx(0.04022, rel=1e-4)
    assert oil["pressure_viscosity"]["value"] == pytest.approx(1.6223e-8, rel=1e-4)
    sources = {name: of["source"] for name, of in oil.items() if isinstance(of, dict)}
    assert sources["viscosity_40"] == "named oil"
    assert sources["pressure_viscosity"] == "Gold et al. 2001"
    assert sources["limiting_stress"] == "given"
    base = json.loads(_core.oil('{"oil": "vg68", "temperature": 328.15, "base": "pao"}'))
    assert base["limiting_stress"] == {"value": 0.035, "source": "base"}


def test_an_unusable_lubricant_is_refused_by_its_field() -> None:
    with pytest.raises(SceneError, match=r"lubricant\.viscosity_40 = -1"):
        _core.oil('{"viscosity_40": -1, "viscosity_100": 8e-6, "temperature": 330}')
    with pytest.raises(SceneError, match="vg32, vg68, vg100, vg220, fva3"):
        _core.oil('{"oil": "vg46", "temperature": 330}')
