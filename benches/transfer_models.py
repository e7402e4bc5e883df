"""Models of simulated and of measured records, and what they say of measured ones, for ``transfer.py``."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from sklearn.ensemble import ExtraTreesClassifier
from sklearn.linear_model import LogisticRegression
from sklearn.metrics import balanced_accuracy_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import ballrace as br
import verdict_measured
from ballrace.learn.pieces import pieces_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

    Machines = dict[str, br.measuring.Chain]
    Features = NDArray[np.float32]

MACHINES = 60
STANDARD_GRAVITY = 9.80665

LOADS: dict[str, Any] = {"radial_load": (100.0, 800.0), "axial_load": (-150.0, 150.0)}
SPEED, WINDOW = (800.0, 1800.0), 0.75
"""Speeds that measured records of the page have [1/min]; length of a simulated one, ten turns and more [s]."""
RECIPES = {
    "whole": br.learn.Recipe("6205", speed_rpm=SPEED, **LOADS),
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
CLASSES = ("healthy", "inner_race", "outer_race", "ball")
CHOSEN_BY = ("97", "105", "130", "209", "234")
"""Records of CWRU by which defaults of scenes or features were chosen, as by all of HIT-SM."""
BETRAYING = ("97", "105", "130")
"""Records of CWRU that are compared with simulated ones, beside those of HIT-SM."""


@dataclass(frozen=True, eq=False)
class Record:
    """A measured record with its class, and the features of its pieces, shape (pieces, features)."""

    of: verdict_measured.Record
    truth: str
    channel: br.Channel
    X: Features

    @property
    def is_forecast(self) -> bool:
        """Fitness of the record as a forecast: whether nothing was chosen by it."""
        return self.of.collection != "HIT-SM" and self.of.name not in CHOSEN_BY


def measured(turns: float, fs: float) -> list[Record]:
    """Return the measured records that are there, in pieces as long as simulated records."""
    return [record_of(each, turns, fs) for each in verdict_measured.records()]


def record_of(of: verdict_measured.Record, turns: float, fs: float) -> Record:
    """Return a record at its true speed."""
    rate = of.nominal * verdict_measured.SPEEDS.get(of.name, 1.0) / 60.0
    channel = br.Channel(x=of.x, fs=of.fs, shaft=rate)
    lines = br.learn.EnvelopeLines(of.bearing)
    X = lines.fit_transform(pieces_of(channel, turns, fs)).astype(np.float32)
    return Record(of, of.part or "healthy", channel, X)


def chains(of: Callable[[br.measuring.Machine], br.measuring.Machine], seed: int = 1) -> Machines:
    """Return the machines, with something changed."""
    drawn = br.measuring.random_chains(MACHINES, seed=seed)
    return {name: replace(one, machine=of(one.machine)) for name, one in drawn.items()}  # type: ignore[arg-type]


PLAIN = chains(lambda machine: machine)
WHOLE = "the whole recipe"
VARIANTS: dict[str, tuple[str, Machines]] = {
    WHOLE: ("whole", PLAIN),
    "without modulation of the noise": (
        "whole",
        chains(lambda m: replace(m, modulation=(), wander=0.0)),
    ),
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
        window=WINDOW,
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
    ways = (WHOLE, "trained on a 6306"), ("trained on a 6306", WHOLE)
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
class Named:
    """Judgement of a record: a class, those of its windows, and whether it shows lines of a fault."""

    record: Record
    found: str
    windows: tuple[str, ...]
    shown: bool = True


def by_model(model: br.learn.Diagnoser, record: Record, heights: list[bool] | None = None) -> Named:
    """Judge a record by a model, as its ``diagnose`` does, from features of which some are heights of lines."""
    found = model._judged(record.X, heights or [name.endswith(".height") for name in names()])
    windows = tuple(map(str, model.predict(record.X)))
    return Named(record, found.verdict, windows, found.shows_lines)


@functools.cache
def names() -> tuple[str, ...]:
    """Return the names of the features."""
    lines = br.learn.EnvelopeLines("6205").fit([br.Channel(x=np.zeros(10), fs=1.0, shaft=1.0)])
    return tuple(map(str, lines.get_feature_names_out()))


def by_verdict(record: Record) -> Named:
    """Judge a record, and pieces of 25 turns, by the verdict, which learns nothing."""
    x = record.of.x * (STANDARD_GRAVITY if record.of.unit == "g" else 1.0)
    unit = None if record.of.unit is None else "m/s^2"
    channel = replace(record.channel, x=x, unit=unit)
    pieces = pieces_of(channel, 25.0, 1e6)
    return Named(record, verdict_of(channel, record), tuple(verdict_of(p, record) for p in pieces))


def verdict_of(channel: br.Channel, of: Record) -> str:
    """Return the class that the verdict names."""
    found = br.diagnose(channel, of.of.bearing)
    return found.verdict if found.verdict != "damaged" else "+".join(found.parts)


def by_measured(
    records: Sequence[Record], classifier: Any, apart: Callable[[Record], str]
) -> Iterator[Named]:
    """Judge each record by a model that has learnt from all measured ones but those that are of a kind with it."""
    for kind in dict.fromkeys(map(apart, records)):
        train = [one for one in records if apart(one) != kind]
        model = trained(train, classifier)
        for record in records:
            if apart(record) == kind:
                yield by_model(model, record)


def by_other_sizes(records: Sequence[Record], classifier: Any) -> Iterator[Named]:
    """Judge the damaged records of a collection by those of other sizes; healthy ones by its first halves.

    Damage of one size is left out. There is one healthy machine a collection, half of which is learnt.
    """
    for collection in dict.fromkeys(one.of.collection for one in records):
        own = [one for one in records if one.of.collection == collection]
        sizes = dict.fromkeys(map(size_of, (one for one in own if one.of.part)))
        healthy = [halves(one) for one in own if not one.of.part]
        if len(sizes) < 2 or not healthy:
            continue
        for k, size in enumerate(sizes):
            train = [one for one in own if one.of.part and size_of(one) != size]
            model = trained([*train, *(first for first, _ in healthy)], classifier)
            learnt = {one.truth for one in train}
            asked = [one for one in own if size_of(one) == size and one.truth in learnt]
            second = [later for _, later in healthy if k == 0 and asked]
            for record in [*asked, *second]:
                yield by_model(model, record)


def halves(record: Record) -> tuple[Record, Record]:
    """Return a record's first pieces, and the others."""
    middle = len(record.X) // 2
    return replace(record, X=record.X[:middle]), replace(record, X=record.X[middle:])


