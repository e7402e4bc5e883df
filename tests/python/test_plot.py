"""Pictures hold the numbers they are given."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from inspect import signature
from pathlib import Path
from typing import Literal

import numpy as np
import plotly.graph_objects as go
import plotly.io as pio
import polars as pl
import pytest
from plotly.subplots import make_subplots

import ballrace as br
from ballrace import plot
from ballrace.plot.ellipse import axis_ratio, semi_axes
from ballrace.plot.outlines import groove, outlines
from ballrace.plot.style import COLOURS


def test_signals(out: br.Signals) -> None:
    fig = plot.signals(out, ["outer.y", "outer.ay"], title="A run")
    np.testing.assert_array_equal(fig.data[1].y, out["outer.ay"])
    assert fig.layout.yaxis2.title.text == "m/s²"
    assert fig.layout.title.text == "A run"


def test_load_cases_share_their_scales(out: br.Signals) -> None:
    fig = plot.load_cases({"a": out, "b": out}, bpfo=157.0)
    assert fig.layout.yaxis2.matches == "y"
    assert fig.layout.xaxis.matches == "x2"
    assert fig.layout.xaxis.minor.dtick == 1.0 / 157.0
    assert [a.text for a in fig.layout.annotations] == ["a", "b"]
    assert fig.layout.xaxis2.title.text == "time / s"


def test_a_figure_of_the_caller(out: br.Signals) -> None:
    fig = make_subplots(rows=1)
    assert plot.signals(out, ["outer.ay"], fig=fig) is fig
    assert len(fig.data) == 1


def test_load_distribution(wheel: br.Scene) -> None:
    eq = br.equilibrium(wheel)
    fig = plot.load_distribution(eq)
    assert [trace.name for trace in fig.data] == ["row 0", "row 1"]
    np.testing.assert_array_equal(fig.data[0].r[:13], eq.outer_load[:13])
    both = plot.load_distribution({"a": eq, "b": eq})
    assert len(both.data) == 4
    assert both.layout.polar.radialaxis.range == both.layout.polar2.radialaxis.range


def test_one_name_is_a_column(out: br.Signals) -> None:
    fig = plot.signals(out, "outer.ay")
    assert [trace.name for trace in fig.data] == ["vertical acceleration, outer ring"]


@pytest.fixture(scope="module")
def faulty() -> br.Signals:
    """A spall of an outer race, with a ball that passes it."""
    defect = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=1000.0, defects=defect, speed_rpm=1800.0)
    ball = br.scene.MotionProbe(body="row0.ball0", components=("x", "y"))
    return br.simulate(scene.replace({"probes.ball": ball}), duration=0.1)


@pytest.fixture(scope="module")
def animated(wheel: br.Scene) -> br.Signals:
    ready = wheel.replace({"probes": br.plot.probes(wheel)})
    return br.simulate(ready, duration=0.004, settle=0.0)


def test_pictures_come_with_the_package_and_plotly_when_drawn() -> None:
    code = (
        "import sys, ballrace as br; heavy = {'plotly', 'scipy', 'polars'};"
        "assert not heavy & set(sys.modules); br.plot.CONFIG; assert 'plotly' not in sys.modules;"
        "br.plot.section(br.presets.wheel_bearing()); assert 'plotly' in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
    assert "plot" in br.__all__
    with pytest.raises(AttributeError, match="no attribute 'plots'"):
        br.plots  # type: ignore[attr-defined]  # noqa: B018


def test_a_missing_plotly_is_named_with_its_extra(tmp_path: Path) -> None:
    (tmp_path / "plotly.py").write_text("raise ImportError('none', name='plotly')")
    code = (
        "import sys; sys.path.insert(0, sys.argv[1]); import ballrace as br\n"
        "scene = br.bearing('6205', speed_rpm=1800.0)\n"
        "eq = br.equilibrium(scene); plot = br.plot\n"
        "for draw, of in ((plot.section, scene), (plot.unrolled, scene), (plot.load_distribution, eq)):\n"
        "    try: draw(of)\n"
        "    except ImportError as error: print(error.name, error)\n"
    )
    command = [sys.executable, "-c", code, str(tmp_path)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    needs = 'plotly a picture needs plotly (none): pip install "ballrace[plot]"'
    assert printed.splitlines() == [needs] * 3


Drawn = dict[str, Callable[..., go.Figure]]


@pytest.fixture(scope="module")
def drawn(faulty: br.Signals, wheel: br.Scene, out: br.Signals, animated: br.Signals) -> Drawn:
    eq = br.equilibrium(wheel)
    found = br.spectra.kurtogram(faulty["outer.ay"], faulty.fs, narrowest=2000.0)
    table = pl.DataFrame({"a": [1.0, 2.0], "b": [1.0, 1.0], "c": [3.0, 4.0]})
    return {
        "impacts": partial(plot.impacts, faulty),
        "envelope_spectrum": partial(plot.envelope_spectrum, faulty),
        "psd": partial(plot.psd, faulty),
        "spectrogram": partial(plot.spectrogram, faulty),
        "order_map": partial(plot.order_map, faulty, highest=5.0),
        "kurtogram": partial(plot.kurtogram, found),
        "orbit": partial(plot.orbit, faulty),
        "ball_path": partial(plot.ball_path, faulty),
        "section": partial(plot.section, wheel),
        "campaign_map": partial(plot.campaign_map, table, "a", "b", "c"),
        "distribution": partial(plot.distribution, table, "c"),
        "unrolled": partial(plot.unrolled, wheel, eq),
        "signals": partial(plot.signals, out, ["outer.y", "outer.ay"]),
        "load_cases": partial(plot.load_cases, {"a": out, "b": out}),
        "load_distribution": partial(plot.load_distribution, eq),
        "force_distribution": partial(plot.force_distribution, eq),
        "slice_forces": partial(plot.slice_forces, out),
        "animation": partial(plot.animation, animated, frames=3),
        "animation3d": partial(plot.animation3d, animated, frames=3),
    }


def test_each_is_drawn_here_and_listed(drawn: Drawn) -> None:
    """Every function that is public and draws: no new one is left out."""
    functions = {name for name in plot.__all__ if callable(getattr(plot, name))}
    draws = {name for name in functions if "layout" in signature(getattr(plot, name)).parameters}
    assert set(drawn) == draws
    assert set(re.findall(r":func:`(\w+)`", plot.__doc__ or "")) == draws | {"write"}


def test_each_draws_into_a_figure_and_takes_a_layout(drawn: Drawn) -> None:
    for name, draw in drawn.items():
        fig = draw(title="Own", height=333)
        assert (fig.layout.title.text, fig.layout.height) == ("Own", 333), name
        # A figure with as many panels.
        own = draw()
        own.data = ()
        again = draw(fig=own)
        assert again is own, name
        assert len(again.data) == len(fig.data) > 0, name
        titles = [a.title.text for a in fig.select_xaxes()] + [
            a.title.text for a in fig.select_yaxes()
        ]
        assert all(text is None or "_" not in text for text in titles), name


def test_impacts_stand_where_blows_are() -> None:
    """Truth: blows at known times."""
    fs, rates = 20_000.0, br.fault_frequencies("6205", 1797.0)
    t = np.arange(10_000) / fs
    since = (t - 0.002) % (1.0 / rates.bpfo)
    x = np.exp(-900.0 * since) * np.sin(2 * np.pi * 3000.0 * since)
    fig = plot.impacts(x, fs=fs, rates=rates, faults=["outer_race"])
    marks = np.asarray(fig.data[1].x)
    wanted = 0.002 + np.arange(-1, 60) / rates.bpfo
    away = np.abs(marks[:, None] - wanted).min(axis=1)
    assert away.max() < 1e-3  # the envelope's oscillation is highest a little after the blow begins
    np.testing.assert_allclose(np.diff(marks), 1.0 / rates.bpfo)
    assert fig.data[1].marker.symbol == "triangle-down"
    assert len(plot.impacts(x, fs=fs).data) == 1  # nothing is known of the bearing


@pytest.mark.filterwarnings("ignore:defects.*on = ball")
def test_fault_lines_stand_at_the_operating_angle() -> None:
    scene = br.bearing("6205", radial_load=300.0, axial_load=300.0, speed_rpm=1800.0)
    defect = br.defects.spall(on="ball", width_mm=0.5)
    out = br.simulate(scene.replace({"defects.d": defect}), duration=0.05)
    rates = br.fault_frequencies(out)
    fig = plot.envelope_spectrum(out, harmonics=2)
    lines = np.asarray(fig.data[1].x[::3], dtype=float)
    spin = rates.bsf / math.cos(rates.contact_angle)
    wanted = [k * spin + side * rates.ftf for k in (1, 2) for side in (-1, 0, 1)]
    np.testing.assert_allclose(lines, wanted)
    nominal = br.fault_frequencies(out, operating=False)
    assert abs(rates.bsf / nominal.bsf - 1.0) > 1e-3
    assert fig.data[1].line.dash == "dot"
    assert [a.text for a in fig.layout.annotations][1::3] == ["BSF/cos α", "2·BSF/cos α"]


@pytest.mark.filterwarnings("ignore:defects.*on = ball")
@pytest.mark.parametrize(("length_mm", "hits"), [(1.0, 1), (5.0, 2)])
def test_the_lines_of_a_ball_are_those_the_model_has(length_mm: float, hits: int) -> None:
    """Truth: the rate at which a ball of the run turned, once or twice of which its defect strikes."""
    scene = br.bearing("6205", radial_load=300.0, axial_load=300.0, speed_rpm=1800.0)
    offset: br.scene.AxialOffset = 0.0 if hits == 2 else "contact"
    defect = br.defects.spall(on="ball", width_mm=0.5, length_mm=length_mm, axial_offset=offset)
    ball = br.scene.MotionProbe(body="row0.ball0", components=("x", "y", "theta"))
    out = br.simulate(scene.replace({"defects.d": defect, "probes.ball": ball}), duration=0.2)
    late = out.t > 0.1
    orbit = np.unwrap(np.arctan2(out["ball.y"], out["ball.x"]))[late]
    turned = abs(np.polyfit(out.t[late], out["ball.theta"][late] - orbit, 1)[0]) / (2.0 * np.pi)
    fig = plot.envelope_spectrum(out, "outer.ay", harmonics=1, sidebands=0)
    assert fig.data[1].x[0] == pytest.approx(hits * turned, rel=0.01)
    # A measured bearing's balls tumble.
    rates = br.fault_frequencies(out)
    record = plot.envelope_spectrum(
        out["outer.ay"], fs=out.fs, rates=rates, faults=["ball"], harmonics=1, sidebands=0
    )
    assert record.data[1].x[0] == pytest.approx(2.0 * rates.bsf)
    assert record.layout.annotations[0].text == "2·BSF"


def test_no_two_faults_look_alike_without_colour(faulty: br.Signals) -> None:
    fig = plot.envelope_spectrum(faulty, faults=("outer_race", "inner_race", "ball", "cage"))
    lines = fig.data[1:]
    assert (
        len({line.line.dash for line in lines}) == len({line.marker.symbol for line in lines}) == 4
    )


def test_spectra_lie_over_each_other_in_one_figure(faulty: br.Signals) -> None:
    fig = plot.envelope_spectrum(faulty, faults=(), limit=400.0, name="one")
    fig = plot.envelope_spectrum(faulty, band=(2000.0, 8000.0), limit=400.0, name="two", fig=fig)
    fig = plot.envelope_spectrum(faulty, faults=(), limit=400.0, name="three", fig=fig)
    colours = {trace.name: trace.line.color for trace in fig.data if trace.mode == "lines"}
    assert list(colours.items()) == list(zip(("one", "two", "three"), COLOURS, strict=False))
    assert [trace.name for trace in fig.data[:2]] == ["one", "two"]
    assert fig.data[0].line.dash != fig.data[1].line.dash


def test_ellipses_are_those_of_hertz() -> None:
    """Truth: Brewe and Hamrock's fit of the axes, κ = 1.0339 (R_y/R_x)^0.636, within 3 % of the integrals."""
    for name in ("6205", "7205B", "6310"):
        row = br.bearing(name, speed_rpm=1800.0).rows[0]
        gamma = row.ball_diameter * np.cos(row.contact_angle) / row.pitch_diameter
        races: tuple[Literal["outer", "inner"], ...] = ("outer", "inner")
        for race, rolling, f in zip(
            races, (1 / (1 + gamma), 1 / (1 - gamma)), (row.outer_conformity, row.inner_conformity), strict=True
        ):  # fmt: skip
            fitted = 1.0339 * (rolling / (1.0 - 0.5 / f)) ** 0.636
            assert axis_ratio(row, race) == pytest.approx(fitted, rel=0.03)
    eq = br.equilibrium(br.bearing("6205", radial_load=2000.0, speed_rpm=1800.0))
    a, b = semi_axes(row, "inner", eq.inner_load, eq.inner_pressure)
    loaded = eq.inner_load > 0.0
    area = np.pi * a * b * eq.inner_pressure
    np.testing.assert_allclose(area[loaded], 1.5 * eq.inner_load[loaded])
    assert not a[~loaded].any()


