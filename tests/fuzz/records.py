"""Seeds of every format of records, as this package and as others write them, by the end of their names."""

from __future__ import annotations

import io
import struct
import tempfile
import warnings
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any

import h5py
import nptdms
import numpy as np
import polars as pl
import pyuff
import xlsxwriter
from scipy.io import savemat, wavfile

import ballrace as br
from ballrace.recordings.formats import FORMATS

X = np.round(np.sin(np.arange(40.0)), 3)
T = np.arange(40) / 1000.0


@cache
def seeds(end: str) -> tuple[bytes, ...]:
    """Return the contents of small files whose names end so."""
    made = {
        "csv": _csv,
        "wav": _wav,
        "mat": _mat,
        "uff": _uff,
        "h5": _hdf5,
        "parquet": _parquet,
        "lvm": _lvm,
        "npy": _npy,
        "npz": _npz,
        "tdms": _tdms,
        "xlsx": _xlsx,
    }
    ours = br.Recording(columns={"ay": X, "ax": 2.0 * X}, fs=1000.0, units={"ay": "g"}, shaft=25.0)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"a.{end}"
        if end in READ:
            return tuple(made[end](path))
        ours.write(path)
        return path.read_bytes(), *made[end](path)


_FIRST = {one.suffixes[0][1:]: one for one in FORMATS.values()}

READ = ("lvm", *(end for end, one in _FIRST.items() if not one.written))
"""Ends of names of files that are only read, of LabVIEW's texts, too."""

ENDS = (*(end for end, one in _FIRST.items() if one.written), *READ)


def _csv(_: Path) -> list[bytes]:
    rows = [f"{t};{x}".replace(".", ",") for t, x in zip(T, X, strict=True)]
    spaced = [f"{t}  {x}" for t, x in zip(T, X, strict=True)]
    return [
        "\r\n".join(["# remark", "Zeit (ms);a [m/s²]", *rows]).encode("cp1252"),
        "\n".join(spaced).encode(),
    ]


def _wav(_: Path) -> list[bytes]:
    found = []
    for kind, scale in (("i2", 2**14), ("i4", 2**30), ("f8", 1.0)):
        buffer = io.BytesIO()
        wavfile.write(buffer, 1000, (X * scale).astype(kind))
        found.append(buffer.getvalue())
    form = struct.pack("<IHHIIHH", 16, 1, 1, 8000, 24_000, 3, 24)
    sizes = b"ds64" + struct.pack("<IQQQI", 28, 102, 30, 10, 0)
    start = b"RF64\xff\xff\xff\xffWAVE" + sizes + b"fmt " + form
    return [*found, start + b"data\xff\xff\xff\xff" + bytes(range(30))]


def _mat(path: Path) -> list[bytes]:
    rasters = [{"Name": "Time", "Type": "double", "Data": T, "Raster": "r"}]
    signals = [{"Name": "vibration_1", "Type": "double", "Data": X, "Raster": "r"}]
    paderborn = {"N15": {"X": np.array(rasters), "Y": np.array(signals)}}
    contents: list[tuple[dict[str, Any], dict[str, Any]]] = [
        ({"X105_DE_time": X[:, None], "X105_FE_time": X[:, None], "X105RPM": [[1797]]}, {}),
        ({"bearing": {"sr": 1000, "gs": X, "load": 270, "rate": 25}}, {"do_compression": True}),
        (paderborn, {"do_compression": True}),
        (paderborn, {}),
        ({"ax": X, "fs": 1000.0}, {"format": "4"}),
    ]
    found = []
    for content, options in contents:
        buffer = io.BytesIO()
        savemat(buffer, content, **options)
        found.append(buffer.getvalue())
    with h5py.File(path, "w", userblock_size=512) as file:
        file["X105_DE_time"] = X[None, :]
    return [*found, b"MATLAB 7.3 MAT-file".ljust(512, b"\0") + path.read_bytes()[512:]]


