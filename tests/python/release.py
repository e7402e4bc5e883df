"""Whether a tag may be published: one version stands everywhere, and no address is a placeholder.

python tests/python/release.py v0.2.0
"""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
PLACEHOLDER = "example.org"
"""Where the addresses point until there is a repository: a name that nobody may register."""


def obstacles(tag: str, root: Path = ROOT) -> list[str]:
    """What keeps a tag from being published, in sentences."""
    package = manifest(root)
    told = disagreements(root)
    if tag != f"v{package['version']}":
        told.append(f"the tag is {tag}, Cargo.toml has version {package['version']}")
    told += [
        f"Cargo.toml: {name} is still a placeholder, {package[name]}"
        for name in ("repository", "documentation")
        if PLACEHOLDER in package[name]
    ]
    return told


def disagreements(root: Path = ROOT) -> list[str]:
    """Files that tell another version than Cargo.toml."""
    version = manifest(root)["version"]
    lock = tomllib.loads(text(root, "Cargo.lock"))["package"]
    found = {
        "Cargo.lock": [row["version"] for row in lock if row["name"] == "ballrace"],
        "CITATION.cff": re.findall(r"^version: (\S+)$", text(root, "CITATION.cff"), re.MULTILINE),
        "CHANGELOG.md": re.findall(r"^## (\d\S*)", text(root, "CHANGELOG.md"), re.MULTILINE)[:1],
    }
    return [
        f"{name} tells version {', '.join(told) or 'none'}, Cargo.toml {version}"
        for name, told in found.items()
        if told != [version]
    ]


def manifest(root: Path = ROOT) -> dict[str, Any]:
    """What the packages of Cargo.toml have in common."""
    package: dict[str, Any] = tomllib.loads(text(root, "Cargo.toml"))["workspace"]["package"]
    return package


def text(root: Path, name: str) -> str:
    """A file of the project."""
    return (root / name).read_text(encoding="utf-8")


if __name__ == "__main__":
    sys.exit("\n".join(obstacles(sys.argv[1])) or 0)
