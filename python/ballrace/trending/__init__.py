"""Records of one bearing over time: a table of signs of damage, and when they depart from the baseline.

==============  ================================================================================
``quantities``  numbers of one record; ``pooling``: lines in the spectra of several
``departure``   the first record that departs from the baseline
``procedure``   :func:`ballrace.trend`
``result``      :class:`ballrace.trending.Trend`; ``picture`` shows it
==============  ================================================================================
"""

from __future__ import annotations

from .._base.later import listed
from .procedure import trend
from .result import Trend

__all__ = ["Trend", "trend"]

__dir__ = listed(__name__)
