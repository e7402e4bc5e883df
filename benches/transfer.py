"""Train on simulated records alone and test on measured ones; writes benches/transfer.md.

    python benches/transfer.py [--runs FOLDER] [--per-class 48] [--domain] [-o FILE]

Records of HIT-SM (21) and CWRU (3) are looked for in the folders ``hit-sm`` and ``cwru`` of $BALLRACE_DATA, by
default ``../shared/data`` beside the project. Four sets are simulated: the whole recipe, smooth surfaces, equal
balls, another bearing. The classifier is chosen on simulated records of the other bearing and other machines.
With a folder the runs are kept there, and those that are there are not simulated anew.
"""

from __future__ import annotations

import argparse
import functools
import os
import tempfile
import time
import warnings
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from sklearn.ensemble import ExtraTreesClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import balanced_accuracy_score, recall_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import ballrace as br
from ballrace.learn.domain import compared, marks_of
from ballrace.learn.pieces import pieces_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from numpy.typing import NDArray

    Machines = dict[str, br.measuring.Chain]

ROOT = Path(__file__).parents[1]
DATA = Path(os.environ.get("BALLRACE_DATA") or ROOT.parent / "shared" / "data")
LOOKS = 2
"""How often results of measured records have been looked at while settings could still be changed."""

LOADS: dict[str, Any] = {"radial_load": (100.0, 800.0), "axial_load": (-150.0, 150.0)}
SPEED = (1200.0, 1800.0)
RECIPES = {
    "whole": br.learn.Recipe("6205", speed_rpm=SPEED, **LOADS),
    "smooth": br.learn.Recipe("6205", speed_rpm=SPEED, surfaces="smooth", **LOADS),
    "even": br.learn.Recipe("6205", speed_rpm=SPEED, slip=None, **LOADS),
    "other": br.learn.Recipe(
        "6306", speed_rpm=SPEED, radial_load=(200.0, 1600.0), axial_load=(-300.0, 300.0)
    ),
}
CLASSIFIERS: dict[str, Any] = {
    "boosted trees": None,
    "extremely random trees": ExtraTreesClassifier(
        300, class_weight="balanced", min_samples_leaf=2, random_state=0
    ),
    "linear": make_pipeline(
        StandardScaler(), LogisticRegression(class_weight="balanced", max_iter=2000)
    ),
}
WAYS = (
    "6205, bearings not seen", "6306 on other machines", "trained on a 6306, bearings not seen",
    "6205 on other machines",
)  # fmt: skip
PRESENT = ("healthy", "inner_race", "outer_race")
"""Classes of the measured records."""


@dataclass(frozen=True)
class Record:
    """A measured record with its class."""

    name: str
    truth: str
    channel: br.Channel

    @property
    def source(self) -> str:
        """Return the name of its set."""
        return "CWRU" if self.name.isdigit() else "HIT-SM"


def measured() -> Iterator[Record]:
    """Yield the measured records that are there."""
    kinds = {"Normal": "healthy", "IR": "inner_race", "OR": "outer_race"}
    for path in sorted((DATA / "hit-sm").glob("*.mat")):
        kind, _, rpm = path.stem.partition("_")
        truth = kinds[kind.rstrip("258")]
        yield Record(path.stem, truth, channel(path, 51_200.0, float(rpm), None))
    known = {
        "97": (48_000.0, "healthy"),
        "105": (12_000.0, "inner_race"),
        "130": (12_000.0, "outer_race"),
    }
    for path in sorted((DATA / "cwru").glob("*.mat")):
        if path.stem in known:
            fs, truth = known[path.stem]
            yield Record(path.stem, truth, channel(path, fs, 1797.0, "DE"))


def channel(path: Path, fs: float, rpm: float, column: str | None) -> br.Channel:
    """Return a signal of a file that is sampled and turns at known rates."""
    return replace(br.read(path, fs=fs).channel(column), shaft=rpm / 60.0)


