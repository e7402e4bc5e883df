"""scipy's signal functions, imported where they are first needed: ``from ._scipy import signal``."""

from __future__ import annotations

try:
    from scipy import signal
except ImportError as error:
    raise ImportError(
        'this needs scipy: pip install "ballrace[signal]" (or pip install scipy)'
    ) from error

__all__ = ["signal"]
