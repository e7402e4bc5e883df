"""The charts of speed against accuracy, as pictures (SVG) and tables (CSV).

    python benches/work_precision.py              # all of them, under 20 minutes on two cores
    python benches/work_precision.py --quick      # coarser, two minutes
    python benches/work_precision.py --only methods --draw    # a picture from its table

Wants the extra ``bench``. What they say stands in ``benches/README.md``.
"""

from __future__ import annotations

import argparse
import csv
import time
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any

import ballrace as br
from precision import contact, features, knobs, methods, pits, signals

if TYPE_CHECKING:
    from collections.abc import Iterable

CHARTS = {chart.NAME: chart for chart in (contact, signals, methods, features, knobs, pits)}


def write(rows: list[dict[str, Any]], path: Path) -> None:
    """Write a table."""
    with path.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        for row in rows:
            table.writerow({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in row.items()})


def read(path: Path) -> list[dict[str, Any]]:
    """Read a table back."""
    with path.open(newline="", encoding="utf-8") as file:
        return [{k: value(v) for k, v in row.items()} for row in csv.DictReader(file)]


def value(text: str) -> Any:
    """Return a number where it is one."""
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def make(names: Iterable[str], folder: Path, *, quick: bool, redraw: bool) -> None:
    """Measure and draw."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        begun = time.perf_counter()
        table = folder / f"{name}.csv"
        if not redraw:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", br.AccuracyWarning)
                write(CHARTS[name].measure(quick=quick), table)
        rows = read(table)
        CHARTS[name].draw_chart(rows, folder / f"{name}.svg")
        if name == "methods":
            for cost in ("evaluations", "wall_ms"):
                print(*methods.cheapest(rows, cost), sep="\n")
        if name == "pits":
            print(*pits.cheapest(rows), sep="\n")
        print(f"{name}: {len(rows)} rows, {time.perf_counter() - begun:.0f} s", flush=True)


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", "--output", type=Path, default=Path(__file__).parent / "charts")
    parser.add_argument("--quick", action="store_true", help="coarser, in two minutes")
    parser.add_argument("--only", nargs="+", choices=CHARTS, default=list(CHARTS))
    parser.add_argument("--draw", action="store_true", help="draw from the tables there are")
    options = parser.parse_args()
    make(options.only, options.output, quick=options.quick, redraw=options.draw)


if __name__ == "__main__":
    main()
