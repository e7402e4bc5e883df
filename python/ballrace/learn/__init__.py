"""Trained models from records: recipes, windows, features, a classifier, how measured records differ.

A :class:`Recipe` says what is simulated, and :func:`dataset` does it; :func:`examples` makes writable arrays of
a table of windows. With scikit-learn (``pip install "ballrace[learn]"``): :class:`EnvelopeLines`, a transformer
whose features are the same of simulated and measured records, :class:`Diagnoser`, a classifier that has learnt
from them, and :func:`domain_report`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._base.later import later, listed

if TYPE_CHECKING:
    from .arrays import Examples, examples
    from .data import Simulated, dataset
    from .diagnoser import Diagnoser, Judgement
    from .domain import DomainReport, domain_report
    from .envelope_lines import EnvelopeLines
    from .recipe import Recipe
else:
    # Arrays and recipes do not need scikit-learn.
    __getattr__ = later(
        __name__,
        {
            "arrays": ("Examples", "examples"),
            "data": ("Simulated", "dataset"),
            "diagnoser": ("Diagnoser", "Judgement"),
            "domain": ("DomainReport", "domain_report"),
            "envelope_lines": ("EnvelopeLines",),
            "recipe": ("Recipe",),
        },
    )

__all__ = [
    "Diagnoser",
    "DomainReport",
    "EnvelopeLines",
    "Examples",
    "Judgement",
    "Recipe",
    "Simulated",
    "dataset",
    "domain_report",
    "examples",
]

__dir__ = listed(__name__)
