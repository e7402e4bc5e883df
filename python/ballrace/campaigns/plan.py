"""The arguments of a campaign, checked."""

from __future__ import annotations

import json
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .. import _core
from ..errors import CampaignError, CampaignWarning, SceneError, SceneWarning
from ..scene import Scene
from .cases import Cases
from .spread import Executor
from .work import Job, version

if TYPE_CHECKING:
    from collections.abc import Iterator

    from .store import Store
    from .work import Document


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What is to be done.

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

    def missing(self, store: Store) -> list[int]:
        """Return the cases of the shard that have not finished, in the order of the table.

        Raises
        ------
        CampaignError
            A shard is damaged, or what is there may not be built upon.
        """
        results = store.results()
        self._check_results(store, results)
        shards = store.kept_signals() if self.job.keep_signals else set()
        finished = set()
        for case_id, status, signals in results.select("case_id", "status", "signals").iter_rows():
            kept = not self.job.keep_signals or signals in shards
            if (status == "ok" and kept) or (status == "failed" and not self.job.raise_errors):
                finished.add(case_id)
        return sorted(i for case_id, i in self.ids().items() if case_id not in finished)

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
    scenes = {"": given} if isinstance(given, Scene) else given
    if (
        not isinstance(scenes, Mapping)
        or not scenes
        or not all(isinstance(scene, Scene) for scene in scenes.values())
    ):
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
    if threads < 1:
        raise SceneError("threads", str(threads), "at least 1")
    return threads


def shard_of(shard: tuple[int, int]) -> tuple[int, int]:
    """Return which part of how many."""
    part, parts = shard
    if not 0 <= part < parts:
        raise SceneError("shard", f"{part}/{parts}", "i/n with i from 0 to n - 1")
    return part, parts
