"""Cases stream through: the parent holds the table, and nothing of what has finished."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.serial

PROGRAM = """
import resource, sys
sys.path.insert(0, {here!r})
import sweeps
from ballrace.campaigns import work

# A shard is written before a fifth of the cases is done, however fast the machine is.
work._OFTEN = 0.02
peaks = []

def report(progress):
    # Linux counts in KiB, others in bytes.
    unit = 1024.0 if sys.platform == "linux" else 1024.0**2
    peaks.append(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / unit)
    if progress.done * 5 >= progress.total and len(first) == 0:
        first.append(peaks[-1])

first = []
sweeps.run(
    sweeps.table({count}), {out!r}, duration=2e-4, start="rolling", keep="signals", fs={fs}, progress=report
)
print(first[0], peaks[-1])
"""


@pytest.mark.skipif(sys.platform == "win32", reason="the peak is asked for in another way there")
@pytest.mark.parametrize(
    ("count", "fs"), [(500, 1e6), pytest.param(10_000, 50e3, marks=pytest.mark.long)]
)
def test_memory_does_not_grow_with_cases(count: int, fs: float, tmp_path: Path) -> None:
    """From a fifth of the cases on, the peak of resident memory grows by no more than 8 MiB.

    All signals take 20 MB in either campaign.
    """
    program = PROGRAM.format(
        here=str(Path(__file__).parent), out=str(tmp_path / "runs"), count=count, fs=fs
    )
    command = [sys.executable, "-c", program]
    text = subprocess.run(command, capture_output=True, text=True, timeout=900, check=True).stdout
    fifth, last = map(float, text.split())
    assert last - fifth < 8.0, f"from {fifth} to {last} MiB"
