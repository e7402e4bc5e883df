"""How wide a spall is, and how likely damage is.

Truth: analytic where two blows follow each other by an arc that was chosen; the scenes of the shipped library,
whose records of one bearing at a time are judged by those of all others. How measured records come out is in
``test_diagnosis_measured.py``.
"""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import numpy as np
import pytest

import ballrace as br
from ballrace.diagnosis.library import library
from ballrace.diagnosis.likelihood import (
    at_any_size,
    fitted,
    judged,
    odds_of,
    rows_of,
    with_ratios,
)
from ballrace.diagnosis.null import ACCUSED, probability
from ballrace.diagnosis.strength import limits_of
from ballrace.diagnosis.verdict import DOUBT, UNLIKELY
from ballrace.diagnosis.width import are_clear, bridged

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ballrace.diagnosis.evidence import Evidence

ROOT = Path(__file__).parents[2]
FS, RPM = 51_200.0, 900.0
BEARING = br.catalogue["6205"]
BALL = BEARING.ball_diameter
RATES = {
    "outer_race": BEARING.orders.bpfo * RPM / 60.0,
    "inner_race": BEARING.orders.bpfi * RPM / 60.0,
}
Race = Literal["outer_race", "inner_race"]
RACES: tuple[Race, ...] = ("outer_race", "inner_race")


def passes(part: Race, arc: float, second: float = 0.8, seed: int = 1) -> NDArray[np.float64]:
    """Return blows at the rate of a race, each followed by another after an arc [ball diameters], in noise."""
    rng = np.random.default_rng(seed)
    x = np.zeros(round(4.0 * FS))
    begin = np.arange(0.1, 3.9, 1.0 / RATES[part])
    begin += 0.005 / RATES[part] * rng.normal(size=begin.size)
    # Balls go on with the cage along the outer race, and against the shaft along the inner one.
    cage, side = BEARING.orders.ftf, 1.0 if part == "outer_race" else -1.0
    turns = (cage if part == "outer_race" else 1.0 - cage) * RPM / 60.0
    behind = arc * BALL / (np.pi * turns * (BEARING.pitch_diameter + side * BALL))
    # A place on the inner race goes through the load zone once a turn.
    zone = 1.0 + 0.8 * (part == "inner_race") * np.cos(2 * np.pi * RPM / 60.0 * begin)
    for delay, height in ((0.0, 1.0), (behind, second)):
        np.add.at(
            x,
            np.rint((begin + delay) * FS).astype(int),
            height * zone * rng.uniform(0.7, 1.3, begin.size),
        )
    t = np.arange(400) / FS
    tones = np.array([[2700.0], [5100.0], [8300.0], [13_000.0]])
    rings = (np.exp(-900.0 * t) * np.sin(2 * np.pi * tones * t)).sum(axis=0)
    return np.convolve(x, rings)[: x.size] + 0.05 * rng.normal(size=x.size)


@pytest.mark.parametrize("part", RACES)
@pytest.mark.parametrize("arc", [0.15, 0.25, 0.4])
def test_the_arc_between_two_blows_is_found(part: Race, arc: float) -> None:
    found = br.diagnose(passes(part, arc), "6205", RPM, fs=FS)
    assert found.parts == (part,)
    width = found.width
    assert width.spacing is not None
    assert width.spacing == pytest.approx(arc * BALL, abs=0.01 * BALL)
    assert width.value is not None
    assert width.interval is not None
    # What is reported is the spacing and what spalls of the library are wider.
    assert width.value == pytest.approx(width.spacing + bridged(part)[1] * BALL)
    assert width.interval[0] < width.value < width.interval[1]
    assert f"width {1e3 * width.value:.2f} mm" in repr(found)


def test_where_no_width_is_known_there_is_a_reason() -> None:
    once = br.diagnose(passes("outer_race", 0.3, second=0.0), "6205", RPM, fs=FS)
    assert (once.parts, once.width.value, once.width.interval) == (("outer_race",), None, None)
    assert "no second event" in once.width.why
    orders = br.diagnose(passes("outer_race", 0.3), BEARING.orders, RPM, fs=FS)
    assert "only orders" in orders.width.why
    noise = br.diagnose(np.random.default_rng(1).normal(size=100_000), "6205", RPM, fs=FS)
    assert noise.width.part is None
    assert "no race is damaged" in noise.width.why
    with pytest.raises(br.errors.SceneError, match=r"no second event"):
        once.plot_size()
    silent = br.diagnose(np.ones(100_000), "6205", RPM, fs=FS)
    with pytest.raises(br.errors.SceneError, match=r"no part is called damaged"):
        silent.plot_size()


