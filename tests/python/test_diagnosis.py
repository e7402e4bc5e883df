"""A verdict from a record: synthetic records whose truth is known.

Truth: analytic. Blows at a known rate in noise are damage of the part that has that rate; noise, tones, mains and
blows at no part's rate are none, and of such records a verdict may accuse the share that was asked for. The limits
for counts are those of binomial numbers: exceeded once in a thousand times at the rate asked for.
"""

from __future__ import annotations

import math
import pickle
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import ballrace as br
from ballrace.diagnosis.bursts import Bursts
from ballrace.diagnosis.drift import without_drift
from ballrace.diagnosis.lacking import unexplained
from ballrace.diagnosis.likelihood import at_any_size
from ballrace.diagnosis.null import largest_z, null_orders, probability
from ballrace.diagnosis.severity import zone_of
from ballrace.diagnosis.upper import upper_edge
from ballrace.diagnosis.verdict import Size, Verdict, decided

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from numpy.typing import NDArray

    from ballrace.diagnosis.combs import Part
    from ballrace.diagnosis.evidence import Evidence
    from ballrace.diagnosis.kinematics import AnyBearing

    Signal = NDArray[np.float64]

FS, RPM = 12_000.0, 1770.0
SHAFT = RPM / 60.0
ORDERS = br.catalogue["6205"].orders
RATES = {"outer_race": ORDERS.bpfo, "inner_race": ORDERS.bpfi, "ball": 2.0 * ORDERS.bsf}
SIDEBANDS = {"outer_race": 0.0, "inner_race": 1.0, "ball": ORDERS.ftf}


def blows(
    order: float,
    side: float = 0.0,
    *,
    seed: int = 1,
    duration: float = 2.0,
    swell: float = 0.8,
    off: float = 0.005,
) -> Signal:
    """Return blows at an order that ring at 3 kHz, swelling at another, their times off by 0.5 %."""
    rng = np.random.default_rng(seed)
    x = np.zeros(round(duration * FS))
    period = 1.0 / (order * SHAFT)
    times = np.arange(0.0, duration, period)
    times = times + off * period * rng.normal(size=times.size)
    at = np.clip(np.rint(times * FS).astype(int), 0, x.size - 1)
    np.add.at(x, at, 1.0 + swell * (side > 0.0) * np.cos(2 * np.pi * side * SHAFT * times))
    t = np.arange(200) / FS
    ringing = np.exp(-800.0 * t) * np.sin(2 * np.pi * 3000.0 * t)
    return np.convolve(x, ringing)[: x.size]


def noise(x: Signal, level: float, seed: int = 2) -> Signal:
    return x + level * np.random.default_rng(seed).normal(size=x.size)


def judged(
    x: Signal, bearing: AnyBearing = "6205", rpm: float = RPM, **more: Any
) -> br.diagnosis.Diagnosis:
    return br.diagnose(x, bearing, rpm, fs=FS, **more)


@pytest.mark.parametrize("part", RATES)
@pytest.mark.parametrize("seed", range(3))
def test_blows_accuse_the_part_with_their_rate(part: str, seed: int) -> None:
    x = noise(blows(RATES[part], SIDEBANDS[part], seed=seed), 0.3, seed)
    found = judged(x)
    assert (found.verdict, found.parts) == ("damaged", (part,))
    one = found.evidence[found.parts[0]]
    assert one.probability < 1e-3
    assert one.factor * found.shaft.rate == pytest.approx(SHAFT, rel=0.0025)
    assert one.strength.depth > 0.5
    assert {line.label for line in one.lines} >= {"outer_race": {"BPFO"}, "inner_race": {"BPFI"},
                                                  "ball": {"2·BSF"}}[part]  # fmt: skip


@pytest.mark.parametrize("seed", range(1, 4))
def test_two_faults_are_both_named_and_one_is_not_two(seed: int) -> None:
    outer, inner = blows(ORDERS.bpfo, seed=seed), blows(ORDERS.bpfi, 1.0, seed=seed + 29)
    both = judged(noise(outer + inner, 0.1))
    assert set(both.parts) == {"outer_race", "inner_race"}
    # Blows of the outer race that the shaft modulates have lines next to the inner race's: 9 f_r − BPFO is BPFI.
    swelling = 1.0 + 0.8 * np.cos(2 * np.pi * SHAFT * np.arange(outer.size) / FS)
    assert judged(noise(swelling * outer, 0.1)).parts == ("outer_race",)


def test_slip_and_speed_are_found() -> None:
    """Blows 0.8 % beside the nominal order, and a shaft 0.6 % faster than given."""
    x = blows(1.008 * ORDERS.bpfo)
    t = np.arange(x.size) / FS
    x = noise(x + sum(np.cos(2 * np.pi * k * SHAFT * t + k) / k for k in range(1, 11)), 0.3)
    found = judged(x, rpm=RPM / 1.006)
    assert found.parts == ("outer_race",)
    assert found.shaft.by == "record"
    assert found.shaft.rate == pytest.approx(SHAFT, rel=1e-3)
    one = found.evidence["outer_race"]
    assert one.factor == pytest.approx(1.008, abs=0.0015)
    for line in one.lines:
        assert line.found == pytest.approx(1.008 * line.expected, rel=2e-3)
    # A bearing with that order at a contact angle: cos α = (1 − 2 · order / 9) d_m / D.
    row = br.catalogue["6205"]
    cosine = (1 - 2 * one.factor * one.order / 9) * row.pitch_diameter / row.ball_diameter
    assert one.contact_angle == pytest.approx(math.acos(cosine))


