"""Universal File Format, data sets 58 (time responses), by pyuff.

The format's own step of time has six digits, so the exact rate stands in the fifth line of text; without it
the rate is taken to the five digits that are sure.
"""

from __future__ import annotations

import errno
import re
import warnings
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import needed
from .._base.units import canonical
from ..errors import FileError, SceneError
from .rates import roundest
from .sampled import cut
from .samples import Samples
from .times import Column, examined
from .titles import TIME_UNITS, time_unit

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from .reading import Reading

_TIME_RESPONSE = 1
_TYPES = {
    0: "general", 1: "time response", 2: "auto spectrum", 3: "cross spectrum", 4: "frequency response function",
    5: "transmissibility", 6: "coherence", 7: "auto correlation", 8: "cross correlation",
    9: "power spectral density", 10: "energy spectral density", 11: "probability density", 12: "spectrum",
}  # fmt: skip
"""Function types of the format, by its names."""

_TIME, _ACCELERATION, _UNKNOWN = 17, 12, 0
"""Kinds of data on an axis, after the format."""

_ACCELERATIONS = ("m/s^2", "g")

_AXES = {
    "type": 58, "binary": 1, "func_type": _TIME_RESPONSE, "rsp_dir": 0, "ref_node": 0, "ref_dir": 0,
    "z_axis_value": 0.0, "abscissa_spacing": 1, "abscissa_spec_data_type": _TIME,
    "abscissa_axis_lab": "Time", "abscissa_axis_units_lab": "s", "orddenom_spec_data_type": _UNKNOWN,
    "z_axis_spec_data_type": _UNKNOWN,
}  # fmt: skip
"""Requirements of all data sets of a record: real numbers at equal steps of time."""

_LINE = 80
_UNIT = 20
"""Most characters of a line of text, and of a unit."""

_EXACT = re.compile(r"sampling rate (?P<fs>\S+) Hz(, shaft (?P<shaft>\S+) Hz)?")


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a binary data set a column, with 64 bits a number."""
    pyuff = needed("pyuff", path.name)
    shaft = "" if samples.shaft is None else f", shaft {samples.shaft!r} Hz"
    exact = f"sampling rate {samples.fs!r} Hz{shaft}"
    sets = [
        _AXES
        | _ordinate(name, samples.units.get(name, ""), x)
        | {"id5": exact, "rsp_node": place, "x": samples.t}
        for place, (name, x) in enumerate(samples.columns.items(), start=1)
    ]
    try:
        with warnings.catch_warnings():
            # It leaves closing the file to Python, which does so as the call returns.
            warnings.simplefilter("ignore", ResourceWarning)
            # Its mode "overwrite" would keep of each data set what stands after the samples.
            temporary.unlink(missing_ok=True)
            pyuff.UFF(str(temporary)).write_sets(sets, mode="add")
    except Exception as error:  # pyuff raises no other, and gives no reason
        raise OSError(errno.EIO, f"cannot be written ({error})", str(path)) from error


def _ordinate(name: str, unit: str, x: NDArray[np.float64]) -> dict[str, Any]:
    """Return what is a column's own in its data set; what the format cannot hold is refused."""
    if len(name.encode()) > _LINE or len(unit.encode()) > _UNIT or not name.strip():
        allowed = f"names up to {_LINE} characters and units up to {_UNIT} in a Universal File"
        raise SceneError("columns", f"{name} [{unit}]", allowed)
    if x.size < 2 or not np.isfinite(x).all():
        allowed = "in a Universal File at least two numbers, all finite: others would be read as 0"
        raise SceneError("columns", name, allowed)
    kind = _ACCELERATION if unit in _ACCELERATIONS else _UNKNOWN
    labels = {"ordinate_axis_units_lab": unit or "NONE", "ordinate_spec_data_type": kind}
    return {"id1": name, "data": x} | labels


