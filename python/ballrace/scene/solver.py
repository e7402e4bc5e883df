"""How the equations are integrated."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from .._base.document import Part

__all__ = ["Method", "Solver"]


Method = Literal[
    "adams",
    "dormand-prince",
    "verner",
]
"""The method of integration: a predictor–corrector of order 4 with one evaluation a step, and explicit pairs of
order 5 and 6."""


@dataclass(frozen=True, kw_only=True)
class Solver(Part):
    """How the equations are integrated.

    Attributes
    ----------
    method : Method
        The method. ``"adams"`` takes one evaluation in each step, and a third to a fifth of the evaluations that
        the explicit Runge-Kutta pairs take for the same error; stiff friction does not shorten its steps.
    rtol : float or "band"
        Relative tolerance [1], 1e-12 to 1e-1; each kind of state has its scale from the scene. ``"band"``: as the
        record needs it, 1e-4 with 1.2 times the step cap where signals are filtered to 20.5 kHz and less (``fs``
        of 51.2 kHz and less), friction fades at 0.05 m/s or more and contacts are damped, else 1e-7
        (``provenance.by_band``). In a document that does not say it, 1e-7.
    first_step : float or None
        First step [s]; None: Hairer's estimate.
    max_step : float or None
        Largest step [s]; None: no limit other than ``frequency_cap``.
    frequency_cap : bool
        Whether the step is also kept below a share of the period of the highest contact frequency that the
        method's stability and accuracy require, smaller where contacts vibrate undamped
        (``provenance.step_limit``). Without it, runs with loose tolerances succeed with accelerations wrong by 30
        % and more.
    reduce : bool
        Whether a run leaves out what does not change the motion: directions without forces and mirror
        images.
    """

    method: Method = "adams"
    rtol: float | Literal["band"] = "band"
    first_step: float | None = None
    max_step: float | None = None
    frequency_cap: bool = True
    reduce: bool = True
