"""Formats by name: Universal Files, TDMS, workbooks, units, what is not read, and the one table of all."""

from __future__ import annotations

import datetime as dt
import gzip
import importlib.util
import re
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import ballrace as br
from ballrace.recordings import apart, formats, preamble

FS = 25_600.0
N = 300
_rng = np.random.default_rng(69)
A, B = _rng.normal(size=(2, N))


def universal(path: Path, *sets: dict[str, Any]) -> Path:
    """Write functions of data set 58, as text, whose axis is labelled as each one says."""
    lines: list[str] = []
    for number, one in enumerate(sets, start=1):
        x = one.get("x", A)
        values = x.view(np.float64) if np.iscomplexobj(x) else x
        kind = 5 if np.iscomplexobj(x) else 2
        lines += ["    -1", "    58", one.get("name", "DE"), *["NONE"] * 4]
        lines.append(
            f"{one.get('function', 1):5d}{0:10d}{0:5d}{0:10d} {'NONE':10s}{number:10d}{3:4d}"
            f" {'NONE':10s}{0:10d}{0:4d}"
        )
        lines.append(
            f"{kind:10d}{x.size:10d}{1:10d}{0.0:13.5e}{one.get('step', 1.0 / FS):13.5e}{0.0:13.5e}"
        )
        for axis, label, unit in (
            (one.get("axis", 17), "Time", one.get("unit", "s")),
            (12, "NONE", one.get("of", "g")),
            (0, "NONE", "NONE"),
            (0, "NONE", "NONE"),
        ):
            lines.append(f"{axis:10d}{0:5d}{0:5d}{0:5d} {label:20s} {unit:20s}")
        for start in range(0, values.size, 6):
            lines.append("".join(f"{v:13.5e}" for v in values[start : start + 6]))
        lines.append("    -1")
    path.write_text("\n".join(lines) + "\n", encoding="ascii", newline=one.get("newline"))
    return path


AXES: dict[str, tuple[dict[str, Any], float]] = {
    "seconds": ({}, FS),
    "milliseconds": ({"unit": "ms", "step": 1e3 / FS}, FS),
    "msec": ({"unit": "msec", "step": 1e3 / FS}, FS),
    "microseconds": ({"unit": "us", "step": 1e6 / FS}, FS),
    "minutes": ({"unit": "min", "step": 1.0 / FS / 60.0}, FS),
    "sec": ({"unit": "sec"}, FS),
    "no label": ({"unit": "NONE"}, FS),
    "empty label": ({"unit": ""}, FS),
    "a general function over time": ({"function": 0}, FS),
    "a general function labelled ms": (
        {"function": 0, "axis": 0, "unit": "ms", "step": 1e3 / FS},
        FS,
    ),
    "a rate of seven digits": ({"step": 1.0 / 97_656.25}, 97_656.25),
    "carriage returns": ({"newline": "\r\n"}, FS),
}


@pytest.mark.parametrize("case", AXES)
def test_the_axis_of_a_universal_file_has_a_unit(tmp_path: Path, case: str) -> None:
    pytest.importorskip("pyuff")
    options, rate = AXES[case]
    record = br.read(universal(tmp_path / "a.uff", options))
    assert (list(record), record.units["DE"], record.fs) == (["DE"], "g", rate)
    np.testing.assert_allclose(record["DE"], A, rtol=1e-5)


FUNCTIONS: dict[str, tuple[dict[str, Any], str]] = {
    "frequency response": (
        {"function": 4, "axis": 18, "unit": "Hz"},
        "frequency response function",
    ),
    "spectrum": ({"function": 2, "axis": 18, "unit": "Hz"}, "auto spectrum"),
    "density": ({"function": 9, "axis": 18, "unit": "Hz"}, "power spectral density"),
    "general, over frequency": ({"function": 0, "axis": 18, "unit": "Hz"}, "general"),
    "complex": ({"x": A + 1j * B}, "time response"),
    "correlation": ({"function": 7}, "auto correlation"),
}


