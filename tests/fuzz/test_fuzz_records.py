"""Any bytes under the name of a record end in a record or one error with the file's name, within the limits."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import hypothesis.strategies as st
import numpy as np
import pytest
from hypothesis.strategies import DrawFn

import ballrace as br
from budget import decided, fuzzed
from records import ENDS, seeds

CORPUS = Path(__file__).parent / "corpus" / "records"

PIECES = st.one_of(
    st.binary(min_size=1, max_size=8),
    st.sampled_from(
        (b"\0", b"\xff", b"\xff" * 4, b"\xff" * 8, b"\x7f" + b"\xff" * 3, b"\0" * 8, b"\x80", b"\n", b",", b";",
         b'"', b"nan", b"1e999", b"-", b"\x0b", b"\x85", "\u2028".encode(), b"\0\0\0\x80", b"\xff\xff\xff\x7f")
    ),
)  # fmt: skip


@st.composite
def damaged(draw: DrawFn, end: str) -> bytes:
    """Draw a file with some bytes changed, put in, left out, doubled or cut."""
    data = draw(st.sampled_from(seeds(end)))
    for _ in range(draw(st.integers(1, 4))):
        at, length = draw(st.integers(0, len(data))), draw(st.integers(0, 40))
        match draw(st.integers(0, 5)):
            case 0 | 1:
                piece = draw(PIECES)
                data = data[:at] + piece + data[at + len(piece) :]
            case 2:
                data = data[:at] + draw(PIECES) + data[at:]
            case 3:
                data = data[:at] + data[at + length :]
            case 4:
                data = data[: at + length] + data[at:]
            case _:
                bit = bytes([data[at] ^ (1 << draw(st.integers(0, 7)))]) if at < len(data) else b""
                data = data[:at] + bit + data[at + 1 :]
    return data


def record_is_decided(end: str, data: bytes) -> str:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"105.{end}"
        path.write_bytes(data)

        def read(fs: float | None) -> br.Recording:
            return br.read(path, fs, time_limit=5.0, memory_limit=1e9)

        found = decided(lambda: read(None))
        if isinstance(found, br.SceneError) and found.path == "fs":
            found = decided(lambda: read(1000.0))  # the file has none
        if isinstance(found, br.FileError):
            assert found.path == str(path), found
            return "ended" if "ended the process" in found.reason else "refused"
        assert not isinstance(found, br.InternalError), found
        if isinstance(found, br.BallraceError):
            return type(found).__name__
        assert found.n_samples > 0
        assert all(x.dtype == np.float64 for x in found.values())
        return "read"


def _target(end: str) -> Callable[[], None]:
    @fuzzed(data=damaged(end))
    def target(data: bytes) -> str:
        return record_is_decided(end, data)

    return target


for _end in ENDS:
    globals()[f"test_any_{_end}"] = _target(_end)


@pytest.mark.parametrize("end", ENDS)
def test_every_seed_is_a_record(end: str) -> None:
    assert {record_is_decided(end, data) for data in seeds(end)} == {"read"}


@pytest.mark.parametrize("path", sorted(CORPUS.glob("*")), ids=lambda path: path.name)
def test_the_corpus(path: Path) -> None:
    record_is_decided(path.suffix[1:], path.read_bytes())
