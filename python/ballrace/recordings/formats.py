"""The one table of formats: how a file is recognised, what reads and writes it, which library that needs."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ..errors import FileError, SceneError
from . import arrays, hierarchical, matlab, parquet, sound, tdms, text, universal, workbook
from .lines import other_ways
from .reading import Reading
from .samples import Samples


@dataclass(frozen=True, kw_only=True)
class Format:
    """A format of records.

    Attributes
    ----------
    name : str
        As the argument ``format`` has it.
    title : str
        What a file of it is called.
    suffixes : tuple of str
        What names of files end in, those that are written first.
    beginnings : tuple of bytes
        First bytes of a file of it; none where it has none of its own.
    read : function
        Reads it: its samples, as a reading asks for.
    write : function or None
        Writes samples to a temporary file in place of a path; None where it is only read.
    written : int
        How many of the suffixes are written.
    library : str
        The module that is needed, imported before memory is limited: libraries reserve address space that they
        never use.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    beginnings: tuple[bytes, ...] = ()
    read: Callable[[Path, Reading], Samples]
    write: Callable[[Samples, Path, Path], None] | None = None
    written: int = 0
    library: str = "numpy"


_HDF5 = b"\x89HDF\r\n\x1a\n"

FORMATS = {
    one.name: one
    for one in (
        Format(
            name="csv", title="a text table", suffixes=(".csv", ".txt", ".tsv", ".lvm", ".asc"), written=2,
            read=text.read, write=text.write, library="ballrace._base.polars",
        ),
        Format(
            name="wav", title="a WAV file", suffixes=(".wav",), written=1, beginnings=(b"RIFF", b"RIFX", b"RF64"),
            read=sound.read, write=sound.write, library="scipy.io.wavfile",
        ),
        Format(
            name="mat", title="a MATLAB file", suffixes=(".mat",), written=1,
            beginnings=(b"MATLAB 5.0", b"MATLAB 7.3", _HDF5), library="scipy.io", read=matlab.read,
            write=matlab.write,
        ),
        Format(
            name="uff", title="a Universal File", suffixes=(".uff", ".unv"), written=2, beginnings=(b"    -1",),
            read=universal.read, write=universal.write, library="pyuff",
        ),
        Format(
            name="hdf5", title="an HDF5 file", suffixes=(".h5", ".hdf5"), written=2, beginnings=(_HDF5,),
            read=hierarchical.read, write=hierarchical.write, library="h5py",
        ),
        Format(
            name="parquet", title="a Parquet file", suffixes=(".parquet", ".pq"), written=2, beginnings=(b"PAR1",),
            read=parquet.read, write=parquet.write, library="ballrace._base.polars",
        ),
        Format(
            name="tdms", title="a TDMS file", suffixes=(".tdms",), beginnings=(b"TDSm",), read=tdms.read,
            library="nptdms",
        ),
        Format(
            name="npy", title="an NPY file", suffixes=(".npy",), beginnings=(b"\x93NUMPY",), read=arrays.read_npy,
        ),
        Format(name="npz", title="an NPZ file", suffixes=(".npz",), read=arrays.read_npz),
        Format(
            name="xlsx", title="an Excel workbook", suffixes=(".xlsx", ".xlsm", ".xls"),
            beginnings=(b"PK\x03\x04", b"\xd0\xcf\x11\xe0"), read=workbook.read, library="fastexcel",
        ),
    )
}  # fmt: skip
"""Formats by their names."""

_BY_SUFFIX = {suffix: one.name for one in FORMATS.values() for suffix in one.suffixes}

_OTHERS = {
    b"\x1f\x8b": "compressed by gzip: unpack it first",
    b"BZh": "compressed by bzip2: unpack it first",
    b"\xfd7zXZ": "compressed by xz: unpack it first",
    b"7z\xbc\xaf": "a 7z archive: unpack it first",
    b"Rar!": "a RAR archive: unpack it first",
    b"MDF     ": "a file of measurements in ASAM's MDF: asammdf reads it",
    b"ARROW1": "an Arrow file: polars.read_ipc reads it",
    **dict.fromkeys((b"\x80\x03", b"\x80\x04", b"\x80\x05"), "a pickle, which runs code and is never read"),
    b"OggS": "a compressed sound: save it as WAV", b"fLaC": "a compressed sound: save it as WAV",
    b"ID3": "a compressed sound, which has lost what is measured",
}  # fmt: skip
"""First bytes of what is not read, with what to do."""

_UNIVERSAL = re.compile(rb" {4}-1 *\r?\n *\d+b?\b")


def by_name(path: Path) -> Format:
    """Return the format that is written to a file of this name.

    Raises
    ------
    SceneError
        There is none.
    """
    written = {suffix: one for one in FORMATS.values() for suffix in one.suffixes[: one.written]}
    found = written.get(path.suffix.lower())
    if found is None:
        raise SceneError("path", str(path), f"a name that ends in {', '.join(written)}")
    return found


def by_contents(path: Path, start: bytes) -> Format:
    """Return the format of a file by its name and first bytes; where they contradict each other, by the bytes.

    Raises
    ------
    FileError
        It is of a format that is known and not read.
    """
    named = FORMATS.get(_BY_SUFFIX.get(path.suffix.lower(), ""))
    if named is not None and named.beginnings and start.startswith(named.beginnings):
        return named
    if start.startswith(b"PK") and named is None:
        raise FileError(
            str(path), "a ZIP archive: unpack it first; format= reads a workbook or NPZ"
        )
    found = next((one for one in FORMATS.values() if _begins(start, one)), None)
    if found is not None and named is not FORMATS["npz"]:
        return found
    told = next((what for mark, what in _OTHERS.items() if start.startswith(mark)), None)
    if told is not None and not (start.isascii() and b"\0" not in start):
        raise FileError(str(path), f"{told}; {other_ways()}")
    return named or FORMATS["csv"]


def _begins(start: bytes, form: Format) -> bool:
    """Whether first bytes are of a format whatever the file is called; HDF5 is one of its own."""
    match form.name:
        case "uff":
            return _UNIVERSAL.match(start) is not None
        case "mat":
            return start.startswith(b"MATLAB") and start.startswith(form.beginnings)
    return bool(form.beginnings) and start.startswith(form.beginnings)