def test_unrolled_has_the_contacts_in_their_places(wheel: br.Scene) -> None:
    eq = br.equilibrium(wheel)
    fig = plot.unrolled(wheel, eq)
    heaviest = int(np.argmax(np.where(eq.row == 0, eq.outer_load, 0.0)))
    text = f"{eq.outer_load[heaviest]:.0f} N"
    (ellipse,) = [
        d for d in fig.data if d.yaxis == "y" and (d.text or "").__str__().startswith(text)
    ]
    middle = 0.5 * (max(ellipse.y) + min(ellipse.y))
    row = wheel.rows[0]
    assert middle == pytest.approx(1e3 * (eq.outer_zone_centre[heaviest] - row.axial_position))
    angle = 0.5 * (max(ellipse.x) + min(ellipse.x))
    assert np.cos(np.radians(angle) - eq.angle[heaviest]) == pytest.approx(1.0)
    (box,) = [d for d in fig.data if str(d.text).startswith("spall")]
    assert (min(box.y), max(box.y)) == (pytest.approx(1.57), pytest.approx(3.07))


def test_section_has_the_contact_angles_of_the_model(wheel: br.Scene) -> None:
    """Row 0, side +1, touches its outer race towards +z, where its spall lies: on the groove, at the bottom."""
    fig = plot.section(wheel)
    spall = next(d for d in fig.data if d.line.width == 6)
    middle = float(np.mean(spall.x)) - 1e3 * wheel.rows[0].axial_position
    assert middle == pytest.approx(2.32, abs=0.02)
    assert max(spall.x) - min(spall.x) == pytest.approx(1.5)
    assert max(spall.y) < 0.0
    row = wheel.rows[0]
    reach = 1e3 * (0.5 * row.pitch_diameter + 0.5 * row.ball_diameter)
    assert -reach < min(spall.y) < -reach + 0.6
    dashed = [d for d in fig.data if d.line.dash == "dash"]
    assert dashed[0].x[1] > dashed[0].x[0]  # row 0, from inside to outside at the top
    assert dashed[2].x[1] < dashed[2].x[0]
    given = outlines(br.bearing("6205", speed_rpm=1800.0))
    assert (given.outside, given.bore, given.assumed) == (26.0, 12.5, False)
    assert outlines(wheel).assumed


