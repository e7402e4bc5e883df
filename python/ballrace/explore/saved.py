"""Files that are saved: the scene, a report of the run, a notebook that does both again."""

from __future__ import annotations

import json
import re
import tempfile
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from .._base.text import printable
from .running import FS

if TYPE_CHECKING:
    from ..scene import Scene
    from ..signals import Signals


def scene_file(scene: Scene) -> bytes:
    """Return a scene as TOML, which ``ballrace run`` and ``ballrace explore`` read."""
    return scene.to_toml(comments=True).encode()


def report(out: Signals) -> bytes:
    """Return the report of a run as a page."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "report.html"
        out.report(path)
        return path.read_bytes()


def notebook(scene: Scene, duration: float, noise: float) -> bytes:
    """Return a notebook of Jupyter that has the scene in it and does again what the page does.

    It has the simulated time [s] and the root mean square of the sensor's noise [m/s²] in it, too.
    """
    density = noise**2 / (0.5 * FS)
    name = scene.name or "A bearing"
    cells = [
        ("markdown", f"# {_worded(name)}\n\nA bearing at rest, a run of it, and its envelope."),
        ("code", f"import ballrace as br\n\nscene = br.Scene.from_toml({_quoted(scene)})\nscene"),
        ("code", "br.equilibrium(scene)"),
        ("code", "br.stiffness(scene), br.rating_life(scene)"),
        ("code", f"out = br.simulate(scene, duration={duration!r}, fs={FS!r}, progress=True)\nout"),
        (
            "code",
            "chain = br.measuring.Chain(\n"
            f"    logger=br.measuring.Logger(noise_density={density!r})\n)\n"
            "record = br.measure(out, chain, seed=1)\nrecord",
        ),
        ("code", "br.plot.envelope_spectrum(record)"),
    ]
    written = {
        "cells": [_cell(kind, text, place) for place, (kind, text) in enumerate(cells)],
        "metadata": {"language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(written, indent=1, ensure_ascii=False).encode()


def _worded(text: str) -> str:
    """Return a text that Markdown shows as it is, in one line: no markup, no link, no picture."""
    return re.sub(r"([\\`*_{}\[\]()#+\-.!|~$])", r"\\\1", escape(" ".join(printable(text).split())))


def _quoted(scene: Scene) -> str:
    """Return the scene's text as a literal of several lines, whatever stands in it."""
    lines = scene.to_toml().splitlines(keepends=True)
    return "(\n" + "".join(f"    {line!r}\n" for line in lines) + ")"


def _cell(kind: str, text: str, place: int) -> dict[str, object]:
    cell: dict[str, object] = {
        "cell_type": kind, "id": f"cell-{place}", "metadata": {}, "source": text,
    }  # fmt: skip
    return cell | ({"execution_count": None, "outputs": []} if kind == "code" else {})