def test_a_run_up_is_judged_over_the_angle() -> None:
    """Blows of the outer race while the shaft goes from 20 to 40 turns a second."""
    rng = np.random.default_rng(1)
    t = np.arange(round(3.0 * FS)) / FS
    turns = 20.0 * t + 20.0 / 6.0 * t**2
    passes = np.arange(1.0, turns[-1] * ORDERS.bpfo) + 0.005 * rng.normal()
    x = 0.1 * rng.normal(size=t.size)
    x[np.searchsorted(turns * ORDERS.bpfo, passes + 0.005 * rng.normal(size=passes.size))] += 3.0
    turn, value = br.spectra.by_order(x, 2 * np.pi * turns)
    assert br.diagnose(value, "6205", 60.0, fs=1.0 / turn[1]).parts == ("outer_race",)
    assert not judged(x, rpm=1800.0).parts


@pytest.mark.parametrize("sides", [(-1, 0, 1), (-2, -1, 1, 2)])
def test_a_ball_is_found_by_either_of_its_families(sides: tuple[int, ...]) -> None:
    """Noise that swells at 2·BSF with sidebands of the cage; of a ball whose axis turns with sidebands alone."""
    t = np.arange(round(2.0 * FS)) / FS
    rates = [k * RATES["ball"] + side * ORDERS.ftf for k in (1, 2, 3) for side in sides]
    swelling = np.sum([np.cos(2 * np.pi * rate * SHAFT * t + rate) for rate in rates], axis=0)
    x = np.random.default_rng(1).normal(size=t.size) * (1.0 + 0.06 * swelling)
    evidence = judged(x).evidence
    found = evidence["ball"]
    assert found.z > 8.0
    assert max(evidence[race].z for race in ("outer_race", "inner_race")) < 4.0
    assert any("FTF" in line.label for line in found.lines)
    assert any("2·FTF" in line.label for line in found.lines) == (2 in sides)


def test_a_ball_that_meets_the_load_zone_now_and_then_is_found() -> None:
    """Blows at 2·BSF, 1.7 % above nominal, while the ball is in the load zone, a third of a turn of the cage.

    Truth: they fill four sidebands of the cage on each side, which are no chance.
    """
    base = 1.017 * RATES["ball"]
    x = blows(base)
    cage = np.cos(2 * np.pi * ORDERS.ftf * SHAFT * np.arange(x.size) / FS)
    found = judged(noise(x * np.maximum(cage - 0.5, 0.0), 0.01))
    assert found.parts == ("ball",)
    assert found.evidence["ball"].factor == pytest.approx(1.017, abs=0.0025)


def test_the_null_of_a_ball_holds_none_of_its_sidebands() -> None:
    """Truth: a comb at an order of the cage beside 2·BSF has its lines in common with the ball's."""
    drawn = null_orders(ORDERS, "ball", np.random.default_rng(0))
    sides = RATES["ball"] + np.arange(-4, 5) * ORDERS.ftf
    assert drawn.size == 600
    assert np.abs(drawn[:, np.newaxis] / sides - 1.0).min() >= 0.025


def test_what_names_the_bearing_does_not_matter() -> None:
    x = noise(blows(ORDERS.bpfi, 1.0), 0.3)
    scene = br.bearing("6205", radial_load=500.0, speed_rpm=RPM)
    for bearing in (
        "6205-2RS/C3",
        br.catalogue["6205"],
        scene,
        scene.rows[0],
        ORDERS,
        vars(ORDERS),
    ):
        assert judged(x, bearing).parts == ("inner_race",), bearing


def test_what_holds_the_record_does_not_matter() -> None:
    x = noise(blows(ORDERS.bpfi, 1.0), 0.3)
    record = br.Recording(columns={"quiet": np.ones(x.size), "DE": x}, fs=FS, shaft=SHAFT)
    alone = judged(x)
    for found in (br.diagnose(record, "6205", column="DE"), br.diagnose(record.channel("DE"), "6205"),
                  br.diagnose(br.measure(x, fs=FS, shaft=SHAFT), "6205")):  # fmt: skip
        assert found.evidence["inner_race"].z == pytest.approx(alone.evidence["inner_race"].z)


def test_what_is_excluded_accuses_nobody() -> None:
    """A fan whose blades pass at the order of the outer race."""
    x = noise(blows(ORDERS.bpfo), 0.3)
    assert judged(x).verdict == "damaged"
    found = judged(x, exclude=[ORDERS.bpfo])
    assert found.verdict == "undecided"
    assert found.evidence["outer_race"].hidden > 0.9
    assert "excluded" in found.why


def run_of(x: Signal, scale: float, rpm: float = RPM) -> br.diagnosis.Diagnosis:
    """Return the verdict on a signal as that of a run, of a scaled size [m/s²]."""
    scene = br.bearing("6205", radial_load=500.0, speed_rpm=rpm)
    fs = FS * rpm / RPM
    return br.diagnose(
        br.Channel(
            x=scale * x / x.std(), fs=fs, unit="m/s^2", shaft=rpm / 60.0, scene=scene, is_run=True
        )
    )