def test_grooves_touch_the_balls_at_the_contact_angle() -> None:
    """Truth: without clearance ball and race share a point there, on either side."""
    rows = [*br.presets.wheel_bearing().rows, br.bearing("7205B", speed_rpm=1800.0).rows[0]]
    for row in rows:
        centre = np.array([1e3 * row.axial_position, 0.5e3 * row.pitch_diameter])
        angle = row.side * row.contact_angle
        out = 0.5e3 * row.ball_diameter * np.array([np.sin(angle), np.cos(angle)])
        np.testing.assert_allclose(groove(row, "outer", np.array([angle]))[0], centre + out)
        np.testing.assert_allclose(groove(row, "inner", np.array([-angle]))[0], centre - out)


def test_orbit_is_seen_from_the_outer_ring(faulty: br.Signals) -> None:
    relative, absolute = plot.orbit(faulty), plot.orbit(faulty, relative=False, skip=0.05)
    first = 1e6 * (faulty["inner.x"] - faulty["outer.x"])[0]
    assert relative.data[1].x[0] == pytest.approx(first)
    late = int(np.searchsorted(faulty.t, 0.05))
    assert absolute.data[1].y[0] == pytest.approx(1e6 * faulty["inner.y"][late])


def test_a_ball_dips_into_the_spall(faulty: br.Signals) -> None:
    fig = plot.ball_path(faulty)
    x, y = (np.asarray(values) for values in (fig.data[0].x, fig.data[0].y))
    inside = np.abs(x) < 0.5
    # It sinks by 11 µm; before, the housing's swing moves the race by 1.3.
    assert y[inside].max() > 8.0 > 4.0 * np.abs(y[x < -1.0]).max()
    with pytest.raises(br.SceneError, match="defect"):
        plot.ball_path(faulty, "scratch")


