"""Any table as some logger may write it is read right or refused: never other numbers, never another rate."""

from __future__ import annotations

import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

import hypothesis.strategies as st
import numpy as np
from hypothesis.strategies import DrawFn

import ballrace as br
from budget import decided, fuzzed

RATES = (1000.0, 12_000.0, 12_800.0, 20_000.0, 25_600.0, 48_000.0, 51_200.0, 97_656.25)
SEPARATORS = (";", ",", "\t", " ", "  ", " ; ", ", ", "|", "\t ")
TITLES = {
    "": ("t [s]", "Time (s)", "time", "t", "Zeit in s", "seconds", "X_Value", "abc", ""),
    "ms": ("t [ms]", "Time (ms)", "time_ms", "t / ms", "millis", "Zeit [ms]"),
    "us": ("t [us]", "Time (µs)", "time_us", "TimeUs"),
}
ABOVE = (
    "Logger X-100",
    "Serial;12",
    "Channels: 2",
    "# a remark",
    "",
    "Date,2026-11-26",
    "Operator\tN. N.",
    "Range: 10 V",
    "a, b and c",
)
BELOW = ("", "  ", "End of file", "Mean;0,5;1", "# 300 samples", "-----", "Max: 3.2")


@dataclass(frozen=True)
class Logged:
    """A file, and what it holds."""

    content: bytes
    fs: float
    signals: tuple[np.ndarray[tuple[int], np.dtype[np.float64]], ...]
    tolerance: float

    def __repr__(self) -> str:
        return f"{self.fs} Hz, {len(self.signals)} signals: {self.content[:600]!r}"


def _times(draw: DrawFn, fs: float, count: int) -> tuple[list[list[str]], list[str]]:
    """Draw columns of times with their names: none, a counter, stamps, a clock, or seconds in some unit."""
    unit = draw(st.sampled_from(("none", "", "", "ms", "us", "count", "stamp", "clock")))
    at = np.arange(count) / fs
    first = draw(st.sampled_from((0.0, 0.0, 1.5, -0.01, 1.7e9)))
    fine = draw(st.sampled_from((4, 6, 7, 9, 12)))
    match unit:
        case "none":
            return [], []
        case "count":
            return [[str(k + 1) for k in range(count)]], ["n"]
        case "stamp":
            days = draw(st.sampled_from(("", "2026-11-26 ", "26.11.2026 ", "2026-11-26T")))
            seconds = 30.0 + at
            stamps = [
                f"{days}10:{20 + int(s // 60):02d}:{s % 60.0:0{fine + 3}.{fine}f}" for s in seconds
            ]
            return [stamps], [draw(st.sampled_from(("when", "time", "Timestamp")))]
        case "clock":
            whole = np.floor(39.5 + at).astype(int)
            micro = np.floor(1e6 * (39.5 + at - whole) + 1e-6).astype(int)
            constant = [["9"] * count, ["39"] * count]
            return [*constant, [str(s) for s in whole], [str(m) for m in micro]], [
                "h",
                "m",
                "s",
                "us",
            ]
        case _:
            factor = {"": 1.0, "ms": 1e3, "us": 1e6}[unit]
            times = [f"{factor * (first + t):.{fine}f}" for t in at]
            return [times], [draw(st.sampled_from(TITLES[unit]))]


@st.composite
def logged(draw: DrawFn) -> Logged:
    """Draw a table with what loggers do to it."""
    fs, count = draw(st.sampled_from(RATES)), draw(st.sampled_from((20, 60, 300, 2000)))
    rng = np.random.default_rng(draw(st.integers(0, 10_000)))
    width, digits = draw(st.integers(1, 3)), draw(st.integers(1, 8))
    scale = 10.0 ** draw(st.integers(-2, 3))
    power = draw(st.sampled_from(("f", "f", "f", "e", "E", "g")))
    sign = draw(st.sampled_from(("", "", "+")))
    signals = tuple(scale * rng.normal(size=count) for _ in range(width))
    separator, mark = draw(st.sampled_from(SEPARATORS)), draw(st.sampled_from((".", ".", ",")))
    columns = [[f"{value:{sign}.{digits}{power}}" for value in x] for x in signals]
    titles = draw(
        st.sampled_from(
            (
                [f"ch{k}" for k in range(width)],
                [f"a{k} [g]" for k in range(width)],
                [f"Acc {k} (m/s2)" for k in range(width)],
                [],
            )
        )
    )
    times, names = _times(draw, fs, count)
    fields = [*times, *columns]
    titled = bool(titles) and draw(st.booleans())
    if mark == ",":
        # Days of a date are separated by points all the same.
        fields = [
            [re.sub(r"\.(?=\d*$|\d+[eE])", ",", text) for text in column] for column in fields
        ]
    quoted = draw(st.booleans()) and draw(st.booleans())
    if separator == "," and mark == "," and len(fields) > 1 and not quoted:
        separator = ";"  # nobody could read it
    if quoted:
        fields = [[f'"{text}"' for text in column] for column in fields]
    end = draw(st.sampled_from(("", "", "", separator.strip() or "", " ")))
    rows = [separator.join(row) + end for row in zip(*fields, strict=True)]
    above = draw(st.lists(st.sampled_from(ABOVE), max_size=4))
    if draw(st.integers(0, 3)) == 0:
        above.append(
            draw(
                st.sampled_from(
                    (f"Sampling rate: {fs:g} Hz", f"fs;{fs:g}", f"Delta_X\t{1 / fs:.10g}")
                )
            )
        )
    head = [separator.join([*names, *titles])] if titled else []
    below = draw(st.lists(st.sampled_from(BELOW), max_size=2))
    text = draw(st.sampled_from(("\n", "\r\n"))).join([*above, *head, *rows, *below]) + draw(
        st.sampled_from(("\n", ""))
    )
    encoding = draw(st.sampled_from(("utf-8", "utf-8", "utf-8-sig", "utf-16", "cp1252")))
    sizes = max(float(np.abs(x).max()) for x in signals)
    tolerance = 0.51 * 10.0**-digits * (1.0 if power == "f" else max(10.0 * sizes, 1.0))
    return Logged(text.encode(encoding, errors="replace"), fs, signals, tolerance)


@fuzzed(example=logged())
def test_what_a_logger_writes_is_read_right_or_refused(example: Logged) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.txt"
        path.write_bytes(example.content)
        found = decided(lambda: br.read(path, trusted=True))
        asked = isinstance(found, br.SceneError) and found.path in ("fs", "time_unit")
        if asked:
            found = decided(lambda: br.read(path, example.fs, trusted=True))
        assert not isinstance(found, br.InternalError), found
        if isinstance(found, br.BallraceError):
            return type(found).__name__
        assert abs(found.fs / example.fs - 1.0) < 2e-4, found
        assert len(found) == len(example.signals), found
        for x, truth in zip(found.values(), example.signals, strict=True):
            np.testing.assert_allclose(x, truth, atol=example.tolerance)
        return "read when asked" if asked else "read"
