"""A table of cases bound to its scenes: what each row means, and the id it is known by."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from .. import _core
from .._document import encode
from ..errors import SceneError
from ..scene import Scene
from .store import BASE

if TYPE_CHECKING:
    import polars as pl

RUN = ("duration", "fs", "start", "rtol", "accuracy", "method", "bandwidth", "settle")
"""Columns that say how a case is run, instead of the campaign's own arguments."""

RESULTS = (*BASE, "changes")
"""Columns of the manifest that a table may not have."""

_FIELDS = frozenset(field.name for field in fields(Scene))
_STEP = re.compile(r"[^.\[\]]+")


@dataclass(frozen=True, slots=True)
class Case:
    """One row of a table: its id, and why it cannot be run, if so."""

    id: str
    error: SceneError | None


class Cases:
    """The cases of a table.

    Nothing but ids and the table itself is held; documents are made when they are asked for.
    """

    def __init__(self, table: object, scenes: Mapping[str, str], run: Mapping[str, Any]) -> None:
        self._scenes = scenes
        self._run = dict(run)
        self._rows, self.names = _rows(table)
        self._parameters = [name for name in self.names if _is_parameter(name)]
        self._check_columns()
        self.cases = [self._case(row) for row in self._rows]

    def __len__(self) -> int:
        return len(self.cases)

    def document(self, index: int) -> tuple[str, str]:
        """Return scene and run of a case as JSON, every field written out.

        Raises
        ------
        SceneError
            A value of the row is not usable.
        """
        return apply(self.changes(index), self._scenes, self._run)

    def changes(self, index: int) -> dict[str, Any]:
        """Return what the row changes: ``scene``, fields by their paths, and arguments of the run."""
        return self._changes(self._rows[index])

    def frame(self) -> pl.DataFrame:
        """Return the table with case ids: the left part of the manifest."""
        import polars as pl

        columns = [pl.Series("case_id", [case.id for case in self.cases], dtype=pl.String)]
        columns += [_series(name, [row.get(name) for row in self._rows]) for name in self.names]
        texts = [json.dumps(_plain(self._changes(row))) for row in self._rows]
        columns.append(pl.Series("changes", texts, dtype=pl.String))
        return pl.DataFrame(columns)

    def _changes(self, row: Mapping[str, Any]) -> dict[str, Any]:
        """Leave labels and empty cells out."""
        wanted = (*self._parameters, *RUN, "scene")
        return {name: row[name] for name in wanted if row.get(name) is not None}

    def _case(self, row: Mapping[str, Any]) -> Case:
        changes = self._changes(row)
        try:
            scene, run = apply(changes, self._scenes, self._run)
        except SceneError as error:
            # It has no document to be known by, but what it was made from.
            made_from = json.dumps([dict(self._scenes), self._run, _plain(changes)])
            return Case(_digest("not usable", made_from), error)
        return Case(_digest(scene, run), None)

    def _check_columns(self) -> None:
        for name in self.names:
            if name in RESULTS:
                raise SceneError(name, "a column of cases", "another name; the manifest has it")
        if "scene" in self.names and len(self._scenes) < 2:
            raise SceneError("scene", "a column of cases", "several scenes by name to choose from")
        if "scene" not in self.names and len(self._scenes) > 1:
            known = ", ".join(self._scenes)
            raise SceneError("cases", "no column scene", f"a column scene that says which: {known}")
        documents = [json.loads(scene) for scene in self._scenes.values()]
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
    own = {key: rest.pop(key) for key in RUN if key in rest}
    pairs = [(path, encode(value, path)) for path, value in rest.items()]
    scene = _core.scene_replace(scenes[name], json.dumps(pairs))
    return scene, json.dumps(run_document({**run, **own}))


def run_document(run: Mapping[str, Any]) -> dict[str, Any]:
    """Return the arguments of a run as JSON has them.

    Raises
    ------
    SceneError
        One is not usable.
    """
    document: dict[str, Any] = {"start": run["start"]}
    if document["start"] not in ("equilibrium", "rolling"):
        raise SceneError("start", repr(document["start"]), "'equilibrium' or 'rolling'")
    document["method"] = run.get("method")
    document["bandwidth"] = _bandwidth(run["bandwidth"])
    limits = {
        "duration": (0.0, 1e6),
        "fs": (0.0, 1e9),
        "rtol": (1e-12, 1e-1),
        "accuracy": (1e-4, 1e-1),
        "settle": (0.0, 1e3),
    }
    for name, (low, high) in limits.items():
        value: Any = run.get(name)
        if value is None and name in ("rtol", "accuracy", "settle"):
            document[name] = None
            continue
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise SceneError(name, repr(value), "a number") from None
        ends_count = low > 0.0 or name == "settle"
        if not (low < number <= high or (number == low and ends_count)):
            least = "at least 0" if name == "settle" else f"above {low:g}"
            raise SceneError(name, str(value), f"{least} and at most {high:g}")
        document[name] = number
    return document


def _bandwidth(value: object) -> str | None:
    """Return what the core takes; a table, whose empty cells change nothing, and TOML say "none"."""
    if value not in ("auto", "none", None):
        raise SceneError("bandwidth", repr(value), "'auto' or None ('none' in tables and sweeps)")
    return "auto" if value == "auto" else None


def _rows(table: object) -> tuple[list[dict[str, Any]], list[str]]:
    """Return the rows of a table of any kind, and the names of its columns."""
    import polars as pl

    if isinstance(table, Sequence) and all(isinstance(row, Mapping) for row in table):
        rows = [dict(row) for row in table]
        names = list(dict.fromkeys(name for row in rows for name in row))
    else:
        frame = _frame(table, pl)
        rows, names = frame.to_dicts(), frame.columns
    for name in names:
        if not isinstance(name, str):
            raise SceneError("cases", f"a column {name!r}", "columns with names")
    if not rows:
        raise SceneError("cases", "an empty table", "at least one row")
    return rows, names


def _frame(table: Any, pl: Any) -> Any:
    if isinstance(table, pl.LazyFrame):
        return table.collect()
    try:
        if type(table).__module__.partition(".")[0] == "pandas":
            # Pandas says "not a number" where there is nothing.
            return pl.from_pandas(table)
        return pl.DataFrame(table)
    except (TypeError, ValueError, pl.exceptions.PolarsError) as error:
        kinds = "a table: polars, pandas, Arrow, a list of dicts or a dict of columns"
        raise SceneError("cases", type(table).__name__, f"{kinds} ({error})") from error


def _is_parameter(name: str) -> bool:
    return (name in _FIELDS and name != "scene") or "." in name or "[" in name


def _exists(document: Any, path: str) -> bool:
    """Say whether a dotted path leads somewhere in a document."""
    for step in _STEP.findall(path):
        if isinstance(document, dict) and step in document:
            document = document[step]
        elif isinstance(document, list) and step.isdigit() and int(step) < len(document):
            document = document[int(step)]
        else:
            return False
    return True


def _digest(scene: str, run: str) -> str:
    text = json.dumps(["ballrace case 1", scene, run])
    return hashlib.blake2b(text.encode(), digest_size=16).hexdigest()


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
    import polars as pl

    cells = [_plain(value) for value in values]
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
