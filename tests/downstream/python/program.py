"""What a program outside may rely on, checked by ``mypy --strict`` against what is installed."""

from __future__ import annotations

from typing import assert_type

import numpy as np
import polars as pl
from numpy.typing import NDArray

import ballrace as br
from ballrace.scene import ContactsProbe, Defect, Load, MotionProbe

Array = NDArray[np.float64]


def bearing(force: float) -> br.Scene:
    """Return a bearing by its name, with a spall and two probes."""
    spall: Defect = br.defects.spall(on="outer_race", width_mm=1.0)
    scene = br.bearing("6205", radial_load=force, speed_rpm=1797.0, defects=spall)
    assert all(isinstance(load, Load) for load in scene.loads.values())
    probes = {"outer": MotionProbe(body="outer"), "contacts": ContactsProbe(balls=(0,))}
    return assert_type(scene.replace({"probes": probes}), br.Scene)


def run(scene: br.Scene) -> tuple[Array, float]:
    """Return the acceleration [m/s²] and the sampling rate [Hz] of a short run."""
    try:
        out = br.simulate(scene, duration=2e-3, settle=0.0)
    except br.SceneError as error:
        raise SystemExit(f"{error}") from error
    except br.IntegrationError as error:
        raise SystemExit(f"stopped at {assert_type(error.time, float)} s") from error
    assert_type(out.warnings, tuple[str, ...])
    return assert_type(out["outer.ay"], Array), assert_type(out.fs, float)


def rest(scene: br.Scene) -> float:
    """Return the heaviest contact [N] at rest; the equations are open to one's own integrator."""
    found: br.statics.Equilibrium = br.equilibrium(scene)
    model = br.Model(scene)
    rates: Array = model.rhs(0.0, model.start())
    assert rates.shape == (len(model.names),)
    return float(found.outer_load.max())


def table() -> pl.DataFrame:
    """Return a table of six cases."""
    return br.grid(
        {"loads.radial.force": [500.0, 1000.0], "defects.spall.width": [0.0, 1e-3, 2e-3]}
    )


def main() -> None:
    scene = bearing(1000.0)
    acceleration, fs = run(scene)
    f, value = br.spectra.squared_envelope_spectrum(acceleration, fs)
    print(f"{len(f)} lines, the highest {float(value.max()):.3g}")
    print(
        f"{rest(scene):.1f} N; {table().height} cases; BPFO {br.fault_frequencies(scene).bpfo:.2f} Hz"
    )


if __name__ == "__main__":
    main()
