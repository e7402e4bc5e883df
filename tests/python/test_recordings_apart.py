"""Records from strangers: whatever is in a file, reading it ends in a record or one error, within its limits.

They are read in a child process, one for all files of a process.
"""

from __future__ import annotations

import contextlib
import io
import os
import signal
import struct
import subprocess
import sys
import time
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import polars as pl
import pytest
from scipy.io import savemat, wavfile

import ballrace as br
from ballrace._base import memory as _memory
from ballrace.recordings import apart

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

X = np.sin(np.arange(500.0))


of_linux = pytest.mark.skipif(_memory.used() is None, reason="only Linux limits memory")


@pytest.fixture
def csv(tmp_path: Path) -> Path:
    path = tmp_path / "sensor.csv"
    path.write_text("t [s],ay [g]\n0,1\n0.5,2\n1,4\n")
    return path


@pytest.fixture
def reading(monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str], None]]:
    """Let the child read by a program of the test's own."""

    def by(program: str) -> None:
        apart.end_child()
        start = (
            "from ballrace.recordings import formats, samples; import dataclasses, os, numpy as np, signal\n"
            "def csv_by(read):\n"
            "    formats.FORMATS['csv'] = dataclasses.replace(formats.FORMATS['csv'], read=read)"
        )
        serve = "from ballrace.recordings.apart import serve; serve()"
        made = f"import sys; sys.path[:] = sys.argv[1:]\n{start}\n{program}\n{serve}"
        monkeypatch.setattr(apart, "_PROGRAM", made)

    yield by
    apart.end_child()


def test_a_child_reads_what_this_process_reads(csv: Path) -> None:
    ours, childs = br.read(csv, trusted=True), br.read(csv)
    assert {n: x.tolist() for n, x in ours.items()} == {n: x.tolist() for n, x in childs.items()}
    assert (ours.fs, ours.units, ours.source) == (childs.fs, childs.units, childs.source)


def test_a_hundred_files_take_one_child(csv: Path) -> None:
    children = set()
    for _ in range(100):
        br.read(csv)
        assert apart._Own.child is not None
        children.add(apart._Own.child._process.pid)
    assert len(children) == 1
    assert os.getpid() not in children


@pytest.mark.parametrize(
    "how",
    ["os.kill(os.getpid(), signal.SIGSEGV)", "os.abort()", "os._exit(3)", "print('{}', flush=True); os._exit(0)"],
)  # fmt: skip
def test_a_child_that_ends_is_an_error_with_the_files_name(
    csv: Path, reading: Callable[[str], None], how: str
) -> None:
    program = f"def end(path, reading):\n    {how}\ncsv_by(end)"
    reading(program)
    for _ in range(2):  # another child reads the next file, and ends as well
        with pytest.raises(br.FileError, match=r"sensor\.csv: ended the process that read it"):
            br.read(csv)
    reading("")
    assert br.read(csv).n_samples == 3


@pytest.mark.parametrize(
    "answer",
    ["[]", "nonsense", '{"groups": []}', '{"groups": [{"sizes": {"a": 1e30}}]}',
     '{"groups": [{"sizes": {"a": 99999}, "fs": 1}]}', '{"groups": [{"sizes": {"a": -5}, "fs": 1}]}',
     '{"error": "eval", "arguments": []}'],
)  # fmt: skip
def test_what_a_child_under_control_of_a_file_says_is_checked(
    csv: Path, reading: Callable[[str], None], answer: str
) -> None:
    # It has started; then it answers.
    reading(f"os.write(1, {(chr(10) + answer + chr(10)).encode()!r}); os.read(0, 9); os._exit(0)")
    with pytest.raises(br.FileError, match=r"sensor\.csv: "):
        br.read(csv)


def test_time_is_limited(csv: Path, reading: Callable[[str], None]) -> None:
    reading("def wait(path, reading):\n    while True: pass\ncsv_by(wait)")
    message = r"sensor\.csv: took longer than 0\.2 s to read; raise time_limit"
    with pytest.raises(br.FileError, match=message):
        br.read(csv, time_limit=0.2)