@pytest.mark.parametrize("case", FUNCTIONS)
def test_what_is_no_time_signal_is_named(tmp_path: Path, case: str) -> None:
    pytest.importorskip("pyuff")
    options, name = FUNCTIONS[case]
    path = universal(tmp_path / "a.uff", options)
    with pytest.raises(br.FileError, match=rf"no time response.*type {name}; export"):
        br.read(path)


def test_several_sets_of_a_universal_file(tmp_path: Path) -> None:
    pytest.importorskip("pyuff")
    path = universal(
        tmp_path / "a.uff",
        {},
        {"name": "FE", "x": B},
        {"name": "T", "x": B[:40], "step": 0.1},
        {"function": 4, "axis": 18},
        {"name": "S", "x": A[:40], "step": 0.1},
        {"name": "DE", "x": B, "unit": "ms", "step": 1e3 / FS},
    )
    record = br.read(path)
    assert (list(record), record.fs) == (["DE", "FE", "DE_6"], FS)
    assert [(list(one), one.fs) for one in record.others] == [(["T", "S"], 10.0)]


def test_an_axis_in_another_unit_is_asked_for(tmp_path: Path) -> None:
    pytest.importorskip("pyuff")
    path = universal(tmp_path / "a.uff", {"unit": "rev"})
    with pytest.raises(br.SceneError, match=r"time_unit = None: .*'rev'; or fs="):
        br.read(path)
    assert br.read(path, fs=FS).fs == FS
    assert br.read(path, time_unit="ms").fs == 1e3 * FS


@pytest.mark.parametrize("waveform", [True, False])
def test_tdms(tmp_path: Path, waveform: bool) -> None:
    nptdms = pytest.importorskip("nptdms")
    properties = (
        {"wf_increment": 1.0 / FS, "unit_string": "m/s2"} if waveform else {"unit_string": "m/s2"}
    )
    channels = [
        nptdms.ChannelObject("run", "acc", A, properties),
        nptdms.ChannelObject("run", "acc2", B, properties),
    ]
    if not waveform:
        channels.insert(0, nptdms.ChannelObject("run", "Time", np.arange(N) / FS))
    slow = nptdms.ChannelObject("run", "load", B[:30], {"wf_increment": 0.01})
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        writer.write_segment([nptdms.RootObject({"operator": "N. N."}), *channels, slow])
    record = br.read(tmp_path / "a.tdms")
    assert (list(record), record.fs, record.units["acc"]) == (["acc", "acc2"], FS, "m/s^2")
    np.testing.assert_array_equal(record["acc2"], B)
    assert [(list(one), one.fs) for one in record.others] == [(["load"], 100.0)]
    assert record.metadata["operator"] == "N. N."
    (tmp_path / "a.tdms").rename(tmp_path / "b.dat")
    assert br.read(tmp_path / "b.dat").fs == FS


def test_tdms_of_several_groups(tmp_path: Path) -> None:
    nptdms = pytest.importorskip("nptdms")
    properties = {"wf_increment": 1.0 / FS}
    with nptdms.TdmsWriter(tmp_path / "a.tdms") as writer:
        writer.write_segment(
            [nptdms.ChannelObject(group, "acc", A, properties) for group in ("one", "two")]
        )
    assert list(br.read(tmp_path / "a.tdms")) == ["one/acc", "two/acc"]


def workbook(path: Path, *above: list[Any], dated: bool = False, sheets: int = 1) -> Path:
    xlsxwriter = pytest.importorskip("xlsxwriter")
    book = xlsxwriter.Workbook(path, {"default_date_format": "yyyy-mm-dd hh:mm:ss.000"})
    for number in range(sheets):
        sheet = book.add_worksheet()
        if number < sheets - 1:
            sheet.write_row(0, 0, ["about", "this file"])
            continue
        for place, row in enumerate(above):
            sheet.write_row(place, 0, row)
        for k in range(N):
            at = len(above) + k
            if dated:
                sheet.write_datetime(
                    at, 0, dt.datetime(2026, 11, 26) + dt.timedelta(milliseconds=k)
                )
            else:
                sheet.write_number(at, 0, k / FS)
            sheet.write_row(at, 1, [A[k], B[k]])
    book.close()
    return path