def test_the_averaged_pass_has_both_events() -> None:
    arc = 0.3
    found = br.diagnose(passes("outer_race", arc), "6205", RPM, fs=FS)
    other = br.diagnose(passes("outer_race", arc, seed=2), "6205", RPM, fs=FS)
    fig = found.plot_size(beside=other)
    x, y = (np.asarray(fig.data[0][name]) for name in ("x", "y"))
    near = [y[np.abs(x - at * 1e3 * BALL) < 0.1].max() for at in (0.0, 0.5 * arc, arc)]
    assert min(near[0], near[2]) > 3.0 * near[1]
    assert len(fig.data) == 2
    assert found.width.spacing is not None
    marked = [shape.x0 for shape in fig.layout.shapes]
    assert marked == pytest.approx([0.0, 1e3 * found.width.spacing])


def test_an_interval_of_nine_in_ten_holds_nine_in_ten() -> None:
    """Of every bearing's records the intervals are those of all other bearings."""
    rows = library()
    held, count, errors = 0, 0, []
    for part in RACES:
        for bearing in np.unique(rows["bearing"]):
            own = rows[(rows["part"] == part) & (rows["bearing"] == bearing)]
            own = own[are_clear(own)]
            low, middle, high = bridged(part, bearing)
            bridge = own["width"] - own["spacing"]
            held += int(np.count_nonzero((low <= bridge) & (bridge <= high)))
            errors += (np.abs(middle - bridge) / own["width"]).tolist()
            count += len(own)
    print(f"\n[verdict] simulated, width given, {count} records | {held / count:.0%} within 90 % intervals | "
          f"median error {np.median(errors):.0%}")  # fmt: skip
    assert count >= 100
    assert 0.85 <= held / count <= 0.95


def test_few_widths_are_reported_of_spalls_that_are_too_narrow() -> None:
    rows = library()
    rows = rows[np.isin(rows["part"], RACES)]
    clear, width = are_clear(rows), rows["width"]
    shares = {}
    for low, high in ((0.03, 0.1), (0.1, 0.2), (0.2, 0.45)):
        among = (low <= width) & (width < high)
        shares[low] = float(clear[among].mean())
        print(f"\n[verdict] simulated, spalls of {low:g} to {high:g} ball diameters | width given for "
              f"{shares[low]:.0%} of {np.count_nonzero(among)} | any speed, load, noise")  # fmt: skip
    assert shares[0.03] < 0.03
    assert shares[0.2] > shares[0.1]


@pytest.mark.parametrize("sized", [True, False])
def test_a_likelihood_ratio_is_calibrated(sized: bool) -> None:
    """Of records that are given a chance of damage as many are damaged, of bearings that the fit did not see."""
    rows = judged()
    chance, true = [], []
    for part in ACCUSED:
        for bearing in np.unique(rows["bearing"]):
            own = rows[rows["bearing"] == bearing]
            odds = odds_of(fitted(part, sized, bearing), rows_of(part, own, sized))
            chance += (odds / (1.0 + odds)).tolist()
            true += (own["part"] == part).tolist()
    predicted, damaged = np.array(chance), np.array(true)
    off = 0.0
    for low, high in ((0.0, 0.05), (0.05, 0.3), (0.3, 0.7), (0.7, 0.95), (0.95, 1.01)):
        among = (low <= predicted) & (predicted < high)
        mean, share = predicted[among].mean(), damaged[among].mean()
        off += abs(mean - share) * among.mean()
        unit = "with" if sized else "without"
        print(f"\n[verdict] simulated, chance of damage {low:g} to {min(high, 1.0):g}, {unit} unit | "
              f"{share:.0%} of {np.count_nonzero(among)} damaged | {mean:.0%} predicted")  # fmt: skip
    assert off < 0.03
    # As good as chance would be 0.25 for halves; a fit that knows the shares alone has 0.17.
    assert float(np.mean((predicted - damaged) ** 2)) < 0.08


