"""Tables of cases, built."""

from __future__ import annotations

from itertools import count
from typing import Any

import numpy as np
import pytest

import ballrace as br

RANGES = {"loads.axial.force": (-3000.0, 3000.0), "rows[0].clearance": (0.0, 2e-5)}


def test_a_grid_has_every_combination() -> None:
    found = br.grid({"a.b": [1.0, 2.0], "label": ["x", "y", "z"]})
    assert found.rows() == [
        (1.0, "x"), (1.0, "y"), (1.0, "z"), (2.0, "x"), (2.0, "y"), (2.0, "z"),
    ]  # fmt: skip


@pytest.mark.parametrize("build", [br.latin_hypercube, br.sobol])
def test_samples_fill_their_ranges(build: Any) -> None:
    """Analytic: of n strata of each range, a Latin hypercube and a scrambled Sobol sequence meet each once."""
    found = build(RANGES, 32, seed=3)
    for name, (low, high) in RANGES.items():
        strata = np.floor(32 * (found[name].to_numpy() - low) / (high - low))
        assert sorted(strata) == list(range(32))
    assert found.equals(build(RANGES, 32, seed=3))
    assert not found.equals(build(RANGES, 32, seed=4))


def test_scatter_has_the_deviations_asked_for() -> None:
    scene = br.presets.wheel_bearing()
    made = br.scatter(scene, 2000, seed=5, ball_diameter=0.3e-6, clearance=2e-6, groove_radius=5e-6)
    errors = np.array(made["rows[1].diameter_errors"].to_list())
    assert errors.shape == (2000, 13)
    assert errors.std() == pytest.approx(0.3e-6, rel=0.03)
    assert np.abs(errors).max() <= 0.9e-6
    clearance = made["rows[0].clearance"].to_numpy()
    assert clearance.std() == pytest.approx(2e-6, rel=0.05)
    row = scene.rows[0]
    radius = made["rows[0].inner_conformity"].to_numpy() * row.ball_diameter
    assert radius.std() == pytest.approx(5e-6, rel=0.05)
    assert radius.mean() == pytest.approx(row.inner_conformity * row.ball_diameter, abs=0.5e-6)
    phase = made["rows[0].start_angle"].to_numpy() - row.start_angle
    assert (phase.min() >= 0.0, phase.max() < 2.0 * np.pi / 13) == (True, True)
    assert phase.std() == pytest.approx(2.0 * np.pi / 13 / np.sqrt(12.0), rel=0.05)
    # Rows of balls are not made alike, nor are bearings.
    assert made["rows[0].start_angle"].n_unique() == 2000
    assert not np.allclose(errors, np.array(made["rows[0].diameter_errors"].to_list()))


def test_scatter_is_seeded_and_usable() -> None:
    scene = br.presets.deep_groove_6205()
    made = br.scatter(scene, 3, seed=5, ball_diameter=0.3e-6, groove_radius=1e-6)
    assert made.equals(br.scatter(scene, 3, seed=5, ball_diameter=0.3e-6, groove_radius=1e-6))
    assert not made.equals(br.scatter(scene, 3, seed=6, ball_diameter=0.3e-6, groove_radius=1e-6))
    row = made.drop("bearing_id").row(0, named=True)
    assert scene.replace(row).rows[0].diameter_errors == tuple(row["rows[0].diameter_errors"])
    crossed = made.join(br.grid({"loads.axial.force": [0.0, 100.0]}), how="cross")
    assert crossed.group_by("bearing_id").len()["len"].to_list() == [2, 2, 2]


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: br.grid({}), "values"),
        (lambda: br.grid({"a": []}), "a = []: at least one value"),
        (lambda: br.grid({"a": count()}), "a = 10,000,001 cases: at most 10,000,000"),
        (lambda: br.grid({"a": range(4000), "b": range(4000)}), "values = 16,000,000 cases"),
        (lambda: br.sobol({"a": (0.0, 1.0)}, 2**60, seed=1), "n = 1,152,921,504,606,846,976 cases"),
        (lambda: br.latin_hypercube({"a": (0.0, 1.0)}, 10**12, seed=1), "n = 1,000,000,000,000"),
        (lambda: br.scatter(br.presets.deep_groove_6205(), 10**12, seed=1), "n = 1,000,000,000"),
        (lambda: br.latin_hypercube({"a": (1.0, 1.0)}, 4, seed=1), "a = (1.0, 1.0)"),
        (lambda: br.latin_hypercube({}, 4, seed=1), "ranges"),
        (lambda: br.sobol({"a": (0.0, 1.0)}, 6, seed=1), "n = 6: a power of two"),
        (lambda: br.scatter(br.presets.deep_groove_6205(), 0, seed=1), "n = 0"),
        (lambda: br.scatter(br.presets.deep_groove_6205(), 1, seed=1, clearance=-1.0), "clearance"),
    ],
)
def test_bad_tables(build: Any, message: str) -> None:
    with pytest.raises(br.SceneError) as caught:
        build()
    assert message in str(caught.value)
