"""Train a small network on a simulated set of bearings and test it on measured records.

    python -m ballrace.learn.corpus FOLDER --bearings 64 --records 2 --seconds 2
    python benches/transfer_network.py FOLDER

The network (two hidden layers, some five thousand weights) sees windows of 12.5 turns as levels of lines in the
squared envelope's spectrum after cepstrum prewhitening: four harmonics of each part of the bearing with the
sidebands beside them, so that it is the same for all bearings. It is trained on the training bearings of the set,
five times, each without a fifth of them, by which weight decay and the bound of false alarms are chosen. Records
are those of ``transfer.py``, judged in the same way.
"""

from __future__ import annotations

import argparse
import warnings
from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import median_filter
from sklearn.neural_network import MLPClassifier
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import ballrace as br
from ballrace.learn.pieces import pieces_of
from transfer import accuracies, balanced
from transfer_models import Named, Record, by_model, measured

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

TURNS, FS = 12.5, 12_000.0
HARMONICS, LAGS = (1, 2, 3, 4), np.linspace(0.985, 1.015, 31)
SIDES = (-1.0, 0.0, 1.0)
HIDDEN, DECAYS = (64, 32), (1e-3, 1e-2, 1e-1, 1.0)
LABELS = {
    "normal": "healthy",
    "inner": "inner_race",
    "outer": "outer_race",
    "rolling_element": "ball",
}
PARTS = 4
# The plain line of each harmonic of a part; not those of the cage, which are last, and not the kurtosis.
HEIGHTS = [
    side == 0.0 and part < PARTS - 1
    for part in range(PARTS) for _ in HARMONICS for side in SIDES
] + [False]  # fmt: skip


def windows(channel: br.Channel, orders: br.frequencies.Orders) -> NDArray[np.float32]:
    """Return what the network sees of a record's windows, shape (windows, 49)."""
    seen = [levels(piece, orders) for piece in pieces_of(channel, TURNS, FS)]
    return np.array(seen, dtype=np.float32)


def levels(channel: br.Channel, orders: br.frequencies.Orders) -> NDArray[np.float64]:
    """Return levels by part, harmonic and sideband [dB], each within 1.5 %, and the logarithm of the kurtosis."""
    x = np.asarray(channel.x, dtype=float)
    white = br.spectra.prewhitened(x, channel.fs)
    f, value = br.spectra.squared_envelope_spectrum(white, channel.fs, None)
    shaft = channel.shaft or 0.0
    around = median_filter(value, int(4.0 * shaft / f[1]) | 1)
    level = 10.0 * np.log10(np.maximum(value / around, 1e-3))
    parts = (
        (orders.bpfo, orders.ftf), (orders.bpfi, 1.0), (2.0 * orders.bsf, orders.ftf), (orders.ftf, 1.0),
    )  # fmt: skip
    found = []
    for order, apart in parts:
        for k in HARMONICS:
            lines = (k * order * LAGS + np.array(SIDES)[:, np.newaxis] * apart) * shaft / f[1]
            at = np.clip(np.rint(lines).astype(int), 0, level.size - 1)
            found += level[at].max(axis=1).tolist()
    spread = x - x.mean()
    return np.array([*found, np.log(np.mean(spread**4) / np.mean(spread**2) ** 2)])


def simulated(
    folder: Path, split: str
) -> tuple[NDArray[np.float32], NDArray[np.str_], NDArray[np.str_]]:
    """Return the windows of the bearings of a part of a set, their classes and their bearings."""
    data = br.read_bearing_dataset(folder)
    inputs, classes, bearings = [], list[str](), list[str]()
    for row in data.metadata.iter_rows(named=True):
        if row["split"] != split:
            continue
        orders = br.catalogue[row["bearing_model"].split()[0]].orders
        seen = windows(data.channel(row["signal_id"]), orders)
        inputs.append(seen)
        classes += [LABELS[row["fault_type"]]] * len(seen)
        bearings += [row["bearing_id"]] * len(seen)
    return np.concatenate(inputs), np.array(classes), np.array(bearings)


def trained(
    X: NDArray[np.float32],
    y: NDArray[np.str_],
    bearings: NDArray[np.str_],
    false_alarm: float | None,
) -> br.learn.Diagnoser:
    """Return the networks whose weight decay does best on bearings that they have not seen."""
    found = []
    for decay in DECAYS:
        network = make_pipeline(
            StandardScaler(), MLPClassifier(HIDDEN, alpha=decay, max_iter=400, random_state=0)
        )
        model = br.learn.Diagnoser(classifier=network, false_alarm=false_alarm)
        found.append(model.fit(X, y, bearings))
    return max(found, key=lambda model: model.held_out_accuracy_)


def named(model: br.learn.Diagnoser, record: Record) -> Named:
    """Judge a measured record."""
    bearing = record.of.bearing
    orders = br.catalogue[bearing].orders if isinstance(bearing, str) else bearing
    return by_model(model, replace(record, X=windows(record.channel, orders)), HEIGHTS)


def table(found: Sequence[Named]) -> str:
    """Return a line a collection: accuracies as of ``transfer.py``, and what each class is called."""
    lines = []
    for collection in dict.fromkeys(one.record.of.collection for one in found):
        own = [one for one in found if one.record.of.collection == collection]
        called = Counter((one.record.truth, one.found) for one in own)
        text = ", ".join(f"{truth} {name} {n}" for (truth, name), n in sorted(called.items()))
        lines.append(f"| {collection} ({len(own)}) | {accuracies(own)} | {text} |")
    return "\n".join(lines)


def main() -> None:
    """Train, and print how the network does on bearings not seen and on measured records."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="set of ballrace.learn.corpus")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    learnt, (X, truth, _) = (simulated(options.folder, split) for split in ("train", "test"))
    records = measured(TURNS, FS)
    for false_alarm in (0.05, None):
        model = trained(*learnt, false_alarm)
        share = balanced(truth.tolist(), model.predict(X).tolist())
        print(
            f"\nFalse alarms bounded by {false_alarm}: windows of training bearings not seen "
            f"{model.held_out_accuracy_:.2f}, of test bearings {share:.2f}"
        )
        found = [named(model, record) for record in records]
        for title, forecast in (("not looked at", True), ("looked at", False)):
            own = [one for one in found if one.record.is_forecast is forecast]
            print(f"\nRecords {title}:\n{table(own)}")


if __name__ == "__main__":
    main()
