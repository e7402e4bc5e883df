"""Text tables as loggers export them: separators, decimal marks, what stands above and below; else a message.

The numbers are drawn here, written as each logger would, and have to come back.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import ballrace as br

FS = 25_600.0
N = 300
_rng = np.random.default_rng(66)
A = np.round(_rng.normal(size=N), 6)
B = np.round(0.5 * _rng.normal(size=N), 6)
T = np.arange(N) / FS


def number(value: float, form: str = "{:.6f}", mark: str = ".") -> str:
    return form.format(value).replace(".", mark)


def rows(
    separator: str = ",", mark: str = ".", form: str = "{:.6f}", *, t: bool = True, b: bool = False
) -> list[str]:
    """Lines of times, the first signal, and the second."""
    columns = [[number(x, "{:.9f}", mark) for x in T]] if t else []
    columns.append([number(x, form, mark) for x in A])
    columns += [[number(x, form, mark) for x in B]] if b else []
    return [separator.join(fields) for fields in zip(*columns, strict=True)]


def table(lines: list[str], *above: str, below: tuple[str, ...] = (), end: str = "\n") -> str:
    return end.join([*above, *lines, *below]) + end


def written(path: Path, text: str, encoding: str = "utf-8") -> Path:
    path.write_bytes(text.encode(encoding))
    return path


def check(
    record: br.Recording, second: bool = False, fs: float = FS, within: float = 1e-12
) -> None:
    assert record.fs == fs
    values = list(record.values())
    assert len(values) == 1 + second, list(record)
    np.testing.assert_allclose(values[0], A, atol=within)
    if second:
        np.testing.assert_allclose(values[1], B, atol=within)


WHOLE = np.concatenate([np.zeros(20), np.round(A[20:], 3)])
SHORT = np.round(A, 1)

# One column of numbers with decimal commas, however they are written.
DECIMAL_COMMAS: dict[
    str, tuple[Callable[[], str], np.ndarray[tuple[int], np.dtype[np.float64]]]
] = {
    "plain": (lambda: table(rows(mark=",", t=False)), A),
    "carriage returns": (lambda: table(rows(mark=",", t=False), end="\r\n"), A),
    "no end of the last line": (lambda: table(rows(mark=",", t=False)).rstrip("\n"), A),
    "powers of ten": (lambda: table(rows(mark=",", form="{:.5e}", t=False)), A),
    "capital powers": (lambda: table(rows(mark=",", form="{:.5E}", t=False)), A),
    "signs": (lambda: table(rows(mark=",", form="{:+.6f}", t=False)), A),
    "quoted": (lambda: table([f'"{row}"' for row in rows(mark=",", t=False)]), A),
    "whole numbers first": (
        lambda: table([f"{x:g}".replace(".", ",") for x in WHOLE]),
        WHOLE,
    ),
    "whole numbers between": (lambda: table([f"{x:g}".replace(".", ",") for x in SHORT]), SHORT),
    "a name": (lambda: table(rows(mark=",", t=False), "Beschleunigung [g]"), A),
    "a name without a unit": (lambda: table(rows(mark=",", t=False), "Beschleunigung"), A),
    "a remark": (lambda: table(rows(mark=",", t=False), "# Sensor 1, links"), A),
    "blank lines": (lambda: table(rows(mark=",", t=False), "", "") + "\n\n", A),
    "blanks around": (lambda: table([f"  {row} " for row in rows(mark=",", t=False)]), A),
    "UTF-8 with a mark": (lambda: "\ufeff" + table(rows(mark=",", t=False)), A),
    "no zero before the comma": (
        lambda: table(
            [
                row.replace("0,", ",") if row.lstrip("-").startswith("0,") else row
                for row in rows(mark=",", t=False)
            ]
        ),
        A,
    ),
    "preamble": (
        lambda: table(rows(mark=",", t=False), "Messung vom Montag", "Abtastrate: 25600 Hz", ""),
        A,
    ),
}


@pytest.mark.parametrize("case", DECIMAL_COMMAS)
def test_a_column_with_decimal_commas_is_one_column(tmp_path: Path, case: str) -> None:
    text, truth = DECIMAL_COMMAS[case]
    record = br.read(written(tmp_path / "acc.txt", text()), FS)
    (x,) = record.values()
    np.testing.assert_allclose(x, truth, atol=1e-5 if "power" in case else 1e-12)


# Two or three columns, whatever separates them and whatever the decimal mark is.
SEPARATORS: dict[str, str] = {
    "comma": table(rows(), "t [s],a"),
    "comma and blanks": table(rows(", "), "t [s], a"),
    "semicolon": table(rows(";"), "t [s];a"),
    "semicolon, decimal comma": table(rows(";", ","), "t [s];a"),
    "tab, decimal comma": table(rows("\t", ","), "t [s]\ta"),
    "blanks, decimal comma": table(rows("   ", ","), "t [s]   a"),
    "blanks before": table(["   " + row for row in rows("  ")], "  t [s]  a"),
    "bars": table(rows(" | "), "t [s] | a"),
    "quoted, decimal commas between commas": table(
        [",".join(f'"{field}"' for field in row.split(";")) for row in rows(";", ",")],
        '"t [s]","a"',
    ),
    "decimal commas between commas": table(rows(",", ","), "t [s];a"),
    "tab with blanks": table(rows("\t "), "t [s]\ta"),
    "Fortran's powers": table(
        [row.replace("E", "D") for row in rows(" ", form="{:.6E}")], "t [s] a"
    ),
    "typeset minus": table([row.replace("-", "−") for row in rows(";")], "t [s];a"),
    "thousands": table([f"{t:.9f};{x:,.6f}" for t, x in zip(T, 1e4 * A, strict=True)], "t [s];a"),
    "thousands, decimal comma": table(
        [
            f"{t:.9f};{x:,.6f}".replace(",", "'").replace(".", ",").replace("'", ".")
            for t, x in zip(T, 1e4 * A, strict=True)
        ],
        "t [s];a",
    ),
}


@pytest.mark.parametrize("case", SEPARATORS)
def test_what_separates_columns_is_found(tmp_path: Path, case: str) -> None:
    record = br.read(written(tmp_path / "a.csv", SEPARATORS[case]))
    assert record.fs == FS
    (x,) = record.values()
    scale = 1e4 if "thousands" in case else 1.0
    np.testing.assert_allclose(x / scale, A, atol=2e-6 if "powers" in case else 1e-9)


# What precedes a table: names, units, preambles; names, units and rate have to be right.
ABOVE: dict[str, tuple[str, str, str, str]] = {
    "names": (table(rows(), "Time (s),Channel A (mV)"), "Channel A", "mV", "utf-8"),
    "units below names": (
        table(rows(), "Time,Channel A", "(s),(mV)", ""),
        "Channel A",
        "mV",
        "utf-8",
    ),
    "bare units below names": (table(rows(";"), "Zeit;a", "s;m/s²"), "a", "m/s^2", "cp1252"),
    "units above names": (table(rows("\t"), "s\tg", "t\ta"), "a", "g", "utf-8"),
    "keys and values": (
        table(
            rows(),
            "Model,X-100",
            "Serial,12",
            "Sample Rate,25600",
            "Date,2026-11-26 10:00:00",
            "",
            "Time [s],Acc [g]",
        ),
        "Acc",
        "g",
        "utf-8",
    ),
    "keys with colons": (
        table(rows(";"), "Device: logger", "Channels: 1", "Comment: run, up", "t [s];Acc [g]"),
        "Acc",
        "g",
        "utf-8",
    ),
    "remarks and blank lines": (
        table(rows(), "# logger", "", "# range 10, 20, 30", "", "Time [s],Acc [g]", ""),
        "Acc",
        "g",
        "utf-8",
    ),
    "names in a remark": (table(rows(" "), "# t[s] Acc[g]"), "Acc", "g", "utf-8"),
    "UTF-16": (table(rows("\t"), "Time (s)\tAcc (g)", end="\r\n"), "Acc", "g", "utf-16"),
    "UTF-16 without a mark": (table(rows("\t"), "Time (s)\tAcc (g)"), "Acc", "g", "utf-16-le"),
    "UTF-8 with a mark": ("\ufeff" + table(rows(), "Time [s],Acc [g]"), "Acc", "g", "utf-8"),
    "Latin-1": (
        table(rows(";"), "Gerät;Prüfstand", "Zeit [s];Acc [m/s²]"),
        "Acc",
        "m/s^2",
        "latin-1",
    ),
    "units by DIN": (table(rows(";"), "t / s;a / (m/s²)"), "a", "m/s^2", "utf-8"),
    "units in words": (table(rows(";"), "Zeit in s;Acc in g"), "Acc", "g", "utf-8"),
    "quoted names": (
        table(rows(), '"Time, elapsed [s]","Acc, left [g]"'),
        "Acc, left",
        "g",
        "utf-8",
    ),
    "a table's own small numbers": (
        table(rows(), "Channels,1", "Range,10", "Points,300", "Time [s],Acc [g]"),
        "Acc",
        "g",
        "utf-8",
    ),
    "blank lines alone": (table(rows(), "", "", "Time [s],Acc [g]"), "Acc", "g", "utf-8"),
    "a long preamble": (
        table(rows(), *[f"Line {k}: text" for k in range(300)], "Time [s],Acc [g]"),
        "Acc",
        "g",
        "utf-8",
    ),
    "carriage returns alone": (table(rows(), "Time [s],Acc [g]", end="\r"), "Acc", "g", "utf-8"),
}


@pytest.mark.parametrize("case", ABOVE)
def test_what_precedes_a_table_is_names_units_and_preamble(tmp_path: Path, case: str) -> None:
    text, name, unit, encoding = ABOVE[case]
    record = br.read(written(tmp_path / "scope.csv", text, encoding))
    check(record)
    assert (list(record), record.units[name]) == ([name], unit)


def test_a_preamble_is_kept_and_its_rate_counts(tmp_path: Path) -> None:
    above = ("Model: X-100", "Sample interval [us];39.0625", "run up", "Acc [g]")
    record = br.read(written(tmp_path / "a.txt", table(rows(t=False), *above)))
    check(record)
    assert record.metadata["Model"] == "X-100"
    assert record.metadata["remarks"] == ["run up"]


@pytest.mark.parametrize(
    "line",
    [
        "Sampling rate: 25600",
        "fs = 25600 Hz",
        "Sample Rate (kHz),25.6",
        "Abtastrate;25,6 kHz",
        "Delta_X\t3.90625E-5",
        "Sampling Frequency [Hz]\t25600",
        "# SampleRate: 25600",
        "dt=3.90625e-5",
        "Sample Interval,39.0625,us",
        "Samples/sec: 25600",
        "sampling_rate_hz: 25600",
    ],
)
def test_a_rate_stands_above_under_many_names(tmp_path: Path, line: str) -> None:
    check(br.read(written(tmp_path / "a.txt", table(rows(t=False), line, "Acc [g]"))))


# What follows a table: separators, blank lines, footers.
BELOW: dict[str, str] = {
    "semicolons at ends": table([row + ";" for row in rows(";")], "t [s];a [g];"),
    "semicolons at ends of rows": table([row + ";" for row in rows(";")], "t [s];a [g]"),
    "commas at ends": table([row + "," for row in rows()], "t [s],a [g],"),
    "tabs at ends": table([row + "\t" for row in rows("\t")], "t [s]\ta [g]\t"),
    "blanks at ends": table([row + "  " for row in rows(" ")], "t a"),
    "two separators at ends": table([row + ",," for row in rows()], "t [s],a [g],,"),
    "an empty column between": table([row.replace(";", ";;") for row in rows(";")], "t [s];;a [g]"),
    "blank lines": table(rows(), "t [s],a [g]") + "\n\n  \n",
    "blank lines between rows": table([row + "\n" for row in rows()], "t [s],a [g]"),
    "a footer of keys": table(rows(), "t [s],a [g]", below=("", "Max,2.5", "Min,-2.5")),
    "a footer of words": table(rows(";"), "t [s];a [g]", below=("End of file",)),
    "a footer of statistics": table(
        rows(";"), "t [s];a [g]", below=("Mean;0,5;1,5", "RMS;1;2", "")
    ),
    "a line": table(rows(), "t [s],a [g]", below=("-" * 40,)),
    "the end of old texts": table(rows(), "t [s],a [g]") + "\x1a",
    "remarks between rows": table(
        [row + "\n# mark" if k == 7 else row for k, row in enumerate(rows())], "t [s],a [g]"
    ),
    "a remark below": table(rows(), "t [s],a [g]", below=("# 300 samples",)),
    "single column with separators": table(
        [row + ";" for row in rows(t=False)], "Abtastrate: 25600 Hz", "a [g]"
    ),
}


@pytest.mark.parametrize("case", BELOW)
def test_what_follows_rows_and_tables_is_no_data(tmp_path: Path, case: str) -> None:
    check(br.read(written(tmp_path / "a.csv", BELOW[case])))


# Refused: the message has to say what to do.
REFUSED: dict[str, tuple[str, str]] = {
    "a broken row": (
        table([*rows()[:20], "0.1,x", *rows()[20:]], "t [s],a"),
        r"column a has .*'x' in line 22",
    ),
    "a broken row among the first": (
        table([*rows()[:5], "0.1,---", *rows()[5:]], "t [s],a"),
        r"column a has .*'---' in line 7",
    ),
    "a row that is cut": (
        table(rows(), "t [s],a", below=("0.01171",)),
        r"line 302 has 1 fields where the others have 2",
    ),
    "a row too long": (
        table([*rows()[:20], "1,2,3", *rows()[20:]], "t [s],a"),
        r"line 22 has 3 fields",
    ),
    "text between rows": (
        table([*rows()[:20], "OVERLOAD", *rows()[20:]], "t [s],a"),
        r"line 22 \('OVERLOAD'\) interrupts .* skip=22",
    ),
    "a second table": (
        table(rows(), "t [s],a", below=("", "second", "t [s],a", *rows())),
        r"interrupts the table, and line .* skip=",
    ),
    "a first table": (
        table(["1,2", "3,4", "again,now", *rows()], "t [s],a"),
        r"interrupts a table.* skip=",
    ),
    "an empty field": (table([*rows()[:20], "0.1,", *rows()[20:]], "t [s],a"), r"line 22"),
    "names too many": (table(rows(), "t,a,b"), r"header names 3 columns of 2; skip="),
    "one name twice": (table(rows(b=True), "t [s],a,a"), r"one name, 'a'; give columns="),
    "commas that may be both": (
        table([f"{k % 7},{3 + k % 5}" for k in range(50)]),
        r'decimal="\." reads 2 columns \(0 and 3; 1 and 4; .*decimal="," 1 \(0\.3; 1\.4',
    ),
    "no table": (
        "Dear colleague,\nplease find the data attached.\n",
        r"no line holds numbers alone.*br\.Recording",
    ),
    "one line of all samples": (
        ",".join(rows(t=False)) + "\n",
        r"300 numbers in a line.*numpy\.loadtxt",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
@pytest.mark.parametrize("trusted", [False, True])
def test_what_is_no_table_is_refused_with_a_remedy(
    tmp_path: Path, case: str, trusted: bool
) -> None:
    text, message = REFUSED[case]
    with pytest.raises(br.FileError, match=message):
        br.read(written(tmp_path / "a.csv", text), FS, trusted=trusted)


def test_what_is_ambiguous_is_read_as_it_is_told(tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", "".join(f"{k % 7},{3 + k % 5}\n" for k in range(50)))
    assert len(br.read(path, FS, decimal=".")) == 2
    (x,) = br.read(path, FS, decimal=",").values()
    assert x[:3].tolist() == [0.3, 1.4, 2.5]


def test_lines_are_skipped_where_they_look_like_rows(tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", table(rows(), "1,2", "3,4", "t [s],a [g]"))
    with pytest.raises(br.FileError, match="skip=3"):
        br.read(path)
    record = br.read(path, skip=2)
    check(record)
    assert record.units["a"] == "g"


def test_columns_are_chosen_by_names_and_places(tmp_path: Path) -> None:
    path = written(tmp_path / "a.csv", table(rows(b=True), "t [s],a [g],b [g]"))
    check(br.read(path), second=True)
    for columns in ("b", 2, -1, ["b"], {"b": "b"}, {2: "b"}):
        record = br.read(path, columns=columns)
        assert (list(record), record.fs) == (["b"], FS)
        np.testing.assert_array_equal(record["b"], B)
    assert list(br.read(path, columns={1: "horizontal", 2: "vertical"})) == [
        "horizontal",
        "vertical",
    ]
    for columns in ("c", 3, ["a", "c"], {-4: "x"}):
        with pytest.raises(br.SceneError, match=r"columns = .*0: t, 1: a, 2: b"):
            br.read(path, columns=columns)


def test_text_columns_beside_numbers_are_kept_as_metadata(tmp_path: Path) -> None:
    lines = [f"{row},running" for row in rows()]
    record = br.read(written(tmp_path / "a.csv", table(lines, "t [s],a [g],state")))
    check(record)
    assert record.metadata["texts"] == {"state": "running"}


def test_a_table_without_names_by_another_program(tmp_path: Path) -> None:
    """As pandas writes arrays: names are numbers, and rows are numbered."""
    plain = table(rows(t=False, b=True), "0,1")
    check(br.read(written(tmp_path / "a.csv", plain), FS), second=True)
    numbered = table([f"{k},{row}" for k, row in enumerate(rows(t=False, b=True))], ",0,1")
    record = br.read(written(tmp_path / "b.csv", numbered), FS)
    check(record, second=True)


LVM = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t,
Multi_Headings\tNo
X_Columns\tOne
Time_Pref\tRelative
Operator\tN. N.
Date\t2026/11/26
Time\t10:20:30,1234567
***End_of_Header***\t

Channels\t1\t
Samples\t300\t
Date\t2026/11/26\t
Time\t10:20:30,1234567\t
Y_Unit_Label\tg\t
X_Dimension\tTime\t
X0\t0,0000000000000000E+0\t
Delta_X\t3,90625E-5\t
***End_of_Header***\t\t
X_Value\tAcc\tComment
"""


