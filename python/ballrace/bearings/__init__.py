"""Common bearings by name, and scenes of them.

>>> import ballrace as br
>>> br.catalogue["SKF 6205-2RS"].ball_count
9
>>> scene = br.bearing("6205", radial_load=500.0, speed_rpm=1797.0)

============  =====================================================================
``catalogue`` the rows of ``bearings.csv``, found by designation
``names``     which designations mean a row: makers, seals, clearances
``sources``   where each number of a row comes from
``clearance`` the classes of ISO 5753
``build``     a scene of a row: clearance, cage, friction, supports
============  =====================================================================

Makers print bore, outside diameter, width and the load ratings of a bearing, not its balls. Those of most rows are
worked out: of all balls in steps of 1/64 inch and all their numbers one set alone has, with the pitch diameter
half-way between bore and outside diameter, the static rating of ISO 76 within 2 % and the dynamic rating of ISO 281
within 1 % of the printed ones; the next best set is off by 3 % or more in one of them. ``sources`` of a row says so.
A pitch diameter may be 1 % larger than that mean, which moves BPFO by less than 0.4 %.
"""

from __future__ import annotations

from .build import bearing
from .catalogue import Bearing, Catalogue, catalogue

__all__ = ["Bearing", "Catalogue", "bearing", "catalogue"]
