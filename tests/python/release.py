"""What a release asks for beside the packages themselves.

python tests/python/release.py check v0.3.0    whether that tag may be published
python tests/python/release.py notes           the changelog of this version, for the release's page
python tests/python/release.py readme          turns README.md into that of the packages, before they are built
"""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
PLACEHOLDER = "placeholder:"
"""How the addresses of Cargo.toml begin until there is a repository: no registry takes such an address."""
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#:\s]+)(#[^)\s]*)?\)")
"""A link or a picture within the repository."""
SOURCE = re.compile(r"<!-- source -->\n.*?<!-- package\n(.*?)-->\n", re.DOTALL)
"""What README.md says to readers of the repository, and in a comment what it says to those of a package."""


def obstacles(tag: str, root: Path = ROOT) -> list[str]:
    """What keeps a tag from being published, in sentences."""
    version = manifest(root)["version"]
    found = disagreements(root) + placeholders(root)
    if tag != f"v{version}":
        found.append(f"the tag is {tag}, Cargo.toml has version {version}")
    if not re.search(
        rf"^## {re.escape(version)}, \d{{4}}-\d\d-\d\d$", _changes(root), re.MULTILINE
    ):
        found.append(f"CHANGELOG.md: no heading '## {version}, YEAR-MONTH-DAY'")
    return found


def placeholders(root: Path = ROOT) -> list[str]:
    """Addresses that nobody has filled in."""
    package = manifest(root)
    return [
        f"Cargo.toml: {name} is still a placeholder, {package[name]}"
        for name in ("repository", "documentation")
        if package[name].startswith(PLACEHOLDER)
    ]


def disagreements(root: Path = ROOT) -> list[str]:
    """Files that have another version than Cargo.toml."""
    version = manifest(root)["version"]
    lock = tomllib.loads(text(root, "Cargo.lock"))["package"]
    found = {
        "Cargo.lock": [row["version"] for row in lock if row["name"] == "ballrace"],
        "CITATION.cff": re.findall(r"^version: (\S+)$", text(root, "CITATION.cff"), re.MULTILINE),
        "packaging/recipe.yaml": re.findall(
            r'^  version: "(\S+)"$', text(root, "packaging/recipe.yaml"), re.MULTILINE
        ),
        "CHANGELOG.md": re.findall(r"^## (\d[^\s,]*)", _changes(root), re.MULTILINE)[:1],
    }
    return [
        f"{name} has version {', '.join(versions) or 'none'}, Cargo.toml {version}"
        for name, versions in found.items()
        if versions != [version]
    ]


def notes(root: Path = ROOT) -> str:
    """What the changelog says of this version."""
    version = re.escape(manifest(root)["version"])
    found = re.search(
        rf"^## {version}\b.*?\n(.*?)(?=^## |\Z)", _changes(root), re.DOTALL | re.MULTILINE
    )
    return found[1].strip() + "\n" if found else ""


def readme(root: Path = ROOT) -> str:
    """README.md as a package shows it: installed from the registries, links to the repository at this version."""
    package = manifest(root)

    def absolute(link: re.Match[str]) -> str:
        mark, words, target, anchor = link.groups(default="")
        kind = "raw" if mark else "blob"
        place = f"{package['repository']}/{kind}/v{package['version']}/{target}"
        return f"{mark}[{words}]({place}{anchor})"

    return LINK.sub(absolute, SOURCE.sub(r"\1", text(root, "README.md")))


def manifest(root: Path = ROOT) -> dict[str, Any]:
    """What the packages of Cargo.toml have in common."""
    package: dict[str, Any] = tomllib.loads(text(root, "Cargo.toml"))["workspace"]["package"]
    return package


def text(root: Path, name: str) -> str:
    """A file of the project."""
    return (root / name).read_text(encoding="utf-8")


def _changes(root: Path) -> str:
    return text(root, "CHANGELOG.md")


COMMANDS = ("check", "notes", "readme")


def main(command: str = "", *rest: str) -> str | None:
    """Do what is asked for; what is returned is why it cannot be done."""
    if command not in COMMANDS or len(rest) != (command == "check"):
        return f"{' '.join((command, *rest)) or 'nothing'}: no such command\n{__doc__}"
    tag = "".join(rest)
    if refused := obstacles(tag) if command == "check" else placeholders():
        return "\n".join(refused)
    if command == "notes":
        sys.stdout.write(notes())
    elif command == "readme":
        (ROOT / "README.md").write_text(readme(), encoding="utf-8")
    return None


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
