"""A bearing followed over its records.

Truth: analytic, since it is known when blows begin, and how seldom chance departs.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace.trending.departure import departure_of, limit_of

FS, RPM = 12_000.0, 1797.0
PERIOD = FS * 60.0 / (br.catalogue["6205"].orders.bpfi * RPM)


def taken(k: int, height: float) -> NDArray[np.float64]:
    """A second of noise with blows at the rate of the inner race."""
    x = np.random.default_rng(k).normal(size=12_000)
    x[np.arange(0, x.size, PERIOD).astype(int)] += height
    return 3.0 * x


def _with(given: dict[str, Any], others: dict[str, Any]) -> dict[str, Any]:
    return given | others


def followed(heights: list[float], **options: Any) -> br.trending.Trend:
    records = (taken(k, height) for k, height in enumerate(heights))
    return br.trend(
        records, "6205", RPM, **_with({"fs": FS, "unit": "m/s^2", "speed_within": 1e-3}, options)
    )


def test_the_first_of_two_records_with_blows_departs() -> None:
    """One record with blows alone, the 13th, is an outlier; from the 16th on all have them."""
    found = followed([0.0] * 12 + [8.0, 0.0, 0.0] + [8.0] * 4)
    assert found.departed == 15
    assert set(found.departures) >= {"inner_race.acceleration", "crest_factor", "kurtosis"}
    assert found.table["parts"].to_list()[15:] == ["inner_race"] * 4
    assert found.table["verdict"].to_list()[:12] == ["healthy"] * 12
    assert "record 15 at 15 departs" in repr(found)


def snapshots(seed: int, height: float, late: int, count: int = 150) -> list[NDArray[np.float64]]:
    """Return records of a tenth of a second, three turns, in which blows of the inner race are lost in noise."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(count):
        x = rng.normal(size=1200)
        first = rng.uniform(0.0, PERIOD)
        x[np.arange(first, x.size - 1.0, PERIOD).astype(int)] += height * (k >= late)
        found.append(x)
    return found


def test_short_records_are_pooled_so_that_lines_depart() -> None:
    """Blows of five deviations in records of three turns: none has a verdict, lines of the last 20 depart."""
    found = br.trend(snapshots(1, 5.0, 110), "6205", RPM, fs=FS, unit="m/s^2", baseline=100)
    assert found.pooled == 21
    assert set(found.table["verdict"]) == {"undecided"}
    lines = found.table["inner_race.lines"].to_numpy()
    assert np.isnan(lines[:20]).all()
    assert not np.isnan(lines[20:]).any()
    assert 110 <= found.departures["inner_race.lines"] <= 130
    assert lines[-1] > lines[60:110].max() + 1.0
    assert "outer_race.lines" not in found.departures
    # Few records of a baseline make small groups.
    assert br.trend(snapshots(1, 0.0, 0, 20), "6205", RPM, fs=FS, baseline=9).pooled == 3


@pytest.mark.parametrize("seed", range(3))
def test_pooled_lines_of_healthy_snapshots_do_not_depart(seed: int) -> None:
    found = br.trend(snapshots(10 + seed, 0.0, 0), "6205", RPM, fs=FS, unit="m/s^2", baseline=60)
    assert not {name for name in found.departures if name.endswith(".lines")}


def test_a_healthy_bearing_does_not_depart() -> None:
    found = followed([0.0] * 20)
    assert found.departed is None
    assert found.departures == {}
    assert "none departs" in repr(found)


def test_the_table_has_the_numbers_of_each_record() -> None:
    """Root mean square and velocity are those of the signal; both shapes are of one band."""
    found = followed(
        [0.0] * 4 + [8.0] * 2, baseline=3, machine="medium_rigid", times=[1, 2, 3, 4, 8, 9]
    )
    assert found.table["time"].to_list() == [1.0, 2.0, 3.0, 4.0, 8.0, 9.0]
    for k, height in ((0, 0.0), (5, 8.0)):
        x = taken(k, height)
        one = br.diagnose(x, "6205", RPM, fs=FS, unit="m/s^2", machine="medium_rigid")
        row = found.table.row(k, named=True)
        assert one.severity is not None
        assert row["rms"] == pytest.approx(x.std(), rel=1e-9)
        assert (row["velocity"], row["zone"]) == (one.severity.velocity, one.severity.zone)
        assert row["inner_race.z"] == one.evidence["inner_race"].z
    last = br.diagnose(taken(5, 8.0), "6205", RPM, fs=FS, unit="m/s^2")
    assert found.band in {
        last.evidence["inner_race"].band,
        *[e.band for e in last.evidence.values()],
    }


