"""A table of cases with its scenes: what each row means, and its id."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields
from typing import Any

from .. import _core
from .._base.document import encode
from .._base.libraries import pl
from ..errors import SceneError
from ..options import BUDGET, DECIDING, EMPTY, document
from ..scene import Scene
from .columns import BASE
from .disk import hash_of
from .frames import rows_of

RESULTS = (*BASE, "changes", "measured_clipped", "turns", "batches")
"""Columns of the manifest that a table may not have."""

_FIELDS = frozenset(field.name for field in fields(Scene))
_STEP = re.compile(r"[^.\[\]]+")
_NEW = re.compile(r"(loads|moments|unbalances|table_forces|defects|probes)\.[^.\[\]]+")
"""Paths of entries whose names people choose."""


@dataclass(frozen=True, slots=True)
class Case:
    """A row of a table: its id, and why it cannot be run, if so."""

    id: str
    error: SceneError | None


class Cases:
    """The cases of a table.

    Nothing but ids and the table itself is held; documents are made when they are asked for.
    """

    def __init__(
        self,
        table: object,
        scenes: Mapping[str, str],
        run: Mapping[str, Any],
        *,
        budget: Mapping[str, Any],
        features: str,
    ) -> None:
        self._scenes = scenes
        self._run = dict(run)
        self._budget = dict(budget)
        self._features = features
        self._rows, self.names = rows_of(table)
        self._parameters = [name for name in self.names if _is_parameter(name)]
        documents = [json.loads(scene) for scene in scenes.values()]
        self._check_columns(documents)
        whole = [name for name in self._parameters if any(_is_whole(d, name) for d in documents)]
        if whole:
            self._rows = [_made_whole(row, whole) for row in self._rows]
        self.labels = [name for name in self.names if name not in self._meant()]
        self.cases = [self._case(row) for row in self._rows]

    def document(self, index: int) -> tuple[str, str]:
        """Return scene and run of a case as JSON, every field written out.

        Raises
        ------
        SceneError
            A value of the row is not usable.
        """
        scene, run = apply(self.changes(index), self._scenes, self._run)
        return scene, json.dumps({**json.loads(run), **self.budget(index)})

    def budget(self, index: int) -> dict[str, float | int]:
        """Return what a case may cost, as far as that is limited.

        Raises
        ------
        SceneError
            A limit is not usable.
        """
        return self._limits(self._rows[index])

    def changes(self, index: int) -> dict[str, Any]:
        """Return the changes of the row: ``scene``, fields by their paths, and arguments of the run."""
        return self._changes(self._rows[index])

    def frame(self) -> pl.DataFrame:
        """Return the table with case ids: the left part of the manifest."""
        columns = [pl.Series("case_id", [case.id for case in self.cases], dtype=pl.String)]
        columns += [_series(name, [row.get(name) for row in self._rows]) for name in self.names]
        texts = [json.dumps(_plain(self._changes(row))) for row in self._rows]
        columns.append(pl.Series("changes", texts, dtype=pl.String))
        return pl.DataFrame(columns)

    def _changes(self, row: Mapping[str, Any]) -> dict[str, Any]:
        """Leave labels and empty cells out."""
        wanted = (*self._parameters, *DECIDING, "scene")
        return {name: row[name] for name in wanted if row.get(name) is not None}

    def _limits(self, row: Mapping[str, Any]) -> dict[str, float | int]:
        own = {name: row[name] for name in BUDGET if row.get(name) is not None}
        return document({**self._budget, **own})

    def _meant(self) -> set[str]:
        """Return the columns that mean something to a case."""
        return {*self._parameters, *DECIDING, *BUDGET, "scene"}

    def _case(self, row: Mapping[str, Any]) -> Case:
        changes = self._changes(row)
        try:
            scene, run = apply(changes, self._scenes, self._run)
            limited = {**json.loads(run), **self._limits(row)}
            _core.check_run(json.dumps(limited), self._features)
        except SceneError as error:
            # It has no document to be known by, but what it was made from.
            parts = [dict(self._scenes), self._run, _plain(changes)]
            if error.path in BUDGET:
                parts.append(_plain({name: row.get(name) for name in BUDGET}))
            return Case(_digest("not usable", json.dumps(parts)), error)
        return Case(_digest(scene, run), None)

    def _check_columns(self, documents: list[Any]) -> None:
        for name in self.names:
            if name in RESULTS:
                raise SceneError(name, "a column of cases", "another name; the manifest has it")
        if "scene" in self.names and len(self._scenes) < 2:
            raise SceneError("scene", "a column of cases", "several scenes by name to choose from")
        if "scene" not in self.names and len(self._scenes) > 1:
            known = ", ".join(self._scenes)
            raise SceneError("cases", "no column scene", f"a column scene that says which: {known}")
        if not {*DECIDING, *BUDGET}.intersection(self.names):
            # Arguments that fail every case fail before the first.
            _core.check_run(json.dumps({**self._run, **self._budget}), self._features)
        for name in self._parameters:
            if not any(_exists(document, name) for document in documents):
                # The core says what there is instead.
                _core.scene_replace(next(iter(self._scenes.values())), json.dumps([[name, None]]))


def apply(
    changes: Mapping[str, Any], scenes: Mapping[str, str], run: Mapping[str, Any]
) -> tuple[str, str]:
    """Return scene and run of a case as JSON.

    Raises
    ------
    SceneError
        A value is not usable.
    """
    rest = dict(changes)
    name = rest.pop("scene", next(iter(scenes)))
    if name not in scenes:
        raise SceneError("scene", str(name), f"one of {', '.join(scenes)}")
    own = {key: rest.pop(key) for key in DECIDING if key in rest}
    for path, value in rest.items():
        if isinstance(value, float) and math.isnan(value):
            raise SceneError(path, "nan", f"a finite number; {EMPTY}")
    pairs = [(path, encode(value, path)) for path, value in rest.items()]
    scene = _core.scene_replace(scenes[name], json.dumps(pairs))
    return scene, json.dumps(document({**run, **own}))


def _is_parameter(name: str) -> bool:
    return (name in _FIELDS and name != "scene") or "." in name or "[" in name


_NOWHERE = object()


def _at(document: Any, path: str) -> Any:
    """Return what stands at a dotted path in a document."""
    for step in _STEP.findall(path):
        if isinstance(document, dict) and step in document:
            document = document[step]
        elif isinstance(document, list) and step.isdigit() and int(step) < len(document):
            document = document[int(step)]
        else:
            return _NOWHERE
    return document


def _exists(document: Any, path: str) -> bool:
    """Say whether a dotted path leads somewhere in a document, or to where a new entry may stand."""
    return _at(document, path) is not _NOWHERE or _NEW.fullmatch(path) is not None


def _is_whole(document: Any, path: str) -> bool:
    """Say whether a whole number stands at a path."""
    found = _at(document, path)
    return isinstance(found, int) and not isinstance(found, bool)


def _made_whole(row: dict[str, Any], names: list[str]) -> dict[str, Any]:
    """Return a row with whole numbers where tables with empty cells have had to make them floats."""
    floats = {name: row[name] for name in names if isinstance(row.get(name), float)}
    return {**row, **{name: int(x) for name, x in floats.items() if x.is_integer()}}


def _digest(scene: str, run: str) -> str:
    return hash_of(json.dumps(["ballrace case 1", scene, run]).encode())


def _plain(value: Any) -> Any:
    """Return what JSON can say of a cell that need not be usable."""
    if isinstance(value, Mapping):
        return {str(k): _plain(v) for k, v in value.items()}
    try:
        return encode(value, "")
    except SceneError:
        return repr(value)


def _series(name: str, values: Iterable[Any]) -> pl.Series:
    """Return a column; where its cells are of different kinds, as JSON text."""
    # A label may well be no number.
    cells = [value if isinstance(value, float) else _plain(value) for value in values]
    present = [cell for cell in cells if cell is not None]
    if any(isinstance(cell, float) for cell in present) and all(
        isinstance(cell, float | int) and not isinstance(cell, bool) for cell in present
    ):
        return pl.Series(name, cells, dtype=pl.Float64, strict=False)
    if not any(isinstance(cell, dict) for cell in present):
        try:
            return pl.Series(name, cells, strict=True)
        except (TypeError, OverflowError, pl.exceptions.PolarsError):
            pass
    texts = [None if cell is None else json.dumps(cell) for cell in cells]
    return pl.Series(name, texts, dtype=pl.String)
