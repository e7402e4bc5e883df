"""Arrays by names, in structs and groups: which are signals, at which rate, and what is beside them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from .._base.units import canonical
from ..errors import FileError
from .lines import other_ways
from .preamble import rate_in
from .rates import stated_rate
from .sampled import at_its_rate, sampled
from .samples import Said, Samples
from .times import Column

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from .reading import Reading

_WIDEST = 64
"""Most columns of a matrix of signals."""

_NARROW = 4
"""How many times longer than wide a matrix of signals is at least."""

_SAME = 0.01
"""Largest difference of lengths, as a part, up to which vectors without a rate of their own are of one rate."""

_LABELS = (
    "names",
    "name",
    "labels",
    "label",
    "channels",
    "channel_names",
    "columns",
    "column_names",
    "signals",
    "block0_items",
)
_UNITS = ("units", "unit", "y_unit", "yunit", "engunits", "eu", "unit_string")
_LONGEST = 200
"""Characters of a text that is kept as metadata."""


@dataclass(frozen=True, eq=False)
class Leaf:
    """An array with the attributes it has in the file."""

    values: NDArray[Any]
    attributes: Mapping[str, Any] = field(default_factory=dict)


Tree = dict[str, Any]
"""Content by names: leaves, numbers, texts, trees (structs, groups), lists of these (cells, arrays of structs)."""


@dataclass(kw_only=True, eq=False)
class _Found:
    """An array that may be signals, with what is said near it."""

    column: Column
    rate: float | None


def from_tree(
    path: Path, tree: Tree, reading: Reading, *, joint: str = ".", shaft: float | None = None
) -> Samples:
    """Return the signals of the largest group of arrays of one length and rate; the other groups are ``others``.

    Raises
    ------
    FileError
        There are none.
    SceneError
        As of :func:`.sampled.sampled`.
    """
    walk = _Walk(joint)
    walk.through(tree, "", None, None)
    left, texts = walk.left, walk.texts
    if len(walk.rates) == 1 and all(one.rate is None for one in walk.found):
        # As in a head of the file, beside the structs with signals.
        for one in walk.found:
            (one.rate,) = walk.rates
    groups: dict[tuple[int, float | None], list[_Found]] = {}
    for one in walk.found:
        groups.setdefault((one.column.values.size, one.rate), []).append(one)
    if not groups:
        has = f"; it has {', '.join(left[:8])}" if left else ""
        among = "" if left else f" among {', '.join(list(tree)[:8]) or 'nothing'}"
        reason = "holds no data set that could be a signal, a vector or a matrix of numbers"
        raise FileError(str(path), f"{reason}{has}{among}; {other_ways()}")
    wanted = {key for key, _ in reading.columns or () if isinstance(key, str)}

    def weight(item: tuple[tuple[int, float | None], list[_Found]]) -> tuple[int, int]:
        (length, _), group = item
        return sum(one.column.name in wanted for one in group), length * len(group)

    ordered = sorted(groups.items(), key=weight, reverse=True)
    (size, rate), first = ordered[0]
    metadata = texts | ({"left_out": left} if left else {})
    said = Said(rate=rate, metadata=metadata)
    samples = sampled(path, [one.column for one in first], reading, said)
    samples.shaft = shaft
    for (length, own), group in ordered[1:]:
        alike = own is None and abs(length - size) <= _SAME * size
        samples.others.append(_other([one.column for one in group], samples.fs if alike else own))
    samples.others = [at_its_rate(one, reading) for one in samples.others]
    return samples


def _other(columns: list[Column], fs: float | None) -> Samples:
    units = {column.name: canonical(column.unit) for column in columns}
    return Samples(columns={column.name: column.values for column in columns}, fs=fs, units=units)


class _Walk:
    """Walk through a tree: arrays that may be signals, others, and what is said about them."""

    def __init__(self, joint: str) -> None:
        self._joint = joint
        self._names: set[str] = set()
        self.rates: set[float] = set()
        self.found: list[_Found] = []
        self.left: list[str] = []
        self.texts: dict[str, Any] = {}

    def through(self, tree: Tree, prefix: str, rate: float | None, unit: str | None) -> None:
        """Collect arrays of a struct and of those in it; a rate and a unit hold for what is below them."""
        rate = _stated(tree, rate)
        if rate is not None:
            self.rates.add(rate)
        said = (one for name, one in tree.items() if name.lower() in _UNITS)
        unit = next((one for one in said if isinstance(one, str)), unit)
        for name, value in tree.items():
            full = f"{prefix}{self._joint}{name}" if prefix else name
            match value:
                case Leaf():
                    self._take(value, full, tree, rate, unit)
                case dict():
                    self.through(value, full, rate, unit)
                case list() if not all(isinstance(one, str) for one in value):
                    inner = {str(place + 1): one for place, one in enumerate(value)}
                    self.through(inner, full, rate, unit)
                case str() if len(value) <= _LONGEST:
                    self.texts[full] = value
                case float() if _stated({name: value}, None) is None:
                    self.texts[full] = value

    def _take(
        self, leaf: Leaf, name: str, beside: Tree, rate: float | None, unit: str | None
    ) -> None:
        """Add the columns of an array."""
        values = np.squeeze(leaf.values)
        if values.ndim not in (1, 2) or (values.ndim == 2 and not _is_long(values.shape)):
            self.left.append(f"{name} {values.shape}")
            return
        rows = np.atleast_2d(values)
        rows = rows if rows.shape[0] < rows.shape[1] else rows.T
        count = len(rows)
        units = _texts(leaf.attributes, _UNITS, count) or _texts(beside, _UNITS, count)
        names = [name]
        if count > 1:
            labels = _texts(leaf.attributes, _LABELS, count) or _texts(beside, _LABELS, count)
            names = labels or [f"{name}_{place + 1}" for place in range(count)]
        rate = _stated(leaf.attributes, rate)
        for label, row, one in zip(names, rows, units or [unit or ""] * count, strict=True):
            free = f"{name} {label}" if label in self._names else label
            self._names.add(free)
            self.found.append(_Found(column=Column(name=free, values=row, unit=one), rate=rate))


def _stated(entries: Mapping[str, Any], otherwise: float | None) -> float | None:
    """Return the sampling rate among named numbers."""
    rates = (
        stated_rate(name, value) if isinstance(value, float) else rate_in(name, value)
        for name, value in entries.items()
        if isinstance(value, float | str)
    )
    return next((rate for rate in rates if rate is not None), otherwise)


def _is_long(shape: tuple[int, ...]) -> bool:
    """Whether a matrix is a few signals beside each other."""
    return min(shape) <= _WIDEST and max(shape) >= _NARROW * min(shape)


def _texts(where: Mapping[str, Any], names: tuple[str, ...], count: int) -> list[str] | None:
    """Return texts that stand under one of some names, one for each column; one text is that of all."""
    for name, value in where.items():
        if name.lower() not in names:
            continue
        if isinstance(value, str) and (count == 1 or names is _UNITS):
            return [value] * count
        if (
            isinstance(value, list)
            and len(value) == count
            and all(isinstance(one, str) for one in value)
        ):
            return list(value)
    return None


def leaves(tree: Tree) -> Iterator[Leaf]:
    """Yield all arrays."""
    for value in tree.values():
        match value:
            case Leaf():
                yield value
            case dict():
                yield from leaves(value)
            case list():
                yield from leaves({str(place): one for place, one in enumerate(value)})
