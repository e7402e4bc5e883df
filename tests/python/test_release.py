"""A release is refused by name while something is missing; the README of a package leads into the repository."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from release import (
    PLACEHOLDER,
    ROOT,
    SOURCE,
    disagreements,
    manifest,
    notes,
    obstacles,
    readme,
    text,
)

TAG = f"v{manifest()['version']}"
REPOSITORY = "https://ballrace.invalid/repository"


def test_one_version_stands_everywhere() -> None:
    assert disagreements() == []


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """What a release reads, with the addresses and the day filled in."""
    (tmp_path / "packaging").mkdir()
    for name in (
        "Cargo.toml", "Cargo.lock", "CITATION.cff", "CHANGELOG.md", "README.md", "packaging/recipe.yaml"
    ):  # fmt: skip
        shutil.copy(ROOT / name, tmp_path / name)
    for name in ("repository", "documentation"):
        value = re.escape(manifest()[name])
        replaced(
            tmp_path,
            "Cargo.toml",
            f'{name} = "{value}"',
            f'{name} = "https://ballrace.invalid/{name}"',
        )
    heading = rf"^## {re.escape(manifest()['version'])}\b.*$"
    replaced(tmp_path, "CHANGELOG.md", heading, f"## {manifest()['version']}, 2026-12-01")
    return tmp_path


def replaced(root: Path, name: str, old: str, new: str) -> None:
    changed, count = re.subn(old, new, text(root, name), flags=re.MULTILINE)
    assert count
    (root / name).write_text(changed, encoding="utf-8")


@pytest.mark.parametrize(
    "name", ["Cargo.toml", "CITATION.cff", "CHANGELOG.md", "packaging/recipe.yaml"]
)
def test_two_versions_are_reported(copy: Path, name: str) -> None:
    version = manifest()["version"]
    before = {"Cargo.toml": f'version = "{version}"', "CITATION.cff": f"version: {version}"}
    before["packaging/recipe.yaml"] = f'version: "{version}"'
    old = before.get(name, f"## {version}")
    replaced(copy, name, re.escape(old), old.replace(version, "9.9.9"))
    found = "\n".join(disagreements(copy))
    assert "9.9.9" in found
    assert ("Cargo.lock" if name == "Cargo.toml" else name) in found


def test_what_is_filled_in_may_be_published(copy: Path) -> None:
    assert obstacles(TAG, copy) == []


@pytest.mark.parametrize("field", ["repository", "documentation"])
def test_an_address_that_nobody_filled_in(copy: Path, field: str) -> None:
    replaced(copy, "Cargo.toml", f"https://ballrace.invalid/{field}", PLACEHOLDER)
    (obstacle,) = obstacles(TAG, copy)
    assert obstacle.startswith(f"Cargo.toml: {field} ")


def test_another_tag_and_a_changelog_without_a_day(copy: Path) -> None:
    (obstacle,) = obstacles("v9.9.9", copy)
    assert "v9.9.9" in obstacle
    replaced(copy, "CHANGELOG.md", ", 2026-12-01$", "")
    (obstacle,) = obstacles(TAG, copy)
    assert obstacle.startswith("CHANGELOG.md")


def test_addresses_stand_in_one_place() -> None:
    package = manifest()
    project = tomllib.loads(text(ROOT, "pyproject.toml"))["project"]
    assert {"version", "authors", "keywords", "urls"} == set(project["dynamic"])
    assert package["authors"] == ["the ballrace developers"]
    # The crate's own would take the place of docs.rs.
    assert "documentation" not in tomllib.loads(text(ROOT, "Cargo.toml"))["package"]
    patterns = ("*.toml", "*.md", "*.cff", "*.json", ".*.json", ".github/**/*.*", "packaging/*")
    pages = [page for pattern in patterns for page in ROOT.glob(pattern)]
    host = package["repository"].removeprefix("https://")
    assert [p.name for p in pages if host in p.read_text(encoding="utf-8")] == ["Cargo.toml"]


def test_the_readme_of_a_package_leads_to_the_repository(copy: Path) -> None:
    page = readme(copy)
    links = re.findall(r"(!?)\[[^\]]*\]\(([^)#\s]+)", page)
    assert len(links) > 15
    for picture, target in links:
        kind = "raw" if picture else "blob"
        path = target.removeprefix(f"{REPOSITORY}/{kind}/{TAG}/")
        assert (ROOT / path).is_file(), target


def test_the_readme_of_a_package_installs_from_the_registries(copy: Path) -> None:
    """And that of the repository from the source; what both say stands there once."""
    first = re.compile(r"```sh[^\n]*\n(.*?)\n", re.DOTALL)
    page, source = readme(copy), text(ROOT, "README.md")
    assert _command(first, page) == 'pip install "ballrace[plot]" && ballrace demo'
    assert _command(first, source) == 'pip install ".[plot]" && ballrace demo'
    assert "<!--" not in page
    assert "tests/run" not in page
    assert len(SOURCE.findall(source)) == source.count("<!--") / 2


def _command(block: re.Pattern[str], page: str) -> str:
    found = block.search(page)
    assert found
    return found[1].partition("#")[0].strip()


def test_notes_are_those_of_the_version(copy: Path) -> None:
    replaced(copy, "CHANGELOG.md", r"^## Unreleased$", "## Unreleased\n\n- Not yet.")
    with (copy / "CHANGELOG.md").open("a", encoding="utf-8") as file:
        file.write("\n## 0.0.1\n\n- Long ago.\n")
    version = manifest(copy)["version"]
    replaced(copy, "CHANGELOG.md", rf"^## {version}.*$", r"\g<0>\n\nOf this version.")
    page = notes(copy)
    assert page.startswith("Of this version.")
    assert "Not yet." not in page
    assert "Long ago." not in page


@pytest.mark.parametrize(
    "words", [(), ("publish",), ("check",), ("check", "v0.2.0", "v0.3.0"), ("readme", "now"), ("--help",)]
)  # fmt: skip
def test_what_is_no_command_is_refused_and_changes_nothing(words: tuple[str, ...]) -> None:
    """A typing error must neither pass for a check nor rewrite the README."""
    before = text(ROOT, "README.md")
    command = [sys.executable, str(ROOT / "tests" / "python" / "release.py"), *words]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stdout == ""
    assert "no such command" in done.stderr
    assert "release.py check v0.3.0" in done.stderr
    assert text(ROOT, "README.md") == before
