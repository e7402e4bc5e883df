"""From a record to a verdict."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from .._numbers import real
from .._units import ACCELERATIONS
from ..channel import channel_of
from ..errors import SceneError
from ..spectra.checks import checked_signal
from .combs import PARTS, comb_of
from .envelopes import bands_of, envelope_spectra, levels_of
from .evidence import evidence_of
from .kinematics import kinematics_of
from .null import ACCUSED, largest_z
from .result import Diagnosis
from .severity import checked_machine, severity_of
from .shaft import ShaftRate, shaft_rate
from .strength import Envelopes, faint_below
from .verdict import decided, own_lines

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import NDArray

    from ..channel import Channel
    from ..spectra.checks import Given
    from .kinematics import AnyBearing, Kinematics
    from .severity import Machine

__all__ = ["diagnose"]

_TURNS = 20.0
"""Turns of the shaft below which the running median under a line has too few bins for a null."""

_HELD = 2.0
"""Lines of an inner race that a band has to hold: an envelope has none above the width of its band."""

_CLIPPED = 1e-3
"""Share of samples at the largest or the smallest value from which on a record counts as clipped."""


def diagnose(
    record: Given,
    bearing: AnyBearing | None = None,
    speed_rpm: float | None = None,
    *,
    fs: float | None = None,
    column: str | None = None,
    unit: str | None = None,
    row: int = 0,
    false_alarm: float = 0.01,
    exclude: Iterable[float] = (),
    mains: float | None = None,
    machine: Machine | None = None,
    seed: int = 0,
) -> Diagnosis:
    """Say whether a race or a ball is damaged, nothing is, or the record cannot tell.

    The record is prewhitened in two ways; in overlapping bands the squared envelope's spectrum is searched
    for the combs of lines that faults of each part have. How high they stand is compared with a thousand combs
    at orders of the same record that no part has, so that chance has a known rate, without training and without
    a threshold in decibels. Lines that stand out accuse a part only where they are deep or blows stand out,
    and, where the unit of the record is known, where they carry more than those of a healthy bearing do.

    Parameters
    ----------
    record : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        At constant speed, over 20 turns of the shaft and more. Of a speed that changes give the signal over the
        shaft's angle (:func:`ballrace.spectra.by_order`), with its samples a turn as ``fs`` and 60 as
        ``speed_rpm``.
    bearing : str, Bearing, Scene, Row, Orders, FaultFrequencies or mapping, optional
        A designation such as ``"6205-2RS/C3"``, a bearing of the catalogue, a scene, a row of one, or orders, as a
        mapping of ``ftf``, ``bpfo``, ``bpfi`` and ``bsf``. By default the scene of the record.
    speed_rpm : float, optional
        Nominal speed of the inner ring, within 1 % [rev/min]; by default what the record knows.
    fs : float, optional
        Sampling rate of an array [Hz].
    column : str, optional
        Column of a record; by default ``outer.ay`` if there is one, else the first.
    unit : {"m/s^2", "g"}, optional
        Unit, where the record does not tell it, as of an array. Without one lines are judged, and not their size.
    row : int
        Row of balls of a scene, from 0.
    false_alarm : float
        Share of healthy records that may be called damaged, from 1e-6 to 0.2.
    exclude : iterable of float
        Orders, with their multiples, that are not the bearing's: of belts, blades, gears.
    mains : float, optional
        Frequency of the mains, 50 or 60 [Hz], whose multiples are not the bearing's.
    machine : {"large_rigid", "large_flexible", "medium_rigid", "medium_flexible"}, optional
        Class of the machine, for the zone of ISO 20816-3: above 300 kW or from 15 to 300 kW, on a rigid or a
        flexible foundation.
    seed : int
        Which combs the null has.

    Returns
    -------
    Diagnosis
        Verdict, evidence, severity; ``plot()`` and ``report(path)``.

    Raises
    ------
    SceneError
        An argument is not usable; samples that are not finite; a speed or a bearing that nobody tells.
    KeyError
        There is no such column.

    Examples
    --------
    Blows at the rate of the inner race, half a percent of a period off, in noise:

    >>> import ballrace as br, numpy as np
    >>> fs, shaft, rng = 16_000.0, 30.0, np.random.default_rng(1)
    >>> blow = np.arange(650) + 0.005 * rng.normal(size=650)
    >>> at = np.rint(blow * fs / (br.catalogue["6205"].orders.bpfi * shaft)).astype(int)
    >>> x = 0.3 * rng.normal(size=64_000)
    >>> x[at[at >= 0]] += 3.0 + 2.0 * np.cos(2 * np.pi * shaft * at[at >= 0] / fs)
    >>> found = br.diagnose(x, "6205", 1800.0, fs=fs)
    >>> found.verdict, found.parts
    ('damaged', ('inner_race',))
    """
    channel = _checked(channel_of(record, fs, column, name="record"), unit)
    kinematics = _kinematics(channel, bearing, row)
    nominal = _nominal(channel, speed_rpm)
    if not 1e-6 <= real(false_alarm) <= 0.2:
        raise SceneError("false_alarm", repr(false_alarm), "a share of records, 1e-6 to 0.2")
    orders, rates = _others(exclude, mains)
    machine = checked_machine(machine)
    bands = bands_of(channel.fs, _HELD * kinematics.orders.bpfi * nominal)
    shaft = ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    told = _undecided(channel, kinematics, shaft, false_alarm)
    lack = _lack(channel, nominal, kinematics, len(bands))
    if lack is not None:
        return replace(told, why=lack)
    spectra = _spectra(channel, bands, kinematics, nominal)
    shaft = shaft_rate(channel.x, channel.fs, nominal, spectra)
    levels = levels_of(spectra, channel.n_samples / channel.fs, shaft.rate)
    levels = levels.without([shaft.rate, *(order * shaft.rate for order in orders), *rates])
    envelopes = Envelopes(channel.x, channel.fs, bands)
    evidence = {
        part: evidence_of(
            part, envelopes, levels=levels, kinematics=kinematics, shaft=shaft.rate, seed=seed
        )
        for part in PARTS
    }
    own = own_lines(evidence, levels, kinematics, shaft.rate, false_alarm=false_alarm, seed=seed)
    faint = _faint(channel, kinematics, shaft.rate)
    verdict = decided(evidence, own, false_alarm, faint=faint, wanting=_wanting(channel))
    deciding = bands.index(max((evidence[part] for part in ACCUSED), key=lambda one: one.z).band)
    severity = severity_of(channel, shaft.rate, envelopes, deciding, machine)
    return replace(
        told, verdict=verdict.verdict, parts=verdict.parts, why=verdict.why, evidence=evidence, shaft=shaft,
        severity=severity, _levels=levels, _bands=tuple(bands),
    )  # fmt: skip


def _spectra(
    channel: Channel, bands: list[tuple[float, float]], kinematics: Kinematics, shaft: float
) -> NDArray[np.float64]:
    """Return the spectra of envelopes up to the last line of the null's highest comb."""
    highest = max(comb_of(part, kinematics.orders).order for part in ACCUSED)
    limit = (4.1 * 1.55 * highest + 3.0) * shaft
    return envelope_spectra(channel.x, channel.fs, bands, limit, shaft)


