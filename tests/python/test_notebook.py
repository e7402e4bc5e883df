"""What a notebook shows of each object: its numbers, every text escaped; progress of a single run."""

from __future__ import annotations

import io
import re
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace._base.html import waveform
from ballrace._base.progress import Bar

if TYPE_CHECKING:
    from collections.abc import Iterator

NOTEBOOKS = Path(__file__).parents[2] / "examples" / "notebooks"

EVIL = '<script>alert("a")</script>'


def shown(of: Any) -> str:
    """What a notebook asks for, well-formed as XML: no tag is left open, no text unescaped."""
    html = of._repr_html_()
    assert isinstance(html, str)
    ET.fromstring(f"<all>{html}</all>")
    return html


def drawn(html: str) -> Iterator[ET.Element]:
    for svg in re.findall(r"<svg.*?</svg>", html, re.DOTALL):
        yield ET.fromstring(svg)


def tags(svg: ET.Element, tag: str) -> list[ET.Element]:
    return [each for each in svg.iter() if each.tag.endswith(tag)]


def test_a_scene_is_drawn_with_its_balls_load_and_damage() -> None:
    spall = br.defects.spall(on="outer_race", width_mm=1.0, angle=np.radians(-90.0))
    made = br.bearing("6205", radial_load=800.0, defects=spall, speed_rpm=1800.0)
    (svg,) = drawn(shown(made))
    circles = [{k: float(c.get(k, "nan")) for k in ("cx", "cy", "r")} for c in tags(svg, "circle")]
    # In metres: the outside diameter of a 6205, nine balls on their pitch circle, the spall at the bottom.
    assert circles[0]["r"] == pytest.approx(26e-3)
    balls = [c for c in circles if c["r"] == pytest.approx(0.5 * 7.938e-3, rel=1e-3)]
    assert len(balls) == 9
    assert all(np.hypot(c["cx"], c["cy"]) == pytest.approx(0.5 * 39.04e-3, rel=0.02) for c in balls)
    assert circles[-1]["cy"] < -0.02
    (arrow,) = tags(svg, "line")
    assert float(arrow.get("y2", "0")) < 0.0
    assert [len(list(drawn(shown(br.presets.wheel_bearing()))))] == [2]


def test_a_scene_shows_its_doubts_or_why_it_is_refused() -> None:
    made = br.bearing("6205", speed_rpm=1800.0)
    assert "<li>" not in shown(made)
    odd = made.replace({"rows[0].clearance": 2e-3})
    assert len(re.findall("<li>", shown(odd))) == len(odd.doubts()) > 0
    broken = br.Scene(rows=(), drive=br.scene.SpeedDrive(1.0))
    assert "not usable: rows" in shown(broken)


def test_names_of_others_are_text() -> None:
    named = br.bearing("6205", speed_rpm=1800.0).replace({"name": EVIL})
    for of in (named, br.simulate(named, duration=1e-3), br.equilibrium(named)):
        assert "<script" not in shown(of)
    assert "<script" not in waveform(EVIL, EVIL, np.arange(3.0))


def test_an_equilibrium_is_a_line_a_ball() -> None:
    found = br.equilibrium(br.bearing("6205", radial_load=800.0, speed_rpm=1800.0))
    html = shown(found)
    assert html.count("<tr>") == 1 + 9
    assert f"{found.outer_load.max():.1f}" in html


def test_signals_are_waveforms_with_their_size(out: br.Signals) -> None:
    html = shown(out)
    assert f"RMS {np.sqrt(np.mean(out['outer.ay'] ** 2)):.3g}" in html
    assert len(list(drawn(html))) == 6
    assert f"and {len(out) - 6} more" in html


def test_a_waveform_keeps_every_peak() -> None:
    """One sample of a hundred thousand reaches the upper edge."""
    x = np.zeros(100_000)
    x[71_234] = 5.0
    (svg,) = drawn(waveform("a", "m/s^2", x))
    points = [p.split(",") for p in tags(svg, "polygon")[0].get("points", "").split()]
    tops = [int(t) for t, y in points if float(y) == 0.0]
    assert tops == [71_234 * 300 // 100_000]


def test_explanation_and_campaign(tmp_path: Path) -> None:
    scene = br.bearing("6205", speed_rpm=1800.0)
    explanation = br.explain(scene)
    assert str(explanation).splitlines()[0][:20] in shown(explanation)
    done = br.campaign(
        [{}, {}], tmp_path / "c", scene=scene, duration=1e-3, progress=False, keep="signals"
    )
    assert "2 ok" in done._repr_html_()
    assert "<table" in done._repr_html_()
    # A campaign keeps no units with its signals.
    run = done.run_of(done.manifest["case_id"][0])
    assert len(list(drawn(shown(run)))) == min(6, len(run))
    assert run.to_windows(10, columns="outer.ay").height == 5
    assert run.channel("outer.ay").unit == ""


def test_a_single_run_shows_its_progress_in_a_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    """A notebook's standard error is no terminal; it is known by its kernel."""
    silent = io.StringIO()
    with Bar("run", silent) as bar:
        bar.show(0.5)
    assert silent.getvalue() == ""
    # A library that only imports IPython makes no notebook of a program.
    ipython = ModuleType("IPython")
    shell = SimpleNamespace()
    monkeypatch.setattr(ipython, "get_ipython", lambda: shell, raising=False)
    monkeypatch.setitem(sys.modules, "IPython", ipython)
    with Bar("run", silent) as bar:
        bar.show(0.5)
    assert silent.getvalue() == ""
    shell.kernel = object()
    seen = io.StringIO()
    monkeypatch.setattr(sys, "stderr", seen)
    br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.02, progress=True)
    lines = seen.getvalue().split("\r")
    assert any("6205  [" in line and "%" in line for line in lines)
    assert lines[-1] == ""
    assert "\033" not in seen.getvalue()


@pytest.mark.long
@pytest.mark.parametrize("path", sorted(NOTEBOOKS.glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_run(path: Path, tmp_path: Path) -> None:
    nbformat = pytest.importorskip("nbformat", reason="nbformat is not installed")
    nbclient = pytest.importorskip("nbclient", reason="nbclient is not installed")
    pytest.importorskip("ipykernel", reason="ipykernel is not installed")
    notebook = nbformat.read(path, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    resources = {"metadata": {"path": str(tmp_path)}}
    nbclient.NotebookClient(notebook, timeout=300, resources=resources).execute()
    outputs = [o for cell in notebook.cells for o in cell.get("outputs", [])]
    assert any("text/html" in each.get("data", {}) for each in outputs)


def test_there_are_notebooks() -> None:
    names = {path.stem for path in NOTEBOOKS.glob("*.ipynb")}
    assert names == {"1_first_bearing", "2_data_set", "3_diagnosis"}
