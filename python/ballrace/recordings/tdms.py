"""TDMS, as LabVIEW and its relatives write it, by nptdms."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._base.libraries import needed
from ..errors import FileError
from .limits import check_declared
from .lines import other_ways
from .rates import roundest
from .tree import Leaf, Tree, from_tree

if TYPE_CHECKING:
    from pathlib import Path

    from .reading import Reading
    from .samples import Samples

_STEP, _UNIT, _START = "wf_increment", "unit_string", "wf_start_time"
"""Properties of a channel: step of time [s], unit, time of the first sample."""


def read(path: Path, reading: Reading) -> Samples:
    """Read the channels of all groups, each at the rate of its waveform.

    Raises
    ------
    FileError
        It is damaged, or has no channel of numbers.
    """
    nptdms = needed("nptdms", path.name)
    try:
        with nptdms.TdmsFile.open(path) as file:
            groups = [group for group in file.groups() if group.channels()]
            check_declared(path, sum(float(len(c)) for group in groups for c in group.channels()))
            tree: Tree = {name: str(value) for name, value in file.properties.items()}
            for group in groups:
                channels = {
                    c.name: leaf for c in group.channels() if (leaf := _leaf(c)) is not None
                }
                tree |= channels if len(groups) == 1 else {group.name: channels}
    except FileError:
        raise
    except Exception as error:
        reason = f"not a TDMS file, or damaged, as nptdms reads it ({error})"
        raise FileError(str(path), f"{reason}; {other_ways()}") from error
    return from_tree(path, tree, reading, joint="/")


def _leaf(channel: Any) -> Leaf | None:
    """Return the samples of a channel, with its rate and unit."""
    values = np.asarray(channel[:])
    if values.dtype.kind == "M":
        values = values.astype("M8[ns]").astype(np.int64) * 1e-9
        return Leaf(values, {"unit": "s"}) if values.size > 1 else None
    if values.dtype.kind not in "fiub" or values.size < 2:
        return None
    step, unit = channel.properties.get(_STEP), channel.properties.get(_UNIT)
    attributes: dict[str, Any] = {"unit": str(unit)} if unit else {}
    if isinstance(step, int | float) and step > 0.0:
        attributes["sampling_rate"] = roundest(1.0 / float(step), 1e-9)
    return Leaf(values, attributes)
