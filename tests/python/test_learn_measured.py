"""Measured records, named by a model that has learnt from a recipe's simulated records alone.

Truth: the names of public records, as in ``test_diagnosis_measured.py``. The recipe is that of the guide's page
``learning.md`` at HIT-SM's speeds. Its features, noise, pedestal and grease were chosen with these records at
hand: 24 of 24 are no forecast (``benches/transfer.md`` has records by which nothing was chosen). On one set of
runs all are right with 20, 30, 40 and 60 bearings; with balls as a class one to four are called balls below 60.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import ballrace as br
from test_diagnosis_measured import CWRU, FOLDER, HIT, hit, there

if TYPE_CHECKING:
    from pathlib import Path

pytest.importorskip("sklearn", reason="scikit-learn is not installed")
pytestmark = pytest.mark.long

NAMES = {"N": "healthy", "I": "inner_race", "O": "outer_race",
         "97": "healthy", "105": "inner_race", "130": "outer_race"}  # fmt: skip


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> br.learn.Diagnoser:
    """A model of 30 bearings of each class on 60 machines."""
    there(FOLDER / "hit-sm" / f"{HIT[0]}.mat")
    recipe = br.learn.Recipe(
        "6205", speed_rpm=(1200.0, 1800.0), radial_load=(100.0, 800.0), axial_load=(-150.0, 150.0),
        faults={"outer": (0.15, 3.0), "inner": (0.15, 3.0)},
    )  # fmt: skip
    runs: Path = tmp_path_factory.mktemp("learning") / "runs"
    machines = br.measuring.random_chains(60, seed=1)
    data = br.learn.dataset(recipe, runs, per_class=30, machines=machines, progress=False)
    return br.learn.Diagnoser(turns=data.turns, fs=data.fs).fit(*data.features())


@pytest.mark.parametrize("name", HIT)
def test_records_of_hit_sm(model: br.learn.Diagnoser, name: str) -> None:
    """At 600, 900 and 1200 1/min and 51.2 kHz."""
    x, rpm = hit(name)
    assert model.diagnose(x, "6205", rpm, fs=51_200.0).verdict == NAMES[name[0]]


@pytest.mark.parametrize("number", CWRU)
def test_records_of_case_western_reserve(model: br.learn.Diagnoser, number: str) -> None:
    x = br.read(there(FOLDER / "cwru" / f"{number}.mat"), fs=CWRU[number])["DE"]
    assert model.diagnose(x, "6205", 1797.0, fs=CWRU[number]).verdict == NAMES[number]