def test_records_that_allow_no_verdict_are_followed_by_their_level() -> None:
    """Half a second at 100 1/min is less than a turn: there is a root mean square, and no z."""
    rng = np.random.default_rng(2)
    records = [rng.normal(scale=s, size=6000) for s in [1.0] * 6 + [2.0] * 2]
    found = br.trend(records, "6205", 100.0, fs=FS, baseline=5)
    assert found.departures == {"rms": 6}
    assert found.band is None
    assert found.table["inner_race.z"].null_count() == 8


@pytest.mark.parametrize("count", [5, 10, 20])
def test_chance_departs_as_seldom_as_the_limit_says(count: int) -> None:
    """One value of a normal quantity exceeds the limit in 0.135 % of series, whatever the baseline's length."""
    x = np.random.default_rng(count).normal(loc=3.0, size=(10_000, count + 1))
    above = sum(row[-1] > limit_of(row[:-1]) for row in x)
    assert above / 10_000 == pytest.approx(0.00135, abs=4.0 * np.sqrt(0.00135 / 10_000))


def test_a_departure_is_twice_in_a_row_behind_the_baseline() -> None:
    assert departure_of(np.array([9.0, 9.0, 9.0, 0.0, 9.0, 0.0, 9.0, 9.0]), 3, 5.0) == 6
    assert departure_of(np.array([9.0, 9.0, 9.0, 0.0, 9.0, 0.0, 9.0]), 3, 5.0) is None


def test_the_picture_has_every_quantity_over_its_limit() -> None:
    found = followed([0.0] * 4 + [8.0] * 2, baseline=3)
    fig = found.plot(title="over a year")
    drawn = {trace.name: trace.y for trace in fig.data}
    assert np.allclose(drawn["z, inner race"], found.table["inner_race.z"])
    assert np.allclose(drawn["kurtosis"], found.table["kurtosis"] / found.limits["kurtosis"])
    assert len(drawn) == 3 + len(found.limits)
    assert fig.layout.title.text == "over a year"


def records() -> Iterator[br.Recording]:
    for k in range(5):
        yield br.Recording(columns={"a": taken(k, 0.0)}, fs=FS if k < 4 else 2.0 * FS, shaft=30.0)


@pytest.mark.parametrize(
    ("path", "given", "options"),
    [
        ("records", taken(0, 0.0)[:2], {"fs": FS}),
        ("records", next(records()), {}),
        ("records", [taken(k, 0.0) for k in range(4)], {"fs": FS}),
        ("records[4]", records(), {}),
        ("baseline", [], {"baseline": 2}),
        ("times", [taken(k, 0.0) for k in range(5)], {"fs": FS, "times": [0, 1, 2, 2, 3]}),
        ("times", [taken(k, 0.0) for k in range(5)], {"fs": FS, "times": [0, 1]}),
        ("bearing", [taken(k, 0.0) for k in range(5)], {"fs": FS, "bearing": None}),
    ],
)
def test_what_cannot_be_followed_is_refused(path: str, given: Any, options: dict[str, Any]) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.trend(given, **_with({"bearing": "6205", "speed_rpm": RPM, "baseline": 3}, options))
    assert caught.value.path == path


def test_a_change_is_the_ratio_to_the_reference() -> None:
    """Twice the record is twice the velocity, and as impulsive; blows of a record raise its kurtosis alone."""
    before, faulty = taken(1, 0.0), taken(1, 8.0)
    arguments: dict[str, Any] = {"fs": FS, "unit": "m/s^2"}
    found = br.diagnose(faulty, "6205", RPM, **arguments)
    assert found.severity is not None
    assert found.severity.change is None
    twice = found.against(0.5 * faulty, **arguments).severity
    assert twice is not None
    assert twice.change is not None
    assert vars(twice.change) == pytest.approx(
        {"velocity": 2.0, "crest_factor": 1.0, "kurtosis": 1.0}
    )
    rose = found.against(before, **arguments).severity
    assert rose is not None
    assert rose.change is not None
    assert rose.change.kurtosis == pytest.approx(found.severity.kurtosis / 3.0, rel=0.1)


def test_the_change_stands_on_the_page(tmp_path: Any) -> None:
    x = taken(1, 8.0)
    found = br.diagnose(x, "6205", RPM, fs=FS).against(x, fs=FS)
    found.report(tmp_path / "page.html")
    text = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert "Times those of the reference record: velocity –, crest factor 1, kurtosis 1." in text


def test_a_reference_of_another_kind_is_refused() -> None:
    x = taken(1, 8.0)
    found = br.diagnose(x, "6205", RPM, fs=FS)
    short = br.diagnose(x[:2000], "6205", RPM, fs=FS)
    for one, options in (
        (found, {"fs": FS, "unit": "g"}),
        (found, {"fs": 500.0}),
        (short, {"fs": FS}),
    ):
        with pytest.raises(br.SceneError) as caught:
            one.against(x, **options)
        assert caught.value.path == "reference"