def test_weak_lines_are_left_open_and_clear_a_run_only() -> None:
    """The same blows as an acceleration of 0.05 m/s², as of a loaded healthy bearing, and of 50 m/s²."""
    x = noise(blows(ORDERS.bpfo), 0.05)
    quiet, loud = (judged(scale * x / x.std(), unit="m/s^2") for scale in (0.05, 50.0))
    assert quiet.verdict == "undecided"
    assert "lines of the outer race are certain" in quiet.why
    assert "early damage, a distant sensor, or a wrong unit" in quiet.why
    assert loud.parts == ("outer_race",)
    run = run_of(x, 0.05)
    assert run.verdict == "healthy"
    assert run.why.startswith("lines of the outer race are there")
    in_g = judged(50.0 / 9.80665 * x / x.std(), unit="g").evidence["outer_race"].strength
    assert in_g.acceleration == pytest.approx(loud.evidence["outer_race"].strength.acceleration)
    # Nearly all of the record comes at that rate.
    assert 40.0 < in_g.acceleration < 50.0


def test_faint_blows_of_a_ball_are_damage() -> None:
    """Neither the load zone nor waves of a race have a ball's rate, so that its blows need no size."""
    x = noise(blows(RATES["ball"], SIDEBANDS["ball"]), 0.05)
    assert judged(0.1 * x / x.std(), unit="m/s^2").parts == ("ball",)
    assert run_of(x, 0.1).parts == ("ball",)


def decide(evidence: dict[Part, Any], **more: Any) -> Verdict:
    """Return the verdict on evidence of a record that lacks nothing and would have shown damage."""
    seen = br.diagnosis.Sensitivity(share=0.1, acceleration=1.0, width=1e-3)
    given: dict[str, Any] = {
        "size": None,
        "falls": False,
        "is_run": False,
        "bursts": None,
        "seen": seen,
        "wanting": (),
    }
    return decided(evidence, 0.01, **(given | more))


def test_a_record_in_which_nothing_would_stand_out_clears_nothing() -> None:
    evidence = dict(judged(noise(np.zeros(24_000), 1.0)).evidence)
    assert decide(evidence, seen=None).verdict == "undecided"
    assert decide(evidence, seen=None, is_run=True).verdict == "healthy"


def test_lines_of_a_slow_run_leave_it_open() -> None:
    """Blows at 590 1/min: healthy ones have up to 0.3 m/s² there, 1.8 times the limit for faint lines."""
    x = noise(blows(ORDERS.bpfo), 0.05)
    quiet, between, loud = (run_of(x, scale, RPM / 3) for scale in (0.15, 0.4, 2.0))
    assert (quiet.verdict, between.verdict, loud.verdict) == ("healthy", "undecided", "damaged")
    assert "from when it was new" in between.why


def test_balls_that_fall_leave_it_open() -> None:
    """Below 530 1/min gravity takes unloaded balls of a healthy 6205 off the outer race, which they strike.

    Truth: ω_c² D/2 = 0.5 and 1.6 g. Simulated healthy bearings have such lines below 1 g (`_TINY`).
    """
    x = noise(blows(ORDERS.bpfo), 0.05)
    for rpm, parts in ((380.0, ()), (680.0, ("outer_race",))):
        for unit in (None, "m/s^2"):
            found = br.diagnose(
                5.0 * x / x.std(), "6205", rpm, fs=FS * rpm / RPM, unit=unit, speed_within=1e-3
            )
            assert found.parts == parts, (rpm, unit)
            assert ("fall off the race" in found.why) == (not parts)


def test_a_resonance_without_blows_needs_to_be_loud() -> None:
    """Weak blows at 3 kHz, and tones around 0.9 kHz at multiples of BPFO, 100 and 10 000 times as strong.

    Truth: blows of 0.05 m/s² are tiny; tones are damage from ten times the limit on, 24 m/s² (`_RINGING`).
    """
    x = blows(ORDERS.bpfo)
    t = np.arange(x.size) / FS
    tones = np.sum([np.cos(2 * np.pi * k * ORDERS.bpfo * SHAFT * t) for k in (8, 9)], axis=0)
    x = 0.05 * noise(x / x.std(), 0.05)
    for size, parts in ((5.0, ()), (500.0, ("outer_race",))):
        found = judged(x + size * tones, unit="m/s^2")
        strength = found.evidence["outer_race"].strength
        assert strength.acceleration > 0.5 * size
        assert strength.impulsive < 0.06
        assert found.parts == parts


def test_waves_without_blows_leave_it_open() -> None:
    """Tones at multiples of BPFO, as of balls that pass through the load zone of a smooth bearing, in noise.

    Truth: the squared envelope of tones has a depth of at most 1, and they a kurtosis below 3; however strong.
    """
    t = np.arange(round(4.0 * FS)) / FS
    tones = [np.cos(2 * np.pi * k * ORDERS.bpfo * SHAFT * t + k * k) for k in range(4, 12)]
    x = noise(np.sum(tones, axis=0), 1.0)
    for unit in (None, "m/s^2"):
        found = judged(10.0 * x, unit=unit)
        one = found.evidence["outer_race"]
        assert one.probability < 0.01
        assert one.strength.depth > 0.5
        assert one.strength.kurtosis < 3.5
        assert found.verdict == "undecided"
        assert "no impacts stand out" in found.why


def weaker(one: Evidence, acceleration: float) -> Evidence:
    """Return evidence of lines that carry an acceleration, all of it by impacts."""
    strength = replace(one.strength, acceleration=acceleration, impulsive=acceleration)
    return replace(one, strength=strength)


