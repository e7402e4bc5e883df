"""The options of a run: one table of arguments that runs, campaigns and the command line share."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from . import _core
from ._base.document import Part
from ._base.numbers import counted, real
from .errors import SceneError
from .scene import Method

__all__ = ["Run"]

EMPTY = "an empty cell is None, or null in a data frame"
"""Advice on what to write into a table where nothing is meant."""

Start = Literal["equilibrium", "rolling"]


@dataclass(frozen=True, kw_only=True)
class Run(Part):
    """The arguments of a run as one document, which mirrors the core's.

    :func:`ballrace.simulate` describes each and its range; its arguments and those of :func:`ballrace.campaign`
    are these. :func:`ballrace.simulate` has no default for ``duration``.

    Attributes
    ----------
    duration, fs : float
        Simulated time [s] and sampling rate [Hz].
    start : {"equilibrium", "rolling"} or array_like of shape (n_states,)
        Where the run starts.
    rtol, accuracy : float or None
        Tolerance of the integrator, or the error of the accelerations from which it is chosen.
    method : Method or None
        Method of integration.
    threads : int
        Threads of the run; 0: chosen automatically.
    bandwidth : {"auto"} or None
        Whether signals are filtered.
    settle : float or None
        Time before t = 0 in which the transient of the start decays [s].
    time_limit, max_steps
        Limits of the run: wall time [s], and steps.

    Examples
    --------
    >>> import ballrace as br
    >>> run = br.Run(duration=0.001, fs=20_000.0)
    >>> br.simulate(br.presets.deep_groove_6205(), **run.to_dict()).t.size
    20
    """

    duration: float = 0.1
    fs: float = 50_000.0
    start: Start | NDArray[np.float64] | tuple[float, ...] = "equilibrium"
    rtol: float | None = None
    accuracy: float | None = None
    method: Method | None = None
    threads: int = 0
    bandwidth: Literal["auto"] | None = "auto"
    settle: float | None = None
    time_limit: float | None = None
    max_steps: int | None = None

    @classmethod
    def from_json(cls, text: str) -> Run:
        """Read a run from JSON and check it.

        Raises
        ------
        SceneError
            Names the first field that is unknown or not usable.
        """
        return cls(**json.loads(_core.run_from_json(text)))

    def to_json(self) -> str:
        """Check the run and return it as JSON on one line, every field written out.

        Raises
        ------
        SceneError
            A field is not usable.
        """
        return _core.run_from_json(json.dumps(document({n: getattr(self, n) for n in ARGUMENTS})))


ARGUMENTS = tuple(field.name for field in fields(Run))
"""Names of the arguments of a run, in the order of their declaration."""

BUDGET = ("time_limit", "max_steps")
"""Options that say what a run may cost: no result depends on them."""

DECIDING = ("start", "method", "bandwidth", "duration", "fs", "rtol", "accuracy", "settle")
"""Options that results depend on, in the order in which a case's id has them."""

_OPTIONAL = frozenset(field.name for field in fields(Run) if field.default is None)


def document(given: Mapping[str, Any]) -> dict[str, Any]:
    """Return arguments of a run as JSON has them, in the order given; ranges are the core's to check.

    Raises
    ------
    SceneError
        One is unknown, no number, or none of the names that it may be.
    """
    for name in given:
        if name not in ARGUMENTS:
            raise SceneError(name, "an argument of a run", f"one of {', '.join(ARGUMENTS)}")
    return {name: _as_json(name, value) for name, value in given.items()}


def _as_json(name: str, value: Any) -> Any:
    """Return the value of an argument as JSON has it."""
    if isinstance(value, Mapping):
        # None of them is a mapping: messages show it as it was written, not as a part of a scene keeps it.
        value = dict(value)
    match name:
        case "start":
            return _start(value)
        case "method":
            return _one_of(name, value, (None, *get_args(Method)), ", ".join(get_args(Method)))
        case "bandwidth":
            # Tables, whose empty cells change nothing, and TOML have no None.
            _one_of(
                name, value, ("auto", "none", None), "'auto' or None ('none' in tables and sweeps)"
            )
            return "auto" if value == "auto" else None
        case _ if value is None and name in _OPTIONAL:
            return None
        case "threads" | "max_steps":
            return counted(name, value, 0)
    return _number(name, value)


def _start(value: Any) -> Any:
    if not isinstance(value, tuple | list | np.ndarray):
        return _one_of("start", value, get_args(Start), "'equilibrium' or 'rolling'")
    return [_number(f"start[{i}]", number) for i, number in enumerate(value)]


def _one_of(name: str, value: Any, names: tuple[Any, ...], allowed: str) -> Any:
    if not isinstance(value, str | None) or value not in names:
        several = name == "method"
        raise SceneError(name, shown(value), f"one of {allowed}" if several else allowed)
    return value


def _number(name: str, value: Any) -> float:
    number = real(value)
    if not math.isfinite(number):
        finite = isinstance(value, float | int | np.floating) and not isinstance(value, bool)
        raise SceneError(name, shown(value), "a finite number" if finite else "a number")
    return number


def shown(value: Any) -> str:
    """Return a cell as a message shows it; for one that is not a number, how to leave it empty."""
    if isinstance(value, float) and math.isnan(value):
        return f"{value} ({EMPTY})"
    return repr(value)