def _checked(channel: Channel, unit: str | None) -> Channel:
    """Return the channel in m/s² where its unit is known, cut to a length that transforms quickly."""
    from scipy.fft import prev_fast_len

    x = checked_signal(channel.x, channel.fs, "record")
    channel = replace(channel, x=x[: prev_fast_len(x.size, real=True)])
    if unit is not None:
        if unit.replace("²", "^2") not in ACCELERATIONS:
            raise SceneError("unit", repr(unit), f"one of {', '.join(ACCELERATIONS)}, or None")
        channel = replace(channel, unit=unit.replace("²", "^2"))
    return channel.to("m/s^2") if channel.unit in ACCELERATIONS else channel


def _kinematics(channel: Channel, bearing: AnyBearing | None, row: int) -> Kinematics:
    bearing = channel.scene if bearing is None else bearing
    if bearing is None:
        raise SceneError("bearing", "None", "a bearing: the record does not know its own")
    return kinematics_of(bearing, row)


def _nominal(channel: Channel, speed_rpm: float | None) -> float:
    if speed_rpm is None:
        if not channel.shaft:
            raise SceneError(
                "speed_rpm", "None", "the speed [rev/min]: the record does not know it"
            )
        return abs(channel.shaft)
    if not 0.0 < abs(real(speed_rpm)) < math.inf:
        raise SceneError("speed_rpm", repr(speed_rpm), "a speed of the inner ring [rev/min], not 0")
    return abs(real(speed_rpm)) / 60.0


