"""The signals of a report: over time, their spectra, and their features."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..channel import default_column
from ..errors import BallraceError, SceneError
from ..plot.decimation import min_max
from ..scene.turning import relative_speed
from . import words

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import plotly.graph_objects as go

    from ..signals import Signals
    from .page import Page

_SHORT = 512
"""Samples below which spectra say nothing."""


def chosen(out: Signals, columns: Sequence[str] | None) -> tuple[str, ...]:
    """Return the columns that a report shows: those asked for, or one acceleration.

    Raises
    ------
    SceneError
        A column was not recorded.
    """
    for name in columns or ():
        if name not in out:
            raise SceneError("columns", repr(name), f"some of {', '.join(out.names)}")
    if columns is not None:
        return tuple(columns)
    accelerations = [name for name in out.names if out.units[name] == "m/s^2"]
    preferred = [name for name in (default_column(out.names), "inner.ay") if name in accelerations]
    return tuple((preferred or accelerations or list(out.names))[:1])


def add_signal(
    page: Page, out: Signals, name: str, decided: tuple[float, float] | None = None
) -> None:
    """Add a signal over time with expected hits, its envelope spectrum with lines, and its spectral density.

    The envelope is of the band in which a verdict was decided [Hz], else of all frequencies.
    """
    from .. import plot
    from ..plot.style import words as in_words

    page.section(f"Vibration: {in_words(name)}")
    speed = relative_speed(out.scene)
    if speed is None:
        page.figure(_thinned(plot.signals(out, name)), "signal over time; the speed changes.")
        _add_order_map(page, out, name)
        return
    if out.n_samples < _SHORT:
        page.figure(_thinned(plot.signals(out, name)), "signal over time.")
        page.text(f"{out.n_samples} samples are too few for spectra.")
        return
    hits = "marks where a defect is expected to be hit, a period apart at the contact angle under load."
    page.figure(_thinned(plot.impacts(out, name)), f"signal over time; {hits}")
    turns = out.n_samples / out.fs * abs(speed) / (2.0 * math.pi)
    of = (
        "of all frequencies"
        if decided is None
        else f"of {decided[0]:.0f} to {decided[1]:.0f} Hz, where the verdict was decided"
    )
    page.figure(
        plot.envelope_spectrum(out, name, band=decided),
        f"spectrum of the squared envelope {of}, over {turns:.1f} turns of the shaft, with the lines of defects.",
    )
    page.figure(_thinned(plot.psd(out, name, band=decided)), "power spectral density.")


def _thinned(fig: go.Figure) -> go.Figure:
    """Leave each line of a figure no more points than paper and screens show."""
    for line in fig.data:
        if line.mode == "lines":
            line.x, line.y = min_max(np.asarray(line.x), np.asarray(line.y))
    return fig


def _add_order_map(page: Page, out: Signals, name: str) -> None:
    from .. import plot

    try:
        fig = plot.order_map(out, column=name)
    except (BallraceError, KeyError) as error:
        page.text(f"No order map: {error}.")
        return
    page.figure(
        fig,
        "orders of the squared envelope over the turns of the shaft, with those of the defects.",
    )


_FEATURES = {
    "rms": "root mean square", "peak": "peak", "crest_factor": "crest factor", "kurtosis": "kurtosis",
}  # fmt: skip
_LINES = {"ftf": "FTF", "bpfo": "BPFO", "bpfi": "BPFI", "2bsf": "2·BSF"}


def add_features(page: Page, out: Signals, names: Sequence[str]) -> None:
    """Add the features of the chosen columns, as a campaign's table has them."""
    from ..plot.style import unit

    accelerations = [name for name in names if out.units[name] == "m/s^2"]
    if not accelerations:
        return
    page.section("Characteristic values")
    found = out.features(columns=accelerations)
    for name in accelerations:
        shape = [(what, _with_error(found, f"{name}.{key}")) for key, what in _FEATURES.items()]
        page.facts([("column", f"{name}, {unit(out.units[name])}"), *shape])
        rows = []
        for row in range(len(out.scene.rows)):
            for key, what in _LINES.items():
                stem = f"{name}.row{row}.{key}"
                tails = ("", "_harmonics", "_envelope", "_envelope_harmonics")
                if any(stem + tail in found for tail in tails):
                    rows.append(
                        [f"row {row}, {what}", *(_with_error(found, stem + tail) for tail in tails)]
                    )
        header = ["line at", "signal", "with harmonics", "squared envelope", "with harmonics"]
        if rows:
            page.table(header, rows)
    if found["batches"]:
        page.text(
            "Behind ± stands the standard error: what another run of the same length may give."
        )


def _with_error(found: Mapping[str, float | None], name: str) -> str:
    """Return a feature, with its standard error where there is one."""
    error = found.get(f"{name}_se")
    return words.with_error(found.get(name), error)
