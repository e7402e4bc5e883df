"""The arguments of a campaign, checked."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .. import _core
from .._base.numbers import counted
from .._base.text import printable
from ..errors import CampaignError, CampaignWarning, SceneError, SceneWarning
from ..options import BUDGET, DECIDING
from ..scene import Scene
from ..scene.scene import checked_scene
from .cases import Cases
from .executors import Executor
from .frames import resembling
from .shards import names
from .work import Job, version

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from .store import Store
    from .work import Document


@dataclass(frozen=True, kw_only=True)
class Plan:
    """Plan of a campaign: what is to be done.

    Attributes
    ----------
    cases : Cases
        The table.
    identity : dict
        What makes a folder that of one campaign: schema, scenes, arguments of the runs, options of the features.
    job : Job
        How cases are worked on.
    executor : Executor or None
        Where tasks run; None: here.
    workers : int or None
        Tasks that the executor runs at once, if it says so.
    shard : tuple of int, int
        Which part of how many.
    resume : str or bool
        As in :func:`ballrace.campaign`.
    """

    cases: Cases
    identity: dict[str, Any]
    job: Job
    executor: Executor | None
    workers: int | None
    shard: tuple[int, int]
    resume: str | bool

    def ids(self) -> dict[str, int]:
        """Return the distinct cases of the shard: id, and the first row that has it."""
        part, parts = self.shard
        cases = self.cases.cases
        return {cases[i].id: i for i in reversed(range(part, len(cases), parts))}

    def parallel(self) -> int:
        """Return how many cases run at once."""
        threads = self.job.threads or _core.available_threads()
        return threads if self.executor is None else threads * (self.workers or 1)

    def documents(self, indices: list[int]) -> Iterator[Document]:
        """Yield the documents of cases, made one by one."""
        for i in indices:
            yield self.cases.cases[i].id, *self.cases.document(i)

    def missing(self, store: Store) -> tuple[list[int], list[Path]]:
        """Return the cases of the shard that have not finished, in the order of the table, and damaged files.

        Not finished are those whose rows or, where they are kept, signals are not there or damaged, and those
        that have spent a smaller budget than they would have now.

        Raises
        ------
        CampaignError
            The results cannot be read, or what is there may not be built upon.
        """
        damaged: list[Path] = []
        results = store.results(damaged)
        self._check_results(store, results)
        ids = self.ids()
        rows = [row for row in results.iter_rows(named=True) if row["case_id"] in ids]
        shards = None
        if self.job.keep_signals:
            others = set(results["signals"].drop_nulls()) - {row["signals"] for row in rows}
            broken = store.damaged_signals(but=others)
            damaged += broken
            shards = names(store.root, "signals") - {path.name for path in broken}
        finished = {
            row["case_id"] for row in rows if self._has_finished(row, ids[row["case_id"]], shards)
        }
        return sorted(i for case_id, i in ids.items() if case_id not in finished), damaged

    def _has_finished(self, row: dict[str, Any], index: int, shards: set[str] | None) -> bool:
        if row["status"] == "ok":
            return shards is None or row["signals"] in shards
        if self.job.raise_errors:
            return False
        if row["budget"] is None:
            return True
        limit = self.cases.budget(index).get(row["budget"])
        return limit is not None and limit <= row["budget_limit"]

    def _check_results(self, store: Store, results: Any) -> None:
        if self.resume is False and not results.is_empty():
            raise CampaignError(
                f"{store.root}: holds {results.height} finished cases; give another folder, "
                'or resume="auto"'
            )
        others = sorted(set(results["version"]) - {version()})
        if others:
            text = f"{store.root}: has cases of ballrace {', '.join(others)}; this is {version()}"
            if self.resume == "strict":
                raise CampaignError(f"{text}; give another folder")
            warnings.warn(text, CampaignWarning, stacklevel=5)


def check_choices(**given: object) -> None:
    """Refuse values that are not among the choices."""
    choices: dict[str, tuple[object, ...]] = {
        "keep": ("features", "signals"),
        "resume": ("auto", "strict", False),
        "on_error": ("record", "raise"),
    }
    for name, value in given.items():
        if value not in choices[name]:
            raise SceneError(name, repr(value), f"one of {', '.join(map(repr, choices[name]))}")


def scenes_of(given: Scene | Mapping[str, Scene], features: dict[str, Any]) -> dict[str, str]:
    """Return the scenes as JSON, having checked that they give the features; warn of what is doubtful in them."""
    scenes = given if isinstance(given, Mapping) else {"": checked_scene(given)}
    if not scenes or not all(isinstance(scene, Scene) for scene in scenes.values()):
        raise SceneError("scene", repr(given), "a Scene, or Scenes by name")
    documents = {str(name): scene.to_json() for name, scene in scenes.items()}
    for document in documents.values():
        _core.feature_columns(document, json.dumps(features))
        for doubt in _core.scene_doubts(document):
            warnings.warn(doubt, SceneWarning, stacklevel=3)
    return documents


def threads_of(threads: int | None, executor: object) -> int:
    """Return the threads of a process; 0: all."""
    if threads is None:
        return 0 if executor is None else 1
    return counted("threads", threads, 1)


def shard_of(shard: tuple[int, int]) -> tuple[int, int]:
    """Return which part of how many."""
    try:
        part, parts = (counted("shard", number, 0) for number in shard)
    except (TypeError, ValueError):
        raise SceneError("shard", repr(shard), "a pair (i, n) of whole numbers") from None
    if not 0 <= part < parts:
        raise SceneError("shard", f"{part}/{parts}", "i/n with i from 0 to n - 1")
    return part, parts


def warn_of_labels(cases: Cases, scenes: Mapping[str, str]) -> None:
    """Warn of columns that are carried along as labels, but may have been meant for fields."""
    documents = [json.loads(scene) for scene in scenes.values()]
    for label in cases.labels:
        near = resembling(label, documents, (*DECIDING, *BUDGET))
        if near is not None:
            text = (
                f"the column {label} is no field: it changes nothing and is carried along as a label; if it is "
                f"meant to change the case, call it {near}"
            )
            warnings.warn(printable(text), CampaignWarning, stacklevel=3)
