"""What strangers get: metadata, licences, the crate's own tests, citation, and a typed program of theirs.

What takes minutes stands in ``tests/packages``.
"""

from __future__ import annotations

import json
import re
import sys
import tomllib
from importlib.metadata import distribution
from pathlib import Path

import pytest

from notices import notices
from release import ROOT, text
from tools import run

NOTICES = "THIRD-PARTY-NOTICES.txt"
DOWNSTREAM = ROOT / "tests" / "downstream" / "python"


def test_the_crate_has_all_that_its_tests_need() -> None:
    listed = run("cargo", "package", "--list", "--allow-dirty", "--locked", "--offline")
    assert listed.returncode == 0, listed.stderr
    packed = {Path(line) for line in listed.stdout.splitlines()}
    # The bindings are a package of their own, which nobody but the wheel needs.
    own = [
        path for path in (ROOT / "src").rglob("*") if ROOT / "src" / "python" not in path.parents
    ]
    tests = [*(ROOT / "tests").rglob("*.rs"), *own]
    wanted = {path.relative_to(ROOT) for path in tests if path.is_file()}
    wanted |= {
        Path(name) for name in ("README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE")
    }
    crates = ("tests/downstream", "tests/fuzz")
    strangers = {path for path in wanted if any(map(path.is_relative_to, crates))}
    assert wanted - strangers <= packed
    assert not packed & strangers
    assert not [path for path in packed if path.suffix == ".py"]


def test_the_sdist_holds_what_git_holds() -> None:
    """And git holds all that there is: nothing that a test reads is ignored."""
    assert (
        tomllib.loads(text(ROOT, "pyproject.toml"))["tool"]["maturin"]["sdist-generator"] == "git"
    )
    if not (ROOT / ".git").exists():
        pytest.skip("not a repository")
    ignored = run("git", "ls-files", "--others", "--ignored", "--exclude-standard", "src", "tests")
    left = [line for line in ignored.stdout.splitlines() if "__pycache__" not in line]
    assert not [line for line in left if line.endswith((".py", ".rs", ".toml", ".csv", ".cff"))]


def test_licences_of_what_is_compiled_in_come_along() -> None:
    """As texts, and as a list for programs that look for crates with known faults."""
    project = tomllib.loads(text(ROOT, "pyproject.toml"))["project"]
    assert set(project["license-files"]) == {p.name for p in ROOT.glob("*LICENSE*")} | {NOTICES}
    if run("cargo", "fetch", "--locked", "--offline").returncode:
        pytest.skip("not all crates of other platforms are downloaded")
    assert text(ROOT, NOTICES) == notices()
    files = distribution("ballrace").files or []
    (bill,) = [file for file in files if file.match("sboms/*.cyclonedx.json")]
    listed = {part["name"] for part in json.loads(bill.read_text())["components"]}
    assert set(re.findall(r"^([\w-]+) \d\S* \(", text(ROOT, NOTICES), re.MULTILINE)) <= listed


def test_the_citation_is_one() -> None:
    found = run(
        "check-jsonschema", "--builtin-schema", "vendor.citation-file-format", "CITATION.cff"
    )
    assert found.returncode == 0, found.stdout
    paper = "A 3D-ball bearing model for simulation of axial load variations"
    assert paper in text(ROOT, "CITATION.cff")
    assert paper in text(ROOT, "src/lib.rs")


def test_a_typed_program_of_a_stranger() -> None:
    """Checked strictly against what is installed, from outside the source, and run."""
    cache = ROOT / ".mypy_cache" / "downstream"
    strict = ("-m", "mypy", "--config-file", "mypy.ini", "--cache-dir", cache)
    found = run(sys.executable, *strict, "program.py", folder=DOWNSTREAM)
    assert found.returncode == 0, found.stdout + found.stderr
    ran = run(sys.executable, "program.py", folder=DOWNSTREAM)
    assert ran.returncode == 0, ran.stderr
    assert "6 cases" in ran.stdout