def test_likelihood_decides_what_is_weak() -> None:
    """Weak blows that carry the vibration at their rate are damage at ten to one, in sizes of the library."""
    x = noise(blows(ORDERS.bpfi, duration=4.0), 0.05)
    evidence = dict(judged(x / x.std(), unit="m/s^2").evidence)
    diameter = br.catalogue["6205"].pitch_diameter
    size = Size(diameter=diameter, rate=SHAFT, pressed=math.inf)
    own = weaker(evidence["inner_race"], 0.7e-3 * math.pi * SHAFT / diameter)

    def inner(ratio: float, one: Evidence = own, size: Size | None = size, **more: Any) -> Verdict:
        named = replace(one, probability=1e-4, ratio=ratio)
        return decide(evidence | {"inner_race": named}, size=size, **more)

    assert size.is_tiny(own)
    assert inner(0.05).parts == ("inner_race",)
    assert "and among simulated bearings are 20 times likelier" in inner(0.05).why
    ringing = replace(
        own, strength=replace(own.strength, impulsive=0.1 * own.strength.acceleration)
    )
    distant = weaker(own, 0.6 * own.strength.impulsive)
    left = (
        inner(0.2), inner(0.05, ringing), inner(0.05, distant), inner(0.05, falls=True),
        inner(0.05, size=replace(size, diameter=0.015)),
    )  # fmt: skip
    assert {found.verdict for found in left} == {"undecided"}
    large = {each: replace(size, diameter=each) for each in (0.12, 0.13)}
    named = {
        each: inner(0.05, weaker(own, 0.7e-3 * math.pi * SHAFT / each), of).parts
        for each, of in large.items()
    }
    assert named == {0.12: ("inner_race",), 0.13: ()}
    doubted = replace(own, probability=0.02, ratio=0.05)
    assert decide(evidence | {"inner_race": doubted}, size=size).verdict == "undecided"


def test_impacts_that_come_with_the_cage_are_a_balls() -> None:
    """Blows at no part's rate while one ball is in the load zone; and by hand: what chance has is no damage."""
    rng = np.random.default_rng(1)
    t = np.arange(round(8.0 * FS)) / FS
    x = np.zeros(t.size)
    swell = np.maximum(np.cos(2 * np.pi * ORDERS.ftf * SHAFT * t), 0.0) ** 4
    x[rng.random(t.size) < 8e-3 * swell] = 30.0
    found = judged(noise(x, 1.0), speed_within=1e-3)
    assert found.parts == ("ball",)
    assert "come and go with the cage" in found.why
    evidence = dict(judged(noise(np.zeros(24_000), 1.0)).evidence)
    assert decide(evidence, bursts=Bursts(kurtosis=20.0, probability=1e-3)).parts == ("ball",)
    assert not decide(evidence, bursts=Bursts(kurtosis=20.0, probability=0.02)).parts


DRIFTS: dict[str, Callable[[Signal], Signal]] = {
    "ramp": lambda t: 50.0 * t / t[-1],
    "step": lambda t: 20.0 * (t > 0.37 * t[-1]),
    "decay": lambda t: 20.0 * np.exp(-t / 0.3),
    "wave": lambda t: 50.0 * np.sin(2 * np.pi * 0.3 * SHAFT * t),
}


@pytest.mark.parametrize("drift", DRIFTS)
def test_a_drift_changes_no_verdict(drift: str) -> None:
    """Truth: what is slower than the shaft is no vibration of the bearing."""
    struck, silent = noise(blows(ORDERS.bpfo), 0.3), noise(np.zeros(24_000), 1.0)
    for x, verdict in ((10.0 * struck / struck.std(), "damaged"), (silent, "healthy")):
        slow = DRIFTS[drift](np.arange(x.size) / FS)
        plain, drifted = (judged(y, unit="m/s^2", speed_within=1e-3) for y in (x, x + slow))
        assert plain.verdict == drifted.verdict == verdict
        one, other = (found.evidence["outer_race"].strength for found in (plain, drifted))
        assert other.depth == pytest.approx(one.depth, abs=0.1)
        assert other.acceleration == pytest.approx(one.acceleration, rel=0.1, abs=0.03)


def test_a_drift_is_taken_out_and_the_shafts_orders_stay() -> None:
    t = np.arange(24_000) / FS
    wave = np.sin(2 * np.pi * 3.0 * SHAFT * t)
    left = without_drift(wave + 50.0 * t, FS, SHAFT)
    assert np.abs(left - wave).max() < 0.25
    assert np.abs(left - wave)[2000:-2000].max() < 0.02


def test_a_narrow_band_clears_nothing() -> None:
    """Noise below 1 kHz, by a low rate and by a filter, of a 6205: impacts would ring above."""
    from scipy.signal import butter, resample_poly, sosfilt

    white = noise(np.zeros(48_000), 1.0, seed=5)
    known: dict[str, Any] = {"speed_within": 1e-3, "false_alarm": 1e-4}
    low = sosfilt(butter(8, 1000.0, fs=FS, output="sos"), white)
    slow = resample_poly(white, 1, 6)
    assert judged(white, **known).verdict == "healthy"
    for x, fs, edge in ((low, FS, 1200.0), (slow, FS / 6.0, 1000.0)):
        assert upper_edge(x, fs) == pytest.approx(edge, rel=0.25)
        found = br.diagnose(x, "6205", RPM, fs=fs, **known)
        assert found.verdict == "undecided"
        assert "a wider band, to 3 kHz and more: this one ends at" in found.why
    # A bearing twice as large rings half as high.
    wide = resample_poly(white, 1, 3)
    assert "a wider band" in br.diagnose(wide, "6205", RPM, fs=FS / 3.0, **known).why
    assert "a wider band" not in br.diagnose(wide, "6412", RPM, fs=FS / 3.0, **known).why


