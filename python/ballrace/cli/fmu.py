"""``ballrace fmu``: a bearing for other simulation programs, by the Functional Mock-up Interface 3.0."""

from __future__ import annotations

import ctypes
import platform
import sys
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

from .._io.whole import whole
from ..errors import FileError
from .arguments import Commands, add_scene, added, read_scene

if TYPE_CHECKING:
    import argparse

__all__ = ["add_commands"]

_ENDINGS = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
_SYSTEMS = {"darwin": "darwin", "win32": "windows"}
_MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
"""Names that the standard has for systems and machines, where Python has others."""

_IDENTIFIER = "ballrace_fmu"
"""Name of the library within an FMU, as its description has it."""

_LONG_AGO = (1980, 1, 1, 0, 0, 0)
"""The time of every entry, so that the same scene and library give the same bytes."""


def add_commands(commands: Commands[argparse.ArgumentParser]) -> None:
    """Add the subcommand."""
    pack = added(
        commands, "fmu", "pack a scene for other simulation programs, as an FMU (FMI 3.0, co-simulation)",
        "ballrace fmu scene.toml -o bearing.fmu", _fmu,
    )  # fmt: skip
    add_scene(pack)
    pack.add_argument("-o", "--out", type=Path, required=True, metavar="FILE", help="file, .fmu")
    pack.add_argument(
        "--library", type=Path, default=_built(), metavar="FILE",
        help="what `cargo build --release -p ballrace-fmu` has built in the repository (default: %(default)s)",
    )  # fmt: skip


def _built() -> Path:
    """Return where cargo puts the library, from the root of the repository."""
    prefix = "" if sys.platform == "win32" else "lib"
    ending = _ENDINGS.get(sys.platform, ".so")
    return Path("target", "release", f"{prefix}{_IDENTIFIER}{ending}")


def _fmu(options: argparse.Namespace) -> None:
    scene = read_scene(options.scene).to_toml()
    description = _described(options.library, scene)
    machine = platform.machine().lower()
    system = _SYSTEMS.get(sys.platform, sys.platform)
    folder = f"binaries/{_MACHINES.get(machine, machine)}-{system}"
    ending = _ENDINGS.get(sys.platform, ".so")
    entries = {
        "modelDescription.xml": description.encode(),
        f"{folder}/{_IDENTIFIER}{ending}": options.library.read_bytes(),
        "resources/scene.toml": scene.encode(),
    }
    with whole(options.out) as temporary, zipfile.ZipFile(temporary, "w") as packed:
        for name, content in entries.items():
            entry = zipfile.ZipInfo(name, _LONG_AGO)
            entry.compress_type = zipfile.ZIP_DEFLATED
            packed.writestr(entry, content)
    print(f"{options.out}: {', '.join(entries)}")


def _described(library: Path, scene: str) -> str:
    """Return the description of a scene, which the library writes.

    Raises
    ------
    FileError
        There is no such library, or it is none of ours; or it refuses the scene.
    """
    if not library.is_file():
        raise FileError(
            str(library),
            "no such library: build it in ballrace's repository, `cargo build --release -p ballrace-fmu`, "
            f"and give {_built()} there by --library",
        )
    answers: list[tuple[bool, str]] = []
    answer = ctypes.CFUNCTYPE(None, ctypes.c_bool, ctypes.c_char_p)
    try:
        describe = ctypes.CDLL(str(library.resolve())).ballrace_fmu_describe
    except (OSError, AttributeError) as error:
        raise FileError(str(library), f"no library of ballrace's FMUs ({error})") from error
    describe.restype = None
    describe(scene.encode(), answer(lambda well, text: answers.append((well, text.decode()))))
    ((well, text),) = answers
    if not well:
        raise FileError(str(library), f"of another version, it refuses the scene: {text}")
    return text
