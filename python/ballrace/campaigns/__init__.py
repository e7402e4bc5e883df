"""Campaigns: a table of load cases in, a table of results out.

:func:`~ballrace.campaigns.run.campaign` is the one call. Everything else either builds its table
(:func:`~ballrace.campaigns.designs.grid`, :func:`~ballrace.campaigns.designs.latin_hypercube`,
:func:`~ballrace.campaigns.designs.sobol`, :func:`~ballrace.campaigns.bearings.scatter`) or reads what came of it
(:class:`~ballrace.campaigns.result.Campaign`).

===============  =====================================================================
``cases``        a table and its scenes: what each row means, and its case id
``frames``       tables of any kind, and suggestions for unknown columns
``store``        the folder of a campaign
``shards``       its files of results and signals, checked, and set aside if damaged
``columns``      what every row of results has
``description``  makes a folder that of one campaign, sealed, in two copies
``verify``       every byte of a folder checked
``disk``         files that are complete or absent
``work``         cases run in this process, results written as they finish
``executors``    the same work given to an executor, chunk by chunk
===============  =====================================================================
"""

from __future__ import annotations

from .._base.later import listed
from .bearings import scatter
from .designs import grid, latin_hypercube, sobol
from .estimate import Estimate
from .progress import Progress
from .result import Campaign
from .run import campaign
from .verify import verify

__all__ = [
    "Campaign",
    "Estimate",
    "Progress",
    "campaign",
    "grid",
    "latin_hypercube",
    "scatter",
    "sobol",
    "verify",
]

__dir__ = listed(__name__)
