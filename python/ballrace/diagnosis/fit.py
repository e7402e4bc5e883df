"""Numbers fitted to simulated records whose damage is known: ``fit.json``, written by ``benches/verdict_fit.py``.

==============  ==========================================================================================
``ratio``       regressions of :mod:`ballrace.diagnosis.likelihood`, by part, with a unit and without one
``bridge``      what spalls are wider than the spacing of the two events of a pass: 5 %, median, 95 %, by race
                [ball diameters]
``strength``    strength of spalls of the outer race over their width, for :mod:`ballrace.diagnosis.sensitivity`
==============  ==========================================================================================
"""

from __future__ import annotations

import functools
import json
from importlib import resources
from typing import Any


@functools.cache
def fit() -> dict[str, Any]:
    """Return the numbers."""
    found: dict[str, Any] = json.loads(
        resources.files(__package__).joinpath("fit.json").read_text(encoding="utf-8")
    )
    return found
