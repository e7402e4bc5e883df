"""Sampling rates: how files call them, and what a rate is within the digits that are known."""

from __future__ import annotations

import math
import re

from .titles import TIME_UNITS, time_unit

_RATE = re.compile(
    r"f ?s(?:amp\w*)?|f ?a|sr|sps|sampl\w* ?(?:rate|freq\w*|clock|per ?sec\w*)"
    r"|(?:scan|acquisition|daq|logging|abtast|mess) ?(?:rate|freq\w*)"
    r"|abtastfrequenz|samples? ?(?:per|/) ?s(?:ec\w*)?|rate of sampling"
)
_INTERVAL = re.compile(
    r"d ?t|t ?s|t ?interval|(?:delta|d) ?[tx]|sampl\w* ?(?:interval|intervall|period|time|step|increment)"
    r"|time ?(?:interval|increment|step|base)|(?:abtast|mess) ?(?:interval\w*|schritt|zeit|periode)"
    r"|(?:wf|x) ?(?:increment|incr|inc|delta|step)|t ?step|t ?inc|increment|interval"
)
_HERTZ = {
    "hz": 1.0, "khz": 1e3, "mhz": 1e6, "1/s": 1.0, "s-1": 1.0, "sps": 1.0, "ksps": 1e3, "s/s": 1.0, "ks/s": 1e3,
    "sa/s": 1.0, "ksa/s": 1e3, "samples/s": 1.0, "samples/sec": 1.0, "samples/second": 1.0,
}  # fmt: skip

_WORDS = re.compile(r"(?<=[a-z])(?=[A-Z])|[_\-.:\s]+")
_UNIT = re.compile(r"^(?P<name>.*?)[\s_]*[\[(](?P<unit>[^\])]*)[\])]$")


def stated_rate(key: str, value: float, unit: str = "") -> float | None:
    """Return the sampling rate that a named number states [Hz]; None if it is another number.

    >>> stated_rate("Sampling rate (kHz)", 25.6), stated_rate("Delta_X", 3.90625e-05), stated_rate("rate", 25.0)
    (25600.0, 25600.0, None)
    """
    if not 0.0 < value < math.inf:
        return None if not _is_rate(key) else value
    if (found := _UNIT.match(key.strip())) is not None:
        key, unit = found["name"], unit or found["unit"]
    words = [word.lower() for word in _WORDS.split(key.strip()) if word not in ("", "in")]
    before = " ".join(words[:-1])
    if not unit and (_INTERVAL.fullmatch(before) or _RATE.fullmatch(before)):
        unit = words.pop()
    name = " ".join(words)
    if _RATE.fullmatch(name):
        scale = _HERTZ.get(unit.strip().lower()) if unit else 1.0
        return None if scale is None else value * scale
    if _INTERVAL.fullmatch(name):
        scale = TIME_UNITS.get(time_unit(unit) or "") if unit else 1.0
        # Without a unit it is in seconds, or no interval between samples of vibration.
        return (
            None
            if scale is None or (not unit and value >= 1.0)
            else roundest(1.0 / (value * scale), 1e-9)
        )
    return None


def _is_rate(key: str) -> bool:
    return _RATE.fullmatch(" ".join(w.lower() for w in _WORDS.split(key.strip()) if w)) is not None


def roundest(rate: float, within: float) -> float:
    """Return the number of fewest digits near a rate, or one over that near its step, within a part of it.

    >>> roundest(25599.99987, 1e-8), roundest(1666.6667, 1e-3), roundest(97656.25, 1e-12)
    (25600.0, 1666.66666667, 97656.25)
    """
    digits, found = _shortest(rate, within)
    fewer, step = _shortest(1.0 / rate, within)
    return float(f"{1.0 / step:.12g}") if fewer < digits else found


def _shortest(value: float, within: float) -> tuple[int, float]:
    for digits in range(1, 12):
        found = float(f"{value:.{digits}g}")
        if abs(found - value) <= within * value:
            return digits, found
    return 12, float(f"{value:.12g}")
