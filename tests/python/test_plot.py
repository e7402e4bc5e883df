"""Pictures hold the numbers they are given."""

from __future__ import annotations

import numpy as np
from plotly.subplots import make_subplots

import ballrace as br
from ballrace import plot


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