def test_a_nominal_speed_clears_nothing_unless_the_record_shows_it() -> None:
    white = noise(np.zeros(24_000), 1.0)
    t = np.arange(white.size) / FS
    shaft = white + 0.2 * sum(np.cos(2 * np.pi * k * 1.06 * SHAFT * t + k) for k in range(1, 11))
    assert "the exact speed: the record has no clear lines of a shaft" in judged(white).why
    assert judged(white, speed_within=1e-3).verdict == "healthy"
    # The shaft turns 6 % faster than its nominal speed.
    found = judged(shaft)
    assert (found.verdict, found.shaft.by) == ("healthy", "record")
    assert found.shaft.rate == pytest.approx(1.06 * SHAFT, rel=1e-3)
    assert judged(shaft, speed_within=0.01).shaft.by == "nominal"


@pytest.mark.parametrize("slip", [0.96, 0.985, 1.01])
@pytest.mark.parametrize("part", ["outer_race", "inner_race"])
def test_one_cage_slips_for_all_parts(part: str, slip: float) -> None:
    """Truth: balls pass the outer race at Z·s·f_c and the inner race at Z·(f_r − s·f_c)."""
    orders = {"outer_race": slip * ORDERS.bpfo, "inner_race": 9.0 - slip * ORDERS.bpfo}
    found = judged(noise(blows(orders[part], SIDEBANDS[part]), 0.3), speed_within=1e-3)
    assert found.parts == (part,)
    for name, order in orders.items():
        one = found.evidence[name]  # type: ignore[index]
        assert one.factor * one.order == pytest.approx(order, rel=3e-3)
    assert found.evidence["cage"].factor == pytest.approx(slip, abs=4e-3)


@pytest.mark.parametrize("seed", range(3))
def test_a_race_at_the_speed_of_a_cage_that_rolls_comes_first(seed: int) -> None:
    """Blows of an inner race that swell twice a turn have lines at BPFI - 2 f_r, 0.957 BPFO of a 6222."""
    orders = br.catalogue["6222"].orders
    order = orders.bpfi - 0.005 * orders.bpfo
    assert (order - 2.0) / orders.bpfo == pytest.approx(0.957, abs=1e-3)
    x = noise(blows(order, 2.0, seed=seed, swell=1.5, off=0.003), 0.2, seed)
    found = judged(x, "6222", speed_within=1e-3)
    assert found.parts == ("inner_race",)


def test_what_is_at_the_end_of_a_search_is_not_found() -> None:
    """A cage 6 % slower than nominal, and a shaft 1.6 % beside a speed that is known within 1 %."""
    x = noise(blows(0.94 * ORDERS.bpfo), 0.3)
    assert judged(x, speed_within=1e-3).verdict == "undecided"
    t = np.arange(x.size) / FS
    shaft = 0.3 * sum(np.cos(2 * np.pi * k * 1.016 * SHAFT * t + k) for k in range(1, 11))
    found = judged(noise(np.zeros(x.size), 0.3) + shaft, speed_within=0.01)
    assert found.shaft.by == "nominal"


def test_impacts_at_another_rate_name_the_likely_mistake() -> None:
    """A speed that is 10 % off, a rate of another bearing, 11 025 for 12 000 Hz, a speed in hertz."""
    struck = noise(blows(ORDERS.bpfi, 1.0), 0.02)
    slow = judged(struck, rpm=1.1 * RPM, speed_within=1e-3)
    assert slow.verdict == "undecided"
    assert slow.why.startswith("the exact speed, or the right bearing: impacts repeat at 159.")
    other = judged(noise(blows(br.catalogue["6203"].orders.bpfo), 0.02), speed_within=1e-3)
    assert other.verdict == "undecided"
    assert "BPFO of a 6203 (3.054)" in other.why
    outer = noise(blows(ORDERS.bpfo), 0.02)
    audio = br.diagnose(outer, "6205", RPM, fs=11_025.0, speed_within=1e-3)
    assert audio.verdict == "undecided"
    assert "BPFO with fs=12000" in audio.why
    t = np.arange(struck.size) / FS
    shaft = struck + 0.3 * sum(np.cos(2 * np.pi * k * SHAFT * t + k) for k in range(1, 11))
    hertz = judged(shaft, rpm=SHAFT)
    assert hertz.verdict == "undecided"
    assert "29.5 was given, and the record has lines of a shaft at 29." in hertz.why


def test_a_changing_speed_is_named() -> None:
    """Blows of the outer race while the shaft goes from 20 to 40 turns a second."""
    rng = np.random.default_rng(1)
    t = np.arange(round(6.0 * FS)) / FS
    turns = 20.0 * t + 20.0 / 12.0 * t**2
    x = 0.3 * rng.normal(size=t.size)
    x[np.searchsorted(turns * ORDERS.bpfo, np.arange(1.0, turns[-1] * ORDERS.bpfo))] += 5.0
    found = judged(x, rpm=1800.0)
    assert found.verdict == "undecided"
    assert "the record over the shaft's angle (ballrace.spectra.by_order)" in found.why
    steady = judged(noise(blows(4.31, duration=6.0), 0.02))
    assert "by_order" not in steady.why


