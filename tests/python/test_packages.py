"""What strangers get: metadata, the crate's own tests, citation, workflows, and a typed program of theirs.

What takes minutes stands in ``tests/packages``.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from release import PLACEHOLDER, ROOT, disagreements, manifest, obstacles, text

WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
DOWNSTREAM = ROOT / "tests" / "downstream" / "python"


def run(*command: str | Path, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
    """Run a command in a folder, or skip where its program is not installed."""
    program = shutil.which(command[0]) or shutil.which(
        command[0], path=str(Path(sys.executable).parent)
    )
    if program is None:
        pytest.skip(f"{command[0]} is not installed")
    return subprocess.run(
        [program, *command[1:]], check=False, cwd=folder, capture_output=True, text=True
    )


def test_one_version_stands_everywhere() -> None:
    assert disagreements() == []


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The files that tell a version."""
    for name in ("Cargo.toml", "Cargo.lock", "CITATION.cff", "CHANGELOG.md"):
        shutil.copy(ROOT / name, tmp_path)
    return tmp_path


def replaced(root: Path, name: str, old: str, new: str) -> None:
    told = text(root, name)
    assert old in told
    (root / name).write_text(told.replace(old, new), encoding="utf-8")


@pytest.mark.parametrize("name", ["Cargo.toml", "CITATION.cff", "CHANGELOG.md"])
def test_two_versions_are_told(copy: Path, name: str) -> None:
    version = manifest()["version"]
    before = {"Cargo.toml": f'version = "{version}"', "CITATION.cff": f"version: {version}"}
    old = before.get(name, f"## {version}")
    replaced(copy, name, old, old.replace(version, "9.9.9"))
    told = "\n".join(disagreements(copy))
    assert "9.9.9" in told
    assert ("Cargo.lock" if name == "Cargo.toml" else name) in told


def test_publishing_waits_for_addresses_and_the_right_tag(copy: Path) -> None:
    tag = f"v{manifest()['version']}"
    replaced(copy, "Cargo.toml", PLACEHOLDER, "ballrace.invalid")
    assert obstacles(tag, copy) == []
    assert len(obstacles("v9.9.9", copy)) == 1
    replaced(copy, "Cargo.toml", "https://ballrace.invalid/ballrace/docs", f"https://{PLACEHOLDER}")
    assert "documentation" in obstacles(tag, copy)[0]


def test_addresses_stand_in_one_place() -> None:
    package = manifest()
    project = tomllib.loads(text(ROOT, "pyproject.toml"))["project"]
    assert {"version", "authors", "keywords", "urls"} == set(project["dynamic"])
    assert package["authors"] == ["the ballrace developers"]
    host = package["repository"].removeprefix("https://")
    pages = [*ROOT.glob("*.toml"), *ROOT.glob("*.md"), *ROOT.glob("*.cff"), *WORKFLOWS]
    found = [page.name for page in pages if host in page.read_text(encoding="utf-8")]
    assert found == ["Cargo.toml"]


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


def test_the_citation_is_one() -> None:
    found = run(
        "check-jsonschema", "--builtin-schema", "vendor.citation-file-format", "CITATION.cff"
    )
    assert found.returncode == 0, found.stdout
    paper = "A 3D-ball bearing model for simulation of axial load variations"
    assert paper in text(ROOT, "CITATION.cff")
    assert paper in text(ROOT, "src/lib.rs")


def test_workflows_are_what_github_reads() -> None:
    assert {path.stem for path in WORKFLOWS} == {"publish", "tests", "wheels"}
    updates = ROOT / ".github" / "dependabot.yml"
    for kind, files in {"github-workflows": WORKFLOWS, "dependabot": [updates]}.items():
        found = run("check-jsonschema", "--builtin-schema", f"vendor.{kind}", *files)
        assert found.returncode == 0, found.stdout


def test_workflows_are_safe() -> None:
    """Actions by the hash of a commit, least permissions, no credentials left behind."""
    found = run("zizmor", "--offline", "--quiet", "--min-severity", "medium", *WORKFLOWS)
    assert found.returncode == 0, found.stdout


def test_wheels_are_built_for_all() -> None:
    wheels = text(ROOT, ".github/workflows/wheels.yml")
    for platform in (
        "manylinux",
        "musllinux",
        "macos",
        "macos-15-intel",
        "windows",
        "-arm",
        "abi3",
    ):
        assert platform in wheels, platform


def test_a_typed_program_of_a_stranger() -> None:
    """Checked strictly against what is installed, from outside the source, and run."""
    cache = ROOT / ".mypy_cache" / "downstream"
    strict = ("-m", "mypy", "--config-file", "mypy.ini", "--cache-dir", cache)
    found = run(sys.executable, *strict, "program.py", folder=DOWNSTREAM)
    assert found.returncode == 0, found.stdout + found.stderr
    ran = run(sys.executable, "program.py", folder=DOWNSTREAM)
    assert ran.returncode == 0, ran.stderr
    assert "6 cases" in ran.stdout