@pytest.mark.parametrize(
    "case", ["names", "preamble", "units", "dates", "second sheet", "no names"]
)
def test_workbooks(tmp_path: Path, case: str) -> None:
    pytest.importorskip("fastexcel")
    rows: dict[str, list[list[Any]]] = {
        "names": [["Time [s]", "a [g]", "b [g]"]],
        "preamble": [
            ["Model", "X-100"],
            [],
            ["Sample Rate", 25_600],
            ["Time [s]", "a [g]", "b [g]"],
        ],
        "units": [["Time", "a", "b"], ["s", "g", "g"]],
        "dates": [["When", "a [g]", "b [g]"]],
        "second sheet": [["Time [s]", "a [g]", "b [g]"]],
        "no names": [],
    }
    path = workbook(
        tmp_path / "a.xlsx",
        *rows[case],
        dated=case == "dates",
        sheets=2 if case == "second sheet" else 1,
    )
    record = br.read(path)
    assert record.fs == (1000.0 if case == "dates" else FS)
    assert len(record) == 2
    # The sixteen digits of a workbook, and not the nine that a sheet shows.
    np.testing.assert_allclose(record.channel().x, A, rtol=1e-15)
    if case != "no names":
        assert dict(record.units) == {"a": "g", "b": "g"}


# Spellings of units, with the value of 1 in m/s², or in mm/s of velocities.
UNITS: list[tuple[str, str, float]] = [
    *(
        (unit, "m/s^2", 1.0)
        for unit in (
            "m/s2",
            "m/s^2",
            "m/s²",
            "m/s/s",
            "m.s-2",
            "m·s⁻²",
            "m s-2",
            "m/sec^2",
            "ms-2",
            "M/S2",
            "m/s**2",
        )
    ),
    *((unit, "m/s^2", 9.80665) for unit in ("g", "G", "gn", "g's")),
    ("mg", "m/s^2", 9.80665e-3),
    ("mm/s^2", "m/s^2", 1e-3),
    ("mm/s2", "m/s^2", 1e-3),
    ("in/s^2", "m/s^2", 0.0254),
    ("ft/s2", "m/s^2", 0.3048),
    ("cm/s²", "m/s^2", 1e-2),
    *((unit, "mm/s", 1.0) for unit in ("mm/s", "mm/sec", "mm s-1")),
    *((unit, "mm/s", 25.4) for unit in ("in/s", "ips", "inch/s")),
    ("m/s", "mm/s", 1e3),
    ("µm/s", "mm/s", 1e-3),
    ("um/s", "mm/s", 1e-3),
]


@pytest.mark.parametrize(("unit", "wanted", "value"), UNITS)
def test_units_however_they_are_spelled(
    tmp_path: Path, unit: str, wanted: str, value: float
) -> None:
    path = tmp_path / "a.csv"
    path.write_text(
        f"t [s],a [{unit}]\n" + "".join(f"{k / 1000},1\n" for k in range(20)), encoding="utf-8"
    )
    channel = br.read(path).channel()
    np.testing.assert_allclose(channel.to(wanted).x, value, rtol=1e-12)
    made = br.Recording(np.ones(20), fs=1000.0, unit=unit)
    assert made.units["x"] == channel.unit


@pytest.mark.parametrize(
    ("unit", "message"),
    [
        ("V", r'sensitivity; for 100 mV/g it is br\.Recording\(x / 0\.1, fs=fs, unit="g"\)'),
        ("mV", "x / 100,"),
        ("Volt", "sensitivity"),
        ("mV/g", "the sensitivity of a sensor"),
        ("µm", "a displacement"),
        ("mil", "a displacement"),
        ("gE", "its envelope"),
        ("furlong", "one of m/s"),
        ("", "give its unit"),
    ],
)
def test_units_of_something_else_are_refused_by_what_they_mean(unit: str, message: str) -> None:
    channel = br.Recording(np.ones(20), fs=1000.0, unit=unit).channel()
    with pytest.raises(br.SceneError, match=message):
        channel.to("m/s^2")


