"""Files of measured records."""

from __future__ import annotations

import math
import warnings
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from .._base.numbers import real
from .._base.progress import Bar
from .._base.text import printable
from .._io.files import as_path
from ..errors import FileWarning, SceneError
from .apart import read_apart
from .formats import FORMATS
from .here import format_of, read_here
from .reading import checked
from .recording import Recording

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from .reading import Chosen, Key
    from .samples import Samples


def read(
    path: str | os.PathLike[str],
    fs: float | None = None,
    format: str | None = None,  # noqa: A002
    *,
    skip: int | None = None,
    columns: Chosen = None,
    decimal: str | None = None,
    time: Key | Iterable[Key] | bool | None = None,
    time_unit: str | None = None,
    start: float | None = None,
    stop: float | None = None,
    progress: bool | Callable[[float], object] = False,
    time_limit: float = 60.0,
    memory_limit: float = 4e9,
    trusted: bool = False,
) -> Recording:
    r"""Read a measured record, or one that ``write`` wrote.

    :mod:`ballrace.recordings` lists the formats. In a text, of whatever logger, the table is found by itself, with
    its separators, decimal marks, names and units; columns that are times, or count, are recognised by their steps
    and are no signals. Names of data sets are known: of the Case Western Reserve
    University (columns ``DE``, ``FE``, ``BA``), Paderborn University (``vibration_1``, …; slower ones in
    ``others``), the MFPT society (``acceleration``) and LMS. What cannot be known is asked for: the message names
    the argument.

    A child process reads the file, so that a damaged or malicious one can neither crash this process nor fill the
    memory. It takes some 0.3 s to start, reads all later files, too, and ends with this process.

    Parameters
    ----------
    path : path
        The file.
    fs : float, optional
        Sampling rate [Hz]; needed where the file does not have it. Files of the Case Western Reserve University
        never do: it is 12 or 48 kHz, as on the page of the record. Where times are too coarse for the rate, this
        one counts, with a :class:`ballrace.FileWarning`; one that they contradict by more than 1 % is refused.
    format : str, optional
        One of csv (any text), wav, mat, uff, hdf5, parquet, tdms, npy, npz, xlsx; by default what the file begins
        as, or else what its name ends in.
    skip : int, optional
        Lines of a text before the names, or before the first row.
    columns : name, place, iterable of these, or mapping from them to new names, optional
        Which columns are signals: ``["ax", "ay"]``, ``-1``, ``{4: "horizontal", 5: "vertical"}``. Places count
        from 0, and those of times, too. By default all that are neither times nor counters.
    decimal : {".", ","}, optional
        Decimal mark of a text, where commas could also separate columns.
    time : name, place, iterable of these, or False, optional
        The column of times, or those of a clock from the longest unit to the shortest; False for none, so that
        samples are taken to be at equal steps.
    time_unit : {"s", "ms", "us", "ns", "min", "h", "d", "samples"}, optional
        Unit of the times, where the file does not say it; it overrides the file.
    start, stop : float, optional
        Times from the first sample between which the record is read [s]; by default all of it. Of text no more is
        held in memory.
    progress : bool or callable
        True shows a bar on a terminal or in a notebook while a text is read; a callable is called with the share
        done, 0 to 1; an exception that it raises ends reading.
    time_limit : float
        How long reading may take [s]; ``math.inf`` for any time. Raise it for texts beyond a gigabyte.
    memory_limit : float
        Memory that reading may take in addition to the libraries [bytes]; ``math.inf`` for any. Twice the
        samples, 8 bytes each, are enough for text, ten times for any format. Linux enforces it. On macOS the child
        checks its memory every 10 ms, and ends beyond it. On Windows only the declared size of a file is compared
        with it (HDF5, Parquet, TDMS, NPY, NPZ).
    trusted : bool
        Whether to read in this process, without limits, which a damaged file may crash.

    Returns
    -------
    Recording
        Columns with sampling rate, units and shaft rate as far as the file has them.

    Raises
    ------
    SceneError
        An argument is not usable, or is needed and missing, or ``fs`` differs from the file's rate.
    FileError
        The file is damaged, has no record, can be read in two ways, or takes more than the limits to read; the
        message says which, and what to do.
    InternalError
        The reader has a fault.
    ImportError
        The library for this format is not installed (extra ``io``).
    OSError
        The file cannot be read.

    Examples
    --------
    >>> import ballrace as br, pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "sensor.csv"
    ...     _ = path.write_text("t [s];ay [g]\n0;0.1\n0.001;0.3\n0.002;-0.2\n")
    ...     record = br.read(path)
    >>> record.fs, record.units["ay"], record["ay"].tolist()
    (1000.0, 'g', [0.1, 0.3, -0.2])
    """
    path = as_path(path)
    if format is not None and not (isinstance(format, str) and format in FORMATS):
        raise SceneError("format", repr(format), f"one of {', '.join(FORMATS)}")
    reading = checked(
        fs=fs, skip=skip, columns=columns, decimal=decimal, time=time, time_unit=time_unit, start=start, stop=stop
    )  # fmt: skip
    limits = {"time_limit": real(time_limit), "memory_limit": real(memory_limit)}
    for name, given in (("time_limit", time_limit), ("memory_limit", memory_limit)):
        if not limits[name] > 0.0:
            raise SceneError(name, repr(given), "above 0, or math.inf")
    if not isinstance(trusted, bool):
        raise SceneError("trusted", repr(trusted), "True or False")

    def samples(tell: Callable[[float], object]) -> Samples:
        asked = replace(reading, tell=tell)
        if trusted:
            return read_here(path, format_of(path, format), asked)
        return read_apart(path, format, asked, **limits)

    if progress is True:
        with Bar(path.name) as bar:
            found = samples(bar.show)
    else:
        try:
            found = samples(partial(_told, progress) if progress else reading.tell)
        except _Stopped as stopped:
            raise stopped.__cause__ or stopped from None
    for note in found.notes:
        warnings.warn(printable(f"{path}: {note}"), FileWarning, stacklevel=2)
    return _recording(path, found)


class _Stopped(BaseException):
    """A function of the caller's, which is told about progress, has raised an exception."""


def _told(progress: Callable[[float], object], share: float) -> None:
    try:
        progress(share)
    except Exception as error:
        raise _Stopped from error


def _recording(path: Path, samples: Samples) -> Recording:
    if samples.fs is None:
        raise SceneError("fs", "None", f"the sampling rate [Hz], which {path.name} does not have")
    others = [
        replace(other, fs=math.nan) if other.fs is None else other for other in samples.others
    ]
    return Recording(
        columns=samples.columns,
        fs=samples.fs,
        units=samples.units,
        shaft=samples.shaft,
        source=str(path),
        metadata=samples.metadata,
        others=tuple(_recording(path, other) for other in others),
    )
