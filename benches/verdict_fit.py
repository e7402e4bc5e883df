"""Fit what verdicts read from simulated records, and write it into the package.

    python benches/verdict_fit.py

reads ``benches/verdict_library.csv``, which ``benches/verdict_library.py`` makes anew, and writes
``python/ballrace/diagnosis/fit.json``. The library has a record a row:

=====================  ==========================================================================================
``bearing``            designation
``part``               what is damaged, two surfaces joined by ``+``, or ``none``
``speed_rpm``, ``fs``  speed [1/min], sampling rate [Hz]
``load``               radial load over the static rating
``width``, ``edge``    width of the damage and radius of its edges, 0 of dents and holes [ball diameters]
``snr_db``             vibration over noise [dB]
``z_…``, ``depth_…``   of the evidence for the outer race, the inner race, a ball; nan where not judged
``accel_…``            its acceleration, at any size and speed: :func:`ballrace.diagnosis.likelihood.at_any_size`
``kurtosis``           largest of a band
``spacing`` and so on  of the passes of a spall of a race: see :class:`ballrace.diagnosis.passes.Passes`
``shape``              what the damage is: ``spall``, ``pit``, ``dent``, ``cap``, ``none``, or two of these
``lag``                how far the cage lags behind the orders that records are judged by, as a part of it
``weaker_db``          what the path takes off [dB]
``clipped``            share of the samples that are clipped
=====================  ==========================================================================================
"""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.optimize import minimize

import ballrace as br
from ballrace.diagnosis.likelihood import numbers_of
from ballrace.diagnosis.null import ACCUSED
from ballrace.diagnosis.width import are_clear

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ballrace.diagnosis.combs import Part

TABLE = Path(__file__).with_name("verdict_library.csv")
FIT = Path(br.__file__).parent / "diagnosis" / "fit.json"
WORDS = ("bearing", "part", "shape")
"""Columns of words."""
RIDGE = 0.3
"""Pull of the coefficients of standardised numbers towards 0."""

RACES: tuple[Part, ...] = ("outer_race", "inner_race")
WITHIN = (0.05, 0.5, 0.95)
NINE_IN_TEN = 0.1


@functools.cache
def library(path: Path = TABLE) -> NDArray[Any]:
    """Return the table, a structured array of a record a row."""
    with path.open(encoding="utf-8") as file:
        names = file.readline().strip().split(",")
        kinds = [(name, "U21" if name in WORDS else float) for name in names]
        return np.genfromtxt(file, delimiter=",", dtype=kinds, encoding="utf-8")


def judged(rows: NDArray[Any] | None = None) -> NDArray[Any]:
    """Return the records of a library that have evidence; by default of the one that is kept."""
    rows = library() if rows is None else rows
    found: NDArray[Any] = rows[np.isfinite(rows["kurtosis"])]
    return found


def damaged(rows: NDArray[Any], part: Part) -> NDArray[np.bool_]:
    """Return whether a part is what is damaged, or one of two that are, shape (rows,)."""
    return np.array([part in each.split("+") for each in rows["part"].tolist()])


@functools.cache
def regression(part: Part, sized: bool, without: str = "") -> dict[str, Any]:
    """Return the regression of a part over the library, on request without a bearing.

    The coefficients of greatest likelihood less the ridge, none of them below 0.
    """
    rows = judged()
    rows = rows[rows["bearing"] != without]
    x, true = numbers_of(part, rows, sized), damaged(rows, part)
    mean, deviation = x.mean(axis=0), x.std(axis=0)
    x = np.column_stack([np.ones(len(x)), (x - mean) / deviation])

    def cost(a: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        logit = x @ a
        chance = 1.0 / (1.0 + np.exp(-logit))
        pull = RIDGE * np.array([0.0, *a[1:]])
        value = np.logaddexp(0.0, logit).sum() - logit[true].sum() + 0.5 * float(pull @ a)
        return float(value), x.T @ (chance - true) + pull

    bounds = [(None, None)] + [(0.0, None)] * (x.shape[1] - 1)
    found = minimize(cost, np.zeros(x.shape[1]), jac=True, method="L-BFGS-B", bounds=bounds).x
    return {
        "mean": mean.tolist(), "deviation": deviation.tolist(), "constant": float(found[0]),
        "coefficients": found[1:].tolist(), "prior": float(true.sum() / (~true).sum()),
    }  # fmt: skip


def ratios(model: dict[str, Any], x: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the likelihood ratios of sound to damaged by a regression, shape (rows,)."""
    logit = model["constant"] + ((x - model["mean"]) / model["deviation"]) @ model["coefficients"]
    found: NDArray[np.float64] = model["prior"] * np.exp(-np.clip(logit, -50.0, 50.0))
    return found


@functools.cache
def bridged(part: Part, without: str = "") -> tuple[float, float, float]:
    """Return what spalls of the library are wider than the spacing: 5 %, median, 95 % [ball diameters].

    Ranks are counted out of one more than there are, so that the next one lies within in nine of ten cases.
    """
    rows = library()
    rows = rows[are_clear(rows) & (rows["part"] == part) & (rows["bearing"] != without)]
    low, middle, high = np.quantile(rows["width"] - rows["spacing"], WITHIN, method="weibull")
    return float(low), float(middle), float(high)


def strength() -> dict[str, float]:
    """Return the strength that nine of ten spalls of the outer race that show lines exceed, over their width.

    The decimal logarithm of a·D²/v is a line over that of the width in ball diameters.
    """
    rows = judged()
    shows = rows["accel_outer_race"] > 0.0
    rows = rows[(rows["part"] == "outer_race") & (rows["edge"] > 0.0) & shows]
    width, size = np.log10(rows["width"]), np.log10(rows["accel_outer_race"])
    slope, constant = np.polyfit(width, size, 1)
    below = float(np.quantile(size - constant - slope * width, NINE_IN_TEN))
    return {
        "slope": float(slope), "constant": float(constant) + below,
        "narrowest": float(rows["width"].min()), "widest": float(rows["width"].max()),
    }  # fmt: skip


def main() -> None:
    """Write the fit."""
    fitted = {
        "ratio": {
            part: {"sized": regression(part, True), "unsized": regression(part, False)}
            for part in ACCUSED
        },
        "bridge": {part: bridged(part) for part in RACES},
        "strength": strength(),
    }
    rounded = json.loads(json.dumps(fitted), parse_float=lambda text: float(f"{float(text):.7g}"))
    FIT.write_text(json.dumps(rounded, indent=1, allow_nan=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
