"""Worth of each condition of a verdict: verdicts on known records with one left out at a time.

    python benches/verdict_gates.py [--runs FOLDER] [--count N] [-o TABLE]

takes a record of each of the first runs of ``verdict_library.py``, judged with its unit by a fit to the other
bearings, and the records of ``verdict_measured.py``, judged by the fit that is shipped, with a unit where one is
known. Each record is examined once. A line is a condition that is left out, with what then changes of five counts:
healthy records called damaged, and healthy; damaged records whose damage is named, where a sound part is named,
and that are called healthy.
"""

from __future__ import annotations

import argparse
import csv
import multiprocessing
import os
import tempfile
import warnings
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any
from unittest import mock

import ballrace as br
import verdict_library
import verdict_measured
from ballrace.diagnosis import likelihood, procedure, strength, verdict
from ballrace.diagnosis.null import ACCUSED
from verdict_cases import case
from verdict_fit import regression

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from ballrace.diagnosis.verdict import Verdict

    Asked = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class Judged:
    """Arguments from which a verdict on a record is decided, and what is damaged."""

    source: str
    parts: frozenset[str]
    asked: Asked


@dataclass(frozen=True, kw_only=True)
class Gate:
    """A condition of a verdict: constants, by module and name, or arguments without which it is left out."""

    name: str
    constants: tuple[tuple[Any, str, Any], ...] = ()
    changed: Callable[[Asked], Asked] = dict


def without(*begins: str) -> Callable[[Asked], Asked]:
    """Return a change of arguments by which a record lacks nothing whose words begin so."""

    def changed(asked: Asked) -> Asked:
        kept = [each for each in asked["wanting"] if not any(word in each for word in begins)]
        return asked | {"wanting": kept}

    return changed


def seen(asked: Asked) -> Asked:
    """Return arguments of a record in which nothing is hidden by the shaft."""
    evidence = {part: replace(one, hidden=0.0) for part, one in asked["evidence"].items()}
    return asked | {"evidence": evidence}


GATES = (
    Gate(name="(all conditions)"),
    Gate(name="lines are deep", constants=((strength, "SHALLOW", 0.0),)),
    Gate(name="lines are no sine's", constants=((strength, "_OVERTONES", 0.0),)),
    Gate(name="lines hold enough of the variance", constants=((verdict, "EXPLAINED", 0.0),)),
    Gate(name="impacts stand out", constants=((strength, "_SMOOTH", 0.0),)),
    Gate(name="not tiny", constants=((verdict, "_TINY", 0.0), (verdict, "_TINY_LOOSE", ()))),
    Gate(name="limits where balls fall", constants=((verdict, "_TINY_LOOSE", ()),)),
    Gate(name="limits beyond the sizes", constants=((verdict, "_BEYOND", 1.0),)),
    Gate(name="limits of what rings", constants=((verdict, "_RINGING", 1.0),)),
    Gate(name="falling balls without a unit", changed=lambda asked: asked | {"falls": False}),
    Gate(name="one race's lines beside the other's", constants=((verdict, "_BESIDE", 0.0),)),
    Gate(name="bursts name a ball", changed=lambda asked: asked | {"bursts": None}),
    Gate(name="the ratio names what is weak", constants=((verdict, "UNLIKELY", 0.0),)),
    Gate(name="doubted lines clear nothing", constants=((verdict, "_DOUBT", 1.0),)),
    Gate(name="lines under the shaft's clear nothing", changed=seen),
    Gate(name="damage would stand out", changed=lambda asked: asked | {"seen": asked["seen"] or "all"}),
    Gate(name="not clipped", changed=without("clipped")),
    Gate(name="the band is wide", changed=without("wider band")),
    Gate(name="no impacts at other rates", changed=without("impacts stand out")),
    Gate(name="turns separate race and shaft", changed=without("too near")),
    Gate(name="the speed is sure", changed=without("no clear lines of a shaft")),
)  # fmt: skip


def kept(
    source: str, parts: Iterable[str], record: Any, *given: Any, **options: Any
) -> Judged | None:
    """Return what the verdict on a record is decided from; None where it lacks what any verdict needs."""
    asked: list[Asked] = []

    def decided(evidence: Any, false_alarm: float, **others: Any) -> Verdict:
        asked.append({"evidence": evidence, "false_alarm": false_alarm, **others})
        return verdict.decided(evidence, false_alarm, **others)

    with mock.patch.object(procedure, "decided", decided):
        br.diagnose(record, *given, **options)
    return Judged(source=source, parts=frozenset(parts), asked=asked[0]) if asked else None


