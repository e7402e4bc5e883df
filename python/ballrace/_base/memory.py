"""The memory of this process: its address space, which Linux limits (``ulimit -v``, RLIMIT_AS), and its peak."""

from __future__ import annotations

import sys
from pathlib import Path

_STATM = Path("/proc/self/statm")
"""File in which Linux reports how much of the address space is used; containers may hide it."""

_UNIT = 1 if sys.platform == "darwin" else 1024
"""Unit in which getrusage counts memory [bytes]."""


def used() -> int | None:
    """Return how much address space is used, held or not [bytes]; None where the system does not report it."""
    try:
        pages = int(_STATM.read_text().split()[0])
    except OSError:
        return None
    import resource

    return pages * resource.getpagesize()


def peak() -> int | None:
    """Return the most memory that this process has held so far [bytes]; None on Windows.

    On Linux that of a program which another started begins with what the other held.
    """
    try:
        import resource
    except ImportError:
        return None
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _UNIT


def left() -> float:
    """Return what the limit of the process leaves [bytes]; infinity where there is none, or none is reported."""
    now = used()
    if now is None:
        return float("inf")
    import resource

    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return float("inf") if limit == resource.RLIM_INFINITY else float(limit - now)


def let(more: float) -> bool:
    """Set the limit to what is used now and ``more`` [bytes], as far as the process may; return whether it can."""
    now = used()
    if now is None:
        return False
    import resource

    _, highest = resource.getrlimit(resource.RLIMIT_AS)
    wanted = now + more
    if highest != resource.RLIM_INFINITY:
        wanted = min(wanted, highest)
    soft = resource.RLIM_INFINITY if wanted >= 2.0**63 else int(wanted)
    resource.setrlimit(resource.RLIMIT_AS, (soft, highest))
    return True
