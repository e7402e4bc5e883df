"""Beside other programs, all in one run: what the same bearing costs them at the same error. For developers.

    python benches/peers.py --quick       # about two minutes on an idle core
    python benches/peers.py -o FOLDER     # everything; tables on the screen, and peers.csv in the folder

The scene is the preset ``wheel_bearing`` under 3 kN of thrust: two rows, an outer-race defect, friction.

1. *Slices*: what a number of slices or nodes costs and what it errs in the outer ring's acceleration, all three
   components, relative L2 over 6 ms from equilibrium with one impact, against 64 fitted nodes, integrated tightly.
   numba (`numba_bearing.py`) on 200 fixed slices, first held to ``Model.rhs``, and on 12 to 32 Gauss nodes along
   the zone, which is divided where a spall ends. Ours is timed as a run over its evaluations, the integrator's own
   work included.
2. *A run* of the same 6 ms at the same whole error, of contacts and steps together, against the same reference:
   Dormand and Prince's pair compiled with the right-hand side (`programs/dormand_prince.py`), SciPy's ``RK45`` and
   ``LSODA`` with it, Octave's ``ode45`` with a vectorised one (`octave_bearing.m`), ours on 4 to 24 fitted nodes,
   and ours as shipped. Tolerances are swept with the step free and capped at multiples of our cap: every program
   is taken at its best settings for an error.
3. *Exudyn* (extra ``validation``) on the healthy 6205 of ``tests/python/test_exudyn.py``, steps swept; each
   program against its own converged solution over 3 ms, and timed over 20 ms.

Tolerances are one number times a scale for each kind of state, the same for all: the approach of a loaded contact
for lengths, times the highest contact frequency for speeds. SciPy's and Octave's relative part is off, since 36 mm
of position say nothing about what error of it matters; with it on LSODA takes many times longer.

Times are processor times of one thread: on an idle machine wall time, and on a loaded one still comparable.
Peers alternate in rounds; a ratio is the median of the rounds' ratios, with their range. The time at an error is
interpolated on a program's front of error and cost; where all its settings do better, it is the cheapest one's.
Needs the extras ``bench`` and ``test``; what is not installed is skipped, and listed.
"""

from __future__ import annotations

import argparse
import importlib.metadata
import importlib.util
import shutil
import warnings
from pathlib import Path

import numpy as np

import ballrace as br
from programs.dormand_prince import DormandPrince, slice_errors
from programs.measuring import (
    Row,
    alternate,
    compare,
    machine,
    relative,
    settings_of,
    show,
    write,
)
from programs.wheel import (
    CONVERGED,
    SHIPPED,
    Judge,
    Wheel,
    hold,
    our_cases,
    problems,
    shipped,
)
from programs.with_exudyn import exudyn_cases
from programs.with_octave import Octave
from programs.with_scipy import Scipy

TARGETS = (5e-2, 1e-2, 3e-3)
OUR_NODES = (4, 6, 8, 12, 16, 24)
GAUSS_NODES = (12, 16, 24, 32)


def wheel_bearing(quick: bool, rounds: int) -> dict[str, list[Row]]:
    """Run everything on the wheel bearing."""
    tolerances = [10.0**-k for k in (range(3, 7) if quick else range(3, 8))]
    sections: dict[str, list[Row]] = {}
    slices, converged = Wheel({"fixed": 200}), Wheel(CONVERGED)
    others = problems(slices, converged, GAUSS_NODES)
    along = slices.states(4)
    judge = Judge(slices, np.concatenate([along[::10], along[60:70]]))
    hold("numba", judge, [others[0].bearing(0.0, y) for y in judge.states])
    truth = converged.truth
    print(f"reference from rtol 1e-9 at a fifth of the cap: {converged.doubt:.1e}")
    [fine] = problems(slices, converged, [64])[1:]
    _, confirmed = Scipy(fine).run("DOP853", 1e-9, converged.cap / 3)
    print(f"reference from DOP853 on 64 Gauss nodes in numba: {relative(confirmed, truth):.1e}")
    sections["slices"] = slice_errors(others, truth, rounds)
    show("Slices and nodes", sections["slices"])

    cases = [shipped(truth)]
    for nodes in OUR_NODES:
        cases += our_cases(Wheel({"fitted": nodes}), truth, tolerances)
    for problem in others:
        cases += DormandPrince(problem).cases(tolerances)
        cases += Scipy(problem).cases(tolerances[:2] if quick else tolerances)
    if shutil.which("octave-cli"):
        octave = Octave(others[0])
        hold("octave", judge, octave.call(np.stack(judge.states), [], [])["derivatives"])
        cases += octave.cases([1e-4, 1e-5] if quick else [1e-3, 1e-4, 1e-5, 1e-6])
    else:
        print("octave: skipped, octave-cli is not installed")
    alternate(cases, rounds)
    sections["settings"] = settings_of(cases)
    show("All settings of a run of 6 ms with an impact", sections["settings"])
    sections["run"] = compare(cases, "ballrace", TARGETS)
    sections["run"] += compare(cases, SHIPPED, [cases[0].error])
    show("The same at equal whole error", sections["run"])
    return sections


def main() -> None:
    """Run all peers."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--quick", action="store_true", help="fewer settings and rounds")
    parser.add_argument("-o", "--output", type=Path, help="folder for peers.csv")
    given = parser.parse_args()
    quick = given.quick
    rounds = 3 if quick else 5
    # Loose tolerances are tried too, and runs before a ball meets the spall.
    for kind in (br.AccuracyWarning, br.SceneWarning):
        warnings.simplefilter("ignore", kind)
    about = machine()
    print(about)
    sections = wheel_bearing(quick, rounds)
    if importlib.util.find_spec("exudyn"):
        healthy = exudyn_cases(quick)
        alternate(healthy, rounds)
        found = settings_of(healthy) + compare(healthy, "ballrace, healthy 6205", [1e-2])
        sections["healthy 6205"] = found
        show("20 ms of the healthy 6205", found)
    else:
        print("exudyn: skipped, the extra `validation` is not installed")
    if given.output is not None:
        write(given.output, sections, about)


if __name__ == "__main__":
    main()