@of_linux
def test_memory_is_limited_and_the_limit_can_be_raised(
    csv: Path, reading: Callable[[str], None]
) -> None:
    reading(
        "def fill(path, reading):\n    return samples.Samples(columns={'a': np.ones(30_000_000)}, fs=1.0)\n"
        "csv_by(fill)"
    )
    with pytest.raises(br.FileError, match=r"sensor\.csv: .* more memory than there is; raise"):
        br.read(csv, memory_limit=1e8)
    assert br.read(csv, memory_limit=1e9).n_samples == 30_000_000


NO_PROC = """
import pathlib
from ballrace._base import memory as _memory
_memory._STATM = pathlib.Path('/nowhere')
def peak(status=pathlib.Path('/proc/self/status')):
    return 1024 * int(status.read_text().split('VmHWM:')[1].split()[0])
_memory.peak = peak
"""
"""As where there is no /proc: on macOS, or in some containers. The peak is the program's own, as on macOS."""

FILL = """
import time
def fill(path, reading):
    taken = np.ones(int(path.read_text()))
    time.sleep(0.1)
    return samples.Samples(columns={'a': taken[:3]}, fs=1.0)
csv_by(fill)
"""


@of_linux
def test_without_proc_a_child_reads_and_is_ended_when_it_takes_too_much(
    csv: Path, reading: Callable[[str], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(_memory, "_STATM", Path("/nowhere"))
    assert _memory.used() is None
    assert _memory.left() == float("inf")
    assert _memory.peak() > 30e6  # type: ignore[operator]
    reading(f"{NO_PROC}{FILL}")
    csv.write_text("30_000_000")  # and gives three of them
    message = r"sensor\.csv: ended the process .* needs more than memory_limit \(0\.1 GB\)"
    with pytest.raises(br.FileError, match=message):
        br.read(csv, memory_limit=1e8)
    assert br.read(csv, memory_limit=1e9).n_samples == 3


@of_linux
def test_without_proc_a_peak_does_not_hide_the_next(
    csv: Path, reading: Callable[[str], None]
) -> None:
    """Only the peak is known there, which does not fall: a child that has grown is replaced, others stay."""
    reading(f"{NO_PROC}{FILL}")
    children = []
    for numbers in (3, 50_000_000, 3, 3):
        csv.write_text(str(numbers))
        assert br.read(csv, memory_limit=1e9).n_samples == 3
        assert apart._Own.child is not None
        children.append(apart._Own.child._process.pid)
    assert children[0] == children[1] != children[2] == children[3]


def test_without_a_clock_of_the_system_the_parent_ends_the_child(
    csv: Path, reading: Callable[[str], None], monkeypatch: pytest.MonkeyPatch
) -> None:
    """As on Windows."""
    monkeypatch.setattr(apart, "_ALARM", None)
    reading(
        "from ballrace.recordings import apart; apart._ALARM = None\n"
        "def wait(path, reading):\n    while True: pass\ncsv_by(wait)"
    )
    with pytest.raises(br.FileError, match=r"sensor\.csv: took longer than 0\.5 s to read"):
        br.read(csv, time_limit=0.5)


@of_linux
def test_the_peak_is_what_linux_reports() -> None:
    status = Path("/proc/self/status").read_text()
    highest = 1024.0 * int(status.split("VmHWM:")[1].split()[0])
    assert _memory.peak() == pytest.approx(highest, rel=0.3)  # 1024 apart in another unit


@pytest.mark.parametrize("name", ["time_limit", "memory_limit"])
@pytest.mark.parametrize("limit", [0.0, -1.0, float("nan"), "1", None])
def test_limits_are_checked(csv: Path, name: str, limit: Any) -> None:
    read: Any = br.read
    with pytest.raises(br.SceneError, match=rf"{name} = .*: above 0, or math\.inf"):
        read(csv, **{name: limit})
    assert read(csv, **{name: float("inf")}).n_samples == 3


def test_errors_of_the_child_are_those_of_this_process(csv: Path, tmp_path: Path) -> None:
    csv.write_text("a,b\n1,x\n")
    (tmp_path / "none.h5").write_text("none")
    for path in (csv, tmp_path / "none.h5"):
        arguments = []
        for trusted in (False, True):
            with pytest.raises(br.FileError) as raised:
                br.read(path, trusted=trusted)
            arguments.append(raised.value.args)
        assert arguments[0] == arguments[1]


def test_a_library_that_the_child_lacks_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "h5py.py").write_text("raise ImportError('no such library', name='h5py')")
    monkeypatch.syspath_prepend(tmp_path)
    apart.end_child()
    (tmp_path / "a.h5").write_text("any")
    with pytest.raises(ImportError, match=r'pip install "ballrace\[io\]"') as raised:
        br.read(tmp_path / "a.h5")
    assert raised.value.name == "h5py"
    apart.end_child()


def test_a_program_within_the_package_reads(csv: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Truth: the page of ``explore`` has its folder first; ``report/signal.py`` is no library."""
    folder = Path(apart.__file__).parents[1] / "report"
    assert (folder / "signal.py").exists()
    monkeypatch.syspath_prepend(folder)
    apart.end_child()
    assert br.read(csv).fs == br.read(csv, trusted=True).fs
    apart.end_child()


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_forked_process_has_a_child_of_its_own(csv: Path) -> None:
    program = (
        "import os, sys, ballrace as br\n"
        "from ballrace.recordings import apart\n"
        "br.read(sys.argv[1]); first = apart._Own.child._process.pid\n"
        "if (pid := os.fork()) == 0:\n"
        "    br.read(sys.argv[1]); os._exit(int(apart._Own.child._process.pid == first))\n"
        "print(os.waitpid(pid, 0)[1], br.read(sys.argv[1]).n_samples, apart._Own.child._process.pid == first)"
    )
    command = [sys.executable, "-W", "ignore", "-c", program, str(csv)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=60.0, check=True)
    assert ended.stdout.split() == ["0", "3", "True"]


FORKS = """
import multiprocessing, os, sys, threading, time, ballrace as br
from ballrace.recordings import apart
br.read(sys.argv[1])
waiting = threading.Thread(target=lambda: br.read(sys.argv[2], time_limit=600.0), daemon=True)
waiting.start()
while not apart._Own.lock.locked():
    time.sleep(0.01)
time.sleep(0.3)

def work():
    os._exit(0 if br.read(sys.argv[1]).n_samples == 3 else 1)

started = [multiprocessing.get_context("fork").Process(target=work) for _ in range(4)]
for one in started:
    one.start()
for one in started:
    one.join(60.0)
print([one.exitcode for one in started], waiting.is_alive(), flush=True)
for one in started:
    one.kill()
os._exit(0)
"""


@pytest.mark.serial
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
def test_a_process_that_is_forked_while_a_thread_reads_does_not_hang(
    csv: Path, tmp_path: Path
) -> None:
    """The locks of Python's files, which the reading thread holds, would never be released there."""
    slow = tmp_path / "slow.lvm"
    slow.write_text("1\n2\n")
    program = FORKS.replace(
        "br.read(sys.argv[1])\n",
        "apart._PROGRAM = apart._PROGRAM.replace('; serve()', "
        "'; import ballrace.recordings.apart as a, time; old = a.read_here; "
        'a.read_here = lambda p, f, r: (p.suffix == ".lvm" and time.sleep(600.0)) or old(p, f, r); serve()\')\n'
        "br.read(sys.argv[1])\n",
        1,
    )
    command = [sys.executable, "-W", "ignore", "-c", program, str(csv), str(slow)]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=120.0, check=True)
    assert ended.stdout == "[0, 0, 0, 0] True\n"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no pipes with names")
@pytest.mark.parametrize("trusted", [False, True])
def test_a_pipe_is_no_file(tmp_path: Path, trusted: bool) -> None:
    """Opened as a file, it would wait for somebody who writes, before any clock runs."""
    os.mkfifo(tmp_path / "a.csv")
    with pytest.raises(br.FileError, match=r"a\.csv: is a pipe or a device, no file"):
        br.read(tmp_path / "a.csv", 1.0, time_limit=10.0, trusted=trusted)
    with pytest.raises(br.FileError, match="is a pipe or a device"):
        br.read("/dev/null", 1.0, trusted=trusted)
    with pytest.raises(OSError, match="directory"):
        br.read(tmp_path, 1.0, trusted=trusted)
    with pytest.raises(FileNotFoundError):
        br.read(tmp_path / "none.csv", 1.0, trusted=trusted)


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="no such signals")
def test_a_stopped_child_is_not_waited_for(csv: Path) -> None:
    assert br.read(csv).n_samples == 3
    assert apart._Own.child is not None
    os.kill(apart._Own.child._process.pid, signal.SIGSTOP)
    with pytest.raises(br.FileError, match=r"sensor\.csv: took longer than 0\.3 s to read"):
        br.read(csv, time_limit=0.3)
    assert br.read(csv).n_samples == 3


