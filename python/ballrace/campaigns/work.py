"""Cases run in this process, their results written as they finish."""

from __future__ import annotations

import importlib.metadata
import json
import os
import time
from contextlib import suppress
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from .. import _core
from .._base.libraries import pl
from .._base.text import printable
from ..errors import BallraceError, CampaignError, from_record, record_of
from ..scene.defect import SURFACES
from .columns import BUDGET, FAULTS, STATISTICS, schema
from .progress import Counts

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from .._core import _Signals
    from .store import Store

Document: TypeAlias = tuple[str, str, str]
"""Case id, scene as JSON, run as JSON."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """How cases are worked on, wherever that is.

    Attributes
    ----------
    threads : int
        Cases at once in a process; 0: as many as it has cores.
    sharing : int
        Processes, or tasks of one process, at once on a machine, which have its memory between them.
    keep_signals : bool
        Whether signals are written beside features.
    features : str
        Options of the features, as JSON.
    raise_errors : bool
        Whether the error of the first case that fails is raised instead of recorded.
    retries : int
        How often a case is tried again, alone, whose worker died.
    """

    threads: int
    sharing: int = 1
    keep_signals: bool
    features: str
    raise_errors: bool
    retries: int = 0


_PROCESS = os.getpid()

_OFTEN, _SELDOM = 1.0, 30.0
"""Results wait for their shard no longer than this at first, and after an hour [s]."""

_LARGE = 64 << 20
"""Signals that wait for their shard at most [bytes]."""


def check_process() -> None:
    """Refuse to work in a forked child, where locks of threads that are not there hang for ever."""
    if os.getpid() != _PROCESS:
        raise CampaignError(
            "this process was forked from one that had imported ballrace, and would hang; start workers "
            'afresh, as by ProcessPoolExecutor(mp_context=multiprocessing.get_context("spawn"))'
        )


def version() -> str:
    """Return the version of the solver."""
    return importlib.metadata.version("ballrace")


class Writer:
    """Collects finished cases and writes them, the signals first.

    A shard is written as soon as the last one is a second old, later on a hundredth of the time at work: few
    files after hours, and little lost to a kill beside the cases that ran.
    """

    def __init__(self, store: Store) -> None:
        self._store = store
        self._rows: list[dict[str, Any]] = []
        self._signals: list[tuple[str, _Signals]] = []
        self._size = 0
        self._began = self._written = time.monotonic()

    def add(self, case_id: str, record: dict[str, Any], signals: _Signals | None) -> None:
        """Take a finished case."""
        self._rows.append(row(case_id, record))
        if signals is not None:
            self._signals.append((case_id, signals))
            self._size += signals["t"].nbytes * (1 + len(signals["columns"]))

    def flush_when_due(self) -> None:
        """Write what there is if it is time."""
        now = time.monotonic()
        wait = min(max(_OFTEN, 0.01 * (now - self._began)), _SELDOM)
        if self._size >= _LARGE or now - self._written >= wait:
            self.flush()

    def flush(self) -> None:
        """Write what there is."""
        self._written = time.monotonic()
        if not self._rows:
            return
        name = self._write_signals() if self._signals else None
        kept = {case_id for case_id, _ in self._signals}
        for entry in self._rows:
            entry["signals"] = name if entry["case_id"] in kept else None
        self._store.write("results", _results(self._rows))
        self._rows, self._signals, self._size = [], [], 0

    def _write_signals(self) -> str:
        frames = []
        for case_id, raw in sorted(self._signals, key=lambda pair: pair[0]):
            columns = {name: values for name, _, values in raw["columns"]}
            frames.append(
                pl.DataFrame({"t": raw["t"], **columns}).select(
                    pl.lit(case_id).alias("case_id"), pl.all()
                )
            )
        return self._store.write("signals", pl.concat(frames, how="diagonal"))


def run_here(
    store: Store, cases: Iterable[Document], job: Job, on_progress: Callable[[Counts], object]
) -> None:
    """Run cases on threads of this process and write what they give.

    Cases are drawn as threads become free; ``on_progress`` is given the numbers of cases so far, some twenty times
    a second.
    """
    ids: list[str] = []
    writer = Writer(store)
    counts = Counts()

    def documents() -> Iterator[tuple[str, str]]:
        for case_id, scene, run in cases:
            ids.append(case_id)
            yield scene, run

    def done(outcomes: list[tuple[int, str, _Signals | None]]) -> None:
        nonlocal counts
        for index, text, signals in outcomes:
            record = json.loads(text)
            if "error" in record and job.raise_errors:
                raise from_record(record["error"])
            counts = counts.plus(Counts(1, "error" in record, bool(record.get("warnings"))))
            writer.add(ids[index], record, signals)
        writer.flush_when_due()
        on_progress(counts)

    try:
        _core.campaign(documents(), job.threads, job.sharing, job.features, job.keep_signals, done)
    except KeyboardInterrupt:
        # What has finished is written, even if Ctrl-C comes again.
        with suppress(KeyboardInterrupt):
            writer.flush()
        raise
    finally:
        writer.flush()


def row(case_id: str, record: dict[str, Any]) -> dict[str, Any]:
    """Return what the manifest says of a finished case."""
    error = record.get("error")
    spent = error["arguments"][2:] if error and error["class"] == "BudgetError" else (None, None)
    return {
        "case_id": case_id,
        **_faults(record.get("defects")),
        "status": "failed" if error else "ok",
        "error": error and error["class"],
        "message": error and printable(error["message"]),
        "warnings": printable("; ".join(record.get("warnings", ()))) or None,
        "version": version(),
        **{name: record.get(name) for name in STATISTICS},
        "signals": None,
        **dict(zip(BUDGET, spent, strict=True)),
        **dict(record.get("features", ())),
        **dict(_touched(record.get("defects", ()))),
    }


def _faults(defects: list[dict[str, Any]] | None) -> dict[str, bool | None]:
    """Say which surfaces have a defect that was touched; nothing of a run that failed, or that no ball passed."""

    def is_touched(surface: str) -> bool | None:
        if defects is None:
            return None
        there = [defect for defect in defects if defect["on"] == surface]
        if any(defect["touched"] for defect in there):
            return True
        return False if all(defect["passes"] for defect in there) else None

    return {fault: is_touched(surface) for fault, surface in zip(FAULTS, SURFACES, strict=True)}


def _touched(defects: Iterable[dict[str, Any]]) -> Iterator[tuple[str, float | None]]:
    """Return the columns of the defects of a run: place, passes, share of these that touched, largest load."""
    for defect in defects:
        name, passes = f"defects.{defect['name']}", defect["passes"]
        yield f"{name}.placed_at", defect["axial_offset"]
        yield f"{name}.passes", float(passes)
        yield f"{name}.touched", defect["touched"] / passes if passes else None
        yield f"{name}.largest_load", defect["largest_load"]


def record_failed(store: Store, failed: Iterable[tuple[str, BallraceError]]) -> None:
    """Write rows of cases that failed without a run, by their ids."""
    records = (
        (case_id, {"error": record_of(error), "wall_time": 0.0}) for case_id, error in failed
    )
    store.write("results", _results([row(case_id, record) for case_id, record in records]))


def _results(rows: list[dict[str, Any]]) -> Any:
    base = schema()
    names = list(dict.fromkeys(name for entry in rows for name in entry))
    types = {name: base.get(name, pl.Float64) for name in names}
    ordered = sorted(rows, key=lambda entry: entry["case_id"])
    return pl.DataFrame(ordered, schema=types)
