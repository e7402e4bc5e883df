"""The charts of speed against accuracy: a module a chart, each with ``measure`` and ``draw``."""
