"""Reports: one page of a run or of a campaign that needs no network, with figures, tables and warnings.

>>> import ballrace as br, pathlib, tempfile
>>> out = br.simulate(br.bearing("6205", speed_rpm=1800.0), duration=0.05)
>>> with tempfile.TemporaryDirectory() as folder:
...     path = pathlib.Path(folder) / "report.html"
...     out.report(path)
...     "contact pressure and rating life" in path.read_text(encoding="utf-8")
True
"""

from __future__ import annotations

from .._base.later import listed
from .campaign import campaign_page
from .page import Page
from .run import run_page
from .writing import write_page

__all__ = ["Page", "campaign_page", "run_page", "write_page"]

__dir__ = listed(__name__)