def simulated(number: int, folder: Path) -> Judged | None:
    """Return what the verdict on the first record of a run of the library rests on; None of one that fails."""
    warnings.simplefilter("ignore")
    of = case(number)
    try:
        x = verdict_library.run(of, folder)
    except br.BallraceError:
        return None
    record = verdict_library.recorded(of, x, 0).channel
    others = {"ratio": ratios_without(of.bearing.designation)}
    with mock.patch.object(likelihood, "fit", return_value=others):
        return kept("simulated", of.parts, record, verdict_library.promised(of), of.rpm)


def ratios_without(bearing: str) -> dict[str, Any]:
    """Return the regressions of all parts over the library without a bearing."""
    return {
        part: {
            "sized": regression(part, True, bearing), "unsized": regression(part, False, bearing)
        }
        for part in ACCUSED
    }  # fmt: skip


def measured(of: verdict_measured.Record) -> Judged | None:
    """Return what the verdict on a measured record is decided from."""
    warnings.simplefilter("ignore")
    parts = () if of.part is None else (of.part,)
    return kept(of.collection, parts, of.x, of.bearing, of.nominal, fs=of.fs, unit=of.unit)


def again(of: Judged, gate: Gate) -> Verdict:
    """Return the verdict on a record without a condition."""
    with ExitStack() as stack:
        for module, name, value in gate.constants:
            stack.enter_context(mock.patch.object(module, name, value))
        asked = gate.changed(of.asked)
        evidence, false_alarm = asked.pop("evidence"), asked.pop("false_alarm")
        return verdict.decided(evidence, false_alarm, **asked)


Counts = dict[str, int]
"""Numbers of verdicts by their kind."""


def counts(of: Sequence[Judged], found: Sequence[Verdict]) -> Counts:
    """Return how many healthy records are accused or called healthy, damaged ones named, mistaken or cleared."""
    both = list(zip(of, found, strict=True))
    sound = [one for each, one in both if not each.parts]
    damaged = [(each.parts, set(one.parts), one.verdict) for each, one in both if each.parts]
    return {
        "accused": sum(one.verdict == "damaged" for one in sound),
        "called healthy": sum(one.verdict == "healthy" for one in sound),
        "named": sum(bool(named) and named <= parts for parts, named, _ in damaged),
        "a sound part named": sum(bool(named - parts) for parts, named, _ in damaged),
        "cleared": sum(verdict == "healthy" for _, _, verdict in damaged),
    }


def lines(of: Sequence[Judged]) -> Iterator[tuple[str, Gate, Counts, Counts]]:
    """Yield a line a source and a condition: what the counts are without it, and how much more that is."""
    for source in dict.fromkeys(each.source for each in of):
        own = [each for each in of if each.source == source]
        whole = counts(own, [again(each, GATES[0]) for each in own])
        for gate in GATES:
            left = counts(own, [again(each, gate) for each in own])
            yield source, gate, left, {name: left[name] - whole[name] for name in whole}


def judged(folder: Path, count: int) -> list[Judged]:
    """Return what the verdicts on all records are decided from, examined on all cores."""
    started = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(os.cpu_count(), mp_context=started) as pool:
        runs = list(pool.map(partial(simulated, folder=folder), range(count)))
        found = list(pool.map(measured, verdict_measured.records()))
    return [each for each in (*runs, *found) if each is not None]


def main() -> None:
    """Print what each condition is worth, and write it where asked."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=Path, metavar="FOLDER", help="where runs are kept")
    parser.add_argument(
        "--count", type=int, default=verdict_library.COUNT, help="runs (default: all)"
    )
    parser.add_argument("-o", "--output", type=Path, metavar="TABLE", help="all counts, as CSV")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.runs or Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        found = list(lines(judged(folder, options.count)))
    for source, gate, left, more in found:
        told = left if gate is GATES[0] else {name: f"{by:+d}" for name, by in more.items() if by}
        text = ", ".join(f"{name} {number}" for name, number in told.items()) or "nothing"
        print(f"{source} | {gate.name} | {text}")
    if options.output is not None:
        with options.output.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["source", "without", *found[0][2]])
            writer.writerows([source, gate.name, *left.values()] for source, gate, left, _ in found)


if __name__ == "__main__":
    main()
