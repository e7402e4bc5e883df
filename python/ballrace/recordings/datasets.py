"""MATLAB files of public data sets and of LMS; a function returns None for a file of another kind."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.units import canonical
from ..errors import FileError
from .rates import roundest
from .sampled import cut
from .samples import Samples
from .titles import TIME_UNITS, time_unit
from .tree import Leaf, Tree, from_tree

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from numpy.typing import NDArray

    from .reading import Reading

_CWRU = re.compile(r"X(?P<number>\d+)_(?P<place>[A-Z]{2})_time")

_SPEED = "speed"
"""Column of Paderborn's files with the speed of the shaft [1/min]."""


def cwru(path: Path, tree: Tree, reading: Reading) -> Samples | None:
    """Take the accelerations at drive end, fan end and base. Neither rate nor unit are in the file.

    Where it holds two records, as 99.mat does, the one of the file's name is taken.
    """
    found = [match for name in tree if (match := _CWRU.fullmatch(name))]
    numbers = {match["number"] for match in found}
    if not found:
        return None
    if len(numbers) > 1:
        numbers = {number for number in numbers if number.lstrip("0") == path.stem.lstrip("0")}
    if len(numbers) != 1:
        raise FileError(str(path), "holds several records, and its name is the number of none")
    (number,) = numbers
    columns = {m["place"]: tree[m[0]] for m in found if m["number"] == number}
    rpm = tree.get(f"X{number}RPM")
    shaft = float(np.ravel(rpm.values)[0]) if isinstance(rpm, Leaf) else rpm
    shaft = shaft / 60.0 if isinstance(shaft, float) else None
    samples = from_tree(path, columns, reading, shaft=shaft)
    samples.metadata["record"] = int(number)
    return samples


def paderborn(path: Path, tree: Tree, reading: Reading) -> Samples | None:
    """Take a struct with the times ``X`` and the signals ``Y``, by rasters; the fastest are the columns."""
    structs = {n: v for n, v in tree.items() if isinstance(v, dict) and {"X", "Y"} <= set(v)}
    if len(structs) != 1:
        return None
    ((name, struct),) = structs.items()
    times = {str(x.get("Raster")): _vector(x.get("Data")) for x in _structs(struct["X"])}
    rasters: dict[str, Samples] = {}
    for y in _structs(struct["Y"]):
        values, raster, label = _vector(y.get("Data")), str(y.get("Raster")), str(y.get("Name"))
        if raster not in times or times[raster].size != values.size:
            raise FileError(str(path), f"its signal {label} has not one time a sample")
        group = rasters.setdefault(raster, Samples(columns={}, fs=_rate(path, times[raster])))
        group.columns[label] = values
        group.units[label] = y["Unit"] if isinstance(y.get("Unit"), str) else ""
    if not rasters:
        raise FileError(str(path), "has no signals in the struct of its record")
    first, *others = sorted(rasters.values(), key=lambda group: -(group.fs or 0.0))
    speeds = [
        np.mean(group.columns[_SPEED]) for group in rasters.values() if _SPEED in group.columns
    ]
    first.shaft = float(speeds[0]) / 60.0 if speeds else None
    first.metadata, first.others = {"record": name}, others
    return cut(path, first, reading)


def _structs(value: Any) -> list[Tree]:
    found = value if isinstance(value, list) else [value]
    return [one for one in found if isinstance(one, dict)]


def mfpt(path: Path, tree: Tree, reading: Reading) -> Samples | None:
    """Take a struct of rate ``sr``, acceleration ``gs`` [g], ``load`` [lb] and the shaft's ``rate`` [Hz]."""
    struct = next(
        (v for v in tree.values() if isinstance(v, dict) and {"sr", "gs"} <= set(v)), None
    )
    if struct is None:
        return None
    rate, load, sr = (struct.get(name) for name in ("rate", "load", "sr"))
    values = _vector(struct["gs"])
    if not isinstance(sr, float) or not values.size:
        raise FileError(
            str(path), "damaged: the struct bearing cannot be read: it has no rate or no samples"
        )
    samples = Samples(
        columns={"acceleration": values},
        fs=sr,
        units={"acceleration": "g"},
        shaft=rate if isinstance(rate, float) else None,
        metadata={"load_lb": load} if isinstance(load, float) else {},
    )
    return cut(path, samples, reading)


def lms(path: Path, tree: Tree, reading: Reading) -> Samples | None:
    """Take structs with ``x_values.increment`` and ``y_values.values``, as LMS (Simcenter Testlab) has them."""
    found: Tree = {}
    for name, struct in _with_axes(tree):
        x, y = struct["x_values"], struct["y_values"]
        increment, values = x.get("increment"), y.get("values")
        if not (isinstance(increment, float) and increment > 0.0 and isinstance(values, Leaf)):
            continue
        unit = time_unit(_label(x) or "s")
        scale = TIME_UNITS[unit] if unit else None
        if scale is None:
            continue  # a spectrum, over Hz
        label = _called(struct) or name
        labels = label if isinstance(label, str) else "; ".join(label)
        attributes: dict[str, Any] = {
            "sampling_rate": roundest(1.0 / (increment * scale), 1e-6),
            "unit": _label(y) or "",
        }
        if not isinstance(label, str):
            attributes["names"], labels = label, name
        found[labels if labels not in found else f"{labels} {name}"] = Leaf(
            values.values, attributes
        )
    return from_tree(path, found, reading) if found else None


def _with_axes(tree: Tree, prefix: str = "") -> Iterator[tuple[str, Tree]]:
    for name, value in tree.items():
        for place, struct in enumerate(_structs(value)):
            full = f"{prefix}{name}" if place == 0 else f"{prefix}{name}_{place + 1}"
            if all(isinstance(struct.get(axis), dict) for axis in ("x_values", "y_values")):
                yield full, struct
            else:
                yield from _with_axes(struct, f"{full}.")


def _label(axis: Tree) -> str | None:
    quantity = axis.get("quantity")
    label = quantity.get("label") if isinstance(quantity, dict) else axis.get("unit")
    return canonical(label) if isinstance(label, str) else None


def _called(struct: Tree) -> str | list[str] | None:
    record = struct.get("function_record")
    name = record.get("name") if isinstance(record, dict) else struct.get("name")
    if isinstance(name, list):
        return [str(one) for one in name]
    return name if isinstance(name, str) else None


def _vector(value: Any) -> NDArray[Any]:
    """Return numbers as a row; an empty one of what is none."""
    if isinstance(value, Leaf):
        return np.ravel(value.values)
    return np.array([value]) if isinstance(value, float) else np.empty(0)


def _rate(path: Path, times: NDArray[Any]) -> float:
    """Return the rate of a raster [Hz], to the six digits that its times are sure of."""
    if times.size < 2 or not times[-1] > times[0]:
        raise FileError(str(path), "damaged: its times do not rise")
    return float(f"{(times.size - 1) / (times[-1] - times[0]):.6g}")
