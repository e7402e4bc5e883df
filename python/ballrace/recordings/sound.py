"""WAV: 32-bit floats without a scale, so that no amplitude is clipped and none has to be guessed.

Names, units and the rest stand in the comment of the file's list of information, which players pass over.
"""

from __future__ import annotations

import io
import json
import struct
import warnings
from typing import TYPE_CHECKING

import numpy as np

from .._base.libraries import scipy
from ..errors import FileError, SceneError
from .sampled import cut
from .samples import Samples, from_header

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from .reading import Reading

_FULL = {"u1": 128.0, "i2": 2.0**15, "i4": 2.0**31}
"""Full scale of whole numbers; scipy gives those of 24 bits as the upper ones of 32."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write the columns as channels; the format holds whole rates only."""
    fs = samples.fs or 0.0
    if fs != round(fs) or fs >= 2**32:
        raise SceneError(
            "path", str(path), f"a format for a rate of {fs:g} Hz; WAV has whole numbers"
        )
    wide = np.stack(list(samples.columns.values()), axis=1)
    with np.errstate(over="ignore"):
        data = wide.astype(np.float32)
    if np.any(np.isinf(data) & np.isfinite(wide)):
        raise SceneError("path", str(path), "a format for numbers that 32 bits do not hold")
    buffer = io.BytesIO()
    scipy.io.wavfile.write(buffer, round(fs), data)
    temporary.write_bytes(_commented(buffer.getvalue(), samples.header()))


def read(path: Path, reading: Reading) -> Samples:
    """Read the channels: floats as they are, whole numbers as shares of the full scale.

    Raises
    ------
    FileError
        It is damaged, or no WAV.
    """
    content = path.read_bytes()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", scipy.io.wavfile.WavFileWarning)
            warnings.filterwarnings("ignore", message="Chunk .* not understood")
            # Of a file it would set aside what a header of 180 bytes declares.
            fs, data = scipy.io.wavfile.read(io.BytesIO(content))
    except (ValueError, EOFError, struct.error, scipy.io.wavfile.WavFileWarning) as error:
        raise FileError(str(path), f"not a WAV file, or damaged ({error})") from error
    if not data.size:
        raise FileError(str(path), "not a WAV file, or damaged: it has no samples")
    channels = data.reshape(len(data), -1).astype(np.float64).T
    if header := _comment(content):
        names = _names(header)
        return cut(
            path, from_header(path, header, dict(zip(names, channels, strict=False))), reading
        )
    unit, channels = _scaled(channels, data.dtype)
    names = [f"channel_{place + 1}" for place in range(len(channels))]
    columns = dict(zip(names, channels, strict=True))
    samples = Samples(columns=columns, fs=float(fs), units=dict.fromkeys(names, unit))
    return cut(path, samples, reading)


def _scaled(
    channels: NDArray[np.float64], kind: np.dtype[np.generic]
) -> tuple[str, NDArray[np.float64]]:
    full = _FULL.get(kind.str[1:])
    if full is None:
        return "", channels
    return "full scale", (channels - (full if kind.kind == "u" else 0.0)) / full


def _commented(wav: bytes, text: str) -> bytes:
    """Append a list of information that holds a comment, and correct the length of it all."""
    comment = text.encode() + b"\0" * (2 - len(text.encode()) % 2)
    entry = b"INFOICMT" + struct.pack("<I", len(comment)) + comment
    whole = wav + b"\0" * (len(wav) % 2) + b"LIST" + struct.pack("<I", len(entry)) + entry
    return whole[:4] + struct.pack("<I", len(whole) - 8) + whole[8:]


def _comment(wav: bytes) -> str:
    """Return the comment of a file if it is ours, else nothing."""
    start = wav.rfind(b"INFOICMT")
    if start < 0:
        return ""
    (size,) = struct.unpack("<I", wav[start + 8 : start + 12])
    text = wav[start + 12 : start + 12 + size].rstrip(b"\0").decode("utf-8", errors="replace")
    return text if text.startswith('{"columns"') else ""


def _names(header: str) -> list[str]:
    try:
        return list(json.loads(header)["columns"])
    except (ValueError, KeyError, TypeError):
        return []