def test_what_is_asked_for_where_impacts_stand_out() -> None:
    """A run's own bearing and speed are exact; a damaged ball comes to the load once in a turn of the cage."""
    known = unexplained(57.4, exact=True, cage=False)
    assert known == (
        "a longer record: impacts stand out (kurtosis 57), but at no rate of this bearing"
    )
    asked = unexplained(57.4, exact=False, cage=False)
    assert asked == f"the exact speed, the right bearing, or {known}"
    assert unexplained(None, exact=True, cage=True) is None
    at_cage = unexplained(57.4, exact=False, cage=True)
    assert at_cage is not None
    assert "only at the cage's rate, as a damaged ball may have" in at_cage


def test_an_order_next_to_a_whole_one_needs_turns() -> None:
    """Truth: two lines are apart once a record has several times as many turns as one over their distance."""
    orders = br.catalogue["6309"].orders
    assert orders.bpfi == pytest.approx(4.963, abs=1e-3)
    x = noise(np.zeros(round(20.0 * FS)), 1.0)
    short, long = (judged(y, "6309", speed_within=1e-3) for y in (x[:24_000], x))
    assert short.verdict == "undecided"
    assert "race's order" in short.why
    assert f"at least {8.0 / (5.0 - orders.bpfi) / SHAFT:.3g} s" in short.why
    assert long.verdict == "healthy"


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("name", ["6204", "6308"])
def test_an_exact_speed_separates_an_inner_race_from_the_shaft(name: str, seed: int) -> None:
    """Truth: 4.95 times a rate, and its sidebands, are 5 times one that is 1 % lower, and its neighbours.

    In 40 turns nothing else separates them; blows once a turn of a shaft whose speed is known are no damage.
    """
    order, long = br.catalogue[name].orders.bpfi, 40.0 / SHAFT
    assert 4.9 < order < 4.95
    x = noise(blows(order, 1.0, seed=seed, duration=long), 0.1, seed)
    for within in (None, 0.01, 1e-3):
        found = judged(x, name, speed_within=within)
        assert (found.verdict, found.parts) == ("damaged", ("inner_race",))
    assert found.shaft.rate == pytest.approx(SHAFT, rel=1.001e-3)
    # The speed of a scene is exact.
    scene = br.bearing(name, speed_rpm=RPM)
    run = br.Channel(x=x, fs=FS, shaft=SHAFT, scene=scene)
    assert br.diagnose(run).parts == ("inner_race",)
    shaft = noise(blows(1.0, seed=seed, duration=long), 0.1, seed)
    assert judged(shaft, name, speed_within=1e-3).verdict == "undecided"


def test_a_velocity_clears_nothing() -> None:
    x = noise(np.zeros(24_000), 1.0)
    velocity = br.Channel(x=x, fs=FS, unit="m/s^2").to("mm/s")
    found = br.diagnose(velocity, "6205", RPM)
    assert found.verdict == "undecided"
    assert "an acceleration" in found.why


def test_shallow_lines_leave_it_open() -> None:
    """Noise that a waved inner race modulates by an eighth: lines without a blow."""
    t = np.arange(round(8.0 * FS)) / FS
    x = np.random.default_rng(1).normal(size=t.size)
    for k in (1, 2, 3):
        x *= 1.0 + 0.12 * np.cos(2 * np.pi * k * ORDERS.bpfo * SHAFT * t + k)
    found = judged(x)
    assert found.evidence["outer_race"].probability < 1e-3
    assert found.verdict == "undecided"
    assert "but modulate the vibration by" in found.why


def shaken(kind: str, rng: np.random.Generator, duration: float = 2.0) -> Signal:
    """Return a record in which no part of the bearing has lines."""
    t = np.arange(round(duration * FS)) / FS
    white = rng.normal(size=t.size)
    phases = rng.uniform(0.0, 2.0 * np.pi, size=12)

    def tones(f: float) -> Signal:
        waves = [np.cos(2 * np.pi * (k + 1) * f * t + phases[k]) / (k + 1) for k in range(12)]
        return np.asarray(3.0 * np.sum(waves, axis=0))

    blow = np.zeros(t.size)
    blow[rng.integers(0, t.size, 20)] = 30.0
    ringing = np.exp(-200.0 * t[:999]) * np.sin(2 * np.pi * rng.uniform(500, 4000) * t[:999])
    made: dict[str, Callable[[], Signal]] = {
        "white noise": lambda: white,
        "coloured noise": lambda: np.convolve(white, ringing, "same"),
        "shaft": lambda: tones(1.004 * SHAFT) + 0.1 * white,
        "shaft without noise": lambda: tones(1.004 * SHAFT),
        "noise modulated by the shaft": lambda: white * (1.0 + 0.5 * np.cos(2 * np.pi * SHAFT * t)),
        "mains": lambda: tones(50.0) + 0.3 * white,
        "noise modulated by the mains": lambda: white * (1.0 + 0.5 * np.cos(2 * np.pi * 100.0 * t)),
        "random impacts": lambda: blow + white,
        "clipped": lambda: np.clip(white, -1.0, 1.0),
    }
    return made[kind]()


