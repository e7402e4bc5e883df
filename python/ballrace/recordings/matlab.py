"""MATLAB files: of the Case Western Reserve University, Paderborn University, the MFPT society, or vectors.

The keys of Case Western are ``X105_DE_time`` and so on, and ``X105RPM``. Its files have neither the sampling rate
nor the unit.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import FileError, SceneError
from .datasets import cwru, mfpt, paderborn, vectors
from .hierarchical import contents
from .samples import Samples, from_header

if TYPE_CHECKING:
    from pathlib import Path

_LONGEST = 63
"""Most characters of a name in MATLAB."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a vector a column under the keys of Case Western, the rate as ``fs``, and the rest as JSON.

    The number in the keys is that of the file's name, ``105.mat``, or 1.
    """
    from scipy.io import savemat

    number = f"X{int(path.stem) if path.stem.isdecimal() else 1:03d}"
    variables: dict[str, Any] = {}
    for name, x in samples.columns.items():
        key = f"{number}_{re.sub(r'[^0-9A-Za-z]+', '_', name)}_time"
        if key in variables or len(key) > _LONGEST:
            raise SceneError(
                "columns",
                name,
                f"names that differ in letters and digits; {key} is taken or too long",
            )
        variables[key] = x[:, np.newaxis]
    keys = list(variables)
    if samples.shaft is not None:
        variables[f"{number}RPM"] = 60.0 * samples.shaft
    variables |= {
        "fs": samples.fs,
        "ballrace": samples.header(),
        "keys": np.array(keys, dtype=object),
    }
    savemat(temporary, variables, appendmat=False, do_compression=True)


def read(path: Path) -> Samples:
    """Read a record of any of these kinds.

    Raises
    ------
    FileError
        It is damaged, no MATLAB file, or has no record.
    """
    variables = _variables(path)
    if "ballrace" in variables:
        return _ours(path, variables)
    for kind in (cwru, paderborn, mfpt, vectors):
        found = kind(path, variables)
        if found is not None:
            return found
    raise FileError(str(path), f"has no record among {', '.join(variables) or 'nothing'}")


def _variables(path: Path) -> dict[str, Any]:
    from scipy.io import loadmat

    with path.open("rb") as file:
        start = file.read(20)
    if start.startswith((b"MATLAB 7.3", b"\x89HDF")):
        arrays, _, single = contents(path)
        return {**arrays, **{name: np.array([value]) for name, value in single.items()}}
    try:
        found = loadmat(path, squeeze_me=True, struct_as_record=False, appendmat=False)
    except Exception as error:
        raise FileError(str(path), f"not a MATLAB file, or damaged ({error})") from error
    return {name: value for name, value in found.items() if not name.startswith("__")}


def _ours(path: Path, variables: dict[str, Any]) -> Samples:
    header = str(variables["ballrace"])
    try:
        keys = np.atleast_1d(variables["keys"]).tolist()
        vectors = [np.atleast_1d(np.asarray(variables[key], dtype=np.float64)) for key in keys]
        columns = dict(zip(json.loads(header)["columns"], vectors, strict=True))
    except (KeyError, TypeError, ValueError) as error:
        raise FileError(str(path), f"damaged: a column is missing ({error!r})") from error
    return from_header(path, header, columns)
