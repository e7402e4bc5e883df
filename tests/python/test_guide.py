"""The guide: it builds without a warning, needs no network, and what it says of files and columns is there."""

from __future__ import annotations

import dataclasses
import importlib.util
import re
import subprocess
import sys
import types
from html.parser import HTMLParser
from pathlib import Path

import pytest

import ballrace as br
import ballrace.scene as s
from ballrace._base.document import Part, Variant

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
EXTENSIONS = ("sphinx", "furo", "latex2mathml", "myst_parser", "numpydoc")


class Fetched(HTMLParser):
    """What a page makes a browser fetch, and the equations that are left to a script."""

    def __init__(self) -> None:
        super().__init__()
        self.addresses: list[str] = []
        self.unrendered: list[str] = []
        self.equations = 0

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = dict(attrs)
        if tag in ("script", "img", "iframe", "source", "object", "embed"):
            self.addresses += [found[name] or "" for name in ("src", "data") if name in found]
        # Links to other pages are read on request; icons and styles are fetched.
        if tag == "link" and found.get("rel") in ("stylesheet", "icon", "preload", "preconnect"):
            self.addresses.append(found.get("href") or "")
        if tag == "math":
            self.equations += 1
        if "math" in (found.get("class") or "").split():
            self.unrendered.append(tag)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The guide as built by the command that it gives itself, warnings being errors."""
    for name in EXTENSIONS:
        if importlib.util.find_spec(name) is None:
            pytest.skip(f"{name} is not there: pip install '.[docs]'")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    done = subprocess.run(
        [*command, str(GUIDE), str(folder)], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return folder


@pytest.mark.long
def test_pages_need_no_network(site: Path) -> None:
    pages = sorted(site.rglob("*.html"))
    assert len(pages) > 25
    equations = 0
    for page in pages:
        found = Fetched()
        found.feed(page.read_text(encoding="utf-8"))
        equations += found.equations
        assert not found.unrendered, page
        for address in found.addresses:
            assert not re.match(r"(\w+:)?//", address), f"{page.name} fetches {address}"
            if not address.startswith("data:"):
                assert (page.parent / address.partition("?")[0]).is_file(), (
                    f"{page.name}: {address}"
                )
    assert equations > 15
    for style in site.rglob("*.css"):
        text = style.read_text(encoding="utf-8")
        assert not re.search(r"(@import|url\()\s*[\"']?(https?:)?//", text), style


@pytest.mark.long
def test_the_reference_has_every_field(site: Path) -> None:
    text = (site / "scene.html").read_text(encoding="utf-8")
    kinds = [kind for name in s.__all__ if isinstance(kind := getattr(s, name), type)]
    parts = [kind for kind in kinds if issubclass(kind, Part)]
    assert len(parts) > 30
    for kind in parts:
        wrapped = issubclass(kind, Variant) and kind.wraps
        fields = [] if wrapped else [f.name.removesuffix("_") for f in dataclasses.fields(kind)]
        for name in fields:
            assert f'<span class="pre">{name}</span>' in text, (kind, name)
        if issubclass(kind, Variant):
            assert f'<span class="pre">{kind.tag}' in text, kind


@pytest.mark.long
def test_the_reference_has_every_public_name(site: Path) -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in (site / "api").glob("*.html"))
    for name in set(br.__all__) - {"catalogue"}:  # which is documented by its class
        is_module = isinstance(getattr(br, name), types.ModuleType)
        wanted = f"module-ballrace.{name}" if is_module else rf"ballrace\.(\w+\.)*{name}"
        assert re.search(rf'id="{wanted}"', text), name


def test_files_that_pages_name_are_there() -> None:
    named = 0
    pages = [
        *ROOT.glob("*.md"),
        *GUIDE.rglob("*.md"),
        *ROOT.glob("benches/**/*.md"),
        *ROOT.glob("tests/**/*.md"),
    ]
    # What the changelog says of older versions may be gone.
    for page in set(pages) - {ROOT / "CHANGELOG.md"}:
        for path in re.findall(
            r"`((?:src|tests|python|benches|docs)/[\w./]+\.\w+)`", page.read_text(encoding="utf-8")
        ):
            named += 1
            assert (ROOT / path).is_file(), f"{page.name} names {path}"
    assert named > 30


def test_the_paper_has_numbers_that_are_tested_or_measured() -> None:
    """And cites what its bibliography has."""
    paper = (ROOT / "paper" / "paper.md").read_text(encoding="utf-8")
    sources = [ROOT / "tests" / "README.md", *ROOT.glob("benches/*.md")]
    known = set(NUMBER.findall("\n".join(page.read_text(encoding="utf-8") for page in sources)))
    numbers = NUMBER.findall(paper.partition("# Validation")[2].partition("# What it cannot")[0])
    assert len(numbers) > 20
    assert set(numbers) <= known
    entries = re.findall(
        r"@\w+\{(\w+),", (ROOT / "paper" / "paper.bib").read_text(encoding="utf-8")
    )
    assert set(re.findall(r"@([a-z]+\d*)", paper.partition("# Summary")[2])) == set(entries)
    for picture in re.findall(r"!\[[^\]]*\]\(([^)]+)\)", paper):
        assert (ROOT / "paper" / picture).is_file()


def test_lines_of_one_formula_are_a_row_and_a_count() -> None:
    """And the row of the validation page is that of the furthest."""
    spec = importlib.util.spec_from_file_location("validation", ROOT / "tests" / "validation.py")
    assert spec
    assert spec.loader
    program = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(program)
    printed = (
        "| 6205: orbit, orders | 0.4 | 0.4 | +0.000 % | 0.3 % |\n"
        "| 6205, inner: line at order 4.390, Hz | 100 | 99.9 | -0.100 % | 0.3 % |\n"
        "| 6205, inner: line at order 5.390, Hz | 200 | 200.1 | +0.050 % | 0.3 % |\n"
    )
    found = program.rows(printed).splitlines()
    assert found[0] == printed.splitlines()[0]
    assert found[1:] == [
        "| 2 lines of simulated defects; the furthest: 6205, inner: line at order 4.390, Hz"
        " | 100 | 99.9 | -0.100 % | 0.3 % |"
    ]
    page = (ROOT / "tests" / "README.md").read_text(encoding="utf-8")
    assert len(re.findall(r": line at order [\d.]+, Hz \|", page)) == 1


def test_guide_and_changelog_stay_readable() -> None:
    """At most 24 000 words without blocks of code, and twelve kilobytes."""
    block = re.compile(r"^```.*?^```", flags=re.DOTALL | re.MULTILINE)
    pages = [block.sub("", page.read_text(encoding="utf-8")) for page in GUIDE.glob("*.md")]
    assert sum(len(page.split()) for page in pages) <= 24_000
    assert (ROOT / "CHANGELOG.md").stat().st_size <= 12_288


def test_what_pages_link_to_is_there() -> None:
    """Pages and pictures; the build looks at the anchors of the guide's own."""
    for page in [ROOT / "README.md", *GUIDE.glob("*.md")]:
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text(encoding="utf-8")):
            if "://" not in target:
                assert (page.parent / target).is_file(), f"{page.name} links to {target}"


