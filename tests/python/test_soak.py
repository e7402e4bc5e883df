"""A campaign among faults ends as one that nobody disturbed: ``tests/soak.py``, for a moment or for a minute."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

SOAK = Path(__file__).parents[1] / "soak.py"

pytestmark = [
    pytest.mark.serial,
    pytest.mark.skipif(sys.platform == "win32", reason="signals are sent in another way there"),
]


def soaked(*arguments: str) -> str:
    done = subprocess.run(
        [sys.executable, SOAK, *arguments],
        capture_output=True,
        text=True,
        timeout=900.0,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_a_round() -> None:
    """This one fills the disk, where one may be mounted, kills twice, and cuts files."""
    printed = soaked("--rounds", "1", "--seed", "2")
    assert re.search(r"^4 faults: .*\n[1-9] calls: .*done", printed, re.MULTILINE), printed


@pytest.mark.long
def test_a_minute() -> None:
    printed = soaked("60", "--seed", "7")
    (faults,) = re.findall(r"^(\d+) faults: ", printed, re.MULTILINE)
    assert int(faults) >= 4
