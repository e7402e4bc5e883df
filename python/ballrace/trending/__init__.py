"""Records of one bearing over time: a table of signs of damage, and when they depart from the baseline.

==============  ================================================================================
``quantities``  numbers of one record; ``pooling``: lines in the spectra of several
``departure``   the first record that departs from the baseline
``procedure``   :func:`ballrace.trend`
``result``      :class:`ballrace.Trend`; ``picture`` shows it
==============  ================================================================================
"""

from __future__ import annotations

from .procedure import trend
from .result import Trend

__all__ = ["Trend", "trend"]
