"""Modules import each other one way only; packages list their public names; tests say what they prove."""

from __future__ import annotations

import ast
import importlib.metadata
import re
import subprocess
import sys
from graphlib import TopologicalSorter
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

import ballrace

if TYPE_CHECKING:
    from collections.abc import Iterator

PACKAGE = Path(ballrace.__file__).parent
ROOT = Path(__file__).parents[2]

FLOORS = {
    "base": "errors _base _core _io",
    "scene": "scene defects channel duty bearings frequencies.kinematic ratings.load_rating",
    "records": "recordings signals _results spectra.checks",
    "engine": "options statics model ring_force rotor explanation simulation run machines presets",
    "analysis": "frequencies ratings spectra measuring noise campaigns",
    "judgement": "diagnosis trending learn datasets",
    "faces": """plot report explore demo paper cli __main__
        diagnosis.page diagnosis.picture diagnosis.size_picture trending.picture datasets.campaign""",
}
"""The parts of the package, floor by floor: each imports its own floor and those above it in this table."""


def modules() -> dict[str, Path]:
    """All modules by their dotted names, the compiled one by its stub."""
    found = {}
    for path in (*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi")):
        parts = ("ballrace", *path.relative_to(PACKAGE).with_suffix("").parts)
        found[".".join(parts).removesuffix(".__init__")] = path
    return found


def hands_on(node: ast.AST) -> bool:
    """Whether a method only hands on what it was given: an import, and a call of what was imported.

    So a result may offer, as methods, pictures and pages that are made of it; nothing else names what is above it.
    """
    if not isinstance(node, ast.FunctionDef):
        return False
    *imports, last = node.body
    if imports and ast.get_docstring(node):
        imports = imports[1:]
    if not isinstance(last, ast.Return | ast.Expr) or not isinstance(last.value, ast.Call):
        return False
    imported = {
        alias.name for one in imports if isinstance(one, ast.ImportFrom) for alias in one.names
    }
    only = bool(imports) and all(isinstance(one, ast.ImportFrom) for one in imports)
    return only and isinstance(last.value.func, ast.Name) and last.value.func.id in imported


def statements(node: ast.AST, handed: bool = False) -> Iterator[tuple[ast.AST, bool]]:
    """All below a node, and whether a method that only hands on has it."""
    for child in ast.iter_child_nodes(node):
        of_child = handed or (isinstance(node, ast.ClassDef) and hands_on(child))
        yield child, of_child
        yield from statements(child, of_child)


def floor(name: str) -> int:
    """The floor of a module, counted from the lowest: that of the longest part of its name that has one."""
    floors = {part: i for i, parts in enumerate(FLOORS.values()) for part in parts.split()}
    name = name.removeprefix("ballrace.")
    while name not in floors:
        assert "." in name, f"{name} has no floor"
        name = name.rpartition(".")[0]
    return floors[name]


def may_be_handed(package: str, to: str) -> bool:
    """Whether a method in a package may hand on to a module above it: a face, or a file beside."""
    return floor(to) == len(FLOORS) - 1 or to.rpartition(".")[0] == package


def imported(name: str, path: Path, known: set[str], *, everywhere: bool) -> set[str]:
    """Modules that a module imports as it is loaded; or everywhere, in functions and for types too.

    A method that only hands on may call a face or a file of its own package, and nothing else.
    """
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = set()
    for node, handed in statements(tree) if everywhere else ((node, False) for node in tree.body):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = ".".join(package.split(".")[: len(package.split(".")) - node.level + 1])
            base = f"{base}.{node.module}" if node.module else base
            members = {f"{base}.{alias.name}" for alias in node.names}
            # `from . import x` means the module x if there is one, and what the package defines if there is none.
            modules = ((members & known) or {base}) & known
            if handed:
                modules = {m for m in modules if not may_be_handed(package, m)}
            found |= modules
    return found


@pytest.mark.parametrize("everywhere", [False, True])
def test_modules_import_each_other_one_way(everywhere: bool) -> None:
    paths = modules()
    assert {"ballrace", "ballrace.scene", "ballrace.scene.bearing"} <= set(paths)
    graph = {
        name: imported(name, path, set(paths), everywhere=everywhere)
        for name, path in paths.items()
    }
    # Raises CycleError with the circle if there is one.
    order = list(TopologicalSorter(graph).static_order())
    assert order.index("ballrace.scene.time") < order.index("ballrace.scene.load")
    if everywhere:
        assert order.index("ballrace.plot") < order.index("ballrace.paper.report")


def test_floors_import_those_below() -> None:
    paths = modules()
    for name, path in paths.items():
        if name == "ballrace":
            continue
        for other in imported(name, path, set(paths), everywhere=True) - {"ballrace"}:
            assert floor(other) <= floor(name), (
                f"{name} imports {other}, which stands on a floor above"
            )
    loose = {path.stem for path in PACKAGE.glob("_*.py")} - {"__init__", "__main__"}
    assert not loose, "a private module belongs into _base, _io or _results"


def test_an_import_loads_what_describes_a_scene() -> None:
    """The rest comes when it is asked for: a program that writes scenes, or prints one, need not wait for it."""
    program = (
        "import sys, ballrace;"
        "print(*(name.split('.')[1] for name in sys.modules if name.startswith('ballrace.')))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    scenes = {"defects", "errors", "frequencies", "presets", "scene"}
    loaded = {name for name in done.stdout.split() if not name.startswith("_")}
    assert loaded == scenes


def test_what_comes_later_is_there() -> None:
    program = (
        "import ballrace as br;"
        "assert not set(br.__all__) - set(dir(br));"
        "assert all(getattr(br, name) is getattr(br, name) for name in br.__all__);"
        "from ballrace import *; assert campaign is br.campaigns.campaign"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
    with pytest.raises(AttributeError, match="'ballrace' has no attribute 'bearing_'"):
        ballrace.bearing_  # type: ignore[attr-defined]  # noqa: B018


def test_packages_list_their_public_names() -> None:
    """And no modules beneath, nor what they import."""
    public = [
        "bearings",
        "campaigns",
        "datasets",
        "diagnosis",
        "frequencies",
        "learn",
        "machines",
        "measuring",
        "plot",
        "ratings",
        "recordings",
        "report",
        "scene",
        "spectra",
        "trending",
    ]
    for name in public:
        package = importlib.import_module(f"ballrace.{name}")
        assert dir(package) == sorted(package.__all__), name
        assert all(hasattr(package, each) for each in package.__all__), name
    assert dir(ballrace) == sorted([*ballrace.__all__, "__version__"])
    assert ballrace.__version__ == importlib.metadata.version("ballrace")


@pytest.mark.parametrize(("name", "module"), sorted(ballrace._MOVED.items()))
def test_results_that_moved_are_found_with_a_warning(name: str, module: str) -> None:
    there = f"ballrace.{module}.{name}"
    with pytest.warns(DeprecationWarning, match=f"^ballrace.{name} is {there} since 0.4") as caught:
        found = getattr(ballrace, name)
    assert caught[0].filename == __file__
    assert found is getattr(importlib.import_module(f"ballrace.{module}"), name)
    assert name not in ballrace.__all__


def test_every_file_of_tests_says_what_it_proves() -> None:
    """In its first line, so that a list of these lines is the map of the tests."""
    paths = [path for kind in ("rs", "py") for path in ROOT.glob(f"tests/**/*.{kind}")]
    paths = [path for path in paths if "target" not in path.parts]
    assert len(paths) > 100
    for path in paths:
        with path.open(encoding="utf-8") as file:
            assert re.match(r'(//! |""")\w', file.readline()), path
