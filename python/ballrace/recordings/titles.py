"""Units in the heads of files: of times, and of columns beside their names."""

from __future__ import annotations

import re

from .._base.units import is_unit

TIME_UNITS = {
    "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0, "d": 86400.0, "samples": None,
}  # fmt: skip
"""Units of times [s]; ``samples`` are numbers of samples."""

_SPELLINGS = {
    "s": "s sec secs second seconds sek sekunde sekunden",
    "ms": "ms msec msecs millis milli millisecond milliseconds millisekunden",
    "us": "us µs μs usec µsec μsec micros microsecond microseconds mikrosekunden",
    "ns": "ns nsec nanos nanosecond nanoseconds nanosekunden",
    "min": "min mins minute minutes minuten",
    "h": "h hr hrs hour hours std stunde stunden",
    "d": "d day days tag tage",
    "samples": "sample samples sampleno pts points point counts",
}
_BY_SPELLING = {text: unit for unit, texts in _SPELLINGS.items() for text in texts.split()}

_BRACKETED = re.compile(r"^(?P<name>.*?)\s*(?:\[(?P<square>[^\]]*)\]|\((?P<round>.*)\))\s*$")
"""A name with its unit: ``ay [m/s^2]``, ``Time (ms)``."""

_BESIDE = re.compile(r"^(?P<name>.*\S)(?:\s+in\s+|\s*[/,;]\s*)(?P<unit>\S.*)$")
"""A name with its unit behind a sign, as DIN 461 and some instruments write it: ``t / ms``, ``a in m/s²``."""

_ALONE = ("g", "G", "mg", "gE", "V", "mV", "Volt", "Volts", "volt", "volts", "ips")
"""Names of columns that are units and hardly anything else."""

_TIME_WORDS = (
    "t|time|times|zeit|zeitstempel|uhrzeit|temps|tiempo|tempo|tijd|time ?stamps?|date ?time|date/time|datum|date"
    "|elapsed"
)
_UNITS = "|".join(sorted(_BY_SPELLING, key=len, reverse=True))
_TIME_NAME = re.compile(
    r"(?:(?:rel|relative|abs|absolute|elapsed|system|unix|epoch|utc|local|sample|sampling|scan|logger|device|gps"
    r"|pc|start)"
    rf"[ _.-]*)*(?:{_TIME_WORDS}|x[ _-]?(?:values?|axis))(?:[ _.-]*(?P<unit>{_UNITS}))?"
)


def time_unit(text: str) -> str | None:
    """Return the unit of time that a text is, of :data:`TIME_UNITS`; None if it is none.

    >>> time_unit("(ms)"), time_unit("Seconds"), time_unit("µs"), time_unit("g")
    ('ms', 's', 'us', None)
    """
    return _BY_SPELLING.get(text.strip().strip("[]().").lower())


def is_time_name(name: str) -> tuple[bool, str]:
    """Whether a column's name says that it is of times, and the unit in the name, if any.

    >>> is_time_name("timestamp_ms"), is_time_name("Time"), is_time_name("load")
    ((True, 'ms'), (True, ''), (False, ''))
    """
    text = " ".join(name.lower().replace("_", " ").split())
    alone = _BY_SPELLING.get(text)
    if alone in ("s", "ms", "us", "ns"):
        return True, alone
    found = _TIME_NAME.fullmatch(text)
    return found is not None, _BY_SPELLING.get((found and found["unit"]) or "", "")


def named(title: str) -> tuple[str, str]:
    """Return the name and the unit of a column from what stands above it.

    >>> named("ay [m/s^2]"), named("t / ms"), named("Volt"), named("left, upper")
    (('ay', 'm/s^2'), ('t', 'ms'), ('Volt', 'Volt'), ('left, upper', ''))
    """
    title = title.strip(" \t")
    if found := _BRACKETED.match(title):
        unit = found["square"] if found["square"] is not None else found["round"]
        return found["name"].rstrip(" /,;") or title, unit.strip()
    found = _BESIDE.match(title)
    if found:
        unit = found["unit"].strip("() ")
        if is_unit(unit) or (time_unit(unit) and is_time_name(found["name"])[0]):
            return found["name"], unit
    return title, title if title in _ALONE or ("/" in title and is_unit(title)) else ""
