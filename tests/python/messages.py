"""What people read who get a field of a scene wrong: every message of every field, reviewed as its reader would.

python tests/python/messages.py > tests/documents/messages.txt
"""

from __future__ import annotations

import copy
import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import ballrace as br

if TYPE_CHECKING:
    from collections.abc import Iterator

sys.path.insert(0, str(Path(__file__).parent))

Path_ = tuple[str | int, ...]


def leaves(value: Any, path: Path_ = ()) -> Iterator[Path_]:
    """Paths of all values of a document; of lists the first."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(value, list) and value:
        yield from leaves(value[0], (*path, 0))
        yield path
    elif path:
        yield path


def put(document: Any, path: Path_, value: object) -> Any:
    """Return a document with a value in its place."""
    document = copy.deepcopy(document)
    inner = document
    for key in path[:-1]:
        inner = inner[key]
    inner[path[-1]] = value
    return document


def wrong(value: object) -> list[object]:
    """What to try in place of a value."""
    if isinstance(value, bool):
        return [1.5]
    if isinstance(value, int | float):
        return ["much", -1e9, 0.0, 1e12]
    if isinstance(value, str):
        return [7, "nothing of the kind"]
    if isinstance(value, list):
        return [7, [], [1.0, "much"]]
    return [True, "nothing of the kind", -1e9]


def messages() -> Iterator[str]:
    """One line a message, in the order of the fields."""
    from test_scene import scenes

    seen: set[tuple[Path_, str]] = set()
    for scene in scenes():
        document = json.loads(scene.to_json())
        for path in leaves(document):
            value: Any = document
            for key in path:
                value = value[key]
            for other in wrong(value):
                try:
                    br.Scene.from_json(json.dumps(put(document, path, other)))
                except br.SceneError as error:
                    allowed = str(error).partition(": ")[2]
                    if (path, allowed) not in seen:
                        seen.add((path, allowed))
                        yield str(error)


def text() -> str:
    """All of them, sorted."""
    return "".join(f"{line}\n" for line in sorted(set(messages())))


if __name__ == "__main__":
    sys.stdout.write(text())
