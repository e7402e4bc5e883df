"""A page: headings, text, tables and figures in one file that needs no network.

What draws the figures, plotly.js, and the figures themselves stand in the page compressed: 1.9 MB instead of 5. A
short program at its end unpacks them. Bytes are written in base 85, a quarter more characters than bytes, where
base 64 needs a third. Printed, figures are as wide as paper of A4.
"""

from __future__ import annotations

import base64
import json
import zlib
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    import plotly.graph_objects as go

_STYLE = """
:root { color-scheme: light }
body { font: 16px/1.5 system-ui, "Segoe UI", Helvetica, Arial, sans-serif; color: #222; background: #fff;
       max-width: 1100px; margin: 0 auto; padding: 1rem; overflow-wrap: break-word }
h1 { font-size: 1.7rem; line-height: 1.2 } h2 { font-size: 1.25rem; margin: 2.2rem 0 .4rem }
p, ul { max-width: 46rem } .wide { overflow-x: auto }
table { border-collapse: collapse; font-size: .92rem; margin: .5rem 0 }
th, td { text-align: right; padding: .2rem .8rem; border-bottom: 1px solid #ddd; vertical-align: top }
th { border-bottom: 2px solid #888 } th:first-child, td:first-child { text-align: left; padding-left: 0 }
table.facts td { text-align: left } figure { margin: .6rem 0 1.2rem }
figcaption { font-size: .9rem; color: #444; max-width: 46rem }
.warning { border-left: 4px solid #c8452f; padding: .1rem 0 .1rem .8rem }
pre { font-size: .8rem; overflow-x: auto }
@media (max-width: 600px) { th, td { padding: .15rem .35rem; font-size: .8rem } .modebar { display: none } }
@media (max-width: 600px) { table.many tr { display: block; padding: .3rem 0; border-bottom: 1px solid #888 }
  table.many tr:first-child { display: none } table.many td { display: flex; justify-content: space-between;
  gap: 1rem; border: 0; padding: 0 } table.many td::before { content: attr(data-of); color: #444 }
  table.many td:first-child { font-weight: 600 } }
@page { margin: 15mm }
@media print { figure, table { break-inside: avoid } h2, h2 + p { break-after: avoid } .modebar { display: none }
  body { padding: 0; font-size: 10pt } }
"""

_DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!#$%&()*+-;/=>?@^_`{|}~"
"""Digits of base 85: those of :func:`base64.b85encode`, with ``/`` for the one by which a tag begins in HTML."""

_DRAW = """
(async () => {
  const digit = new Uint8Array(128);
  [...DIGITS].forEach((c, i) => { digit[c.charCodeAt(0)] = i; });
  const unpacked = async id => {
    const text = document.getElementById(id).textContent, left = (5 - text.length % 5) % 5;
    const full = text + "~".repeat(left), bytes = new DataView(new ArrayBuffer(full.length / 5 * 4));
    for (let i = 0; i < full.length; i += 5) {
      let word = 0;
      for (let k = 0; k < 5; k++) word = 85 * word + digit[full.charCodeAt(i + k)];
      bytes.setUint32(i / 5 * 4, word);
    }
    const packed = new Blob([new Uint8Array(bytes.buffer, 0, bytes.byteLength - left)]);
    return new Response(packed.stream().pipeThrough(new DecompressionStream("deflate"))).text();
  };
  const divs = [...document.querySelectorAll("figure > div")];
  try {
    const library = document.createElement("script");
    library.textContent = await unpacked("plotly-js");
    document.head.append(library);
    const figures = JSON.parse(await unpacked("figures"));
    divs.forEach((div, i) => Plotly.newPlot(div, { ...figures[i], config: CONFIG }));
    const wide = width => divs.forEach(div => Plotly.relayout(div, { width, autosize: width === null }));
    addEventListener("beforeprint", () => wide(670));
    addEventListener("afterprint", () => wide(null));
  } catch (error) {
    for (const div of divs) div.textContent = `This browser cannot draw the figure: ${error}`;
  }
})();
"""


_FEW = 4
"""Columns that a phone has room for."""


def _single(part: Any) -> Any:
    """Return a part of a figure with its arrays in single precision, which is more than a screen shows."""
    if isinstance(part, list):
        return [_single(each) for each in part]
    if not isinstance(part, dict):
        return part
    if part.get("dtype") != "f8":
        return {key: _single(each) for key, each in part.items()}
    double = np.frombuffer(base64.b64decode(part["bdata"]), np.float64)
    return part | {
        "dtype": "f4",
        "bdata": base64.b64encode(double.astype(np.float32).tobytes()).decode(),
    }


