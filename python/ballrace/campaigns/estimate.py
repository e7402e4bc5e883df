"""Estimate of a campaign's time and disk space."""

from __future__ import annotations

import shutil
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import BallraceError
from .progress import duration
from .store import Store
from .work import run_here

if TYPE_CHECKING:
    from .arguments import Plan

_ROW = 16
"""Bytes that a feature takes in a shard of many rows, names and statistics of the file included."""


@dataclass(frozen=True, kw_only=True)
class Estimate:
    """Estimate of what a campaign would take, from its first missing case.

    Attributes
    ----------
    total, missing : int
        Cases of the table, and those of them that have not finished yet.
    seconds : float
        Wall time on the threads of this machine, or of the executor [s].
    bytes : int
        Disk space for what would be written.
    free : int
        Disk space there is.
    """

    total: int
    missing: int
    seconds: float
    bytes: int
    free: int

    def __str__(self) -> str:
        return (
            f"{self.missing} of {self.total} cases to run: about {duration(self.seconds)}, "
            f"{self.bytes / 1e6:.3g} MB of {self.free / 1e9:.3g} GB free"
        )


def estimate(plan: Plan, out: Path) -> Estimate:
    """Run the first missing case that does not fail into a temporary folder.

    Raises
    ------
    BallraceError
        All of them fail: the error of the last.
    """
    total = len(plan.ids())
    there = (out / "campaign.json").exists()
    missing = sorted(plan.ids().values())
    if there:
        missing, _ = plan.missing(Store.opened(out, plan.identity))
    todo = [i for i in missing if plan.cases.cases[i].error is None]
    place = next(path for path in [out.absolute(), *out.absolute().parents] if path.exists())
    seconds, size = _first(plan, todo)
    return Estimate(
        total=total,
        missing=len(missing),
        seconds=seconds * len(todo) / max(1, min(plan.parallel(), len(todo))),
        bytes=size * len(todo),
        free=shutil.disk_usage(place).free,
    )


def _first(plan: Plan, todo: list[int]) -> tuple[float, int]:
    for index in todo:
        try:
            return _try(plan, index)
        except BallraceError:
            if index == todo[-1]:
                raise
    return 0.0, 0


def _try(plan: Plan, index: int) -> tuple[float, int]:
    """Return wall time [s] and bytes of a case; if it fails, its error is raised."""
    job = replace(plan.job, raise_errors=True)
    with tempfile.TemporaryDirectory() as folder:
        store = Store.prepare(Path(folder), plan.identity)
        began = time.monotonic()
        run_here(store, plan.documents([index]), job, lambda counts: None)
        seconds = time.monotonic() - began
        signals = sum(path.stat().st_size for path in (store.root / "signals").iterdir())
        return seconds, signals + _ROW * store.results().width