@pytest.mark.parametrize("title", ["a [gE]", "gE", "Envelope (gE)"])
def test_an_envelope_is_no_record_of_vibration(tmp_path: Path, title: str) -> None:
    path = tmp_path / "a.csv"
    path.write_text(f"{title};b [g]\n" + "1.5;2.5\n" * 20)
    with pytest.raises(
        br.FileError, match=r"is in gE, .*; export the acceleration, or take other columns"
    ):
        br.read(path, 1000.0)
    assert list(br.read(path, 1000.0, columns="b")) == ["b"]


def test_a_column_in_volts_keeps_its_unit(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("Time,Volt\n" + "".join(f"{k / 1000},1\n" for k in range(20)))
    assert dict(br.read(path).units) == {"Volt": "V"}


def test_an_array_is_a_record() -> None:
    """What messages tell to type."""
    record = br.Recording(A, fs=FS, unit="m/s2")
    assert (list(record), record.fs, record.units["x"]) == (["x"], FS, "m/s^2")
    assert list(br.Recording(np.stack([A, B], axis=1), fs=FS, unit="g")) == ["x_1", "x_2"]
    assert br.Recording(columns={"y": A}, fs=FS, unit="g").units["y"] == "g"
    for bad in (3.0, "text", [[1.0]], np.zeros((2, 2, 2))):
        with pytest.raises(br.SceneError, match="columns"):
            br.Recording(bad, fs=FS)


def archive(path: Path) -> None:
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("a.csv", "1\n2\n")


# What is not read: the message names it, and the way.
OTHERS: dict[str, tuple[Any, str]] = {
    "a.gz": (
        lambda p: p.write_bytes(gzip.compress(b"1\n2\n" * 100)),
        "compressed by gzip: unpack it first",
    ),
    "a.zip": (archive, "a ZIP archive: unpack it first"),
    "a.mf4": (lambda p: p.write_bytes(b"MDF     4.10    " + bytes(200)), "asammdf reads it"),
    "a.pkl": (
        lambda p: p.write_bytes(b"\x80\x04\x95" + bytes(20)),
        "a pickle, which runs code and is never read",
    ),
    "a.flac": (lambda p: p.write_bytes(b"fLaC" + bytes(200)), "save it as WAV"),
    "a.feather": (lambda p: p.write_bytes(b"ARROW1" + bytes(200)), r"polars\.read_ipc reads it"),
    "a.7z": (lambda p: p.write_bytes(b"7z\xbc\xaf\x27\x1c" + bytes(200)), "a 7z archive"),
    "a.bin": (
        lambda p: p.write_bytes(np.zeros(200).tobytes()),
        "neither text nor a record of a known format",
    ),
    "b.dat": (
        lambda p: p.write_bytes(bytes(range(256))),
        "neither text nor a record of a known format",
    ),
    "a.tdms": (
        lambda p: p.write_bytes(b"TDSm\x0e\0\0\0i\x12" + bytes(200)),
        "not a TDMS file, or damaged, as nptdms reads it",
    ),
    "a.npy": (
        lambda p: p.write_bytes(b"\x93NUMPY\x01\0" + bytes(30)),
        r"not an NPY file, or damaged .*np\.load",
    ),
    "a.npz": (
        lambda p: p.write_bytes(b"PK\x03\x04" + bytes(30)),
        r"not an NPZ file, or damaged .*np\.load",
    ),
    "a.xlsx": (
        lambda p: p.write_bytes(b"PK\x03\x04" + bytes(30)),
        "not an Excel workbook, or damaged",
    ),
}


@pytest.mark.parametrize("name", OTHERS)
def test_what_is_not_read_is_named_with_the_way(tmp_path: Path, name: str) -> None:
    write, message = OTHERS[name]
    write(tmp_path / name)
    with pytest.raises((br.FileError, ImportError), match=message) as caught:
        br.read(tmp_path / name, FS)
    if "compressed" in message or "neither" in message or "asammdf" in message:
        assert 'br.Recording(array, fs=fs, unit="g")' in str(caught.value)


@pytest.mark.parametrize(
    ("end", "library"),
    [("tdms", "nptdms"), ("xlsx", "fastexcel"), ("uff", "pyuff"), ("h5", "h5py")],
)
def test_a_library_that_is_missing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, end: str, library: str
) -> None:
    monkeypatch.setitem(sys.modules, library, None)
    path = tmp_path / f"a.{end}"
    path.write_bytes(b"any")
    with pytest.raises(ImportError, match=rf'needs {library} .*: pip install "ballrace\[io\]"'):
        br.read(path, trusted=True)


