"""Reports have the numbers of what they report on."""

from __future__ import annotations

import base64
import html
import importlib.util
import re
import zlib
from dataclasses import replace
from pathlib import Path

import numpy as np
import plotly.graph_objects as go
import polars as pl
import pytest

import ballrace as br
from ballrace import demo
from ballrace.report import Page, words


@pytest.fixture(scope="module")
def out() -> br.Signals:
    defect = br.defects.spall(on="inner_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=1500.0, speed_rpm=1797.0, defects=defect)
    return br.simulate(scene, duration=0.05)


def text_of(path: Path) -> str:
    """The text of a page without scripts, styles and marks."""
    text = path.read_text(encoding="utf-8")
    text = re.sub(r"<(script|style)\b.*?</\1>", " ", text, flags=re.DOTALL)
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", text)).split())


def unpacked(page: str, name: str) -> str:
    """What stands compressed in a page, as Python's own reader of base 85 has it."""
    (packed,) = re.findall(f'<script type="text/plain" id="{name}">([^<]*)</script>', page)
    return zlib.decompress(base64.b85decode(packed.replace("/", "<"))).decode()


def test_a_run(out: br.Signals, tmp_path: Path) -> None:
    path = tmp_path / "report.html"
    out.report(path)
    text = text_of(path)
    eq = br.equilibrium(out.scene.replace({"defects": {}}))
    rates, life = br.fault_frequencies(out), br.rating_life(out.scene)
    found = out.features(columns=["housing.sensor.ay"])
    assert life.basic is not None
    for wanted in (
        f"{rates.bpfi:.4g}", f"{eq.outer_load.max():.0f}", f"{1e-6 * eq.inner_pressure.max():.0f}",
        f"{1e-6 * life.reference:.4g} million turns", f"{1e-6 * life.basic:.4g} million turns",
        words.number(found["housing.sensor.ay.rms"]),
        words.number(found["housing.sensor.ay.kurtosis"]),
        str(out.provenance.method), f"{out.stats.nfev}", "mirror symmetry", "1500 N on the inner ring",
        "1797 1/min", "spall: on the inner race of row 0",
        f"{out.defects['spall'].touched} of {out.defects['spall'].passes}",
    ):  # fmt: skip
        assert wanted in text, wanted
    whole = path.read_text(encoding="utf-8")
    library = unpacked(whole, "plotly-js")
    assert "plotly.js v" in library
    assert "plotly.js v" not in whole
    assert len(unpacked(whole, "figures")) > 10_000
    assert not re.search(r"<(script|link|img)[^>]*\b(src|href)=[\"']?https?:", whole)


def test_a_read_run_reports_the_same(out: br.Signals, tmp_path: Path) -> None:
    out.write_parquet(tmp_path / "out.parquet")
    out.report(tmp_path / "a.html")
    br.Signals.read_parquet(tmp_path / "out.parquet").report(tmp_path / "b.html")
    assert text_of(tmp_path / "a.html") == text_of(tmp_path / "b.html")


def test_it_begins_with_the_verdict(tmp_path: Path) -> None:
    """Of a record long enough, as the diagnosis of the shown column has it; else with what it lacks."""
    defect = br.defects.spall(on="inner_race", width_mm=2.2, edge_radius_mm=0.05)
    scene = br.bearing("6205", radial_load=60.0, speed_rpm=1797.0, defects=defect)
    out = br.simulate(scene, duration=0.8, fs=25_000.0)
    for column, words_ in (("outer.ay", "vertical acceleration"), ("outer.ax", "horizontal acc")):
        out.report(tmp_path / "r.html", columns=[column])
        begin, _, rest = (
            text_of(tmp_path / "r.html").removeprefix("6205 6205 ").partition("Simulated bearing")
        )
        found = br.diagnose(out, column=column)
        assert found.verdict == "damaged"
        assert begin.startswith(f"Verdict: damaged, inner race I{found.why[1:]}. Width ")
        assert f"rests on one signal, {words_}" in begin
        assert column in begin
        band = found.evidence["inner_race"].band
        assert (
            f"squared envelope of {band[0]:.0f} to {band[1]:.0f} Hz, where the verdict was decided"
            in rest
        )


def test_five_pictures_in_two_megabytes(out: br.Signals, tmp_path: Path) -> None:
    """Of a record of a second: what was simulated, signal, envelope, density, loads, in this order."""
    br.simulate(out.scene, duration=1.0).report(tmp_path / "r.html")
    assert (tmp_path / "r.html").stat().st_size < 2_000_000
    captions = re.findall(r"Figure \d: ([\w ]+)", text_of(tmp_path / "r.html"))
    assert [caption.split()[0] for caption in captions] == [
        "the",
        "signal",
        "spectrum",
        "power",
        "load",
    ]


def test_a_run_of_two_rows_has_the_verdict_on_both(tmp_path: Path) -> None:
    """What the diagnosis notes of the other row stands there, too."""
    out = br.simulate(br.presets.wheel_bearing(), duration=0.02)
    out.report(tmp_path / "r.html")
    begin = text_of(tmp_path / "r.html").partition(" samples at ")[0]
    assert "Verdict: undecided What would decide: a longer record" in begin
    assert "Rows 0 and 1 have the same orders" in begin


def test_columns_and_title(out: br.Signals, tmp_path: Path) -> None:
    out.report(tmp_path / "r.html", columns=["outer.ax", "inner.ay"], title="A <b> & c")
    text = text_of(tmp_path / "r.html")
    assert "Vibration: horizontal acceleration, outer ring" in text
    assert "Vibration: vertical acceleration, inner ring" in text
    assert text.startswith("A <b> & c")


def test_warnings_stand_on_the_page(wheel: br.Scene, tmp_path: Path) -> None:
    with pytest.warns(br.SceneWarning, match="density"):
        heavy = br.simulate(
            wheel.replace({"materials.balls.density": 2.0e5}), duration=0.001, rtol=1e-7
        )
    heavy.report(tmp_path / "r.html")
    assert "Warning: " + " ".join(heavy.warnings[0].split()) in text_of(tmp_path / "r.html")


def test_a_bearing_that_no_equilibrium_holds(tmp_path: Path) -> None:
    """A start that rolls needs none; the page says what it lacks."""
    scene = br.bearing("6205", radial_load=0.0, speed_rpm=1800.0).replace(
        {"gravity": [0.0, 0.0, 0.0]}
    )
    out = br.simulate(scene, duration=5e-4, start="rolling", settle=0.0)
    with pytest.raises(br.EquilibriumError):
        br.equilibrium(scene)
    out.report(tmp_path / "r.html")
    assert "no static solution" in text_of(tmp_path / "r.html")


def test_bad_arguments_leave_nothing(out: br.Signals, tmp_path: Path) -> None:
    before = set(tmp_path.iterdir())
    with pytest.raises(br.SceneError, match="html"):
        out.report(tmp_path / "r.pdf")
    with pytest.raises(br.SceneError, match=r"outer\.aq"):
        out.report(tmp_path / "r.html", columns=["outer.aq"])
    with pytest.raises(FileNotFoundError):
        out.report(tmp_path / "nowhere" / "r.html")
    assert set(tmp_path.iterdir()) == before


def test_without_plotly(out: br.Signals, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name: None if name == "plotly" else find(name)
    )
    with pytest.raises(br.SceneError, match=r"ballrace\[plot\]"):
        out.report(tmp_path / "r.html")


def test_a_campaign(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    table = br.grid({"loads.axial.force": [0.0, 3000.0, 1e7], "defects.spall.width": [0.0, 2e-3]})
    scene = br.presets.wheel_bearing()
    done = br.campaign(table, tmp_path / "runs", scene=scene, duration=0.03, columns=["outer.ay"])
    assert done.parameters == ("loads.axial.force", "defects.spall.width")
    mapped = []
    drawn = br.plot.campaign_map

    def remembered(part: pl.DataFrame, *others: str) -> go.Figure:
        mapped.append(part["fault_outer_race"].to_list())
        return drawn(part, *others)

    monkeypatch.setattr(br.plot, "campaign_map", remembered)
    done.report(tmp_path / "r.html", features=["outer.ay.rms"])
    assert sorted(map(set, mapped), key=str) == [{False}, {True}]
    text = text_of(tmp_path / "r.html")
    assert "2 of 6 cases failed" in text
    assert done.failed["message"][0][:30] in text
    over = "outer.ay.rms over loads.axial.force and defects.spall.width: the mean of the cases of each cell"
    assert f"{over}, where a loaded contact met a defect of the outer race" in text
    assert f"{over}, but for those where a loaded contact met" in text
    with pytest.raises(br.SceneError, match="features"):
        done.report(tmp_path / "r.html", features=["outer.rms"])


def test_demo_says_which_row_and_why(tmp_path: Path) -> None:
    cases = {k: demo.run_case(v, 0.03) for k, v in demo.AXIAL_LOADS.items()}
    demo.write(cases, tmp_path)
    text = text_of(tmp_path / "demo.html")
    none, towards, away = cases.values()
    low, high = none.spall
    row = none.out.scene.rows[0]
    assert (
        f"from {1e3 * (low - row.axial_position):.2f} to {1e3 * (high - row.axial_position):.2f} mm"
        in text
    )
    assert away.within < none.within < towards.within
    for case in cases.values():
        assert f"{case.within:.0f} N" in text
        healthy = case.out.scene.replace({"defects": {}})
        down = -np.pi / 2.0
        turned = {
            f"rows[{r}].start_angle": down + k.start_angle - row.start_angle
            for r, k in enumerate(healthy.rows)
        }
        eq = br.equilibrium(healthy.replace(turned))
        radial = eq.outer_load[0] * np.cos(eq.outer_angle[0])
        assert case.zone.force == pytest.approx(radial, rel=1e-3)
    assert "row 0" in text
    assert "Why" in text


def test_a_page_escapes_what_it_is_given() -> None:
    page = Page("<u>")
    page.section("<u>")
    page.text("<u>")
    page.warning("<u>")
    page.points(["<u>"])
    page.facts([("<u>", "<u>")])
    page.table(["<u>"], [["<u>"]])
    page.folded("<u>", "</pre><u>")
    assert "<u>" not in page.html()
    assert page.html().count("&lt;u&gt;") == 12


def test_a_scene_in_words() -> None:
    scene = br.presets.wheel_bearing()
    quiet = replace(scene, cage=None, friction="none")
    assert ("Cage", "none") in words.model(quiet)
    assert ("Friction", "none") in words.model(quiet)
    oil = br.scene.Lubricant.named("vg68", temperature_c=55.0)
    rows = dict(words.model(replace(quiet, lubricant=oil)))
    assert rows["Lubricant"] == "vg68 at 55 °C, with its film, damping, traction, rolling"
    assert "Lubricant" not in dict(words.model(quiet))
    assert [what for what, _ in words.bearing(scene)] == ["Row 0", "Row 1", "Defect"]


FIXED = br.scene.Support(x="fixed", y="fixed", z="fixed")
ODD: dict[str, dict[str, object]] = {
    "held": {
        "outer_ring.support": FIXED, "inner_ring.support": FIXED, "rows[0].clearance": -1e-5, "probes": {},
    },
    "torque": {"drive": br.scene.TorqueDrive(value=0.01, initial_speed=100.0)},
    "still": {"drive": br.scene.SpeedDrive(0.0)},
    "backwards": {"drive": br.scene.SpeedDrive(-188.0)},
    "varying": {"loads.radial.force": br.scene.Sine(mean=500.0, amplitude=100.0, frequency=10.0, phase=0.0)},
    "large balls": {"rows[0].ball_count": 6, "rows[0].ball_diameter": 0.0105, "name": "own"},
    "arch": {"rows[0].outer_arch": br.scene.GothicArch(shim_angle=0.3)},
}  # fmt: skip


NO_VERDICT = {
    "held": "no acceleration of a ring was recorded",
    "torque": "the speed is not constant",
    "still": "the rings do not turn against each other",
}


@pytest.mark.parametrize("name", ODD)
@pytest.mark.parametrize("duration", [4e-5, 0.02])
@pytest.mark.filterwarnings("ignore::ballrace.SceneWarning")
def test_every_scene_that_runs_has_a_report(name: str, duration: float, tmp_path: Path) -> None:
    # A seat moves a ring, which then cannot be held.
    scene = br.bearing("6205", housing=None if name == "held" else "pedestal", speed_rpm=1800.0)
    out = br.simulate(scene.replace(ODD[name]), duration=duration, settle=0.0)
    out.report(tmp_path / "r.html")
    text = text_of(tmp_path / "r.html")
    assert "Settings and effort of the simulation" in text
    why = NO_VERDICT.get(name, "record = an array of shape" if duration < 1e-3 else "")
    begin = f"No verdict: {why}" if why else "Verdict: undecided What would decide: a longer record"
    assert begin in text.partition(" samples at ")[0]
