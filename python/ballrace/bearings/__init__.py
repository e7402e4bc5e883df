"""Common bearings by name, and scenes of them.

>>> import ballrace as br
>>> br.catalogue["SKF 6205-2RS"].ball_count
9
>>> scene = br.bearing("6205", radial_load=500.0, speed_rpm=1797.0)

=============  ====================================================================
``rows``       the rows of ``bearings.csv``, found by designation
``names``      which designations mean a row: makers, seals, clearances
``sources``    where each number of a row comes from
``clearance``  the classes of ISO 5753
``pedestal``   the housing that the outer ring sits in
``build``      a scene of a row: clearance, cage, friction, supports
=============  ====================================================================

Makers publish bore, outside diameter, width and load ratings of a bearing, not its balls. Those of most rows are
estimated: the number of balls and their diameter in 1/64 inch whose ratings come nearest to the published ones,
the static by ISO 76 (within 2 %) and the dynamic by ISO 281 (within 1 %), with the pitch diameter half-way
between bore and outside diameter. Where makers publish their factor f₀, it leads to the same set.
``sources`` of a row says what is estimated. A real pitch diameter may be 1 % larger than that mean, which moves
BPFO by less than 0.4 %.
"""

from __future__ import annotations

from .build import bearing
from .pedestal import Pedestal
from .rows import Bearing, Catalogue, catalogue

__all__ = ["Bearing", "Catalogue", "Pedestal", "bearing", "catalogue"]
