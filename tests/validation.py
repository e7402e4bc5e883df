"""Writes tests/README.md: what was published beside what ballrace gives. Run from anywhere:

    python tests/validation.py

It runs the tests that hold each number (`cargo test`, `pytest`), reads the lines they print, runs
`ballrace.paper`, and draws the pictures. The page is never edited by hand.
"""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ballrace.paper import Paper

ROOT = Path(__file__).parents[1]
PAGE = ROOT / "tests" / "README.md"
LITERATURE = [
    "literature_contacts",
    "literature_statics",
    "literature_dynamics",
    "literature_spall",
]
# Python tests that print rows of the same form.
MEASURED = ["test_defects_speak.py", "test_cwru.py", "test_exudyn.py"]
HEADER = "| case | published | ours | deviation | tolerance |\n|---|---|---|---|---|\n"
ROW = re.compile(r"^(?:test \S+ \.\.\. )?(\| .* \|)$", re.MULTILINE)


def output(command: list[str]) -> str:
    """Run a command in the project; its output, or the end of this program if it fails."""
    print("$", " ".join(command), file=sys.stderr)
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout + done.stderr)
    return done.stdout


def rows(text: str) -> str:
    """Return the table rows that tests have printed."""
    return "\n".join(match[1] for match in ROW.finditer(text)) + "\n"


def source(test: str) -> str:
    """Return the module documentation of a Rust test, where its sources stand."""
    lines = (ROOT / "tests" / f"{test}.rs").read_text(encoding="utf-8").splitlines()
    return "\n".join(line[3:].strip() for line in lines if line.startswith("//!")) + "\n"


def literature() -> str:
    """Every printed number of the textbooks."""
    parts = []
    for test in LITERATURE:
        text = output(
            ["cargo", "test", "-q", "--test", test, "--", "--nocapture", "--test-threads=1"]
        )
        parts.append(source(test) + "\n" + HEADER + rows(text))
    return "\n".join(parts)


def paper() -> str:
    """The paper's case."""
    from ballrace import paper as published

    result = published.run()
    lines = [published.HEADER, *published.rows(result)]
    table = ["| " + " | ".join(line) + " |" for line in lines]
    table.insert(1, "|" + "---|" * len(published.HEADER))
    pictures(result)
    return "\n".join(table) + "\n\n![figures 6 and 11](paper_signals.svg)\n"


def pictures(result: Paper) -> None:
    """Draw the counterparts of figures 6 and 11."""
    import matplotlib as mpl

    mpl.use("svg")
    import matplotlib.pyplot as plt

    cases = result.cases
    figure, axes = plt.subplots(len(cases), 1, figsize=(8, 6), sharex=True, sharey=True)
    for axis, (name, case) in zip(axes, cases.items(), strict=True):
        out = case.signals
        axis.plot(out.t[::4], out["outer.ay"][::4], linewidth=0.4)
        axis.set_ylabel(f"{name}\nouter.ay [m/s²]")
        axis.set_ylim(-150, 150)
    axes[-1].set_xlabel("time [s]")
    figure.tight_layout()
    figure.savefig(ROOT / "tests" / "paper_signals.svg", metadata={"Date": None})


def measured() -> str:
    """What the simulated defects say, beside kinematics and measured bearings."""
    text = output(
        [sys.executable, "-m", "pytest", "-q", "-s", *(f"tests/python/{m}" for m in MEASURED)]
    )
    return HEADER + rows(text)


def main() -> None:
    """Write the page."""
    PAGE.write_text(
        "# Validation\n\n"
        "Made by `python tests/validation.py`; every row is a test that fails if its number drifts.\n"
        "`bash tests/run` runs them, `bash tests/run --all` also those that take minutes.\n\n"
        f"## The paper\n\n{paper()}\n## The literature\n\n{literature()}\n## Defects and measured bearings\n\n"
        f"{measured()}\n" + LIMITS,
        encoding="utf-8",
    )


LIMITS = """## Not validated

- Sjövall's ratio at working load (1.192 and 1.134 in the reference list): the source names no bearing.
- Friction torque, temperature, lubricant film: no reference at hand, and no film in the model.
- Ball defects of a real bearing: here a ball spins about z only, and a short defect meets one race at a contact
  angle; a real ball tumbles.
"""

if __name__ == "__main__":
    main()