@pytest.mark.parametrize("times", [True, False])
def test_labviews_text(tmp_path: Path, times: bool) -> None:
    """With times, and without, where the step stands in the head."""
    lines = rows("\t", ",") if times else [f"\t{row}" for row in rows("\t", ",", t=False)]
    record = br.read(written(tmp_path / "a.lvm", LVM + "\r\n".join(lines) + "\r\n"))
    check(record)
    assert list(record) == ["Acc"]


def scope(*head: str, beside: bool = False, times: str = "{:.9e}") -> str:
    """A table as an oscilloscope writes it, perhaps with the head beside its first rows."""
    lines = [f"{times.format(t - 0.005)},{a:.6f}" for t, a in zip(T, A, strict=True)]
    if not beside:
        return table(lines, *head)
    filled = [*head, *[",,"] * (N - len(head))]
    return table([f"{key},{line}" for key, line in zip(filled, lines, strict=True)])


# Heads as oscilloscopes and analysers write them, and the unit of the signal.
SCOPES: dict[str, tuple[str, str]] = {
    "head beside the rows": (
        scope(
            "Record Length,3.0e+02,",
            "Sample Interval,3.90625e-05,",
            "Vertical Units,V,",
            "Source,CH1,",
            beside=True,
        ),
        "V",
    ),
    "names and units, numbered": (scope("x-axis,1", "second,Volt"), "V"),
    "head with an empty line": (
        scope(
            "Model,M", "Sample Interval,3.90625e-05", "Vertical Units,mV", "", "Label,", "TIME,CH1"
        ),
        "mV",
    ),
    "second and value": (scope("Record Length,Analog:300", "Second,Value"), ""),
    "brackets": (scope('"Time(s)","Acc(g)"'), "g"),
    "sep= of a spreadsheet": ("sep=;\n" + table(rows(";"), "t [s];a [g]"), "g"),
    "sections of a head": (
        table(rows(t=False), "[Header]", "SampleRate=25600", "Unit=g", "[Data]"),
        "g",
    ),
    "unit of the signal above": (
        table(rows(t=False), "Sampling rate: 25600 Hz", "Unit: m/s2", "Sensor 3"),
        "m/s^2",
    ),
    "times named by the device": (scope("Time  1 - default sample rate [s],Acc [g]"), "g"),
    "numbers of samples, rate above": (
        table(
            [f"{k};{row}" for k, row in enumerate(rows(t=False))], "fs = 25600 Hz", "Sample;Acc [g]"
        ),
        "g",
    ),
    "empty fields at ends": (
        table([row + ",," for row in rows()], "t [s],a [g],Start,Increment"),
        "g",
    ),
}


@pytest.mark.parametrize("case", SCOPES)
def test_heads_of_oscilloscopes_and_analysers(tmp_path: Path, case: str) -> None:
    text, unit = SCOPES[case]
    record = br.read(written(tmp_path / "scope.csv", text))
    check(record)
    assert record.channel().unit == unit


def test_numbers_above_a_column_are_no_samples(tmp_path: Path) -> None:
    path = written(tmp_path / "a.txt", table(rows(t=False), "300", "25600"))
    with pytest.raises(
        br.FileError, match=r"first numbers \(300, 25600\) are far .*; skip=2 leaves them out"
    ):
        br.read(path, FS)
    check(br.read(path, FS, skip=2))
    assert br.read(path, FS, skip=0).n_samples == N + 2


def test_a_spectrum_is_no_record(tmp_path: Path) -> None:
    lines = [f"{1.25 * k},{abs(a)}" for k, a in enumerate(A)]
    for title in ("Frequency [Hz],Amplitude [g]", "Frequency,Amplitude", "f [Hz],a"):
        with pytest.raises(br.FileError, match=r"is a spectrum over .*export the time signal"):
            br.read(written(tmp_path / "a.csv", table(lines, title)), FS)
