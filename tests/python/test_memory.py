"""A run that needs more memory than there is, is refused with numbers; the process lives on."""

from __future__ import annotations

import subprocess
import sys

import pytest

import ballrace as br

if sys.platform != "linux":
    pytest.skip("only Linux tells what there is", allow_module_level=True)

PROGRAM = """
import resource
from dataclasses import replace
import ballrace as br
scene = br.presets.deep_groove_6205()
br.simulate(scene, duration=1e-3, settle=0.0)
with open("/proc/self/statm") as file:
    used = int(file.read().split()[0]) * resource.getpagesize()
limit = used + 600 * 2**20
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
S = br.scene
try:
    {call}
except MemoryError as error:
    assert isinstance(error, br.BallraceError), error
    assert error.needed > error.available and error.available < 600 * 2**20
    print(error)
out = br.simulate(scene, duration=1e-3, settle=0.0)
print("alive", len(out["outer.ay"]))
"""

PROBES = """probes = {{f"p{{k}}": {probe} for k in range({count})}}
    br.simulate(replace(scene, probes=probes), duration={duration}, fs={fs}, settle=0.0)"""

CALLS = {
    "samples": 'br.simulate(scene, duration=100.0, fs=1e6, start="rolling", settle=0.0)',
    "contacts": PROBES.format(
        probe="S.ContactsProbe(row=0)", count=20_000, duration=0.01, fs=1000.0
    ),
    "slices": PROBES.format(
        probe="S.SlicesProbe(row=0, times=tuple(i * 1e-6 for i in range(10000)))",
        count=10,
        duration=0.01,
        fs=1000.0,
    ),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_does_not_fit_is_a_memory_error(name: str) -> None:
    command = [sys.executable, "-c", PROGRAM.format(call=CALLS[name])]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.returncode == 0, ended.stderr
    refused, alive = ended.stdout.splitlines()
    assert " GiB of memory would be needed where " in refused
    assert "shorten duration = " in refused
    assert refused.endswith("let a single run write its record to a file as it goes on (out)")
    assert alive == "alive 50"


def test_what_the_machine_does_not_have_is_refused() -> None:
    with pytest.raises(MemoryError, match="samples of") as raised:
        br.simulate(br.presets.deep_groove_6205(), duration=1e6, fs=1e6, start="rolling")
    assert isinstance(raised.value, br.errors.MemoryLimitError)
    assert raised.value.needed > 1e13
