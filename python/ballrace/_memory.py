"""The address space of this process, which Linux limits (``ulimit -v``, RLIMIT_AS)."""

from __future__ import annotations

import sys
from pathlib import Path

LIMITED = sys.platform == "linux"
"""Whether the system limits it, and says how much is used."""


def used() -> int:
    """Return how much of it is used, held memory or not [bytes]."""
    import resource

    return int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()


def left() -> float:
    """Return what the limit of the process leaves [bytes]; infinity where there is none."""
    if not LIMITED:
        return float("inf")
    import resource

    limit, _ = resource.getrlimit(resource.RLIMIT_AS)
    return float("inf") if limit == resource.RLIM_INFINITY else float(limit - used())


def let(more: float) -> None:
    """Set the limit to what is used now and ``more`` [bytes], as far as the process may; nothing elsewhere."""
    if not LIMITED:
        return
    import resource

    _, highest = resource.getrlimit(resource.RLIMIT_AS)
    wanted = used() + more
    if highest != resource.RLIM_INFINITY:
        wanted = min(wanted, highest)
    soft = resource.RLIM_INFINITY if wanted >= 2.0**63 else int(wanted)
    resource.setrlimit(resource.RLIMIT_AS, (soft, highest))
