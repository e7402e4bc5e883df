"""Meanings of a campaign's columns, in words with their units."""

from __future__ import annotations

import re

from .style import title, words

_UNITS = {
    "force": "N", "width": "m", "length": "m", "clearance": "m", "axial_offset": "m", "edge_radius": "m",
    "ball_diameter": "m", "pitch_diameter": "m", "speed": "rad/s", "angle": "rad", "start_angle": "rad",
    "contact_angle": "rad", "axial_preload": "m", "mass": "kg", "stiffness": "N/m", "amplitude": "m", "depth": "m",
    "rim_height": "m",
    "load_max": "N", "load_min": "N", "film_min": "m", "friction_torque_mean": "N m", "slip_power_mean": "W",
    "rolling_power_mean": "W", "damping_power_mean": "W", "drag_power_mean": "W",
}  # fmt: skip
_SHAPES = {
    "rms": "root mean square",
    "peak": "peak",
    "crest_factor": "crest factor",
    "kurtosis": "kurtosis",
}
_BARE = ("crest_factor", "kurtosis")
_LINES = {"ftf": "FTF", "bpfo": "BPFO", "bpfi": "BPFI", "2bsf": "2·BSF"}
_ACCELERATION = "m/s²"


def parameter(path: str) -> str:
    """Return a field of a scene in words: what it is of, itself, and its unit.

    Examples
    --------
    >>> parameter("loads.axial.force"), parameter("rows[1].clearance"), parameter("speed_class")
    ('axial load, force / N', 'row 1, clearance / m', 'speed class')
    """
    *parts, field = re.sub(r"\[(\d+)\]", r" \1", path).split(".")
    named = [part for part in parts if part not in ("loads", "defects", "unbalances")]
    if parts and parts[0] == "loads":
        named[0] += " load"
    of = " ".join(named).replace("rows ", "row ")
    what = field.replace("_", " ")
    return title(f"{of}, {what}" if of else what, _UNITS.get(field, "") if parts else "")


def feature(column: str) -> str:
    """Return a feature in words.

    Examples
    --------
    >>> feature("outer.ay.rms")
    'root mean square, vertical acceleration, outer ring / m/s²'
    >>> feature("outer.ay.row0.bpfo_envelope")
    'envelope line at BPFO, row 0, vertical acceleration, outer ring / (m/s²)²'
    >>> feature("largest_pressure")
    'largest pressure / Pa'
    >>> feature("outer.ay.rms_se")
    'standard error of root mean square, vertical acceleration, outer ring / m/s²'
    """
    if column.endswith("_se"):
        return f"standard error of {feature(column.removesuffix('_se'))}"
    if column == "largest_pressure":
        return "largest pressure / Pa"
    signal, _, name = column.rpartition(".")
    accelerated = re.search(r"\.a[xyz]$", signal.rpartition(".row")[0] or signal) is not None
    unit = _ACCELERATION if accelerated else ""
    if name in _SHAPES and signal:
        return title(f"{_SHAPES[name]}, {words(signal)}", "" if name in _BARE else unit)
    line = re.fullmatch(r"(ftf|bpfo|bpfi|2bsf)(_envelope)?(?:_(harmonics|sidebands))?", name)
    if line is None or ".row" not in signal:
        return parameter(column)
    signal, _, row = signal.rpartition(".row")
    also = f" with {line[3]}" if line[3] else ""
    kind = "envelope line" if line[2] else "line"
    square = f"({unit})²" if line[2] and unit else unit
    return title(f"{kind} at {_LINES[line[1]]}{also}, row {row}, {words(signal)}", square)
