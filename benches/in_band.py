"""Judge tolerances and step caps by what a record of 50 kHz keeps: samples of a millisecond, statistics of 0.3 s.

    python benches/in_band.py samples|statistics [--only NAME] [--drawn COUNT] [-o FILE]

``samples``: the error of the sensor's or the outer ring's acceleration along x, y and z behind the recorder's
filter over one millisecond (relative L2, median of ten developed states of each scene), against rtol 1e-10 with
half the cap.
``statistics``: rms in octave bands to 20 kHz, kurtosis, crest and the lines of the ball passes over 0.3 s of eight
starts 1e-7 apart, against those of the default of raw signals (rtol 1e-7, the cap once); a number is biased where
Welch's t-test finds its mean apart at 1 %. ``--drawn``: of so many spalled bearings by chance instead, at the
default and at the tolerance for all frequencies.
"""

from __future__ import annotations

import argparse
import csv
import functools
import warnings
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import signal, stats

import ballrace as br
from ballrace.learn.drawn import log_uniform

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    Settings = tuple[tuple[float, float], ...]

FS = 50e3
SETTINGS = (
    (1e-7, 1.0),
    (1e-6, 1.0),
    (1e-5, 1.0),
    (1e-5, 1.2),
    (1e-4, 1.0),
    (1e-4, 1.2),
    (1e-4, 1.4),
    (1e-4, 1.8),
)
"""Tolerance, and step cap over that of raw signals; the first one is what the others are compared with."""
DEFAULTS = (SETTINGS[0], (1e-4, 1.2))
"""The tolerance for all frequencies, and that in a band."""
STATES, STARTS = 10, 8
COLUMNS = [f"{where}.a{along}" for where in ("housing.sensor", "outer") for along in "xyz"]
"""Accelerations that are judged: the sensor's, or where there is none the outer ring's."""
BANDS = ((50.0, 1250.0), (1250.0, 2500.0), (2500.0, 5000.0), (5000.0, 10e3), (10e3, 20e3))


def scenes() -> dict[str, br.Scene]:
    """Return the scenes by name."""

    def spalled(width: float, name: str = "6205") -> br.Scene:
        damage = br.defects.spall(on="outer_race", width_mm=width)
        return br.bearing(name, radial_load=500.0, speed_rpm=1797.0, defects=damage)

    load: dict[str, Any] = {"radial_load": 500.0, "speed_rpm": 1797.0}
    return {
        "wheel": br.presets.wheel_bearing(3000.0),
        "6205 healthy": br.bearing("6205", **load),
        "6205 spall 0.5": spalled(0.5),
        "6205 spall 1.5": spalled(1.5),
        "6206 spall 0.8": spalled(0.8, "6206"),
        "6205 oil": br.bearing("6205", lubricant="vg68", temperature_c=55.0, **load),
        "7208B pair": br.pair("7208B", radial_load=1000.0, axial_load=500.0, speed_rpm=1800.0),
        "7205B free": replace(br.bearing("7205B", axial_load=800.0, **load), spin="free"),
        "cornering": br.presets.cornering_wheel(),
    }


def drawn(count: int) -> dict[str, br.Scene]:
    """Return spalled deep groove bearings of the catalogue by chance."""
    rng = np.random.default_rng(62)
    names = [f"6{series}{bore:02d}" for series in (0, 2, 3) for bore in range(17)]
    found = {}
    for number in range(count):
        bearing = br.catalogue[str(rng.choice(names))]
        load = log_uniform(rng, (0.005, 0.08)) * bearing.static_rating
        width = log_uniform(rng, (0.03, 0.3)) * bearing.ball_diameter
        spall = br.defects.spall(
            on=("outer_race", "inner_race")[number % 2], width_mm=1e3 * width, edge_radius_mm=30.0 * width
        )  # fmt: skip
        found[f"{number} {bearing.designation}"] = br.bearing(
            bearing, radial_load=load, axial_load=rng.uniform(0.0, 0.4) * load,
            speed_rpm=log_uniform(rng, (600.0, 3600.0)), defects=spall,
        )  # fmt: skip
    return found


def run(scene: br.Scene, rtol: float, cap: float, **options: Any) -> br.Signals:
    """Run a scene with a tolerance and a multiple of the step cap of raw signals."""
    limit = _limit(scene)
    own = {"solver.frequency_cap": False, "solver.max_step": cap * limit, "solver.rtol": rtol}
    return br.simulate(scene.replace(own), threads=1, fs=FS, **options)


@functools.cache
def _limit(scene: br.Scene) -> float:
    exact = br.simulate(scene, duration=1e-4, fs=FS, settle=0.0, rtol=SETTINGS[0][0])
    return exact.provenance.step_limit


