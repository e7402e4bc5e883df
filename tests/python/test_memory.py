"""A run that needs more memory than there is, is refused with numbers; the process lives on."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import ballrace as br

pytestmark = pytest.mark.serial

if sys.platform != "linux":
    pytest.skip("only Linux reports what there is", allow_module_level=True)

PROGRAM = """
import os, resource
import numpy as np
from dataclasses import replace
import ballrace as br

scene = br.presets.deep_groove_6205()
br.simulate(scene, duration=1e-3, settle=0.0)
# The threads of polars must be there before the limit is.
br.grid({{"a": [1.0]}}).write_parquet(os.devnull)
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


MANY = """one = S.Defect(
        on="outer_race", width=1e-4, length=1e-3, angle=0.0, axial_offset=0.0, edge_radius=1e-3
    )
    defects = {{f"d{{k}}": replace(one, angle=0.003 * k) for k in range({count})}}
    br.simulate(replace(scene, defects=defects), duration=1e-5, fs=1e5, start="rolling", settle=0.0)"""

LISTS = {
    "positions": ("br.load_distribution(scene, positions=10**9)", "lower positions"),
    "toml": ("""br.Scene.from_toml("gravity = [" + "1.0," * 10**7 + "]")""", "characters"),
    "json": ("""br.Scene.from_json('{"name": "' + "x" * 10**8 + '"}')""", "characters"),
    "defects": (MANY.format(count=100_000), "a scene of 16696479 characters"),
}
"""What is as long as one likes, and what the refusal names."""

CASES = """table = {{"loads.radial.force": [1e3 + k for k in range(8)]}}
    done = br.campaign(
        table, folder, scene=scene, duration=0.02, fs=2e7, start="rolling", settle=0.0,
        threads=4, keep={keep!r}, progress=False,
    )
    assert set(done.manifest["error"]) == {{"MemoryLimitError"}}, done.manifest
    print(done.manifest["message"][0])"""


def program(call: str) -> list[str]:
    """Run under a limit and return the lines that it prints: the refusal, and that all is well after it."""
    command = [sys.executable, "-c", PROGRAM.format(call=call)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.returncode == 0, ended.stderr
    lines = ended.stdout.splitlines()
    assert lines[-1] == "alive 50"
    return lines[:-1]


@pytest.mark.parametrize("name", LISTS)
def test_lists_that_do_not_fit_are_a_memory_error(name: str) -> None:
    call, named = LISTS[name]
    (refused,) = program(call)
    assert " GiB of memory would be needed where " in refused
    assert named in refused


def test_two_thousand_defects_fit() -> None:
    assert program(MANY.format(count=2000)) == []


@pytest.mark.parametrize("keep", ["features", "signals"])
def test_cases_at_once_share_the_memory(keep: str, tmp_path: Path) -> None:
    (refused,) = program(CASES.format(keep=keep).replace("folder", repr(str(tmp_path / "out"))))
    assert "run fewer cases at once, which share the memory" in refused


def test_a_start_of_another_length_is_not_copied() -> None:
    call = """try:
        br.simulate(scene, duration=1e-3, start=np.zeros(40_000_000))
    except br.SceneError as error:
        print(error)"""
    assert program(call) == ["start = 40000000 numbers: 88 numbers, named by the model"]


FIRST = """
import resource
import ballrace as br
with open("/proc/self/statm") as file:
    used = int(file.read().split()[0]) * resource.getpagesize()
limit = used + {left} * 2**20
resource.setrlimit(resource.RLIMIT_AS, (limit, limit))
for _ in range(2):
    try:
        br.campaign([{{"duration": 1e-3}}], {folder!r}, scene=br.presets.deep_groove_6205())
    except MemoryError as error:
        assert isinstance(error, br.BallraceError) and error.needed > error.available, error
        print(error)
print("alive", len(br.simulate(br.presets.deep_groove_6205(), duration=1e-3)["outer.ay"]))
"""
"""A campaign is the first that needs polars, whose library and threads find too little address space."""


@pytest.mark.parametrize("left", [100, 300, 400, 450, 550])
def test_polars_that_cannot_start_is_a_memory_error(left: int, tmp_path: Path) -> None:
    command = [sys.executable, "-c", FIRST.format(left=left, folder=str(tmp_path / "out"))]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=False)
    assert ended.returncode == 0, ended.stderr
    *refused, alive = ended.stdout.splitlines()
    assert alive == "alive 50"
    assert len(refused) == 2
    assert all(text.startswith("polars, which holds the tables, would need ") for text in refused)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("name", CALLS)
def test_what_does_not_fit_is_a_memory_error(name: str) -> None:
    (refused,) = program(CALLS[name])
    assert " GiB of memory would be needed where " in refused
    assert "shorten duration = " in refused
    assert refused.endswith("let a single run write its record to a file as it goes on (out)")


def test_what_the_machine_does_not_have_is_refused() -> None:
    with pytest.raises(MemoryError, match="samples of") as raised:
        br.simulate(br.presets.deep_groove_6205(), duration=1e6, fs=1e6, start="rolling")
    assert isinstance(raised.value, br.errors.MemoryLimitError)
    assert raised.value.needed > 1e13