def chains(of: Callable[[br.measuring.Machine], br.measuring.Machine], seed: int = 1) -> Machines:
    """Return the machines, with something changed."""
    drawn = br.measuring.random_chains(60, seed=seed)
    return {name: replace(one, machine=of(one.machine)) for name, one in drawn.items()}  # type: ignore[arg-type]


PLAIN = chains(lambda machine: machine)
VARIANTS: dict[str, tuple[str, Machines]] = {
    "the whole recipe": ("whole", PLAIN),
    "without texture": ("smooth", PLAIN),
    "without modulation of the noise": (
        "whole",
        chains(lambda m: replace(m, modulation=(), wander=0.0)),
    ),
    "without jitter: equal balls": ("even", PLAIN),
    "without tones": ("whole", chains(lambda m: replace(m, shaft=(), mains=()))),
    "without the path: the pedestal": (
        "whole",
        {name: replace(one, path=None) for name, one in PLAIN.items()},
    ),
    "trained on a 6306": ("other", PLAIN),
}


@functools.cache
def simulated(folder: Path, variant: str, per_class: int) -> br.learn.Simulated:
    """Return the records of a variant."""
    name, machines = VARIANTS[variant]
    return br.learn.dataset(
        RECIPES[name],
        folder / name,
        per_class=per_class,
        machines=machines,
        threads=1,
        progress=False,
    )


@functools.cache
def features(folder: Path, variant: str, per_class: int, seed: int = 1) -> tuple[Any, Any, Any]:
    """Return the features of a variant, as measured at its machines, or by others."""
    data = simulated(folder, variant, per_class)
    if seed != 1:
        machines = logged(chains(lambda machine: machine, seed), data.fs)
        data = replace(data, chains=machines)
    return data.features()


def logged(machines: Machines, fs: float) -> Machines:
    """Return machines that log at a rate."""
    loggers = {name: one.logger or br.measuring.Logger() for name, one in machines.items()}
    return {
        name: replace(one, logger=replace(loggers[name], fs=fs)) for name, one in machines.items()
    }


def held_out(folder: Path, per_class: int) -> dict[str, list[float]]:
    """Return by classifier the accuracies on bearings not seen and on another one, trained on either bearing."""
    ways = ("the whole recipe", "trained on a 6306"), ("trained on a 6306", "the whole recipe")
    found = {}
    for name, classifier in CLASSIFIERS.items():
        accuracies = []
        for ours, others in ways:
            model = br.learn.Diagnoser(classifier=classifier)
            model.fit(*features(folder, ours, per_class))
            X, truth, _ = features(folder, others, per_class, 2)
            accuracies += [
                model.held_out_accuracy_,
                balanced_accuracy_score(truth, model.predict(X)),
            ]
        found[name] = accuracies
    return found


@dataclass(frozen=True)
class Tested:
    """What a model, or the verdict, says of the measured records."""

    truth: list[str]
    found: list[str]
    of_windows: list[str]
    windows: list[str]
    sources: list[str]
    shown: list[bool]

    def accuracy(self, source: str | None = None) -> float:
        """Return the balanced accuracy by record, of all or of a set."""
        chosen = [k for k, s in enumerate(self.sources) if source in (None, s)]
        return balanced([self.truth[k] for k in chosen], [self.found[k] for k in chosen])

    def of_shown(self) -> float:
        """Return the balanced accuracy of healthy records and of those that show lines."""
        chosen = [k for k, shown in enumerate(self.shown) if shown or self.truth[k] == "healthy"]
        return balanced([self.truth[k] for k in chosen], [self.found[k] for k in chosen])

    def accused(self) -> float:
        """Return the share of healthy windows that are called damaged."""
        healthy = [f for f, t in zip(self.windows, self.of_windows, strict=True) if t == "healthy"]
        return float(np.mean([found in ("inner_race", "outer_race", "ball") for found in healthy]))


def balanced(truth: list[str], found: list[str]) -> float:
    """Return the mean of the classes' shares that are named rightly."""
    return float(np.mean(per_class_of(truth, found)))


