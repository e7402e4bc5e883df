"""A verdict from a record: healthy, damaged, or what would decide.

>>> import ballrace as br, numpy as np
>>> noise = np.random.default_rng(1).normal(size=48_000)
>>> br.diagnose(noise, "6205", 1800.0, fs=12_000.0).verdict
'healthy'

==============  ==================================================================================================
``arguments``   checks of the arguments; ``lacking``: what a record would need
``kinematics``  orders of a bearing, whatever names it
``envelopes``   prewhitening, spectra of squared envelopes in bands, levels over their running medians
``shaft``       rate of the shaft from its own orders
``combs``       the lines that a fault of each part has
``null``        the same combs where no part has them: z and probability
``strength``    how strong the vibration of a fault is
``evidence``    all of that for one part; ``examined``: for all parts
``likelihood``  how much likelier that is of a sound part than of a damaged one, in the ``library`` of runs
``verdict``     healthy, damaged or undecided
``severity``    velocity and zone by ISO 20816-3, crest factor, kurtosis; ``reference``: their change
``rows``        the same for each row of a bearing
``passes``      how far apart the two events of a pass are; ``width``: what width that means
``procedure``   the way from a record to a verdict
``result``      what comes out; ``picture``, ``size_picture`` and ``page`` show it
==============  ==================================================================================================
"""

from __future__ import annotations

from .evidence import Evidence, Line
from .procedure import diagnose
from .result import Diagnosis
from .severity import Change, Severity
from .shaft import ShaftRate
from .strength import Strength
from .width import Width

__all__ = [
    "Change",
    "Diagnosis",
    "Evidence",
    "Line",
    "Severity",
    "ShaftRate",
    "Strength",
    "Width",
    "diagnose",
]
