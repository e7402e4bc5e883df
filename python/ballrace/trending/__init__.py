"""Records of one bearing over time: a table of what tells damage, and from when on it is another machine.

==============  ===========================================================
``quantities``  numbers of one record
``departure``   the first record that departs from the baseline
``procedure``   :func:`ballrace.trend`
``result``      :class:`ballrace.Trend`; ``picture`` shows it
==============  ===========================================================
"""

from __future__ import annotations

from .procedure import trend
from .result import Trend

__all__ = ["Trend", "trend"]
