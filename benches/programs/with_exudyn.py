"""Exudyn on the healthy 6205."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

import ballrace as br

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from .measuring import Case, relative, timed
from .wheel import FS

sys.path.append(str(Path(__file__).parents[2] / "tests" / "python"))


def exudyn_cases(quick: bool) -> list[Case]:
    """Run the healthy 6205, each program against its own converged solution."""
    import exudyn
    import exudyn.itemInterface

    import test_exudyn as shared

    scene, constants = shared.scene(), shared.constants()
    rate = scene.drive.speed / math.tau
    horizon, length = 3e-3, 20e-3
    samples = round(horizon * FS)

    def theirs(step: float, duration: float) -> tuple[float, Array]:
        built = shared.build(scene, rate, *constants)
        output = exudyn.OutputVariableType.Acceleration
        sensor = built.system.AddSensor(
            exudyn.itemInterface.SensorBody(
                bodyNumber=built.inner, storeInternal=True, outputVariableType=output
            )
        )
        built.system.Assemble()
        chosen = shared.implicit(exudyn, duration, step, FS)
        seconds, _ = timed(lambda: built.system.SolveDynamic(chosen))
        found = built.system.GetSensorStoredData(sensor)
        return seconds, found[1:samples, 1:3].T

    def ours(rtol: float, step: float, duration: float) -> tuple[float, Array]:
        changes = {"solver.max_step": step, "solver.frequency_cap": False}
        bounded = scene.replace(changes)
        seconds, out = timed(
            lambda: br.simulate(
                bounded,
                duration=duration,
                fs=FS,
                start="rolling",
                rtol=rtol,
                threads=1,
                bandwidth=None,
            )
        )
        return seconds, np.stack([out["inner.ax"], out["inner.ay"]])[:, 1:samples]

    cap = br.simulate(scene, duration=1e-4, start="rolling").provenance["max_step"]
    finest = 2.5e-7
    their_truth = theirs(finest, horizon)[1]
    our_truth = ours(1e-10, cap / 10, horizon)[1]
    print(
        f"Exudyn against ballrace, both converged: {relative(their_truth, our_truth):.1e} "
        "(a point contact and linear damping there)"
    )

    steps = (1e-5, 5e-6, 2.5e-6, 1.25e-6) if quick else (2e-5, 1e-5, 5e-6, 2.5e-6, 1.25e-6, 6.25e-7)
    cases = [
        Case("exudyn, healthy 6205", f"{h:.2e} s", lambda h=h: theirs(h, length), their_truth)
        for h in steps
    ]
    cases += [
        Case(
            "ballrace, healthy 6205",
            f"{r:.0e}, {factor:g} × cap",
            lambda r=r, h=factor * cap: ours(r, h, length),
            our_truth,
        )
        for r in (1e-2, 1e-3, 1e-4, 1e-5, 1e-6)
        for factor in (1.0, 2.0, 4.0)
    ]
    return cases
