"""From records to what learns: arrays of windows, and features, the same of simulated and measured records.

:func:`examples` makes writable arrays of a table of windows; :class:`EnvelopeLines` is a transformer of
scikit-learn (``pip install "ballrace[learn]"``).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._later import later

if TYPE_CHECKING:
    from .arrays import Examples, examples
    from .envelope_lines import EnvelopeLines
else:
    # Arrays do not need scikit-learn.
    __getattr__ = later(
        __name__, {"envelope_lines": ("EnvelopeLines",), "arrays": ("Examples", "examples")}
    )

__all__ = ["EnvelopeLines", "Examples", "examples"]