def test_frames_have_the_balls_where_the_run_has_them(animated: br.Signals) -> None:
    fig = plot.animation(animated, frames=5, title="T")
    assert len(fig.frames) == 5
    last = fig.frames[-1]
    ball = last.data[1]  # after the cage
    end = animated.n_samples - 1
    middle = 0.5 * (max(ball.x) + min(ball.x))
    assert middle == pytest.approx(1e3 * animated["row0_ball0.x"][end], abs=1e-3)
    size = max(ball.x) - min(ball.x)
    assert size == pytest.approx(1e3 * animated.scene.rows[0].ball_diameter, rel=1e-3)
    bars = next(d for d in last.data if d.name == "load")
    loads = [animated[f"row0.ball{b}.outer.load"][end] for b in range(13)]
    x, y = (np.asarray(values).reshape(13, 3) for values in (bars.x, bars.y))
    lengths = np.hypot(x[:, 1] - x[:, 0], y[:, 1] - y[:, 0])
    np.testing.assert_allclose(lengths / lengths.max(), loads / np.max(loads), atol=1e-3)
    assert last.traces == tuple(range(len(fig.data) - len(last.data), len(fig.data)))


def test_balls_of_the_section_keep_their_size(animated: br.Signals) -> None:
    """In each frame a ball a row at the top and at the bottom, as large as the row's balls."""
    fig = plot.animation(animated, frames=12)
    rows = animated.scene.rows
    for frame in fig.frames:
        cut = [
            t
            for t, of in zip(frame.data, fig.data[-len(frame.data) :], strict=True)
            if of.xaxis == "x2"
        ]
        widths = [float(np.ptp(t.x)) for t in cut]
        expected = [1e3 * row.ball_diameter for row in rows for _ in range(2)]
        np.testing.assert_allclose(widths, expected, rtol=1e-6)
        assert [float(np.mean(t.y)) > 0.0 for t in cut] == [True, False] * len(rows)


