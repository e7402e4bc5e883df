"""The shape of the package: modules import each other one way only."""

from __future__ import annotations

import ast
from graphlib import TopologicalSorter
from pathlib import Path

import ballrace

PACKAGE = Path(ballrace.__file__).parent


def modules() -> dict[str, Path]:
    """All modules by their dotted names, the compiled one by its stub."""
    found = {}
    for path in (*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi")):
        parts = ("ballrace", *path.relative_to(PACKAGE).with_suffix("").parts)
        found[".".join(parts).removesuffix(".__init__")] = path
    return found


def imported_on_loading(name: str, path: Path, known: set[str]) -> set[str]:
    """Modules that a module imports as it is loaded: not in functions, nor for types alone."""
    package = name if path.name == "__init__.py" else name.rpartition(".")[0]
    found = set()
    for node in ast.parse(path.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.ImportFrom) and node.level:
            base = ".".join(package.split(".")[: len(package.split(".")) - node.level + 1])
            base = f"{base}.{node.module}" if node.module else base
            members = {f"{base}.{alias.name}" for alias in node.names}
            # `from . import x` means the module x if there is one, and what the package defines if there is none.
            found |= (members & known) or {base}
    return found & known


def test_modules_import_each_other_one_way() -> None:
    paths = modules()
    assert {"ballrace", "ballrace.scene", "ballrace.scene.bearing"} <= set(paths)
    graph = {name: imported_on_loading(name, path, set(paths)) for name, path in paths.items()}
    # Raises CycleError with the circle if there is one.
    order = list(TopologicalSorter(graph).static_order())
    assert order.index("ballrace.scene.time") < order.index("ballrace.scene.load")
