"""polars, started with room for its threads; it is ``pl`` of :mod:`ballrace._base.libraries`.

It reserves address space for its library and for its threads. Where a limit (``ulimit -v``, RLIMIT_AS) leaves too
little of it, polars panics during its start, or ends the process. So its need is compared with the limit before.
"""

from __future__ import annotations

import io
import os
import sys

from ..errors import MemoryLimitError
from .memory import left

__all__ = ["pl"]

# Measured with polars 2.1; most of it is address space for what may yet be allocated, and holds no memory.
_LIBRARY = 400 * 2**20
"""Address space of the library [bytes]."""

_START = 500 * 2**20
"""Address space of what runs once, whatever the number of threads [bytes]."""

_THREAD = 32 * 2**20
"""Address space of a thread [bytes]."""

_WAYS_OUT = (
    "raise the limit, or let polars have fewer threads by the environment's POLARS_MAX_THREADS"
)


def needed() -> float:
    """Return the address space that polars takes as it starts [bytes]."""
    try:
        threads = int(os.environ["POLARS_MAX_THREADS"])
    except (KeyError, ValueError):
        threads = os.cpu_count() or 1
    library = 0 if "polars" in sys.modules else _LIBRARY
    return float(library + _START + threads * _THREAD)


def _refusal(why: str) -> MemoryLimitError:
    return MemoryLimitError(f"polars, which holds the tables, {why}; {_WAYS_OUT}", needed(), left())


if left() < needed():
    raise _refusal(
        f"would need {needed() / 2**30:.2f} GiB of address space where {left() / 2**30:.2f} GiB are left to use"
    )

import polars as pl  # noqa: E402 (there must be room for it)

try:
    # Starts all its threads, those that write and read files among them.
    pl.DataFrame({"a": [1.0]}).lazy().select("a").collect().write_parquet(io.BytesIO())
except pl.exceptions.PanicException as error:
    raise _refusal(f"cannot start its threads ({error})") from None
