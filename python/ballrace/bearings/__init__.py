"""Bearings by the name on their box, or by their size, and scenes of them.

>>> import ballrace as br
>>> br.catalogue["SKF 6205-2RS"].ball_count
9
>>> scene = br.bearing("6205", radial_load=500.0, speed_rpm=1797.0)

=============  ====================================================================
``entry``      a bearing by its numbers
``rows``       the rows of ``bearings.csv``, found by name
``names``      what a name says, by ``marks.csv``: makers, seals, cages, clearances
``refused``    bearings that are not in the catalogue, by kind
``sources``    where each number of a row comes from
``estimate``   a bearing of which bore, outside diameter and width are known
``clearance``  the classes of ISO 5753
``pedestal``   the machine around the outer ring, a structure with modes
``build``      a scene of a bearing: clearance, loads, supports
``filled``     what all such scenes have: friction, cage, drive, probes
``fits``       classes of ISO 286, and interferences after Lamé
``heat``       the clearance in operation, steady temperatures
=============  ====================================================================

Makers publish bore, outside diameter, width, load ratings and often a factor f₀ of a bearing, not its balls. Those
of most rows are estimated: the number of balls and their diameter, in steps of an inch, whose ratings come nearest
to the published ones, the static by ISO 76 (within 2 %) and the dynamic by ISO 281 (within 1.5 %), with the pitch
diameter half-way between bore and outside diameter. Where f₀ is published, C₀ = f₀ Z D² takes the place of ISO 76.
``sources`` of a row says what is estimated. A real pitch diameter may be 1.5 % larger or smaller than that mean,
which moves BPFO by less than 0.7 %. Makers choose different balls for some sizes; ``sources`` says where SKF does.
"""

from __future__ import annotations

from .._base.later import listed
from .build import bearing
from .entry import Bearing, Uncertainty
from .fits import Seat
from .heat import OperatingClearance, Temperatures, operating_clearance, steady_temperatures
from .names import Name
from .rows import Catalogue, catalogue

__all__ = [
    "Bearing",
    "Catalogue",
    "Name",
    "OperatingClearance",
    "Seat",
    "Temperatures",
    "Uncertainty",
    "bearing",
    "catalogue",
    "operating_clearance",
    "steady_temperatures",
]

__dir__ = listed(__name__)