def _uff(path: Path) -> list[bytes]:
    found = []
    for binary in (0, 1):
        path.unlink()
        data = {"x": T, "data": X, "num_pts": X.size, "abscissa_inc": 1e-3, "abscissa_spacing": 1}
        labels = {"id1": "ay", "id5": "NONE", "ordinate_axis_units_lab": "g", "binary": binary}
        axes = {"type": 58, "func_type": 1, "rsp_node": 1, "rsp_dir": 1, "ref_node": 1, "ref_dir": 1,
                "abscissa_spec_data_type": 17, "ordinate_spec_data_type": 12,
                "orddenom_spec_data_type": 0, "z_axis_spec_data_type": 0}  # fmt: skip
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ResourceWarning)  # it leaves closing to Python
            pyuff.UFF(str(path)).write_sets([axes | data | labels], mode="add")
        found.append(path.read_bytes())
    return found


def _hdf5(path: Path) -> list[bytes]:
    found = []
    options: tuple[dict[str, Any], ...] = (
        {},
        {"chunks": (10,), "compression": "gzip", "shuffle": True, "fletcher32": True},
        {"chunks": (10,), "compression": "lzf", "maxshape": (None,)},
    )
    for libver in ("earliest", "latest"):
        for option in options:
            with h5py.File(path, "w", libver=libver) as file:
                file.attrs["fs"] = 1000.0
                file.create_dataset("group/ay", data=X, **option).attrs["units"] = "g"
            found.append(path.read_bytes())
    return found


def _parquet(path: Path) -> list[bytes]:
    table = pl.DataFrame({"t": T, "x": X, "n": range(40), "s": ["1.5"] * 40})
    found = []
    for compression in ("uncompressed", "snappy", "zstd", "gzip", "lz4"):
        table.write_parquet(path, compression=compression, row_group_size=16)
        found.append(path.read_bytes())
    scene = br.presets.deep_groove_6205()
    br.simulate(scene, duration=4e-4, start="rolling", settle=0.0).write_parquet(path)
    return [*found, path.read_bytes()]


def _lvm(_: Path) -> list[bytes]:
    head = [
        "LabVIEW Measurement\t", "Separator\tTab", "Decimal_Separator\t,", "***End_of_Header***\t", "",
        "Channels\t1", "Y_Unit_Label\tg", "Delta_X\t1,0E-3", "***End_of_Header***\t\t", "X_Value\tAcc\tComment",
    ]  # fmt: skip
    rows = [f"{t:.6f}\t{x:.6f}".replace(".", ",") for t, x in zip(T, X, strict=True)]
    clock = [f"10:20:{30.0 + t:09.6f}|{x}|ok" for t, x in zip(T, X, strict=True)]
    return [
        "\r\n".join([*head, *rows]).encode(),
        "\n".join(["Time|a|state", *clock, "", "End"]).encode("utf-16"),
        "\n".join(["# remark", *(f'"{x}"'.replace(".", ",") for x in X)]).encode(),
    ]


def _saved(save: Callable[[io.BytesIO], object]) -> bytes:
    buffer = io.BytesIO()
    save(buffer)
    return buffer.getvalue()


def _npy(_: Path) -> list[bytes]:
    table = np.zeros(40, dtype=[("t", "f8"), ("x", "f4")])
    table["t"], table["x"] = T, X
    arrays = (X, np.stack([X, T]), X.astype("<i2"), table)
    return [_saved(partial(np.save, arr=array)) for array in arrays]


def _npz(_: Path) -> list[bytes]:
    content: dict[str, Any] = {"acc": X, "fs": 1000.0, "unit": "g", "tach": T[:9]}
    return [_saved(partial(save, **content)) for save in (np.savez, np.savez_compressed)]


def _tdms(path: Path) -> list[bytes]:
    found = []
    for properties in ({"wf_increment": 1e-3, "unit_string": "g"}, {}):
        channels = [
            nptdms.ChannelObject("run", "acc", X, properties),
            nptdms.ChannelObject("run", "t", T),
        ]
        with nptdms.TdmsWriter(path) as writer:
            writer.write_segment([nptdms.RootObject({"operator": "N. N."}), *channels])
            if properties:
                writer.write_segment(channels)
        found.append(path.read_bytes())
    return found


def _xlsx(path: Path) -> list[bytes]:
    book = xlsxwriter.Workbook(path)
    sheet = book.add_worksheet()
    sheet.write_row(0, 0, ["Time [s]", "a [g]"])
    for number, row in enumerate(zip(T.tolist(), X.tolist(), strict=True)):
        sheet.write_row(number + 1, 0, row)
    book.close()
    return [path.read_bytes()]
