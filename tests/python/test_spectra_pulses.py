"""The shaft's angle from the pulses of a tachometer.

Truth: analytic. The times of the pulses of a run-up at constant acceleration, of which some are taken away, some
come twice and all are off by a little; the angle is that of the run-up.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
import pytest

import ballrace as br
from ballrace import spectra

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

FS, SECONDS = 12_800.0, 8.0
T = np.arange(round(SECONDS * FS)) / FS
# From 14 to 24 turns a second.
FIRST, GAIN = 14.0, 10.0 / 16.0
ANGLE = 2.0 * np.pi * (FIRST * T + GAIN * T**2)


def pulses_of(each: int = 1, seconds: float = SECONDS) -> NDArray[np.float64]:
    """Return when the run-up has its pulses."""
    turns = np.arange(int(each * (FIRST * seconds + GAIN * seconds**2)) + 1) / each
    return (-FIRST + np.sqrt(FIRST**2 + 4.0 * GAIN * turns)) / (2.0 * GAIN)


def broken(
    pulses: NDArray[np.float64], missing: float, double: float, jitter: float, seed: int
) -> NDArray[np.float64]:
    """Return pulses of which shares are missing and double, off by parts of an interval; the ends are kept."""
    rng = np.random.default_rng(seed)
    interval = np.gradient(pulses)
    pulses = np.sort(np.abs(pulses + jitter * interval * rng.normal(size=pulses.size)))
    inner = np.arange(1, pulses.size - 1)
    twice = inner[rng.random(inner.size) < double]
    again = pulses[twice] + interval[twice] * rng.uniform(0.02, 0.4, twice.size)
    gone = inner[rng.random(inner.size) < missing]
    return np.sort(np.concatenate((np.delete(pulses, gone), again)))


def quietly(pulses: NDArray[np.float64], each: int = 1) -> NDArray[np.float64]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", br.AccuracyWarning)
        return spectra.angle_from_pulses(pulses, T, each)


@pytest.mark.parametrize("each", [1, 2, 60])
def test_pulses_of_a_run_up_give_its_angle(each: int) -> None:
    """Exact between the pulses; after the last one the speed stays, for less than an interval."""
    angle = spectra.angle_from_pulses(pulses_of(each), T, each)
    inner = pulses_of(each)[-1] >= T
    np.testing.assert_allclose(angle[inner], ANGLE[inner], rtol=0.0, atol=1e-6)
    assert np.abs(angle - ANGLE).max() < 0.02 / each**2
    assert np.diff(angle).min() > 0.0


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(("missing", "double"), [(0.05, 0.0), (0.0, 0.05), (0.15, 0.1)])
@pytest.mark.parametrize("each", [1, 8])
def test_missing_and_double_pulses_are_repaired(
    each: int, missing: float, double: float, seed: int
) -> None:
    """A miscounted pulse would turn all that follows by 2π/each; a double one may stand for its missing first."""
    pulses = broken(pulses_of(each), missing, double, 0.005, seed)
    with pytest.warns(br.AccuracyWarning, match="missing" if missing else "double"):
        angle = spectra.angle_from_pulses(pulses, T, each)
    off = angle - ANGLE
    assert np.abs(off).max() < 1.0 / each
    assert off.std() < 0.1 / each
    assert np.diff(angle).min() > 0.0


def test_what_was_repaired_is_told() -> None:
    whole = pulses_of()
    pulses = np.sort(np.append(np.delete(whole, [50, 51, 90]), whole[60] + 1e-3))
    told = "of 151 pulses 1 was double and is dropped, 3 missing ones are counted"
    with pytest.warns(br.AccuracyWarning, match=told):
        angle = spectra.angle_from_pulses(pulses, T)
    assert np.abs(angle - ANGLE).max() < 0.02


def test_a_wheel_with_a_gap_and_a_contact_that_chatters() -> None:
    """A gap of two teeth in 60 each turn; and pulses each of which is followed by two more."""
    teeth = pulses_of(60)
    gap = teeth[np.arange(teeth.size) % 60 < 58]
    np.testing.assert_allclose(quietly(gap, 60)[:-200], ANGLE[:-200], rtol=0.0, atol=1e-4)
    one = pulses_of()
    chatter = np.sort(np.concatenate((one, one + 1e-3, one + 2e-3)))
    off = quietly(chatter) - ANGLE
    # The same one of three each time: later by 2 ms at most, 0.3 rad at 24 turns a second.
    assert off.min() > -0.31
    assert off.max() < 0.03


def test_where_it_cannot_be_decided_it_is_not() -> None:
    rng = np.random.default_rng(5)
    pulses = pulses_of()
    stop = np.concatenate((pulses[:60], pulses[110:]))
    odd: list[tuple[NDArray[np.float64], str]] = [
        # Pulses by chance; half of them missing; each followed by one after a third of a turn.
        (np.cumsum(rng.exponential(0.05, 200)), "pulses may be missing or double|no even speed"),
        (broken(pulses, 0.5, 0.0, 0.0, 1), "pulses may be missing or double|no even speed"),
        (np.sort(np.append(pulses, pulses + np.gradient(pulses) / 3.0)), "missing or double"),
        # None for 50 turns.
        (stop, "no even speed beyond 3.6"),
    ]
    for each, found in odd:
        with pytest.raises(br.SceneError, match=found) as caught:
            spectra.angle_from_pulses(each, each[5:10])
        assert caught.value.path == "pulses"


def test_one_missing_in_front_of_the_last_while_the_shaft_stops_is_no_guess() -> None:
    """From 30 to 2 turns a second in 10 s: the last turn takes 1.4 times the one before."""
    turns = np.arange(161.0)
    pulses = (30.0 - np.sqrt(900.0 - 5.6 * turns)) / 2.8
    with pytest.raises(br.SceneError, match=r"1\.00 pulses missing between 9\.32189 and 10 s"):
        spectra.angle_from_pulses(np.delete(pulses, 159), pulses[:9])


def test_from_rest_the_angle_is_known_when_the_speed_is_even() -> None:
    """Analytic: the second turn takes 0.41 of the first, the fifth 0.89 of the fourth."""
    pulses = np.sqrt(np.arange(60.0))
    late = np.linspace(2.0, pulses[-1], 99)
    with pytest.warns(br.AccuracyWarning, match="dropped"):
        angle = spectra.angle_from_pulses(pulses, late)
    np.testing.assert_allclose(angle - angle[0], 2.0 * np.pi * (late**2 - 4.0), atol=1e-2)
    with (
        pytest.warns(br.AccuracyWarning, match="dropped"),
        pytest.raises(br.SceneError, match="at = 0 to"),
    ):
        spectra.angle_from_pulses(pulses, pulses)


def test_bad_arguments_are_refused() -> None:
    pulses = pulses_of()
    calls: list[tuple[str, Callable[[], object]]] = [
        ("pulses", lambda: spectra.angle_from_pulses(pulses[:3], T)),
        ("pulses", lambda: spectra.angle_from_pulses(pulses[::-1], T)),
        ("pulses", lambda: spectra.angle_from_pulses(np.where(pulses > 4.0, np.nan, pulses), T)),
        ("pulses", lambda: spectra.angle_from_pulses(np.where(pulses > 4.0, np.inf, pulses), T)),
        ("pulses", lambda: spectra.angle_from_pulses(np.ones(20), T)),
        ("pulses", lambda: spectra.angle_from_pulses([0.0, 0.0, 0.0, 1.0, 1.0], T)),
        ("pulses_per_turn", lambda: spectra.angle_from_pulses(pulses, T, 0)),
        ("at", lambda: spectra.angle_from_pulses(pulses, T + 0.2)),
        ("at", lambda: spectra.angle_from_pulses(pulses, [[0.0]])),
        ("at", lambda: spectra.angle_from_pulses(pulses, [np.nan])),
        ("level", lambda: spectra.pulse_times(np.sin(T), FS, level=2.0)),
        ("x", lambda: spectra.pulse_times(np.ones(100), FS)),
        ("fs", lambda: spectra.pulse_times(np.sin(T))),
    ]
    for name, call in calls:
        with pytest.raises(br.SceneError) as caught:
            call()
        assert caught.value.path == name
    assert spectra.angle_from_pulses(pulses, []).size == 0


def test_a_recorded_tachometer_gives_its_pulses() -> None:
    """Pulses of 5 % of a turn and finite slopes, on an offset, in noise of a tenth of their height."""
    turns = ANGLE / (2.0 * np.pi) + 0.5
    turn = turns % 1.0
    shape = 2.0 + 5.0 * np.clip(np.minimum(turn, 0.05 - turn) / 0.005, 0.0, 1.0)
    clean = spectra.pulse_times(shape, FS)
    # Halfway up its slope.
    expected = np.interp(np.arange(1, int(turns[-1]) + 1) + 0.0025, turns, T)
    np.testing.assert_allclose(clean, expected, rtol=0.0, atol=1e-5)
    noisy = shape + 0.5 * np.random.default_rng(1).normal(size=T.size)
    record = br.Recording(columns={"DE": np.zeros(T.size), "tacho": noisy}, fs=FS)
    found = spectra.pulse_times(record.channel("tacho"))
    assert found.size == clean.size
    assert np.abs(found - clean).max() < 1e-3
    angle = spectra.angle_from_pulses(found, record.t)
    # As the pulses begin half a turn later than the record.
    assert np.abs(angle + 2.0 * np.pi * 0.5025 - ANGLE).max() < 0.1
    later = br.channel.Channel(x=noisy, fs=FS, start=10.0)
    np.testing.assert_allclose(spectra.pulse_times(later), found + 10.0)


def test_a_simulated_tachometer_gives_the_angle_of_its_shaft() -> None:
    chain = br.measuring.Chain(tacho=br.measuring.Tacho(pulses=4, jitter=1e-5))
    measured = br.measure(np.zeros(T.size), chain, fs=FS, shaft=ANGLE, seed=1)
    angle = spectra.angle_from_pulses(measured.pulses, measured.t, 4)
    assert np.abs(angle - ANGLE).max() < 0.01


def test_over_the_angle_of_broken_pulses_the_outer_race_is_found() -> None:
    """Blows at BPFO in noise: as pulses without repair have it, no part is named."""
    rng = np.random.default_rng(3)
    order = br.catalogue["6205"].orders.bpfo
    at = np.searchsorted(ANGLE, 2.0 * np.pi * np.arange(1.0, ANGLE[-1] * order / 6.3) / order)
    x = np.zeros(T.size)
    x[at] = 10.0 + rng.normal(size=at.size)
    ring = np.arange(200) / FS
    x = np.convolve(x, np.exp(-1200.0 * ring) * np.sin(2.0 * np.pi * 3500.0 * ring))[: x.size]
    x += rng.normal(size=x.size)
    pulses = broken(pulses_of(), 0.05, 0.05, 0.002, 2)
    turn, value = spectra.by_order(x, quietly(pulses))
    found = br.diagnose(value, "6205", 60.0, fs=1.0 / turn[1])
    assert found.parts == ("outer_race",)
    counted = np.interp(T, pulses, 2.0 * np.pi * np.arange(pulses.size), right=2e3) + 1e-9 * T
    turn, value = spectra.by_order(x[: T.size - 2000], counted[: T.size - 2000])
    assert (
        br.diagnose(value, "6205", 60.0, fs=1.0 / turn[1]).evidence["outer_race"].z
        < 0.5 * found.evidence["outer_race"].z
    )
