"""Simulated records whose damage is known, and what is found in them.

``library.csv`` has a record a row: bearings of the catalogue under loads, clearances, waves or textures of the
races and spalls by chance, measured through random housings in noise. It is made anew by
``python benches/verdict_library.py``; the likelihood of damage and the width of a spall are read from it.

=====================  ==========================================================================================
``bearing``            designation
``part``               what is damaged, or ``none``
``speed_rpm``, ``fs``  speed [rev/min], sampling rate [Hz]
``load``               radial load over the static rating
``width``, ``edge``    width of the spall and radius of its edges [ball diameters]
``snr_db``             vibration over noise [dB]
``z_…``, ``depth_…``   of the evidence for the outer race, the inner race, a ball; nan where not judged
``accel_…``            its acceleration, at any size and speed: :func:`ballrace.diagnosis.likelihood.at_any_size`
``kurtosis``           largest of a band
``spacing`` and so on  of the passes of the damaged race: see :class:`ballrace.diagnosis.passes.Passes`
=====================  ==========================================================================================
"""

from __future__ import annotations

import functools
from importlib import resources
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["library"]


@functools.cache
def library() -> NDArray[Any]:
    """Return the table, a structured array of a record a row."""
    with resources.files(__package__).joinpath("library.csv").open(encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        kinds = [(name, "U10" if name in ("bearing", "part") else float) for name in names]
        return np.genfromtxt(file, delimiter=",", dtype=kinds, encoding="utf-8")