def test_the_bytes_of_a_file_win_over_its_name(tmp_path: Path) -> None:
    record = br.Recording(A, fs=FS, unit="g")
    record.write(tmp_path / "a.parquet")
    (tmp_path / "a.parquet").rename(tmp_path / "a.csv")
    assert br.read(tmp_path / "a.csv").fs == FS
    # Text may begin as a binary file does.
    (tmp_path / "b.txt").write_text(
        "MATLAB export\nt [s];a [g]\n" + "".join(f"{k / 1000};1\n" for k in range(20))
    )
    assert br.read(tmp_path / "b.txt").fs == 1000.0


def test_the_table_of_formats_is_complete() -> None:
    """One table: names, ends of files and first bytes are of one format each, and texts list all."""
    suffixes = [suffix for one in formats.FORMATS.values() for suffix in one.suffixes]
    assert len(set(suffixes)) == len(suffixes)
    guide = (Path(__file__).parents[2] / "docs" / "files.md").read_text(encoding="utf-8")
    for text in (guide, br.recordings.__doc__ or ""):
        assert set(re.findall(r"`(\.\w+)`", text)) == set(suffixes)
    written = {end for one in formats.FORMATS.values() for end in one.suffixes[: one.written]}
    ends = re.search(r"File that ends in (.*) or (.*)\.\n", br.Recording.write.__doc__ or "")
    assert ends is not None
    assert {*ends[1].split(", "), ends[2]} == written
    names = re.search(r"One of (.*?);", br.read.__doc__ or "")
    assert names is not None
    assert {name.split(" ")[0] for name in names[1].split(", ")} == set(formats.FORMATS)
    for name, one in formats.FORMATS.items():
        assert name == one.name
        assert (one.write is None) == (one.written == 0)
        assert importlib.util.find_spec(
            one.library.partition(".")[0]
        ) is not None or one.library in ("pyuff", "h5py", "nptdms", "fastexcel")


FAULTS = {
    "ours": (
        "None",
        br.InternalError,
        r"a fault of ballrace as it read .*report it\n(.|\n)*Traceback(.|\n)*text\.py",
    ),
    "a library's": (
        "lambda lines: json.loads('x')",
        br.FileError,
        r"damaged, or no file of the format csv",
    ),
}


@pytest.mark.parametrize("trusted", [False, True])
@pytest.mark.parametrize("case", FAULTS)
def test_a_fault_of_ours_is_told_as_ours(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, case: str, trusted: bool
) -> None:
    """Not as damage of the file, and with the traceback of the process that read it."""
    fault, kind, message = FAULTS[case]
    program = (
        f"import json\nfrom ballrace.recordings import apart, text\ntext.described = {fault}\n"
    )
    path = tmp_path / "a.csv"
    path.write_text("1.5\n2.5\n")
    monkeypatch.setattr("ballrace.recordings.text.described", preamble.described)
    apart.end_child()
    monkeypatch.setattr(apart, "_PROGRAM", apart._PROGRAM.replace("from", f"\n{program}from", 1))
    if trusted:
        exec(program)
    with pytest.raises(kind, match=message):
        br.read(path, FS, trusted=trusted)
    apart.end_child()