def _others(exclude: Iterable[float], mains: float | None) -> tuple[list[float], list[float]]:
    """Return orders, and frequencies [Hz], whose multiples are not the bearing's."""
    orders = [real(order) for order in exclude]
    for order in orders:
        if not 0.05 <= order < math.inf:
            raise SceneError("exclude", repr(order), "orders of the shaft from 0.05 on")
    if mains is not None and not 1.0 <= real(mains) <= 1000.0:
        raise SceneError("mains", repr(mains), "a frequency, 1 to 1000 Hz, or None")
    return orders, [] if mains is None else [real(mains)]


def _notes(channel: Channel, kinematics: Kinematics) -> tuple[str, ...]:
    notes = list(channel.warnings)
    if channel.unit != "m/s^2":
        unit = f"{channel.unit} is no acceleration" if channel.unit else "its unit is not known"
        notes.append(f"how strong lines are was not judged: {unit}; give unit=")
    elif kinematics.row is None:
        notes.append("how strong lines are was not judged: only orders of the bearing are known")
    return tuple(notes)


def _lack(channel: Channel, shaft: float, kinematics: Kinematics, bands: int) -> str | None:
    """Say what a record would need to have for any evidence; None if it has it."""
    turns = channel.n_samples / channel.fs * shaft
    if not channel.x.std() > 1e-12 * np.abs(channel.x).max():
        return "a signal: this one is silent"
    if turns < _TURNS:
        return f"a longer record, at least {_TURNS / shaft:.3g} s: this one has {turns:.3g} turns of the shaft"
    if not bands:
        needed = 2.0 * _HELD * kinematics.orders.bpfi * shaft / 0.92
        return (
            f"a higher sampling rate, at least {needed:.3g} Hz: no band holds two lines of a race"
        )
    return None


def _wanting(channel: Channel) -> list[str]:
    """Return what a record lacks for a statement that nothing is damaged."""
    x = channel.x
    at_rails = np.count_nonzero((x == x.max()) | (x == x.min()))
    if at_rails > max(_CLIPPED * x.size, 8):
        return ["a record within the logger's range: this one is clipped"]
    return []


def _faint(channel: Channel, kinematics: Kinematics, shaft: float) -> float | None:
    if channel.unit != "m/s^2" or kinematics.row is None:
        return None
    return faint_below(kinematics.row.pitch_diameter, shaft)


def _undecided(
    channel: Channel, kinematics: Kinematics, shaft: ShaftRate, false_alarm: float
) -> Diagnosis:
    """Return what is known before there is evidence."""
    record = (
        f"{channel.name or 'signal'}, {channel.n_samples / channel.fs:.4g} s at {channel.fs:g} Hz"
    )
    return Diagnosis(
        verdict="undecided", parts=(), why="", evidence={}, shaft=shaft, severity=None,
        false_alarm=false_alarm, threshold=largest_z(false_alarm, len(ACCUSED)), bearing=kinematics.name,
        record=record, unit=channel.unit, notes=_notes(channel, kinematics),
    )  # fmt: skip