class Page:
    """A page that is written from top to bottom; what it is given is text, not HTML.

    Examples
    --------
    >>> page = Page("A <bearing>")
    >>> page.text("It turns.")
    >>> "<h1>A &lt;bearing&gt;</h1>" in page.html()
    True
    """

    def __init__(self, title: str) -> None:
        self._title = escape(title)
        self._parts = [f"<h1>{self._title}</h1>"]
        self._figures: list[str] = []

    def section(self, title: str) -> None:
        """Begin a section."""
        self._parts.append(f"<h2>{escape(title)}</h2>")

    def text(self, text: str) -> None:
        """Add a paragraph."""
        self._parts.append(f"<p>{escape(text)}</p>")

    def warning(self, text: str) -> None:
        """Add a paragraph that stands out, by its bar and its first word."""
        self._parts.append(f'<p class="warning"><strong>Warning:</strong> {escape(text)}</p>')

    def points(self, items: Iterable[str]) -> None:
        """Add a list."""
        lines = "".join(f"<li>{escape(item)}</li>" for item in items)
        self._parts.append(f"<ul>{lines}</ul>")

    def facts(self, entries: Iterable[tuple[str, str]]) -> None:
        """Add a table of two columns, what and its value."""
        lines = "".join(f"<tr><td>{escape(a)}</td><td>{escape(b)}</td></tr>" for a, b in entries)
        self._parts.append(f'<div class="wide"><table class="facts">{lines}</table></div>')

    def table(self, header: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
        """Add a table of numbers, the first column names; of more than four a phone shows a list a row."""
        names = [escape(cell) for cell in header]
        many = len(names) > _FEW
        head = "".join(f"<th>{name}</th>" for name in names)
        begins = [f'<td data-of="{name}">' if many else "<td>" for name in names]
        lines = (
            "".join(f"{td}{escape(cell)}</td>" for td, cell in zip(begins, row, strict=True))
            for row in rows
        )
        body = "".join(f"<tr>{line}</tr>" for line in lines)
        kind = ' class="many"' if many else ""
        self._parts.append(f'<div class="wide"><table{kind}><tr>{head}</tr>{body}</table></div>')

    def figure(self, fig: go.Figure, caption: str | None) -> None:
        """Add a figure with what it shows, numbered; without that under a title of its own."""
        self._figures.append(json.dumps(_single(json.loads(fig.to_json()))))
        number = len(self._figures)
        # Its place, so that the text does not move when it is drawn.
        height = f"height:{fig.layout.height or 450:g}px"
        drawn = f'<div id="figure-{number}" class="plotly-graph-div" style="{height}"></div>'
        figcaption = ""
        if caption is not None:
            figcaption = f"<figcaption>Figure {number}: {escape(caption)}</figcaption>"
        self._parts.append(f"<figure>{drawn}{figcaption}</figure>")

    def folded(self, title: str, text: str) -> None:
        """Add a text in its own lines, closed until it is asked for."""
        self._parts.append(
            f"<details><summary>{escape(title)}</summary><pre>{escape(text)}</pre></details>"
        )

    def html(self) -> str:
        """Return the page; plotly.js stands in it once, if there is a figure."""
        head = (
            '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
            f'<link rel="icon" href="data:,"><title>{self._title}</title><style>{_STYLE}</style>'
        )
        body = "\n".join([*self._parts, *(self._drawing() if self._figures else ())])
        return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{body}\n</body></html>\n'

    def _drawing(self) -> Iterator[str]:
        """Give the scripts that draw the figures."""
        from .._base.plotly import get_plotlyjs
        from ..plot import CONFIG

        for name, text in (
            ("plotly-js", get_plotlyjs()),
            ("figures", f"[{','.join(self._figures)}]"),
        ):
            packed = base64.b85encode(zlib.compress(text.encode(), 9)).decode().replace("<", "/")
            yield f'<script type="text/plain" id="{name}">{packed}</script>'
        draw = _DRAW.replace("DIGITS", json.dumps(_DIGITS)).replace("CONFIG", json.dumps(CONFIG))
        yield f"<script>{draw}</script>"