def test_rings_between_rows_are_steps() -> None:
    """Between rows that lie apart, what joins them runs along the axis or across it."""
    shaft = br.presets.motor()
    z = sorted(1e3 * row.axial_position for row in shaft.rows)
    for ring in (outlines(shaft).outer, outlines(shaft).inner):
        edges = np.stack([ring[:-1], ring[1:]], axis=1)
        middle = edges[:, :, 0].mean(axis=1)
        reach = 2e3 * max(row.ball_diameter for row in shaft.rows)
        between = edges[(middle > z[0] + reach) & (middle < z[1] - reach)]
        assert len(between) >= 3
        assert (np.abs(between[:, 0] - between[:, 1]).min(axis=1) < 1e-9).all()


def test_animations_stand_until_they_are_run(animated: br.Signals, tmp_path: Path) -> None:
    for fig in (plot.animation(animated, frames=3), plot.animation3d(animated, frames=3)):
        shown = pio.renderers["notebook"].to_mimebundle(fig.to_dict())["text/html"]
        fig.write_html(tmp_path / "page.html", include_plotlyjs=False)
        page = (tmp_path / "page.html").read_text(encoding="utf-8")
        for text in (shown, page, fig.to_html(include_plotlyjs=False)):
            assert "Plotly.addFrames" in text
            assert "Plotly.animate" not in text
        assert "Plotly.animate" in fig.to_html(include_plotlyjs=False, auto_play=True)


