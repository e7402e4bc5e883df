"""``ballrace fmu``: a bearing for other simulation programs, by the Functional Mock-up Interface 3.0."""

from __future__ import annotations

import ctypes
import json
import platform
import shutil
import subprocess
import sys
import zipfile
from contextlib import suppress
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import TYPE_CHECKING
from urllib.parse import urlsplit
from urllib.request import url2pathname

from .._io.whole import whole
from ..errors import FileError
from .arguments import Commands, add_scene, added, read_scene

if TYPE_CHECKING:
    import argparse

_ENDINGS = {"linux": ".so", "darwin": ".dylib", "win32": ".dll"}
_SYSTEMS = {"darwin": "darwin", "win32": "windows"}
_MACHINES = {"amd64": "x86_64", "arm64": "aarch64"}
"""Names that the standard has for systems and machines, where Python has others."""

_IDENTIFIER = "ballrace_fmu"
"""Name of the library within an FMU, as its description has it."""

_NAME = (
    f"{'' if sys.platform == 'win32' else 'lib'}{_IDENTIFIER}{_ENDINGS.get(sys.platform, '.so')}"
)
"""Name of its file, as cargo gives it."""

_PACKAGED = Path(__file__).parents[1] / "_fmu" / _NAME
"""Folder of the library in wheels of a release: no place where Python looks for modules."""

_CARGO = ("cargo", "build", "--release", "--locked", "-p", "ballrace-fmu")

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
    where = pack.add_mutually_exclusive_group()
    where.add_argument(
        "--library", type=Path, metavar="FILE",
        help="shared library to pack (default: the package's, or else what cargo has built in the repository)",
    )  # fmt: skip
    where.add_argument(
        "--build", action="store_true",
        help=f"build the library first, in ballrace's repository: {' '.join(_CARGO)}",
    )  # fmt: skip


def _library(options: argparse.Namespace) -> Path:
    """Return the library to pack.

    Raises
    ------
    FileError
        There is none, or it cannot be built.
    """
    repository = _repository()
    if options.build:
        return _built(repository)
    if options.library is not None:
        given: Path = options.library
        return given
    places = [_PACKAGED]
    if repository is not None:
        places.append(repository / "target" / "release" / _NAME)
    for place in places:
        if place.is_file():
            return place
    raise FileError(
        _NAME,
        "this installation has no library for FMUs, as it was built from source; add --build, or build it in "
        f"ballrace's repository, {' '.join(_CARGO)}, and give it by --library",
    )


def _repository() -> Path | None:
    """Return ballrace's repository or unpacked sdist: around us, or what pip has built this installation from."""
    here = Path.cwd()
    found = [here, *here.parents]
    with suppress(PackageNotFoundError):
        origin = distribution("ballrace").read_text("direct_url.json")
        url = urlsplit(json.loads(origin)["url"] if origin else "")
        if url.scheme == "file":
            found.append(Path(url2pathname(url.path)))
    return next((folder for folder in found if (folder / "fmu" / "src" / "abi.rs").is_file()), None)


def _built(repository: Path | None) -> Path:
    """Return the library that cargo builds; what it does meanwhile goes to standard error."""
    if repository is None:
        raise FileError(
            str(Path.cwd()),
            "neither ballrace's repository nor its unpacked sdist, in which --build builds the library",
        )
    if shutil.which("cargo") is None:
        raise FileError(
            str(repository), "--build needs cargo, which is not installed: see https://rustup.rs"
        )
    command = [*_CARGO, "--message-format=json-render-diagnostics"]
    done = subprocess.run(command, cwd=repository, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise FileError(
            str(repository), f"{' '.join(_CARGO)} has failed; what it said stands above"
        )
    messages = [json.loads(line) for line in done.stdout.splitlines()]
    files = [Path(file) for message in messages for file in message.get("filenames", [])]
    (library,) = [file for file in files if file.name == _NAME]
    return library


def _fmu(options: argparse.Namespace) -> None:
    scene = read_scene(options.scene).to_toml()
    library = _library(options)
    description = _described(library, scene)
    machine = platform.machine().lower()
    system = _SYSTEMS.get(sys.platform, sys.platform)
    folder = f"binaries/{_MACHINES.get(machine, machine)}-{system}"
    ending = _ENDINGS.get(sys.platform, ".so")
    entries = {
        "modelDescription.xml": description.encode(),
        f"{folder}/{_IDENTIFIER}{ending}": library.read_bytes(),
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
        raise FileError(str(library), "no such library")
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
