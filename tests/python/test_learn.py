"""Arrays and features for what learns.

Truth: analytic, since blows at a known rate, and what must not change the features, are known.
"""

from __future__ import annotations

import pickle
import warnings
from typing import Any

import numpy as np
import polars as pl
import pytest
from numpy.typing import NDArray

import ballrace as br

pytest.importorskip("sklearn", reason="scikit-learn is not installed")
from sklearn.linear_model import LogisticRegression
from sklearn.model_selection import cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import check_estimator

FS, RPM = 16_000.0, 1800.0
ORDERS = br.catalogue["6205"].orders
RATES = {"outer_race": ORDERS.bpfo, "inner_race": ORDERS.bpfi, "ball": 2.0 * ORDERS.bsf}


def lines(**options: Any) -> br.learn.EnvelopeLines:
    return br.learn.EnvelopeLines("6205", fs=FS, speed_rpm=RPM, **options)


def blows(part: str, seed: int = 1, seconds: float = 0.5) -> NDArray[np.float64]:
    """Noise with blows that slip by 1 % of a period."""
    rng = np.random.default_rng(seed)
    x = rng.normal(size=int(seconds * FS))
    if part in RATES:
        count = int(seconds * RATES[part] * RPM / 60.0)
        at = (np.arange(count) + 0.01 * rng.normal(size=count)) * 60.0 * FS / (RATES[part] * RPM)
        x[np.clip(np.rint(at).astype(int), 0, x.size - 1)] += 10.0
    return x


