"""Pages whose text stands elsewhere in the project: a line ``% from: NAME`` of a page is replaced by it.

NAME is a Markdown file of the project, whose links are turned to the pages of the guide, or one of the texts made
here: the reference of scenes, the catalogue, and the marks of its names.
"""

from __future__ import annotations

import csv
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import scene_reference

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Callable

    from sphinx.application import Sphinx
    from sphinx.util.typing import ExtensionMetadata

ROOT = Path(__file__).parents[2]
PAGES = {
    "benches/README.md": "benchmarks.md",
    "benches/records.md": "records.md",
    "benches/identified.md": "identified.md",
    "benches/transfer.md": "transfer.md",
    "tests/README.md": "validation.md",
    "CHANGELOG.md": "changelog.md",
    "README.md": "index.md",
}
"""Pages of the guide that show a file of the project."""
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def _linked(file: Path, text: str) -> str:
    """Return a file's text with links from a page of the guide; a file that is no page is given by its name."""

    def turned(found: re.Match[str]) -> str:
        picture, words, target, anchor = found[1], found[2], found[3], found[4] or ""
        if "://" in target:
            return found[0]
        path = (file.parent / target).resolve().relative_to(ROOT).as_posix()
        if picture:
            return f"![{words}](../{path})"
        if path in PAGES:
            return f"[{words}]({PAGES[path]}{anchor})"
        if path.startswith("docs/"):
            return f"[{words}]({path.removeprefix('docs/')}{anchor})"
        return words if words in path else f"{words} (`{path}`)"

    return LINK.sub(turned, text)


def _catalogue() -> str:
    """Return a row a bearing, and below it where the numbers of balls come from."""
    lines = [
        "| name | balls | D | d_m | bore | outside | width | angle | C | C₀ | f₀ | source |",
        "|---|" + "---:|" * 11,
    ]
    sources: dict[str, int] = {}
    for row in br.catalogue.values():
        sizes = (row.ball_diameter, row.pitch_diameter, row.bore, row.outside_diameter, row.width)
        balls = f"{'2 x ' * (row.row_count - 1)}{row.ball_count}"
        cells = [row.designation, balls, *(f"{1e3 * size:.5g}" for size in sizes)]
        cells += [f"{math.degrees(row.contact_angle):.0f}°"]
        cells += [f"{row.dynamic_rating:.0f}", f"{row.static_rating:.0f}", row.f0 or ""]
        cells += [sources.setdefault(row.sources.balls, len(sources) + 1)]
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    numbered = [f"{number}. {source}" for source, number in sources.items()]
    return "\n".join(
        [*lines, "", "Where number and diameter of the balls come from:", "", *numbered]
    )


def _marks() -> str:
    """Return what may follow a designation, by meaning."""
    lines = ["| mark | maker | meaning |", "|---|---|---|"]
    with (ROOT / "python/ballrace/bearings/marks.csv").open(encoding="utf-8", newline="") as file:
        lines += [
            f"| {row['mark']} | {row['makers']} | {row['meaning']} |"
            for row in csv.DictReader(file)
        ]
    return "\n".join(lines)


MADE: dict[str, Callable[[], str]] = {
    "scene": scene_reference.markdown,
    "catalogue": _catalogue,
    "marks": _marks,
}


def _fill(app: Sphinx, page: str, source: list[str]) -> None:
    def text(found: re.Match[str]) -> str:
        name = found[1].strip()
        if name in MADE:
            # What it is made of are many files; such a page is read anew whenever pages are built.
            app.env.note_reread()
            return MADE[name]()
        app.env.note_dependency(ROOT / name, docname=page)
        return _linked(ROOT / name, (ROOT / name).read_text(encoding="utf-8"))

    source[0] = re.sub(r"(?m)^% from: (.+)$", text, source[0])


def setup(app: Sphinx) -> ExtensionMetadata:
    """Fill pages as they are read."""
    app.connect("source-read", _fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
