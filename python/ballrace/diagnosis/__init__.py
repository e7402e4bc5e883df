"""A verdict from a record: healthy, damaged, or what would decide.

>>> import ballrace as br, numpy as np
>>> noise = np.random.default_rng(1).normal(size=48_000)
>>> br.diagnose(noise, "6205", 1800.0, fs=12_000.0, speed_within=0.001).verdict
'healthy'
"""

from __future__ import annotations

from .._base.later import listed
from .evidence import Evidence, Line
from .procedure import diagnose
from .result import Diagnosis
from .sensitivity import Sensitivity
from .severity import Change, Severity
from .shaft import ShaftRate
from .speeds import width_over_speeds
from .strength import Strength
from .width import Width

__all__ = [
    "Change",
    "Diagnosis",
    "Evidence",
    "Line",
    "Sensitivity",
    "Severity",
    "ShaftRate",
    "Strength",
    "Width",
    "diagnose",
    "width_over_speeds",
]

__dir__ = listed(__name__)
