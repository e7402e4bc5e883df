"""Sets of labelled records in the layout of the package ``bearing-datasets``, and how to split them.

That package (0.3.0, MIT licence) gives 69 public measured sets one layout: a folder with a table of signals, their
samples in Parquet files, and a card. :meth:`ballrace.campaigns.Campaign.to_bearing_datasets` writes it,
:func:`read_bearing_dataset` reads it, and neither needs the package. :func:`bearing_split` splits any table so
that no bearing is in both parts.
"""

from __future__ import annotations

from .._base.later import listed
from .reading import BearingDataset, read_bearing_dataset
from .split import bearing_split

__all__ = ["BearingDataset", "bearing_split", "read_bearing_dataset"]

__dir__ = listed(__name__)