def test_the_best_band_has_power() -> None:
    """What a filter leaves above its edge is impulsive at times; of a constant there is no band at all."""
    fs, rng = 16_000.0, np.random.default_rng(1)
    t = np.arange(32_000) / fs
    passed = np.fft.rfft(rng.normal(size=t.size)) * (np.fft.rfftfreq(t.size, 1.0 / fs) < 3000.0)
    whisper = 3e-3 * np.sin(2.0 * np.pi * 6000.0 * t) * (t % 0.1 < 1e-3)
    found = br.spectra.kurtogram(np.fft.irfft(passed) + whisper, fs, narrowest=500.0)
    loudest = int(np.argmax(found.kurtosis))
    assert found.low[loudest] < 6000.0 < found.high[loudest]
    assert not found.has_power[found.low >= 3000.0].any()
    assert found.best[0] < 3000.0
    assert found.highest < 0.5
    assert found.kurtosis[loudest] > 2.0
    assert f"{found.highest:.2f}" in plot.kurtogram(found).layout.annotations[0].text
    silent = plot.kurtogram(np.full(2000, 0.1), fs=fs)
    assert silent.layout.annotations[0].text.startswith("no band has power")
    assert not silent.layout.shapes


def test_slices_of_a_run(out: br.Signals) -> None:
    fig = plot.slice_forces(out)
    assert out.slices is not None
    assert len(fig.data) == out.slices.select("time", "race").unique().height
    assert sum(fig.data[0].y) == pytest.approx(out.slices["force"][: len(fig.data[0].y)].sum())


def test_one_row_of_several_cases(wheel: br.Scene) -> None:
    loads = br.load_distribution(wheel, positions=2)
    fig = plot.load_distribution({"a": loads, "b": br.equilibrium(wheel)}, row=1)
    assert [(t.name, t.line.dash) for t in fig.data] == [("a", "solid"), ("b", "dash")]


def test_cases_at_random_are_points_and_those_of_a_grid_cells() -> None:
    """Truth: a Latin hypercube has no two cases with the same value: most cells of its grid are empty."""
    random = br.latin_hypercube({"a": (0.0, 1.0), "b": (10.0, 20.0)}, 30, seed=1)
    random = random.with_columns(c=pl.col("a") * pl.col("b"))
    (points,) = plot.campaign_map(random, "a", "b", "c", logarithmic=True).data
    assert (points.type, points.mode) == ("scatter", "markers")
    order = np.lexsort((points.y, points.x))
    expected = random.sort("a")
    np.testing.assert_allclose(np.array(points.x)[order], expected["a"])
    shades = np.array(points.marker.color)[order]
    np.testing.assert_allclose(shades, np.log10(expected["c"]))
    grid = pl.DataFrame({"a": [1.0, 2.0, 1.0], "b": [1.0, 1.0, 2.0], "c": [3.0, 4.0, 5.0]})
    (cells,) = plot.campaign_map(grid, "a", "b", "c").data
    assert cells.type == "heatmap"
    assert [list(line) for line in cells.text] == [["3", "4"], ["5", "–"]]