def per_class_of(truth: list[str], found: list[str]) -> NDArray[np.float64]:
    """Return the share of each class that is named rightly."""
    there = [name for name in PRESENT if name in truth]
    return np.asarray(recall_score(truth, found, labels=there, average=None, zero_division=0.0))


def tested(model: br.learn.Diagnoser, records: list[Record]) -> Tested:
    """Judge all records and their windows by a model."""
    judged = [model.diagnose(record.channel, "6205") for record in records]
    windows = [name for one in judged for name, count in one.votes.items() for _ in range(count)]
    counts = [sum(one.votes.values()) for one in judged]
    of_windows = [r.truth for r, count in zip(records, counts, strict=True) for _ in range(count)]
    return Tested(
        [r.truth for r in records], [one.verdict for one in judged], of_windows, windows,
        [r.source for r in records], [one.shows_lines for one in judged],
    )  # fmt: skip


def by_verdict(records: list[Record]) -> Tested:
    """Judge all records, and pieces of 25 turns, by the verdict, which learns nothing."""
    found = [verdict_of(record.channel) for record in records]
    pieces = [(r.truth, verdict_of(p)) for r in records for p in pieces_of(r.channel, 25.0, 1e6)]
    of_windows, windows = map(list, zip(*pieces, strict=True))
    sources = [r.source for r in records]
    return Tested(
        [r.truth for r in records], found, of_windows, windows, sources, [True] * len(records)
    )


def verdict_of(record: br.Channel) -> str:
    """Return the class that the verdict names."""
    found = br.diagnose(record, "6205")
    return found.verdict if found.verdict != "damaged" else "+".join(found.parts)


def row(name: str, found: Tested) -> str:
    """Return a line of the table."""
    by_window = per_class_of(found.of_windows, found.windows)
    by_record = per_class_of(found.truth, found.found)
    shown = sum(found.shown)
    cells = [
        f"{found.accuracy():.2f}", f"{found.accuracy('HIT-SM'):.2f}", f"{found.accuracy('CWRU'):.2f}",
        f"{found.of_shown():.2f} ({shown})", " ".join(f"{value:.2f}" for value in by_record),
        f"{by_window.mean():.2f}", " ".join(f"{value:.2f}" for value in by_window),
        f"{100.0 * found.accused():.0f} %",
    ]  # fmt: skip
    return f"| {name} | {' | '.join(cells)} |"


COLUMNS = (
    "", "by record", "HIT-SM", "CWRU", "that show lines", "each class", "by window", "each class",
    "healthy windows accused",
)  # fmt: skip
HEAD = f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}"


def domain(data: br.learn.Simulated, records: list[Record]) -> str:
    """Return how well simulated and measured records of each class can be separated, and by what."""
    lines, rows = br.learn.EnvelopeLines("6205"), list[str]()
    alone: dict[str, list[list[float]]] = {}
    labels, bearings = (data.windows[name].to_numpy() for name in ("label", "bearing_id"))
    names, ours = marks_of(list(data.channels()), lines)
    for truth in PRESENT:
        mine = [(k, r) for k, r in enumerate(records) if r.truth == truth]
        cut = [(k, piece) for k, r in mine for piece in pieces_of(r.channel, data.turns, data.fs)]
        _, theirs = marks_of([piece for _, piece in cut], lines)
        runs = np.array([k for k, _ in cut])
        found = compared(names, ours[labels == truth], theirs, bearings[labels == truth], runs)
        rows.append(
            f"| {truth.replace('_', ' ')} | {found.auc:.3f} | {found.auc_without_path:.3f} |"
        )
        for name, *numbers in found.features.select(
            "feature", "auc", "simulated", "measured"
        ).iter_rows():
            alone.setdefault(name, []).append(numbers)
    worst = sorted(alone, key=lambda name: -np.mean([numbers[0] for numbers in alone[name]]))[:10]
    table = [
        f"| {name} | {' | '.join(f'{a:.2f}: {s:.3g}, {m:.3g}' for a, s, m in alone[name])} |"
        for name in worst
    ]
    return "\n".join([
        "| class | AUC | without the path |", "|---|---|---|", *rows, "",
        f"| the ten features that differ most | {' | '.join(name.replace('_', ' ') for name in PRESENT)} |",
        "|---|---|---|---|", *table,
    ])  # fmt: skip