def test_strength_is_judged_alike_at_any_size() -> None:
    """Truth: analytic. Waves of one height cause accelerations as 1/D², also in healthy ones of the library."""
    rows = judged()
    rows = rows[rows["part"] == "none"]
    diameter = np.array([br.catalogue[name].pitch_diameter for name in rows["bearing"]])
    speed = np.log(np.pi * diameter * rows["speed_rpm"] / 60.0)
    known = np.column_stack([np.ones(len(rows)), np.log(diameter), speed])
    left = np.linalg.lstsq(known, np.log(rows["accel_outer_race"]), rcond=None)[0][1]
    print(f"\n[verdict] simulated, acceleration of healthy bearings over their pitch diameter | "
          f"to the power {left - 2.0:.1f} | by theory −2")  # fmt: skip
    assert abs(left) < 0.4
    # Half the size, at the same speed of the pitch circle and with four times the acceleration: the same ratio.
    evidence = br.diagnose(passes("outer_race", 0.3), "6205", RPM, fs=FS, unit="m/s^2").evidence
    here, larger = ({p: _times(one, by) for p, one in evidence.items()} for by in (1.0, 4.0))
    ratio = with_ratios(here, 0.04, 15.0)["outer_race"].ratio
    assert ratio is not None
    assert 0.02 < ratio < 50.0
    assert with_ratios(larger, 0.02, 30.0)["outer_race"].ratio == pytest.approx(ratio)
    assert with_ratios(larger, 0.04, 15.0)["outer_race"].ratio < 0.9 * ratio  # type: ignore[operator]


def _times(one: Evidence, scale: float) -> Evidence:
    """Return evidence of a signal that is so many times as large."""
    strength = replace(one.strength, acceleration=scale * one.strength.acceleration)
    return replace(one, strength=strength)


def test_healthy_bearings_of_the_library_are_accused_at_the_rate_asked_for() -> None:
    """Each bearing judged by all others, also the smallest, which no other is like."""
    rows = judged()
    rows, accused = rows[rows["part"] == "none"], 0
    for bearing in np.unique(rows["bearing"]):
        own = rows[rows["bearing"] == bearing]
        row, rate = br.catalogue[str(bearing)], own["speed_rpm"] / 60.0
        limits = limits_of(math.pi * row.pitch_diameter)
        named = np.zeros(len(own), dtype=bool)
        for part in ACCUSED:
            damaged = judged()["part"] == part
            prior = np.count_nonzero(damaged) / np.count_nonzero(~damaged)
            ratio = prior / odds_of(fitted(part, True, str(bearing)), rows_of(part, own, True))
            chance = np.array([probability(z, len(ACCUSED)) for z in own[f"z_{part}"]])
            size = own[f"accel_{part}"] / at_any_size(1.0, row.pitch_diameter, 1.0) * rate
            loud = size >= np.maximum(limits.faint * rate, limits.slow)
            others = judged()[(judged()["part"] == "none") & (judged()["bearing"] != bearing)]
            strong = own[f"accel_{part}"] > others[f"accel_{part}"].max()
            named |= loud & (
                (chance < 0.01 * DOUBT) & (ratio < UNLIKELY[part]) | (chance < 0.01) & strong
            )
        accused += int(np.count_nonzero(named))
    print(f"\n[verdict] simulated, {len(rows)} healthy of the library, each bearing judged by all others | "
          f"{accused / len(rows):.1%} accused | 1 % asked for")  # fmt: skip
    assert accused <= 1.5 * 0.01 * len(rows)


def test_a_ratio_favours_what_is_there() -> None:
    found = br.diagnose(passes("outer_race", 0.3), "6205", RPM, fs=FS)
    ratios = {part: one.ratio for part, one in found.evidence.items()}
    assert ratios["cage"] is None
    assert ratios["outer_race"] is not None
    assert 0.01 <= ratios["outer_race"] < 0.2
    noise = br.diagnose(np.random.default_rng(1).normal(size=100_000), "6205", RPM, fs=FS)
    for part in RACES:
        ratio = noise.evidence[part].ratio
        assert ratio is not None
        assert ratio > 3.0


@pytest.mark.long
def test_the_library_is_what_its_command_makes(tmp_path: Path) -> None:
    """Golden: the first records, made anew by ``python benches/verdict_library.py``."""
    table = tmp_path / "library.csv"
    command = [
        sys.executable,
        str(ROOT / "benches" / "verdict_library.py"),
        "--count",
        "4",
        "-o",
        str(table),
    ]
    subprocess.run(command, check=True, capture_output=True)
    made = np.genfromtxt(
        table, delimiter=",", skip_header=1, dtype=library().dtype, encoding="utf-8"
    )
    shipped = library()[: len(made)]
    for name in library().dtype.names or ():
        if made.dtype[name].kind == "U":
            assert (made[name] == shipped[name]).all(), name
        else:
            near = np.isclose(made[name], shipped[name], rtol=0.1, atol=0.1, equal_nan=True)
            assert near.mean() > 0.8, name
    assert not math.isnan(float(made["z_ball"][0]))