def test_a_child_that_cannot_be_ended_is_left_alone(
    csv: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As one that waits for a network mount which does not answer: no signal ends it."""
    apart.end_child()
    assert br.read(csv).n_samples == 3
    child = apart._Own.child
    assert child is not None
    os.kill(child._process.pid, signal.SIGSTOP)
    end = child._process.kill
    monkeypatch.setattr(child._process, "kill", lambda: None)
    monkeypatch.setattr(apart, "_PATIENCE", 0.1)
    with pytest.raises(br.FileError, match="took longer"):
        br.read(csv, time_limit=0.3)
    assert br.read(csv).n_samples == 3
    end()
    child._process.wait(10.0)


def test_progress_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.csv"
    path.write_text("1.5\n" * 200_000)
    monkeypatch.setattr("ballrace.recordings.lines.PIECE", 1 << 16)
    shares: list[float] = []
    assert br.read(path, 1.0, progress=shares.append, trusted=True).n_samples == 200_000
    assert len(shares) > 5
    assert shares == sorted(shares)
    assert shares[-1] == 1.0
    assert br.read(path, 1.0, progress=True).n_samples == 200_000

    def stop(_share: float) -> None:
        raise KeyError("stopped")

    with pytest.raises(KeyError, match="stopped"):
        br.read(path, 1.0, progress=stop, trusted=True)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no such signals")
def test_the_child_ends_with_its_process(csv: Path) -> None:
    program = (
        "import os, signal, sys, ballrace as br\n"
        "from ballrace.recordings import apart\n"
        "br.read(sys.argv[1]); print(apart._Own.child._process.pid, flush=True)\n"
        "os.kill(os.getpid(), signal.SIGKILL)"
    )
    ended = subprocess.run(
        [sys.executable, "-c", program, str(csv)],
        capture_output=True,
        timeout=60.0,
        check=False,
    )
    child = int(ended.stdout)
    with contextlib.suppress(ProcessLookupError):
        for _ in range(600):
            os.kill(child, 0)
            if _is_zombie(child):
                break
            time.sleep(0.05)
        else:
            pytest.fail("the child is still there")


def _is_zombie(pid: int) -> bool:
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] in "ZX"
    return False


def hdf5(path: Path, fill: Callable[[Any], object]) -> Path:
    h5py = pytest.importorskip("h5py")
    with h5py.File(path, "w") as file:
        file.attrs["fs"] = 1000.0
        fill(file)
    return path


def test_declared_sizes_are_compared_before_memory_is_set_aside(tmp_path: Path) -> None:
    """Small files that declare GB: refused by what they declare, on every system."""

    def huge(file: Any) -> None:
        file.create_dataset("ay", shape=(2**34,), dtype="f8", chunks=(2**16,), compression="gzip")

    path = hdf5(tmp_path / "huge.h5", huge)
    assert path.stat().st_size < 4000
    with pytest.raises(br.FileError, match=r"huge\.h5: declares 1\.72e\+10 numbers \(137 GB\) in"):
        br.read(path)
    path = tmp_path / "huge.parquet"
    rows = pl.select(pl.repeat(0.0, 10_000_000).alias("ay"))
    rows.write_parquet(path, compression="zstd")
    assert path.stat().st_size < 100_000
    with pytest.raises(br.FileError, match=r"huge\.parquet: declares 1e\+07 numbers"):
        br.read(path, fs=1.0, memory_limit=5e7)
    assert br.read(path, fs=1.0).n_samples == 10_000_000


def rf64(declared: int) -> bytes:
    sizes = b"ds64" + struct.pack("<IQQQI", 28, declared + 200, declared, declared // 8, 0)
    form = b"fmt " + struct.pack("<IHHIIHH", 16, 3, 1, 8000, 64_000, 8, 64)
    return b"RF64\xff\xff\xff\xffWAVE" + sizes + form + b"data\xff\xff\xff\xff" + b"\0" * 64


@pytest.mark.parametrize("trusted", [False, True])
def test_a_sound_of_180_bytes_that_declares_128_gib(tmp_path: Path, trusted: bool) -> None:
    path = tmp_path / "huge.wav"
    path.write_bytes(rf64(2**37))
    assert path.stat().st_size < 200
    with pytest.raises(br.FileError, match=r"huge\.wav: "):
        br.read(path, trusted=trusted)


def bomb(numbers: int) -> bytes:
    """A MAT file with a vector of zeros, compressed by a factor of a thousand."""
    size = 8 * numbers
    body = struct.pack("<IIIIIIIIIIII", 6, 8, 6, 0, 5, 8, 1, numbers, 1, 2, 0x7961, 0)
    head = struct.pack("<II", 14, len(body) + 8 + size) + body + struct.pack("<II", 9, size)
    packed = zlib.compressobj(9)
    data = packed.compress(head)
    for _ in range(0, size, 1 << 20):
        data += packed.compress(bytes(1 << 20))
    data += packed.flush()
    start = io.BytesIO()
    savemat(start, {})
    return start.getvalue()[:128] + struct.pack("<II", 15, len(data)) + data


@of_linux
def test_a_mat_file_that_unpacks_to_gigabytes(tmp_path: Path) -> None:
    path = tmp_path / "bomb.mat"
    path.write_bytes(bomb(1 << 25))
    assert path.stat().st_size < 400_000
    with pytest.raises(br.FileError, match=r"bomb\.mat: "):
        br.read(path, fs=1.0, memory_limit=1e8)


@pytest.mark.parametrize("at", ["external", "virtual", "link", "link in a group"])
@pytest.mark.parametrize("end", [".h5", ".mat"])
def test_hdf5_that_leads_to_other_files_is_refused(tmp_path: Path, at: str, end: str) -> None:
    """Another file of the machine would be read as a signal."""
    h5py = pytest.importorskip("h5py")
    secret = tmp_path / "secret"
    secret.write_bytes(np.arange(4.0).tobytes())
    hdf5(tmp_path / "other.h5", lambda file: file.create_dataset("x", data=X))

    def fill(file: Any) -> None:
        file["ay"] = X
        match at:
            case "external":
                file.create_dataset("x", shape=(4,), dtype="f8", external=[(str(secret), 0, 32)])
            case "virtual":
                layout = h5py.VirtualLayout(shape=X.shape, dtype="f8")
                layout[:] = h5py.VirtualSource(tmp_path / "other.h5", "x", shape=X.shape)
                file.create_virtual_dataset("x", layout)
            case "link":
                file["x"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "x")
            case _:
                file["group/x"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "x")

    path = hdf5(tmp_path / f"data{end}", fill)
    with pytest.raises(
        br.FileError, match=r"data\.\w+: refused: what it has as .*x is in another file"
    ):
        br.read(path)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.wav", b"RIFF\4\0\0\0WAVE"),
        ("a.csv", b"a\x0bb\n1\n2\n"),
        ("a.csv", b"a\x85b;c\n1;2\n2;3\n"),
        ("a.csv", "a\u2028,b\n1,2\n2,3\n".encode()),
        ("a.csv", b'"a\nb",c\n1,2\n'),
        ("a.mat", b"\0" * 200),
        ("a.uff", b"    -1\n    58\n    -1\n"),
        ("a.h5", b"\x89HDF\r\n\x1a\n" + b"\0" * 100),
        ("a.parquet", b"PAR1PAR1"),
    ],
)
@pytest.mark.parametrize("trusted", [False, True])
def test_no_error_is_outside_the_tree(
    tmp_path: Path, name: str, content: bytes, trusted: bool
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with contextlib.suppress(br.FileError):
        assert br.read(path, fs=1.0, trusted=trusted).n_samples > 0


def test_names_keep_what_is_no_end_of_a_line(tmp_path: Path) -> None:
    path = tmp_path / "a.csv"
    path.write_text("a\u2028b,c\x0bd\n1,2\n2,3\n", encoding="utf-8")
    record = br.read(path, fs=1.0)
    assert {name: x.tolist() for name, x in record.items()} == {
        "a\u2028b": [1.0, 2.0],
        "c\x0bd": [2.0, 3.0],
    }


def test_sounds_of_any_whole_numbers_stay(tmp_path: Path) -> None:
    path = tmp_path / "a.wav"
    wavfile.write(path, 8000, np.array([1, -2, 3], dtype=np.int16))
    assert (br.read(path)["channel_1"] * 2**15).tolist() == [1.0, -2.0, 3.0]
