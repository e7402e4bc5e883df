"""A measured record beside the run: its envelope, and the verdict on it."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import spectra
from ..diagnosis import diagnose
from ..errors import FileError
from ..recordings import Recording, read
from ..recordings.reading import key_of
from ..recordings.titles import TIME_UNITS
from .sensor import envelope
from .settings import outer_speed_of, speed_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    import plotly.graph_objects as go

    from ..channel import Channel
    from ..diagnosis import Diagnosis
    from ..frequencies.operating import FaultFrequencies
    from ..scene import Scene

__all__ = ["TIME_UNITS", "Dropped", "judged", "left_out", "overlaid", "received", "said_by"]


_SHOWN = 600.0
"""Highest frequency that is shown of a record without a run [Hz]."""


_LONGEST = 2_000_000
"""Samples of a record that are judged, from its beginning: a verdict on them takes some 10 s and 1 GB."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Dropped:
    """A file that was dropped, read.

    Attributes
    ----------
    name : str
        Its name.
    record : Recording
        What it holds.
    """

    name: str
    record: Recording


def received(name: str, contents: bytes, fs: float | None = None, **said: Any) -> Dropped:
    """Read a dropped file in a child process, within limits.

    What the file does not say itself is given: ``fs`` [Hz], and other arguments of :func:`ballrace.read`.

    Raises
    ------
    SceneError
        The rate is missing, or differs from that of the file.
    FileError
        It is damaged or no record.
    """
    suffix = Path(name).suffix
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"record{suffix}"
        path.write_bytes(contents)
        try:
            record = read(path, fs, **said)
        except FileError as error:
            # The reader knows the copy alone.
            raise FileError(name, str(error).replace(str(path), name)) from error
    return Dropped(name=name, record=replace(record, source=name))


def said_by(values: Mapping[str, Any]) -> dict[str, Any]:
    """Return what the controls about a file say, as arguments of :func:`ballrace.read`; nothing of empty ones.

    Columns, and those of times, are names or places with commas between them; the time ``none`` is no column.
    """
    said: dict[str, Any] = {name: values[name] or None for name in ("skip", "decimal", "time_unit")}
    for name in ("columns", "time"):
        keys = [key_of(text) for text in values[name].split(",") if text.strip()]
        said[name] = keys or None
    if said["time"] == ["none"]:
        said["time"] = False
    return said


def judged(
    dropped: Dropped,
    column: str,
    scene: Scene,
    *,
    speed_rpm: float | None,
    unit: str | None,
) -> tuple[Channel, Diagnosis]:
    """Return the beginning of the record's channel, and the verdict on it for the bearing of a scene.

    The speed is by default that of the file, or that of the scene [1/min]; the unit counts where the file
    does not have it.

    Raises
    ------
    SceneError
        An argument is not usable, or the speed is missing.
    """
    whole = dropped.record.channel(column)
    channel = replace(whole, x=whole.x[:_LONGEST])
    if unit is not None and not channel.unit:
        channel = replace(channel, unit=unit)
    if channel.unit == "g":
        channel = channel.to("m/s^2")
    healthy = scene.replace({"defects": {}})
    if speed_rpm is not None and outer_speed_of(scene) is not None and speed_of(scene) == 0.0:
        # That of the ring which alone turns.
        return channel, diagnose(channel, healthy, 0.0, outer_rpm=speed_rpm)
    speed = speed_rpm if speed_rpm is not None or channel.shaft is not None else speed_of(scene)
    return channel, diagnose(channel, healthy, speed)


def left_out(dropped: Dropped, judged: Channel) -> str:
    """Return what of a record was too long to be judged, in words; empty if nothing was."""
    total = dropped.record.n_samples
    if judged.n_samples == total:
        return ""
    seconds, all_of_it = judged.n_samples / judged.fs, total / judged.fs
    return f"Judged are the first {seconds:.3g} s of the record's {all_of_it:.4g} s; br.diagnose takes all of it."


def overlaid(
    simulated: Channel | None,
    measured: Channel,
    rates: FaultFrequencies | None,
    found: Diagnosis,
) -> go.Figure:
    """Return both envelopes in the band that decided the verdict, each over its own largest line.

    A machine lies between a simulated ring and a sensor: places of lines are compared, not heights. Without a run
    the measured one stands alone.
    """
    from ..plot import envelope_spectrum

    rate = measured.fs if simulated is None else min(simulated.fs, measured.fs)
    band = _band(found, rate)
    first = None if simulated is None else envelope(_levelled(simulated, band), rates)
    end = None if first is None else first.layout.xaxis.range[1]
    beside = _levelled(measured, band)
    return envelope_spectrum(
        beside, faults=(), name="measured", fig=first, limit=end or _SHOWN, band=band
    )


def _band(found: Diagnosis, fs: float) -> tuple[float, float] | None:
    parts = [one for one in found.evidence.values() if one.part != "cage"]
    band = max(parts, key=lambda one: one.z).band if parts else None
    return band if band is not None and band[1] <= 0.5 * fs else None


def _levelled(channel: Channel, band: tuple[float, float] | None) -> Channel:
    """Return a signal so scaled that the largest line of its squared envelope is 1."""
    f, value = spectra.envelope_spectrum(channel.x, channel.fs, band)
    largest = float(value[f > 0.0].max(initial=0.0)) or 1.0
    return replace(channel, x=channel.x / largest**0.5, unit="")