def test_conventions_of_scikit_learn() -> None:
    """All checks of an estimator pass; that of array interfaces wants a variable of the environment."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of checks that are skipped
        done = check_estimator(lines(), on_fail="raise")
        spectrum = check_estimator(lines(highest=10.0), on_fail="raise")
    for each in (*done, *spectrum):
        skipped = each["check_name"] == "check_array_api_input" and each["status"] == "skipped"
        assert each["status"] == "passed" or skipped, each["check_name"]
    assert len(done) > 40


@pytest.mark.parametrize("part", RATES)
def test_blows_raise_the_lines_of_their_part(part: str) -> None:
    found = lines().fit_transform([blows("none"), blows(part)])
    noise, faulty = (dict(zip(lines().fit(np.zeros((1, 99))).get_feature_names_out(), row, strict=True))
                     for row in found)  # fmt: skip
    heights = {p: faulty[f"{p}.height"] for p in (*RATES, "cage")}
    assert max(heights, key=heights.__getitem__) == part
    assert heights[part] > noise[f"{part}.height"] + 3.0
    assert faulty[f"{part}.depth"] > 2.0 * noise[f"{part}.depth"]


def test_the_order_of_the_blows_is_the_highest_of_the_spectrum() -> None:
    found = lines(highest=10.0, step=0.2)
    row = found.fit_transform([blows("outer_race", seconds=2.0)])[0]
    spectrum = row[list(found.get_feature_names_out()).index("order 0.4") :]
    assert found.orders_[np.argmax(spectrum)] % ORDERS.bpfo == pytest.approx(0.0, abs=0.15)


def test_neither_unit_nor_speed_change_the_features() -> None:
    """A record in other units, and one that runs twice as fast at twice the rate, are the same by turn."""
    x = blows("inner_race")
    wanted = lines().fit_transform([x])
    assert lines().fit_transform([1e3 * x]) == pytest.approx(wanted, rel=1e-9)
    fast = br.learn.EnvelopeLines("6205", fs=2.0 * FS, speed_rpm=2.0 * RPM)
    assert fast.fit_transform([x]) == pytest.approx(wanted, rel=1e-9)


def test_records_and_arrays_have_the_same_features() -> None:
    x = blows("outer_race")
    record = br.Recording(columns={"DE": x}, fs=FS, shaft=RPM / 60.0)
    without = br.Recording(columns={"DE": x}, fs=FS)
    of_records = br.learn.EnvelopeLines("6205").fit_transform([record, record.channel()])
    wanted = lines().fit_transform([x, x])
    assert np.array_equal(of_records, wanted)
    given = br.learn.EnvelopeLines("6205", speed_rpm=RPM)
    assert np.array_equal(given.fit_transform([without])[0], wanted[0])


def test_a_run_and_its_measurement_are_records() -> None:
    out = br.simulate(br.bearing("6205", radial_load=500.0, speed_rpm=1800.0), duration=0.1)
    sensed = br.measure(out, logger=br.measuring.Logger(fs=12_000.0))
    found = br.learn.EnvelopeLines("6205").fit_transform([out, sensed])
    assert found.shape == (2, 8)
    assert np.isfinite(found).all()


def test_silence_and_short_windows_have_zeros() -> None:
    assert not lines().fit_transform(np.zeros((1, 4000))).any()
    assert not lines().fit_transform(blows("none")[np.newaxis, :63]).any()


def test_in_a_pipeline_of_records() -> None:
    """Twelve records of three classes, separated without a mistake; a fitted one can be pickled."""
    names = [*RATES, "none"] * 4
    x = [
        br.Recording(columns={"a": blows(n, k)}, fs=FS, shaft=RPM / 60.0)
        for k, n in enumerate(names)
    ]
    model = make_pipeline(br.learn.EnvelopeLines("6205"), StandardScaler(), LogisticRegression())
    assert cross_val_score(model, x, names, cv=4).min() == 1.0
    again = pickle.loads(pickle.dumps(model.fit(x, names)))
    assert list(again.predict(x)) == names


@pytest.mark.parametrize(
    ("path", "options", "given"),
    [
        ("fs", {"speed_rpm": RPM}, np.zeros((1, 100))),
        ("speed_rpm", {"fs": FS}, np.zeros((1, 100))),
        ("fs", {"fs": -1.0, "speed_rpm": RPM}, np.zeros((1, 100))),
        ("speed_rpm", {}, [br.Recording(columns={"a": np.ones(100)}, fs=FS)]),
        ("X", {}, br.Recording(columns={"a": np.ones(100)}, fs=FS)),
        ("highest", {"highest": 0.0}, [br.Recording(columns={"a": np.ones(100)}, fs=FS)]),
        ("step", {"highest": 1.0, "step": 0.5}, [br.Recording(columns={"a": np.ones(9)}, fs=FS)]),
        ("row", {"bearing": br.bearing("6205", speed_rpm=1800.0), "row": 1}, np.zeros((1, 100))),
    ],
)
def test_what_is_missing_is_named(path: str, options: dict[str, Any], given: Any) -> None:
    found = br.learn.EnvelopeLines(**({"bearing": "6205"} | options))
    with pytest.raises(br.SceneError) as caught:
        found.fit_transform(given)
    assert caught.value.path == path


def table(labels: list[Any]) -> pl.DataFrame:
    x = np.arange(5.0 * len(labels)).reshape(-1, 5)
    return pl.DataFrame({"x": x, "label": pl.Series(labels, dtype=pl.String)})


def test_examples_are_writable_32_bit_arrays_with_class_weights() -> None:
    found = br.learn.examples(table(["b", "a", "b", "b"]))
    assert found.classes == ("a", "b")
    assert found.y.tolist() == [1, 0, 1, 1]
    assert found.class_weight == {0: 2.0, 1: pytest.approx(2.0 / 3.0)}
    assert found.x.dtype == np.float32
    assert found.x.flags.writeable
    assert found.x.flags.c_contiguous
    found.x[0, 0] = 7.0
    assert np.array_equal(found.x.ravel()[1:], np.arange(1.0, 20.0))


def test_examples_of_a_campaign_are_named_by_what_was_met() -> None:
    given = table(["", "", ""]).select(
        "x",
        fault_outer_race=pl.Series([True, False, True]),
        fault_inner_race=pl.Series([False, False, True]),
        fault_ball=False,
    )
    found = br.learn.examples(given)
    assert [found.classes[k] for k in found.y] == ["outer_race", "healthy", "outer_race+inner_race"]


@pytest.mark.parametrize(
    ("path", "given", "options"),
    [
        ("column", table(["a"]), {"column": "y"}),
        ("label", table(["a"]), {"label": "kind"}),
        ("label", table(["a", None]), {}),
        ("column", pl.DataFrame({"x": [[1.0], [1.0, 2.0]], "label": ["a", "a"]}), {}),
    ],
)
def test_what_makes_no_examples_is_refused(
    path: str, given: pl.DataFrame, options: dict[str, Any]
) -> None:
    with pytest.raises(br.SceneError) as caught:
        br.learn.examples(given, **options)
    assert caught.value.path == path
