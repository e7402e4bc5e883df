"""Pages work in a real browser without network, on a phone and on a screen, and say nothing to its console."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import ballrace as br
from ballrace import demo, paper
from ballrace.report import Page
from ballrace.spectra.bands import Fault
from browser import Browser, opened

pytestmark = pytest.mark.filterwarnings("ignore::ballrace.SceneWarning")

PAGES = (
    "run",
    "run-up",
    "short",
    "angular",
    "campaign",
    "demo",
    "paper",
    "pictures",
    "animation",
    "hostile",
)
WIDTHS = (390, 1400)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with opened() as found:
        yield found


@pytest.fixture(scope="module")
def pages(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write every kind of page; after the browser, so that none is made for nothing."""
    folder = tmp_path_factory.mktemp("pages")
    faulty = br.bearing(
        "6205",
        radial_load=1500.0,
        defects=br.defects.spall(on="inner_race", width_mm=1.0),
        speed_rpm=1800.0,
    )
    ball = br.scene.MotionProbe(body="row0.ball0", components=("x", "y"))
    out = br.simulate(faulty.replace({"probes.ball": ball}), duration=0.1)
    out.report(folder / "run.html")
    speed = br.scene.SpeedDrive(br.scene.Ramp(from_=60.0, to=200.0, start=0.0, end=0.2))
    rising = br.simulate(faulty.replace({"drive": speed}), duration=0.2)
    rising.report(folder / "run-up.html")
    br.simulate(br.presets.wheel_bearing(), duration=0.001).report(folder / "short.html")
    br.simulate(br.bearing("7205B", speed_rpm=1800.0), duration=0.03).report(
        folder / "angular.html"
    )
    hostile = faulty.replace(
        {"name": '</script><script>console.error("in")</script>', "defects": {}}
    )
    br.simulate(hostile, duration=0.01).report(folder / "hostile.html", title='<img src="x.png">')
    _campaign(folder)
    demo.write({k: demo.run_case(v, 0.03) for k, v in demo.AXIAL_LOADS.items()}, folder)
    paper.write(paper.run(duration=0.035), folder)
    _pictures(out, rising, folder)
    wheel = br.presets.wheel_bearing(3000.0)
    ready = wheel.replace({"probes": br.plot.probes(wheel)})
    moving = br.plot.animation(br.simulate(ready, duration=0.01), frames=12)
    br.plot.write(moving, folder / "animation.html")
    return folder


def _campaign(folder: Path) -> None:
    table = br.grid(
        {"loads.axial.force": [-3000.0, 3000.0, 1e7], "defects.spall.width": [0.0, 2e-3]}
    )
    done = br.campaign(
        table,
        folder / "runs",
        scene=br.presets.wheel_bearing(),
        duration=0.03,
        columns=["outer.ay"],
    )
    done.report(folder / "campaign.html")


def _pictures(out: br.Signals, rising: br.Signals, folder: Path) -> None:
    """All kinds of pictures on one page."""
    wheel = br.presets.wheel_bearing(3000.0)
    balls = br.scene.MotionProbe(body="row0.ball0", components=("x", "y"))
    probe = br.scene.SlicesProbe(balls=(1,), races=("outer",), times=(0.0, 2e-4))
    dipping = br.simulate(wheel.replace({"probes.b": balls, "probes.s": probe}), duration=0.03)
    everything: tuple[Fault, ...] = ("outer_race", "inner_race", "ball", "cage")
    page = Page("Pictures")
    for fig in (
        br.plot.section(wheel, operating=True),
        br.plot.impacts(out, faults=everything),
        br.plot.envelope_spectrum(out, faults=everything),
        br.plot.psd(out, band=(2000.0, 6000.0)),
        br.plot.spectrogram(out),
        br.plot.order_map(rising),
        br.plot.kurtogram(br.spectra.kurtogram(out["outer.ay"], out.fs, narrowest=1000.0)),
        br.plot.load_distribution(
            {"at rest": br.equilibrium(wheel), "around": br.load_distribution(wheel)}
        ),
        br.plot.unrolled(wheel),
        br.plot.slice_forces(dipping),
        br.plot.orbit(out),
        br.plot.ball_path(dipping),
        br.plot.signals(out, ["outer.ax", "outer.ay"]),
    ):
        page.figure(fig, "a picture.")
    (folder / "pictures.html").write_text(page.html(), encoding="utf-8")


@pytest.mark.parametrize("width", WIDTHS)
@pytest.mark.parametrize("name", PAGES)
def test_page(browser: Browser, pages: Path, name: str, width: int) -> None:
    path = pages / f"{name}.html"
    with browser.page(path, width) as (page, seen):
        assert seen.console == []
        assert [
            url for url in seen.requests if not url.startswith(("file:", "data:", "blob:"))
        ] == []
        assert [url for url in seen.requests if url.startswith("file:")] == [path.as_uri()[:100]]
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        figures = page.query_selector_all(".plotly-graph-div")
        assert figures
        for figure in figures:
            box = figure.bounding_box()
            assert 200 < box["width"] <= width
            assert box["height"] > 200
            assert figure.query_selector_all(".main-svg path, .main-svg image")
        assert page.query_selector_all(".modebar .plotlyjsicon") == []
        buttons = page.eval_on_selector_all(
            ".modebar-btn", "all => all.map(b => b.dataset.title || '')"
        )
        assert not [b for b in buttons if "cloud" in b.lower() or "studio" in b.lower()]


def test_titles_are_words(browser: Browser, pages: Path) -> None:
    """No name of a column or a field stands at an axis."""
    for name in ("run", "campaign", "demo", "pictures"):
        with browser.page(pages / f"{name}.html", 1400) as (page, _):
            titles = page.eval_on_selector_all(
                ".xtitle, .ytitle, .cbtitle text", "all => all.map(t => t.textContent)"
            )
            assert titles
            assert not [
                t for t in titles if any(c in t for c in ("_", "outer.", "loads.", "defects."))
            ]


def test_animation_moves(browser: Browser, pages: Path) -> None:
    """The balls go round when the button is pressed, and stand when the page has just opened."""
    first = "() => Array.from(document.querySelector('.plotly-graph-div').data.at(-1).x)[0]"
    with browser.page(pages / "animation.html", 1400) as (page, seen):
        assert page.evaluate(first) == 0.0
        page.click("text=run")
        page.wait_for_function(
            "document.querySelector('.plotly-graph-div').data.at(-1).x[0] > 5", timeout=10_000
        )
        assert seen.console == []
