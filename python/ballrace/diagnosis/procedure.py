"""Course of a diagnosis from a record to a verdict."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from .._base.numbers import counted
from ..channel import channel_of
from ..scene import Scene
from .arguments import (
    check_false_alarm,
    checked_channel,
    known_bearing,
    known_within,
    other_rates,
)
from .bursts import bursts_of
from .drift import without_drift
from .examined import bands_for, examined
from .lacking import lack_of, notes_of, unclipped, unexplained, wanting_of
from .likelihood import with_ratios
from .mistakes import another_rate, changing_speed, given_in_hertz, repeating
from .null import ACCUSED, largest_z
from .result import Diagnosis
from .rows import judged_by_rows
from .sensitivity import sensitivity_of
from .severity import checked_machine, severity_of
from .shaft import ShaftRate
from .strength import SHALLOW
from .verdict import Size, Verdict, decided
from .width import sized, unknown_width

if TYPE_CHECKING:
    from collections.abc import Iterable

    from ..channel import Channel
    from ..spectra.checks import Given
    from .examined import Examined
    from .kinematics import AnyBearing, Kinematics
    from .sensitivity import Sensitivity
    from .severity import Machine

_GRAVITY = 9.81
"""Acceleration of falling balls [m/s²]."""

_A_TURN = 1.0
"""Rate of the shaft of a record over its angle, whose speed is not known."""


def diagnose(
    record: Given,
    bearing: AnyBearing | None = None,
    speed_rpm: float | None = None,
    *,
    outer_rpm: float | None = None,
    fs: float | None = None,
    column: str | None = None,
    unit: str | None = None,
    row: int | None = None,
    speed_within: float | None = None,
    false_alarm: float = 0.01,
    exclude: Iterable[float] = (),
    mains: float | None = None,
    machine: Machine | None = None,
    seed: int = 0,
) -> Diagnosis:
    """Diagnose a bearing from a record: healthy, damaged with the parts, or undecided.

    The record is prewhitened in two ways; in overlapping bands the squared envelope's spectrum is searched for
    the combs of lines that faults of each part have, all at one speed of the cage. Their heights are compared
    with hundreds of combs at orders of the same record that no part has, so that the rate of false alarms is
    known, without training and without a threshold in decibels. Lines that stand out are damage where they are
    deep, come from impacts and are not tiny, or tiny at odds of ten to one among simulated bearings; otherwise
    they are left open, and only in a run itself called healthy. A record is called healthy where damage would have
    stood out in it: not with a narrow band, at a nominal speed that it does not show, with impacts at no rate of
    the bearing, or with too few turns to separate a race from the shaft.

    Parameters
    ----------
    record : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        At constant speed, over 20 turns of the shaft and more. Of a speed that changes give the signal over the
        shaft's angle (:func:`ballrace.spectra.by_order`), with its samples a turn as ``fs`` and 60 as
        ``speed_rpm``. What is slower than the shaft does not count.
    bearing : str, Bearing, Scene, Row, Orders, FaultFrequencies or mapping, optional
        A designation such as ``"6205-2RS/C3"``, a bearing of the catalogue, a scene, a row of one, or orders, as a
        mapping of ``ftf``, ``bpfo``, ``bpfi`` and ``bsf``. By default the scene of the record.
    speed_rpm : float, optional
        Nominal speed of the inner ring, within ``speed_within`` [1/min]; by default that of the record, or 0
        where an ``outer_rpm`` is given. Where the bearing is given as orders or rates of a hub, the relative speed
        of its rings, by default that of the rates.
    outer_rpm : float, optional
        Nominal speed of the outer ring [1/min], as in hubs, idlers and planets; of the other sign where the
        rings turn in opposite ways. By default that of the scene, else the outer ring stands. Where both rings
        turn, their speeds are not looked for in the record.
    fs : float, optional
        Sampling rate of an array [Hz].
    column : str, optional
        Column of a record; by default as of :meth:`ballrace.Recording.channel`.
    unit : {"m/s^2", "g"}, optional
        Unit, where the record has none, such as an array. Without one the strength of lines is not judged.
    row : int, optional
        Row of balls of a scene, from 0; by default all rows whose orders differ, and the verdict on the one with
        the strongest sign of damage (``bearing`` names it, a note the others).
    speed_within : float, optional
        Relative uncertainty of the speed, 0 to 0.08, such as 0.001 with a tachometer; 0 where it is a run's own.
        By default the shaft is looked for within 1 %, and within 8 % where it is not clear there. A record that
        does not show it clears nothing unless its speed is known within 0.002.
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
        Seed of the null's combs.

    Returns
    -------
    Diagnosis
        Verdict, evidence, what damage would have stood out, severity, width of a spall; ``plot()``,
        ``plot_size()`` and ``report(path)``.

    Raises
    ------
    SceneError
        An argument is not usable, samples are not finite, or a speed or a bearing is missing.
    KeyError
        There is no such column.

    Examples
    --------
    Impacts at the rate of the inner race, with a scatter of half a percent of a period, in noise:

    >>> import ballrace as br, numpy as np
    >>> fs, shaft, rng = 16_000.0, 30.0, np.random.default_rng(1)
    >>> impact = np.arange(650) + 0.005 * rng.normal(size=650)
    >>> at = np.rint(impact * fs / (br.catalogue["6205"].orders.bpfi * shaft)).astype(int)
    >>> x = 0.3 * rng.normal(size=64_000)
    >>> x[at[at >= 0]] += 3.0 + 2.0 * np.cos(2 * np.pi * shaft * at[at >= 0] / fs)
    >>> found = br.diagnose(x, "6205", 1800.0, fs=fs)
    >>> found.verdict, found.parts
    ('damaged', ('inner_race',))
    """
    channel = checked_channel(channel_of(record, fs, column, name="record"), unit)
    check_false_alarm(false_alarm)
    seed = counted("seed", seed, 0)
    scene = channel.scene if bearing is None else bearing
    if row is None and isinstance(scene, Scene) and len(scene.rows) > 1:
        again = partial(
            diagnose,
            channel,
            scene,
            speed_rpm,
            outer_rpm=outer_rpm,
            speed_within=speed_within,
            exclude=exclude,
            mains=mains,
            machine=machine,
            seed=seed,
        )
        return judged_by_rows(scene, false_alarm, lambda k, share: again(row=k, false_alarm=share))
    kinematics, nominal = known_bearing(channel, bearing, row or 0, speed_rpm, outer_rpm)
    given = speed_rpm is not None or outer_rpm is not None
    within = known_within(channel, given=given, speed_within=speed_within)
    orders, rates = other_rates(exclude, mains)
    machine = checked_machine(machine)
    shaft = ShaftRate(rate=nominal, nominal=nominal, by="nominal", z=0.0)
    undecided = _undecided(channel, kinematics, shaft, false_alarm)
    whole, clipped = channel, unclipped(channel.x)
    channel = replace(channel, x=without_drift(channel.x, channel.fs, nominal))
    lack = lack_of(channel, nominal, kinematics, len(bands_for(channel, kinematics, nominal)))
    if lack is not None:
        return replace(undecided, why=given_in_hertz(channel, nominal) or lack)
    found = examined(
        channel, kinematics, nominal, within=within, orders=orders, rates=rates, seed=seed
    )
    shaft, bands = found.shaft, found.envelopes.bands
    diameter = _diameter(channel, kinematics)
    evidence = with_ratios(found.evidence, diameter, shaft.rate)
    pressed = _pressed(kinematics, shaft)
    size = None if diameter is None else Size(diameter=diameter, rate=shaft.rate, pressed=pressed)
    exact = within == 0.0 and channel.scene is not None and bearing is None
    is_run = exact and channel.is_run
    kurtosis = found.envelopes.impacts(size.faint if is_run and size is not None else 0.0)
    # A cage that stands has no lines.
    cage = "cage" in evidence and evidence["cage"].probability < false_alarm
    seen = None if is_run else _seen(found, kinematics, undecided.threshold, diameter)
    impacts = unexplained(kurtosis, exact=exact, cage=cage)
    verdict = decided(
        evidence, false_alarm, size=size, falls=pressed < 1.0, is_run=is_run, bursts=bursts_of(evidence),
        seen=seen, wanting=[*clipped, *wanting_of(channel, shaft, kinematics, within, impacts)],
    )  # fmt: skip
    verdict = verdict if exact else _doubted(verdict, impacts, found, channel, kinematics)
    deciding = bands.index(max((evidence[part] for part in ACCUSED), key=lambda one: one.z).band)
    severity = severity_of(whole, shaft.rate, found.envelopes, deciding, machine)
    damaged = [evidence[part] for part in verdict.parts]
    width = sized(channel.x, channel.fs, shaft.rate, kinematics, damaged)
    return replace(
        undecided, verdict=verdict.verdict, parts=verdict.parts, why=verdict.why, evidence=evidence, shaft=shaft,
        severity=severity, width=width.width, sensitivity=seen, _size=width, _levels=found.levels,
        _bands=tuple(bands),
    )  # fmt: skip


def _doubted(
    verdict: Verdict, impacts: str | None, found: Examined, channel: Channel, kinematics: Kinematics
) -> Verdict:
    """Return a verdict that names the likely mistake, and is open where something unknown repeats deeply."""
    shaft, bands = found.shaft.rate, found.envelopes.bands
    if verdict.verdict == "undecided" and impacts is not None:
        why = changing_speed(channel, shaft, bands)
        if why is not None:
            return replace(verdict, why=why)
    if verdict.verdict == "healthy" or verdict.why == impacts:
        rate = repeating(channel, shaft, bands)
        if rate is not None and found.envelopes.deepest(rate) >= SHALLOW:
            why = another_rate(channel, kinematics, rate, shaft)
            return Verdict(verdict="undecided", parts=(), why=why)
    return verdict


def _seen(
    found: Examined, kinematics: Kinematics, threshold: float, diameter: float | None
) -> Sensitivity | None:
    """Return the least damage of the outer race that would stand out."""
    search = found.searches["outer_race"]
    ball = None if kinematics.row is None else kinematics.row.ball_diameter
    return sensitivity_of(
        found.envelopes,
        search.comb,
        search.found,
        found.shaft.rate,
        threshold,
        diameter=diameter,
        ball=ball,
    )


def _diameter(channel: Channel, kinematics: Kinematics) -> float | None:
    """Return the pitch diameter [m]; None where how strong lines are says nothing."""
    if channel.unit != "m/s^2" or kinematics.row is None:
        return None
    return kinematics.row.pitch_diameter


def _pressed(kinematics: Kinematics, shaft: ShaftRate) -> float:
    """Return the acceleration with which the turn of the cage presses balls to the outer race, over gravity."""
    if kinematics.row is None or shaft.nominal == _A_TURN:
        return math.inf
    turn = 2.0 * math.pi * kinematics.orders.ftf * shaft.rate
    return turn**2 * 0.5 * kinematics.row.pitch_diameter / _GRAVITY


def _undecided(
    channel: Channel, kinematics: Kinematics, shaft: ShaftRate, false_alarm: float
) -> Diagnosis:
    """Return what is known before there is evidence."""
    size = unknown_width("no part is called damaged")
    record = (
        f"{channel.name or 'signal'}, {channel.n_samples / channel.fs:.4g} s at {channel.fs:g} Hz"
    )
    return Diagnosis(
        verdict="undecided", parts=(), why="", evidence={}, shaft=shaft, severity=None,
        width=size.width, _size=size, false_alarm=false_alarm, bearing=kinematics.name, record=record,
        threshold=largest_z(false_alarm, len(ACCUSED)), unit=channel.unit, notes=notes_of(channel, kinematics),
    )  # fmt: skip
