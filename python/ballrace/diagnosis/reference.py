"""A record beside an earlier one of the same machine."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..channel import channel_of
from ..errors import SceneError
from .arguments import checked_channel
from .drift import without_drift
from .null import ACCUSED
from .severity import severity_of
from .strength import Envelopes

if TYPE_CHECKING:
    from ..spectra.checks import Given
    from .result import Diagnosis


def against(
    of: Diagnosis, reference: Given, fs: float | None, column: str | None, unit: str | None
) -> Diagnosis:
    """Return a diagnosis with its change; see :meth:`ballrace.diagnosis.Diagnosis.against`."""
    if of.severity is None:
        raise SceneError("reference", "a record", f"none: the record itself needs {of.why}")
    channel = checked_channel(
        channel_of(reference, fs, column, name="reference"), unit, "reference"
    )
    band = max((of.evidence[part] for part in ACCUSED), key=lambda one: one.z).band
    if channel.unit != of.unit or band[1] > channel.fs / 2.0:
        given = f"{channel.fs:g} Hz in {channel.unit or 'no unit'}"
        allowed = (
            f"a record in {of.unit or 'no unit'} that reaches the deciding band, {band[1]:.0f} Hz"
        )
        raise SceneError("reference", given, allowed)
    steady = without_drift(channel.x, channel.fs, of.shaft.nominal)
    envelopes = Envelopes(steady, channel.fs, [band])
    before = severity_of(channel, of.shaft.rate, envelopes, 0, of.severity.machine)
    return replace(of, severity=of.severity.over(before))
