"""What the MATLAB files of public data sets hold; a function returns None for a file that is none of its own."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import FileError
from .samples import RATES, Samples

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from numpy.typing import NDArray

_CWRU = re.compile(r"X(?P<number>\d+)_(?P<place>[A-Z]{2})_time")

_SPEED = "speed"
"""Column of Paderborn's files with the speed of the shaft [1/min]."""


def cwru(path: Path, variables: Mapping[str, Any]) -> Samples | None:
    """Take the accelerations at drive end, fan end and base. Neither rate nor unit are in the file.

    Where it holds two records, as 99.mat does, the one of the file's name is taken.
    """
    found = [match for name in variables if (match := _CWRU.fullmatch(name))]
    numbers = {match["number"] for match in found}
    if not found:
        return None
    if len(numbers) > 1:
        numbers = {number for number in numbers if number.lstrip("0") == path.stem.lstrip("0")}
    if len(numbers) != 1:
        raise FileError(str(path), "holds several records, and its name is the number of none")
    (number,) = numbers
    columns = {m["place"]: _vector(variables[m[0]]) for m in found if m["number"] == number}
    rpm = variables.get(f"X{number}RPM")
    shaft = None if rpm is None else float(np.ravel(rpm)[0]) / 60.0
    return Samples(columns=_even(path, columns), shaft=shaft, metadata={"record": int(number)})


def paderborn(path: Path, variables: Mapping[str, Any]) -> Samples | None:
    """Take a struct with the times ``X`` and the signals ``Y``, by rasters; the fastest are the columns."""
    structs = {n: v for n, v in variables.items() if hasattr(v, "X") and hasattr(v, "Y")}
    if len(structs) != 1:
        return None
    ((name, struct),) = structs.items()
    times = {str(x.Raster): np.atleast_1d(x.Data) for x in np.atleast_1d(struct.X)}
    rasters: dict[str, Samples] = {}
    for y in np.atleast_1d(struct.Y):
        values, raster = _vector(np.atleast_1d(y.Data)), str(y.Raster)
        if raster not in times or times[raster].size != values.size:
            raise FileError(str(path), f"damaged: {y.Name} has not one time a sample")
        group = rasters.setdefault(raster, Samples(columns={}, fs=_rate(path, times[raster])))
        group.columns[str(y.Name)] = values
        group.units[str(y.Name)] = _text(getattr(y, "Unit", ""))
    first, *others = sorted(rasters.values(), key=lambda group: -(group.fs or 0.0))
    speeds = [
        np.mean(group.columns[_SPEED]) for group in rasters.values() if _SPEED in group.columns
    ]
    first.shaft = float(speeds[0]) / 60.0 if speeds else None
    first.metadata, first.others = {"record": name}, others
    return first


def mfpt(path: Path, variables: Mapping[str, Any]) -> Samples | None:
    """Take a struct of rate ``sr``, acceleration ``gs`` [g], ``load`` [lb] and the shaft's ``rate`` [Hz]."""
    struct: Any = variables.get("bearing")
    if not (hasattr(struct, "sr") and hasattr(struct, "gs")):
        return None
    try:
        columns = {"acceleration": _vector(struct.gs)}
        rate, load = (getattr(struct, name, None) for name in ("rate", "load"))
        return Samples(
            columns=columns,
            fs=float(struct.sr),
            units={"acceleration": "g"},
            shaft=None if rate is None else float(rate),
            metadata={} if load is None else {"load_lb": float(load)},
        )
    except (TypeError, ValueError) as error:
        raise FileError(
            str(path), f"damaged: the struct bearing cannot be read ({error})"
        ) from error


def vectors(path: Path, variables: Mapping[str, Any]) -> Samples | None:
    """Take all vectors of the greatest length by their names, and a number called ``fs`` or so as the rate."""
    columns, fs = {}, None
    for name, value in variables.items():
        array = np.asarray(value)
        if array.dtype.kind in "fiu" and array.size > 1 and max(array.shape) == array.size:
            columns[name] = _vector(array)
        elif array.dtype.kind in "fiu" and array.size == 1 and name in RATES:
            fs = float(array.ravel()[0])
    longest = max((x.size for x in columns.values()), default=0)
    columns = {name: x for name, x in columns.items() if x.size == longest}
    return Samples(columns=columns, fs=fs) if columns else None


def _vector(value: Any) -> NDArray[np.float64]:
    return np.asarray(value, dtype=np.float64).ravel()


def _even(path: Path, columns: dict[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    if len({x.size for x in columns.values()}) != 1:
        raise FileError(str(path), "damaged: its columns are of different lengths")
    return columns


def _rate(path: Path, times: NDArray[np.float64]) -> float:
    """Return the rate of a raster [Hz], to the six digits that its times are sure of."""
    if times.size < 2 or not times[-1] > times[0]:
        raise FileError(str(path), "damaged: its times do not rise")
    return float(f"{(times.size - 1) / (times[-1] - times[0]):.6g}")


def _text(value: Any) -> str:
    return value if isinstance(value, str) else ""
