"""The few numbers that characterise a signal, as in the table of a campaign."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .. import _core
from .._base.interrupt import answers_ctrl_c
from .._base.numbers import finite, real
from ..errors import SceneError
from ..scene.scene import checked_scene

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..scene import Scene
    from ..spectra.checks import Given


@answers_ctrl_c
def features(
    x: Given,
    fs: float | None = None,
    *,
    name: str = "",
    scene: Scene | None = None,
    skip: float = 0.0,
    band: tuple[float, float] | None = None,
) -> dict[str, float | None]:
    """Return the features of a signal, simulated or measured, by the names of a campaign's columns.

    Features of a measurement are comparable, name by name, with the manifest of a campaign;
    :meth:`ballrace.Signals.features` returns those of a run.

    Parameters
    ----------
    x : Signals, Measurement, Recording, Channel or array_like, shape (n,)
        Signal; of a record its column by default, as of :meth:`ballrace.Recording.channel`.
    fs : float, optional
        Sampling rate of an array [Hz].
    name : str
        Name of the column that the features are of: ``"outer.ay"`` gives ``outer.ay.rms``, no name ``rms``.
    scene : Scene, optional
        The bearing and its speed, for the lines at the fault frequencies of its rows; its loads and defects do not
        matter. Without it there are only the moments, ``rms``, ``peak``, ``crest_factor`` and ``kurtosis``, and no
        standard errors, since the duration of a turn of the shaft is unknown.
    skip : float
        Beginning of the signal that is left out [s].
    band : tuple of two floats, optional
        Band of the envelope [Hz]; by default all frequencies.

    Returns
    -------
    dict of str to float or None
        In the unit of ``x``, squared for an envelope; :func:`ballrace.campaign` lists them at
        ``columns``. None where the signal cannot give a feature: a line for which it is too short. With a scene
        their standard errors, such as ``rms_se``, and ``turns``, ``row0.passes`` and ``batches``, as
        described for :meth:`ballrace.Signals.features`.

    Raises
    ------
    SceneError
        An argument is not usable.

    Examples
    --------
    >>> import ballrace as br, numpy as np
    >>> t = np.arange(12_000) / 12_000.0
    >>> found = br.features(np.sin(2 * np.pi * 50.0 * t), fs=12_000.0, name="sensor")
    >>> round(found["sensor.rms"], 4), round(found["sensor.kurtosis"], 4)
    (0.7071, 1.5)
    """
    from ..spectra.checks import given_signal

    document = None if scene is None else checked_scene(scene).to_json()
    options = json.dumps(feature_options(None, skip, band, loads=False))
    signal, fs = given_signal(x, fs)
    return dict(_core.signal_features(signal, fs, name, document, options))


def feature_options(
    columns: Sequence[str] | str | None, skip: float, band: Sequence[float] | None, loads: object
) -> dict[str, Any]:
    """Return the options of the features as the core reads them.

    Raises
    ------
    SceneError
        One is not usable.
    """
    if not isinstance(loads, bool):
        raise SceneError("contact_loads", repr(loads), "True or False")
    columns = [columns] if isinstance(columns, str) else columns
    if columns is not None and not isinstance(columns, Iterable):
        raise SceneError("columns", repr(columns), "a name of a column, or several")
    edges = [real(edge) for edge in band] if isinstance(band, Iterable) else []
    if band is not None and not (len(edges) == 2 and all(map(math.isfinite, edges))):
        raise SceneError("band", repr(band), "two frequencies [Hz]")
    return {
        "columns": None if columns is None else [str(name) for name in columns],
        "skip": finite("skip", skip, "s"),
        "band": None if band is None else edges,
        "contact_loads": loads,
    }