def samples(
    name: str, scene: br.Scene, settings: Settings = SETTINGS
) -> Iterator[dict[str, object]]:
    """Yield the error in the band of every setting."""
    spread = 0.011 * (1.0 + 0.618 * np.arange(STATES))
    out, states = br.simulate(scene, duration=0.05, fs=FS), []
    for seconds in np.diff(spread, prepend=0.0):
        out = br.simulate(scene, duration=float(seconds), fs=FS, start=out)
        states.append(out.end_state)
    true = [_columns(run(scene, 1e-10, 0.5, duration=1e-3, start=state)) for state in states]
    for rtol, cap in settings:
        errors, count = [], 0
        for state, exact in zip(states, true, strict=True):
            made = run(scene, rtol, cap, duration=1e-3, start=state)
            errors.append(np.linalg.norm(_columns(made) - exact) / np.linalg.norm(exact))
            count += made.stats.nfev
        yield {
            "scene": name, "rtol": rtol, "cap": cap, "evaluations a second": round(count / STATES / 1e-3),
            "median %": f"{100.0 * np.median(errors):.3f}", "worst %": f"{100.0 * max(errors):.3f}",
        }  # fmt: skip


def statistics(
    name: str, scene: br.Scene, settings: Settings = SETTINGS
) -> Iterator[dict[str, object]]:
    """Yield what of the statistics every setting changes."""
    load = next(iter(scene.loads))
    size = scene.loads[load].force
    assert isinstance(size, float)
    made = {}
    for rtol, cap in settings:
        numbers, count = [], 0
        for k in range(STARTS):
            near = scene.replace({f"loads.{load}.force": size * (1.0 + 1e-7 * k)})
            out = run(near, rtol, cap, duration=0.3)
            numbers.append(_numbers(out))
            count += out.stats.nfev
        made[rtol, cap] = {key: np.array([one[key] for one in numbers]) for key in numbers[0]}
        first = made[SETTINGS[0]]
        apart = {
            key: float(stats.ttest_ind(values, first[key], equal_var=False).pvalue)
            for key, values in made[rtol, cap].items()
            if np.ptp(values) > 0.0
        }
        biased = [
            f"{key} {100.0 * (made[rtol, cap][key].mean() / first[key].mean() - 1.0):+.1f} %"
            for key, p in apart.items()
            if p < 0.01
        ]
        yield {
            "scene": name, "rtol": rtol, "cap": cap, "evaluations a second": round(count / STARTS / 0.3),
            "rms": f"{made[rtol, cap]['rms'].mean():.4g}", "kurtosis": f"{made[rtol, cap]['kurtosis'].mean():.3g}",
            "biased": "; ".join(biased),
        }  # fmt: skip


def _numbers(out: br.Signals) -> dict[str, float]:
    x = next(out[name] for name in COLUMNS if name.endswith(".ay") and name in out)
    x = x - x.mean()
    f, density = signal.welch(x, FS, nperseg=2048)
    found = {
        f"rms {low:.0f}-{high:.0f} Hz": float(
            np.sqrt(density[(f >= low) & (f < high)].sum() * f[1])
        )
        for low, high in BANDS
    }
    found |= {"rms": float(x.std()), "kurtosis": float(np.mean(x**4) / np.mean(x**2) ** 2)}
    found["crest"] = float(np.abs(x).max() / x.std())
    rates = br.fault_frequencies(out.scene)
    at, value = br.spectra.squared_envelope_spectrum(x, FS)
    for k in (1, 2, 3):
        near = np.abs(at - k * rates.bpfo) < 6.0
        found[f"{k} BPFO"] = float(value[near].max())
    return found


def _columns(out: br.Signals) -> NDArray[np.float64]:
    names = [name for name in COLUMNS if name in out]
    where = names[0].rpartition(".")[0]
    return np.concatenate([out[name] for name in names if name.startswith(where)])


def main() -> None:
    """Write a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=("samples", "statistics"))
    parser.add_argument("--only", default="", help="a part of a scene's name")
    parser.add_argument("--drawn", type=int, default=0, metavar="COUNT", help="scenes by chance")
    parser.add_argument("-o", "--output", type=Path)
    options = parser.parse_args()
    warnings.simplefilter("ignore", br.SceneWarning)
    of = samples if options.what == "samples" else statistics
    rows = []
    settings = DEFAULTS if options.drawn else SETTINGS
    for name, scene in (drawn(options.drawn) if options.drawn else scenes()).items():
        if options.only in name:
            for row in of(name, scene, settings):
                print(*row.values(), sep="\t", flush=True)
                rows.append(row)
    if options.output is not None:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
