"""The verdict on a run, with which its report begins."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..errors import BallraceError
from ..scene.turning import relative_speed
from .signal import chosen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..signals import Signals
    from .page import Page


def add_verdict(page: Page, out: Signals, names: Sequence[str]) -> dict[str, tuple[float, float]]:
    """Add what :func:`ballrace.diagnose` says of the first acceleration, or why it says nothing.

    Returns
    -------
    dict
        The band in which it was decided [Hz], by the signal's name; empty where nothing was.
    """
    from ..diagnosis import diagnose
    from ..diagnosis.result import capital, headline, reason, width_of
    from ..plot.style import words as in_words

    accelerations = (name for name in (*names, *chosen(out, None)) if out.units[name] == "m/s^2")
    column = next(accelerations, None)
    lacking = _lacking(out, column)
    if not lacking:
        try:
            found = diagnose(out, column=column)
        except BallraceError as error:
            lacking = str(error)
    if lacking:
        page.section("Verdict")
        page.text(f"No verdict: {lacking}.")
        return {}
    assert column is not None
    page.section(f"Verdict: {headline(found)}")
    width = f" {capital(width_of(found))}." if found.width.part else ""
    page.text(f"{capital(reason(found))}.{width}")
    page.text(
        f"It rests on one signal, {in_words(column)}. Its evidence has a page of its own: "
        f'br.diagnose(out, column="{column}").report("diagnosis.html").'
    )
    for note in found.notes:
        if note not in out.warnings:
            page.text(f"{capital(note)}.")
    surest = max(found.evidence.values(), key=lambda one: one.z, default=None)
    return {} if surest is None else {column: surest.band}


def _lacking(out: Signals, column: str | None) -> str:
    """Return what a verdict lacks in plain words; empty where nothing is missing."""
    if column is None:
        return "no acceleration of a ring was recorded"
    speed = relative_speed(out.scene)
    if speed is None:
        return "the speed is not constant; over the shaft's angle (br.spectra.by_order) there may be one"
    return "" if speed else "the rings do not turn against each other"
