"""Files of measured records."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from .._io.files import as_path
from .._numbers import RATES, real, sampling_rate
from ..errors import FileError, SceneError
from .apart import read_apart
from .formats import by_contents
from .here import READERS, read_here
from .recording import Recording

if TYPE_CHECKING:
    import os
    from pathlib import Path

    from .samples import Samples

__all__ = ["read"]


def read(
    path: str | os.PathLike[str],
    fs: float | None = None,
    format: str | None = None,  # noqa: A002
    *,
    time_limit: float = 60.0,
    memory_limit: float = 4e9,
    trusted: bool = False,
) -> Recording:
    r"""Read a measured record, or one that ``write`` wrote.

    Read are ``.mat`` files of the Case Western Reserve University (columns ``DE``, ``FE``, ``BA``), of Paderborn
    University (``vibration_1``, …; slower ones in ``others``), of the MFPT society (``acceleration``) and plain
    ones with vectors; CSV with or without header, times and units (``ay [m/s^2]``), with commas, semicolons,
    tabs or spaces; WAV (whole numbers as shares of the full scale); Universal Files with data sets 58; HDF5; and
    Parquet, also that of runs.

    A child process reads the file, so that a damaged or malicious one can neither crash this process nor fill the
    memory. It takes 0.3 s to start, reads all later files, too, and ends with this process.

    Parameters
    ----------
    path : path
        The file.
    fs : float, optional
        Sampling rate [Hz]; needed where the file does not have it. Files of the Case Western Reserve University
        never do: it is 12 or 48 kHz, as on the page of the record.
    format : {"csv", "wav", "mat", "uff", "hdf5", "parquet"}, optional
        By default what the name ends in, or else how the file begins.
    time_limit : float
        How long reading may take [s]; ``math.inf`` for any time.
    memory_limit : float
        Memory that reading may take in addition to the libraries [bytes]; ``math.inf`` for any. Ten times the
        samples, 8 bytes each, are enough. Linux enforces it. On macOS the child checks its memory every 10 ms, and
        ends beyond it. On Windows only the declared size of a file is compared with it (HDF5, Parquet).
    trusted : bool
        Whether to read in this process, without limits, which a damaged file may crash.

    Returns
    -------
    Recording
        Columns with sampling rate, units and shaft rate as far as the file has them.

    Raises
    ------
    SceneError
        An argument is not usable, or ``fs`` is missing, or differs from the file's rate.
    FileError
        The file is damaged, has no record, or takes more than the limits to read; the message says which.
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
    fs = None if fs is None else sampling_rate(fs)
    if format is not None and not (isinstance(format, str) and format in READERS):
        raise SceneError("format", repr(format), f"one of {', '.join(READERS)}")
    limits = {"time_limit": real(time_limit), "memory_limit": real(memory_limit)}
    for name, given in (("time_limit", time_limit), ("memory_limit", memory_limit)):
        if not limits[name] > 0.0:
            raise SceneError(name, repr(given), "above 0, or math.inf")
    if not isinstance(trusted, bool):
        raise SceneError("trusted", repr(trusted), "True or False")
    with path.open("rb"):
        pass
    form = format or by_contents(path)
    samples = read_here(path, form) if trusted else read_apart(path, form, **limits)
    return _recording(path, samples, fs)


def _recording(path: Path, samples: Samples, fs: float | None) -> Recording:
    recorded = _usable(path, samples.fs, fs)
    if recorded is not None and fs is not None and not math.isclose(fs, recorded, rel_tol=1e-3):
        raise SceneError("fs", str(fs), f"the rate in {path.name}, {recorded:g} Hz, or absent")
    rate = fs if recorded is None else recorded
    if rate is None:
        raise SceneError("fs", "None", f"the sampling rate [Hz], which {path.name} does not have")
    return Recording(
        columns=samples.columns,
        fs=rate,
        units=samples.units,
        shaft=samples.shaft,
        source=str(path),
        metadata=samples.metadata,
        others=tuple(_recording(path, other, None) for other in samples.others),
    )


def _usable(path: Path, rate: float | None, fs: float | None) -> float | None:
    """Return the rate of a file; an unusable one counts as missing where another is given."""
    if rate is None or RATES[0] <= rate <= RATES[1]:
        return rate
    if fs is None:
        raise FileError(str(path), f"has a sampling rate of {rate:g} Hz; give fs if you know it")
    return None
