"""A classifier of records, and what separates simulated from measured ones.

Truth: analytic, blows at a known rate in noise, and features whose distribution is known.
"""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import ballrace as br
from ballrace.learn.character import NAMES, character_of
from ballrace.learn.domain import compared
from ballrace.learn.pieces import pieces_of
from test_learn import FS, RPM, blows

pytest.importorskip("sklearn", reason="scikit-learn is not installed")
from sklearn.ensemble import ExtraTreesClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.utils.estimator_checks import check_estimator

PARTS = {"none": "healthy", "outer_race": "outer_race", "inner_race": "inner_race"}


@pytest.fixture(scope="module")
def model() -> br.learn.Diagnoser:
    """A model of 90 windows of 15 turns, of 10 bearings."""
    names = [*PARTS] * 30
    x = [blows(name, seed) for seed, name in enumerate(names)]
    X = br.learn.EnvelopeLines("6205", fs=FS, speed_rpm=RPM).fit_transform(x)
    found = br.learn.Diagnoser(turns=15.0, fs=FS, classifier=LogisticRegression(max_iter=5000))
    return found.fit(X, [PARTS[name] for name in names], groups=np.arange(90) // 9)


def test_conventions_of_scikit_learn() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of checks that are skipped
        done = check_estimator(br.learn.Diagnoser(), on_fail="raise")
    for each in done:
        skipped = each["check_name"] == "check_array_api_input" and each["status"] == "skipped"
        assert each["status"] == "passed" or skipped, each["check_name"]


def test_held_out_accuracy_is_that_of_bearings_not_seen() -> None:
    """A feature that only says which bearing it is of is worth nothing on others."""
    bearing = np.arange(240) // 8
    y = np.where(bearing % 2, "healthy", "outer_race")
    X = bearing[:, np.newaxis] + 1e-3 * np.random.default_rng(1).normal(size=(240, 3))
    by_heart = br.learn.Diagnoser(classifier=ExtraTreesClassifier(random_state=0), false_alarm=None)
    assert (by_heart.fit(X, y).predict(X) == y).mean() > 0.9
    fair = by_heart.fit(X, y, groups=bearing)
    assert fair.held_out_accuracy_ < 0.7
    assert fair.confusion_.sum() == 240
    assert len(fair.models_) == 5


def test_no_more_healthy_records_are_accused_than_asked_for() -> None:
    """Two classes that overlap by 16 %, named by the nearer one or so that 2 % of the healthy ones are accused."""
    rng = np.random.default_rng(2)
    y = np.repeat(["healthy", "outer_race"], 600)
    X = rng.normal(size=(1200, 2)) + 2.0 * (y == "outer_race")[:, np.newaxis] / np.sqrt(2.0)
    Z = rng.normal(size=(2000, 2))
    accused = {}
    for rate in (None, 0.02):
        model = br.learn.Diagnoser(false_alarm=rate, classifier=LogisticRegression())
        model.fit(X, y, groups=np.arange(1200) % 60)
        accused[rate] = float((model.predict(Z) != "healthy").mean())
    assert accused[None] == pytest.approx(0.159, abs=0.03)
    assert accused[0.02] == pytest.approx(0.02, abs=0.015)
    with pytest.raises(br.SceneError, match="false_alarm"):
        br.learn.Diagnoser(false_alarm=1.5).fit(X, y)


@pytest.mark.parametrize("part", PARTS)
def test_a_record_is_judged_by_the_vote_of_its_pieces(model: br.learn.Diagnoser, part: str) -> None:
    """Two seconds are four pieces of 15 turns; the record is sampled three times as densely as what was learnt."""
    assert model.held_out_accuracy_ > 0.95
    x = blows(part, 7, seconds=2.0)
    dense = br.measure(x, fs=FS, logger=br.measuring.Logger(fs=3.0 * FS)).x
    for record, fs in ((x, FS), (dense, 3.0 * FS)):
        found = model.diagnose(record, "6205", RPM, fs=fs)
        assert found.verdict == PARTS[part]
        assert sum(found.votes.values()) == 4
        assert found.votes[PARTS[part]] >= 3
        assert sum(found.probabilities.values()) == pytest.approx(1.0)
        assert found.shows_lines == (part != "none")
    assert str(found).startswith(PARTS[part])


def test_a_fault_without_lines_is_not_named() -> None:
    """A model that calls all but records full of lines an inner race's fault has nothing to go by in noise."""
    X = np.vstack([np.full((20, 8), 9.0), np.zeros((80, 8))])
    X[:20] += np.random.default_rng(1).normal(size=(20, 8))
    y = ["healthy"] * 20 + ["inner_race"] * 80
    model = br.learn.Diagnoser(turns=15.0, fs=FS).fit(X, y)
    found = model.diagnose(blows("none"), "6205", RPM, fs=FS)
    assert found.votes == {"healthy": 0, "inner_race": 1}
    assert (found.verdict, found.shows_lines) == ("shows no lines", False)


def test_pieces_are_as_long_by_turn_and_as_densely_sampled() -> None:
    record = br.Channel(x=np.sin(np.arange(51_200 * 3) * 0.01), fs=51_200.0, shaft=10.0)
    pieces = pieces_of(record, 12.0, 12_000.0)
    assert len(pieces) == 2
    assert all(piece.fs == pytest.approx(12_000.0, rel=5e-3) for piece in pieces)
    assert all(piece.n_samples / piece.fs == pytest.approx(1.2, rel=1e-3) for piece in pieces)
    slow = br.Channel(x=record.x, fs=8000.0, shaft=10.0)
    assert {piece.fs for piece in pieces_of(slow, 12.0, 12_000.0)} == {8000.0}
    assert len(pieces_of(slow, 1000.0, 12_000.0)) == 1


@pytest.mark.parametrize(
    ("path", "options", "given"),
    [
        ("bearing", {}, {"bearing": None}),
        ("speed_rpm", {}, {"speed_rpm": None}),
        ("record", {}, {"record": np.ones(500)}),
        ("turns", {"turns": 1.0}, {}),
        ("fs", {"fs": 0.0}, {}),
        ("lines", {"lines": br.learn.EnvelopeLines(highest=5.0)}, {}),
    ],
)
def test_what_is_missing_is_named(
    model: br.learn.Diagnoser, path: str, options: dict[str, Any], given: dict[str, Any]
) -> None:
    changed = br.learn.Diagnoser(**{"turns": 15.0, "fs": FS, **options})
    changed.__dict__.update(
        {name: value for name, value in vars(model).items() if name.endswith("_")}
    )
    asked: dict[str, Any] = {"record": blows("none"), "bearing": "6205", "speed_rpm": RPM, "fs": FS}
    asked |= given
    with pytest.raises(br.SceneError) as caught:
        changed.diagnose(asked.pop("record"), **asked)
    assert caught.value.path == path


def test_groups_that_are_none_are_refused() -> None:
    with pytest.raises(br.SceneError, match="groups"):
        br.learn.Diagnoser().fit(np.zeros((4, 2)), ["a", "b"] * 2, groups=[1, 1, 1, 1])


# ------------------------------------------------------------------------------- what betrays a simulation


def character(x: NDArray[np.float64], shaft: float = 25.0) -> dict[str, float]:
    return dict(zip(NAMES, character_of(br.Channel(x=x, fs=12_000.0, shaft=shaft)), strict=True))


def test_character_of_known_signals() -> None:
    rng, t = np.random.default_rng(3), np.arange(24_000) / 12_000.0
    noise = rng.normal(size=t.size)
    plain = character(noise)
    assert plain["plain kurtosis"] == pytest.approx(3.0, abs=0.15)
    assert [plain[f"spectrum {k}"] for k in range(1, 7)] == pytest.approx([-7.78] * 6, abs=0.4)
    assert plain["floor lines"] < 3.0
    tones = sum(np.sin(2 * np.pi * f * t) for f in np.arange(100.5, 6000.0, 100.0))
    assert character(noise + tones)["floor lines"] == pytest.approx(10.0, abs=2.0)
    swelling = noise * (1.0 + 0.3 * np.cos(2 * np.pi * 50.0 * t))
    # Its square has a line of 2 m over 1 + m²/2 at the second order.
    assert character(swelling)["swell 2"] == pytest.approx(20.0 * np.log10(0.6 / 1.045), abs=1.0)
    assert character(swelling)["swell 1"] < -20.0
    assert character(np.tile(noise[:480], 50))["repeats"] > 0.9  # once a turn
    assert plain["repeats"] < 0.1
    assert character(np.exp(np.repeat(rng.normal(size=8), 3000)) * noise)["wander"] > 3.0
    assert not any(character(np.zeros(24_000)).values())


def test_a_report_names_what_betrays() -> None:
    """Of the same distribution nothing; then one feature that is shifted, and one of the path."""
    rng = np.random.default_rng(5)
    names = ["height", "kurtosis", "spectrum 1"]
    simulated, measured = rng.normal(size=(300, 3)), rng.normal(size=(80, 3))
    bearings, runs = np.arange(300) // 10, np.arange(80) // 10
    alike = compared(names, simulated, measured, bearings, runs)
    assert 0.3 < alike.auc < 0.7
    assert alike.outside == ()
    measured[:, 2] += 6.0
    path = compared(names, simulated, measured, bearings, runs)
    assert path.auc > 0.99
    assert path.auc_without_path < 0.7
    assert (path.betraying[0], path.outside) == ("spectrum 1", ("spectrum 1",))
    measured[:, 1] -= 6.0
    assert compared(names, simulated, measured, bearings, runs).auc_without_path > 0.99
    assert "spectrum 1" in str(path)


def test_a_report_of_simulated_records_and_one_that_is_not(tmp_path: Any) -> None:
    """A tone in faint noise, which no simulated record is."""
    recipe = br.learn.Recipe("6205", speed_rpm=3000.0, faults={"outer": (0.5, 2.0)})
    data = br.learn.dataset(
        recipe, tmp_path / "runs", per_class=3, machines=br.measuring.random_chains(3, seed=1), window=0.11,
        per_case=3, threads=1, progress=False,
    )  # fmt: skip
    noise = np.random.default_rng(1).normal(size=12_000)
    tone = 30.0 * np.sin(2.0 * np.pi * 1234.0 * np.arange(12_000) / 12_000.0) + noise
    found = br.learn.domain_report(data, tone, fs=12_000.0, speed_rpm=3000.0, label="healthy")
    assert found.auc > 0.9
    assert found.features.height == 8 + len(NAMES)
    for path, given in (("label", {"label": "cage"}), ("record", {"record": tone[:5000]})):
        asked = {"record": tone, "fs": 12_000.0, "speed_rpm": 3000.0} | given
        with pytest.raises(br.SceneError) as caught:
            br.learn.domain_report(data, **asked)
        assert caught.value.path == path
