"""Fault frequencies: of pure rolling at nominal contact angles, as orders of the shaft.

Those at the contact angles of a load, or of a run, are :func:`ballrace.fault_frequencies`
(:mod:`ballrace.frequencies.operating`).
"""

from __future__ import annotations

from .._base.later import listed
from .kinematic import Orders, bpfi, bpfo, bsf, ftf, of_row, orders

__all__ = ["Orders", "bpfi", "bpfo", "bsf", "ftf", "of_row", "orders"]

__dir__ = listed(__name__)
