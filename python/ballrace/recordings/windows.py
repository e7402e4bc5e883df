"""Windows of a record as a table, with a row for each window and its metadata."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.arguments import whole_text
from .._base.libraries import pl
from .._base.numbers import counted
from ..errors import SceneError

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .samples import Samples

Entries = list[dict[str, Any]] | None
"""Entries of a nested column; None where nothing is known."""


def _unknown(_time: float) -> Any:
    return None


@dataclass(frozen=True, kw_only=True)
class Origin:
    """Origin of samples, as far as it is known; by default nothing.

    Attributes
    ----------
    speed : function of a time [s]
        Speed of the inner ring [rad/s].
    load : function of a time [s]
        Loads: ``name``, ``ring``, ``direction``, ``force`` [N].
    geometry : list of dict or None
        Rows: ``ball_count``, ``ball_diameter`` [m], ``pitch_diameter`` [m], ``contact_angle`` [rad].
    defect : list of dict or None
        Defects: ``name``, ``on``, ``row``, ``ball``, ``angle`` [rad], ``width`` [m], ``length`` [m].
    version : str or None
        The version of this package that simulated it.
    """

    speed: Callable[[float], float | None] = field(default=_unknown)
    load: Callable[[float], Entries] = field(default=_unknown)
    geometry: Entries = None
    defect: Entries = None
    version: str | None = None

    @property
    def label(self) -> str | None:
        """Name of what is damaged."""
        if self.defect is None:
            return None
        return "+".join(sorted({str(defect["on"]) for defect in self.defect})) or "healthy"

    def later(self, start: float) -> Origin:
        """Return what is known of samples whose first one is at a time [s]."""
        speed, load = self.speed, self.load
        return replace(self, speed=lambda t: speed(t + start), load=lambda t: load(t + start))


def windows(
    samples: Samples,
    origin: Origin,
    length: int,
    hop: int | None,
    *,
    label: str | None,
    bearing_id: str | int | None,
) -> pl.DataFrame:
    """Return the table that :meth:`Columns.to_windows` describes."""
    count = samples.n_samples
    length = counted("length", length, 1, count)
    hop = length if hop is None else counted("hop", hop, 1)
    _check_labels(label, bearing_id)
    assert samples.fs is not None
    starts = np.arange(0, count - length + 1, hop)
    middles = ((starts + length / 2) / samples.fs).tolist()
    rows = len(starts)
    kind = pl.String if bearing_id is None else None
    nested = {
        "load": [origin.load(at) for at in middles],
        "geometry": [origin.geometry] * rows,
        "defect": [origin.defect] * rows,
    }
    return pl.DataFrame(
        {
            **{name: _pieces(name, x, length, hop) for name, x in samples.columns.items()},
            "start": starts / samples.fs,
            "label": pl.Series([origin.label if label is None else label] * rows, dtype=pl.String),
            "bearing_id": pl.Series([bearing_id] * rows, dtype=kind),
            "speed": pl.Series([origin.speed(at) for at in middles], dtype=pl.Float64),
            **{name: pl.Series(nested[name], dtype=kind) for name, kind in _types().items()},
            "sampling_rate": [samples.fs] * rows,
            "units": [{name: samples.units.get(name, "") for name in samples.columns}] * rows,
            "version": pl.Series([origin.version] * rows, dtype=pl.String),
        }
    )


def _check_labels(label: object, bearing_id: object) -> None:
    if not isinstance(label, str | None):
        raise SceneError("label", repr(label), "text, or None")
    for name, given in (("label", label), ("bearing_id", bearing_id)):
        if isinstance(given, str):
            whole_text(name, given)
    if isinstance(bearing_id, bool) or not isinstance(bearing_id, str | int | np.integer | None):
        raise SceneError("bearing_id", repr(bearing_id), "text, a whole number, or None")


def _pieces(name: str, x: NDArray[np.float64], length: int, hop: int) -> pl.Series:
    largest = np.abs(x).max(initial=0.0, where=np.isfinite(x))
    if largest > np.finfo(np.float32).max:
        raise SceneError(name, f"{largest:.3g}", "a signal within 3.4e38: windows are float32")
    view = np.lib.stride_tricks.sliding_window_view(x, length)[::hop]
    return pl.Series(values=view.astype(np.float32))


def _types() -> dict[str, Any]:
    """Return the types of the nested columns, which the first rows need not show."""
    number, text, whole = pl.Float64, pl.String, pl.Int64
    geometry = dict.fromkeys(("ball_diameter", "pitch_diameter", "contact_angle"), number)
    sizes = dict.fromkeys(("angle", "width", "length"), number)
    fields: dict[str, dict[str, Any]] = {
        "load": {"name": text, "ring": text, "direction": pl.List(number), "force": number},
        "geometry": {"ball_count": whole, **geometry},
        "defect": {"name": text, "on": text, "row": whole, "ball": whole, **sizes},
    }
    return {name: pl.List(pl.Struct(of_entry)) for name, of_entry in fields.items()}