PAGE = """# Transfer: trained on simulated records, tested on measured ones

Made by `python benches/transfer.py` on {day}, with what the changelog has after {version}.
No model is trained on measured records; results of measured records were inspected {looks} while settings could
still be changed: once of a model of three runs per class, once before false alarms were bounded. The classifier is
chosen on simulated records: bearings not seen, and another bearing on other machines.

{sizes}

## Choice on simulated records

Balanced accuracy of four classes (healthy, outer race, inner race, ball), by window.

{choice}

## On measured records

{count} records of 6205 on two rigs (HIT-SM 21 at 600 to 1200 1/min, CWRU 97, 105, 130),
windows of 12.5 turns. Accuracies are balanced over the three classes of these records, healthy, inner race and
outer race, in this order; `ball` and `shows no lines` are wrong answers. Records "that show lines" (their
number) are the healthy ones and those with lines above those of 95 % of simulated healthy ones.

{table}

Pieces of the verdict without training have 25 turns; of the whole recipe, by classifier:

{others}

## How simulated records differ from measured ones

Area under the curve of a random forest that separates simulated from measured windows of one class, on records and
bearings not seen; and without the shape of the spectrum, which housing and machine determine. Then the features
with the largest areas of their own: area: median of simulated, of measured windows.

{domain}
"""


def report(folder: Path, per_class: int, records: list[Record]) -> str:
    """Return the page."""
    begun = time.process_time()
    choice = held_out(folder, per_class)
    best = max(choice, key=lambda name: np.mean(choice[name]))
    rows, others = list[str](), list[str]()
    for variant in VARIANTS:
        X, y, groups = features(folder, variant, per_class)
        for name in CLASSIFIERS if variant == "the whole recipe" else (best,):
            model = br.learn.Diagnoser(classifier=CLASSIFIERS[name]).fit(X, y, groups)
            line = row(variant if name == best else name, tested(model, records))
            (rows if name == best else others).append(line)
            print(line, flush=True)
    rows.append(row("verdict without training", by_verdict(records)))
    data = simulated(folder, "the whole recipe", per_class)
    chosen = "\n".join(
        f"| {name}{' (chosen)' if name == best else ''} | {' | '.join(f'{share:.3f}' for share in shares)} |"
        for name, shares in choice.items()
    )
    betrayed = domain(data, records)
    sizes = (
        f"{per_class} runs of each of 4 classes and 4 sets, each measured on {data.per_case} of 60 machines; "
        f"{(time.process_time() - begun) / 60.0:.0f} minutes of one core, and 16 for runs where none were kept."
    )
    looks = "once" if LOOKS == 1 else f"{LOOKS} times"
    return PAGE.format(
        looks=looks, sizes=sizes, day=time.strftime("%Y-%m-%d"), version=br.__version__,
        count=len(records), table="\n".join([HEAD, *rows]),
        others="\n".join([HEAD, *others]), domain=betrayed,
        choice=f"| classifier | {' | '.join(WAYS)} |\n|{'---|' * 5}\n{chosen}",
    )  # fmt: skip


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=Path, metavar="FOLDER", help="where runs are kept")
    parser.add_argument(
        "--per-class", type=int, default=48, help="runs of each class (default: %(default)s)"
    )
    parser.add_argument(
        "--domain",
        action="store_true",
        help="print only how simulated records differ from measured ones",
    )
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "benches" / "transfer.md")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    records = list(measured())
    if not records:
        parser.error(f"no records in {DATA}: set BALLRACE_DATA")
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.runs or Path(temporary)
        if options.domain:
            print(domain(simulated(folder, "the whole recipe", options.per_class), records))
            return
        page = report(folder, options.per_class, records)
    options.output.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