KINDS = ["white noise", "coloured noise", "shaft", "shaft without noise", "noise modulated by the shaft", "mains",
         "noise modulated by the mains", "random impacts", "clipped"]  # fmt: skip


def most(count: int, rate: float) -> int:
    """Return the count that a binomial number exceeds once in a thousand times."""
    from scipy.stats import binom

    return int(binom.ppf(0.999, count, rate))


@pytest.mark.parametrize("kind", KINDS)
def test_nothing_of_the_kind_is_damaged(kind: str) -> None:
    # The speed is known, but for the shaft's own orders, 0.4 % beside it.
    within = None if kind.startswith("shaft") else 1e-3
    records = (shaken(kind, np.random.default_rng([7, k])) for k in range(8))
    verdicts = [judged(x, speed_within=within).verdict for x in records]
    assert verdicts.count("damaged") <= most(8, 0.01)
    assert kind != "clipped" or set(verdicts) == {"undecided"}
    # Noise that the shaft swells is no blows: 3 E[a⁴]/E[a²]² of a = 1 + cos(φ)/2 is 4.2.
    if kind in ("white noise", "coloured noise", "noise modulated by the shaft"):
        assert verdicts.count("healthy") >= 6


def test_hum_of_the_mains_is_no_race() -> None:
    """Within the speeds of the cage that are searched BPFO reaches 100 Hz: three in ten were called damaged."""
    records = [
        shaken("noise modulated by the mains", np.random.default_rng([8, k]), 1.0)
        for k in range(20)
    ]
    found = [judged(x) for x in records]
    assert sum(one.verdict == "damaged" for one in found) <= most(20, 0.01)
    assert any("as a sine does" in one.why for one in found)


@pytest.mark.long
@pytest.mark.parametrize("kind", KINDS)
def test_false_alarms_come_at_the_rate_asked_for(kind: str) -> None:
    """500 records of each kind; of white noise the probabilities themselves are right, too."""
    found = [judged(shaken(kind, np.random.default_rng([8, k]), 1.0)) for k in range(500)]
    accused = sum(one.verdict == "damaged" for one in found)
    print(f"\n[verdict] {kind}, 500 records of 1 s | {accused} | at most {most(500, 0.01)}")
    assert accused <= most(500, 0.01)
    if kind == "white noise":
        least = np.array(
            [min(e.probability for p, e in d.evidence.items() if p != "cage") for d in found]
        )
        for rate in (0.05, 0.2):
            assert np.mean(least < rate) == pytest.approx(rate, rel=0.35)


def test_500_records_that_allow_no_evidence_accuse_nobody() -> None:
    """Silence at any level and 0.1 s of blows are left open, what is no number is refused, each by its name."""
    for k in range(500):
        rng = np.random.default_rng([9, k])
        silent = judged(np.full(24_000, rng.normal()))
        assert (silent.verdict, "silent" in silent.why) == ("undecided", True)
        x = noise(blows(ORDERS.bpfo, seed=k, duration=0.1), 0.1, k)
        short = judged(x)
        assert (short.verdict, short.why.startswith("a longer record")) == ("undecided", True)
        x[rng.integers(x.size)] = rng.choice([math.nan, math.inf, -math.inf])
        with pytest.raises(br.SceneError, match=r"^record = (nan|-?inf) in sample \d+: finite"):
            judged(x)
    for kind, allowed in (
        ("silence", "left open"),
        ("0.1 s", "left open"),
        ("not a number", "refused"),
    ):
        print(f"\n[verdict] {kind}, 500 records | 0 | all {allowed}")


def test_probabilities_are_those_of_extreme_values() -> None:
    """Truth: the largest of 50 normal numbers is all but Gumbel's, with the robust scale of the null."""
    rng = np.random.default_rng(1)
    largest = rng.gumbel(size=400_000)
    middle = np.median(largest)
    z = (largest - middle) / (1.4826 * np.median(np.abs(largest - middle)))
    for rate in (0.1, 0.01, 0.001):
        assert probability(float(np.quantile(z, 1.0 - rate))) == pytest.approx(rate, rel=0.15)
        assert probability(largest_z(rate, 3), 3) == pytest.approx(rate)
    assert probability(-1e3) == 1.0
    assert 0.0 <= probability(1e3) < 1e-100


LACKING = {
    "silent": (np.zeros(24_000), {}, "silent"),
    "constant": (np.full(24_000, 3.0), {}, "silent"),
    "short": (noise(np.zeros(1200), 1.0), {}, "a longer record, at least 0.678 s"),
    "slow": (noise(np.zeros(24_000), 1.0), {"fs": 300.0}, "a higher sampling rate, at least"),
}  # fmt: skip


@pytest.mark.parametrize("lacking", LACKING)
def test_a_record_that_allows_no_evidence_says_what_it_lacks(lacking: str) -> None:
    x, more, why = LACKING[lacking]
    found = br.diagnose(x, "6205", RPM, **({"fs": FS} | more))  # type: ignore[arg-type]
    assert found.verdict == "undecided"
    assert why in found.why
    assert not found.evidence
    with pytest.raises(br.SceneError, match="the record needs"):
        found.plot()