def test_the_gallery_has_every_picture() -> None:
    """Each function that draws is in a block of the gallery, and each block's picture is there."""
    text = (GUIDE / "gallery.md").read_text(encoding="utf-8")
    drawing = {name for name in br.plot.__all__ if name.islower()} - {"probes", "write"}
    assert drawing == {name for name in drawing if f"br.plot.{name}(" in text}
    pictures = re.findall(r"\((figures/gallery/\w+\.webp)\)", text)
    assert len(set(pictures)) == len(pictures) >= len(drawing)
    for picture in pictures:
        assert (GUIDE / picture).stat().st_size > 1000, picture


def columns_of_the_guide() -> list[tuple[re.Pattern[str], str]]:
    """Return the rows of the tables of columns as patterns with units."""
    anything, word = r".+", r"[^.]+"
    parts = {
        "probe": word, "sensor": word, "defect": word, "column": anything, "row": r"row\d+",
        "race": "(outer|inner)", "k": r"\d+", "origin": r"(?!outer|inner)[^.]+",
        "fault": "(ftf|bpfo|bpfi|2bsf)", "feature": anything,
    }  # fmt: skip
    found = []
    for line in (GUIDE / "columns.md").read_text(encoding="utf-8").splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        for name in re.findall(r"`([^`]+)`", cells[0]) if line.startswith("| `") else []:
            pattern = re.sub(r"<(\w+)>", lambda part: parts[part[1]], name.replace(".", r"\."))
            found.append((re.compile(pattern), cells[1]))
    return found


def everything() -> s.Scene:
    """A scene with every probe."""
    scene = br.bearing(
        "6205", radial_load=1500.0, lubricant="vg68", temperature_c=55.0,
        defects={"spall": br.defects.spall(on="outer_race", width_mm=1.0)}, speed_rpm=1800.0,
        housing=br.Structure(modes=(
            br.Mode(frequency=1200.0, damping=0.05, mass=2.0, seat=(0, 1, 0), sensors={"top": (0, 1, 0)}),
        )),
    )  # fmt: skip
    probes: dict[str, s.Probe] = {
        "outer": s.MotionProbe(body="outer"), "loads": s.ContactsProbe(row=0), "cage": s.CageProbe(row=0),
        "energy": s.EnergyProbe(), "torque": s.TorqueProbe(), "forces": s.ForcesProbe(body="outer"),
        "oil": s.LubricationProbe(row=0), "inner": s.MotionProbe(body="inner"),
        "ball": s.MotionProbe(body="row0.ball0"), "moments": s.MomentsProbe(),
        "housing": s.StructureProbe(), "seat": s.SeatProbe(),
    }  # fmt: skip
    free = {
        f"inner_ring.support.tilt_{axis}": s.Spring(stiffness=1e3, damping=0.05) for axis in "xy"
    }
    return dataclasses.replace(scene.replace({"spin": "free", **free}), probes=probes)


def test_the_table_of_columns_is_whole(tmp_path: Path) -> None:
    """Every column of signals and manifest has one row of the table, and the unit that a run gives."""
    scene, columns = everything(), columns_of_the_guide()
    out = br.simulate(scene, duration=0.002)
    done = br.campaign(
        # Standard errors want eight passes of balls, lines of the cage two of its turns.
        [{"loads.radial.force": 800.0}], tmp_path, scene=scene, duration=0.18, keep="signals",
        contact_loads=True, columns=["outer.ay"], progress=False,
    )  # fmt: skip
    done.measure(br.measuring.Chain(logger=br.measuring.Logger()))
    linked = dataclasses.replace(
        scene, cage=s.Cage(stiffness=1e6), probes={"cage": s.CageProbe(row=0)}
    )
    others = br.simulate(linked, duration=0.002).names
    names = {"t", *out.names, *others, *done.manifest.columns} - {"loads.radial.force"}
    for name in names:
        units = {unit for pattern, unit in columns if pattern.fullmatch(name)}
        assert len(units) == 1, (name, units)
        assert units == {out.units.get(name, *units)}, name
    for pattern, _ in columns:
        assert any(pattern.fullmatch(name) for name in names), f"no column {pattern.pattern}"