def test_bad_arguments_are_named(faulty: br.Signals, animated: br.Signals, wheel: br.Scene) -> None:
    x = faulty["outer.ay"]
    calls: dict[str, Callable[[], object]] = {
        "fs": lambda: plot.psd(x),
        "faults": lambda: plot.impacts(faulty, faults=["rollers"]),  # type: ignore[list-item]
        "rates": lambda: plot.impacts(x, fs=1e4, faults=["ball"]),
        "limit": lambda: plot.envelope_spectrum(faulty, limit=-1.0),
        "highest": lambda: plot.order_map(faulty, highest=0.0),
        "skip": lambda: plot.orbit(faulty, skip=1.0),
        "cases": lambda: plot.slice_forces(faulty),
        "row": lambda: plot.load_distribution(br.equilibrium(wheel), row=2),
        "loads": lambda: plot.load_distribution(wheel),  # type: ignore[arg-type]
        "frames": lambda: plot.animation(animated, frames=1),
        "start": lambda: plot.animation(animated, start=1.0),
        "out": lambda: plot.animation(faulty),
        "column": lambda: plot.campaign_map(pl.DataFrame({"a": [1.0]}), "a", "b", "a"),
    }
    for path, call in calls.items():
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == path
    with pytest.raises(KeyError, match=r"outer\.aq"):
        plot.psd(faulty, "outer.aq")


@pytest.mark.parametrize(
    ("picture", "field", "allowed"),
    [
        (plot.orbit, "out", "a run, as ballrace.simulate returns it, or a record"),
        (plot.ball_path, "out", "a run, as ballrace.simulate returns it"),
        (plot.animation, "out", "a run, as ballrace.simulate returns it"),
        (plot.animation3d, "out", "a run, as ballrace.simulate returns it"),
        (partial(plot.signals, names="DE"), "out", "a run, as ballrace.simulate returns it, or a record"),
        (plot.load_cases, "cases", "runs by the titles of panels"),
        (plot.slice_forces, "cases", "a run, as ballrace.simulate returns it, or tables of slices"),
        (plot.section, "scene", "a Scene"),
        (plot.unrolled, "scene", "a Scene"),
        (plot.load_distribution, "loads", "what ballrace.equilibrium"),
        (plot.force_distribution, "balls", "what ballrace.equilibrium returns"),
    ],
)  # fmt: skip
def test_what_is_no_run_is_refused_by_name(
    faulty: br.Signals, tmp_path: Path, picture: Callable[..., object], field: str, allowed: str
) -> None:
    """A measurement of a run, its signal, a record from a file, an array: the message names it and what may be."""
    path = tmp_path / "record.csv"
    path.write_text("DE\n" + "0.0\n1.0\n" * 50, encoding="utf-8")
    measured, read = br.measure(faulty), br.read(path, fs=1e4)
    takes_records = field == "out" and allowed.endswith("or a record")
    for given in (measured, measured.channel(), np.zeros(100), *([] if takes_records else [read])):
        with pytest.raises(br.SceneError) as caught:
            picture(given)
        assert str(caught.value).startswith(f"{field} = a {type(given).__name__}: {allowed}")
    if picture is plot.orbit:
        with pytest.raises(br.SceneError, match=r"no column inner\.x"):
            picture(read)


def test_cases_that_are_no_runs_are_refused_by_title(faulty: br.Signals) -> None:
    measured = br.measure(faulty)
    for draw in (plot.load_cases, plot.slice_forces):
        with pytest.raises(br.SceneError) as caught:
            draw({"worn": measured})  # type: ignore[dict-item]
        assert caught.value.path == "cases['worn']"
        assert "a Measurement: a " in str(caught.value)


def test_defects_are_drawn_where_a_run_has_them() -> None:
    """Truth: the scene that a run gives back, whose defects are placed."""
    spall = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=1500.0, axial_load=800.0, speed_rpm=1800.0)
    scene = scene.replace({"defects.spall": spall})
    ran = br.simulate(scene, duration=1e-4, settle=0.0)
    simulated = 1e3 * ran.defects["spall"].axial_offset
    assert simulated > 1.0
    assert scene.placed().defects == ran.scene.defects
    (box,) = (
        trace for trace in plot.unrolled(scene).data if (trace.text or "").startswith("spall")
    )
    assert 0.5 * (min(box.y) + max(box.y)) == pytest.approx(simulated)
    thick = next(trace for trace in plot.section(scene).data if trace.line.width == 6)
    assert thick.x[10] == pytest.approx(simulated)