X = noise(blows(ORDERS.bpfo, duration=1.0), 0.3)
REFUSED: dict[str, Callable[[], object]] = {
    "record = nan in sample 5": lambda: judged(np.where(np.arange(X.size) == 5, np.nan, X)),
    "bearing = ": lambda: br.diagnose(X, None, RPM, fs=FS),
    "designation = '62x5'": lambda: judged(X, "62x5"),
    "bearing = {'bpfo': 3.0}": lambda: judged(X, {"bpfo": 3.0}),
    "bearing.bpfo = 0.0": lambda: judged(X, vars(ORDERS) | {"bpfo": 0.0}),
    "speed_rpm = None": lambda: br.diagnose(X, "6205", fs=FS),
    "speed_rpm = 0.0": lambda: judged(X, rpm=0.0),
    "speed_within = 0.1": lambda: judged(X, speed_within=0.1),
    "speed_within = nan": lambda: judged(X, speed_within=math.nan),
    "fs = None": lambda: br.diagnose(X, "6205", RPM),
    "false_alarm = 0.5": lambda: judged(X, false_alarm=0.5),
    "exclude = [0.0]": lambda: judged(X, exclude=[0.0]),
    "exclude = 1.7": lambda: judged(X, exclude=1.7),
    "seed = -1": lambda: judged(X, seed=-1),
    "mains = 0.0": lambda: judged(X, mains=0.0),
    "machine = 'small'": lambda: judged(X, machine="small"),
    "unit = 'V'": lambda: judged(X, unit="V"),
    "unit = 'g': left out": lambda: br.diagnose(
        br.Channel(x=X, fs=FS, unit="m/s^2"), "6205", RPM, unit="g"
    ),
    "record = 'a.wav': a record": lambda: br.diagnose("a.wav", "6205", RPM),
    "bearing = 6205": lambda: judged(X, 6205),  # type: ignore[arg-type]
    "bearing.bsf = 'x'": lambda: judged(X, vars(ORDERS) | {"bsf": "x"}),
    "row = 1": lambda: judged(X, br.bearing("6205", speed_rpm=1800.0), row=1),
    "part = 'shaft'": lambda: judged(X).plot("shaft"),  # type: ignore[arg-type]
}


@pytest.mark.parametrize("field", REFUSED)
def test_bad_input_is_refused_by_name(field: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        REFUSED[field]()
    assert str(caught.value).startswith(field)


def test_it_is_shown_in_five_lines_a_table_a_picture_and_a_page(tmp_path: Path) -> None:
    found = judged(100.0 * X, unit="m/s^2", machine="medium_rigid")
    assert len(repr(found).splitlines()) <= 5
    assert "damaged, outer race" in repr(found)
    assert "<td>outer race</td>" in found._repr_html_()
    fig = found.plot(title="A record")
    levels = found.evidence["outer_race"].lines
    assert list(fig.data[2].x) == [line.found for line in levels]
    found.report(tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    for text in (
        "Verdict: damaged, outer race",
        "Zone by ISO 20816-3",
        "2·BPFO",
        "By chance".lower(),
    ):
        assert text in page
    again = pickle.loads(pickle.dumps(found))
    assert (again.parts, again.why, dict(again.evidence)) == (
        found.parts,
        found.why,
        dict(found.evidence),
    )


def test_severity_is_that_of_a_tone_and_blows() -> None:
    """Truth: 10 m/s² at 100 Hz are 10/(2π·100·√2) m/s rms, 11.25 mm/s; a tone of 2 kHz is above the band."""
    t = np.arange(24_000) / FS
    x = 10.0 * np.sin(2 * np.pi * 100.0 * t) + 10.0 * np.sin(2 * np.pi * 2000.0 * t)
    severity = judged(noise(x, 1e-3), unit="m/s^2", machine="large_flexible").severity
    assert severity is not None
    assert severity.velocity == pytest.approx(11.254, rel=2e-3)
    assert severity.zone == "D"
    assert severity.band == (10.0, 1000.0)
    # Table A.1 of ISO 10816-3, and its neighbours.
    assert [zone_of(v, "large_rigid") for v in (2.2, 2.4, 4.6, 7.2)] == ["A", "B", "C", "D"]
    white = judged(noise(np.zeros(24_000), 1.0)).severity
    assert white is not None
    assert white.kurtosis == pytest.approx(3.0, abs=0.2)
    assert white.velocity is None


@pytest.mark.parametrize("rpm", [1e-10, 1e-300])
def test_a_turn_far_longer_than_the_record_leaves_all_open(rpm: float) -> None:
    found = br.diagnose(np.random.default_rng(0).normal(size=5000), "6205", rpm, fs=5000.0)
    assert found.verdict == "undecided"
    assert "turns of the shaft" in found.why


def test_a_speed_that_is_none_in_hertz_is_refused() -> None:
    with pytest.raises(br.SceneError, match="speed_rpm = 1e-322"):
        br.diagnose(np.ones(5000), "6205", 1e-322, fs=5000.0)


@pytest.mark.parametrize("name", ["608", "6205", "6316", "6324"])
def test_beyond_the_sizes_of_the_library_limits_are_three_times_as_high(name: str) -> None:
    one = judged(noise(blows(ORDERS.bpfo), 0.1)).evidence["outer_race"]
    size = Size(diameter=br.catalogue[name].pitch_diameter, rate=SHAFT, pressed=10.0)
    for strength, tiny in ((0.9e-3, True), (2.9e-3, name in {"608", "6324"}), (3.1e-3, False)):
        a = strength / at_any_size(1.0, size.diameter, SHAFT)
        is_that = replace(one, strength=replace(one.strength, acceleration=a, impulsive=a))
        assert size.is_tiny(is_that) is tiny