def size_of(record: Record) -> str:
    """Return the size of a record's damage as its group has it."""
    return record.of.group.rpartition(", ")[2]


def trained(records: Iterable[Record], classifier: Any) -> br.learn.Diagnoser:
    """Return a model of measured records."""
    records = list(records)
    y = np.concatenate([[one.truth] * len(one.X) for one in records])
    model = br.learn.Diagnoser(classifier=classifier, false_alarm=None)
    return model.fit(np.concatenate([one.X for one in records]), y)


def ways(
    folder: Path, per_class: int, records: Sequence[Record], best: str
) -> dict[str, list[Named]]:
    """Return what each way says of the records."""
    found: dict[str, list[Named]] = {}
    for variant in VARIANTS:
        X, y, groups = features(folder, variant, per_class)
        for name in CLASSIFIERS if variant == WHOLE else (best,):
            model = br.learn.Diagnoser(classifier=CLASSIFIERS[name]).fit(X, y, groups)
            told = variant if name == best else f"{variant}, {name}"
            found[told] = [by_model(model, record) for record in records]
    X, y, groups = features(folder, WHOLE, per_class)
    races = np.asarray(y) != "ball"
    model = br.learn.Diagnoser(classifier=CLASSIFIERS[best])
    model.fit(np.asarray(X)[races], np.asarray(y)[races], np.asarray(groups)[races])
    found["without the class ball"] = [by_model(model, record) for record in records]
    return found
