"""Rigid shafts on several bearings, as one scene.

=============  ====================================================================
``shafts``     bearings at their places, masses, unbalances, loads
``pairs``      two equal angular contact bearings side by side, with preload
``forces``     belts, gears and other loads at their places
``reactions``  what each row carries, as forces and moments on the shaft
=============  ====================================================================

All inner rings are one rigid body that tilts, all outer rings another, with their housing, that does not.
"""

from __future__ import annotations

from .._base.later import listed
from .forces import belt, force, gear
from .pairs import Arrangement, pair
from .reactions import Reaction, reactions
from .shafts import shaft

__all__ = ["Arrangement", "Reaction", "belt", "force", "gear", "pair", "reactions", "shaft"]

__dir__ = listed(__name__)