def test_a_page_of_one_figure_is_whole(tmp_path: Path, wheel: br.Scene) -> None:
    plot.write(plot.section(wheel), tmp_path / "section.html")
    text = (tmp_path / "section.html").read_text(encoding="utf-8")
    assert "plotly.js v" in text
    assert not re.search(r"<script[^>]*\ssrc=", text)
    assert '"displaylogo": false' in text
    with pytest.raises(FileNotFoundError):
        plot.write(plot.section(wheel), tmp_path / "nowhere" / "section.html")


def test_marks_of_many_hits_are_thinned() -> None:
    """Of 300 hits in a second every third is marked, and the legend says so."""
    rates = br.fault_frequencies(
        br.bearing("6205", speed_rpm=1800.0), 300.0 / br.catalogue["6205"].orders.bpfo * 60.0
    )
    x = np.random.default_rng(1).normal(size=6000)
    marks = br.plot.impacts(x, fs=6000.0, rates=rates, faults=["outer_race"]).data[1]
    assert len(marks.x) == 100
    assert marks.name.endswith("every 3 hits")
    np.testing.assert_allclose(np.diff(marks.x), 3.0 / rates.bpfo)


def test_a_picture_is_written_as_its_ending_says(tmp_path: Path) -> None:
    pytest.importorskip("kaleido", reason="kaleido is not installed")
    if not any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))):
        pytest.skip("there is no browser in which kaleido draws")
    fig = br.plot.section(br.bearing("6205", speed_rpm=1800.0))
    br.plot.write(fig, tmp_path / "section.png")
    br.plot.write(fig, tmp_path / "section.svg")
    assert (tmp_path / "section.png").read_bytes().startswith(b"\x89PNG")
    assert b"<svg" in (tmp_path / "section.svg").read_bytes()


def test_a_picture_without_kaleido_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "kaleido", None)
    with pytest.raises(ImportError, match=r'pip install "ballrace\[image\]"'):
        br.plot.write(
            br.plot.section(br.bearing("6205", speed_rpm=1800.0)), tmp_path / "section.png"
        )
    assert list(tmp_path.iterdir()) == []


def test_a_bearing_stands_for_rates_of_a_measured_record() -> None:
    """Truth: the lines of the rates themselves."""
    record = br.Recording(np.random.default_rng(1).normal(size=4000), fs=4000.0, shaft=29.95)
    rates = br.fault_frequencies("6205", 1797.0)
    for draw in (br.plot.envelope_spectrum, br.plot.impacts):
        wanted = draw(record, rates=rates)
        assert draw(record, bearing="6205") == wanted
        array = draw(record["x"], fs=4000.0, bearing="6205", speed_rpm=1797.0)
        assert (array.data[1:], array.layout.shapes) == (wanted.data[1:], wanted.layout.shapes)
        with pytest.raises(br.SceneError, match="rates = given: None beside a bearing"):
            draw(record, bearing="6205", rates=rates)
        with pytest.raises(br.SceneError, match="bearing = None: a bearing beside speed_rpm"):
            draw(record, speed_rpm=1797.0)
    angle = 2.0 * np.pi * 29.95 * record.t
    wanted = br.plot.order_map(record, angle, rates=rates, faults=["inner_race"])
    found = br.plot.order_map(record, angle, bearing="6205", faults=["inner_race"])
    of = [line.y0 for line in wanted.layout.shapes]
    assert [line.y0 for line in found.layout.shapes] == pytest.approx(of)


def test_unknown_arguments_are_refused_by_name() -> None:
    with pytest.raises(br.SceneError, match=r"speed = 1797\.0: an argument of this picture"):
        br.plot.psd(np.random.default_rng(1).normal(size=4000), fs=4000.0, speed=1797.0)
    fig = br.plot.psd(
        np.ones(4000), fs=4000.0, title_text="title", xaxis_type="log", yaxis={"type": "log"}
    )
    assert (fig.layout.title.text, fig.layout.xaxis.type) == ("title", "log")
