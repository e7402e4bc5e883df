"""The shape of the package: modules import each other one way only."""

from __future__ import annotations

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

import ballrace

PACKAGE = Path(ballrace.__file__).parent


def modules() -> dict[str, Path]:
    """All modules by their dotted names, the compiled one by its stub."""
    found = {}
    for path in (*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi")):
        parts = ("ballrace", *path.relative_to(PACKAGE).with_suffix("").parts)
        found[".".join(parts).removesuffix(".__init__")] = path
    return found


STANDING = {
    ("ballrace._record", "ballrace.signals"),
    ("ballrace.signals", "ballrace.report"),
    ("ballrace.campaigns.result", "ballrace.report"),
}
"""Who names whom against the order: for a type alone, or in a method that only hands on what it was given."""


def imported(name: str, path: Path, known: set[str], *, everywhere: bool) -> set[str]:
    """Modules that a module imports as it is loaded; or everywhere, in functions and for types too."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    tree = ast.parse(path.read_text(encoding="utf-8"))
    found = set()
    for node in ast.walk(tree) if everywhere else tree.body:
        if isinstance(node, ast.ImportFrom) and node.level:
            base = ".".join(package.split(".")[: len(package.split(".")) - node.level + 1])
            base = f"{base}.{node.module}" if node.module else base
            members = {f"{base}.{alias.name}" for alias in node.names}
            # `from . import x` means the module x if there is one, and what the package defines if there is none.
            found |= (members & known) or {base}
    return {other for other in found & known if (name, other) not in STANDING}


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
