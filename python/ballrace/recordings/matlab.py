"""MATLAB files: of the Case Western Reserve University, Paderborn University, MFPT, LMS, or any vectors.

The keys of Case Western are ``X105_DE_time`` and so on, and ``X105RPM``. Its files have neither the sampling rate
nor the unit. Files of version 7.3 are HDF5, with the same content.
"""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import scipy
from ..errors import FileError, SceneError
from .datasets import cwru, lms, mfpt, paderborn
from .hierarchical import contents
from .sampled import cut
from .samples import Samples, from_header
from .tree import Leaf, Tree, from_tree

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading

_LONGEST = 63
"""Most characters of a name in MATLAB."""


def write(samples: Samples, temporary: Path, path: Path) -> None:
    """Write a vector a column under the keys of Case Western, the rate as ``fs``, and the rest as JSON.

    The number in the keys is that of the file's name, ``105.mat``, or 1.
    """
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
    scipy.io.savemat(temporary, variables, appendmat=False, do_compression=True)


def read(path: Path, reading: Reading) -> Samples:
    """Read a record of any of these kinds.

    Raises
    ------
    FileError
        It is damaged, no MATLAB file, or has no record.
    """
    tree = _tree(path)
    if isinstance(tree.get("ballrace"), str):
        return cut(path, _ours(path, tree), reading)
    for kind in (cwru, paderborn, mfpt, lms):
        found = kind(path, tree, reading)
        if found is not None:
            return found
    return from_tree(path, tree, reading)


def _tree(path: Path) -> Tree:
    """Return the variables of a file of any version."""
    with path.open("rb") as file:
        start = file.read(20)
    if start.startswith((b"MATLAB 7.3", b"\x89HDF")):
        return contents(path, matlab=True)
    try:
        found = scipy.io.loadmat(path, squeeze_me=True, struct_as_record=False, appendmat=False)
    except Exception as error:
        raise FileError(str(path), f"not a MATLAB file, or damaged ({error})") from error
    return {name: _plain(value) for name, value in found.items() if not name.startswith("__")}


def _plain(value: Any) -> Any:
    """Return a value of a file as a leaf, a number, a text, a tree or a list of these; None of what is none."""
    if hasattr(value, "_fieldnames"):
        return {name: _plain(getattr(value, name)) for name in value._fieldnames}
    if isinstance(value, str):
        return value
    array = np.asarray(value)
    if array.dtype.kind == "U":
        return [str(text) for text in array.ravel()]
    if array.dtype.kind == "O":
        return [_plain(one) for one in array.ravel(order="F")]
    if array.dtype.kind not in "fiub" or array.size == 0:
        return None
    return float(array.ravel()[0]) if array.size == 1 else Leaf(array)


def _ours(path: Path, tree: Tree) -> Samples:
    header = tree["ballrace"]
    try:
        keys = tree["keys"]
        leaves = [tree[key] for key in ([keys] if isinstance(keys, str) else keys)]
        vectors = [
            np.ravel(x.values if isinstance(x, Leaf) else x).astype(np.float64) for x in leaves
        ]
        columns = dict(zip(json.loads(header)["columns"], vectors, strict=True))
    except (KeyError, TypeError, ValueError) as error:
        raise FileError(str(path), f"damaged: a column is missing ({error!r})") from error
    return from_header(path, header, columns)
