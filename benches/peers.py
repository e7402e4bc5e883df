"""Beside other programs, all in one run: what the same bearing costs them at the same error. For developers.

    python benches/peers.py --quick       # about two minutes on an idle core
    python benches/peers.py -o FOLDER     # everything; tables on the screen, and peers.csv in the folder

The scene is the preset ``wheel_bearing`` under 3 kN of thrust: two rows, an outer-race defect, friction.

1. *Slices*: what a number of slices or nodes costs and what it errs in the outer ring's acceleration, all three
   components, relative L2 over 6 ms from equilibrium with one impact, against 64 fitted nodes, integrated tightly.
2. *Right-hand side*: numba (`numba_bearing.py`) on 200 fixed slices, first held to ``Model.rhs``, then timed over
   states along the run. Ours is timed as a run over its evaluations, the integrator's own work included.
3. *A run* of the same 6 ms: SciPy's ``RK45`` and ``LSODA`` with the numba right-hand side, Octave's ``ode45``
   with a vectorised one (`octave_bearing.m`), ours on the same 200 slices, on its default of six fitted nodes, and
   on the fewest nodes that err no more than 200 slices do. Tolerances are swept with the step free, capped as we
   cap it, and (ours) at twice the cap. The error is that of the integration alone: against our integrator on the
   same slices at rtol 1e-10 with a tenth of the cap, which DOP853 confirms for 200 slices.
4. *Exudyn* (extra ``validation``) on the healthy 6205 of ``tests/python/test_exudyn.py``, steps swept; each
   program against its own converged solution over 3 ms, and timed over 20 ms.

Tolerances are one number times a scale for each kind of state, the same for all: the approach of a loaded contact
for lengths, times the highest contact frequency for speeds. SciPy's and Octave's relative part is off, since 36 mm
of position say nothing about what error of it matters; with it on LSODA takes many times longer.

Times are processor times of one thread: on an idle machine wall time, and on a loaded one still comparable.
Peers alternate in rounds; a ratio is the median of the rounds' ratios, with their range. "At 1 %" is interpolated
on a program's front of error and cost; where all its settings do better, it is the cheapest one.
Needs the extras ``bench`` and ``test``; what is not installed is skipped, and said so.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import importlib.util
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numba_bearing import Bearing

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

from programs.measuring import Row, alternate, compare, machine, relative, show, write
from programs.wheel import Judge, Wheel, hold, our_cases, right_hand_sides, slice_errors
from programs.with_exudyn import exudyn_cases
from programs.with_octave import Octave
from programs.with_scipy import Scipy


def wheel_bearing(quick: bool, rounds: int) -> dict[str, list[Row]]:
    """Run everything on the wheel bearing."""
    tolerances = [10.0**-k for k in (range(3, 7) if quick else range(3, 10))]
    sections: dict[str, list[Row]] = {}
    slices, nodes = Wheel({"fixed": 200}), Wheel({"fitted": 6})
    sections["slices"], fewest = slice_errors(rounds)
    show("Slices", sections["slices"])
    matched = Wheel(fewest)
    wheels = [slices, nodes, matched]

    print("\nfewest nodes that err no more than 200 slices:", matched.name)
    bearing = Bearing(slices.scene)
    along = slices.states(4)
    judge = Judge(slices, np.concatenate([along[::10], along[60:70]]))
    hold("numba", judge, [bearing(0.0, y) for y in judge.states])
    bearing.repeat(judge.states[0][None])  # compiles
    scipy_peer = Scipy(slices, bearing)
    _, confirmed = scipy_peer.run("DOP853", 1e-10, slices.cap / 3)
    print(f"reference of 200 slices from DOP853 at 1e-10: {relative(confirmed, slices.truth):.1e}")
    for wheel in wheels:
        print(f"reference of {wheel.name} from rtol 1e-9 at a fifth of the cap: {wheel.doubt:.1e}")
    sections["right-hand side"] = right_hand_sides(wheels, bearing, 5 * rounds)
    show("A right-hand side", sections["right-hand side"])

    cases = [case for wheel in wheels for case in our_cases(wheel, tolerances)]
    cases += scipy_peer.cases(tolerances)
    if shutil.which("octave-cli"):
        octave = Octave(scipy_peer)
        hold("octave", judge, octave.call(np.stack(judge.states), [], [])["derivatives"])
        cases += octave.cases([1e-4, 1e-5] if quick else [1e-3, 1e-4, 1e-5, 1e-6])
    else:
        print("octave: skipped, octave-cli is not installed")
    alternate(cases, rounds)
    ours = [wheel.name for wheel in wheels]
    peers = dict.fromkeys(case.peer for case in cases if case.peer not in ours)
    sections["run"] = compare(cases, [(peer, own) for own in ours for peer in peers])
    show("A run of 6 ms with an impact", sections["run"])
    return sections


def main() -> None:
    """Run all peers."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer settings and rounds")
    parser.add_argument("-o", "--output", type=Path, help="folder for peers.csv")
    given = parser.parse_args()
    quick = given.quick
    rounds = 3 if quick else 5
    about = machine()
    print(about)
    sections = wheel_bearing(quick, rounds)
    if importlib.util.find_spec("exudyn"):
        healthy = exudyn_cases(quick)
        alternate(healthy, rounds)
        pair = [("exudyn, healthy 6205", "ballrace, healthy 6205")]
        sections["healthy 6205"] = compare(healthy, pair)
        show("20 ms of the healthy 6205", sections["healthy 6205"])
    else:
        print("exudyn: skipped, the extra `validation` is not installed")
    if given.output is not None:
        write(given.output, sections, about)


if __name__ == "__main__":
    main()