def read(path: Path, reading: Reading) -> Samples:
    """Read all time responses; those of another rate or length than the first are ``others``.

    Raises
    ------
    FileError
        It is damaged, no Universal File, or has no time response.
    """
    pyuff = needed("pyuff", path.name)
    if path.read_bytes()[-16:].split()[-1:] != [b"-1"]:
        raise FileError(str(path), "not a Universal File, or damaged: it does not end as one")
    try:
        found = pyuff.UFF(str(path)).read_sets()
    except Exception as error:
        raise FileError(str(path), f"not a Universal File, or damaged ({error})") from error
    # Of sets that it does not know, pyuff gives none.
    functions = [
        s
        for s in (found if isinstance(found, list) else [found])
        if isinstance(s, dict) and s.get("type") == 58
    ]
    sets = [one for one in functions if _is_response(one)]
    if not sets:
        kinds = sorted({_TYPES.get(int(one.get("func_type", -1)), "unknown") for one in functions})
        has = f"; its functions are of type {', '.join(kinds)}" if kinds else ""
        raise FileError(
            str(path), f"has no time response (data set 58){has}; export the time signal"
        )
    samples = Samples(columns={})
    for data in sets:
        _take(path, data, samples, reading)
    # The unit of the axis was taken as it was given.
    return cut(path, samples, replace(reading, time_unit=None))


def _is_response(data: dict[str, Any]) -> bool:
    """Whether a function is a real signal over time: a time response, or a general one on an axis of time."""
    kind, axis = data.get("func_type"), data.get("abscissa_spec_data_type")
    label = str(data.get("abscissa_axis_units_lab", "")).strip()
    over_time = axis == _TIME or (axis == _UNKNOWN and time_unit(label) is not None)
    real = not np.iscomplexobj(data.get("data", ()))
    return real and (kind == _TIME_RESPONSE or (kind == 0 and over_time))


def _take(path: Path, data: dict[str, Any], samples: Samples, reading: Reading) -> None:
    """Add a data set to the columns; one of another rate or length than the first to the others."""
    x = np.asarray(data["data"], dtype=np.float64)
    if x.size != data["num_pts"] or x.size < 2:
        raise FileError(str(path), f"damaged: {x.size} numbers where {data['num_pts']} should be")
    exact = _EXACT.search(data["id5"])
    fs = _number(path, exact["fs"]) if exact else _rate(path, data, reading)
    rest = samples
    if samples.columns and (fs, x.size) != (samples.fs, samples.n_samples):
        alike = [one for one in samples.others if (one.fs, one.n_samples) == (fs, x.size)]
        rest = alike[0] if alike else Samples(columns={})
        if not alike:
            samples.others.append(rest)
    name = data["id1"].strip()
    if name in ("", "NONE") or name in rest.columns:
        name = f"{name}_{data['rsp_node']}".removeprefix("NONE").lstrip("_")
    if name in rest.columns:
        name = f"{name}_{len(rest.columns) + 1}"
    unit = data["ordinate_axis_units_lab"].strip()
    rest.columns[name], rest.fs = x, fs
    rest.units[name] = "" if unit == "NONE" else canonical(unit)
    rest.shaft = _number(path, exact["shaft"]) if exact and exact["shaft"] else None


def _number(path: Path, text: str) -> float:
    """Return a number that a line of text has."""
    try:
        return float(text)
    except ValueError:
        raise FileError(str(path), f"damaged: {text} Hz is no number") from None


def _rate(path: Path, data: dict[str, Any], reading: Reading) -> float | None:
    """Return the sampling rate by the axis, in the unit of its label; None where only the caller knows it [Hz]."""
    label = str(data.get("abscissa_axis_units_lab", "")).strip()
    unit = reading.time_unit or ("s" if label in ("", "NONE") else time_unit(label))
    scale = TIME_UNITS[unit] if unit is not None else None
    if scale is None:
        if reading.fs is not None:
            return None
        allowed = f"one of {', '.join(TIME_UNITS)}: the axis of {path.name} is in {label!r}; or fs="
        raise SceneError("time_unit", "None", allowed)
    if data["abscissa_spacing"]:
        step = float(data["abscissa_inc"]) * scale
        # The format has six digits of it.
        within = 0.5 * 10.0 ** (np.floor(np.log10(step)) - 5) / step if step > 0.0 else 0.0
    else:
        steps = examined(Column(name="abscissa", values=np.asarray(data["x"], dtype=np.float64)))
        if steps is None or not (steps.are_equal or steps.are_rounded):
            raise FileError(str(path), "its times are not at equal steps")
        step, within = steps.mean * scale, steps.within
    if not 0.0 < step < float("inf"):
        raise FileError(str(path), f"damaged: a step of {step} s between samples")
    return roundest(1.0 / step, max(within, 1e-12))
